//! How many roundings numbers go through: the one place where the length of the longest equation, and what is enough for
//! distances, enter error bounds.
//!
//! Each count has a name, what is enough for distances, which are sums of up to three squares of differences, and what a longer
//! equation adds, as a function of the number of its products (for problems of distances alone that is zero). Callers
//! give what they know beside that (how many coefficients, blocks or key unknowns there are), and add nothing of their own.
//! An equation of another form than a sum of products of differences needs another look at every function here.

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

/// The counts for m equations in n = m + 1 unknowns, t last.
#[derive(Debug, Clone, Copy)]
pub struct Counts {
    m: usize,
    longer: Longer,
}

/// At a point.
impl Counts {
    /// A term of F: a difference is exact but for one rounding, which it has twice in a square; a sum over up to three axes; ten
    /// in Horner's rule for E of degree 4 with its coefficients; the last subtraction. In all fewer than 20. (In extended
    /// precision a difference is relatively exact, too, and the rest is the same.) A product of a longer equation has one more, by half a
    /// small whole number, in place of the square's halving.
    pub fn of_residual(self) -> usize {
        20 + self.longer.of_sum()
    }

    /// A bound, for distances, on what that may hide: the same squares and polynomials without signs, once more for the
    /// radii of E's coefficients, and the product with the bound on a rounding.
    pub fn of_residual_bound(self) -> usize {
        24 + self.longer.of_sum()
    }

    /// What the products of a longer equation add to that bound.
    pub fn of_product_bound(self) -> usize {
        24 + self.longer.of_bound()
    }

    /// The bound in extended precision: two for each step of Horner's rule for sizes and for radii, which are rounded to floats
    /// before (16), squares and their sum (8), and the product with the bound on a rounding.
    pub fn of_extended_bound(self) -> usize {
        40 + self.longer.of_sum()
    }

    /// A term of J v: a difference of unknowns, and one of v's, their product, a sum over up to three axes, E' by Horner's rule
    /// (12), its product with v's t, the last subtraction: fewer than 20.
    pub fn of_jacobian_times(self) -> usize {
        20 + self.longer.of_derivative()
    }

    /// A bound on what that may hide, with all that J may be near the point: sums of two products over up to three axes (12), E'
    /// and E'' with their radii (20), and five products and sums of these.
    pub fn of_jacobian_times_bound(self) -> usize {
        40 + self.longer.of_bound()
    }

    /// An entry of Y J at a solution, J's entries being one difference each, or E' (fewer than 12), in a sum over a
    /// column.
    pub fn of_entry_at_point(self) -> usize {
        self.m + 12 + self.longer.of_entry()
    }

    /// The bound on |I − Y [J; e_t]| there: a sum of n products, over one row sum of up to six differences, after
    /// another sum of n for the product that is compared with I.
    pub fn of_contraction_at_point(self) -> usize {
        2 * self.n() + 40 + self.longer.of_bound()
    }

    /// The bound on how that changes: a sum of n products, over up to six squares.
    pub fn of_width_at_point(self) -> usize {
        self.n() + 20 + self.longer.of_bound()
    }
}

/// At a fold, where the unknowns are X, t and a direction: 2 m + 1 in all, and as many equations.
impl Counts {
    fn at_fold(self) -> usize {
        2 * self.m + 1
    }

    /// An entry of Y Φ': as at a solution, with E'' too.
    pub fn of_entry_at_fold(self) -> usize {
        self.at_fold() + 40 + self.longer.of_entry()
    }

    /// The change of a row of Φ' in a box of size 1: up to three squares, and twice that.
    pub fn of_width_at_fold(self) -> usize {
        8 + self.longer.of_bound()
    }

    /// The bound on |I − Y Φ'|: as at a solution.
    pub fn of_contraction_at_fold(self) -> usize {
        2 * self.at_fold() + 60 + self.longer.of_bound()
    }
}

/// Along a tube, in the full space.
impl Counts {
    /// A term of a coefficient of F along a polynomial of this order: differences of coefficients (2), products of
    /// these, up to twice as many as there are coefficients, over up to three axes, powers of t(s) up to the fourth and E's
    /// coefficients: fewer than 200 up to order 5, with six coefficients (3 · 2 · 6 + 4 · 2 · 6 + 20).
    pub fn of_coefficient(self, order: usize) -> usize {
        debug_assert!(order <= 5);
        200 + self.longer.of_coefficient(order + 1)
    }

