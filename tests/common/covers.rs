//! Complete sets with the covers that prove them.

use krawl::certificate::cover::coordinates::CoordinateCover;
use krawl::certificate::cover::verify_cover;
use krawl::complete::{Complete, Options, Status, all};
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

/// The same of a set that has to be complete, and proved by its cover.
pub fn proved(problem: &Problem) -> (Complete, CoordinateCover) {
    let (result, cover) = searched(problem);
    assert_eq!(result.status, Status::Complete, "{}", problem.name);
    let verdict = verify_cover(&cover.to_bytes()).unwrap();
    assert_eq!(verdict.flaw, None, "{}", problem.name);
    assert_eq!(verdict.undecided, 0, "{}", problem.name);
    assert_eq!(verdict.solutions, Some(result.solutions.len() as u64));
    assert!(verdict.is_about(problem));
    (result, cover)
}

/// What a cover that was changed may still prove: the truth, or less.
pub fn is_harmless(cover: &CoordinateCover, count: u64) -> bool {
    let Ok(verdict) = verify_cover(&cover.to_bytes()) else {
        return true;
    };
    !verdict.proves_all() || verdict.solutions == Some(count)
}
