//! Complete sets with the covers that prove them.

use krawl::certificate::cover::coordinates::CoordinateCover;
use krawl::complete::{Complete, Options, all};
use krawl::problem::Problem;

/// All figures, and the cover of the space of coordinates; its bytes are read as they were written.
pub fn searched(problem: &Problem) -> (Complete, CoordinateCover) {
    let options = Options {
        cover: true,
        ..Options::default()
    };
    let mut result = all(problem, &options).unwrap();
    let bytes = result.cover.take().expect("a cover");
    let cover = CoordinateCover::from_bytes(&bytes).unwrap();
    assert_eq!(cover.to_bytes(), bytes);
    (result, cover)
}
