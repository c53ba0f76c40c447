//! Equations for paths that pass through figures in which all points are in the reference plane.
//!
//! Where a problem has more equations that are odd in the heights over the reference plane (coplanarities, most of them)
//! than it has heights, a flat figure satisfies all of them at t = 1, where they are led to zero, whatever else it is:
//! flat figures come in continua there, and the equations are dependent at each of them. A path that runs into one has
//! heights that go to zero like 1 − t. So every quantity u that changes its sign with the heights is written as s·u',
//! with s = 1 − t an unknown, and the odd equations are divided by s. What is left is quadratic again, and regular where
//! the path passes the flat figure (Imbach, Mathis, Schreck meet such figures in 5.2 and step over them in 7.1).
//!
//! For s ≠ 0 the divided equations hold where the given ones do. For s = 0 they hold at flat figures only.

use super::polynomial::Polynomial;
use super::quadratic::{
    Entry, Equation, Form, Nonzero, Product, Role, Tail, Unknown, difference, value,
};
use crate::equations::sign;
use crate::interval::{Interval, Real, point};
use crate::places::Each as _;

/// What an auxiliary unknown of the divided equations stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// s = 1 − t.
    Scale,
    /// The given auxiliary unknown of this number.
    Same(usize),
    /// That, divided by s.
    Divided(usize),
    /// The height of this point over the reference plane, divided by s.
    Height(usize),
}

/// The divided equations.
#[derive(Debug, Clone)]
pub struct Divided {
    /// Their unknowns beside coordinates of points, and those of them that are not distances.
    pub tail: Tail,
    /// What each of its unknowns stands for.
    pub origins: Vec<Origin>,
}

/// An odd unknown: a height or an auxiliary one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Odd {
    Height(usize),
    Auxiliary(usize),
}

/// How many equations of a tail change their sign with the heights, and how many unknowns do; and whether all of those
/// equations have zero on the right for every t, so that they hold in every flat figure. `heights`: as in [`divide`]. The
/// error says which equation does neither.
pub fn odd_ones(tail: &Tail, heights: &[Option<Interval>]) -> Result<([usize; 2], bool), String> {
    let (mut equations, mut hold) = (0, true);
    for equation in &tail.equations {
        if is_odd(equation, tail, heights)? {
            equations += 1;
            hold &= equation.right.iter().all(Real::is_zero);
        }
    }
    let auxiliary = tail.unknowns.iter().filter(|unknown| unknown.flips[2]);
    let unknowns = heights.iter().flatten().count() + auxiliary.count();
    Ok(([equations, unknowns], hold))
}

/// Divides the odd equations of a tail by 1 − t.
///
/// `heights`: for every point an enclosure of its height in the sketch, in the problem's unit, where that is an
/// unknown. Fails, in words for people, where flat figures are no continuum or cannot solve the problem.
pub fn divide(tail: &Tail, heights: &[Option<Interval>]) -> Result<Divided, String> {
    let odd: Vec<bool> = (tail.equations.iter())
        .map(|equation| is_odd(equation, tail, heights))
        .collect::<Result<_, _>>()?;
    let equations = odd.iter().filter(|&&odd| odd).count();
    let unknowns = heights.iter().flatten().count()
        + (tail.unknowns.iter())
            .filter(|unknown| unknown.flips[2])
            .count();
    if equations <= unknowns {
        return Err(
            "there are no more conditions on heights than heights, so that flat figures do not come in continua"
                .to_owned(),
        );
    }
    let is_unfit = |u: &&Unknown| u.flips[2] && u.role == Role::Positive;
    if let Some(unknown) = tail.unknowns.iter().find(is_unfit) {
        return Err(format!(
            "{} would be zero in a flat figure, and must not be",
            unknown.name
        ));
    }
    let mut out = Dividing::new(tail, heights, &odd);
    for (equation, &odd) in tail.equations.iter().zip(&odd) {
        match odd {
            true => out.divide(equation)?,
            false => out.keep(equation),
        }
    }
    Ok(out.finish())
}

/// Whether an equation changes its sign where heights are reversed. The error: some terms do, and others do not.
fn is_odd(equation: &Equation, tail: &Tail, heights: &[Option<Interval>]) -> Result<bool, String> {
    // A height that the reference fixes is zero.
    let left = |entry| match entry {
        Entry::Coordinate { point, axis: 2 } if heights[point].is_none() => Entry::Zero,
        entry => entry,
    };
    let products: Vec<Product> = equation.products.iter().map(|p| p.map(left)).collect();
    sign(&products, |entry| entry.changes(tail, 2)).ok_or_else(|| {
        format!(
            "{} is not symmetric about the reference plane",
            equation.name
        )
    })
}

/// The divided equations as they come to be.
struct Dividing<'a> {
    tail: &'a Tail,
    heights: &'a [Option<Interval>],
    out: Tail,
    origins: Vec<Origin>,
    scale: Entry,
    /// For each given auxiliary unknown what it is now, if it is left; and for odd ones u'.
    same: Vec<Option<Entry>>,
    divided: Vec<Option<Entry>>,
    /// For each point its height over s.
    over: Vec<Option<Entry>>,
}

