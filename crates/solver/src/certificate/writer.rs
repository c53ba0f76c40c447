//! Writing a certificate while a run goes on.

use super::begun::{PROGRAM, write_header, write_text};
use super::checker::Trial;
use super::format::{
    ArcClaim, EndClaim, Ending, FoldClaim, MAX_FREE_COORDINATES, MAX_TEXT, Record, SolutionClaim,
    TAG_ARC, TAG_ARC_OF_DIMENSIONS, TAG_DIVIDE, TAG_END, TAG_EXTENDED, TAG_FOLD, TAG_MOTION,
    TAG_REACHED, TAG_RETURN, TAG_SOLUTION, TAG_TUBE, TAG_TURN, TubeClaim, WEIGHT_UNIT,
};
use crate::problem::{Decimal, Problem, Target};
use crate::track::arc::{ArcEnd, ArcRun, Figure};
use crate::track::{LARGEST_SQUARE, Status, TubeSeen, Witness};
use std::collections::VecDeque;
use std::io::{self, Write};

// What runs prove can be read again.
const _: () = assert!(LARGEST_SQUARE <= MAX_FREE_COORDINATES);

/// Boxes are written wider than they were proved, by this factor and by a few roundings of the
/// largest coordinate, so that a checker that rounds more coarsely has room; the claim is weaker,
/// not stronger.
const WIDER: f64 = 2.0;
/// Boxes of folds are written wider than they were proved by this factor: a checker may bound all their entries by
/// the largest, velocities among them.
const WIDER_AT_FOLDS: f64 = 1024.0;
/// So many records at the end of an open path's way may be left out.
const TAIL: usize = 16;
/// See [`WIDER`].
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// Writes what a certified run lets it see: to be given to [`crate::track::Control::witness`].
///
/// Nothing is kept in memory but the last few records, the tubes of one edit, and those of the way back of an open path. Errors are kept until [`Writer::finish`].
#[derive(Debug)]
pub struct Writer<'a, W> {
    out: W,
    problem: &'a Problem,
    tubes: u64,
    solutions: usize,
    /// The way back from the sketch, and how many solutions there were before.
    back: Option<(Vec<Record>, usize)>,
    /// The piece with heights divided by 1 − t that is being followed, if so: it may come to nothing.
    piece: Option<Vec<Record>>,
    /// The last tubes, in extended precision, and their solutions: left out where the run stops among them, near a
    /// singular place, as the checker's bounds are coarser.
    held: Vec<Record>,
    /// The last records, up to [`TAIL`], which are not written yet: tubes at the end of an open path may be left out.
    tail: VecDeque<Record>,
    /// Whether tubes are written in parts, as those of the reduced space are.
    in_parts: bool,
    /// The edit at hand: what it changes, and its tubes so far.
    arc: Option<Following>,
    /// Whether there was one, and why the last did not come to its end.
    edits: Option<Result<(), String>>,
    /// The motion, where tubes are those of one, and the edit before it.
    motion: Vec<ArcClaim>,
    ended: bool,
    result: io::Result<()>,
    /// What lengths are divided by, and what tells whether tubes will be proved, of the given equations and of the divided ones.
    unit: f64,
    trials: [Option<Trial>; 2],
}

/// An edit that is being followed.
#[derive(Debug)]
struct Following {
    dimensions: Vec<(u32, Decimal)>,
    tubes: Vec<TubeClaim>,
}

impl<'a, W: Write> Writer<'a, W> {
    /// A certificate of this problem, to be written to `out`, which should be buffered.
    pub fn new(out: W, problem: &'a Problem) -> Self {
        Writer {
            out,
            problem,
            tubes: 0,
            solutions: 0,
            back: None,
            piece: None,
            held: Vec::new(),
            tail: VecDeque::new(),
            in_parts: false,
            arc: None,
            edits: None,
            motion: Vec::new(),
            ended: false,
            result: Ok(()),
            unit: 1.0,
            trials: [None, None],
        }
    }

