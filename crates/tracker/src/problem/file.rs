//! Reading problem files (TOML).
//!
//! Numbers are taken from the text of the file, never through a float, so that a decimal means
//! exactly that decimal. Every message names the file, the line and the key.

use super::builder::ProblemBuilder;
use super::cursor::{At, Line, Source, TEXT};
use super::error::{MAX_NAME, MAX_POINTS, Place};
use super::expression;
use super::{Decimal, Problem, ProblemError, Published};
use crate::constraint::{EQUATIONS, KINDS};
use std::collections::{HashMap, HashSet};
use std::fmt;
use std::io::Read;
use std::mem;
use std::path::Path;
use toml_edit::Document;

/// Most bytes of a problem file.
pub const MAX_FILE_SIZE: u64 = 1 << 20;

/// Why a file is no problem that krawl takes. Its text names file, line, key, and point or
/// constraint.
pub struct FileError {
    /// The file, as it was named.
    pub file: String,
    /// The line, counted from 1, where there is one.
    pub line: Option<usize>,
    /// What is wrong with points, distances and homotopy, where all of them could be read.
    pub problem: Option<ProblemError>,
    /// What is wrong, with the key where there is one.
    pub text: String,
}

crate::debug_in_words!(FileError);

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.text),
            None => write!(f, "{}: {}", self.file, self.text),
        }
    }
}

impl std::error::Error for FileError {}

impl FileError {
    pub(super) fn new(file: &str, line: Line, text: impl Into<String>) -> Self {
        FileError {
            file: file.to_owned(),
            line,
            problem: None,
            text: text.into(),
        }
    }

    /// Whether the file is in order but for the number of its equations, or where they are.
    pub fn is_about_structure(&self) -> bool {
        let problem = self.problem.as_ref();
        problem.is_some_and(|problem| problem.is_about_structure())
    }
}

impl Problem {
    /// Reads and checks a problem file.
    ///
    /// ```no_run
    /// let problem = krawl::problem::Problem::read("problems/disulfide.toml")?;
    /// assert_eq!(problem.distances.len(), problem.free_coordinates());
    /// # Ok::<(), krawl::problem::FileError>(())
    /// ```
    pub fn read(path: impl AsRef<Path>) -> Result<Problem, FileError> {
        let (problem, _) = Self::read_with_published(path)?;
        Ok(problem)
    }

    /// Reads and checks a problem file, with what it says was published about the problem.
    ///
    /// ```
    /// use krawl::problem::Problem;
    /// # std::env::set_current_dir("../..").unwrap();
    /// let (problem, rows) = Problem::read_with_published("problems/octahedron.toml")?;
    /// assert_eq!(problem.name, "octahedron");
    /// assert!(rows.iter().any(|row| row.space.as_deref() == Some("reduced") && row.steps == Some(173)));
    /// # Ok::<(), krawl::problem::FileError>(())
    /// ```
    pub fn read_with_published(
        path: impl AsRef<Path>,
    ) -> Result<(Problem, Vec<Published>), FileError> {
        read(path.as_ref())
    }

    /// Reads and checks a problem from the text of a file. `file` is for messages, and its stem
    /// names the problem where the text does not.
    ///
    /// ```
    /// use krawl::problem::Problem;
    /// let problem = Problem::parse(
    ///     r#"
    ///     name = "triangle"
    ///     dimension = 2
    ///     [points]
    ///     a = [0, 0]
    ///     b = [1, 0]
    ///     c = [0.4, 1.1]
    ///     [constraints]
    ///     distances = [["a", "b", 1.0], ["b", "c", 1.12]]
    ///     squared_distances = [["c", "a", 2]]
    ///     "#,
    ///     "triangle.toml",
    /// )
    /// .unwrap();
    /// assert_eq!(problem.homotopy.bend, 2);
    ///
    /// let error = Problem::parse("dimension = 4", "bad.toml").unwrap_err();
    /// assert!(error.to_string().starts_with("bad.toml:1: dimension: "));
    /// ```
    pub fn parse(text: &str, file: &str) -> Result<Problem, FileError> {
        let (problem, _) = problem(text, file, false)?;
        Ok(problem)
    }

