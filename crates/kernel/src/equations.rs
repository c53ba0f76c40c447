//! Products of differences: the left-hand side of every equation is a sum of such, ½ Σ factor · left · right.
//!
//! They are written once, for entries of any kind (a coordinate of a point, the number of an unknown) and factors of any
//! kind, and evaluated once, over any [`Ring`].

use std::ops::{Add, Mul, Sub};

/// Numbers that sums and products are made of: floats, intervals, residues modulo a prime, complex numbers.
pub trait Ring: Clone + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// A whole number.
    fn whole(number: i32) -> Self;
}

impl Ring for f64 {
    fn whole(number: i32) -> Self {
        number.into()
    }
}

/// Numbers that can be halved.
pub trait Halved: Ring {
    /// So many halves of it.
    fn halves(self, count: i32) -> Self;
}

impl Halved for f64 {
    #[inline]
    fn halves(self, count: i32) -> Self {
        0.5 * f64::from(count) * self
    }
}

/// A factor of a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Form<E> {
    /// The first entry minus the second.
    Difference(E, E),
    /// The number 1, for terms that are linear.
    One,
}

/// `factor · left · right`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Product<E, F = i32> {
    /// A whole number from −1000 to 1000, not zero, where nothing else is said.
    pub factor: F,
    /// The first of the two things multiplied.
    pub left: Form<E>,
    /// The second of the two things multiplied.
    pub right: Form<E>,
}

impl<E: Copy + PartialEq> Form<E> {
    /// The same difference of what is put for the entries.
    pub fn map<G>(self, entry: impl Fn(E) -> G) -> Form<G> {
        match self {
            Form::One => Form::One,
            Form::Difference(a, b) => Form::Difference(entry(a), entry(b)),
        }
    }

    /// The entries in it, with their signs.
    pub fn entries(self) -> impl Iterator<Item = (E, i32)> + Clone {
        let both = match self {
            Form::One => [None, None],
            Form::Difference(a, b) => [Some((a, 1)), Some((b, -1))],
        };
        both.into_iter().flatten()
    }

    /// Its value, where entries have these. An entry less itself is zero, whatever it is.
    #[inline]
    pub fn value<T: Ring>(self, at: impl Fn(E) -> T) -> T {
        match self {
            Form::One => T::whole(1),
            Form::Difference(a, b) if a == b => T::whole(0),
            Form::Difference(a, b) => at(a) - at(b),
        }
    }
}

impl<E: Copy + PartialEq, F: Copy> Product<E, F> {
    /// The product of a form with itself, or with another one.
    pub fn new(factor: F, left: Form<E>, right: Form<E>) -> Self {
        Product {
            factor,
            left,
            right,
        }
    }

    /// The same product with something else put for the entries.
    pub fn map<G>(self, entry: impl Fn(E) -> G) -> Product<G, F> {
        Product {
            factor: self.factor,
            left: self.left.map(&entry),
            right: self.right.map(entry),
        }
    }

    /// The two things multiplied.
    pub fn forms(self) -> [Form<E>; 2] {
        [self.left, self.right]
    }

    /// The entries in it, each as often as it stands there.
    pub fn entries(self) -> impl Iterator<Item = E> + Clone {
        let both = self.forms().into_iter();
        both.flat_map(|form| form.entries().map(|entry| entry.0))
    }

    /// left · right, where entries have these values.
    #[inline]
    pub fn value<T: Ring>(self, at: impl Fn(E) -> T) -> T {
        self.left.value(&at) * self.right.value(at)
    }

    /// The derivatives of left · right, as entry, sign and the factor that it has: those of one entry are to be added.
    pub fn derivatives<T: Ring>(self, at: impl Fn(E) -> T) -> impl Iterator<Item = (E, i32, T)> {
        let [left, right] = self.forms();
        [(left, right), (right, left)]
            .into_iter()
            .flat_map(move |(this, other)| {
                let slope = other.value(&at);
                this.entries()
                    .map(move |(entry, sign)| (entry, sign, slope.clone()))
            })
    }
}

