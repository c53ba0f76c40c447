//! `krawl verify`: checks a certificate and prints the theorem that it proves.

use super::{BAD_INPUT, CLOSED, INCOMPLETE, NOT_PROVED, REFUTED, input, output};
use krawl::blocks::{Account, rounded_up};
use krawl::certificate::complex::{ComplexFlaw, verify_complex_set};
use krawl::certificate::cover::{CoverVerdict, verify_cover_while};
use krawl::certificate::{Compared, Contents, Outcome, Settings, Stage, contents, verify};
use krawl::edit::with_turns_of;
use krawl::problem::Problem;
use krawl::report::{ProgressLine, complex_set_theorem, cover_theorem, theorem};
use std::fs::File;
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// Prove all claims of a certificate again
#[derive(clap::Args, Clone)]
#[command(after_long_help = "\
Examples:
  krawl verify proof.krawl
  krawl verify proof.krawl sketch.toml    and it is about this problem

Exit codes: 0 verified; 1 refuted, a claim in it is false or it is about another problem than FILE; 2 not a
certificate; 3 not proved, a claim may be true but the checker's test is too coarse for it; 4 incomplete, the
proof of a run that stopped, true as far as it goes.")]
pub struct Arguments {
    /// The certificate, as `--cert` of a verb writes it
    cert: PathBuf,
    /// The problem that the certificate has to be about
    ///
    /// A problem file (TOML), or a sketch of SolveSpace (.slvs) or FreeCAD (.FCStd)
    file: Option<PathBuf>,
    #[command(flatten)]
    which: input::Which,
    /// Threads to use [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Give up after so many seconds
    ///
    /// Then nothing is said of the certificate but that it was not checked to its end (exit code 3)
    #[arg(long, value_name = "S", value_parser = super::all::seconds)]
    time: Option<f64>,
    /// Print nothing: the exit code tells
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let Some(seconds) = arguments.time else {
        return check(arguments);
    };
    // A check that is not over has nothing to tell, so that it need not be ended: the program ends.
    let (sender, receiver) = mpsc::channel();
    let checked = arguments.clone();
    std::thread::spawn(move || sender.send(check(&checked)));
    match receiver.recv_timeout(Duration::from_secs_f64(seconds)) {
        Ok(checked) => checked,
        Err(mpsc::RecvTimeoutError::Timeout) => {
            let name = arguments.cert.display();
            output::complain(&format!(
                "{name}: NOT PROVED: the check had not come to its end after {seconds} s (--time)"
            ));
            Ok(NOT_PROVED)
        }
        Err(mpsc::RecvTimeoutError::Disconnected) => Ok(BAD_INPUT),
    }
}

