//! Hard cases, in families with a parameter, and what must come out of them, found without
//! following any path: see `problems/hard/README.md`.

pub mod bars;
pub mod boundary;
mod families;
pub mod polynomial;
mod shapes;
pub mod trees;

pub use families::Family;

/// What is known of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    /// It closes, with so many solutions, and so many up to reflection.
    Path { solutions: usize, classes: usize },
    /// It is singular, touches t = 1, or does not come back: no certified run may close.
    NeverCloses,
    /// Nobody has worked it out; what a closed run says must stand the checks that every run does.
    Unknown,
}

/// All of them.
pub fn families() -> impl Iterator<Item = &'static Family> {
    let near = families::FAMILIES.iter().chain(boundary::FAMILIES);
    near.chain(shapes::FAMILIES)
}
