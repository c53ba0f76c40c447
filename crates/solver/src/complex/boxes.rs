//! Boxes in complex space that hold exactly one solution each, and sets of them without duplicates.

use super::system::Signs;
use crate::interval::{DoubleDouble, Interval, hull, point};
use crate::track::arc::Figure;
use crate::track::certified::Same;

/// A box around a solution, proved to hold exactly one.
#[derive(Debug, Clone)]
pub struct SolutionBox {
    /// The box as the tracker takes it: real and imaginary part of every unknown in turn.
    pub figure: Figure,
    /// The box as intervals rounded outwards: real and imaginary part of every unknown in turn.
    pub parts: Vec<Interval>,
    /// Within this distance of the box's middle, in every part, there is no other solution.
    pub alone_within: f64,
}

impl SolutionBox {
    /// From what the tracker proved.
    pub fn new(figure: Figure, alone_within: f64) -> Self {
        let parts = 0..figure.centre.len();
        SolutionBox {
            parts: parts.map(|i| figure.enclosure(i)).collect(),
            figure,
            alone_within,
        }
    }

    /// How far the solution may be from the middle in any part.
    pub fn radius(&self) -> f64 {
        self.figure.radius.iter().copied().fold(0.0, f64::max)
    }

    /// The box's middle: real and imaginary part of every unknown in turn.
    pub fn middle(&self) -> Vec<DoubleDouble> {
        let words = self.figure.centre.iter().zip(&self.figure.low);
        words.map(|(&x, &low)| DoubleDouble::sum(x, low)).collect()
    }

    /// Whether the image of this one's solution under a change of signs, and under conjugation if asked for,
    /// is the other one's. Both have to be solutions of the same equations, which the image satisfies too.
    pub fn is_same(&self, other: &SolutionBox, signs: &Signs, conjugate: bool) -> Same {
        let (mut inside, mut apart) = (true, false);
        let (one, two) = (&self.figure, &other.figure);
        for i in 0..one.centre.len() {
            let minus = signs.changes[i / 2] ^ (conjugate && i % 2 == 1);
            let image = |x: f64| point(if minus { -x } else { x });
            // Between the middles, both words of which count: large solutions are alone within less than a float's last digit.
            let between = image(one.centre[i]) - point(two.centre[i])
                + (image(one.low[i]) - point(two.low[i]));
            let around = hull(-one.radius[i], one.radius[i]);
            inside &= (between + around).mag() < other.alone_within;
            let both = around + hull(-two.radius[i], two.radius[i]);
            apart |= !(between + both).contains(0.0);
        }
        match (inside, apart) {
            (true, _) => Same::Yes,
            (false, true) => Same::No,
            (false, false) => Same::Unknown,
        }
    }

    /// An enclosure of a number that a solution has in common with its images under all changes of signs and
    /// conjugation: the real part of a sum of the squares of the unknowns with fixed weights.
    fn key(&self) -> Interval {
        let mut sum = point(0.0);
        // Weights without pattern: the golden section's multiples.
        let mut weight = 0.5f64;
        for part in self.parts.chunks(2) {
            weight = (weight + 0.618_033_988_749_894_9).fract();
            sum += point(0.25 + weight) * (part[0].sqr() - part[1].sqr());
        }
        sum
    }

    /// The greatest size of a part.
    pub fn size(&self) -> f64 {
        self.parts.iter().fold(0.0, |max: f64, x| max.max(x.mag()))
    }

    /// The greatest width of a part beside the greatest size, or 1 if that is more.
    pub fn relative_width(&self) -> f64 {
        let width = self.parts.iter().fold(0.0, |max: f64, x| max.max(x.wid()));
        width / self.size().max(1.0)
    }
}

/// What a set says of a box.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// It holds none of the set's solutions, nor an image of one.
    New,
    /// It holds this one, or an image of it.
    Old(usize),
    /// Neither could be proved.
    Unknown,
}

/// Solutions of one instance, one of each orbit under a group of changes of signs; proved to be different.
#[derive(Debug, Clone, Default)]
pub struct SolutionSet {
    boxes: Vec<SolutionBox>,
    /// Keys' lower ends with the boxes' indices, in order.
    keys: Vec<(f64, usize)>,
    /// The widest key.
    widest: f64,
}

impl SolutionSet {
    /// The boxes, in the order in which they came.
    pub fn boxes(&self) -> &[SolutionBox] {
        &self.boxes
    }