    /// Hands the stream back once the run is over, or the last edit. Fails where writing did, or where no
    /// certified run has come to its end.
    pub fn finish(mut self) -> io::Result<W> {
        if let Some(edits) = self.edits.take() {
            let ending = match edits {
                Ok(()) => Ending::Complete,
                Err(reason) => Ending::Stopped(shortened(&reason)),
            };
            self.close(ending, &[]);
        }
        self.result?;
        if !self.ended {
            return Err(io::Error::other("the run left no proof"));
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn put(&mut self, record: Record) {
        if let Some((records, _)) = &mut self.back {
            records.push(record);
        } else {
            self.tail.push_back(record);
            if self.tail.len() > TAIL
                && let Some(record) = self.tail.pop_front()
            {
                self.write(&record);
            }
        }
    }

    fn write(&mut self, record: &Record) {
        if self.result.is_ok() {
            self.result = write_record(&mut self.out, record);
        }
    }

    /// Leaves out tubes at the end of an open path: all that are in extended precision, and of the last [`TAIL`] others those
    /// from the first one on that the checker would not prove. The certificate is of a path that ends before, with the same
    /// solutions: one may be told a little before it is passed, so that the tube behind it stays.
    fn trim(&mut self) {
        if self.in_parts {
            // Solutions are told behind the first of a tube's parts, and lie in any of them.
            return self.release();
        }
        let is_tube = |record: &Record| matches!(record, Record::Tube(_));
        // The tube around the sketch stays: behind the turn, or as the first of all; and the first in the given equations again.
        let last = match &self.back {
            Some((records, _)) => records.last(),
            None => self.tail.back(),
        };
        let is_first = matches!(
            last,
            None | Some(Record::Turn | Record::Return | Record::Motion(_))
        );
        let least = usize::from(is_first);
        let told = self.held.iter().rposition(|record| !is_tube(record));
        let least = told.map_or(least, |k| k + 2);
        while self.held.len() > least && self.held.pop().is_some() {
            self.tubes -= 1;
        }
        self.release();
        let of = (self.problem, self.unit, &self.motion[..]);
        let (records, first): (Vec<&Record>, usize) = match &self.back {
            Some((records, _)) => (records.iter().collect(), 2),
            None => {
                let written = self.tubes > self.tail.iter().filter(|r| is_tube(r)).count() as u64;
                (self.tail.iter().collect(), usize::from(!written))
            }
        };
        let after = records.iter().rposition(|record| !is_tube(record));
        let from = after
            .map_or(0, |k| k + 2)
            .max(first)
            .max(records.len().saturating_sub(TAIL));
        let trial = prepared(&mut self.trials, of, false);
        let fails = |record: &&Record| match (record, trial) {
            (Record::Tube(tube), Some(trial)) => !trial.proves(tube),
            _ => false,
        };
        let kept = (from..records.len()).find(|&k| fails(&records[k]));
        let Some(kept) = kept else {
            return;
        };
        self.tubes -= (records.len() - kept) as u64;
        match &mut self.back {
            Some((records, _)) => records.truncate(kept),
            None => self.tail.truncate(kept),
        }
    }

    /// The last tube of the edit or the piece at hand; or of the path, those that are held left out, if it is not written yet.
    fn last_tube(&mut self) -> Option<&mut TubeClaim> {
        let tube = |record| match record {
            &mut Record::Tube(ref mut tube) => Some(tube),
            _ => None,
        };
        match (&mut self.arc, &mut self.piece, &mut self.back) {
            (Some(arc), _, _) => arc.tubes.last_mut(),
            (None, Some(records), _) | (None, None, Some((records, _))) => {
                records.iter_mut().rev().find_map(tube)
            }
            (None, None, None) => self.tail.iter_mut().rev().find_map(tube),
        }
    }

    fn flush(&mut self) {
        for record in std::mem::take(&mut self.tail) {
            self.write(&record);
        }
    }

    fn release(&mut self) {
        for record in std::mem::take(&mut self.held) {
            self.put(record);
        }
    }

    /// Dimensions that are led, as a certificate has them.
    fn led(&mut self, dimensions: &[(usize, &Target)]) -> Option<Vec<(u32, Decimal)>> {
        let value = |&(index, target): &(usize, &Target)| match target {
            Target::Length(value) => Some((index as u32, value.clone())),
            Target::SquaredLength(_) => None,
        };
        let led: Option<_> = dimensions.iter().map(value).collect();
        if led.is_none() {
            let what = "certificates hold lengths, not squares of them";
            self.result = Err(io::Error::other(what));
        }
        led
    }

    fn close(&mut self, ending: Ending, classes: &[usize]) {
        self.put(Record::End(EndClaim {
            ending,
            tubes: self.tubes,
            classes: classes.iter().map(|&c| c as u32).collect(),
        }));
        self.flush();
        self.ended = true;
    }
}

/// What tells whether tubes will be proved, of the given equations or of the divided ones: made when it is wanted for the first time.
fn prepared<'t>(
    trials: &'t mut [Option<Trial>; 2],
    (problem, unit, motion): (&Problem, f64, &[ArcClaim]),
    is_divided: bool,
) -> Option<&'t Trial> {
    let trial = &mut trials[usize::from(is_divided)];
    if trial.is_none() {
        *trial = Trial::new(problem, unit, motion, is_divided);
    }
    trial.as_ref()
}

