//! What is told of a file: in text, as a line of JSON and as pictures.

use super::asked::Asked;
use super::blocks::{Unbounded, follow_blocks};
use super::hints::hints;
use super::path::{follow, follow_finely, follow_first, samples_for};
use super::{Arguments, input, interrupt};
use crate::cli::edit::say_if_it_moves;
use crate::cli::measured::placed;
use crate::cli::output::{self, Beside};
use crate::cli::results::Results;
use crate::cli::take::{Candidates, Taken};
use crate::cli::{BAD_INPUT, CLOSED, LIMIT, OPEN, STOPPED};
use krawl::blocks::{Seen, clusters};
use krawl::complete::{Among, Tested, among};
use krawl::edit::{Alone, Decomposition, alone};
use krawl::problem::Problem;
use krawl::report::document::{AloneEnding, Beside as More, Solve};
use krawl::report::{
    BlockRuns, Document, Run, alone_in_words, among_in_words, digits_to_table, part_in_words,
    signed_in_words, to_first_table, to_no_first, to_short_table, to_summary, to_table,
};
use krawl::track::{Control, Limit, Mode, Options, Outcome, Signs, Status, Trace};
use std::path::Path;
use std::time::{Duration, Instant};

/// Where results go, and what came of all files so far.
pub(super) struct Told<'a> {
    pub arguments: &'a Arguments,
    pub results: Results<'a>,
    pub cert: Option<Beside>,
    /// Results as JSON, a line for each.
    pub lines: String,
    /// The gravest exit code.
    pub worst: u8,
}

/// The graver of two exit codes.
pub(super) fn worse(one: u8, other: u8) -> u8 {
    match (one, other) {
        (BAD_INPUT, _) | (_, BAD_INPUT) => BAD_INPUT,
        (STOPPED, _) | (_, STOPPED) => STOPPED,
        (CLOSED, code) => code,
        (code, _) => code,
    }
}

/// Says that a drawing in its own frame is singular, which the blocks tell of those that are solved by them.
fn say_if_singular(problem: &Problem) {
    let found = match problem.is_absolute() {
        true => Decomposition::of(problem).ok(),
        false => None,
    };
    let singular = found.and_then(|found| found.singular);
    if let Some(singular) = singular.filter(|singular| singular.seen == Seen::Regular) {
        let place = singular.place_in_a_sentence();
        output::print(&format!("{}: {place}.\n\n", problem.name));
    }
}