fn check(arguments: &Arguments) -> Result<u8, String> {
    let name = arguments.cert.display();
    let file = File::open(&arguments.cert).map_err(|e| format!("{name}: cannot be read: {e}"))?;
    let opened = contents(BufReader::new(file)).map_err(|error| format!("{name}: {error}"));
    let (contents, mut file) = opened?;
    let file_of = arguments.file.as_ref();
    if file_of.is_none() && (arguments.which.sketch.is_some() || arguments.which.heavy) {
        return Err("--sketch and --heavy say what of FILE is meant: name it, too".to_owned());
    }
    let of_file = || {
        let found = file_of.map(|path| of_file(path, &arguments.which, contents));
        found.transpose()
    };
    if contents != Contents::Path {
        let of_file = of_file()?;
        let of_file = of_file.as_deref();
        let mut bytes = Vec::new();
        let read = file.read_to_end(&mut bytes);
        read.map_err(|e| format!("{name}: cannot be read: {e}"))?;
        let proved = match contents {
            Contents::Cover => verify_the_cover(arguments, &bytes)?,
            _ => verify_the_set(arguments, &bytes)?,
        };
        let found = compare(of_file, proved.is_about);
        let of_it = |file: &Path| of_the_set(file, proved.compared, found.as_ref());
        let said = (proved.text, proved.code);
        let of_file = (of_file, false);
        return Ok(conclude(arguments, said, (found.is_some(), of_it), of_file));
    }
    let settings = Settings {
        threads: arguments.threads.unwrap_or(0).into(),
    };
    let clock = Instant::now();
    let line = ProgressLine::new(!arguments.quiet, "");
    let mut show = |stage: Stage| line.show_check(stage.tubes, stage.solutions);
    let verdict = verify(file, &settings, &mut show);
    line.clear();
    let verdict = verdict.map_err(|error| format!("{name}: {error}"))?;
    if verdict.motion.is_some() {
        // Nothing is held in it.
        let loaded = file_of.map(|path| input::load(path, &arguments.which));
        let of_file = loaded.transpose()?.map(|loaded| {
            let mut account = Account::default();
            loaded.add_left_out(&mut account, None);
            (loaded.problem, account)
        });
        let found = of_file.as_ref().map(|(problem, account)| {
            let (missing, off) = verdict.is_motion_of(problem)?;
            Some((missing, off, account.clone()))
        });
        let same = found.as_ref().is_none_or(Option::is_some);
        let of_it = |file: &Path| of_the_motion(file, found.flatten());
        let said = (theorem(&verdict, clock.elapsed()), code(&verdict.outcome));
        let of_file = of_file.as_ref().map(std::slice::from_ref);
        return Ok(conclude(arguments, said, (same, of_it), (of_file, true)));
    }
    let of_file = of_file()?;
    let of_file = of_file.as_deref();
    let found = compare(of_file, |problem| verdict.is_about(problem));
    // What an edit led beyond 0 or 180 degrees.
    let turned = |problem: &Problem| verdict.is_about(&with_turns_of(problem, &verdict.problem));
    let is_turned = found.is_none() && compare(of_file, turned).is_some();
    let (same, found) = (found.is_some() || is_turned, found.unwrap_or_default());
    let of_it = |file: &Path| match same {
        true if is_turned => {
            about(file, &found)
                + "Angles of it that were led beyond 0 or 180 degrees are `turns` in the certificate, in the sense in which they are drawn.\n"
        }
        true => about(file, &found),
        false => format!(
            "REFUTED: the problem is not the one in {}.\n",
            file.display()
        ),
    };
    let said = (theorem(&verdict, clock.elapsed()), code(&verdict.outcome));
    Ok(conclude(arguments, said, (same, of_it), (of_file, false)))
}

/// The exit code of what was found.
fn code(outcome: &Outcome) -> u8 {
    match outcome {
        Outcome::Verified => CLOSED,
        Outcome::Refuted(_) => REFUTED,
        Outcome::NotProved(_) => NOT_PROVED,
        Outcome::Partial(_) => INCOMPLETE,
    }
}

/// What of a file is in the proof of a motion: the names of what is not, and how far from where it has the points they are drawn in the proof, were
/// `found` of it.
fn of_the_motion(file: &Path, found: Option<(Vec<String>, f64, Account)>) -> String {
    let file = file.display();
    let Some((missing, off, account)) = found else {
        return format!(
            "REFUTED: the points, where they are drawn, the objects or the constraints of the proof are not those in {file}: it is of another figure, or of \
             that one drawn or written otherwise.\n"
        );
    };
    let but = match &missing[..] {
        [] => String::new(),
        missing => format!(
            ", but for {}, which the proof leaves out",
            missing.join(", ")
        ),
    };
    let drawn = match off {
        0.0 => "the points are drawn in the same places".to_owned(),
        off => format!(
            "it sets out from a drawing that has points up to {} from where the file has them",
            rounded_up(off)
        ),
    };
    format!(
        "The points and constraints are those in {file}, exactly{but}; {drawn}.{}\n",
        held_and_left_out(&account)
    )
}

/// What a file may stand for in a certificate, each with what was left out and held for it.
type OfFile<'a> = Option<&'a [(Problem, Account)]>;