/// A box around a figure, wider than it was proved.
fn solution_claim(centre: &[f64], radius: &[f64], wider: f64) -> SolutionClaim {
    let largest = |v: &[f64]| v.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
    SolutionClaim {
        centre: centre.iter().map(|x| x + 0.0).collect(),
        radius: (wider * largest(radius) + ROUNDINGS * largest(centre)) as f32,
    }
}

/// A tube as a certificate has it.
fn tube_claim(tube: &TubeSeen) -> TubeClaim {
    let weight = |&u: &f64| (u / WEIGHT_UNIT).round().clamp(1.0, u16::MAX.into()) as u16;
    TubeClaim {
        // Without zeros below zero, which differ between builds.
        centre: tube.centre.iter().map(|x| x + 0.0).collect(),
        low: tube.low.unwrap_or_default().to_vec(),
        normal: tube.normal.iter().map(|&c| c as f32 + 0.0).collect(),
        weights: tube.weights.iter().map(weight).collect(),
        h: tube.h,
        r: tube.r as f32,
        exit: tube.exit,
    }
}

/// As much of a reason as fits.
fn shortened(reason: &str) -> String {
    let end = (0..=reason.len().min(MAX_TEXT)).rev();
    let end = end.into_iter().find(|&end| reason.is_char_boundary(end));
    reason[..end.unwrap_or(0)].to_owned()
}

