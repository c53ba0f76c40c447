use super::*;
use crate::rational::{Rational, exact};
use num_traits::Zero;
use proptest::prelude::*;

/// Of three symbols.
type Three = Model<3, 10>;

/// The polynomial at a point, exactly.
fn polynomial(f: &Three, u: &[f64; 3]) -> Rational {
    let mut sum = exact(f.middle());
    for i in 0..3 {
        sum += exact(f.slope(i)) * exact(u[i]);
        for j in i..3 {
            sum += exact(f.bend(j, i)) * exact(u[i]) * exact(u[j]);
        }
    }
    sum
}

fn encloses(f: &Three, u: &[f64; 3], value: &Rational) -> bool {
    (polynomial(f, u) - value).abs() <= exact(f.r)
}

fn model() -> impl Strategy<Value = Three> {
    let number = || (-1.0f64..1.0, -12i32..3).prop_map(|(x, e)| x * 2f64.powi(e));
    (prop::array::uniform10(number()), 0.0f64..1.0, -40i32..-1).prop_map(|(c, r, e)| Model {
        c,
        r: r * 2f64.powi(e),
    })
}

fn at() -> impl Strategy<Value = [f64; 3]> {
    prop::array::uniform3(prop_oneof![Just(1.0), Just(-1.0), -1.0f64..1.0])
}

/// A value that the model may stand for at u: the polynomial and part of the remainder.
fn value(f: &Three, u: &[f64; 3], part: f64) -> Rational {
    polynomial(f, u) + exact(f.r) * exact(part)
}

