//! `krawl edit`: changes dimensions and takes the figure along.

use super::measured::Measured;
use super::output::{self, Beside, Certificate, Refusal, in_file};
use super::pictures::Pictures;
use super::results::Results;
use super::take::check_format;
use super::verify::check_written;
use super::{BAD_INPUT, CLOSED, LIMIT, PASSES, STOPPED, input, interrupt, serve};
use krawl::blocks::Account;
use krawl::edit::{Asked, Astray, Drag, Edited, Ending, OpenError, Session, Setting};
use krawl::import::{Followed, Format};
use krawl::problem::Problem;
use krawl::remarks::moves;
use krawl::report::{
    Document, account_in_words, edit_to_table, followed_to_table, signs_of_figure,
};
use krawl::track::{Control, Options};
use std::path::{Path, PathBuf};

/// Change dimensions of a figure and keep the figure, with proof, or say how far it can go
///
/// The figure is the sketch in FILE, which should meet its dimensions, at least nearly. Only the dimensions named
/// move, together, and with them those that a FreeCAD file computes from them; all others stay.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl edit problems/mechanisms/four-bar.toml --set B-D=5.2
  krawl edit problems/mechanisms/four-bar.toml --set B-D=5.2 --out edited.toml
  krawl edit docs/examples/arm.toml --drag C=40,30 --out dragged.toml
  krawl edit problems/mechanisms/four-bar.toml --set B-D=5.2 --cert edit.krawl
  krawl verify edit.krawl problems/mechanisms/four-bar.toml
  krawl edit problems/mechanisms/four-bar.toml --set B-D=5.2 --measure A-P --measure 'angle A B P'
  krawl edit problems/sketches/bracket.slvs --set c011=52 --out edited.slvs

Exit codes: 0 reached: the figure printed is the one and only continuation; 3 limit: the dimensions can
go so far and no further, or a point that is dragged did not come all the way; 4 passes: branches of figures
seem to meet; 1 stopped: nothing could be proved from some point on; 2 bad input, or results that could not be written.")]
pub struct Arguments {
    #[command(flatten)]
    source: input::Source,
    /// A dimension and its new value: a-b=5.2, radii:hole=3, c00f=45
    ///
    /// Given several times, all move together. Of a FreeCAD file a cell of a spreadsheet or a variable may be set, too: Spreadsheet.width=90, VarSet.width=90
    #[arg(
        long,
        value_name = "NAME=VALUE",
        required_unless_present_any = ["serve", "drag"],
        conflicts_with = "serve"
    )]
    set: Vec<String>,
    /// A point and where it is wanted: P=40,25
    ///
    /// All dimensions stay what they are, and the figure is led until the point is there, or as near as it can; may
    /// be given for several points
    #[arg(long, value_name = "P=X,Y", conflicts_with_all = ["serve", "set", "cert"], allow_hyphen_values = true)]
    drag: Vec<String>,
    /// Read edits from standard input, and answer each at once
    ///
    /// Edits are JSON objects, one a line, such as {"set": {"a-b": 5.2}}, and each is answered with one line of JSON;
    /// the figure never changes by an edit that is not reached (docs/using/programs.md)
    #[arg(long, conflicts_with_all = ["out", "json", "time"])]
    serve: bool,
    /// Write the edited figure into a file like FILE, if it was reached
    ///
    /// In the format and coordinates of FILE
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the result as JSON; `-` is standard output
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the proof as a certificate, and check it
    ///
    /// It is checked as `verify` does. Where it does not pass, the exit code is that of `verify`. The figure is then
    /// followed as a whole, with what nothing determines held where it is
    #[arg(long, value_name = "FILE", conflicts_with_all = ["serve", "simple"])]
    cert: Option<PathBuf>,
    /// Do not check the certificate that was written
    #[arg(long, requires = "cert", hide_short_help = true)]
    no_verify: bool,
    #[command(flatten)]
    measured: Measured,
    #[command(flatten)]
    pictures: Pictures,
    /// Keep to 53 bits, and stop where they do not suffice
    #[arg(long, hide_short_help = true)]
    no_extended: bool,
    #[command(flatten)]
    left_out: LeftOut,
    #[command(flatten)]
    time: interrupt::Time,
    /// Print nothing
    #[arg(long)]
    quiet: bool,
}