impl Told<'_> {
    /// Answers what is asked of the file of a number. Whether the rest is not wanted any more.
    pub fn answer(&mut self, k: usize, asked: &Asked, file: &Path) -> Result<bool, String> {
        let (arguments, problem) = (self.arguments, &asked.problem);
        // That these are none is said first.
        arguments.measured.of(problem)?;
        if self.results.is_told() && !arguments.summary {
            say_if_it_moves(problem);
            if !asked.is_by_blocks {
                say_if_singular(problem);
            }
        }
        let gap = match k == 0 || arguments.summary {
            true => "",
            false => "\n",
        };
        match asked.is_by_blocks {
            true => self.by_blocks(problem, file, gap).map(|()| false),
            false => {
                let which = output::which_of((k, arguments.files.len()), file);
                self.path(asked, (file, &which), gap)
            }
        }
    }

    /// Tells a result that is whole.
    fn tell(
        &mut self,
        result: impl FnOnce() -> Document,
        text: impl FnOnce() -> String,
        code: u8,
    ) -> Result<(), String> {
        if self.results.are_written() {
            let result = result();
            self.results.write_page(&result)?;
            if self.results.has_json() {
                self.lines += &(result.to_json() + "\n");
            }
        }
        self.results.print(text);
        self.worst = worse(self.worst, code);
        Ok(())
    }

    /// A problem that is solved block by block from the start.
    fn by_blocks(&mut self, problem: &Problem, file: &Path, gap: &str) -> Result<(), String> {
        let arguments = self.arguments;
        let found = match arguments.by_blocks(problem) {
            Ok(found) => found,
            // What came of other files is not lost.
            Err(error) => {
                let all = match input::is_sketch(file) {
                    true => "",
                    false => "; `krawl all` may take it",
                };
                output::complain(&format!("{}: {error}{all}", input::name(file)));
                self.worst = worse(self.worst, BAD_INPUT);
                return Ok(());
            }
        };
        self.results
            .note(arguments.take_of(&found, (problem, file)));
        let alone = match found.figures.count() == Some(0) && self.results.are_read() {
            true => arguments.alone(problem),
            false => Vec::new(),
        };
        let document = || {
            let mut document = found.document();
            document.beside.alone = alone.iter().map(AloneEnding::new).collect();
            document
        };
        let text = || format!("{gap}{}{}", found.text, alone_in_words(&alone));
        self.tell(document, text, found.code)
    }

    /// A problem that stopped, or whose path says nothing, block by block after all. False: it does not fall apart.
    fn cut(
        &mut self,
        (problem, outcome): (&Problem, &Outcome),
        (file, which): (&Path, &str),
        gap: &str,
    ) -> Result<bool, String> {
        let arguments = self.arguments;
        let unbounded = Unbounded::of(&outcome.status);
        let reason = match &outcome.status {
            Status::Stopped(reason) => Some(&*reason.text),
            _ => unbounded
                .filter(|_| problem.is_absolute())
                .map(|path| path.reason),
        };
        let Some(reason) = reason else {
            return Ok(false);
        };
        let options = &arguments.options();
        if problem.is_absolute()
            && let Some(found) = arguments.instead(problem, reason, unbounded)
        {
            self.results
                .note(arguments.take_of(&found, (problem, file)));
            let document = || {
                let mut whole = Solve::of(&Run::new(problem, options, outcome));
                whole.by_blocks = Some(Box::new(found.document()));
                whole.document(problem)
            };
            let text = || match arguments.cert {
                // What the certificate is about.
                Some(_) => format!(
                    "{gap}{}\nThe path of the whole, as far as it was followed:\n\n{}",
                    found.text,
                    arguments.shown(problem, outcome, None)
                ),
                None => format!("{gap}{}", found.text),
            };
            self.tell(document, text, found.code)?;
            return Ok(true);
        }
        // What is asked for may be a certificate of the whole.
        if arguments.cert.is_some() || unbounded.is_some() {
            return Ok(false);
        }
        let blocks = clusters(problem);
        if blocks.is_empty() {
            return Ok(false);
        }
        let name = input::name(file);
        let (runs, code) = follow_blocks(arguments, blocks, &name, which)?;
        let all = BlockRuns {
            problem,
            reason,
            options,
            runs: &runs,
        };
        let document = || all.document(outcome, arguments.all);
        let text = || {
            let hints = hints(problem, outcome, &name);
            format!("{gap}{}{hints}", arguments.shown_blocks(&all))
        };
        self.tell(document, text, code)?;
        if arguments.take.is_wanted()
            || !arguments.measured.is_empty()
            || arguments.many.is_wanted()
        {
            let what = "the solutions listed are of parts of the figure, none of which is written, measured or told to more digits";
            output::complain(&format!("{name}: {what}"));
            self.results.note(false);
        }
        Ok(true)
    }

    /// A problem whose path is followed as a whole. Whether an interrupt ended the run.
    fn path(
        &mut self,
        asked: &Asked,
        (file, which): (&Path, &str),
        gap: &str,
    ) -> Result<bool, String> {
        let (arguments, problem) = (self.arguments, &asked.problem);
        let name = input::name(file);
        let measures = arguments.measured.of(problem)?;
        let is_certified = arguments.mode == Mode::Certified;
        let mut trace = Trace::default();
        let shown = !self.results.pictures.is_empty();
        let wants_path = (self.results.has_json() || shown) && is_certified;
        let samples = match arguments.samples {
            Some(samples) => samples,
            None if arguments.pictures.want_path() => samples_for(problem),
            None => 0,
        };
        let mut turns_at = None;
        let (mut outcome, well, verdict) = if arguments.first && !shown && samples == 0 {
            let found = follow_first(arguments, problem, &name, which)?;
            turns_at = found.turns_at;
            (found.outcome, true, None)
        } else {
            let trace = wants_path.then_some(&mut trace);
            follow(arguments, problem, &name, which, self.cert.as_ref(), trace)?
        };
        self.results.note(well);
        let surplus = asked.surplus.as_ref();
        let tested = surplus.map(|surplus| surplus.test(&mut outcome));
        let tested = tested.as_ref();
        Signs::of(problem).test(&mut outcome, problem.dimension);
        let signed = outcome.signed.unwrap_or_default();
        let missed = tested.map_or(0, |tested| tested.missed as u64);
        let struck = signed.wrong + signed.undecided + signed.mirrored as u64 + missed;
        // Signs may be of points of several blocks.
        let is_plain = tested.is_none() && problem.orientations.is_empty();
        let can_be_cut = is_certified && !arguments.first && !interrupt::is_requested() && is_plain;
        if can_be_cut && self.cut((problem, &outcome), (file, which), gap)? {
            return Ok(false);
        }
        if wants_path
            && samples > 0
            && let Some(finer) = follow_finely(arguments, problem, which, &mut outcome)
        {
            trace = finer;
        }
        let first = match arguments.first {
            true => to_first_table(problem, &outcome),
            false => None,
        };
        let mut solutions = outcome.solutions.iter();
        let direct = solutions.position(|s| s.place.is_some_and(|p| p.folds == Some(0)));
        let listed = match (arguments.first, direct) {
            (true, Some(k)) => k..k + 1,
            (true, None) => 0..0,
            _ => 0..outcome.solutions.len(),
        };
        let reference = &problem.homotopy.reference;
        let many = arguments.many.of(problem, reference, &outcome.solutions);
        let candidates = Candidates {
            count: match listed.is_empty() {
                true => 0,
                false => outcome.solutions.len() as u64,
            },
            first: direct.filter(|_| arguments.first).map(|k| k as u64),
            is_all: true,
        };
        let from = (file, &arguments.which);
        let figure = |number| Taken::of(problem, &outcome.solutions[number as usize], false);
        self.results
            .note(arguments.take.write(from, problem, candidates, figure));
        let is_tested = tested.is_none_or(Tested::is_decided);
        let is_undecided = is_certified && (!is_tested || signed.undecided > 0);
        self.worst = match (&outcome.status, self.worst) {
            (_, BAD_INPUT) => BAD_INPUT,
            (_, worst) if first.is_some() && !is_undecided => worst,
            (_, worst) if arguments.first && struck > 0 => worse(worst, LIMIT),
            (_, worst) if turns_at.is_some() => worse(worst, LIMIT),
            (Status::Stopped(_), _) | (_, STOPPED) => STOPPED,
            // Float runs do not tell which of their solutions is reached without a fold.
            _ if arguments.first && !is_certified => STOPPED,
            // The path comes back, or ends, and has no such solution.
            _ if arguments.first => LIMIT,
            _ if is_undecided => STOPPED,
            (Status::Open(_), _) => OPEN,
            // A certificate that does not pass its check.
            (Status::Closed, CLOSED) => verdict.unwrap_or(CLOSED),
            (Status::Closed, worst) => worst,
        };
        let options = arguments.options();
        let run = Run {
            trace: wants_path.then_some(&trace),
            samples,
            tested,
            ..Run::new(problem, &options, &outcome)
        };
        let mut document = self.results.are_written().then(|| Document::solve(&run));
        if let Some(document) = &document {
            self.results.write_page(document)?;
        }
        self.results.print(|| {
            let part = tested.map_or_else(String::new, |tested| part_in_words(tested) + "\n");
            let summary = || to_summary(problem, &outcome, tested);
            let text = match (first, arguments.first) {
                (Some(text), _) => text + &part,
                // It is there, and no figure of the problem.
                (None, true) if struck > 0 => {
                    let signed = signed_in_words("the figures that were come to", &outcome);
                    let name = &problem.name;
                    format!("{name}: No solution is reached without a fold.{signed}\n{part}")
                }
                (None, true) if turns_at.is_some() => to_no_first(problem, turns_at),
                (None, true) if !is_certified => format!(
                    "{}: which solution is reached without a fold, if any, is told by certified mode alone: leave out \
                     `--mode float`, or without `--first` see all that floats find ({})\n",
                    problem.name,
                    summary().trim_end()
                ),
                (None, true) => format!(
                    "{}: no solution without a fold: the path turns back before, or could not be followed that far ({})\n",
                    problem.name,
                    summary().trim_end()
                ),
                (None, false) => arguments.shown(problem, &outcome, tested),
            };
            let of = match is_certified {
                true => "",
                false => ", without proof",
            };
            let measured =
                measures.to_table(of, outcome.solutions[listed.clone()].iter().map(placed));
            let many = digits_to_table(
                problem,
                listed.start + 1,
                many.get(listed).unwrap_or_default(),
            );
            let hints = hints(problem, &outcome, &name);
            let whole = arguments.whole_in_words(file);
            format!("{gap}{whole}{text}{measured}{many}{hints}")
        });
        // What the path came to is out by now.
        let is_told = self.results.are_read() && tested.is_none();
        let has_none = outcome.status == Status::Closed && outcome.solutions.is_empty();
        let alone = match has_none && is_told && struck == 0 {
            true => arguments.alone(problem),
            false => Vec::new(),
        };
        self.results.print(|| alone_in_words(&alone));
        let among = arguments.among(problem, &outcome, is_told);
        if let Some(among) = among.filter(|_| !arguments.summary) {
            self.results.print(|| among_in_words(among));
        }
        if let Some(document) = document.as_mut().filter(|_| self.results.has_json()) {
            let figures = outcome.solutions.iter().map(placed);
            document.beside = More {
                of_all: among.map(|among| among.all),
                alone: alone.iter().map(AloneEnding::new).collect(),
                measures: measures.told(figures),
                digits: arguments.many.told(problem, &many),
                conformers: None,
            };
            self.lines += &(document.to_json() + "\n");
        }
        Ok(interrupt::is_requested())
    }
}