impl<W: Write> Witness for Writer<'_, W> {
    fn begin(&mut self, unit: f64) {
        // The tubes of a motion go on from a figure.
        if !self.motion.is_empty() {
            return;
        }
        let exponent = unit.log2() as i16;
        self.unit = unit;
        self.result = write_header(
            &mut self.out,
            PROGRAM,
            &self.problem.unsigned().without_limits().to_toml(),
            exponent,
        );
    }

    fn tube(&mut self, tube: TubeSeen) {
        let tube = tube_claim(&tube);
        // The tube before one of more digits is told with as many, so that the checker encloses the point where it is left with these: the next
        // may be narrower than 53 bits tell that point.
        if !tube.low.is_empty()
            && let Some(last) = self.last_tube()
            && last.low.is_empty()
        {
            last.low = vec![0.0; last.centre.len()];
        }
        match (&mut self.arc, &mut self.piece) {
            (Some(arc), _) => arc.tubes.push(tube),
            (None, Some(piece)) => piece.push(Record::Tube(tube)),
            (None, None) => {
                self.tubes += 1;
                if tube.low.is_empty() {
                    self.release();
                    self.put(Record::Tube(tube));
                } else {
                    self.held.push(Record::Tube(tube));
                }
            }
        }
    }

    fn is_provable(&mut self, tube: &TubeSeen) -> bool {
        self.in_parts = true;
        let is_divided = self.piece.is_some();
        let of = (self.problem, self.unit, &self.motion[..]);
        let trial = prepared(&mut self.trials, of, is_divided);
        trial.is_none_or(|trial| trial.proves(&tube_claim(tube)))
    }

    fn solution(&mut self, centre: &[f64], radius: &[f64]) {
        // An edit's figures stand at its end.
        if self.arc.is_none() {
            let record = Record::Solution(solution_claim(centre, radius, WIDER));
            if let Some(piece) = &mut self.piece {
                return piece.push(record);
            }
            self.solutions += 1;
            match self.held.is_empty() {
                true => self.put(record),
                false => self.held.push(record),
            }
        }
    }

    fn divide(&mut self) {
        self.piece = Some(Vec::new());
    }

    fn end_divide(&mut self, kept: bool) {
        let Some(piece) = self.piece.take().filter(|_| kept) else {
            return;
        };
        if !self.motion.is_empty() {
            let what = "a motion past a flat figure, where its equations are dependent, has no certificate";
            self.result = Err(io::Error::other(what));
            return;
        }
        self.release();
        self.put(Record::Divide);
        for record in piece {
            match record {
                Record::Tube(_) => self.tubes += 1,
                _ => self.solutions += 1,
            }
            self.put(record);
        }
        self.put(Record::Return);
    }

    fn turn(&mut self) {
        self.trim();
        self.back = Some((vec![Record::Turn], self.solutions));
    }

    fn end_turn(&mut self, kept: bool) {
        if kept {
            self.trim();
        } else {
            self.release();
        }
        let Some((records, solutions)) = self.back.take() else {
            return;
        };
        if kept {
            records.into_iter().for_each(|record| self.put(record));
        } else {
            let tubes = records.iter().filter(|r| matches!(r, Record::Tube(_)));
            self.tubes -= tubes.count() as u64;
            self.solutions = solutions;
        }
    }

    fn begin_arc(&mut self, dimensions: &[(usize, &Target)]) {
        if let Some(dimensions) = self.led(dimensions) {
            let tubes = Vec::new();
            self.arc = Some(Following { dimensions, tubes });
        }
    }

    fn begin_motion(&mut self, dimensions: &[(usize, &Target)]) {
        let claim = |dimensions| ArcClaim {
            is_general: !self.problem.is_distances_only(),
            dimensions,
            kept: Vec::new(),
        };
        let before = self.edits.take().map(|_| claim(Vec::new()));
        if let Some(dimensions) = self.led(dimensions) {
            let motion = claim(dimensions);
            self.motion = before.into_iter().chain([motion.clone()]).collect();
            self.put(Record::Motion(motion));
        }
    }

    fn end_arc(&mut self, run: &ArcRun) {
        let Some(Following {
            dimensions,
            mut tubes,
        }) = self.arc.take()
        else {
            return;
        };
        if matches!(run.end, ArcEnd::Passes(_) | ArcEnd::Stopped(_)) {
            while tubes.pop_if(|tube| !tube.low.is_empty()).is_some() {}
        }
        let kept = run
            .orientations
            .iter()
            .filter(|o| o.sign != 0 && o.lost.is_none());
        let kept = kept.map(|o| (o.points.iter().map(|&p| p as u32).collect(), o.sign > 0));
        let kept = kept.collect();
        self.put(Record::Arc(ArcClaim {
            is_general: !self.problem.is_distances_only(),
            dimensions,
            kept,
        }));
        self.tubes += tubes.len() as u64;
        for tube in tubes {
            self.put(Record::Tube(tube));
        }
        let figure = |figure: &Figure, wider: f64| {
            let radius = figure.radius.iter().zip(&figure.low);
            let radius: Vec<f64> = radius.map(|(r, low)| r + low.abs()).collect();
            solution_claim(&figure.centre, &radius, wider)
        };
        self.edits = Some(match &run.end {
            ArcEnd::Reached(reached) => {
                self.put(Record::Reached(figure(reached, WIDER)));
                Ok(())
            }
            ArcEnd::Limit(fold) => {
                let t = fold.t.mid();
                self.put(Record::Fold(FoldClaim {
                    figure: figure(&fold.figure, WIDER_AT_FOLDS),
                    t,
                    t_radius: (WIDER_AT_FOLDS * fold.t.rad() + 64.0 * ROUNDINGS) as f32,
                }));
                Ok(())
            }
            ArcEnd::Passes(reason) => Err(format!("branches seem to meet: {reason}")),
            ArcEnd::Stopped(reason) => Err(reason.text.clone()),
        });
    }

    fn end(&mut self, status: &Status, classes: &[usize]) {
        let ending = match status {
            Status::Closed => Ending::Complete,
            // The tubes that were written first are those of the second end.
            Status::Open(ends) => {
                let [behind, ahead] = &**ends;
                Ending::Open([ahead, behind].map(|end| shortened(&end.reason)))
            }
            Status::Stopped(reason) => Ending::Stopped(shortened(reason)),
        };
        match &ending {
            Ending::Stopped(_) => {
                for record in self.held.drain(..) {
                    match record {
                        Record::Tube(_) => self.tubes -= 1,
                        _ => self.solutions -= 1,
                    }
                }
            }
            Ending::Complete | Ending::Open(_) => self.release(),
        }
        // Those that were written are the first ones, and classes are numbered as they come.
        self.close(ending, &classes[..self.solutions.min(classes.len())]);
    }
}

