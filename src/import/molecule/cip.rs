//! The order in which the neighbours of a stereocentre rank, by rules 1a, 1b and 2 of Cahn, Ingold and Prelog (Prelog and Helmchen, Angew.
//! Chem. Int. Ed. 21, 1982; IUPAC, Nomenclature of Organic Chemistry, Recommendations 2013, P-92).
//!
//! The hierarchical digraph of a stereocentre, its root, has a node for each way from there along bonds that comes to no atom twice. A way
//! that would come to one again ends in a duplicate of it, and a bond of order n gives each of its ends n − 1 duplicates of the other, but
//! for bonds of the root itself (P-93.2). Duplicates have no substituents; phantoms of number 0 fill up what is lacking. Two branches are
//! compared sphere by sphere, in each sphere set by set in the order in which the sets' own nodes rank: first all of the digraph by atomic
//! number (rule 1a), then by how near to the root a duplicate's original is (1b), then by mass (2). An atom of a ring of alternating single
//! and double bonds has a duplicate with the mean of the numbers that it has in all ways to draw the ring.
//!
//! What the recommendations leave open, or where programs differ from them, is read both ways, and nothing is ranked where these ways
//! differ: whether a double bond of sulfur, phosphorus and the like away from the root gives duplicates; and whether rules 1b and 2 look at
//! the original of a duplicate where it comes of a double bond (as in the text) or not (Hanson and others, J. Chem. Inf. Model. 58, 2018).

use super::structure::Structure;

/// The neighbours of a stereocentre, the one of the highest rank first; `None` stands for what is not there, a hydrogen that is not in the
/// file or a pair of electrons. Or why they have no rank, in words that follow *as*.
pub type Ranked = Result<[Option<usize>; 4], &'static str>;

/// Larger digraphs are given up.
const MOST_NODES: usize = 10_000;
/// Most substituents of an atom, its own original on the way from the root not among them.
const WIDTH: usize = 6;
/// No atom is so far from the root.
const FAR: i32 = 1 << 20;
const OPEN: &str =
    "that depends on an atom whose hydrogens, charge or double bonds the file leaves open";

/// Ranks the neighbours of an atom, of which there are three or four.
pub fn ranked(of: &Structure, root: usize) -> Ranked {
    if !of.has_orders {
        return Err("the file has no bond orders");
    }
    if of.numbers.contains(&0) {
        return Err("not all atoms are of known elements");
    }
    let ways = [[false, false], [false, true], [true, false], [true, true]];
    let all = ways.map(|[skips_hypervalent, to_the_letter]| {
        let mut digraph = Digraph {
            of,
            root,
            skips_hypervalent,
            to_the_letter,
            depth: 0,
            nodes: 0,
            is_whole: false,
        };
        digraph.ranked()
    });
    for one in &all {
        (*one)?;
    }
    match all.iter().all(|one| *one == all[0]) {
        true => all[0],
        false => Err("the rules can be read in two ways there"),
    }
}

/// What a branch is compared by: for each rule the spheres, one after the other, with the property of each of its nodes in the order of
/// their rank. The spheres of a branch that was cut off are right up to where it was.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Rank([Vec<Vec<i32>>; 3]);

impl Rank {
    /// Of a node with all that is below it.
    fn new(own: [i32; 3], mut below: Vec<Rank>) -> Self {
        below.sort_unstable_by(|a, b| b.cmp(a));
        Rank(std::array::from_fn(|rule| {
            let mut spheres = vec![vec![own[rule]], vec![0; WIDTH]];
            for (k, branch) in below.iter().enumerate() {
                for (l, sphere) in branch.0[rule].iter().enumerate() {
                    match l {
                        0 => spheres[1][k] = sphere[0],
                        _ if l + 1 == spheres.len() => spheres.push(sphere.clone()),
                        _ => spheres[l + 1].extend(sphere),
                    }
                }
            }
            spheres
        }))
    }
}

/// The digraph of a root, down to some depth.
struct Digraph<'a> {
    of: &'a Structure<'a>,
    root: usize,
    /// Whether double bonds of hypervalent atoms give no duplicates.
    skips_hypervalent: bool,
    /// Whether rules 1b and 2 look at the originals of duplicates that come of double bonds.
    to_the_letter: bool,
    /// So many spheres are there, that of the neighbours of the root the first.
    depth: usize,
    nodes: usize,
    /// Whether nothing was cut off.
    is_whole: bool,
}

