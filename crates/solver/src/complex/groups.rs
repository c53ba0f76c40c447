//! Groups of unknowns in which equations have low degrees, and how many isolated zeros there are then at most.
//!
//! Let n equations in n unknowns, which are cut into groups of k_j unknowns each, have degree at most d_ij in the unknowns of group
//! j. They have at most as many isolated zeros, each with its multiplicity, as the coefficient of Π_j X_jᵏʲ in Π_i Σ_j d_ij X_j says: the
//! multi-homogeneous Bézout number. With one group it is the product of the degrees; for A x = λ x it is the size of A with the group
//! of λ and that of x (Morgan, Sommese, *A homotopy for solving general polynomial systems that respects m-homogeneous
//! structures*, 1987; Wampler, *Bezout number calculations for multi-homogeneous polynomial systems*, 1992).

use std::collections::HashMap;

/// So few unknowns are cut into groups in all ways; of more one at a time goes to another group, as long as that makes the number less.
const FEW: usize = 7;
/// More are one group: to look for others would take long.
const MANY: usize = 64;
/// A way to cut them is passed over where more coefficients than this would have to be known at a time.
const MOST: usize = 1 << 10;

/// Groups of unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Groups {
    /// The group of each unknown.
    pub of: Vec<usize>,
    /// Of each equation the degree in each group.
    pub degrees: Vec<Vec<usize>>,
    /// The multi-homogeneous Bézout number.
    pub count: u128,
}

impl Groups {
    /// The groups with the least number that is found; where some have the same, the fewest. `degrees`: of each equation the degree in the
    /// unknowns that are marked. `None`: the equations are not as many as the unknowns, or no number is greater than 0 and small enough to
    /// be told.
    pub fn least(n: usize, degrees: impl Fn(&[bool]) -> Vec<usize>) -> Option<Self> {
        let new = |of| Groups::new(of, &degrees);
        if n == 0 || n > MANY {
            return new(vec![0; n]);
        }
        let mut best = new(vec![0; n]);
        let is_less = |new: &Groups, best: &Option<Groups>| {
            best.as_ref().is_none_or(|best| new.count < best.count)
        };
        if n <= FEW {
            let mut cuts: Vec<Vec<usize>> = vec![vec![]];
            for _ in 0..n {
                let longer = cuts
                    .iter()
                    .flat_map(|of| (0..=after(of)).map(|group| [&of[..], &[group]].concat()));
                cuts = longer.collect();
            }
            cuts.sort_by_key(|of| after(of));
            for groups in cuts.into_iter().filter_map(new) {
                if is_less(&groups, &best) {
                    best = Some(groups);
                }
            }
            return best;
        }
        loop {
            let of = best.as_ref()?.of.clone();
            let moves = (0..n).flat_map(|u| (0..=after(&of)).map(move |group| (u, group)));
            let moved = moves.filter_map(|(u, group)| {
                let mut of = of.clone();
                of[u] = group;
                new(of)
            });
            let least = moved.min_by_key(|groups| groups.count)?;
            if !is_less(&least, &best) {
                return best;
            }
            best = Some(least);
        }
    }

    /// Of each equation one of its factors in one group, for each group as many as it has unknowns: all ways to choose them.
    pub fn chosen<T: Copy>(&self, factors: impl Fn(usize, usize) -> Vec<T>) -> Vec<Vec<T>> {
        let mut all: Vec<(Vec<usize>, Vec<T>)> = vec![(sizes(&self.of), vec![])];
        for e in 0..self.degrees.len() {
            // Whether the equations that come later can be chosen so that nothing of these is left.
            let mut can: HashMap<Vec<usize>, bool> = HashMap::new();
            let mut longer = Vec::new();
            for (left, chosen) in &all {
                for group in (0..left.len()).filter(|&group| left[group] > 0) {
                    let mut left = left.clone();
                    left[group] -= 1;
                    let later = || coefficient(&self.degrees[e + 1..], &left) != Some(0);
                    if *can.entry(left.clone()).or_insert_with(later) {
                        let own = factors(e, group).into_iter();
                        longer.extend(own.map(|f| (left.clone(), [&chosen[..], &[f]].concat())));
                    }
                }
            }
            all = longer;
        }
        all.into_iter().map(|(_, chosen)| chosen).collect()
    }

    fn new(mut of: Vec<usize>, degrees: impl Fn(&[bool]) -> Vec<usize>) -> Option<Self> {
        // A group may have been left by its last unknown.
        let mut used = of.clone();
        used.sort_unstable();
        used.dedup();
        of.iter_mut()
            .for_each(|group| *group = used.partition_point(|other| other < group));
        let sizes = sizes(&of);
        let in_group = |group| {
            let marked: Vec<bool> = of.iter().map(|&other| other == group).collect();
            degrees(&marked)
        };
        let columns: Vec<Vec<usize>> = (0..sizes.len()).map(in_group).collect();
        let equations = columns.first().map_or_else(|| degrees(&[]).len(), Vec::len);
        let row = |e: usize| columns.iter().map(|column| column[e]).collect();
        let degrees: Vec<Vec<usize>> = (0..equations).map(row).collect();
        let count = coefficient(&degrees, &sizes).filter(|&count| count > 0)?;
        Some(Groups { of, degrees, count })
    }
}