/// A file as certificates are about it: of more distances than are needed with those that are, or, where a path is followed in the coordinates of
/// the file, with what is held.
fn of_file(
    path: &Path,
    which: &input::Which,
    contents: Contents,
) -> Result<Vec<(Problem, Account)>, String> {
    let loaded = input::load(path, which)?;
    let own = match contents {
        Contents::Path => input::provable(path, &loaded.problem).map(|(problem, mut account)| {
            loaded.add_left_out(&mut account, None);
            (problem, account)
        }),
        _ => input::whole(path, &loaded),
    };
    let without = loaded.surplus().map(|surplus| {
        let mut account = Account::default();
        surplus.add_to(&mut account, None);
        (surplus.problem.clone(), account)
    });
    match (own, without) {
        (Ok(own), without) => Ok(std::iter::once(own).chain(without).collect()),
        (Err(_), Some(without)) => Ok(vec![without]),
        (Err(error), None) => Err(error),
    }
}

/// What a certificate does not say where its file asks for signs.
fn without_signs(of_file: OfFile, is_motion: bool) -> &'static str {
    match of_file {
        Some([(problem, _), ..]) if is_motion && !problem.orientations.is_empty() => {
            "The signs that the file asks for (`orientation`) are no part of the proof: it is of figures with any signs.\n"
        }
        Some([(problem, _), ..]) if !problem.orientations.is_empty() => {
            "The signs that the file asks for (`orientation`) are no part of the proof: it is of figures with any signs. Which \
             of them have those of the file is told by their boxes, in `krawl solve` and `krawl all`.\n"
        }
        _ => "",
    }
}

/// Whether a certificate is about a file, as which of what it may stand for; without a file it is.
fn compare(of_file: OfFile, is_about: impl Fn(&Problem) -> bool) -> Option<Account> {
    let Some(of_file) = of_file else {
        return Some(Account::default());
    };
    let found = of_file.iter().find(|(problem, _)| is_about(problem));
    found.map(|(_, account)| account.clone())
}

/// That the problem of a certificate is that of a file, what was compared, and what was made of that.
fn about(file: &Path, found: &Account) -> String {
    let (which, but) = match found.left_out.is_empty() {
        true => ("all constraints", ""),
        // Where the length that bends was left out another one does.
        false => (
            "the constraints that are used",
            ", but for which length bends if that of the file was left out",
        ),
    };
    format!(
        "The problem is the one in {}: the points, where the sketch has them, {which} and the way from the sketch \
         to them are the same, exactly{but}.{}\n",
        file.display(),
        held_and_left_out(found)
    )
}

/// What a certificate does not say of its file, as a sentence behind another one.
fn held_and_left_out(found: &Account) -> String {
    match found.clause() {
        clause if clause.is_empty() => clause,
        clause => format!(" What is proved is about the figure {clause}."),
    }
}

/// What was proved of a set of solutions.
struct Proved {
    text: String,
    /// The exit code where it is about the same as the problem file, if there is one, as `is_about` tells by what is `compared`.
    code: u8,
    is_about: Box<dyn Fn(&Problem) -> bool>,
    compared: Compared,
}

/// What was `found` of the same set of a problem file, or that it is about another problem.
fn of_the_set(file: &Path, compared: Compared, found: Option<&Account>) -> String {
    let (what, which, sketch) = match compared {
        Compared::Distances => (
            "names of the points and the distances",
            "names of the points or the distances",
            "; where the sketches have the points was not compared, as the set does not depend on it",
        ),
        Compared::All => (
            "points, where the sketch has them, and all constraints",
            "points, their places in the sketch or the constraints",
            "",
        ),
    };
    let file = file.display();
    match found {
        Some(found) => format!(
            "The {what} are those in {file}, exactly{sketch}.{}\n",
            held_and_left_out(found)
        ),
        None => format!("REFUTED: the {which} are not those in {file}.\n"),
    }
}

