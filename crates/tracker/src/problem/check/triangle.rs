//! Lengths that no triangle has.

use crate::interval::Interval;
use crate::places::Each as _;
use crate::problem::Problem;
use crate::statement::neighbours;

impl Problem {
    /// Says which target lengths no figure has, where three of them belong to a triangle and one is longer
    /// than the other two together. `None`: there is no such triangle (which does not mean that there is a
    /// figure).
    ///
    /// ```
    /// use krawl::problem::Problem;
    /// let triangle = |longest: &str| {
    ///     Problem::build("triangle", 2)
    ///         .point("a", ["0", "0"]).point("b", ["1", "0"]).point("c", ["0.4", "1.1"])
    ///         .distance("a", "b", longest).distance("b", "c", "90").distance("c", "a", "70")
    ///         .finish().unwrap()
    /// };
    /// assert_eq!(triangle("150").impossible_triangle(), None);
    /// assert_eq!(
    ///     triangle("200").impossible_triangle().unwrap(),
    ///     "no figure has these lengths: a-b is longer than a-c and c-b together"
    /// );
    /// ```
    pub fn impossible_triangle(&self) -> Option<String> {
        let lengths: Vec<Interval> = self
            .distances
            .iter()
            .map(|distance| distance.target.enclose())
            .collect();
        // The distances of each point: the other end, and which.
        let joined = neighbours(self.points.len(), self.distances.iter().map(|d| d.points));
        let mut length_to = vec![None; self.points.len()];
        for (index, distance) in self.distances.iter().enumerate() {
            let [a, b] = distance.points;
            for &(c, of_a) in &joined[a] {
                length_to[c] = Some(lengths[of_a]);
            }
            let third = joined[b].iter().find(|&&(c, of_b)| {
                c != a
                    && length_to[c]
                        .is_some_and(|of_a| (of_a + lengths[of_b]).sup() < lengths[index].inf())
            });
            if let Some(&(c, _)) = third {
                let [a, b, c] = [a, b, c].each(|p| &self.points[p].name);
                return Some(format!(
                    "no figure has these lengths: {a}-{b} is longer than {a}-{c} and {c}-{b} together"
                ));
            }
            for &(c, _) in &joined[a] {
                length_to[c] = None;
            }
        }
        None
    }
}