    /// Reads a problem that need not have as many equations as unknowns, in the sketch's own frame, for
    /// [`crate::edit::Session`].
    pub fn parse_loosely(text: &str, file: &str) -> Result<Problem, FileError> {
        let (problem, _) = problem(text, file, true)?;
        Ok(problem)
    }
}

/// See [`Problem::read_with_published`].
fn read(path: &Path) -> Result<(Problem, Vec<Published>), FileError> {
    let file = path.display().to_string();
    let fail = |line, text: &str| FileError::new(&file, line, text);
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        // One byte more than allowed tells that the file is too large, however large it is.
        .and_then(|open| open.take(MAX_FILE_SIZE + 1).read_to_end(&mut bytes))
        .map_err(|error| fail(None, &format!("cannot be read: {error}")))?;
    if bytes.len() as u64 > MAX_FILE_SIZE {
        let most = MAX_FILE_SIZE >> 10;
        return Err(fail(
            None,
            &format!("is larger than the {most} KiB that are read"),
        ));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        fail(Some(line), "is not a text in UTF-8")
    })?;
    let first = text.lines().find(|line| !line.trim().is_empty());
    let is_record = first.is_some_and(|line| {
        let records = [
            "HEADER", "TITLE ", "COMPND", "REMARK", "CRYST1", "ATOM  ", "HETATM",
        ];
        records.iter().any(|record| line.starts_with(record)) && !line.contains('=')
    });
    if is_record {
        let text = "has the records of a PDB file, a molecule's atoms: give it the ending .pdb";
        return Err(fail(None, text));
    }
    problem(&text, &file, false)
}

/// What a text says.
fn problem(text: &str, file: &str, loose: bool) -> Result<(Problem, Vec<Published>), FileError> {
    let source = Source::new(text, file);
    let document = Document::parse(text).map_err(|error| source.syntax(&error))?;
    let reader = Reader {
        builder: Problem::build("", 0),
        root: At::root(&source, document.as_item()),
        parameters: Vec::new(),
        from: Vec::new(),
        led: Vec::new(),
        equations: Vec::new(),
        objects: HashSet::new(),
        places: HashMap::from([
            (Place::Name, ("name".to_owned(), None)),
            (Place::Distances, ("constraints".to_owned(), None)),
        ]),
    };
    let stem = Path::new(file).file_stem();
    let stem = stem.map_or("problem".into(), |stem| stem.to_string_lossy());
    reader.problem(&stem, loose)
}

/// What has been read of a file.
pub(super) struct Reader<'a> {
    pub(super) builder: ProblemBuilder,
    pub(super) root: At<'a>,
    /// The parameters of the file.
    pub(super) parameters: Vec<(String, Decimal)>,
    /// Where parameters begin that do not begin with their values.
    from: Vec<(&'a str, Decimal, At<'a>)>,
    /// The parameters that stand in equations.
    led: Vec<String>,
    /// The equations of one's own.
    equations: Vec<(&'a str, At<'a>)>,
    /// The names in the tables of objects.
    pub(super) objects: HashSet<&'a str>,
    /// Where the parts of the problem stand: the key and the line.
    pub(super) places: HashMap<Place, (String, Line)>,
}

