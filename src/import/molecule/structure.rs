//! What atoms are and how they are bonded, as far as a file tells: by that stereocentres are found and get their letters.

use super::{ELEMENTS, element};
use std::collections::BTreeMap;

/// What a molfile tells of an atom beside its element and its place.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Detail {
    /// By how much its mass number is above the atomic weight of its element, rounded; 0: it is no isotope of its own.
    pub isotope: i32,
    /// Whether it has a charge, a number of unpaired electrons or a valence of its own, of which no more is read.
    pub is_odd: bool,
}

/// An atom that stands for another one once more, where a bond is a multiple one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Duplicate {
    /// Its atomic number, see [`Structure::numbers`].
    pub number: i32,
    /// Which atom it stands for, where there is one such.
    pub of: Option<usize>,
}

/// The atoms of a molecule with all that is told of them.
pub struct Structure<'a> {
    pub elements: Vec<&'a str>,
    /// Atomic numbers times 6, so that the mean of two or three is a whole number; 0: what is no element.
    pub numbers: Vec<i32>,
    pub details: Vec<Detail>,
    /// For each atom those that are bonded to it, with the order of the bond: 4 of an aromatic one, 0 where it is not known.
    pub near: Vec<BTreeMap<usize, u8>>,
    /// Whether orders of bonds are told.
    pub has_orders: bool,
    /// For each atom how many hydrogens it has that are not in the file.
    pub hydrogens: Vec<usize>,
    /// For each atom the duplicates that multiple bonds give it; `None`: the file leaves its hydrogens or its double bonds open.
    pub duplicates: Vec<Option<Vec<Duplicate>>>,
}

/// Rings of alternating single and double bonds have at most so many double bonds.
const LARGEST_RING: usize = 15;

