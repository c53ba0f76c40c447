//! Sets that are joined.

use crate::places::Each as _;

/// The numbers below a count, in sets: each leads to another one of its set, or to itself.
#[derive(Debug, Clone, Default)]
pub struct Joined(Vec<usize>);

impl Joined {
    /// Each number is a set.
    pub fn new(count: usize) -> Self {
        Joined((0..count).collect())
    }

    /// One more number, a set; which it is.
    pub fn add(&mut self) -> usize {
        self.0.push(self.0.len());
        self.0.len() - 1
    }

    /// What stands for the set of a number.
    pub fn of(&self, mut number: usize) -> usize {
        while self.0[number] != number {
            number = self.0[number];
        }
        number
    }

    /// Joins the sets of two; what stands for that of the second stands for both. Whether they were two.
    pub fn join(&mut self, pair: [usize; 2]) -> bool {
        let [a, b] = pair.each(|number| self.of(number));
        self.0[a] = b;
        a != b
    }

    /// Joins the sets of all of these.
    pub fn join_all(&mut self, all: &[usize]) {
        for pair in all.windows(2) {
            self.join([pair[0], pair[1]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Joined;

    #[test]
    fn what_is_joined_has_one_that_stands_for_it() {
        let mut sets = Joined::new(4);
        assert!(sets.join([0, 1]) && sets.join([3, 2]) && !sets.join([1, 0]));
        assert_eq!([0, 1, 2, 3].map(|number| sets.of(number)), [1, 1, 2, 2]);
        let last = sets.add();
        assert_eq!((last, sets.of(last)), (4, 4));
        assert!(sets.join([1, last]) && sets.join([3, 0]) && !sets.join([2, 1]));
        assert!((0..5).all(|number| sets.of(number) == 4));
    }
}