impl<'a> Reader<'a> {
    fn problem(mut self, stem: &str, loose: bool) -> Result<(Problem, Vec<Published>), FileError> {
        self.root.known_keys(&[
            "name",
            "dimension",
            "source",
            "points",
            "lines",
            "planes",
            "circles",
            "spheres",
            "arcs",
            "bodies",
            "places",
            "joints",
            "robots",
            "unknowns",
            "equations",
            "constraints",
            "homotopy",
            "parameters",
            "tolerances",
            "measures",
            "published",
        ])?;
        self.parameters()?;
        self.equations()?;
        // Numbers alone are nowhere.
        let is_nowhere = self.has("unknowns") && !self.has("points") && !self.has("dimension");
        let dimension = if is_nowhere {
            2
        } else {
            let example = "dimension = 2 (plane) or 3 (space)";
            let at = self.root.need("dimension", example)?;
            match at.item.as_integer() {
                Some(d @ (2 | 3)) => d as usize,
                // Other numbers are the builder's to refuse; it cannot hold all of them.
                Some(d) => return Err(at.refused(ProblemError::dimension(d))),
                None => return Err(at.wrong("2 or 3")),
            }
        };
        let name = match self.root.get("name") {
            None => stem,
            Some(at) => {
                self.mark(Place::Name, &at);
                at.text(TEXT)?
            }
        };
        self.builder = Problem::build(name, dimension);
        if let Some(at) = self.root.get("source") {
            self.builder = self.builder.source(at.text(TEXT)?);
        }
        self.points()?;
        self.objects()?;
        self.numbers_of_parameters()?;
        self.constraints()?;
        self.homotopy()?;
        let published = self.published()?;
        let builder = mem::replace(&mut self.builder, Problem::build("", 0));
        let builder = if loose { builder.loose() } else { builder };
        let mut problem = builder.finish().map_err(|error| {
            let (key, line) = self.places.get(&error.place()).cloned().unwrap_or_default();
            let mut at = self.root.named(key);
            at.line = line;
            at.refused(error)
        })?;
        problem.tolerances = Problem::tolerances_of(&self.root)?;
        problem.measures = self.measures()?;
        for (c, constraint) in problem.constraints.iter().enumerate() {
            if let ("values", [super::Item::Object(object)]) =
                (constraint.kind.as_str(), &constraint.items[..])
                && self.led.contains(&problem.objects[*object].name)
            {
                let name = problem.objects[*object].name.clone();
                problem.labels.insert(problem.distances.len() + c, name);
            }
        }
        problem.parameters = self.parameters;
        Ok((problem, published))
    }

    /// Whether the file has this key.
    fn has(&self, key: &str) -> bool {
        self.root.get(key).is_some()
    }

    fn mark(&mut self, place: Place, at: &At) {
        self.places.insert(place, (at.key.clone(), at.line));
    }

    /// Adds to the problem what stands here.
    pub(super) fn add(
        &mut self,
        at: &At,
        with: impl FnOnce(ProblemBuilder) -> Result<ProblemBuilder, FileError>,
    ) -> Result<(), FileError> {
        let before = self.builder.counts();
        self.builder = with(mem::replace(&mut self.builder, Problem::build("", 0)))?;
        for ((place, before), after) in before.into_iter().zip(self.builder.counts()) {
            (before..after.1).for_each(|index| self.mark(place(index), at));
        }
        Ok(())
    }

    fn published(&self) -> Result<Vec<Published>, FileError> {
        let Some(at) = self.root.get("published") else {
            return Ok(Vec::new());
        };
        if !at.item.is_array_of_tables() {
            return Err(at.wrong("tables, each with the heading [[published]]"));
        }
        let all = at.values().map(|at| {
            at.known_keys(&Published::KEYS)?;
            let count = |name: &str| {
                let count = |at: At| {
                    let number = at.item.as_integer().and_then(|n| usize::try_from(n).ok());
                    number.ok_or_else(|| at.wrong("a whole number"))
                };
                at.get(name).map(count).transpose()
            };
            let seconds = |at: At| {
                let whole = at.item.as_integer().map(|n| n as f64);
                let number = at.item.as_float().or(whole);
                let number = number.filter(|x| *x > 0.0 && x.is_finite());
                number.ok_or_else(|| at.wrong("a number greater than 0"))
            };
            let space = |at: At| match at.text(TEXT)? {
                space @ ("full" | "reduced") => Ok(space.to_owned()),
                _ => Err(at.wrong("\"full\" or \"reduced\"")),
            };
            let seconds = at.get("seconds").map(seconds).transpose()?;
            let space = at.get("space").map(space).transpose()?;
            let method = at.need("method", "method = \"whose method, and where\"")?;
            Ok(Published {
                method: method.text(TEXT)?.to_owned(),
                space,
                steps: count("steps")?,
                seconds,
                solutions: count("solutions")?,
            })
        });
        all.collect()
    }

