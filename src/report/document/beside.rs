//! What may be asked for beside the result of a verb.

use super::{Bounds, Named, all, bounds};
use crate::digits::Digits;
use crate::edit::Alone;
use crate::import;
use crate::problem::Problem;
use crate::report::edit::edit_in_words;
use serde::{Deserialize, Serialize};

keys! {
    /// What was asked for, under the keys that it has in any result; none of it at first.
    #[derive(Default)]
    Beside() {} or nothing {
        /// How many figures there are in all, on this path and on others.
        of_all: Option<u64> = None,
        /// What comes of each dimension alone.
        alone: Vec<AloneEnding> = Vec::new(),
        /// What was measured of each figure.
        measures: Vec<Measured> = Vec::new(),
        /// The figures of a molecule.
        conformers: Option<Vec<Conformer>> = None,
        /// Solutions to many digits.
        digits: Option<Vec<ManyDigits>> = None,
    }
}

keys! {
    /// What comes of a dimension that is led to its value after all others.
    AloneEnding(alone: &Alone) {
        /// Its name.
        dimension: String = alone.problem.dimension_name(alone.edited.dimensions[0].index),
        /// How that ended, as an edit does.
        ending: String = alone.edited.ending.name().into(),
        /// Its value where the others are met.
        from: Bounds = bounds(&alone.edited.dimensions[0].from),
        /// What it shall be.
        to: Bounds = bounds(&alone.edited.dimensions[0].to),
        /// What it came to.
        value: Bounds = bounds(&alone.edited.dimensions[0].value),
        /// That in words.
        verdict: String = edit_in_words(&alone.problem, &alone.edited),
    }
}

/// Something that is measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// What it is called.
    pub name: String,
    /// Its bounds for each figure; none where it can be anything.
    pub values: Vec<[Option<f64>; 2]>,
}

keys! {
    /// A figure of a molecule.
    Conformer(problem: &Problem, torsions: &[[usize; 4]], found: &import::Conformer) {
        /// The root of the mean square of how far its atoms are from those of the file.
        rmsd: f64 = found.rmsd,
        /// Whether it has to be mirrored for that.
        mirrored: bool = found.is_mirrored,
        /// The nearest atoms, measured by their radii.
        contact: Option<Contact> = found.contact.map(|contact| Contact::new(problem, contact)),
        /// The torsions about bonds.
        torsions: Vec<Torsion> = all(torsions.iter().zip(&found.torsions), |of| Torsion::new(problem, of)),
    } or nothing {
        /// The stereocentres.
        stereocentres: Vec<Stereocentre> = all(&found.letters, |of| Stereocentre::new(problem, of)),
    }
}

keys! {
    /// An atom that differs from its mirror image, with the one or the other key.
    Stereocentre(problem: &Problem, found: &(usize, import::Letter)) {
        /// Its name.
        atom: String = problem.points[found.0].name.clone(),
    } or nothing {
        /// R or S.
        letter: Option<char> = found.1.ok(),
        /// Why it has no letter, in words that follow *as*.
        no_letter: Option<String> = found.1.err().map(str::to_owned),
    }
}

keys! {
    /// Two atoms near to each other.
    Contact(problem: &Problem, found: ([usize; 2], f64, f64)) {
        /// Their names.
        atoms: Vec<String> = super::names(problem, &found.0),
        /// How far they are apart.
        apart: f64 = found.1,
        /// How far beyond the sum of their radii.
        beyond_radii: f64 = found.2,
    }
}

keys! {
    /// A torsion about a bond.
    Torsion(problem: &Problem, found: (&[usize; 4], &f64)) {
        /// The four atoms.
        atoms: Vec<String> = super::names(problem, found.0),
        /// The angle.
        degrees: f64 = *found.1,
    }
}

/// A solution to many digits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
#[allow(missing_docs)]
pub enum ManyDigits {
    /// Decimals by name.
    Told {
        points: Named<Vec<String>>,
        numbers: Named<String>,
    },
    /// Why it is not told.
    Untold { reason: String },
}

impl ManyDigits {
    /// Of each solution its points and numbers by name, or why it is not told.
    pub fn all(problem: &Problem, found: &[Result<Digits, String>]) -> Vec<Self> {
        all(found, |one| match one {
            Ok(found) => ManyDigits::Told {
                points: Named::of(problem, &found.points, Vec::clone),
                numbers: Named(found.numbers.clone()),
            },
            Err(why) => ManyDigits::Untold {
                reason: why.clone(),
            },
        })
    }
}
