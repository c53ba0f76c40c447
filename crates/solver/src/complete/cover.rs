//! The cover of the search space, as the search leaves it for the check.

use super::search::Search;
use crate::certificate::cover::Figure;
use crate::certificate::cover::Mark;
use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// Pieces of marks have about so many bytes.
const PIECE: usize = 1 << 20;

/// Where marks go: nowhere, or into bytes.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Marks {
    /// The bytes, if they are wanted, in pieces that follow each other: there may be some hundred millions.
    #[serde(rename = "bytes", with = "digits")]
    pieces: Option<Vec<Vec<u8>>>,
}

impl Marks {
    /// None so far.
    pub fn wanted() -> Marks {
        let pieces = Some(Vec::new());
        Marks { pieces }
    }

    /// Writes a mark about a part with so many symbols.
    pub fn put(&mut self, mark: Mark, symbols: usize) {
        let Some(pieces) = &mut self.pieces else {
            return;
        };
        if pieces.last().is_none_or(|last| last.len() >= PIECE) {
            pieces.push(Vec::new());
        }
        if let Some(bytes) = pieces.last_mut() {
            mark.put(symbols, bytes);
        }
    }

    /// How many bytes there are, if they are wanted.
    pub fn bytes(&self) -> Option<usize> {
        let pieces = self.pieces.as_deref();
        pieces.map(|all| all.iter().map(Vec::len).sum())
    }

    /// Adds marks that come after.
    pub fn append(&mut self, other: Marks) {
        let (Some(mine), Some(more)) = (&mut self.pieces, other.pieces) else {
            return;
        };
        for mut piece in more {
            match mine.last_mut() {
                Some(last) if last.len() + piece.len() <= PIECE => last.append(&mut piece),
                _ => {
                    piece.shrink_to_fit();
                    mine.push(piece);
                }
            }
        }
    }
}

/// Bytes as a text of hexadecimal digits.
mod digits {
    use crate::hexadecimal::hexadecimal;
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    pub fn serialize<S: Serializer>(
        pieces: &Option<Vec<Vec<u8>>>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let text = pieces.as_deref().map(|all| hexadecimal(&all.concat()));
        text.serialize(to)
    }

    pub fn deserialize<'d, D: Deserializer<'d>>(from: D) -> Result<Option<Vec<Vec<u8>>>, D::Error> {
        let text: Option<String> = Option::deserialize(from)?;
        let byte = |pair: &[u8]| {
            let digits = std::str::from_utf8(pair).ok()?;
            (pair.len() == 2).then(|| u8::from_str_radix(digits, 16).ok())?
        };
        text.map(|text| {
            let bytes: Option<Vec<u8>> = text.as_bytes().chunks(2).map(byte).collect();
            let bytes = bytes.ok_or_else(|| D::Error::custom("not hexadecimal digits"))?;
            Ok(vec![bytes])
        })
        .transpose()
    }
}

/// The whole cover, as a file, if it is wanted.
pub fn file(
    problem: &Problem,
    search: &Search,
    figures: &[Figure],
    marks: Marks,
) -> Option<Vec<u8>> {
    let length = marks.bytes()?;
    let pieces = marks.pieces?;
    let cover = search.plan.cover(problem, search.targets.unit, figures);
    let mut bytes = cover.head(length);
    bytes.reserve_exact(length);
    // Each piece's memory is free as soon as it is in its place.
    pieces.into_iter().for_each(|piece| bytes.extend(piece));
    Some(bytes)
}