/// A product multiplied out in some of its entries, while the others have values: all but its factor.
pub struct Expansion<T> {
    /// Two of these entries, by their places in order, with signs.
    pub products: Vec<((usize, usize), i32)>,
    /// One of them and what it is multiplied with: those of one entry are to be added.
    pub linear: Vec<(usize, T)>,
    /// What has none of them.
    pub constant: T,
}

impl<E: Copy + PartialEq, F: Copy> Product<E, F> {
    /// Multiplies it out in the entries that have places; `Err` is the value of another one.
    pub fn expand<T: Ring>(self, of: impl Fn(E) -> Result<usize, T>) -> Expansion<T> {
        let side = |form: Form<E>| {
            let mut own = Vec::new();
            let mut rest = T::whole((form == Form::One).into());
            for (entry, sign) in form.entries() {
                match of(entry) {
                    Ok(place) => own.push((place, sign)),
                    Err(value) => rest = rest + T::whole(sign) * value,
                }
            }
            (own, rest)
        };
        let [(left, a), (right, b)] = self.forms().map(side);
        let mut products = Vec::new();
        for &(i, f) in &left {
            products.extend(right.iter().map(|&(j, g)| ((i.min(j), i.max(j)), f * g)));
        }
        let by = |(k, sign), other: &T| (k, T::whole(sign) * other.clone());
        let linear = left.into_iter().map(|own| by(own, &b));
        let linear = linear.chain(right.into_iter().map(|own| by(own, &a)));
        Expansion {
            products,
            linear: linear.collect(),
            constant: a * b,
        }
    }
}

/// Makes numbers that have methods for sums and products a [`Ring`].
#[doc(hidden)]
#[macro_export]
macro_rules! ring {
    ($number:ty, $whole:expr) => {
        $crate::ring!($number, Add add plus);
        $crate::ring!($number, Sub sub minus);
        $crate::ring!($number, Mul mul times);
        impl $crate::equations::Ring for $number {
            fn whole(number: i32) -> Self {
                $whole(number.into())
            }
        }
    };
    ($number:ty, $operator:ident $operate:ident $method:ident) => {
        impl std::ops::$operator for $number {
            type Output = Self;
            fn $operate(self, other: Self) -> Self {
                self.$method(&other)
            }
        }
    };
}
#[doc(hidden)]
pub use ring;

/// ½ Σ factor · left · right, the left-hand side of an equation, where entries have these values.
#[inline]
pub fn left_side<E: Copy + PartialEq, T: Halved>(
    products: &[Product<E>],
    at: impl Fn(E) -> T,
) -> T {
    let terms = products.iter();
    terms.fold(T::whole(0), |sum, p| sum + p.value(&at).halves(p.factor))
}

/// The derivatives of ½ Σ factor · left · right, told one by one: those of one entry are to be added.
#[inline]
pub fn slopes<'p, E: Copy + PartialEq + 'p, T: Halved>(
    products: impl IntoIterator<Item = &'p Product<E>>,
    at: impl Fn(E) -> T,
    mut tell: impl FnMut(E, T),
) {
    for p in products {
        for (entry, sign, other) in p.derivatives(&at) {
            tell(entry, other.halves(sign * p.factor));
        }
    }
}

/// Whether some entries' change of signs reverses a sum of products (`Some(true)`), leaves it (`Some(false)`), or does neither. An entry of
/// which `changes` says nothing is the number 0, which has both signs.
pub fn sign<E: Copy + PartialEq, F: Copy>(
    products: &[Product<E, F>],
    changes: impl Fn(E) -> Option<bool>,
) -> Option<bool> {
    let of = |form: Form<E>| match form.map(&changes) {
        // Both ends change together.
        Form::Difference(Some(a), Some(b)) => (a == b).then_some(a),
        Form::Difference(a, b) => Some(a.or(b).unwrap_or(false)),
        Form::One => Some(false),
    };
    // A difference of an entry and itself is nothing, whatever multiplies it.
    let is_nothing = |form: Form<E>| matches!(form, Form::Difference(a, b) if a == b);
    let products = products.iter();
    let mut signs = products
        .filter(|p| !p.forms().into_iter().any(is_nothing))
        .map(|p| Some(of(p.left)? ^ of(p.right)?));
    let first = signs.next().unwrap_or(Some(false))?;
    signs.all(|sign| sign == Some(first)).then_some(first)
}

