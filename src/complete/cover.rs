//! The cover of the search space, as the search leaves it for the check.

use super::krawczyk::Figure;
use super::plan::{Drive, Kind, Plan, Radius};
use super::search::Search;
use crate::certificate::cover::{self, Cover, Mark};
use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// Where marks go: nowhere, or into bytes.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Marks {
    /// The bytes, if they are wanted.
    #[serde(with = "digits")]
    pub bytes: Option<Vec<u8>>,
}

impl Marks {
    /// Writes a mark about a part with so many symbols.
    pub fn put(&mut self, mark: Mark, symbols: usize) {
        if let Some(bytes) = &mut self.bytes {
            mark.put(symbols, bytes);
        }
    }
}

/// Bytes as a text of hexadecimal digits.
mod digits {
    use crate::hexadecimal::hexadecimal;
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub fn serialize<S: Serializer>(bytes: &Option<Vec<u8>>, to: S) -> Result<S::Ok, S::Error> {
        let text = bytes.as_deref().map(hexadecimal);
        text.serialize(to)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<Option<Vec<u8>>, D::Error> {
        let text: Option<String> = Option::deserialize(from)?;
        let byte = |pair: &[u8]| {
            let digits = std::str::from_utf8(pair).ok()?;
            (pair.len() == 2).then(|| u8::from_str_radix(digits, 16).ok())?
        };
        text.map(|text| {
            let bytes: Option<Vec<u8>> = text.as_bytes().chunks(2).map(byte).collect();
            bytes.ok_or_else(|| D::Error::custom("not hexadecimal digits"))
        })
        .transpose()
    }
}

/// The whole cover, as a file.
pub fn file(problem: &Problem, search: &Search, figures: &[Figure], marks: Vec<u8>) -> Vec<u8> {
    let unit = search.targets.unit.log2();
    Cover {
        problem: problem.to_toml(),
        base: search.plan.base.clone(),
        steps: steps(&search.plan),
        drives: search
            .plan
            .drives
            .iter()
            .map(|drive| match drive {
                Drive::Angle => None,
                Drive::Square(bounds) => Some(*bounds),
            })
            .collect(),
        figures: figures.iter().map(|figure| figure.centre.clone()).collect(),
        unit_exponent: unit as i32,
        marks,
    }
    .to_bytes()
}

fn steps(plan: &Plan) -> Vec<(usize, cover::Kind)> {
    let kind = |kind: &Kind| match kind {
        Kind::Arm { centre, parameter } => cover::Kind::Arm(*centre, *parameter),
        Kind::Hinge { frame, parameter } => cover::Kind::Hinge(*frame, *parameter),
        Kind::Meet { centres, radii } => {
            let radius = |radius: &Radius| match radius {
                Radius::Edge(_) => cover::Radius::Given,
                Radius::Parameter(k) => cover::Radius::Parameter(*k),
            };
            let pairs = centres.iter().zip(radii);
            cover::Kind::Meet(pairs.map(|(p, r)| (*p, radius(r))).collect())
        }
    };
    plan.steps
        .iter()
        .map(|step| (step.point, kind(&step.kind)))
        .collect()
}
