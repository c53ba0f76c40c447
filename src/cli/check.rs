//! `krawl check`: reads a problem and prints what it understood.

use super::{BAD_INPUT, CLOSED, OVER, input, output};
use crate::report::names;
use krawl::blocks::{
    Account, Census, Finding, MOST_POINTS, Seen, Singular, Surplus, Why, clusters, pinned, surplus,
};
use krawl::constraint::fix_frame;
use krawl::edit::{Decomposition, Standing, TooMany};
use krawl::import::{self, Format, Imported, Listed, Skeleton};
use krawl::plan::Plan;
use krawl::problem::{DEPENDS, Object, Problem, Shape, Target, counted};
use krawl::remarks::{in_words, moves, remarks};
use krawl::report::{decomposition_in_words, freedom_of_sketch_in_words};
use krawl::system::{GaugeError, Homotopy};
use std::path::{Path, PathBuf};

/// Check a problem file and print what is in it
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl check sketch.toml
  krawl check sketch.toml --pattern
  krawl generate tower --size 60 | krawl check -
  krawl check problems/sketches/parts.FCStd --sketch Slot

Exit codes: 0 in order, 2 not in order, with the line and what to do, 6 over-constrained: constraints that are one too
many, each with the few that it follows from or contradicts.")]
pub struct Arguments {
    /// The problem file (TOML; `-` is standard input), a sketch or a molecule
    ///
    /// Sketches of SolveSpace (.slvs) and FreeCAD (.FCStd); molecules (.xyz, .mol, .sdf, .pdb, .ent)
    file: PathBuf,
    #[command(flatten)]
    which: input::Which,
    /// Show where the Jacobian has entries, ordered by the construction plan
    ///
    /// However many coordinates there are (otherwise up to 40)
    #[arg(long)]
    pattern: bool,
}

/// Up to so many free coordinates the pattern is shown without being asked for: it fits a screen.
const PATTERN: usize = 40;

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let printed = |text: &str, code| Ok(output::code(output::print(text), code));
    let format = input::format(&arguments.file);
    let is_molecule = matches!(format, Some(Format::Xyz | Format::Sdf | Format::Pdb));
    // One molecule is described as a problem.
    let is_one = || {
        let is_single = || listed(&arguments.file).is_ok_and(|listed| listed.len() == 1);
        is_molecule && (arguments.which.sketch.is_some() || is_single())
    };
    if format.is_some() && !is_one() {
        let (text, code) = describe_sketches(&arguments.file, &arguments.which)?;
        return printed(&text, code);
    }
    let mut centres = String::new();
    let read = input::load(&arguments.file, &arguments.which).and_then(|loaded| {
        centres = loaded.imported().map_or(String::new(), stereocentres);
        loaded.whole(&arguments.file)
    });
    let problem = match read {
        Ok(problem) => problem,
        Err(message) => {
            let loose = Loose::of(&arguments.file).ok_or_else(|| message.clone())?;
            output::complain(&loose.decide(&message));
            output::print(&loose.in_words());
            return Ok(exit_code(&loose.census, BAD_INPUT));
        }
    };
    let mut census = surplus(&problem)?;
    if problem.is_distances_only() {
        // As many as are needed, of which none follows from others whatever the lengths are.
        census.surplus.clear();
    }
    let mut text = describe(&problem, None, &census) + &centres;
    text += &remarks_in_words(&problem);
    text += &surplus_in_words(&census);
    let code = exit_code(&census, CLOSED);
    text += &match problem.is_absolute() {
        true => blocks_in_words(&decomposed(&problem, &census)),
        false if problem.is_distances_only() => clusters_in_words(&problem),
        false => held_in_words(&problem, &census),
    };
    if !problem.is_distances_only() {
        text += "construction plan\n  none in closed form: those are for distances between points alone; --space reduced orders \
                 unknowns and equations by itself\n";
        return printed(&text, code);
    }
    let plan = construction_plan(&problem, arguments.pattern);
    text += &plan.map_err(|error| format!("{}: {error}", input::name(&arguments.file)))?;
    printed(&text, CLOSED)
}