    /// The number of boxes.
    pub fn len(&self) -> usize {
        self.boxes.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }

    /// Boxes whose key may be that of this one.
    fn near(&self, one: &SolutionBox) -> impl Iterator<Item = usize> + '_ {
        let key = one.key();
        // Lower ends further away than the widest key belong to keys that are disjoint from this one.
        let (low, high) = ((key.inf() - self.widest).next_down(), key.sup());
        let first = self.keys.partition_point(|k| k.0 < low);
        self.keys[first..]
            .iter()
            .take_while(move |k| k.0 <= high)
            .map(|k| k.1)
    }

    /// Which of the set's solutions a box holds, up to a group; or the conjugate of which.
    pub fn find(&self, one: &SolutionBox, group: &[Signs], conjugate: bool) -> Found {
        let mut found = Found::New;
        for index in self.near(one) {
            for signs in group {
                match one.is_same(&self.boxes[index], signs, conjugate) {
                    Same::Yes => return Found::Old(index),
                    Same::No => {}
                    Same::Unknown => found = Found::Unknown,
                }
            }
        }
        found
    }

    /// The index of the solution that a box holds, up to a group: it is added if it is new.
    pub fn enter(&mut self, one: SolutionBox, group: &[Signs]) -> Result<usize, String> {
        match self.find(&one, group, false) {
            Found::Old(index) => Ok(index),
            Found::New => Ok(self.push(one)),
            Found::Unknown => Err("two solutions could not be told apart".to_owned()),
        }
    }

    /// Adds a box that was found to be new, and returns its index.
    pub fn push(&mut self, one: SolutionBox) -> usize {
        let (key, index) = (one.key(), self.boxes.len());
        self.widest = self.widest.max(key.wid());
        let place = self.keys.partition_point(|k| k.0 < key.inf());
        self.keys.insert(place, (key.inf(), index));
        self.boxes.push(one);
        index
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn around(parts: &[f64], radius: f64, alone: f64) -> SolutionBox {
        let figure = Figure::around(parts.to_vec(), vec![radius; parts.len()]);
        SolutionBox::new(figure, alone)
    }

    fn signs(changes: &[bool]) -> Signs {
        Signs {
            changes: changes.to_vec(),
            mirrors: false,
        }
    }

    #[test]
    fn a_set_knows_its_own_up_to_signs_and_nothing_else() {
        let group = [signs(&[false, false]), signs(&[true, false])];
        let mut set = SolutionSet::default();
        let one = around(&[1.0, 2.0, 3.0, 4.0], 1e-14, 0.1);
        assert_eq!(set.find(&one, &group, false), Found::New);
        set.push(one.clone());
        assert_eq!(set.find(&one, &group, false), Found::Old(0));
        let image = around(&[-1.0, -2.0, 3.0, 4.0], 1e-14, 0.1);
        assert_eq!(set.find(&image, &group, false), Found::Old(0));
        assert_eq!(set.find(&image, &group[..1], false), Found::New);
        let conjugate = around(&[1.0, -2.0, 3.0, -4.0], 1e-14, 0.1);
        assert_eq!(set.find(&conjugate, &group, false), Found::New);
        assert_eq!(set.find(&conjugate, &group, true), Found::Old(0));
        // Another figure with the same key is no image.
        let other = around(&[1.0, -2.0, 3.0, 4.0], 1e-14, 0.1);
        assert_eq!(set.find(&other, &group, false), Found::New);
        // Boxes that overlap, where nothing is known of the neighbourhood.
        let wide = around(&[1.0, 2.0, 3.0, 4.0], 1e-3, 0.1);
        let mut doubtful = SolutionSet::default();
        doubtful.push(around(&[1.0, 2.0, 3.0, 4.0], 1e-14, 1e-6));
        assert_eq!(doubtful.find(&wide, &group, false), Found::Unknown);
    }

    #[test]
    fn many_solutions_are_told_apart() {
        let group = [signs(&[false])];
        let mut set = SolutionSet::default();
        for i in 0..40 {
            for j in 0..40 {
                let one = around(&[f64::from(i), f64::from(j)], 1e-12, 0.1);
                assert_eq!(set.find(&one, &group, false), Found::New);
                set.push(one);
            }
        }
        for k in (0..1600).step_by(7) {
            let one = set.boxes()[k].clone();
            assert_eq!(set.find(&one, &group, false), Found::Old(k));
        }
    }
}