/// What counts as met of constraints that are left out.
#[derive(clap::Args)]
pub(super) struct LeftOut {
    /// How far constraints left out of the proof may be missed
    ///
    /// Where there are more constraints than unknowns, those that are left out count as met where the figure misses
    /// them by no more than this length; of angles, ratios and others, too, which are missed by about as far as points
    /// would have to move [default: of lengths half a unit of the last digit that the file gives, else 1e-7 of the
    /// mean length]
    #[arg(long, value_name = "X", value_parser = super::all::seconds, hide_short_help = true)]
    pub redundant_tolerance: Option<f64>,
    /// Keep the edges of closed outlines from touching
    ///
    /// In sketches in the plane: a way ends where two edges of closed outlines come to touch that are apart as they are drawn, and says
    /// which. Edges are the lines, arcs and circles of the file; a circle is an outline of its own. Of edges with a common end only lines
    /// are looked at, whether they fold onto each other
    #[arg(long, hide_short_help = true)]
    pub simple: bool,
}

impl LeftOut {
    /// Options for proofs.
    pub fn options(&self) -> Options {
        Options {
            redundant_tolerance: self.redundant_tolerance,
            simple: self.simple,
            ..Options::certified()
        }
    }
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, Refusal> {
    arguments.time.begin();
    let file = &arguments.source.file;
    if let Some(out) = &arguments.out {
        check_format(file, out)?;
    }
    let mut loaded = arguments.source.load()?;
    let mut problem = loaded.problem.clone();
    let options = Options {
        extended: !arguments.no_extended,
        ..arguments.left_out.options()
    };
    if arguments.serve {
        let mut session = open(&problem, file, &options, &mut Control::default())?;
        return Ok(match serve::serve(&mut session, &loaded) {
            true => CLOSED,
            false => BAD_INPUT,
        });
    }
    let mut named = Vec::new();
    for text in &arguments.set {
        let (name, value) = Setting::split(&problem, text).map_err(in_file(file))?;
        match loaded.set_cell(name, value) {
            Some(set) => set.map_err(in_file(file))?,
            None => named.push((name, value)),
        }
    }
    let is_parameter = |(name, _): &(&str, &str)| problem.parameters.iter().any(|(p, _)| p == name);
    let parameter = named
        .iter()
        .find(|one| is_parameter(one))
        .map(|(name, _)| name.to_string());
    let asked = Asked::new(&problem, &named).map_err(in_file(file))?;
    let led: Vec<usize> = asked.given.iter().map(|setting| setting.index).collect();
    loaded.check_numbers(&led).map_err(in_file(file))?;
    let mut followed = match arguments.set.is_empty() {
        true => Followed::default(),
        false => loaded.followed(&problem, &asked.given),
    };
    if named.is_empty() && followed.set.is_empty() && !arguments.set.is_empty() {
        let text = format!(
            "no dimension of the sketch follows from {}: there is nothing to change",
            arguments.set.join(", ")
        );
        return Err(in_file(file)([&[text], &followed.warnings[..]].concat().join("; ")).into());
    }
    let numbers = asked.numbers().chain(followed.numbers()).collect();
    let asked = Asked::led(&problem, asked.parameters, numbers);
    let asked = asked.map_err(|e| in_file(file)(followed.in_error(&e)))?;
    let is_freecad = input::format(file) == Some(Format::FreeCad);
    if arguments.out.is_some()
        && !is_freecad
        && let Some(index) = asked.straight(&problem)
    {
        let name = problem.dimension_name(index);
        return Err(in_file(file)(format!(
            "{name}: under `angles` a file has none of 0 or 180 degrees, nor one beyond that is computed: leave out --out, or say `turns` in the file"
        ))
        .into());
    }
    let measures = arguments.measured.of(&problem)?;
    let as_turns = asked.in_words(&problem);
    let (settings, given) = (asked.settings, asked.given);
    problem = asked.problem;
    let drags = arguments.drag.iter();
    let drags = drags.map(|text| Drag::parse(&problem, text));
    let drags: Vec<Drag> = drags.collect::<Result<_, _>>().map_err(in_file(file))?;
    Drag::check(&problem, &drags).map_err(in_file(file))?;
    if drags.is_empty() {
        Setting::check(&problem, &settings).map_err(in_file(file))?;
    }
    let (mut account, mut astray) = (None, None);
    let mut led = settings.clone();
    let mut cert = arguments.cert.as_deref();
    if cert.is_some() {
        match certified(file, (&problem, &settings), |session| {
            let edited = session.probe(&settings, &mut interrupt::control());
            astray = edited.astray.as_ref().map(Astray::in_words);
            (edited.account.clone(), reason(&edited))
        })? {
            Some(found) => {
                (problem, led) = (found.problem, found.settings);
                account = Some(found.account);
            }
            None => cert = None,
        }
    }
    let named = [arguments.json.as_deref(), None];
    let mut results = Results::open([file], named, &arguments.pictures, arguments.quiet)?;
    // Before any file is begun, so that an interrupt leaves none behind.
    interrupt::flag();
    let begun = cert.map(Beside::new).transpose()?;
    let mut witness = begun.as_ref().map(|beside| beside.certificate(&problem));
    let mut control = interrupt::witnessed(witness.as_mut());
    if results.is_told() {
        say_if_it_moves(&problem);
    }
    let mut session = match drags.is_empty() {
        true => open(&problem, file, &options, &mut control)?,
        false => taken(
            Session::open_to_drag(&problem, &options, &mut control),
            file,
        )?,
    };
    let mut edited = match drags.is_empty() {
        true => session.edit_with(&led, &mut control),
        false => session.drag(&drags, &mut control),
    };
    if let Some(account) = account {
        edited.account = account;
        edited.switched_on.extend(astray);
    }
    loaded.add_left_out(&mut edited.account, Some(&edited.points));
    if edited.ending != Ending::Reached {
        followed.note_way();
        followed
            .warnings
            .extend(parameter.map(|name| no_limit_of(&name)));
    }
    let moved = session.moved();

    let (is_written, verdict) = commit(
        (begun.as_ref(), witness),
        (file, &edited),
        cert.filter(|_| !arguments.no_verify),
        arguments.quiet,
    )?;
    let figure = || std::iter::once((&edited.points[..], &edited.objects[..]));
    results.note(is_written);
    results.write(|| {
        let of_file = (&loaded.problem, &followed);
        let mut document = Document::edit(&problem, &edited, &session, of_file);
        document.beside.measures = measures.told(figure());
        document
    })?;
    if let Some(out) = &arguments.out
        && edited.ending == Ending::Reached
    {
        let (points, objects) = (session.figure(), session.objects());
        let mut changed = Setting::applied(&given, &loaded.problem);
        changed.parameters = asked.parameters;
        let bytes = loaded.rewritten(file, &changed, &points, &objects);
        let bytes = bytes.map_err(in_file(file))?;
        results.note(Beside::new(out)?.write(&bytes));
    }
    results.print(|| {
        let drawn = match &edited.singular {
            None => drawn_in_words(&problem, &session),
            Some(_) => String::new(),
        };
        let table = edit_to_table(&problem, &edited, moved);
        let of = match edited.ending {
            Ending::Reached => "",
            Ending::Limit(_) => " at the limit",
            _ if edited.there.is_some() => " of the figure shortly before",
            Ending::Passes(_) | Ending::Stopped(_) => " of the old figure",
        };
        let mut text = as_turns + &drawn + &table + &account_in_words(&edited.account);
        text += &measures.to_table(of, figure());
        text += &signs_of_figure(&problem, &edited.points);
        text += &followed_to_table(&loaded.problem, &followed);
        text
    });
    Ok(results.code(verdict.unwrap_or(exit_code(&edited))))
}

/// What a certificate of edits is about.
pub(super) struct Certified {
    pub problem: Problem,
    /// The settings, of that problem.
    pub settings: Vec<Setting>,
    /// What is proved of the figures.
    pub account: Account,
}

/// What a certificate of edits is about, and what was made of that in the file: what nothing determines is held, and constraints that seem
/// to follow from others are left out. Where some are, the edits are made part by part first, which looks at these too; `tried` tells
/// what that proves, and if they stop there, why: then no certificate is written, and that is said.
pub(super) fn certified(
    file: &Path,
    (problem, settings): (&Problem, &[Setting]),
    tried: impl FnOnce(&mut Session) -> (Account, Option<String>),
) -> Result<Option<Certified>, String> {
    let (whole, mut account) = input::provable(file, problem)?;
    if !account.left_out.is_empty() {
        let session = Session::open(problem);
        let mut session = session.map_err(in_file(file))?;
        let (proved, stop) = tried(&mut session);
        if let Some(reason) = stop {
            let text = format!("no certificate was written: {reason}");
            output::complain(&in_file(file)(text));
            return Ok(None);
        }
        account = proved;
    }
    let settings = carried(settings, (problem, &whole)).map_err(in_file(file))?;
    Ok(Some(Certified {
        problem: whole,
        settings,
        account,
    }))
}

/// Why an edit stopped, if it did.
pub(super) fn reason(edited: &Edited) -> Option<String> {
    match &edited.ending {
        Ending::Stopped(stop) => Some(stop.text.clone()),
        _ => None,
    }
}

/// Settings of a problem as those of the one that a certificate is about. Dimensions that are left out of that, as they follow
/// from others, are not among them; one at least has to be left.
fn carried(settings: &[Setting], (from, to): (&Problem, &Problem)) -> Result<Vec<Setting>, String> {
    let mut carried = Vec::new();
    for setting in settings {
        match setting.carried(from, to) {
            Ok(Some(setting)) => carried.push(setting),
            Ok(None) => {}
            Err(error) => return Err(format!("{error}: leave out --cert")),
        }
    }
    match settings.first() {
        Some(first) if carried.is_empty() => Err(format!(
            "{} follows from other constraints and is not in a certificate: leave out --cert",
            from.dimension_name(first.index)
        )),
        _ => Ok(carried),
    }
}

/// Ends a certificate, and checks it if its `path` is given: whether it was written, and the exit code where it does not
/// pass. None is written where it would say more than the edit does, and that is said: it is about the equations, which go on where a line
/// or arc vanishes.
pub(super) fn commit(
    (beside, writer): (Option<&Beside>, Option<Certificate>),
    (file, edited): (&Path, &Edited),
    path: Option<&Path>,
    quiet: bool,
) -> Result<(bool, Option<u8>), String> {
    let (Some(beside), Some(writer)) = (beside, writer) else {
        return Ok((true, None));
    };
    if let Ending::Stopped(stop) = &edited.ending
        && edited.ending.is_at_an_edge()
    {
        let text = format!("no certificate was written: {stop}");
        output::complain(&in_file(file)(text));
        return Ok((true, None));
    }
    match beside.commit(writer.finish().map(|_| ())) {
        false => Ok((false, None)),
        true => Ok((true, check_written(path, false, quiet)?)),
    }
}

/// That what was led along a straight way says nothing of a parameter's limits.
pub(super) fn no_limit_of(parameter: &str) -> String {
    format!(
        "on the way every dimension goes straight to what it is to be, and not as the file's expressions of `{parameter}` do: where that ends is no \
         limit of `{parameter}` (`krawl sweep --vary {parameter}` with many frames comes near to one)"
    )
}

/// What is said of a drawing that is singular, and of outlines that are kept apart, a line of text each.
pub(super) fn drawn_in_words(problem: &Problem, session: &Session) -> String {
    let singular = session.singular().map(|singular| singular.in_words());
    let all = singular.into_iter().chain(session.outlines_in_words());
    all.map(|words| format!("{}: {words}\n", problem.name))
        .collect()
}

/// Says before anything else that a sketch seems to move, where it does.
pub(super) fn say_if_it_moves(problem: &Problem) {
    if let Some(moves) = moves(problem) {
        output::print(&format!(
            "{}: {}\n\n",
            problem.name,
            moves.in_words(problem)
        ));
    }
}

/// Takes the sketch for the figure, or says why it is none.
pub(super) fn open(
    problem: &Problem,
    file: &Path,
    options: &Options,
    control: &mut Control,
) -> Result<Session, Refusal> {
    taken(Session::open_with(problem, options, control), file)
}

/// A session, unless the sketch is no figure.
fn taken(opened: Result<Session, OpenError>, file: &Path) -> Result<Session, Refusal> {
    opened.map_err(|error| Refusal {
        message: in_file(file)(&error),
        code: match error {
            OpenError::Correction { .. } => STOPPED,
            _ => BAD_INPUT,
        },
    })
}

/// The exit code that tells how an edit ended.
pub(super) fn exit_code(edited: &Edited) -> u8 {
    match edited.ending {
        Ending::Reached if edited.dragged.as_ref().is_some_and(|d| !d.is_there) => LIMIT,
        Ending::Reached => CLOSED,
        Ending::Limit(_) => LIMIT,
        Ending::Passes(_) => PASSES,
        Ending::Stopped(_) => STOPPED,
    }
}
