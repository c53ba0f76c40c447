//! How many roundings there are more than for distances: the one place where the length of the longest equation
//! enters error bounds.
//!
//! Bounds are counted for distances, which are sums of up to three squares of differences, and say so where
//! they stand. What a longer equation adds to each kind of count is here, as a function of the number of its
//! products; for problems of distances all of it is zero.

use super::equations::Equations;

/// What equations of so many products add.
#[derive(Debug, Clone, Copy)]
struct Longer {
    products: usize,
}

impl Longer {
    /// To a term of F at a point: an addition for each product beyond the three of a distance.
    const fn of_sum(self) -> usize {
        self.products.saturating_sub(3)
    }

    /// To a term of J v: besides, either factor of each product has its turn.
    const fn of_derivative(self) -> usize {
        self.of_sum() + self.products
    }

    /// To a term of a coefficient of F along a polynomial with so many coefficients: each product is a sum of
    /// products of orders.
    const fn of_coefficient(self, coefficients: usize) -> usize {
        self.of_sum() + coefficients * self.products
    }

    /// To an entry of the Jacobian: a sum of at most two forms with factors for each product.
    const fn of_entry(self) -> usize {
        2 * self.products
    }

    /// To a sum over a row of the Jacobian, at three orders, and to its entries: each product has two differences
    /// of two unknowns, so that a row has at most four entries for each product, of at most two parts each.
    const fn of_row(self) -> usize {
        (3 * 4 + 2) * self.products
    }

    /// To a bound, without signs, that adds up what all products of an equation have: four roundings each, for
    /// their absolute values, sums of two, and factors.
    const fn of_bound(self) -> usize {
        4 * self.products
    }
}

impl<const D: usize> Equations<D> {
    fn longer(&self) -> Longer {
        Longer {
            products: self.tail.longest(),
        }
    }

    /// How many roundings any one term of F at a point passes through, `base` being enough for distances.
    pub fn roundings(&self, base: usize) -> usize {
        base + self.longer().of_sum()
    }

    /// How many roundings a term of J v passes through, `base` being enough for distances.
    pub fn roundings_of_derivative(&self, base: usize) -> usize {
        base + self.longer().of_derivative()
    }

    /// How many roundings a term of a coefficient of F along a polynomial with so many coefficients passes
    /// through, `base` being enough for distances.
    pub fn roundings_of_coefficient(&self, base: usize, coefficients: usize) -> usize {
        base + self.longer().of_coefficient(coefficients)
    }

    /// How many roundings an entry of the Jacobian passes through, `base` being enough for distances.
    pub fn roundings_of_entry(&self, base: usize) -> usize {
        base + self.longer().of_entry()
    }

    /// How many roundings a sum over a row of the Jacobian, at up to three orders, and its entries pass through,
    /// `base` being enough for distances.
    pub fn roundings_of_row(&self, base: usize) -> usize {
        base + self.longer().of_row()
    }

    /// How many roundings a bound that adds up, without signs, what all products of an equation have passes
    /// through, `base` being enough for distances.
    pub fn roundings_of_bound(&self, base: usize) -> usize {
        base + self.longer().of_bound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    #[test]
    fn distances_add_nothing_and_each_product_what_is_done_with_it() {
        let none = Longer { products: 0 };
        let counts = |l: Longer| {
            [
                l.of_sum(),
                l.of_derivative(),
                l.of_coefficient(6),
                l.of_entry(),
                l.of_row(),
                l.of_bound(),
            ]
        };
        assert_eq!(counts(none), [0; 6]);
        // One addition; two; one for each pair of orders; two forms; entries and their parts.
        for products in [4, 10, 1000] {
            let [fewer, more] =
                [products, products + 1].map(|products| counts(Longer { products }));
            let added: Vec<usize> = more.iter().zip(fewer).map(|(m, f)| m - f).collect();
            assert_eq!(added, [1, 2, 7, 2, 14, 4]);
        }
    }

    /// Whoever looks at the longest equation for a count of his own has it counted in two places.
    #[test]
    fn nothing_else_in_this_part_asks_how_long_equations_are() {
        fn visit(folder: &Path, offenders: &mut Vec<String>) {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    visit(&path, offenders);
                } else if !path.ends_with("full/roundings.rs")
                    && std::fs::read_to_string(&path)
                        .unwrap()
                        .contains(".longest()")
                {
                    offenders.push(path.display().to_string());
                }
            }
        }
        let mut offenders = Vec::new();
        visit(Path::new("src/track"), &mut offenders);
        assert_eq!(offenders, Vec::<String>::new());
    }
}