impl<'a> Dividing<'a> {
    fn new(tail: &'a Tail, heights: &'a [Option<Interval>], odd: &[bool]) -> Self {
        let count = tail.unknowns.len();
        let mut new = Dividing {
            tail,
            heights,
            out: Tail {
                // With the heights over s reversed the divided equations do not hold.
                mirrors: false,
                ..Tail::default()
            },
            origins: Vec::new(),
            scale: Entry::Zero,
            same: vec![None; count],
            divided: vec![None; count],
            over: vec![None; heights.len()],
        };
        new.scale = new.unknown(
            Origin::Scale,
            Unknown {
                name: "1 − t".to_owned(),
                role: Role::Free,
                power: 0,
                flips: [false; 3],
                sketch: point(1.0),
            },
        );
        let s = value(new.scale);
        let one = vec![Real::whole(1), Real::whole(-1)];
        new.equate("1 − t", vec![Product::new(2, s, Form::One)], one, 0);
        for (p, height) in heights.iter().enumerate() {
            let Some(height) = *height else { continue };
            let name = format!("the height of point {} over 1 − t", p + 1);
            let flips = [false, false, true];
            let over = Unknown {
                name: name.clone(),
                role: Role::Free,
                power: 1,
                flips,
                sketch: height,
            };
            let over = new.unknown(Origin::Height(p), over);
            new.over[p] = Some(over);
            new.is_scaled(&name, Entry::Coordinate { point: p, axis: 2 }, over, 1);
        }
        let is_needed = new.needed(odd);
        for (u, unknown) in tail.unknowns.iter().enumerate() {
            if !unknown.flips[2] || is_needed[u] {
                new.same[u] = Some(new.unknown(Origin::Same(u), unknown.clone()));
            }
            if unknown.flips[2] {
                let name = format!("{} over 1 − t", unknown.name);
                let over = Unknown {
                    name: name.clone(),
                    ..unknown.clone()
                };
                let over = new.unknown(Origin::Divided(u), over);
                new.divided[u] = Some(over);
                if let Some(same) = new.same[u] {
                    new.is_scaled(&name, same, over, unknown.power);
                }
            }
        }
        new
    }

    /// The auxiliary unknowns that even equations are about.
    fn needed(&self, odd: &[bool]) -> Vec<bool> {
        let mut needed = vec![false; self.tail.unknowns.len()];
        let equations = self.tail.equations.iter().zip(odd);
        for (equation, _) in equations.filter(|(_, odd)| !**odd) {
            let entries = equation.products.iter().flat_map(|p| p.entries());
            entries
                .filter_map(Entry::unknown)
                .for_each(|u| needed[u] = true);
        }
        needed
    }

    fn unknown(&mut self, origin: Origin, unknown: Unknown) -> Entry {
        self.out.unknowns.push(unknown);
        self.origins.push(origin);
        Entry::Unknown(self.out.unknowns.len() - 1)
    }

    /// u = s u'.
    fn is_scaled(&mut self, name: &str, u: Entry, over: Entry, power: i32) {
        let products = vec![
            Product::new(2, value(u), Form::One),
            Product::new(-2, value(self.scale), value(over)),
        ];
        self.equate(name, products, vec![Real::zero()], power);
    }

    fn equate(&mut self, name: &str, products: Vec<Product>, right: Polynomial, power: i32) {
        self.out.equations.push(Equation {
            name: name.to_owned(),
            products,
            right,
            power,
        });
    }

    fn odd(&self, entry: Entry) -> Option<Odd> {
        match entry {
            Entry::Coordinate { point, axis: 2 } => self.heights[point].map(|_| Odd::Height(point)),
            Entry::Unknown(u) if self.tail.unknowns[u].flips[2] => Some(Odd::Auxiliary(u)),
            _ => None,
        }
    }

    /// An entry as it is, if it is left.
    fn plain(&self, entry: Entry) -> Option<Entry> {
        match entry {
            Entry::Unknown(u) => self.same[u],
            other => Some(other),
        }
    }

    /// An odd entry over s, any other as it is.
    fn over(&self, entry: Entry) -> Entry {
        match self.odd(entry) {
            Some(Odd::Height(p)) => self.over[p].expect("every height has one"),
            Some(Odd::Auxiliary(u)) => self.divided[u].expect("every odd unknown has one"),
            None => self.plain(entry).expect("even unknowns are left"),
        }
    }

    /// An even equation.
    fn keep(&mut self, equation: &Equation) {
        let plain = |entry| self.plain(entry).expect("it is needed");
        let products = equation.products.iter().map(|p| p.map(plain));
        let products = products.collect();
        let right = equation.right.clone();
        self.equate(&equation.name, products, right, equation.power);
    }

    /// An odd equation, of which each product has one odd factor.
    fn divide(&mut self, equation: &Equation) -> Result<(), String> {
        let Some(right) = over_one_minus_t(&equation.right) else {
            return Err(format!("{} is not zero at t = 1", equation.name));
        };
        let products = equation.products.iter();
        let products = products.map(|p| p.map(|entry| self.over(entry))).collect();
        self.equate(&equation.name, products, right, equation.power);
        Ok(())
    }

