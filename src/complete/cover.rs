//! The cover of the search space as the search goes: which part is excluded by what.
//!
//! A cover is a sequence of marks. Whoever knows the problem and the plan and reads the marks one after the
//! other can do every step of the search again without searching (`certs/covers.md`).

/// One mark. Steps are counted along the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mark {
    /// The point of this step has no place: its squared height is negative.
    NoPlace(u8),
    /// The point of this step has two places; what is said of the first side comes first.
    Sides(u8),
    /// The height of this step's point becomes a symbol in this range: a part of its own.
    Fold(u8, [f64; 2]),
    /// A symbol's range is halved, which makes two parts of their own; signs of later steps are open. The
    /// flag says whether this step's sign is kept.
    Halves(u8, bool, u8),
    /// This step's point stands, and the distance of this place among those that close there is wrong.
    WrongDistance(u8, u8),
    /// This step's point stands, and the equations so far exclude each other.
    Excluded(u8),
    /// This step's point stands, and the equations so far hold within these ranges only: a part of its own.
    Within(u8, [[f64; 2]; super::node::MAX_SYMBOLS], u8),
    /// All points stand, where the uniqueness of a figure listed holds.
    Figure,
    /// Nothing is claimed of this part.
    Undecided,
    /// This step's point stands, too near to or too far from another point.
    TooFar(u8, u8),
}

/// Where marks go: nowhere, or into bytes.
#[derive(Debug, Clone, Default)]
pub struct Marks {
    /// The bytes, if they are wanted.
    pub bytes: Option<Vec<u8>>,
}

impl Marks {
    /// Writes a mark.
    pub fn put(&mut self, mark: Mark) {
        let Some(out) = &mut self.bytes else { return };
        match mark {
            Mark::NoPlace(step) => out.extend([1, step]),
            Mark::Sides(step) => out.extend([2, step]),
            Mark::Fold(step, range) => {
                out.extend([3, step]);
                out.extend(range.iter().flat_map(|x| x.to_le_bytes()));
            }
            Mark::Halves(step, kept, symbol) => out.extend([4, step, kept as u8, symbol]),
            Mark::WrongDistance(step, place) => out.extend([5, step, place]),
            Mark::Excluded(step) => out.extend([6, step]),
            Mark::Within(step, ranges, count) => {
                out.extend([7, step]);
                for range in &ranges[..count as usize] {
                    out.extend(range.iter().flat_map(|x| x.to_le_bytes()));
                }
            }
            Mark::Figure => out.push(8),
            Mark::Undecided => out.push(9),
            Mark::TooFar(step, point) => out.extend([10, step, point]),
        }
    }
}