impl Product<Option<usize>> {
    /// The product multiplied out: for each of the terms the numbers of the unknowns in it, in order, and its factor. An entry
    /// that is `None` is the number 0.
    pub fn multiplied_out(self) -> impl Iterator<Item = (Vec<usize>, i32)> {
        let parts = |form: Form<Option<usize>>| -> Vec<(Option<usize>, i32)> {
            match form {
                Form::One => vec![(None, 1)],
                form => form.entries().filter(|part| part.0.is_some()).collect(),
            }
        };
        let right = parts(self.right);
        parts(self.left).into_iter().flat_map(move |(a, sign)| {
            let terms = right.clone().into_iter();
            terms.map(move |(b, other)| {
                let mut unknowns: Vec<usize> = [a, b].into_iter().flatten().collect();
                unknowns.sort_unstable();
                (unknowns, self.factor * sign * other)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (x − y)(y − 3) at x = 7, y = 5, and its derivatives: y − 3 by x, and x − y − (y − 3) by y.
    #[test]
    fn a_product_has_its_value_and_its_derivatives() {
        let at = |entry: char| match entry {
            'x' => 7.0,
            'y' => 5.0,
            _ => 3.0,
        };
        let product = Product::new(1, Form::Difference('x', 'y'), Form::Difference('y', '3'));
        assert_eq!(product.value(at), 4.0);
        let by = |entry: char| -> f64 {
            let all = product.derivatives(at).filter(|d| d.0 == entry);
            all.map(|(_, sign, slope)| f64::from(sign) * slope).sum()
        };
        assert_eq!([by('x'), by('y')], [2.0, 0.0]);
        assert_eq!(
            product.map(at).entries().collect::<Vec<_>>(),
            [7.0, 5.0, 5.0, 3.0]
        );
        assert_eq!(
            Product::new(1, Form::One, Form::Difference('x', 'x')).value(at),
            0.0
        );
    }

    /// With other signs of x₀ and x₁, which have those of no other.
    #[test]
    fn a_sum_is_reversed_left_or_neither() {
        let form = |a, b| Form::Difference(a, b);
        let (one, other) = (form(Some(0), Some(1)), form(Some(2), None));
        let of = |products: &[[Form<Option<usize>>; 2]]| {
            let products = products.iter();
            let products: Vec<_> = products.map(|&[l, r]| Product::new(1, l, r)).collect();
            sign(&products, |entry| entry.map(|i| i < 2))
        };
        assert_eq!(
            of(&[[one, other], [form(None, Some(1)), Form::One]]),
            Some(true)
        );
        assert_eq!(
            of(&[[one, one], [other, other], [Form::One, other]]),
            Some(false)
        );
        assert_eq!(of(&[[one, one], [one, other]]), None);
        assert_eq!(of(&[[form(Some(0), Some(2)), other]]), None);
        // What is nothing says nothing.
        let nothing = [[form(Some(2), Some(2)), one], [form(None, None), one]];
        assert_eq!(of(&nothing), Some(false));
        assert_eq!(of(&[nothing[0], [one, other], nothing[1]]), Some(true));
    }

    /// 2 (x₁ − x₀)(0 − x₀), and 3 · 1 · (x₁ − 0).
    #[test]
    fn a_product_is_multiplied_out() {
        let form = |a, b| Form::Difference(a, b);
        let out = |product: Product<Option<usize>>| product.multiplied_out().collect::<Vec<_>>();
        let squares = out(Product::new(2, form(Some(1), Some(0)), form(None, Some(0))));
        assert_eq!(squares, [(vec![0, 1], -2), (vec![0, 0], 2)]);
        let linear = out(Product::new(3, Form::One, form(Some(1), None)));
        assert_eq!(linear, [(vec![1], 3)]);
    }
}