    /// Vectors that must not vanish must not do so by what is left of them.
    fn finish(mut self) -> Divided {
        let left = |form: Form| match form {
            Form::One => form,
            Form::Difference(a, b) => match (self.plain(a), self.plain(b)) {
                (Some(a), Some(b)) => difference(a, b),
                _ => difference(Entry::Zero, Entry::Zero),
            },
        };
        let nonzero = self.tail.nonzero.iter().map(|vector| Nonzero {
            name: vector.name.clone(),
            forms: vector.forms.each(left),
        });
        self.out.nonzero = nonzero.collect();
        Divided {
            tail: self.out,
            origins: self.origins,
        }
    }
}

/// The quotient of a polynomial by 1 − t, if that is one without any doubt.
fn over_one_minus_t(of: &Polynomial) -> Option<Polynomial> {
    // Numbers that are no ratios are known to cancel where one is written as the other's opposite.
    if let [start, back] = &of[..]
        && *back == -start
    {
        return Some(vec![start.clone()]);
    }
    let (last, rest) = of.split_last()?;
    let mut sum = Real::zero();
    let mut quotient = Polynomial::new();
    for coefficient in rest {
        sum = &sum + coefficient;
        quotient.push(sum.clone());
    }
    if quotient.is_empty() {
        quotient.push(Real::zero());
    }
    (&sum + last).is_zero().then_some(quotient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constraint::coordinate;

    fn whole(values: &[i64]) -> Polynomial {
        values.iter().map(|&v| Real::whole(v)).collect()
    }

    #[test]
    fn divides_what_vanishes_and_nothing_else() {
        let cases: [(&[i64], Option<&[i64]>); 7] = [
            (&[3, -3], Some(&[3])),
            (&[0, 2, -2], Some(&[0, 2])),
            (&[0], Some(&[0])),
            (&[1, 0, 0, 0, -1], Some(&[1, 1, 1, 1])),
            (&[3, -2], None),
            (&[1], None),
            (&[0, 1, 1], None),
        ];
        for (of, expected) in cases {
            let found = over_one_minus_t(&whole(of));
            assert_eq!(found, expected.map(whole), "{of:?}");
        }
        // The root of 2 led to zero, and to something that only looks like its opposite.
        let root = Real::whole(2).sqrt();
        assert_eq!(
            over_one_minus_t(&vec![root.clone(), -&root]),
            Some(vec![root.clone()])
        );
        let other = &(-&root) + &Real::from(crate::rational::Rational::new(1.into(), 1000.into()));
        assert_eq!(over_one_minus_t(&vec![root, other]), None);
    }

    fn vanishing(name: &str, products: Vec<Product>, right: &[i64]) -> Equation {
        Equation {
            name: name.to_owned(),
            products,
            right: whole(right),
            power: 1,
        }
    }

    /// One height and two conditions on it, of which one may be spoilt.
    fn two(products: Vec<Product>, right: &[i64]) -> Result<Divided, String> {
        let z = value(coordinate(3, 2));
        let tail = Tail {
            equations: vec![
                vanishing("one", vec![Product::new(2, z, Form::One)], &[1, -1]),
                vanishing("other", products, right),
            ],
            ..Tail::default()
        };
        divide(&tail, &[None, None, None, Some(point(1.0))])
    }

    #[test]
    fn refuses_what_keeps_figures_from_being_flat() {
        let (x, z) = (value(coordinate(3, 0)), value(coordinate(3, 2)));
        let odd = || vec![Product::new(2, z, x)];
        assert!(two(odd(), &[4, -4]).is_ok());
        let refused = |result: Result<Divided, String>| result.map(|_| ()).unwrap_err();
        assert!(refused(two(odd(), &[4, -3])).contains("other is not zero at t = 1"));
        let mixed = vec![Product::new(2, z, x), Product::new(2, x, Form::One)];
        assert!(refused(two(mixed, &[4, -4])).contains("other is not symmetric"));
        let form = vec![Product::new(
            2,
            difference(coordinate(3, 0), coordinate(3, 2)),
            Form::One,
        )];
        assert!(refused(two(form, &[4, -4])).contains("other is not symmetric"));
        // Even: then there is one condition on one height.
        assert!(refused(two(vec![Product::new(2, z, z)], &[4])).contains("continua"));
    }

    #[test]
    fn flat_figures_satisfy_the_undivided_equations_at_the_end() {
        let (x, z) = (value(coordinate(3, 0)), value(coordinate(3, 2)));
        let divided = two(vec![Product::new(2, z, x)], &[4, -4]).unwrap();
        assert_eq!(divided.origins, [Origin::Scale, Origin::Height(3)]);
        // s, z = s w, and the two.
        let equations = &divided.tail.equations;
        assert_eq!(equations.len(), 4);
        let over = value(Entry::Unknown(1));
        assert_eq!(equations[2].products, [Product::new(2, over, Form::One)]);
        assert_eq!(equations[3].products, [Product::new(2, over, x)]);
        assert_eq!(equations[3].right, whole(&[4]));
    }
}
