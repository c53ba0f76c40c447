//! `krawl all`: searches all figures that meet the dimensions.

use super::digits::ManyDigits;
use super::edit::say_if_it_moves;
use super::measured::{Measured, placed};
use super::output::{self, Beside, Refusal, number};
use super::pictures::Pictures;
use super::results::Results;
use super::take::{Candidates, Take, Taken};
use super::verify::check_cover;
use super::{CLOSED, INCOMPLETE, NOT_PROVED, STOPPED, input, interrupt};
use krawl::complete::{Complete, Keep, Options, Progress, Status, Tested, Unserved, all};
use krawl::constraint::Symmetry;
use krawl::problem::{Decimal, counted};
use krawl::report::{
    Document, ProgressLine, complete_to_table, conformers_to_table, conformers_told,
    digits_to_table, made_in_words,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Find all real solutions, with a proof that there is no other
///
/// The sketch's path plays no part: every figure that meets the dimensions is listed, up to rigid motions and
/// reflections where constraints do not say otherwise. "Complete" claims that these are all; "partial" and "flexible" say
/// what is undecided.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl all problems/disulfide.toml
  krawl all problems/disulfide.toml --html all.html --xyz all.xyz
  krawl all problems/k33.toml --pick 3 --out taken.toml   the file with the third figure in it
  krawl all problems/dodecagon.toml --store parts    ended at any moment, the same command goes on

Two machines share a search: one runs it with --store a --share 1/2, the other with --store b --share 2/2. Then
--store a --merge b, with neither share, brings both together.

Exit codes: 0 complete, 1 partial, flexible, not served yet or not decided which figures meet what was left out, 2 bad input, 3 or 4 the certificate
does not prove what is said (see `krawl verify --help`).")]
pub struct Arguments {
    /// The problem file (TOML), a molecule or a system of equations
    ///
    /// Molecules: .xyz, .mol, .sdf, .pdb, .ent. Systems: of PHCpack, msolve, Macaulay2 or HomotopyContinuation.jl;
    /// the text tells which.
    file: PathBuf,
    #[command(flatten)]
    which: input::Which,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the proof as a certificate, and check it
    ///
    /// It says why there is no other solution, part by part of the space searched, and is checked as `verify` does.
    /// Where it does not pass, the exit code is that of `verify`; where it proves what the search left open, the set
    /// is complete
    #[arg(long, value_name = "FILE")]
    cert: Option<PathBuf>,
    /// Do not check the certificate that was written
    #[arg(long, requires = "cert", hide_short_help = true)]
    no_verify: bool,
    /// Threads to use [default: one per processor]; the solutions do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Stop after so many seconds, and say what is undecided
    #[arg(long, value_name = "S", value_parser = seconds)]
    time: Option<f64>,
    /// Keep what is done in this folder, and go on from there the next time
    ///
    /// The folder is made where there is none: whenever the search is ended, the same command goes on there
    #[arg(long, value_name = "DIR")]
    store: Option<PathBuf>,
    /// Search the K-th of N shares only, and leave the others to other machines
    #[arg(long, value_name = "K/N", value_parser = share, requires = "store", hide_short_help = true)]
    share: Option<[usize; 2]>,
    /// Take over what another store of the same search has
    ///
    /// Its folder, or the file in it; may be given several times
    #[arg(long, value_name = "PATH", requires = "store", hide_short_help = true)]
    merge: Vec<PathBuf>,
    /// How far constraints left out of the search may be missed
    ///
    /// Of more distances than are needed those that were left out count as met where a figure misses them by no more
    /// than this, in the unit of the file [default: half a unit of the last digit that the file gives a distance
    /// with]
    #[arg(long, value_name = "X", value_parser = seconds, hide_short_help = true)]
    redundant_tolerance: Option<f64>,
    /// Look for figures whatever their signs are
    ///
    /// Whatever `orientation` asks for, and the chirality that a molecule has in its file
    #[arg(long, hide_short_help = true)]
    any_signs: bool,
    /// Look for solutions in which an unknown is in a range, `x=0..2`; one end may be left out
    ///
    /// In place of the range that the file gives it; may be given several times
    #[arg(long, value_name = "X=FROM..TO", value_parser = range, hide_short_help = true)]
    within: Vec<(String, [Option<Decimal>; 2])>,
    #[command(flatten)]
    take: Take,
    #[command(flatten)]
    measured: Measured,
    #[command(flatten)]
    many: ManyDigits,
    #[command(flatten)]
    pictures: Pictures,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    let must = "must be a number greater than 0";
    number(text, |x| *x > 0.0 && *x < 1e9, must)
}

fn share(text: &str) -> Result<[usize; 2], String> {
    let numbers = text
        .split_once('/')
        .and_then(|(k, n)| Some([k.parse().ok()?, n.parse().ok()?]));
    match numbers {
        Some([k, n]) if (1..=n).contains(&k) && n <= 1000 => Ok([k, n]),
        _ => Err("must be K/N, the K-th of N shares: 1/4, 2/4, 3/4, 4/4; at most 1000".to_owned()),
    }
}

fn range(text: &str) -> Result<(String, [Option<Decimal>; 2]), String> {
    let must = "must be an unknown and between which numbers it is to be: x=0..2, x=0.. or x=..2";
    let parts = text.split_once('=');
    let (name, range) = parts
        .filter(|(name, _)| !name.trim().is_empty())
        .ok_or(must)?;
    let (low, high) = range.split_once("..").ok_or(must)?;
    let end = |text: &str| match text.trim() {
        "" => Ok(None),
        text => text
            .parse()
            .map(Some)
            .map_err(|error| format!("`{text}`: {error}")),
    };
    match [end(low)?, end(high)?] {
        [None, None] => Err(must.to_owned()),
        ends => Ok((name.trim().to_owned(), ends)),
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, Refusal> {
    let (file, which) = (&arguments.file, &arguments.which);
    arguments.take.check(file)?;
    let tolerance = arguments.redundant_tolerance;
    let asked = input::asked((file, which), tolerance, arguments.any_signs)?;
    let mut problem = asked.problem;
    for (name, ends) in &arguments.within {
        let restricted = problem.restrict(name, ends.clone());
        restricted.map_err(|why| format!("{}: --within: {why}", file.display()))?;
    }
    let problem = problem;
    let measures = arguments.measured.of(&problem)?;
    let named = [arguments.json.as_deref(), None];
    let mut results = Results::open([file], named, &arguments.pictures, arguments.quiet)?;
    output::refuse_read([file], arguments.cert.as_deref())?;
    if let Some(cert) = &arguments.cert
        && Some(cert) == arguments.json.as_ref()
    {
        let cert = cert.display();
        let what = "is the file of both --cert and --json; name another one for one of them";
        return Err(format!("{cert}: {what}").into());
    }
    // Before any file is begun, so that an interrupt leaves none behind.
    interrupt::flag();
    let cert = arguments.cert.as_deref().map(Beside::new).transpose()?;
    let line = ProgressLine::new(!arguments.quiet, "");
    let begin = Instant::now();
    let tell = |now: Progress| line.show_search(now, begin.elapsed().as_secs_f64());
    let options = Options {
        cancel: Some(interrupt::flag()),
        time: arguments.time.map(Duration::from_secs_f64),
        cover: cert.is_some(),
        threads: arguments.threads.unwrap_or(0).into(),
        within_digits: true,
        redundant_tolerance: tolerance,
        progress: Some(&tell),
        store: arguments.store.as_ref().map(|folder| Keep {
            folder: folder.clone(),
            share: arguments.share,
            merge: arguments.merge.clone(),
        }),
        ..Options::default()
    };
    if results.is_told() {
        say_if_it_moves(&problem);
    }
    let result = match &asked.surplus {
        Some(surplus) => surplus.search(&options),
        None => all(&problem, &options),
    };
    line.clear();
    let mut result = result.map_err(|unserved| match unserved {
        Unserved::Store(what) => Refusal::from(what),
        unserved => Refusal {
            message: format!("{}: {unserved}", arguments.file.display()),
            code: STOPPED,
        },
    })?;
    let mut checked = Checked::default();
    match (&cert, result.cover.take()) {
        (Some(beside), Some(cover)) => {
            let is_there = beside.write(&cover);
            results.note(is_there);
            if let Some(path) = &arguments.cert
                && is_there
                && !arguments.no_verify
            {
                checked = check(arguments, (path, &cover), &mut result);
            }
        }
        (Some(_), None) => output::complain(match result.reason {
            Some(_) => "no certificate is written: the reason above is proved without a search",
            None => {
                "no certificate is written: the checker's test is too coarse for a solution, or two are too near each \
                 other for it"
            }
        }),
        _ => {}
    }
    let figures = || result.solutions.iter().map(placed);
    let either = result.symmetry == Symmetry::Isometries;
    let conformers = asked
        .skeleton
        .filter(|_| results.are_read())
        .map(|skeleton| {
            let solutions = result.solutions.iter();
            let figures: Vec<_> = solutions.map(|solution| &solution.points[..]).collect();
            let conformers = skeleton.conformers(&figures, either);
            (skeleton, conformers)
        });
    let many = arguments
        .many
        .of(&problem, &result.reference, &result.solutions);
    results.write(|| {
        let conformers = conformers.as_ref();
        let mut document = Document::all(&problem, &result, &asked.made);
        document.beside.measures = measures.told(figures());
        document.beside.conformers = conformers.map(|(of, all)| conformers_told(&problem, of, all));
        document.beside.digits = arguments.many.told(&problem, &many);
        document
    })?;
    results.print(|| {
        let mut text = complete_to_table(&problem, &result);
        text += &measures.to_table("", figures());
        if let Some((skeleton, conformers)) = &conformers {
            text += &conformers_to_table(&problem, skeleton, conformers);
        }
        text += &digits_to_table(&problem, 1, &many);
        let made = made_in_words(&asked.made);
        if !made.is_empty() {
            text += &format!("\n{made}\n");
        }
        text + &checked.text
    });
    let count = result.solutions.len() as u64;
    let listed = Candidates {
        count,
        first: None,
        is_all: result.count == Some(count),
    };
    let figure = |number| Taken::of(&problem, &result.solutions[number as usize], either);
    let take = &arguments.take;
    results.note(take.write((file, which), &problem, listed, figure));
    let is_decided = result.tested.as_ref().is_none_or(Tested::is_decided);
    let of_status = match result.status {
        Status::Complete if is_decided => CLOSED,
        _ => STOPPED,
    };
    Ok(results.code(checked.code.unwrap_or(of_status)))
}

/// What comes of the check of a certificate.
#[derive(Default)]
struct Checked {
    /// What is said of it behind the table.
    text: String,
    /// The exit code, where it does not pass.
    code: Option<u8>,
}

/// Checks the certificate that was written, and takes over what it proves beyond the search. Whatever comes of it, the results are there to be told.
fn check(arguments: &Arguments, (path, cover): (&Path, &[u8]), result: &mut Complete) -> Checked {
    let (name, clock) = (path.display(), Instant::now());
    let complain = |what: String, code: Option<u8>| {
        output::complain(&format!("{name}: {what}"));
        let text = String::new();
        Checked { text, code }
    };
    let verdict = match interrupt::is_requested() {
        true => None,
        false => Some(check_cover(
            cover,
            arguments.threads,
            arguments.quiet,
            || !interrupt::is_requested(),
        )),
    };
    let verdict = match verdict.filter(|_| !interrupt::is_requested()) {
        Some(Ok(verdict)) => verdict,
        Some(Err(why)) => {
            let what = format!("the certificate could not be checked: {why}; please report this");
            return complain(what, Some(NOT_PROVED));
        }
        None => {
            let what = format!(
                "the certificate was not checked, as the run was ended; `krawl verify {name}` does that"
            );
            return complain(what, None);
        }
    };
    let not_passed = |what: String, code| {
        let what = format!("the certificate does not pass the checker. {what}");
        complain(what, Some(code))
    };
    if let Some(flaw) = &verdict.flaw {
        return not_passed(format!("NOT PROVED: {flaw}"), NOT_PROVED);
    }
    if verdict.undecided > 0 && result.status == Status::Complete {
        let left = counted(verdict.undecided as usize, "part");
        return not_passed(
            format!("INCOMPLETE: it leaves {left} undecided"),
            INCOMPLETE,
        );
    }
    let left: u64 = result.undecided.iter().map(|part| part.count).sum();
    let seconds = clock.elapsed().as_secs_f64();
    let text = match result.settle(&verdict) {
        true => format!(
            "\nThe search had left {} open. The check of the certificate in {name} decided all of that, in {seconds:.2} s.\n",
            counted(left as usize, "part")
        ),
        false => format!(
            "\nThe certificate in {name} was checked in {seconds:.2} s: it proves this again{}.\n",
            match result.tested {
                _ if result.signed.is_some() => ", but of figures with any signs",
                Some(_) => ", of the constraints used",
                None => "",
            }
        ),
    };
    Checked { text, code: None }
}
