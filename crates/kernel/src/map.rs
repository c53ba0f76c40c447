//! Values by key, in one list.

use crate::order::InOrder as _;
use crate::rational::Rational;
use std::ops::AddAssign;

/// A value for each of some keys, in their order.
///
/// What [`BTreeMap`](std::collections::BTreeMap) is, with a tenth of the code for each type of key and value. A key that is
/// put in before others moves them, which takes time where there are thousands.
#[derive(Debug, Clone, PartialEq)]
pub struct Map<K, V>(Vec<(K, V)>);

impl<K, V> Default for Map<K, V> {
    fn default() -> Self {
        Map(Vec::new())
    }
}

impl<K: Ord, V> Map<K, V> {
    fn place(&self, key: &K) -> Result<usize, usize> {
        self.0.binary_search_by(|(other, _)| other.cmp(key))
    }

    /// The value of a key.
    pub fn get(&self, key: &K) -> Option<&V> {
        self.place(key).ok().map(|at| &self.0[at].1)
    }

    /// Whether a key has a value.
    pub fn contains_key(&self, key: &K) -> bool {
        self.place(key).is_ok()
    }

    /// The value of a key, which is this one if it has none.
    pub fn or_insert(&mut self, key: K, value: V) -> &mut V {
        let at = self.place(&key).unwrap_or_else(|at| {
            self.0.insert(at, (key, value));
            at
        });
        &mut self.0[at].1
    }

    /// Gives a key this value.
    pub fn insert(&mut self, key: K, value: V) {
        match self.place(&key) {
            Ok(at) => self.0[at].1 = value,
            Err(at) => self.0.insert(at, (key, value)),
        }
    }

    /// Takes a key and its value away.
    pub fn remove(&mut self, key: &K) -> Option<V> {
        self.place(key).ok().map(|at| self.0.remove(at).1)
    }

    /// Gives keys values.
    pub fn extend(&mut self, all: impl IntoIterator<Item = (K, V)>) {
        all.into_iter()
            .for_each(|(key, value)| self.insert(key, value));
    }
}

impl<K, V> Map<K, V> {
    /// Whether there is no key.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// How many keys there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Takes all keys away but those with values like this.
    pub fn retain(&mut self, is_kept: impl Fn(&V) -> bool) {
        self.0.retain(|(_, value)| is_kept(value));
    }

    /// All keys with their values.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (&K, &V)> + Clone {
        self.0.iter().map(|(key, value)| (key, value))
    }

    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &K> + Clone {
        self.0.iter().map(|(key, _)| key)
    }

    /// All values.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.0.iter_mut().map(|(_, value)| value)
    }
}

impl<K, V> IntoIterator for Map<K, V> {
    type Item = (K, V);
    type IntoIter = std::vec::IntoIter<(K, V)>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<K: Ord, V> FromIterator<(K, V)> for Map<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(all: I) -> Self {
        let mut out = Map::default();
        out.extend(all);
        out
    }
}

impl<K: Ord, S: AddAssign + Default + PartialEq> Map<K, S> {
    /// The sum of the numbers of each key, of those for which it is not zero.
    pub fn sums(all: impl IntoIterator<Item = (K, S)>) -> Self {
        let mut all: Vec<(K, S)> = all.into_iter().collect();
        all.order_by(|a, b| a.0.cmp(&b.0));
        let mut out: Vec<(K, S)> = Vec::new();
        for (key, number) in all {
            match out.last_mut() {
                Some((last, sum)) if *last == key => *sum += number,
                _ => out.push((key, number)),
            }
        }
        out.retain(|(_, sum)| *sum != S::default());
        Map(out)
    }
}

impl<K: Ord + Clone> Map<K, Rational> {
    /// Adds `by` times other sums.
    pub fn add(&mut self, by: &Rational, other: &Self) {
        let own = std::mem::take(self).into_iter();
        let others = other.iter().map(|(key, number)| (key.clone(), by * number));
        *self = Self::sums(own.chain(others));
    }
}

#[cfg(test)]
mod tests {
    use super::Map;
    use crate::rational::Rational;
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    proptest! {
        #[test]
        fn maps_are_those_of_the_standard_library(steps: Vec<(u8, u8, i8)>) {
            let (mut ours, mut theirs) = (Map::default(), BTreeMap::new());
            for (what, key, value) in steps {
                match what % 4 {
                    0 => prop_assert_eq!(ours.remove(&key), theirs.remove(&key)),
                    1 => {
                        let (one, other) = (ours.or_insert(key, 0), theirs.entry(key).or_insert(0));
                        (*one, *other) = (*one + 1, *other + 1);
                    }
                    _ => {
                        ours.insert(key, i32::from(value));
                        theirs.insert(key, i32::from(value));
                    }
                }
                prop_assert_eq!(ours.get(&key), theirs.get(&key));
                prop_assert_eq!(ours.len(), theirs.len());
            }
            let both = ours.iter().zip(&theirs);
            prop_assert!(both.into_iter().all(|(a, b)| a == b));
        }

        #[test]
        fn sums_are_those_of_each_key(terms: Vec<(u8, i8)>, other: Vec<(u8, i8)>) {
            let number = |x: i8| Rational::from(num_bigint::BigInt::from(x));
            let sums = |terms: &[(u8, i8)]| Map::sums(terms.iter().map(|&(key, x)| (key % 8, number(x))));
            let mut ours = sums(&terms);
            ours.add(&number(-2), &sums(&other));
            let mut theirs = [0i32; 8];
            terms.iter().for_each(|&(key, x)| theirs[usize::from(key % 8)] += i32::from(x));
            other.iter().for_each(|&(key, x)| theirs[usize::from(key % 8)] -= 2 * i32::from(x));
            for (key, sum) in theirs.into_iter().enumerate() {
                let found = ours.get(&(key as u8)).map(Rational::to_f64);
                prop_assert_eq!(found, (sum != 0).then_some(f64::from(sum)));
            }
        }
    }
}