    fn points(&mut self) -> Result<(), FileError> {
        let needs_none = ["unknowns", "joints", "robots"];
        if !self.has("points") && needs_none.iter().any(|table| self.has(table)) {
            return Ok(());
        }
        let example = "[points] and below it a line p1 = [0.0, 0.0, 0.0] for each point";
        let table = self.root.need("points", example)?;
        self.mark(Place::Whole, &table.named(""));
        let points = table.entries()?;
        // Before numbers are made of them: a file has room for many.
        if points.len() > MAX_POINTS {
            let error = ProblemError::too_many_points(points.len());
            return Err(table.named("").refused(error));
        }
        for (index, (name, at)) in points.into_iter().enumerate() {
            at.is_in_place("points")?;
            let list = at.list("coordinates in brackets")?;
            let here = at.named("points");
            if list.len() != self.builder.dimension {
                let name: String = name.chars().take(MAX_NAME).collect();
                let (given, wanted) = (list.len(), self.builder.dimension);
                let error = ProblemError::coordinates(index, &name, given, wanted);
                return Err(here.refused(error));
            }
            let coordinates = list.iter().map(At::number).collect::<Result<Vec<_>, _>>()?;
            self.add(&here, |builder| Ok(builder.point(name, coordinates)))?;
        }
        Ok(())
    }

    fn constraints(&mut self) -> Result<(), FileError> {
        let needs_none = !self.equations.is_empty() || self.has("joints") || self.has("robots");
        let example = "[constraints] and below it distances = [[\"p1\", \"p2\", 1.12], ...]";
        let table = match self.root.get("constraints") {
            None if needs_none => None,
            _ => Some(self.root.need("constraints", example)?),
        };
        if let Some(table) = &table {
            self.mark(Place::Distances, table);
            table.known_keys(&Self::constraint_keys())?;
        }
        let part = |name: &str| table.as_ref().and_then(|table| table.get(name));
        for kind in KINDS {
            match part(kind.key) {
                _ if kind.key == EQUATIONS => self.own_equations()?,
                Some(at) => self.kind(kind, &at)?,
                None => {}
            }
        }
        if let Some(at) = part("squared_distances") {
            self.squared_distances(&at)?;
        }
        part("orientation").map_or(Ok(()), |at| self.orientations(&at))
    }

    /// The signs of figures that are asked for.
    fn orientations(&mut self, at: &At) -> Result<(), FileError> {
        let wanted = match self.builder.dimension {
            2 => "[\"point\", \"point\", \"point\", \"+\" or \"-\"]",
            _ => "[\"point\", \"point\", \"point\", \"point\", \"+\" or \"-\"]",
        };
        for at in at.list(&format!("a list in brackets, each entry {wanted}"))? {
            let mut names = at.texts(wanted)?;
            let is_positive = match names.pop() {
                Some("+") => true,
                Some("-") => false,
                _ => return Err(at.wrong(wanted)),
            };
            self.add(&at, |builder| Ok(builder.orientation(names, is_positive)))?;
        }
        Ok(())
    }

    fn homotopy(&mut self) -> Result<(), FileError> {
        let Some(table) = self.root.get("homotopy") else {
            return Ok(());
        };
        let choices = [
            ("reference", Place::Reference),
            ("bend", Place::Bend),
            ("bend_coefficient", Place::BendCoefficient),
            ("detour", Place::Detour),
        ];
        table.known_keys(&choices.map(|(name, _)| name))?;
        let points = "names of points in brackets, each in quotes";
        for (name, place) in choices {
            let Some(at) = table.get(name) else {
                continue;
            };
            self.mark(place, &at);
            self.add(&at, |builder| {
                Ok(match place {
                    Place::Reference => builder.reference(at.texts(points)?),
                    Place::Bend => builder.bend(at.texts(points)?),
                    Place::BendCoefficient => builder.bend_coefficient(at.number()?),
                    _ => builder.detour(at.number()?),
                })
            })?;
        }
        Ok(())
    }