/// The exit code of what was read, where nothing is one too many this one.
fn exit_code(census: &Census, code: u8) -> u8 {
    match too_many(census) {
        0 => code,
        _ => OVER,
    }
}

/// How many constraints are too many, wholly or in part; objects are no constraints.
fn too_many(census: &Census) -> usize {
    census.surplus.iter().filter(|one| !one.is_object).count()
}

/// How a problem in its own frame falls apart; what is told of its drawing is what was seen at figures near it.
fn decomposed(problem: &Problem, census: &Census) -> Result<Decomposition, String> {
    let mut found = Decomposition::of(problem)?;
    of_census(&mut found, census);
    Ok(found)
}

/// Takes what a census says of the drawing in place of what is seen at the drawing alone.
fn of_census(found: &mut Decomposition, census: &Census) {
    let is_too_many = |singular: &Singular| singular.seen == Seen::TooMany;
    if census.singular.is_some() || found.singular.as_ref().is_some_and(is_too_many) {
        found.singular.clone_from(&census.singular);
    }
}

/// Constraints that are one too many, as lines of text; none where there are none.
fn surplus_in_words(census: &Census) -> String {
    let mut text = String::new();
    if !census.surplus.is_empty() {
        text += "too many\n";
    }
    for one in &census.surplus {
        text += &format!("  {}\n", one.in_words());
    }
    let has_cure = |one: &&Surplus| one.cures.as_ref().is_some_and(|cures| !cures.is_empty());
    if census.surplus.iter().filter(has_cure).count() > 1 {
        text += "  each of these needs a cure of its own: once one is cured, check again\n";
    }
    text
}

/// The sketches or molecules in a file of another program.
fn listed(file: &Path) -> Result<Vec<Listed>, String> {
    let listed = import::list(&file.display().to_string(), &input::bytes(file)?);
    listed.map_err(|error| error.to_string())
}

/// What a file of another program holds: its sketches, or the one of them.
fn describe_sketches(file: &Path, which: &input::Which) -> Result<(String, u8), String> {
    let listed = listed(file)?;
    if listed.is_empty() {
        let file = file.display();
        return Err(format!("{file}: there is no sketch and no molecule in it"));
    }
    if listed.len() != 1 && which.sketch.is_none() {
        let mut text = format!(
            "{} in {}; take one with --sketch NAME\n",
            counted(listed.len(), "sketch"),
            file.display()
        );
        for one in &listed {
            let drawn = counted(one.drawn, "thing");
            let constraints = counted(one.constraints, "constraint");
            text += &format!("  {}: {drawn} drawn, {constraints}\n", one.title());
        }
        return Ok((text, CLOSED));
    }
    let (imported, _) = input::import(file, which)?;
    let problem = &imported.problem;
    let mut text = format!("{}, read as\n", problem.name);
    let census = surplus(problem)?;
    let blocks = decomposed(problem, &census);
    text += &describe(problem, Some(&blocks), &census);
    text += &surplus_in_words(&census);
    let kept = Account::of(problem, 0).kept_in_words();
    if !kept.is_empty() {
        text += &format!("read {kept}\n");
    }
    text += "dimensions (for --set)\n";
    for index in problem.dimensions().filter(|&i| imported.has_number(i)) {
        let name = problem.dimension_name(index);
        let what = match index.checked_sub(problem.distances.len()) {
            None => {
                let Target::Length(length) = &problem.distances[index].target else {
                    continue;
                };
                format!("distance: {}, {length}", problem.distance_name(index))
            }
            Some(c) => problem.constraint_name(c),
        };
        let tied = imported.tied.iter().find(|tied| tied.index == index);
        let tied = tied.map_or(String::new(), |tied| {
            let fault = tied.fault.as_ref().map_or(String::new(), |why| {
                format!(", which is not followed here: {why}")
            });
            format!(
                " (by the expression `{}` in the file{fault})",
                tied.expression
            )
        });
        text += &format!("  {name:<13} {what}{tied}\n");
    }
    text += &blocks_in_words(&blocks);
    Ok((text, exit_code(&census, CLOSED)))
}