/// Prints what was proved, and whether it is about the `same` as the problem file, if there is one.
fn conclude(
    arguments: &Arguments,
    (mut text, code): (String, u8),
    (same, of_it): (bool, impl FnOnce(&Path) -> String),
    (of_file, is_motion): (OfFile, bool),
) -> u8 {
    text += &arguments.file.as_deref().map(of_it).unwrap_or_default();
    text += without_signs(of_file, is_motion);
    let is_printed = arguments.quiet || output::print(&text);
    output::code(is_printed, if same { code } else { REFUTED })
}

/// Checks a set of complex solutions.
fn verify_the_set(arguments: &Arguments, bytes: &[u8]) -> Result<Proved, String> {
    let clock = Instant::now();
    let verdict = super::in_pool(arguments.threads, || verify_complex_set(bytes))?;
    let verdict = verdict.map_err(output::in_file(&arguments.cert))?;
    let text = complex_set_theorem(&verdict, clock.elapsed());
    let code = match verdict.flaw {
        None => CLOSED,
        Some(ComplexFlaw::False(_)) => REFUTED,
        Some(ComplexFlaw::NotProved(_)) => NOT_PROVED,
    };
    Ok(Proved {
        text,
        code,
        compared: verdict.compared(),
        is_about: Box::new(move |problem| verdict.is_about(problem)),
    })
}

/// Checks what a search for all solutions left.
fn verify_the_cover(arguments: &Arguments, bytes: &[u8]) -> Result<Proved, String> {
    let clock = Instant::now();
    let verdict = check_cover(bytes, arguments.threads, arguments.quiet, || true);
    let verdict = verdict.map_err(output::in_file(&arguments.cert))?;
    let text = cover_theorem(&verdict, clock.elapsed());
    let code = match verdict.proves_all() {
        _ if verdict.flaw.is_some() => NOT_PROVED,
        true => CLOSED,
        false => INCOMPLETE,
    };
    Ok(Proved {
        text,
        code,
        compared: verdict.compared(),
        is_about: Box::new(move |problem| verdict.is_about(problem)),
    })
}

/// Checks a cover, and shows where it is, for as long as `goes_on` says so.
pub(super) fn check_cover(
    cover: &[u8],
    threads: Option<u16>,
    quiet: bool,
    goes_on: impl Fn() -> bool + Sync + Send,
) -> Result<CoverVerdict, String> {
    let line = ProgressLine::new(!quiet, "");
    let mut show = |stage| {
        line.show_cover(stage);
        goes_on()
    };
    let verdict = super::in_pool(threads, || verify_cover_while(cover, &mut show));
    line.clear();
    verdict?.map_err(|error| error.to_string())
}

/// Checks a certificate that was just written, on all processors, and says on standard error whether it does
/// not pass: then the result is the exit code for that.
///
/// A certificate of a run that is `closed` has to prove all of it.
pub(super) fn check_written(
    path: Option<&Path>,
    closed: bool,
    quiet: bool,
) -> Result<Option<u8>, String> {
    let Some(path) = path else {
        return Ok(None);
    };
    let name = path.display();
    let file = File::open(path).map_err(|e| format!("{name}: cannot be read again: {e}"))?;
    let line = ProgressLine::new(!quiet, "");
    let mut show = |stage: Stage| line.show_check(stage.tubes, stage.solutions);
    let verdict = verify(BufReader::new(file), &Settings::default(), &mut show);
    line.clear();
    let verdict = verdict.map_err(|error| format!("{name}: {error}; please report this"))?;
    let (what, code) = match &verdict.outcome {
        Outcome::Partial(why) if closed => (format!("INCOMPLETE: {why}"), INCOMPLETE),
        Outcome::Verified | Outcome::Partial(_) => return Ok(None),
        Outcome::NotProved(flaw) => (format!("NOT PROVED: {flaw}"), NOT_PROVED),
        Outcome::Refuted(flaw) => (format!("REFUTED, please report this: {flaw}"), REFUTED),
    };
    output::complain(&format!(
        "{name}: the certificate does not pass the checker. {what}"
    ));
    Ok(Some(code))
}