impl Digraph<'_> {
    /// Deeper and deeper, until atomic numbers decide or there is nothing more. Branches that are apart from all others stay as they are.
    fn ranked(&mut self) -> Ranked {
        let of = self.of;
        let nothing = || Rank::new([0; 3], Vec::new());
        let near = of.near[self.root].keys().map(|&b| (nothing(), Some(b)));
        let mut branches: Vec<(Rank, Option<usize>)> = near.collect();
        if branches.len() == 3 {
            let number = if of.hydrogens[self.root] > 0 { 6 } else { 0 };
            branches.push((Rank::new([number, 0, 0], Vec::new()), None));
        }
        let mut is_tied = vec![true; branches.len()];
        loop {
            (self.depth, self.nodes, self.is_whole) = (self.depth + 1, 0, true);
            for (k, (rank, begin)) in branches.iter_mut().enumerate() {
                if let (true, Some(begin)) = (is_tied[k], *begin) {
                    *rank = self.branch(&mut vec![self.root], begin)?;
                }
            }
            branches.sort_unstable_by(|a, b| b.0.cmp(&a.0));
            let numbers = |k: usize| branches[k].0.0[0].iter().take(self.depth);
            let is_as_next = |k: usize| k + 1 < branches.len() && numbers(k).eq(numbers(k + 1));
            let ties = (0..branches.len()).map(|k| is_as_next(k) || k > 0 && is_as_next(k - 1));
            is_tied = ties.collect();
            let differ = || branches.windows(2).all(|two| two[0].0 != two[1].0);
            if !is_tied.contains(&true) || self.is_whole && differ() {
                let order: Vec<Option<usize>> = branches.into_iter().map(|one| one.1).collect();
                return order.try_into().map_err(|_| OPEN);
            }
            if self.is_whole {
                return Err("rules 1a, 1b and 2 do not decide");
            }
        }
    }

    /// The branch that begins with an atom, where a way from the root has come to it.
    fn branch(&mut self, way: &mut Vec<usize>, at: usize) -> Result<Rank, &'static str> {
        let of = self.of;
        self.nodes += 1;
        if self.nodes > MOST_NODES {
            return Err("its digraph is too large");
        }
        let own = [of.numbers[at], 0, of.details[at].isotope];
        // Of the root's neighbours the way is of one atom.
        if way.len() == self.depth {
            self.is_whole = false;
            return Ok(Rank(own.map(|x| vec![vec![x]])));
        }
        let duplicates = of.duplicates[at].as_ref().ok_or(OPEN)?;
        let from = way.last().copied();
        way.push(at);
        let mut below = Vec::new();
        for &b in of.near[at].keys().filter(|&&b| Some(b) != from) {
            let rank = match way.iter().position(|&a| a == b) {
                Some(k) => self.duplicate(of.numbers[b], FAR - k as i32, Some(b)),
                None => self.branch(way, b)?,
            };
            below.push(rank);
        }
        for one in duplicates {
            let is_skipped = |b| b == self.root || self.skips_hypervalent && of.is_hypervalent(b);
            if one.of.is_some_and(is_skipped) || self.skips_hypervalent && of.is_hypervalent(at) {
                continue;
            }
            let far = |b| way.iter().position(|&a| a == b).unwrap_or(way.len());
            let near = one.of.filter(|_| self.to_the_letter);
            let near = near.map_or(0, |b| FAR - far(b) as i32);
            below.push(self.duplicate(one.number, near, one.of));
        }
        below.extend((0..of.hydrogens[at]).map(|_| Rank::new([6, 0, 0], Vec::new())));
        way.pop();
        match below.len() <= WIDTH {
            true => Ok(Rank::new(own, below)),
            false => Err(OPEN),
        }
    }

    fn duplicate(&self, number: i32, near: i32, of: Option<usize>) -> Rank {
        let isotope = of.map_or(0, |b| self.of.details[b].isotope);
        let isotope = if self.to_the_letter { isotope } else { 0 };
        Rank::new([number, near, isotope], Vec::new())
    }
}

#[cfg(test)]
mod tests {
    use super::super::structure::Detail;
    use super::*;

    /// Ranks the neighbours of the first atom; bonds are single where no order is given.
    fn first(elements: &[&str], bonds: &[[usize; 2]], orders: &[u8], isotopes: &[i32]) -> Ranked {
        let detail = |&isotope: &i32| Detail {
            isotope,
            is_odd: false,
        };
        let details: Vec<Detail> = isotopes.iter().map(detail).collect();
        let mut all = vec![1; bonds.len()];
        all[..orders.len()].copy_from_slice(orders);
        ranked(&Structure::new(elements, bonds, &all, &details), 0)
    }