impl<'a> Structure<'a> {
    /// The order of each bond, or none where they are not told; details of the first atoms, of all others there are none.
    pub fn new(
        symbols: &[&'a str],
        bonds: &[[usize; 2]],
        orders: &[u8],
        details: &[Detail],
    ) -> Self {
        let n = symbols.len();
        let elements: Vec<&str> = symbols.iter().map(|symbol| element(symbol)).collect();
        let number = |symbol: &&str| {
            let mut known = ELEMENTS.split_whitespace();
            let place = known.position(|known| known.eq_ignore_ascii_case(symbol));
            place.map_or(0, |k| 6 * (k as i32 + 1))
        };
        let mut near = vec![BTreeMap::new(); n];
        for (k, &[a, b]) in bonds.iter().enumerate() {
            let order = orders.get(k).copied().unwrap_or(0);
            near[a].insert(b, order);
            near[b].insert(a, order);
        }
        let mut all = Structure {
            numbers: elements.iter().map(number).collect(),
            elements,
            details: details.to_vec(),
            near,
            has_orders: !orders.is_empty(),
            hydrogens: Vec::new(),
            duplicates: Vec::new(),
        };
        all.details.resize(n, Detail::default());
        for (detail, symbol) in all.details.iter_mut().zip(symbols) {
            // Deuterium and tritium by their own symbols.
            let heavy = ["D", "T"].iter().position(|own| {
                let letters = symbol.trim_end_matches(|c: char| c.is_ascii_digit());
                letters.eq_ignore_ascii_case(own)
            });
            if let (0, Some(k)) = (detail.isotope, heavy) {
                detail.isotope = k as i32 + 1;
            }
        }
        let partners = all.partners();
        all.hydrogens = (0..n).map(|a| all.hydrogens_left_out(a)).collect();
        all.duplicates = (0..n).map(|a| all.duplicates_at(a, &partners)).collect();
        all
    }

    /// How many bonds an atom of carbon has beyond one to each neighbour: the same however the double bonds of an aromatic ring are drawn.
    /// 0 of other elements, at whose bonds charges and hydrogens go to and fro.
    pub fn excess(&self, a: usize) -> u8 {
        let orders = self.near[a].values();
        let is_aromatic = u8::from(orders.clone().any(|&order| order == 4));
        match self.elements[a] {
            "C" => is_aromatic.max(orders.filter(|o| (2..4).contains(*o)).map(|o| o - 1).sum()),
            _ => 0,
        }
    }

    /// Whether an atom below the second period has more bonds than its lowest valence, as the sulfur of a sulfoxide.
    pub fn is_hypervalent(&self, a: usize) -> bool {
        self.numbers[a] > 60
            && self
                .lowest_valence(a)
                .is_some_and(|v| self.order_sum(a) > v)
    }

    fn lowest_valence(&self, a: usize) -> Option<usize> {
        match self.numbers[a] / 6 {
            1 => Some(1),
            5 => Some(3),
            number => [10, 18, 36, 54].iter().find_map(|noble| {
                let lacking = usize::try_from(noble - number).ok()?;
                (1..=4).contains(&lacking).then_some(lacking)
            }),
        }
    }

    /// How many bonds an atom has, double ones counted twice; three for the two aromatic ones of a ring.
    fn order_sum(&self, a: usize) -> usize {
        let orders = self.near[a].values();
        let is_aromatic = usize::from(orders.clone().any(|&order| order == 4));
        let count = |order: &u8| if *order == 4 { 1 } else { usize::from(*order) };
        orders.map(count).sum::<usize>() + is_aromatic
    }

    fn hydrogens_left_out(&self, a: usize) -> usize {
        let (sum, Some(lowest)) = (self.order_sum(a), self.lowest_valence(a)) else {
            return 0;
        };
        let mut valence = lowest;
        while valence < sum && self.numbers[a] > 60 && valence + lowest < 8 {
            valence += 2;
        }
        match self.details[a].is_odd {
            true => 0,
            false => valence.saturating_sub(sum),
        }
    }

    /// For each atom with one double bond, and no other multiple one, where that goes.
    fn partners(&self) -> Vec<Option<usize>> {
        let only = |a: usize| {
            let mut all = self.near[a].iter().filter(|(_, order)| **order > 1);
            let (&b, order) = all.next()?;
            (*order == 2 && all.next().is_none() && !self.is_hypervalent(a)).then_some(b)
        };
        let both = |a: usize| only(a).filter(|&b| only(b) == Some(a));
        (0..self.near.len()).map(both).collect()
    }

    fn duplicates_at(&self, a: usize, partners: &[Option<usize>]) -> Option<Vec<Duplicate>> {
        let orders = || self.near[a].values().copied();
        let (is_aromatic, is_single) = (orders().any(|o| o == 4), orders().all(|o| o == 1));
        let is_vague = self.details[a].is_odd && !(is_single && orders().count() > 3);
        if is_vague || orders().any(|o| !(1..5).contains(&o)) || self.lowest_valence(a).is_none() {
            return None;
        }
        if is_aromatic {
            // Whichever of its bonds the double one is, it goes to carbon.
            let is_plain =
                |(&b, order): (&usize, &u8)| *order == 1 || *order == 4 && self.elements[b] == "C";
            let is_one = self.elements[a] == "C" && self.near[a].iter().all(is_plain);
            return is_one.then(|| {
                vec![Duplicate {
                    number: 36,
                    of: None,
                }]
            });
        }
        if let Some(partner) = partners[a] {
            let ends = self.near[a].keys().copied();
            let ends = ends.filter(|&b| b == partner || self.may_be_double([a, b], partners));
            let numbers: Vec<i32> = ends.map(|b| self.numbers[b]).collect();
            return Some(vec![Duplicate {
                number: numbers.iter().sum::<i32>() / numbers.len() as i32,
                of: (numbers.len() == 1).then_some(partner),
            }]);
        }
        let times = |(&b, &order): (&usize, &u8)| {
            let one = Duplicate {
                number: self.numbers[b],
                of: Some(b),
            };
            std::iter::repeat_n(one, usize::from(order) - 1)
        };
        Some(self.near[a].iter().flat_map(times).collect())
    }

    /// Whether a single bond is in a ring of alternating single and double bonds, so that it is double where the ring is drawn the other
    /// way (a Kekulé form).
    fn may_be_double(&self, [a, b]: [usize; 2], partners: &[Option<usize>]) -> bool {
        partners[a].is_some_and(|goal| {
            self.near[a][&b] == 1 && self.alternates(b, goal, partners, &mut vec![a, goal])
        })
    }

    /// Whether a way from an atom along its double bond, a single one, and so on, comes to another atom by a single one.
    fn alternates(
        &self,
        from: usize,
        goal: usize,
        partners: &[Option<usize>],
        seen: &mut Vec<usize>,
    ) -> bool {
        let Some(far) = partners[from].filter(|_| seen.len() < 2 * LARGEST_RING) else {
            return false;
        };
        seen.extend([from, far]);
        let found = self.near[far].iter().any(|(&next, &order)| {
            let is_new = || !seen.contains(&next);
            order == 1 && (next == goal || is_new() && self.alternates(next, goal, partners, seen))
        });
        seen.truncate(seen.len() - 2);
        found
    }
}
