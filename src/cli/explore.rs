//! `krawl explore`: new sketches from solutions, and their paths, until nothing new comes.

use super::output::{self, Beside, Destination, in_file, number};
use super::pictures::Pictures;
use super::results::Results;
use super::verify::check_written;
use super::{CLOSED, INCOMPLETE, input, interrupt};
use crate::order::each_once;
use krawl::complete::{self, all};
use krawl::explore::{ExploreError, Explorer, Finish, Options, Progress};
use krawl::problem::{Problem, Published};
use krawl::report::{AllReal, Document, Explored, ProgressLine, TracedPath, explore_to_table};
use krawl::track;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Look for more real solutions: new sketches from those found, their paths, and so on
///
/// From every solution found, the branches of a construction plan give new sketches. Each is followed with proof, unless
/// a path that is proved already passes through it; then the same with other plans and other lengths that bend, until
/// nothing new comes or the budget ends. All is kept in a store, so that no path that was finished is ever lost: the
/// same command goes on where the last run ended, however that was. That there are no other solutions is not
/// claimed; `krawl all` proves that, where it can.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl explore problems/disulfide.toml --store disulfide
  krawl explore problems/disulfide.toml --store disulfide --html rings.html  the figures, and their paths
  krawl explore problems/icosahedron.toml --store ico --time 3600 --json ico.json
  krawl explore problems/disulfide.toml --store disulfide --proofs proofs    a certificate for each solution