/// How a problem in its own frame falls apart.
fn blocks_in_words(found: &Result<Decomposition, String>) -> String {
    match found {
        Ok(found) => decomposition_in_words(found),
        Err(fault) => format!("blocks\n  none: {fault}\n"),
    }
}

/// A problem file that is in order but has not as many constraints as it needs, or has them in other places.
struct Loose {
    problem: Problem,
    /// What is wrong, without the place in the file.
    fault: String,
    found: Decomposition,
    standing: Standing,
    census: Census,
}

impl Loose {
    /// None of any other file that cannot be read.
    fn of(file: &Path) -> Option<Self> {
        if file == Path::new("-") || input::format(file).is_some() {
            return None;
        }
        let error = match input::made(file) {
            Some(made) => Problem::parse(&made.ok()?, &input::name(file)).err()?,
            None => Problem::read(file).err()?,
        };
        let fault = error.problem?;
        let problem = input::load(file, &Default::default()).ok()?.problem;
        let (found, standing) = Decomposition::led(&problem).ok()?;
        Some(Loose {
            fault: fault.to_string(),
            census: surplus(&problem).ok()?,
            problem,
            found,
            standing,
        })
    }

    /// A message about constraints that depend on each other, with what is known of them.
    fn decide(&self, message: &str) -> String {
        match &self.standing.too_many {
            TooMany::None | TooMany::Undecided => message.to_owned(),
            TooMany::Follow => message.replacen(DEPENDS, "follows from the others", 1),
            // Half a unit of its own last digit is not all that may be off: so may be the others'.
            TooMany::Contradict { name, .. } if self.is_within_digits(name) => format!(
                "{message}; {name} is missed at the figure to which the sketch leads, by no more than the digits of the others \
                 explain"
            ),
            TooMany::Contradict { name, is_proved } => {
                let at = match is_proved {
                    true => "",
                    false => " at the figure to which the sketch leads",
                };
                // Distances stand there without quotes.
                let plain = name.trim_matches('`');
                let is_listed = [",", " "]
                    .iter()
                    .any(|end| message.contains(&format!(" {plain}{end}")));
                // Of several that depend on each other in different ways the message lists those of one.
                let left_out = self.found.account.left_out.iter();
                let is_one = left_out.filter(|one| one.why != Why::Follows).count() <= 1;
                let is_sided = ["`distances:", "`tangent:"]
                    .iter()
                    .any(|kind| message.contains(kind));
                let sides = match *is_proved && is_sided {
                    true => ", with all on the side where the sketch has it",
                    false => "",
                };
                match is_one && (is_listed || message.contains(name)) {
                    true => {
                        message.replacen(DEPENDS, &format!("contradicts the others{at}{sides}"), 1)
                    }
                    false => format!("{message}; {name} contradicts the others{at}{sides}"),
                }
            }
        }
    }

    /// Whether what a constraint is missed by is within what the digits of the numbers allow: wherever constraints depend on each
    /// other and it is one of these.
    fn is_within_digits(&self, name: &str) -> bool {
        let all = self.census.surplus.iter();
        let is_of_it = |one: &&Surplus| one.name == name || one.others.iter().any(|o| o == name);
        let mut of_it = all.filter(is_of_it).peekable();
        of_it.peek().is_some()
            && of_it.all(|one| {
                matches!(
                    one.finding,
                    Finding::Follows | Finding::Rounded { .. } | Finding::Met
                )
            })
    }