    /// An entry of Y J_k: differences, a sum over a column, and the powers of t(s), in all fewer than m + 120. An entry of a
    /// longer equation is a sum of at most twice as many terms as it has products.
    pub fn of_entry_along(self) -> usize {
        self.m + 120 + self.longer.of_entry()
    }

    /// The bound |Y g|_u of a right-hand side g that is a bound itself: g is a sum of at most 200 terms and factors for a
    /// distance (three axes at each order, E and its derivatives with their radii); then a sum of n products and a quotient.
    pub fn of_norm_along(self) -> usize {
        self.n() + 200 + self.longer.of_bound()
    }
}

/// Along a tube, in the reduced space.
impl Counts {
    /// A term of a coefficient of F along ẑ with so many coefficients: the differences and their sum over orders and axes
    /// (27), the powers of t(s) − t₀ (40), E and its derivatives (20), for up to nine coefficients.
    pub fn of_reduced_coefficient(self, coefficients: usize) -> usize {
        debug_assert!(coefficients <= 9);
        // One more than there are: a product is added to what is there.
        100 + self.longer.of_coefficient(coefficients + 1)
    }

    /// A term of F(z₀): differences, their squares and sum (7), E of degree 4 (10).
    pub fn of_reduced_residual(self) -> usize {
        20 + self.longer.of_derivative()
    }

    /// An entry of a row of a longer equation along ẑ, at any of so many orders: a form's coefficient, its size at all orders, and
    /// the parts of the entry.
    pub fn of_row_along(self, coefficients: usize) -> usize {
        2 * coefficients + self.longer.of_row()
    }

    /// An entry of J T along a tube: differences and the powers of t(s), sums over the normal or the distances of a point (m
    /// each, the latter at three orders), over A's rows at two orders and so many key unknowns at three. Also, twice, a sum over a
    /// row of A₀ X − I (`resolvent/listed.rs`): six entries for a distance, four for each product of a longer equation, of two
    /// parts each. That takes 2 · 4 + 2 roundings for each product, of the fourteen that there are for a row.
    pub fn of_reduced_entry(self, keys: usize) -> usize {
        4 * self.m + 4 * keys + 200 + self.longer.of_row()
    }

    /// What the key unknowns' rows and A's add to a bound, beside what the bound on A(s)⁻¹ goes through: the same sums, over
    /// one right-hand side.
    pub fn of_reduced_bound(self) -> usize {
        4 * self.m + 200 + self.longer.of_row()
    }

    /// A number in the bound on A(s)⁻¹, with so many blocks, so many equations in A and in its widest block: it goes through two
    /// sums over a row in every block, and in four more where the bound is put to use, each over at most all rows before, a
    /// block, and three axes' differences.
    pub fn of_inverse(self, blocks: usize, equations: usize, widest: usize) -> usize {
        let row = equations + widest + 10 + self.longer.of_row();
        (blocks + 4) * 2 * row + 200
    }
}

impl Counts {
    fn n(self) -> usize {
        self.m + 1
    }
}

impl Equations {
    /// How many roundings numbers go through, see there.
    pub fn roundings(&self) -> Counts {
        Counts {
            m: self.m,
            longer: Longer {
                products: self.tail.longest(),
            },
        }
    }
}

/// For tests that compare with exact numbers.
#[cfg(test)]
impl Counts {
    /// An entry of a row of a longer equation at a point.
    pub fn of_row_at_point(self) -> usize {
        8 + self.longer.of_row()
    }

