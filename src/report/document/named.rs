//! Maps by name.

use crate::problem::Problem;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;

/// What there is by name, in the order in which it is written: that of the problem. What was read is in the order of the names.
#[derive(Debug, Clone, PartialEq)]
pub struct Named<T>(pub Vec<(String, T)>);

impl<T> Named<T> {
    /// What has a name, if anything has.
    pub fn get(&self, name: &str) -> Option<&T> {
        let mut all = self.0.iter();
        all.find_map(|(known, what)| (known == name).then_some(what))
    }

    /// What there is of each point of a problem.
    pub(crate) fn of<U>(problem: &Problem, all: &[U], make: impl Fn(&U) -> T) -> Self {
        let all = problem.points.iter().zip(all);
        let all = all.map(|(point, one)| (point.name.clone(), make(one)));
        Named(all.collect())
    }
}

impl<C> Named<Vec<C>> {
    /// The points of a problem in a figure, each coordinate as `number` has it.
    pub(crate) fn each<T>(problem: &Problem, places: &[[T; 3]], number: impl Fn(&T) -> C) -> Self {
        let place = |at: &[T; 3]| at[..problem.dimension].iter().map(&number).collect();
        Named::of(problem, places, place)
    }
}

impl<T> Default for Named<T> {
    fn default() -> Self {
        Named(Vec::new())
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, what)| (name, what)))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Named<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let all = BTreeMap::deserialize(deserializer)?;
        Ok(Named(all.into_iter().collect()))
    }
}