/// Writes one record.
pub fn write_record(out: &mut impl Write, record: &Record) -> io::Result<()> {
    match record {
        Record::Tube(tube) => {
            out.write_all(&[if tube.low.is_empty() {
                TAG_TUBE
            } else {
                TAG_EXTENDED
            }])?;
            let centre = tube.centre.iter().chain(&tube.low);
            write_all(out, centre.map(|x| x.to_le_bytes()))?;
            write_all(out, tube.normal.iter().map(|x| x.to_le_bytes()))?;
            write_all(out, tube.weights.iter().map(|x| x.to_le_bytes()))?;
            out.write_all(&tube.h.to_le_bytes())?;
            out.write_all(&tube.r.to_le_bytes())?;
            out.write_all(&tube.exit.to_le_bytes())
        }
        Record::Solution(solution) => write_figure(out, TAG_SOLUTION, solution),
        Record::Turn => out.write_all(&[TAG_TURN]),
        Record::Divide => out.write_all(&[TAG_DIVIDE]),
        Record::Return => out.write_all(&[TAG_RETURN]),
        Record::Arc(arc) | Record::Motion(arc) => {
            out.write_all(&[match record {
                Record::Motion(_) => TAG_MOTION,
                _ if arc.is_general => TAG_ARC_OF_DIMENSIONS,
                _ => TAG_ARC,
            }])?;
            out.write_all(&(arc.dimensions.len() as u32).to_le_bytes())?;
            for (index, value) in &arc.dimensions {
                out.write_all(&index.to_le_bytes())?;
                write_text(out, &value.to_string())?;
            }
            out.write_all(&(arc.kept.len() as u32).to_le_bytes())?;
            for (points, positive) in &arc.kept {
                write_all(out, points.iter().map(|point| point.to_le_bytes()))?;
                out.write_all(&[(*positive).into()])?;
            }
            Ok(())
        }
        Record::Reached(figure) => write_figure(out, TAG_REACHED, figure),
        Record::Fold(fold) => {
            write_figure(out, TAG_FOLD, &fold.figure)?;
            out.write_all(&fold.t.to_le_bytes())?;
            out.write_all(&fold.t_radius.to_le_bytes())
        }
        Record::End(end) => {
            out.write_all(&[TAG_END])?;
            match &end.ending {
                Ending::Complete => out.write_all(&[0])?,
                Ending::Stopped(reason) => {
                    out.write_all(&[1])?;
                    write_text(out, reason)?;
                }
                Ending::Open(reasons) => {
                    out.write_all(&[2])?;
                    for reason in reasons {
                        write_text(out, reason)?;
                    }
                }
            }
            out.write_all(&end.tubes.to_le_bytes())?;
            out.write_all(&(end.classes.len() as u32).to_le_bytes())?;
            write_all(out, end.classes.iter().map(|class| class.to_le_bytes()))
        }
    }
}

/// Writes numbers, each as these bytes.
fn write_all<const N: usize>(
    out: &mut impl Write,
    mut numbers: impl Iterator<Item = [u8; N]>,
) -> io::Result<()> {
    numbers.try_for_each(|bytes| out.write_all(&bytes))
}

fn write_figure(out: &mut impl Write, tag: u8, figure: &SolutionClaim) -> io::Result<()> {
    out.write_all(&[tag])?;
    write_all(out, figure.centre.iter().map(|x| x.to_le_bytes()))?;
    out.write_all(&figure.radius.to_le_bytes())
}
