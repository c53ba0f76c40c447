//! Writing a certificate while a run goes on.

use super::format::{
    EndClaim, MAGIC, MAX_FREE_COORDINATES, MAX_TEXT, Record, SolutionClaim, TAG_END,
    TAG_MOVING_KRAWCZYK, TAG_SOLUTION, TubeClaim, VERSION, WEIGHT_UNIT,
};
use crate::problem::Problem;
use crate::track::{LARGEST_SQUARE, Status, TubeSeen, Witness};
use sha2::{Digest, Sha256};
use std::io::{self, Write};

// What runs prove can be read again.
const _: () = assert!(LARGEST_SQUARE <= MAX_FREE_COORDINATES);

/// Boxes are written wider than they were proved, by this factor and by a few roundings of the
/// largest coordinate, so that a checker that rounds more coarsely has room; the claim is weaker,
/// not stronger.
const WIDER: f64 = 2.0;
/// See [`WIDER`].
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// Writes what a certified run lets it see: to be given to [`crate::track::Control::witness`].
///
/// Nothing is kept in memory. Errors are kept until [`Writer::finish`].
#[derive(Debug)]
pub struct Writer<'a, W> {
    out: W,
    problem: &'a Problem,
    tubes: u64,
    solutions: usize,
    /// A tube came that the format cannot hold: the rest is left out.
    cut: bool,
    ended: bool,
    result: io::Result<()>,
}

impl<'a, W: Write> Writer<'a, W> {
    /// A certificate of this problem, to be written to `out`, which should be buffered.
    pub fn new(out: W, problem: &'a Problem) -> Self {
        Writer {
            out,
            problem,
            tubes: 0,
            solutions: 0,
            cut: false,
            ended: false,
            result: Ok(()),
        }
    }

    /// Whether the certificate ends before the run did, as tubes came that were proved in extended
    /// precision: it is then one of a path that was not followed to its end.
    pub fn is_cut(&self) -> bool {
        self.cut
    }

    /// Hands the stream back once the run is over. Fails where writing did, or where no
    /// certified run has come to its end.
    pub fn finish(mut self) -> io::Result<W> {
        self.result?;
        if !self.ended {
            return Err(io::Error::other("the run left no proof"));
        }
        self.out.flush()?;
        Ok(self.out)
    }

    fn put(&mut self, record: &Record) {
        if self.result.is_ok() {
            self.result = write_record(&mut self.out, record);
        }
    }
}

impl<W: Write> Witness for Writer<'_, W> {
    fn begin(&mut self, unit: f64) {
        let exponent = unit.log2() as i16;
        let program = concat!("krawl ", env!("CARGO_PKG_VERSION"));
        self.result = write_header(&mut self.out, program, &self.problem.to_toml(), exponent);
    }

    fn tube(&mut self, tube: TubeSeen) {
        if tube.extended || self.cut {
            self.cut = true;
            return;
        }
        self.tubes += 1;
        let weight = |&u: &f64| (u / WEIGHT_UNIT).round().clamp(1.0, u16::MAX.into()) as u16;
        self.put(&Record::Tube(TubeClaim {
            centre: tube.centre.to_vec(),
            normal: tube.normal.iter().map(|&c| c as f32).collect(),
            weights: tube.weights.iter().map(weight).collect(),
            h: tube.h,
            r: tube.r as f32,
            exit: tube.exit,
        }));
    }

    fn solution(&mut self, centre: &[f64], radius: &[f64]) {
        if self.cut {
            return;
        }
        self.solutions += 1;
        let largest = |v: &[f64]| v.iter().fold(0.0, |max: f64, x| max.max(x.abs()));
        self.put(&Record::Solution(SolutionClaim {
            centre: centre.to_vec(),
            radius: (WIDER * largest(radius) + ROUNDINGS * largest(centre)) as f32,
        }));
    }

    fn end(&mut self, status: &Status, classes: &[usize]) {
        let stopped = match status {
            _ if self.cut => Some(format!(
                "the next tube was proved in extended precision, which certificates cannot hold: \
                 this one ends after {} tubes, and the run {}",
                self.tubes,
                match status {
                    Status::Closed => "went on and closed",
                    Status::Open(_) | Status::Stopped(_) => "went on, but did not close",
                }
            )),
            Status::Closed => None,
            Status::Open(_) => Some(
                "the path is open: this is its way from the sketch in the direction of travel"
                    .to_owned(),
            ),
            Status::Stopped(reason) => {
                let end = (0..=reason.len().min(MAX_TEXT)).rev();
                let end = end.into_iter().find(|&end| reason.is_char_boundary(end));
                Some(reason[..end.unwrap_or(0)].to_owned())
            }
        };
        // Those that were written are the first ones, and classes are numbered as they come.
        let classes = &classes[..self.solutions.min(classes.len())];
        self.put(&Record::End(EndClaim {
            stopped,
            tubes: self.tubes,
            classes: classes.iter().map(|&c| c as u32).collect(),
        }));
        self.ended = true;
    }
}

/// Writes what stands before the records: the problem as the text of a problem file.
pub fn write_header(
    out: &mut impl Write,
    program: &str,
    problem: &str,
    unit_exponent: i16,
) -> io::Result<()> {
    out.write_all(MAGIC)?;
    out.write_all(&VERSION.to_le_bytes())?;
    write_text(out, program)?;
    out.write_all(&Sha256::digest(problem.as_bytes()))?;
    write_text(out, problem)?;
    out.write_all(&unit_exponent.to_le_bytes())
}

/// Writes one record.
pub fn write_record(out: &mut impl Write, record: &Record) -> io::Result<()> {
    match record {
        Record::Tube(tube) => {
            out.write_all(&[TAG_MOVING_KRAWCZYK])?;
            for x in &tube.centre {
                out.write_all(&x.to_le_bytes())?;
            }
            for x in &tube.normal {
                out.write_all(&x.to_le_bytes())?;
            }
            for x in &tube.weights {
                out.write_all(&x.to_le_bytes())?;
            }
            out.write_all(&tube.h.to_le_bytes())?;
            out.write_all(&tube.r.to_le_bytes())?;
            out.write_all(&tube.exit.to_le_bytes())
        }
        Record::Solution(solution) => {
            out.write_all(&[TAG_SOLUTION])?;
            for x in &solution.centre {
                out.write_all(&x.to_le_bytes())?;
            }
            out.write_all(&solution.radius.to_le_bytes())
        }
        Record::End(end) => {
            out.write_all(&[TAG_END, end.stopped.is_some().into()])?;
            if let Some(reason) = &end.stopped {
                write_text(out, reason)?;
            }
            out.write_all(&end.tubes.to_le_bytes())?;
            out.write_all(&(end.classes.len() as u32).to_le_bytes())?;
            for class in &end.classes {
                out.write_all(&class.to_le_bytes())?;
            }
            Ok(())
        }
    }
}

fn write_text(out: &mut impl Write, text: &str) -> io::Result<()> {
    out.write_all(&(text.len() as u32).to_le_bytes())?;
    out.write_all(text.as_bytes())
}