    /// 1-(pyridin-2-yl)-1-(pyrimidin-2-yl)ethane, and with the double bonds the other way round: N, C and the mean of both at one ring, N,
    /// N and N at the other one. Aromatic bonds leave the mean open.
    #[test]
    fn it_plays_no_part_how_a_ring_is_drawn() {
        let elements = "C C C N C C C C C N C C C N".split(' ').collect::<Vec<_>>();
        let rings = [
            [2, 3],
            [3, 4],
            [4, 5],
            [5, 6],
            [6, 7],
            [7, 2],
            [8, 9],
            [9, 10],
            [10, 11],
            [11, 12],
            [12, 13],
            [13, 8],
        ];
        let bonds = [&rings[..], &[[0, 1], [0, 2], [0, 8]]].concat();
        let wanted = [Some(8), Some(2), Some(1), None];
        for ways in 0..4 {
            let order = |k: usize| {
                if (k + (ways >> (k / 6))).is_multiple_of(2) {
                    2
                } else {
                    1
                }
            };
            let orders: Vec<u8> = (0..12).map(order).collect();
            assert_eq!(first(&elements, &bonds, &orders, &[]), Ok(wanted));
        }
        assert_eq!(first(&elements, &bonds, &[4; 12], &[]), Err(OPEN));
    }

    /// (S)-bicyclo[2.2.2]oct-1-yl[tris(2-cyclopropylethyl)methyl]methanol, an example of P-92.2.2: all numbers are the same, but rings are
    /// closed nearer to the centre in the bicycle.
    #[test]
    fn the_nearer_original_of_a_duplicate_ranks_higher() {
        let mut elements = vec!["C"; 25];
        elements[1] = "O";
        // The quaternary atoms 2 and 3, three arms of the first from 4, 9, 14 on, three bridges of the second from 19 on to 25.
        elements.push("C");
        let mut bonds = vec![[0, 1], [0, 2], [0, 3]];
        for k in 0..3 {
            let (arm, bridge) = (4 + 5 * k, 19 + 2 * k);
            let ring = [[1, 2], [2, 3], [3, 4], [4, 2], [0, 1]].map(|ends| ends.map(|a| arm + a));
            bonds.extend(ring);
            bonds.extend([
                [2, arm],
                [3, bridge],
                [bridge, bridge + 1],
                [bridge + 1, 25],
            ]);
        }
        let wanted = [Some(1), Some(3), Some(2), None];
        assert_eq!(first(&elements, &bonds, &[], &[]), Ok(wanted));
    }

    #[test]
    fn masses_count_last() {
        // Two methyl groups on each of two neighbours, one of them of carbon-13.
        let elements = "C C C C C C C O".split(' ').collect::<Vec<_>>();
        let bonds = [[0, 1], [0, 2], [1, 3], [1, 4], [2, 5], [2, 6], [0, 7]];
        let of = |isotopes: &[i32]| first(&elements, &bonds, &[], isotopes);
        let heavier_first = |b: usize| Ok([Some(7), Some(b), Some(3 - b), None]);
        assert_eq!(of(&[]), Err("rules 1a, 1b and 2 do not decide"));
        assert_eq!(of(&[0, 0, 0, 1]), heavier_first(1));
        assert_eq!(of(&[0, 0, 0, 1, 0, 2]), heavier_first(2));
        assert_eq!(of(&[0, 0, 0, -1]), heavier_first(2));
    }

    /// A sulfoxide beside a sulfenic ester of the same atoms: whether S=O is one bond or two decides.
    #[test]
    fn what_is_read_in_two_ways_has_no_rank() {
        let elements = "C C S O C S O C".split(' ').collect::<Vec<_>>();
        let bonds = [[2, 3], [0, 1], [0, 2], [2, 4], [0, 5], [5, 6], [5, 7]];
        let found = first(&elements, &bonds, &[2], &[]);
        assert_eq!(found, Err("the rules can be read in two ways there"));
    }

    /// Two nets of rings that differ far away.
    #[test]
    fn large_digraphs_are_given_up() {
        const SIDE: usize = 7;
        let at = |net: usize, x: usize, y: usize| 2 + SIDE * (SIDE * net + x) + y;
        let mut bonds = vec![[0, 1], [0, at(0, 0, 0)], [0, at(1, 0, 0)]];
        for net in 0..2 {
            for x in 0..SIDE {
                for y in 1..SIDE {
                    bonds.push([at(net, x, y - 1), at(net, x, y)]);
                    bonds.push([at(net, y - 1, x), at(net, y, x)]);
                }
            }
        }
        let mut elements = vec!["C"; 2 + 2 * SIDE * SIDE];
        elements[1] = "F";
        elements[at(1, SIDE - 1, SIDE - 1)] = "N";
        let found = first(&elements, &bonds, &[], &[]);
        assert_eq!(found, Err("its digraph is too large"));
        // Near by it is soon found.
        elements[at(0, 1, 1)] = "N";
        let wanted = [Some(1), Some(at(0, 0, 0)), Some(at(1, 0, 0)), None];
        assert_eq!(first(&elements, &bonds, &[], &[]), Ok(wanted));
    }
}