    /// What is wrong, what was understood, what is free, and the blocks.
    fn in_words(&self) -> String {
        // Of figures without a frame of their own, and of fixed directions, `solve` takes no loose ones.
        let is_solved =
            fix_frame(&self.problem) && self.problem.fixed_directions().next().is_none();
        let taken = match (self.standing.is_taken, is_solved) {
            (true, true) => "; `krawl solve` and `krawl edit` take it as it is",
            (true, false) => "; `krawl edit` takes it as it is",
            (false, _) => "",
        };
        let fault = self.decide(&self.fault);
        let mut text = format!("{}: not in order: {fault}{taken}\n", self.problem.name);
        text += &in_rows(&understood(&self.problem));
        text += &in_rows(&[freedom(&self.census)]);
        text += &surplus_in_words(&self.census);
        let mut found = self.found.clone();
        of_census(&mut found, &self.census);
        text + &decomposition_in_words(&found)
    }
}

/// How a figure up to motions falls apart, once its reference is held.
fn held_in_words(problem: &Problem, census: &Census) -> String {
    let Some(held) = pinned(problem) else {
        return String::new();
    };
    let text = blocks_in_words(&decomposed(&held, census));
    text.replacen("blocks", "blocks, with the reference held", 1)
}

/// How a figure of distances falls apart at sides that its parts share.
fn clusters_in_words(problem: &Problem) -> String {
    const MOST: usize = 20;
    let blocks = clusters(problem);
    if problem.points.len() > MOST_POINTS {
        return format!("blocks\n  not looked for: there are more than {MOST_POINTS} points\n");
    }
    if blocks.is_empty() {
        return "blocks\n  1: it does not fall apart\n".to_owned();
    }
    let what = match problem.dimension {
        2 => "a side",
        _ => "a triangle of sides",
    };
    let mut text = format!(
        "blocks\n  {}, which share no more than {what}\n",
        blocks.len()
    );
    for (index, block) in blocks.iter().enumerate().take(MOST) {
        let names: Vec<&str> = block.points.iter().map(|p| p.name.as_str()).collect();
        text += &format!("  {}: {}\n", index + 1, names.join(", "));
    }
    if blocks.len() > MOST {
        text += &format!("  and {} more\n", blocks.len() - MOST);
    }
    text
}

/// What makes the sketch or the target singular or impossible, and what can be mirrored, as lines of text.
fn remarks_in_words(problem: &Problem) -> String {
    const MOST: usize = 12;
    let found = remarks(problem);
    let lines = found.iter().take(MOST).map(|remark| {
        let label = if remark.is_warning() {
            "warning"
        } else {
            "note"
        };
        format!("{label}: {}\n", in_words(problem, remark))
    });
    let mut text: String = lines.collect();
    if let Some(moves) = moves(problem) {
        text += &format!("warning: {}\n", moves.in_words(problem));
    }
    if found.len() > MOST {
        text += &format!("and {} more of these\n", found.len() - MOST);
    }
    text
}

/// The construction plan with its driving parameters and removed constraints, and the pattern of
/// the Jacobian that comes of it, as lines of text.
fn construction_plan(problem: &Problem, always: bool) -> Result<String, GaugeError> {
    let homotopy = Homotopy::new(problem)?;
    let plan = Plan::derive(&homotopy);
    let indent = |text: &str| text.lines().map(|line| format!("  {line}\n")).collect();
    let described: String = indent(&plan.describe(problem));
    let mut text = format!("construction plan\n{described}");
    if always || homotopy.equations <= PATTERN {
        let pattern: String = indent(&pattern(problem, &homotopy, &plan));
        text += "Jacobian (columns: key unknowns, then what follows from those to the left; \
                 rows: distances, removed constraints last)\n";
        text += &pattern;
    }
    Ok(text)
}

/// The pattern of the Jacobian under the plan: constraints by name, and coordinates.
fn pattern(problem: &Problem, homotopy: &Homotopy, plan: &Plan) -> String {
    let jacobian = plan.jacobian(homotopy, &homotopy.sketch);
    let distances: Vec<String> = (0..problem.distances.len())
        .map(|index| problem.distance_name(index))
        .collect();
    let coordinates: Vec<String> = homotopy
        .gauge
        .place
        .iter()
        .map(|&place| {
            let (point, axis) = (place / homotopy.dimension, place % homotopy.dimension);
            format!("{}.{}", problem.points[point].name, ["x", "y", "z"][axis])
        })
        .collect();
    jacobian
        .ordering()
        .render(&jacobian.equations, &distances, &coordinates)
}

