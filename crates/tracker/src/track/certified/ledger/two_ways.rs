//! One account of two: of the ways from the sketch in both directions.

use super::Ledger;
use crate::track::Place;
use crate::track::certified::figures::FigureBox;
use crate::track::certified::solution::Same;

impl Ledger {
    /// Takes the account of the way from the sketch in the other direction to that of this way: solutions are
    /// in the order of the path, from the end of the other way to that of this one. Fails where it cannot be told
    /// whether a solution was found on both.
    pub fn go_on_from(&mut self, back: Self) -> Result<(), String> {
        let ahead = std::mem::take(&mut self.found);
        let places = std::mem::take(&mut self.places);
        self.found = back.found;
        self.found.reverse();
        // Behind the sketch lengths of the path count downwards.
        self.places = back.places;
        self.places.reverse();
        for place in &mut self.places {
            (place.arc, place.rising) = (-place.arc, !place.rising);
        }
        for (found, place) in ahead.into_iter().zip(places) {
            let same = |other: &FigureBox| found.is_same(other, |_| false);
            let answers: Vec<Same> = self.found.iter().map(same).collect();
            if answers.contains(&Same::Unknown) {
                return Err(
                    "it could not be told whether a solution near the sketch is one or two"
                        .to_owned(),
                );
            }
            if !answers.contains(&Same::Yes) {
                self.found.push(found);
                self.places.push(place);
            }
        }
        self.length += back.length;
        let (low, high) = back.t_range;
        self.t_range = (self.t_range.0.min(low), self.t_range.1.max(high));
        Ok(())
    }

    /// Takes over the account of the way from the sketch in the other direction, where the two have met: solutions are in
    /// the order of the closed path, from the sketch on. Fails where it cannot be told whether a solution was found on
    /// both, or one was elsewhere than where they met; what is left is then neither's account.
    pub fn close_with(&mut self, back: Self) -> Result<(), String> {
        let (folds, is_certain) = self.turns.closed_by(&back.turns);
        self.length += back.length;
        let ahead = self.found.len();
        let last = back.found.len();
        for (k, (found, place)) in back.found.into_iter().zip(back.places).enumerate().rev() {
            let others = self.found[..ahead].iter();
            let mut answers = others.map(|other| found.is_same(other, |_| false));
            match answers.position(|same| same != Same::No) {
                None => {}
                // The last one of both, where they met.
                Some(at)
                    if (at + 1, k + 1) == (ahead, last)
                        && found.is_same(&self.found[at], |_| false) == Same::Yes =>
                {
                    continue;
                }
                Some(_) => return Err("a solution was found on both ways".to_owned()),
            }
            self.found.push(found);
            // Those of the whole path but for those between it and the sketch, on the way back.
            let folds = folds.saturating_sub(place.folds.unwrap_or(0));
            self.places.push(Place {
                arc: self.length - place.arc,
                rising: !place.rising,
                folds: (folds > 0 || is_certain).then_some(folds),
            });
        }
        let (low, high) = back.t_range;
        self.t_range = (self.t_range.0.min(low), self.t_range.1.max(high));
        Ok(())
    }
}