    /// A bound on what that may hide.
    pub fn of_row_bound(self) -> usize {
        20 + self.longer.of_bound()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::{Path, PathBuf};

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

    /// By name: each count for so many equations and products, order 5 in the full space, 9 coefficients in the reduced one, 8 key
    /// unknowns, and 5 blocks with 40 equations, up to 3 in one.
    fn all(m: usize, products: usize) -> Vec<(&'static str, usize)> {
        let c = Counts {
            m,
            longer: Longer { products },
        };
        vec![
            ("of_residual", c.of_residual()),
            ("of_residual_bound", c.of_residual_bound()),
            ("of_product_bound", c.of_product_bound()),
            ("of_extended_bound", c.of_extended_bound()),
            ("of_jacobian_times", c.of_jacobian_times()),
            ("of_jacobian_times_bound", c.of_jacobian_times_bound()),
            ("of_entry_at_point", c.of_entry_at_point()),
            ("of_contraction_at_point", c.of_contraction_at_point()),
            ("of_width_at_point", c.of_width_at_point()),
            ("of_entry_at_fold", c.of_entry_at_fold()),
            ("of_width_at_fold", c.of_width_at_fold()),
            ("of_contraction_at_fold", c.of_contraction_at_fold()),
            ("of_coefficient", c.of_coefficient(5)),
            ("of_entry_along", c.of_entry_along()),
            ("of_norm_along", c.of_norm_along()),
            ("of_reduced_coefficient", c.of_reduced_coefficient(9)),
            ("of_reduced_residual", c.of_reduced_residual()),
            ("of_row_along", c.of_row_along(9)),
            ("of_reduced_entry", c.of_reduced_entry(8)),
            ("of_reduced_bound", c.of_reduced_bound()),
            ("of_inverse", c.of_inverse(5, 40, 3)),
        ]
    }

    /// Every count covers what is done with each product of a longer equation, and is what it always was for distances: their
    /// bounds, and so their tubes, stay as they are.
    #[test]
    fn every_count_grows_with_the_longest_equation() {
        // For distances, of m = 40 equations; and what a product adds beyond the third.
        let wanted = [
            ("of_residual", 20, 1),
            ("of_residual_bound", 24, 1),
            ("of_product_bound", 24, 4),
            ("of_extended_bound", 40, 1),
            ("of_jacobian_times", 20, 2),
            ("of_jacobian_times_bound", 40, 4),
            ("of_entry_at_point", 52, 2),
            ("of_contraction_at_point", 122, 4),
            ("of_width_at_point", 61, 4),
            ("of_entry_at_fold", 121, 2),
            ("of_width_at_fold", 8, 4),
            ("of_contraction_at_fold", 222, 4),
            ("of_coefficient", 200, 7),
            ("of_entry_along", 160, 2),
            ("of_norm_along", 241, 4),
            ("of_reduced_coefficient", 100, 11),
            ("of_reduced_residual", 20, 2),
            ("of_row_along", 18, 14),
            ("of_reduced_entry", 392, 14),
            ("of_reduced_bound", 360, 14),
            ("of_inverse", 18 * 53 + 200, 18 * 14),
        ];
        let distances = all(40, 0);
        assert_eq!(distances.len(), wanted.len());
        for (&(name, count), wanted) in distances.iter().zip(wanted) {
            assert_eq!((name, count), (wanted.0, wanted.1));
        }
        for products in [3, 4, 10, 1000] {
            let (fewer, more) = (all(40, products), all(40, products + 1));
            for ((fewer, more), wanted) in fewer.iter().zip(&more).zip(wanted) {
                assert_eq!(more.1 - fewer.1, wanted.2, "{}", wanted.0);
            }
        }
        // Which are all that there are.
        let text = std::fs::read_to_string("src/track/full/roundings.rs").unwrap();
        let text = text.split("#[cfg(test)]").next().unwrap();
        let public = text.matches("    pub fn of_").count();
        assert_eq!(public, wanted.len());
    }

    fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            match path.is_dir() {
                true => sources(&path, found),
                false => found.push(path),
            }
        }
    }

    /// Whoever looks at the longest equation for a count of his own has it counted in two places; and whoever adds a number to
    /// a count keeps a part of it that is not here.
    #[test]
    fn nothing_else_in_this_part_counts_for_itself() {
        let mut files = Vec::new();
        sources(Path::new("src/track"), &mut files);
        let mut offenders = Vec::new();
        for path in files
            .iter()
            .filter(|path| !path.ends_with("full/roundings.rs"))
        {
            let text = std::fs::read_to_string(path).unwrap();
            if text.contains(".longest()") {
                offenders.push(path.display().to_string());
            }
            for call in text.split(".roundings().of_").skip(1) {
                let end = call.find(')').unwrap();
                let given = &call[call.find('(').unwrap()..=end];
                let after = call[end + 1..].trim_start();
                if given.contains(|c: char| c.is_ascii_digit()) || after.starts_with(['+', '*']) {
                    offenders.push(format!("{}: {given}{}", path.display(), &after[..1]));
                }
            }
        }
        assert_eq!(offenders, Vec::<String>::new());
    }
}