/// Rows of labels and what stands beside them, as lines of text.
fn in_rows(rows: &[(&str, String)]) -> String {
    let lines = rows.iter();
    lines
        .map(|(label, value)| format!("  {label:<20}{value}\n"))
        .collect()
}

/// The stereocentres of a molecule, as lines of text.
fn stereocentres(imported: &Imported) -> String {
    let letters = imported.skeleton.iter().flat_map(Skeleton::letters);
    let rows = letters.map(|(atom, letter)| {
        let name = &imported.problem.points[atom].name;
        let words = match letter {
            Ok(letter) => format!("{name}, {letter} in the file"),
            Err(why) => format!("{name}, neither R nor S, as {why}"),
        };
        ("stereocentre", words)
    });
    in_rows(&rows.collect::<Vec<_>>())
}

/// What a problem consists of, as it was understood.
fn understood(problem: &Problem) -> Vec<(&'static str, String)> {
    let mut rows: Vec<(&str, String)> = Vec::new();
    if !problem.source.is_empty() {
        rows.push(("source", problem.source.clone()));
    }
    let space = if problem.dimension == 2 {
        "2, the plane"
    } else {
        "3, space"
    };
    if !problem.points.is_empty() {
        rows.push(("dimension", space.to_owned()));
        rows.push(("points", problem.points.len().to_string()));
    }
    let squared = problem
        .distances
        .iter()
        .filter(|d| matches!(d.target, Target::SquaredLength(_)))
        .count();
    let distances = problem.distances.len();
    if !problem.points.is_empty() {
        rows.push((
            "distances",
            match squared {
                0 => distances.to_string(),
                _ => format!("{distances}, {squared} of them given by their squares"),
            },
        ));
    }
    for object in &problem.objects {
        rows.push(("object", object_line(problem, object)));
    }
    for (index, constraint) in problem.constraints.iter().enumerate() {
        let kind = krawl::constraint::kind(&constraint.kind).expect("the problem was checked");
        let name = problem.constraint_name(index);
        let read = krawl::constraint::read_as(problem, index);
        let read = read.map_or_else(String::new, |read| format!("here of {read}: "));
        let meaning = kind.meaning;
        rows.push(("constraint", format!("{name} ({read}{meaning})")));
    }
    for index in 0..problem.orientations.len() {
        let name = problem.orientation_name(index);
        rows.push((
            "sign",
            format!("{name} (which way round these points are in the figures wanted)"),
        ));
    }
    rows
}

/// What is in a problem; with `blocks` of one that has not been checked, of which is said first what is free.
fn describe(
    problem: &Problem,
    blocks: Option<&Result<Decomposition, String>>,
    census: &Census,
) -> String {
    let mut rows = understood(problem);
    let free = problem.free_coordinates();
    for (name, value) in &problem.parameters {
        let computed = value
            .expression()
            .map_or(String::new(), |by| format!(", as {by}"));
        rows.push(("parameter", format!("{name} = {value}{computed}")));
    }
    if !problem.points.is_empty() {
        rows.push(("free coordinates", free.to_string()));
    }
    if !problem.is_distances_only() && !matches!(blocks, Some(Err(_))) {
        let (unknowns, equations) = krawl::constraint::size(problem);
        rows.push((
            "equations",
            match problem.points.is_empty() {
                true => format!("{equations}, for {unknowns} unknowns"),
                false => format!(
                    "{equations}, for {free} coordinates and {} auxiliary unknowns",
                    unknowns - free
                ),
            },
        ));
    }
    rows.push(freedom(census));
    if !problem.points.is_empty() {
        rows.push(frame(problem));
    }
    let homotopy = &problem.homotopy;
    if let Some(bend) = problem.bend() {
        let c = &homotopy.bend_coefficient;
        let remark = if c.is_positive() {
            ""
        } else {
            " (not greater than zero: nothing makes the path turn back)"
        };
        let bend = problem.distance_name(bend);
        rows.push(("bend", format!("{bend}, c = {c}{remark}")));
    }

    let surplus = too_many(census);
    let words = match blocks {
        None => "the input is in order".to_owned(),
        Some(Ok(found)) => freedom_of_sketch_in_words(found),
        Some(Err(fault)) => format!("not in order: {fault}"),
    };
    let too_many = || {
        format!(
            "over-constrained: {} too many",
            counted(surplus, "constraint")
        )
    };
    let state = match (surplus, words.as_str()) {
        (0, _) => words,
        (_, "the input is in order") => too_many(),
        _ => format!("{words}; {}", too_many()),
    };
    format!("{}: {state}\n{}", problem.name, in_rows(&rows))
}