/// Whether 1/f and √f, where they are known at all, hold what they are of a value x of f at u.
fn quotient_and_root_enclose(f: &Three, range: Range, u: &[f64; 3], x: &Rational) -> bool {
    let (over, root) = (f.reciprocal(range), f.square_root(range));
    let is_over = !over.r.is_finite() || encloses(&over, u, &(Rational::one() / x));
    is_over
        && (!root.r.is_finite() || {
            let (p, r) = (polynomial(&root, u), exact(root.r));
            let (low, high) = (&p - &r, &p + &r);
            !high.is_negative() && &high * &high >= *x && (low.is_negative() || &low * &low <= *x)
        })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]
    #[test]
    fn operations_enclose(
        (f, g) in (model(), model()),
        u in at(),
        part in prop::array::uniform2(prop_oneof![Just(1.0), Just(-1.0), -1.0f64..1.0]),
        factor in -3.0f64..3.0,
        shift in 1.0f64..9.0,
    ) {
        let (x, y) = (value(&f, &u, part[0]), value(&g, &u, part[1]));
        prop_assert!(encloses(&f.plus(&g), &u, &(&x + &y)));
        prop_assert!(encloses(&f.minus(&g), &u, &(&x - &y)));
        prop_assert!(encloses(&f.times(&g), &u, &(&x * &y)));
        prop_assert!(encloses(&f.negative(), &u, &-&x));
        prop_assert!(encloses(&f.scaled(factor), &u, &(&x * exact(factor))));
        let number = Number { mid: factor, rad: 0.01 };
        let near = exact(factor) + exact(0.01) * exact(part[1]);
        prop_assert!(encloses(&f.by(number), &u, &(&x * &near)));
        prop_assert!(encloses(&f.shifted(number), &u, &(&x + &near)));
        let sum = weighted(&f, [(number, &g), (Number::exact(-1.0), &f)]);
        prop_assert!(encloses(&sum, &u, &(&near * &y)));
        let numbers = (number, Number { mid: shift, rad: 0.001 });
        let (a, b) = (near.clone(), exact(shift) + exact(0.001) * exact(part[0]));
        let holds = |n: Number, x: &Rational| (exact(n.mid) - x).abs() <= exact(n.rad);
        prop_assert!(holds(numbers.0.times(numbers.1), &(&a * &b)));
        prop_assert!(holds(numbers.0.plus(-0.5, numbers.1), &(&a - &b * exact(0.5))));
        let (a, b) = (f.factor(), g.factor());
        let sum = combined(&f, [(1.0, a, b), (-1.0, b, b), (1.0, a, a)]);
        prop_assert!(encloses(&sum, &u, &(&x + &x * &y - &y * &y + &x * &x)));
        let range = f.range();
        prop_assert!(exact(range.lo) <= x && x <= exact(range.hi));
        prop_assert!((&x - exact(f.middle())).abs() <= exact(f.reach()));

        // Shifted so far that it is positive, and less than so far that 0 is near.
        let shift = f.reach() * (1.0 + shift * shift * 0.01) - f.middle();
        let f = f.shifted(Number::exact(shift));
        let x = value(&f, &u, part[0]);
        let range = f.range();
        if range.lo > 0.0 {
            prop_assert!(quotient_and_root_enclose(&f, range, &u, &x));
        }
    }

    #[test]
    fn rotations_enclose(
        middle in -1.0f64..1.0,
        radius in prop_oneof![0.0f64..1.0, 0.0f64..1e-3, Just(0.0)],
        u in prop_oneof![Just(1.0), Just(-1.0), -1.0f64..1.0],
    ) {
        let pair: [Three; 2] = rotation(1, middle, radius);
        let t = exact(middle) + exact(radius) * exact(u);
        let below = Rational::one() + &t * &t;
        let wanted = [-(&t + &t) / &below, (Rational::one() - &t * &t) / &below];
        for k in 0..2 {
            prop_assert!(encloses(&pair[k], &[0.5, u, 0.25], &wanted[k]));
        }
        // And not by being wide.
        prop_assert!(pair[0].r <= 2.1 * radius.powi(3) + 1e-13);
    }

    /// A common zero of two equations stays in what is left, with and without a margin.
    #[test]
    fn nothing_that_equations_allow_is_cut_away(
        (f, g) in (model(), model()),
        u in at(),
        part in prop::array::uniform2(-1.0f64..1.0),
        checks: bool,
    ) {
        let zero_at = |f: &Three, part: f64| {
            // A float near its value there, and what the float is off.
            let value = value(f, &u, part);
            let near = value.to_f64();
            let off = (exact(near) - value).abs().to_f64() * 1.001 + 1e-300;
            f.shifted(Number { mid: -near, rad: off })
        };
        let equations = [zero_at(&f, part[0]), zero_at(&g, part[1])];
        let mut left = [Range::SYMBOL; 3];
        let margin = if checks { Margin::None } else { Margin::Some };
        let result = contract(&equations, &mut Vec::new(), &mut left, margin);
        prop_assert_eq!(result, Ok(()));
        for (left, u) in left.iter().zip(u) {
            prop_assert!(left.lo <= u && u <= left.hi);
        }
    }
}

proptest! {
    /// Of functions of any size: what is too large or too small for the squares in between is not known.
    #[test]
    fn roots_and_quotients_enclose_at_any_size(
        f in model(),
        u in at(),
        part in -1.0f64..1.0,
        shift in 1.001f64..9.0,
        size in -1000i32..1000,
    ) {
        let f = f.shifted(Number::exact(shift * f.reach() - f.middle()));
        let f = f.scaled(2f64.powi(size / 2)).scaled(2f64.powi(size - size / 2));
        let (x, range) = (value(&f, &u, part), f.range());
        prop_assume!(range.lo > 0.0);
        prop_assert!(quotient_and_root_enclose(&f, range, &u, &x));
    }
}

#[test]
fn products_are_not_wide() {
    let c = [1.0, 0.1, 0.02, 0.0, 0.01, 0.0, 0.0, 0.003, 0.0, 0.0];
    let f = Three { c, r: 1e-9 };
    let g = f.times(&f);
    assert!(g.r < 0.02 && g.middle() == 1.0 && !g.range().lo.is_zero());
}