/// How many groups there are: the number of the next one.
fn after(of: &[usize]) -> usize {
    of.iter().max().map_or(0, |last| last + 1)
}

/// How many unknowns each group has.
fn sizes(of: &[usize]) -> Vec<usize> {
    let mut sizes = vec![0; after(of)];
    of.iter().for_each(|&group| sizes[group] += 1);
    sizes
}

/// The coefficient of Π_j X_j^(sizes j) in Π_i Σ_j degrees_ij X_j. `None`: it is beyond all numbers, or too much work.
fn coefficient(degrees: &[Vec<usize>], sizes: &[usize]) -> Option<u128> {
    if sizes.iter().sum::<usize>() != degrees.len() {
        return Some(0);
    }
    let all = sizes.iter().try_fold(1usize, |all, size| {
        Some(all * (size + 1)).filter(|&all| all <= MOST)
    })?;
    // The coefficient of each product of X_j with exponents up to the sizes, the first group's exponent counting by 1, in the product of as
    // many equations as the exponents add up to.
    let mut coefficients = vec![0u128; all];
    coefficients[0] = 1;
    let mut exponents = vec![0; sizes.len()];
    for place in 1..all {
        let full = (0..)
            .take_while(|&group| exponents[group] == sizes[group])
            .count();
        exponents[..full].fill(0);
        exponents[full] += 1;
        let row = &degrees[exponents.iter().sum::<usize>() - 1];
        let mut step = 1;
        for ((&exponent, &degree), size) in exponents.iter().zip(row).zip(sizes) {
            if exponent > 0 {
                let more = coefficients[place - step].checked_mul(degree as u128)?;
                coefficients[place] = coefficients[place].checked_add(more)?;
            }
            step *= size + 1;
        }
    }
    coefficients.last().copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Monomials of each equation, as the unknowns that are multiplied.
    fn of(n: usize, equations: &[&[&[usize]]]) -> Groups {
        let degrees = |marked: &[bool]| {
            let of = |monomial: &&[usize]| monomial.iter().filter(|u| marked[**u]).count();
            let all = equations.iter();
            all.map(|monomials| monomials.iter().map(of).max().unwrap())
                .collect()
        };
        Groups::least(n, degrees).unwrap()
    }

    #[test]
    fn eigenvalues_are_as_many_as_the_matrix_has_rows() {
        for n in [3usize, 9] {
            let row: Vec<Vec<usize>> = (0..n).flat_map(|x| [vec![x], vec![x, n]]).collect();
            let row: Vec<&[usize]> = row.iter().map(|m| &m[..]).collect();
            let linear: Vec<Vec<usize>> = (0..n).map(|x| vec![x]).collect();
            let linear: Vec<&[usize]> = linear.iter().map(|m| &m[..]).collect();
            let mut equations = vec![&row[..]; n];
            equations.push(&linear);
            let groups = of(n + 1, &equations);
            assert_eq!(groups.count, n as u128);
            assert!(groups.of[..n].iter().all(|group| *group != groups.of[n]));
        }
    }

    #[test]
    fn groups_that_are_left_are_none() {
        // x_i x_{i+1} + x_{i+7} = 1, each unknown in three equations.
        let n = 20;
        let monomials: Vec<[Vec<usize>; 2]> = (0..n)
            .map(|i| [vec![i, (i + 1) % n], vec![(i + 7) % n]])
            .collect();
        let equations: Vec<Vec<&[usize]>> = monomials
            .iter()
            .map(|two| two.iter().map(|one| &one[..]).collect())
            .collect();
        let equations: Vec<&[&[usize]]> = equations.iter().map(|one| &one[..]).collect();
        let groups = of(n, &equations);
        assert!((0..after(&groups.of)).all(|group| groups.of.contains(&group)));
    }

    #[test]
    fn what_tells_all_unknowns_has_one_solution() {
        let groups = Groups::least(0, |_| Vec::new()).unwrap();
        assert_eq!(groups.count, 1);
        assert!(Groups::least(0, |_| vec![0]).is_none());
    }

    #[test]
    fn one_group_where_more_are_no_help() {
        let dense: &[&[usize]] = &[&[0, 0], &[0, 1], &[1, 1]];
        let groups = of(2, &[dense, dense]);
        assert_eq!((groups.count, &groups.of[..]), (4, &[0, 0][..]));
        let bilinear: &[&[usize]] = &[&[0, 1], &[0], &[1]];
        assert_eq!(of(2, &[bilinear, bilinear]).count, 2);
    }
}
