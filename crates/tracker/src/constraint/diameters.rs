//! Chords through the middle of their circle, in the plane, for sets of figures.
//!
//! With a = p − c and b = q − c let |a|² = |b|² and a × b = 0: p and q are on a circle about c, and c is on the line through both. All that has
//! p = q solves these, too, whatever p is, so that a search for all zeros meets curves of what are no figures. Where the
//! line has a direction, w = p − q is not 0; and then s = a + b is: w · s = |a|² − |b|² = 0 and w × s = 2 a × b = 0, and |w|² |s|² is the sum of the
//! squares of both. So s = 0 says in two linear equations what the two others say of figures: c is in the middle.

use super::factors::{Equal, power};
use super::quadratic::{Entry, Equation, Form, Product, Tail, difference};
use crate::interval::Real;
use crate::places::Each as _;

/// A difference from a point c, by what stands for its entries: the other point's coordinate, and that of c.
pub type Ends = [Entry; 2];

/// Puts linear equations in the place of those that a chord through the middle of a circle has.
///
/// `rights`: the right-hand sides at t = 1. `is_kept`: equations that stay. `apart`: whether two
/// points, given by their coordinates, are in different places in all figures.
pub fn halve(
    tail: &mut Tail,
    rights: &[Real],
    equal: &Equal,
    is_kept: &[bool],
    apart: impl Fn([[Entry; 2]; 2]) -> bool,
) {
    let count = tail.equations.len();
    let keys: Vec<Vec<Key>> = tail.equations.iter().map(|e| keys(e, equal)).collect();
    let squares = |keys: &[Key]| keys.iter().filter(|key| key.1 == key.2).count();
    let may_be: Vec<bool> = keys.iter().map(|keys| squares(keys) >= 2).collect();
    let mut is_done = is_kept.to_vec();
    for (first, second) in (0..count).flat_map(|e| (0..count).map(move |f| (e, f))) {
        let is_open = |e: usize| may_be[e] && !is_done[e];
        if !is_open(first) || !is_open(second) || rights[first] != rights[second] {
            continue;
        }
        let found = match first == second {
            false => halves(keys[first].clone(), keys[second].clone()),
            // |a|² − |b|² = 0 by itself.
            true if rights[first].is_zero() => {
                let (one, other): (Vec<Key>, Vec<Key>) = keys[first].iter().partition(|k| k.0 > 0);
                halves(one, other.into_iter().map(|(f, a, b)| (-f, a, b)).collect())
            }
            true => None,
        };
        let chord = found.into_iter().flatten().find_map(|both| {
            // Of each axis the coordinates of p, q and c.
            let axes = both.each(|([p, c], [q, _])| [p, q, c]);
            let is_line = |&e: &usize| {
                let is_free = e != first && e != second && !is_done[e];
                is_free && rights[e].is_zero() && is_cross(&tail.equations[e], equal, &axes)
            };
            let [p, q] = [0, 1].each(|k| axes.each(|axis| axis[k]));
            let line = apart([p, q]).then(|| (0..count).find(is_line))?;
            Some((both, line?))
        });
        let Some(([x, y], line)) = chord else {
            continue;
        };
        for (e, (a, b)) in [(second, x), (line, y)] {
            let sum = [a, b].each(|[p, c]| difference(p, c));
            let equation = &mut tail.equations[e];
            equation.power = power(&tail.unknowns, sum[0]);
            equation.products = sum.each(|form| Product::new(2, form, Form::One)).to_vec();
            equation.right = vec![Real::zero()];
            is_done[e] = true;
        }
        is_done[first] = true;
    }
}

/// A product: its factor, and what stands for its factors, in order, so that one of two differences with the same names is a square, whichever way they are taken.
pub type Key = (i32, Option<Ends>, Option<Ends>);
type Named = Option<(Ends, i32)>;

/// The products of an equation that are not zero.
pub fn keys(equation: &Equation, equal: &Equal) -> Vec<Key> {
    let left = equal.left(&equation.products);
    let keys = left.map(|p| {
        let ends = [p.left, p.right].each(|form| equal.ordered(form));
        // A difference the other way has the other sign.
        let sign = |ends: &Named| ends.map_or(1, |(_, sign)| sign);
        let factor = p.factor * sign(&ends[0]) * sign(&ends[1]);
        let mut ends = ends.each(|ends| ends.map(|(ends, _)| ends));
        ends.sort_unstable();
        (factor, ends[0], ends[1])
    });
    keys.collect()
}

/// For two sums that are the same but for two squares in each, which differences of p and of q from c these may be, axis by axis.
fn halves(mut one: Vec<Key>, mut other: Vec<Key>) -> Option<Vec<[(Ends, Ends); 2]>> {
    one.retain(|key| match other.iter().position(|same| same == key) {
        Some(place) => {
            other.swap_remove(place);
            false
        }
        None => true,
    });
    let squares = |keys: &[Key]| match *keys {
        [(f, a, b), (g, c, d)] if f == g && a == b && c == d => Some((f, [a?, c?])),
        _ => None,
    };
    let ((f, [a, b]), (g, [c, d])) = (squares(&one)?, squares(&other)?);
    if f != g {
        return None;
    }
    // What is common to two differences is c, each from both of its ends.
    let common = |a: Ends, b: Ends| -> Vec<(Ends, Ends)> {
        let turned = |[i, j]: Ends| [[i, j], [j, i]];
        let pairs = turned(a)
            .into_iter()
            .flat_map(|a| turned(b).each(|b| (a, b)));
        pairs.filter(|([_, c], [_, d])| c == d).collect()
    };
    let mut out = Vec::new();
    for [(a, c), (b, d)] in [[(a, c), (b, d)], [(a, d), (b, c)]] {
        for x in common(a, c) {
            out.extend(common(b, d).into_iter().map(|y| [x, y]));
        }
    }
    Some(out)
}

