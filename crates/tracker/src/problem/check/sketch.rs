//! Degenerate places in the sketch, decided exactly.

use crate::problem::Point;
use crate::rational::Rational;

/// Whether two points are in the same place.
pub fn coincide(a: &Point, b: &Point) -> bool {
    a.sketch == b.sketch
}

/// Whether three points lie on one line.
pub fn collinear(a: &Point, b: &Point, c: &Point) -> bool {
    let difference = |p: &Point| -> [Rational; 3] {
        std::array::from_fn(|k| p.sketch[k].value() - a.sketch[k].value())
    };
    let (u, v) = (difference(b), difference(c));
    // Both products of each component of the cross product.
    [(0, 1), (1, 2), (2, 0)]
        .into_iter()
        .all(|(i, j)| (&u[i] * &v[j] - &u[j] * &v[i]).is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Decimal;

    fn point(coordinates: [&str; 3]) -> Point {
        Point {
            name: "p".into(),
            sketch: coordinates.map(|x| x.parse::<Decimal>().unwrap()),
        }
    }

    #[test]
    fn decides_exactly() {
        let a = point(["0.1", "0.2", "0.3"]);
        assert!(coincide(&a, &point(["1e-1", "0.20", "3e-1"])));
        assert!(!coincide(
            &a,
            &point(["0.1", "0.2", "0.30000000000000000000000001"])
        ));
        // In floats 0.1 + 0.2 is not 0.3; here the points are on the line exactly.
        let line = [
            point(["0", "0", "0"]),
            a.clone(),
            point(["0.3", "0.6", "0.9"]),
        ];
        assert!(collinear(&line[0], &line[1], &line[2]));
        let off = point(["0.3", "0.6", "0.90000000000000000000000001"]);
        assert!(!collinear(&line[0], &line[1], &off));
    }
}