On several machines:
  krawl explore problems/icosahedron.toml --store ico --time 10 --shard 100  ico/unit-0.krawl-unit, ...
  krawl work ico/unit-0.krawl-unit                                           on any machine
  krawl merge ico ico/*.krawl-result                                         back into the store

Exit codes: 0 nothing new came, 4 the budget ended or sketches are in work units (the same command goes on), 2 bad
input, or another process has the store open.")]
pub struct Arguments {
    /// The problem file (TOML), or a molecule (.xyz, .mol, .sdf, .pdb)
    file: PathBuf,
    /// The folder of the store; it is made where there is none
    #[arg(long, value_name = "DIR")]
    store: PathBuf,
    #[command(flatten)]
    which: input::Which,
    /// Stop after so many seconds; the next run follows what is left
    #[arg(long, value_name = "S", value_parser = super::all::seconds)]
    time: Option<f64>,
    /// Stop when this run has followed so many paths; 0 shows what the store has
    #[arg(long, value_name = "N")]
    paths: Option<u64>,
    /// Paths to follow at the same time [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// The end: so many ways in a row without a new solution
    ///
    /// A way is a plan, a length that bends and a coefficient
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..))]
    patience: u16,
    /// A path that takes more tubes is given up
    #[arg(long, value_name = "N", default_value_t = 100_000)]
    max_tubes: usize,
    /// At the end put what waits into so many work units
    ///
    /// They are files in the store's folder, each with sketches whose paths wait
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    shard: Option<u32>,
    /// Follow sketches that are in work units here, too
    #[arg(long, conflicts_with = "shard")]
    take_back: bool,
    /// Write certificates of what was found into this folder
    ///
    /// For each path that first found a solution, the problem with its sketch and its certificate
    #[arg(long, value_name = "DIR")]
    proofs: Option<PathBuf>,
    /// How long `krawl all` may look for all solutions, to compare
    ///
    /// 0 leaves it out
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = seconds_or_none)]
    all_time: f64,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// The number of figures along each path in the JSON and the page
    ///
    /// [default: as many as look smooth in the page, none in the JSON]
    #[arg(long, value_name = "N", value_parser = super::solve::samples)]
    samples: Option<usize>,
    #[command(flatten)]
    pictures: Pictures,
    /// Print the coordinates of all solutions
    #[arg(long)]
    all: bool,
    /// Print no table and no progress
    #[arg(long)]
    quiet: bool,
}

fn seconds_or_none(text: &str) -> Result<f64, String> {
    let must = "must be a number, 0 or greater";
    number(text, |x| (0.0..1e9).contains(x), must)
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let file = arguments.file.display();
    let (problem, published) = read(arguments)?;
    output::say_if_signs_are_not_looked_at(&problem);
    let problem = problem.unsigned();
    let named = [arguments.json.as_deref(), None];
    let pictures = &arguments.pictures;
    let mut results = Results::open([&arguments.file], named, pictures, arguments.quiet)?;
    let cancel = interrupt::flag();
    let at = |error: ExploreError| match error {
        ExploreError::Problem(_) | ExploreError::Unserved(_) => format!("{file}: {error}"),
        _ => error.to_string(),
    };
    let mut explorer = Explorer::open(&problem, &arguments.store).map_err(at)?;
    let line = ProgressLine::new(!arguments.quiet, "");
    let tell = |now: Progress| {
        line.show_text(format!(
            "{} paths   {} solutions   {} sketches waiting   way {}   {:.1} paths/s",
            now.paths, now.solutions, now.queue, now.way, now.rate
        ));
    };
    let options = Options {
        time: arguments.time.map(Duration::from_secs_f64),
        paths: arguments.paths,
        jobs: arguments.jobs.unwrap_or(0).into(),
        patience: arguments.patience.into(),
        most_tubes: arguments.max_tubes,
        take_back: arguments.take_back,
        cancel: Some(cancel),
        progress: Some(&tell),
    };
    let finish = explorer.run(&options);
    line.clear();
    let finish = finish.map_err(at)?;
    if let Some(count) = arguments.shard {
        let units = share(&mut explorer, count as usize).map_err(at)?;
        if !arguments.quiet {
            eprintln!(
                "{units} work units in {}; `krawl work` follows one, `krawl merge` takes what comes of it",
                arguments.store.display()
            );
        }
    }
    if let Some(folder) = &arguments.proofs {
        results.note(prove(&explorer, folder, arguments.quiet)?);
    }
    let traced = match arguments.samples.is_some() || arguments.pictures.want_path() {
        true => trace(&explorer, arguments.quiet),
        false => Vec::new(),
    };
    let all = AT_ONCE / problem.points.len().max(1) / traced.len().max(1);
    let explored = Explored {
        explorer: &explorer,
        finish: Some(finish),
        all_real: all_real(&problem, arguments.all_time),
        published: &published,
        traced: &traced,
        samples: arguments.samples.unwrap_or(all.clamp(60, 1200)),
    };
    if let AllReal::Proved(all) = explored.all_real
        && all < explorer.contents().classes.len()
    {
        output::complain(&format!(
            "{file}: {} solutions are proved to exist, and `krawl all` proves that there are {all}: this is a bug in \
             krawl, please report it",
            explorer.contents().classes.len()
        ));
    }
    results.write(|| Document::explore(&explored))?;
    results.print(|| explore_to_table(&explored, arguments.all));
    let is_shared = !explorer.contents().out.is_empty();
    Ok(results.code(match finish {
        Finish::Ended if !is_shared => CLOSED,
        _ => INCOMPLETE,
    }))
}

fn read(arguments: &Arguments) -> Result<(Problem, Vec<Published>), String> {
    let is_toml = arguments.file.extension().is_some_and(|e| e == "toml");
    if is_toml && arguments.which.sketch.is_none() && !arguments.which.heavy {
        return Problem::read_with_published(&arguments.file).map_err(|e| e.to_string());
    }
    let loaded = input::load(&arguments.file, &arguments.which)?;
    let (problem, account) = input::whole(&arguments.file, &loaded)?;
    let clause = account.clause();
    if !clause.is_empty() {
        output::complain(&format!(
            "{}: all that is proved holds {clause}",
            problem.name
        ));
    }
    Ok((problem, Vec::new()))
}

/// How many real solutions there are, if that can be proved in so much time.
fn all_real(problem: &Problem, seconds: f64) -> AllReal {
    if seconds == 0.0 {
        return AllReal::Unknown("`--all-time 0`".to_owned());
    }
    let options = complete::Options {
        cancel: Some(interrupt::flag()),
        time: Some(Duration::from_secs_f64(seconds)),
        ..complete::Options::default()
    };
    match all(problem, &options) {
        Ok(found) if found.status == complete::Status::Complete => match found.count {
            Some(count) => AllReal::Proved(count as usize),
            None => AllReal::Unknown("more than 2^64, as `krawl all` proves".to_owned()),
        },
        Ok(_) => AllReal::Unknown(format!(
            "`krawl all` did not prove it within {seconds} s (`--all-time`)"
        )),
        Err(unserved) => AllReal::Unknown(format!("`krawl all`: {unserved}")),
    }
}

/// Points of figures along paths, for a page: as many as load at once.
const AT_ONCE: usize = 60_000;
/// Paths that are drawn, and tubes of all of them together: following them again takes some ten times as many.
const MOST_DRAWN: usize = 60;
const MOST_TUBES: usize = 60_000;

/// Follows the paths that first found solutions once more, to draw them: the first ones, as far as that does not take
/// long.
fn trace(explorer: &Explorer, quiet: bool) -> Vec<TracedPath> {
    let contents = explorer.contents();
    let mut ids: Vec<u64> = Vec::new();
    for class in &contents.classes {
        if !ids.contains(&class.path) {
            ids.push(class.path);
        }
    }
    let mut tubes = 0;
    ids.retain(|id| {
        let own = contents.paths.get(id).map_or(0, |path| path.tubes);
        let fits = tubes + own <= MOST_TUBES;
        tubes += if fits { own } else { 0 };
        fits
    });
    ids.truncate(MOST_DRAWN);
    let mut out = Vec::with_capacity(ids.len());
    for (k, &id) in ids.iter().enumerate() {
        let Some(problem) = explorer.problem_of(id) else {
            continue;
        };
        let what = format!("picture {} of {}", k + 1, ids.len());
        let traced = interrupt::shown(!quiet, &what, |control| {
            track::trace_path(&problem, &track::Options::certified(), control)
        });
        if let Ok((outcome, trace)) = traced {
            out.push(TracedPath { id, outcome, trace });
        }
    }
    out
}

/// Writes work units into the store's folder, before the store knows of them.
fn share(explorer: &mut Explorer, count: usize) -> Result<usize, ExploreError> {
    let folder = explorer.folder().to_owned();
    explorer.share(count, &mut |unit, share| {
        let path = folder.join(format!("unit-{unit}.krawl-unit"));
        let failed = |error: String| ExploreError::File(path.clone(), error);
        let beside = Beside::new(&path).map_err(&failed)?;
        match beside.write(share.write().as_bytes()) {
            true => Ok(()),
            false => Err(failed("the work unit cannot be written".to_owned())),
        }
    })
}

/// Follows the paths that first found solutions once more, and writes their problems and certificates.
fn prove(explorer: &Explorer, folder: &Path, quiet: bool) -> Result<bool, String> {
    std::fs::create_dir_all(folder).map_err(in_file(folder))?;
    let classes = explorer.contents().classes.iter();
    let paths = each_once(classes.map(|class| class.path));
    let mut well = true;
    for id in paths {
        let Some(problem) = explorer.problem_of(id) else {
            continue;
        };
        let text = folder.join(format!("path-{id}.toml"));
        well &= Destination::new(&text)?.write(&problem.to_toml());
        let cert = folder.join(format!("path-{id}.krawl"));
        let beside = Beside::new(&cert)?;
        let mut writer = beside.certificate(&problem);
        let mut control = interrupt::witnessed(Some(&mut writer));
        track::solve_in_best_space(&problem, &track::Options::certified(), &mut control)
            .map_err(in_file(&text))?;
        if interrupt::is_requested() {
            return Ok(well);
        }
        let whole = writer.finish().map(|_| ());
        well &= beside.commit(whole) && check_written(Some(&cert), false, quiet)?.is_none();
    }
    Ok(well)
}