/// Whether an equation says that two different ones of p − c, q − c and p − q are parallel.
fn is_cross(equation: &Equation, equal: &Equal, axes: &[[Entry; 3]; 2]) -> bool {
    let left: Vec<&Product> = equal.left(&equation.products).collect();
    let &[one, other] = left.as_slice() else {
        return false;
    };
    if one.factor != -other.factor {
        return false;
    }
    // Whether a product is that of two differences of named entries.
    let is = |p: &Product, x: [Entry; 2], y: [Entry; 2]| {
        let both = [p.left, p.right].each(|form| equal.ends(form));
        both == [Some(x), Some(y)] || both == [Some(y), Some(x)]
    };
    let pairs = || (0..3).flat_map(|i| (0..3).filter(move |&j| j != i).map(move |j| [i, j]));
    pairs().any(|[i, j]| {
        let mut others = pairs().filter(|&[k, l]| [k, l] != [i, j] && [l, k] != [i, j]);
        others.any(|[k, l]| {
            let [x, y] = axes;
            let [ux, uy] = [[x[i], x[j]], [y[i], y[j]]];
            let [vx, vy] = [[x[k], x[l]], [y[k], y[l]]];
            let is_so = |one, other| is(one, ux, vy) && is(other, uy, vx);
            is_so(one, other) || is_so(other, one)
        })
    })
}

#[cfg(test)]
mod tests {
    use crate::constraint::quadratic::{Entry, Product, difference};
    use crate::constraint::testing::read;
    use crate::constraint::try_lower_for_sets;

    /// The left-hand sides that sets have of a chord p-q of a circle about c, and others.
    fn left(points: &str, constraints: &str) -> Vec<Vec<Product>> {
        let problem = read(&format!(
            "name = \"chord\"\ndimension = 2\n[points]\n{points}\n[constraints]\n{constraints}"
        ));
        let (tail, _) = try_lower_for_sets(&problem, |_| Ok(Vec::new())).unwrap();
        tail.equations.into_iter().map(|e| e.products).collect()
    }

    /// p + q − 2 c along an axis, c being where it is, or 0.
    fn sum(axis: usize, c: Option<usize>) -> Vec<Product> {
        let at = |point| Entry::Coordinate { point, axis };
        let middle = c.map_or(Entry::Zero, at);
        [0, 1]
            .map(|end| Product::new(2, difference(at(end), middle), super::Form::One))
            .to_vec()
    }

    const POINTS: &str = "p = [2, 0.1]\nq = [-2, 0]\nc = [0, 0]\nm = [1, 5]";
    const REST: &str = "fixed = [\"m\"]\non = [[\"c\", \"p\", \"q\"]]\nperpendicular = [[\"p\", \"q\", \"c\", \"m\"]]";

    fn is_halved(all: &[Vec<Product>], c: Option<usize>) -> bool {
        let same = |one: &[Product], other: &[Product]| {
            one.len() == other.len() && one.iter().all(|p| other.contains(p))
        };
        (0..2).all(|axis| all.iter().any(|left| same(left, &sum(axis, c))))
    }

    #[test]
    fn the_middle_of_a_circle_is_the_middle_of_a_chord_through_it() {
        let fixed = REST.replace("[\"m\"]", "[\"m\", \"n\"]");
        let distances = "distances = [[\"p\", \"c\", 2], [\"c\", \"q\", 2], [\"c\", \"m\", 5], [\"c\", \"n\", 6]]\n";
        let points = format!("{POINTS}\nn = [6, 1]");
        assert!(is_halved(
            &left(&points, &format!("{distances}{fixed}")),
            Some(2)
        ));
        // About the origin.
        let fixed = REST.replace("[\"m\"]", "[\"m\", \"c\"]");
        let distances = "distances = [[\"p\", \"c\", 2], [\"c\", \"q\", 2]]\n";
        assert!(is_halved(
            &left(POINTS, &format!("{distances}{fixed}")),
            None
        ));
    }

    /// A line at a right angle to itself by other names has no length.
    #[test]
    fn squares_by_other_names_are_squares() {
        let points = "a = [1, 2]\na2 = [1, 2]\nb = [0, 0]\nb2 = [0, 0]\nc = [3, 1]\nc2 = [3, 1]";
        let all = left(
            points,
            "fixed = [\"b\"]\ncoincident = [[\"a\", \"a2\"], [\"b\", \"b2\"], [\"c\", \"c2\"]]\n\
             perpendicular = [[\"a\", \"b\", \"a2\", \"b2\"], [\"a\", \"c\", \"a2\", \"c2\"]]\n\
             distances = [[\"b\", \"c\", 2]]\non = [[\"a\", \"b\", \"c\"]]",
        );
        assert!(all.iter().all(|products| !products.is_empty()));
    }

    #[test]
    fn other_chords_and_other_lengths_stay() {
        let fixed = REST.replace("[\"m\"]", "[\"m\", \"c\"]");
        let other = "distances = [[\"p\", \"c\", 2], [\"c\", \"q\", 3]]\n";
        assert!(!is_halved(&left(POINTS, &format!("{other}{fixed}")), None));
        // m is on the chord, c is not.
        let equal = "distances = [[\"p\", \"c\", 2], [\"c\", \"q\", 2]]\n";
        let aside = fixed.replace("[\"c\", \"p\"", "[\"m\", \"p\"");
        assert!(!is_halved(&left(POINTS, &format!("{equal}{aside}")), None));
    }
}
