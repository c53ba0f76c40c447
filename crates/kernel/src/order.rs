//! Sorting by places.

use std::cmp::Ordering;

/// What [`slice::sort_by`] and [`slice::sort_by_key`] do, for lists whose sorting takes no time to speak of: it is their
/// places that are sorted, so that the code for it is built once and not for every type and order.
pub trait InOrder<T> {
    /// Sorts; what is equal keeps its order.
    fn order_by(&mut self, order: impl Fn(&T, &T) -> Ordering);

    /// Sorts by a key; what is equal keeps its order.
    fn order_by_key<K: Ord>(&mut self, key: impl Fn(&T) -> K) {
        self.order_by(|a, b| key(a).cmp(&key(b)));
    }
}

impl<T> InOrder<T> for [T] {
    fn order_by(&mut self, order: impl Fn(&T, &T) -> Ordering) {
        let mut places = sorted(self.len(), &|a, b| order(&self[a], &self[b]));
        for to in 0..self.len() {
            // What stood there, before those that are in their place by now were exchanged.
            let mut from = places[to];
            while from < to {
                from = places[from];
            }
            places[to] = from;
            self.swap(to, from);
        }
    }
}

/// All of some values in order, each once.
pub fn each_once<T: Ord>(all: impl IntoIterator<Item = T>) -> Vec<T> {
    let mut all: Vec<T> = all.into_iter().collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Adds a value to a list, unless it has it.
pub fn add_new<T: PartialEq>(to: &mut Vec<T>, value: T) {
    if !to.contains(&value) {
        to.push(value);
    }
}

/// The numbers below `count` in an order.
fn sorted(count: usize, order: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut places: Vec<usize> = (0..count).collect();
    places.sort_by(|&a, &b| order(a, b));
    places
}

#[cfg(test)]
mod tests {
    use super::InOrder;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lists_are_sorted_as_the_standard_library_sorts_them(list: Vec<(u8, u16)>) {
            let (mut ours, mut theirs) = (list.clone(), list);
            ours.order_by_key(|pair| pair.0 % 8);
            theirs.sort_by_key(|pair| pair.0 % 8);
            prop_assert_eq!(&ours, &theirs);
            ours.order_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
            theirs.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
            prop_assert_eq!(ours, theirs);
        }
    }
}