impl Arguments {
    /// What one dimension can do alone where the path has no figure with all of them; nothing where that is not asked for, or there
    /// are many.
    fn alone(&self, problem: &Problem) -> Vec<Alone> {
        const MOST_DIMENSIONS: usize = 64;
        const MOST_TUBES: usize = 300;
        const LONGEST: Duration = Duration::from_secs(1);
        let is_asked = self.mode == Mode::Certified && !self.summary && !self.first;
        if !is_asked || problem.dimensions().count() > MOST_DIMENSIONS {
            return Vec::new();
        }
        let options = Options {
            max_steps: MOST_TUBES,
            ..self.options()
        };
        let mut control = Control {
            limit: Some(Limit {
                length: f64::INFINITY,
                deadline: Instant::now() + LONGEST,
            }),
            ..interrupt::control()
        };
        alone(problem, &options, &mut control)
    }

    /// How many of all figures the path has, where that is wanted and costs little.
    fn among(&self, problem: &Problem, outcome: &Outcome, is_told: bool) -> Option<Among> {
        let is_asked = !self.no_count && !self.first && self.mode == Mode::Certified;
        let is_wanted = is_told && is_asked && problem.orientations.is_empty();
        is_wanted.then(|| among(problem, outcome))?
    }

    pub(super) fn shown(
        &self,
        problem: &Problem,
        outcome: &Outcome,
        tested: Option<&Tested>,
    ) -> String {
        match (self.summary, self.all) {
            (true, _) => to_summary(problem, outcome, tested),
            (false, true) => to_table(problem, outcome, tested),
            (false, false) => to_short_table(problem, outcome, tested),
        }
    }
}