/// In how many ways a figure can still move, as a row of text.
fn freedom(census: &Census) -> (&'static str, String) {
    ("degrees of freedom", census.freedom.in_words())
}

/// Where coordinates are counted from.
fn frame(problem: &Problem) -> (&'static str, String) {
    let reference = &problem.homotopy.reference;
    if problem.is_absolute() {
        let axes = krawl::constraint::pinned_axes(problem);
        let axes: Vec<&str> = axes.into_iter().map(|k| ["x", "y", "z"][k]).collect();
        let held = match axes.as_slice() {
            _ if problem.points.is_empty() => String::new(),
            [] => String::new(),
            axes => format!(
                "; as nothing says where it is along {}, {} is held where the sketch has it",
                axes.join(" and "),
                problem.points[0].name
            ),
        };
        return ("frame", format!("the sketch's own coordinates{held}"));
    }
    let names = names(problem, reference);
    let in_one_body = problem.objects.iter().any(|object| {
        let points = object.points();
        object.kind(problem.dimension) == "body" && reference.iter().all(|p| points.contains(p))
    });
    let mutually = in_one_body
        || reference
            .iter()
            .enumerate()
            .all(|(k, &a)| reference[..k].iter().all(|&b| problem.are_joined(a, b)));
    let mutually = if mutually {
        "mutually constrained"
    } else {
        "not mutually constrained: the coordinates may become singular where the figure is not"
    };
    ("reference", format!("{} ({mutually})", names.join(", ")))
}

/// What is said of an object.
fn object_line(problem: &Problem, object: &Object) -> String {
    let names = |points: &[usize]| names(problem, points).join(", ");
    let name = &object.name;
    match &object.shape {
        Shape::Line(points) => format!("{name}, the line through {}", names(points)),
        Shape::FreeLine { .. } => format!("{name}, a line of its own"),
        Shape::Plane(points) => format!("{name}, the plane through {}", names(points)),
        Shape::FreePlane { .. } => format!("{name}, a plane of its own"),
        Shape::Round { center, radius } => {
            let what = if problem.dimension == 2 {
                "circle"
            } else {
                "sphere"
            };
            format!(
                "{name}, a {what} about {} (in the sketch {radius})",
                names(&[*center])
            )
        }
        Shape::Arc { center, start, end } => format!(
            "{name}, an arc about {} from {} to {}",
            names(&[*center]),
            names(&[*start]),
            names(&[*end])
        ),
        Shape::Number { sketch, .. } => {
            let range = object
                .shape
                .range()
                .map(|range| format!("; {name} {range}"));
            let range = range.unwrap_or_default();
            format!("{name}, an unknown (in the sketch {sketch}{range})")
        }
        Shape::Joint { sort, bodies, .. } => {
            let [one, other] = bodies.map(|body| &problem.objects[body].name);
            format!(
                "{name}, a {} joint of {one} and {other}",
                sort.name().replace('_', " ")
            )
        }
        Shape::Body {
            points,
            place: Some(_),
            ..
        } if points.is_empty() => format!("{name}, a rigid body with joints"),
        Shape::Body { points, .. } => {
            format!("{name}, the rigid body of {} (not mirrored)", names(points))
        }
    }
}