    fn parameters(&mut self) -> Result<(), FileError> {
        let Some(table) = self.root.get("parameters") else {
            return Ok(());
        };
        for (name, at) in table.entries()? {
            at.is_in_place("parameters")?;
            if !expression::is_name(name) {
                let wanted = "a name of letters, digits and underscores, a letter first";
                let shown: String = name.chars().take(60).collect();
                return Err(at.is_wrong(wanted, &format!("`{shown}`")));
            }
            let wanted = "a number, or an expression in quotes of those before, \"width/2 + 3\"";
            let number = |of: &At| match of.item.as_str() {
                Some(text) => {
                    expression::evaluate(text, &self.parameters).map_err(|why| at.fault(why))
                }
                None if of.is_number() => of.named(&*at.key).number(),
                None => Err(at.wrong(wanted)),
            };
            let mut value = Some(at.clone());
            if at.item.is_table_like() {
                at.known_keys(&["value", "from"])?;
                if let Some(from) = at.get("from") {
                    self.from.push((name, number(&from)?, from));
                }
                value = at.get("value");
            }
            let value = number(&value.ok_or_else(|| at.wrong(wanted))?)?;
            self.parameters.push((name.to_owned(), value));
        }
        Ok(())
    }

    /// The equations of one's own, as texts: before all tables, or among the constraints.
    fn equations(&mut self) -> Result<(), FileError> {
        let tables = [self.root.get("constraints"), Some(self.root.clone())];
        let lists = tables.iter().flatten().filter_map(|at| at.get(EQUATIONS));
        let wanted = "a list of equations in quotes, [\"x^2 + y^2 = 2\", \"x*y = 1\"]";
        for list in lists {
            for at in list.list(wanted)? {
                self.equations.push((at.text(wanted)?, at));
            }
        }
        Ok(())
    }

    /// Parameters that stand in equations are unknowns that are led to their values.
    fn numbers_of_parameters(&mut self) -> Result<(), FileError> {
        for (name, value) in self.parameters.clone() {
            let mut equations = self.equations.iter();
            let used = equations.find(|(text, _)| expression::names(text).any(|n| n == name));
            let from = self.from.iter().find(|(other, ..)| *other == name);
            match (used, from) {
                (None, None) => continue,
                (None, Some((_, _, at))) => {
                    let found = "one that stands in none";
                    return Err(at.is_wrong("of a parameter in `equations`", found));
                }
                (Some((_, at)), _) if self.objects.contains(&*name) => {
                    let wanted = "names that mean one thing, an object or a parameter";
                    return Err(at.is_wrong(wanted, &format!("`{name}`, which is both")));
                }
                _ => {}
            }
            let from = from.map_or(value, |(_, from, _)| from.clone());
            let here = self.root.named("parameters");
            self.add(&here, |builder| Ok(builder.unknown(&name, from)))?;
            self.led.push(name);
        }
        Ok(())
    }

    /// The values of those parameters, and the equations.
    fn own_equations(&mut self) -> Result<(), FileError> {
        let here = self.root.named("parameters");
        for name in self.led.clone() {
            let mut parameters = self.parameters.iter();
            let found = parameters.find(|(other, _)| *other == name);
            let (_, value) = found.expect("what is led is a parameter");
            let value = value.clone().computed_by(&name);
            self.add(&here, |builder| {
                Ok(builder.dimension("values", [name], value))
            })?;
        }
        for (text, at) in self.equations.clone() {
            self.add(&at, |builder| Ok(builder.equation(text)))?;
        }
        Ok(())
    }

    fn measures(&self) -> Result<Vec<(String, String)>, FileError> {
        let Some(table) = self.root.get("measures") else {
            return Ok(Vec::new());
        };
        let all = table.entries()?.into_iter().map(|(name, at)| {
            let what = at.text(TEXT)?;
            if name.trim().is_empty() || name.contains(|c: char| c == '=' || c.is_control()) {
                let found = "one without a name, or with `=` in it";
                return Err(at.is_wrong("of a measure with a name", found));
            }
            Ok((name.to_owned(), what.to_owned()))
        });
        all.collect()
    }
}
