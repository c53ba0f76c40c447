//! Reading problem files (TOML).
//!
//! Numbers are taken from the text of the file, never through a float, so that a decimal means
//! exactly that decimal. Every message names the file, the line and the key.

use super::builder::ProblemBuilder;
use super::error::{MAX_NAME, MAX_POINTS, Place, did_you_mean};
use super::expression;
use super::{Decimal, DecimalError, Problem, ProblemError, Published};
use crate::constraint::{EQUATIONS, KINDS};
use crate::statement::{Tolerances, nearest};
use std::collections::{HashMap, HashSet};
use std::fmt;
use std::io::Read;
use std::ops::Range;
use std::path::Path;
use toml_edit::{Document, Item, Key, TableLike, Value};

/// Most bytes of a problem file.
pub const MAX_FILE_SIZE: u64 = 1 << 20;

/// Why a file is no problem that krawl takes. Its text names file, line, key, and point or
/// constraint.
pub struct FileError {
    /// The file, as it was named.
    pub file: String,
    /// The line, counted from 1, where there is one.
    pub line: Option<usize>,
    /// What is wrong.
    pub fault: Box<FileFault>,
}

crate::debug_in_words!(FileError);

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum FileFault {
    /// It cannot be opened or read.
    #[error("cannot be read: {0}")]
    Unreadable(std::io::Error),
    /// It is too big to be a problem.
    #[error("is larger than the {} KiB that are read", MAX_FILE_SIZE >> 10)]
    TooLarge,
    /// It is not a text.
    #[error("is not a text in UTF-8")]
    NotUtf8,
    /// It is a molecule of the Protein Data Bank.
    #[error("has the records of a PDB file, a molecule's atoms: give it the ending .pdb")]
    Pdb,
    /// It is not TOML.
    #[error("{0}")]
    Syntax(String),
    /// A key has no meaning here.
    #[error("{key}: there is no such key{}", did_you_mean(.nearest))]
    UnknownKey {
        /// The whole key, with the tables it is in.
        key: String,
        /// The most similar one that has a meaning.
        nearest: Option<String>,
    },
    /// A key is needed.
    #[error("{key}: is missing; write {example}")]
    MissingKey {
        /// The whole key.
        key: String,
        /// How it could look.
        example: &'static str,
    },
    /// A value is of the wrong kind.
    #[error("{key}: must be {wanted}, and is {found}")]
    WrongKind {
        /// The whole key.
        key: String,
        /// What belongs there.
        wanted: String,
        /// What is there.
        found: String,
    },
    /// A number is not a finite decimal.
    #[error("{key}: {source}")]
    Number {
        /// The whole key.
        key: String,
        /// What is wrong with it.
        source: DecimalError,
    },
    /// An expression cannot be computed.
    #[error("{key}: {why}")]
    Expression {
        /// The whole key.
        key: String,
        /// What is wrong with it, and where.
        why: String,
    },
    /// Points, distances and homotopy do not fit together.
    #[error("{key}{error}")]
    Problem {
        /// The whole key with a colon, or nothing where the file as a whole is meant.
        key: String,
        /// What is wrong.
        error: ProblemError,
    },
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}: {}", self.file, self.fault),
            None => write!(f, "{}: {}", self.file, self.fault),
        }
    }
}

impl FileError {
    /// Whether the file is in order but for the number of its equations, or where they are.
    pub fn is_about_structure(&self) -> bool {
        match &*self.fault {
            FileFault::Problem { error, .. } => error.is_about_structure(),
            _ => false,
        }
    }
}

impl std::error::Error for FileError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &*self.fault {
            FileFault::Unreadable(error) => Some(error),
            FileFault::Number { source, .. } => Some(source),
            FileFault::Problem { error, .. } => Some(error),
            _ => None,
        }
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
        let (problem, _) = Reader::new(text, file).problem()?;
        Ok(problem)
    }

    /// Reads a problem that need not have as many equations as unknowns, in the sketch's own frame, for
    /// [`crate::edit::Session`].
    pub fn parse_loosely(text: &str, file: &str) -> Result<Problem, FileError> {
        let reader = Reader {
            loose: true,
            ..Reader::new(text, file)
        };
        let (problem, _) = reader.problem()?;
        Ok(problem)
    }
}

/// See [`Problem::read_with_published`].
fn read(path: &Path) -> Result<(Problem, Vec<Published>), FileError> {
    let file = path.display().to_string();
    let fail = |line, fault| FileError {
        file: file.clone(),
        line,
        fault: Box::new(fault),
    };
    let mut bytes = Vec::new();
    std::fs::File::open(path)
        // One byte more than allowed tells that the file is too large, however large it is.
        .and_then(|open| open.take(MAX_FILE_SIZE + 1).read_to_end(&mut bytes))
        .map_err(|error| fail(None, FileFault::Unreadable(error)))?;
    if bytes.len() as u64 > MAX_FILE_SIZE {
        return Err(fail(None, FileFault::TooLarge));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = 1 + valid.iter().filter(|&&byte| byte == b'\n').count();
        fail(Some(line), FileFault::NotUtf8)
    })?;
    let first = text.lines().find(|line| !line.trim().is_empty());
    let is_record = first.is_some_and(|line| {
        let records = [
            "HEADER", "TITLE ", "COMPND", "REMARK", "CRYST1", "ATOM  ", "HETATM",
        ];
        records.iter().any(|record| line.starts_with(record)) && !line.contains('=')
    });
    if is_record {
        return Err(fail(None, FileFault::Pdb));
    }
    Reader::new(&text, &file).problem()
}

/// A text and its name.
pub(super) struct Reader<'a> {
    text: &'a str,
    file: &'a str,
    /// Where the lines end.
    line_ends: Vec<usize>,
    /// Whether the problem need not be well constrained.
    loose: bool,
}

/// Where the parts of a problem stand in the file.
#[derive(Default)]
pub(super) struct Places {
    /// The parameters of the file.
    pub(super) parameters: Vec<(String, Decimal)>,
    /// Where parameters begin that do not begin with their values.
    from: Vec<(String, Decimal, Line)>,
    /// The parameters that stand in equations.
    led: Vec<String>,
    /// The equations of one's own: the key, the line and the text.
    equations: Vec<(&'static str, Line, String)>,
    name: Option<usize>,
    dimension: Option<usize>,
    points: Vec<Option<usize>>,
    points_table: Option<usize>,
    constraints: Option<usize>,
    /// Lengths first, then squares.
    pub(super) distances: Vec<(&'static str, Option<usize>)>,
    /// Bodies, and the lines of `[places]` that say where they are drawn.
    pub(super) poses: HashMap<String, Line>,
    /// Tables of objects and where each object stands.
    pub(super) objects: Vec<(&'static str, Option<usize>)>,
    /// Kinds of constraints and where each constraint stands.
    pub(super) constraints_of_kinds: Vec<(&'static str, Option<usize>)>,
    orientations: Vec<Line>,
    detour: Option<usize>,
    reference: Option<usize>,
    bend: Option<usize>,
    bend_coefficient: Option<usize>,
}

pub(super) type Line = Option<usize>;

impl<'a> Reader<'a> {
    fn new(text: &'a str, file: &'a str) -> Self {
        let bytes = text.bytes().enumerate();
        let line_ends = bytes.filter(|&(_, byte)| byte == b'\n').map(|(at, _)| at);
        Reader {
            text,
            file,
            line_ends: line_ends.collect(),
            loose: false,
        }
    }

    fn problem(&self) -> Result<(Problem, Vec<Published>), FileError> {
        let document = Document::parse(self.text).map_err(|error| self.syntax(&error))?;
        let root = document.as_table();
        self.known_keys(
            root,
            "",
            &[
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
            ],
        )?;
        let mut places = Places::default();
        self.parameters(root, &mut places)?;
        self.equations(root, &mut places)?;

        let dimension = match self.get(root, "dimension") {
            // Numbers alone are nowhere.
            None if root.contains_key("unknowns") && !root.contains_key("points") => 2,
            None => return Err(self.missing("dimension", "dimension = 2 (plane) or 3 (space)")),
            Some((line, item)) => {
                places.dimension = line;
                match item.as_value() {
                    // Other numbers are the builder's to refuse; it cannot hold all of them.
                    Some(Value::Integer(d)) if matches!(*d.value(), 2 | 3) => *d.value() as usize,
                    Some(Value::Integer(d)) => {
                        let error = ProblemError::Dimension(d.value().to_string());
                        return Err(self.in_problem(&places, error));
                    }
                    _ => return Err(self.wrong_kind(line, "dimension", "2 or 3", item)),
                }
            }
        };
        let name = match self.get(root, "name") {
            None => {
                let stem = Path::new(self.file).file_stem();
                stem.map_or("problem".into(), |stem| stem.to_string_lossy().into_owned())
            }
            Some((line, item)) => {
                places.name = line;
                self.string(line, "name", item)?
            }
        };
        let mut builder = Problem::build(&name, dimension);
        if let Some((line, item)) = self.get(root, "source") {
            builder = builder.source(&self.string(line, "source", item)?);
        }
        builder = self.points(root, dimension, builder, &mut places)?;
        let (with_objects, objects) = self.objects(root, builder, &mut places)?;
        let with_objects = self.numbers_of_parameters(&objects, with_objects, &mut places)?;
        builder = self.constraints(root, &objects, with_objects, &mut places)?;
        builder = self.homotopy(root, builder, &mut places)?;
        let published = self.published(root)?;
        if self.loose {
            builder = builder.loose();
        }
        let problem = builder.finish();
        let mut problem = problem.map_err(|error| self.in_problem(&places, error))?;
        problem.tolerances = self.tolerances(root)?;
        problem.measures = self.measures(root)?;
        for (c, constraint) in problem.constraints.iter().enumerate() {
            if let ("values", [super::Item::Object(object)]) =
                (constraint.kind.as_str(), &constraint.items[..])
                && places.led.contains(&problem.objects[*object].name)
            {
                let name = problem.objects[*object].name.clone();
                problem.labels.insert(problem.distances.len() + c, name);
            }
        }
        problem.parameters = places.parameters;
        Ok((problem, published))
    }

    /// Whether a file has something beside points to be sought.
    fn needs_no_points(root: &dyn TableLike) -> bool {
        ["unknowns", "joints", "robots"]
            .iter()
            .any(|table| root.contains_key(table))
    }

    fn published(&self, root: &dyn TableLike) -> Result<Vec<Published>, FileError> {
        let Some((line, item)) = self.get(root, "published") else {
            return Ok(Vec::new());
        };
        let Some(tables) = item.as_array_of_tables() else {
            let wanted = "tables, each with the heading [[published]]";
            return Err(self.wrong_kind(line, "published", wanted, item));
        };
        tables
            .iter()
            .map(|table| {
                self.known_keys(table, "published.", &Published::KEYS)?;
                let text = |name: &str| {
                    let found = self.get(table, name);
                    found
                        .map(|(line, item)| self.string(line, &format!("published.{name}"), item))
                        .transpose()
                };
                let count = |name: &str| {
                    let Some((line, item)) = self.get(table, name) else {
                        return Ok(None);
                    };
                    let number = item.as_integer().and_then(|n| usize::try_from(n).ok());
                    let key = format!("published.{name}");
                    number
                        .map(Some)
                        .ok_or_else(|| self.wrong_kind(line, &key, "a whole number", item))
                };
                let seconds = match self.get(table, "seconds") {
                    None => None,
                    Some((line, item)) => {
                        let number = item
                            .as_float()
                            .or_else(|| item.as_integer().map(|n| n as f64))
                            .filter(|x| *x > 0.0 && x.is_finite());
                        let wanted = "a number greater than 0";
                        let wrong = || self.wrong_kind(line, "published.seconds", wanted, item);
                        Some(number.ok_or_else(wrong)?)
                    }
                };
                let space = text("space")?;
                if let Some(space) = &space
                    && !["full", "reduced"].contains(&space.as_str())
                {
                    let (line, item) = self.get(table, "space").expect("it was just read");
                    let wanted = "\"full\" or \"reduced\"";
                    return Err(self.wrong_kind(line, "published.space", wanted, item));
                }
                Ok(Published {
                    method: text("method")?.ok_or_else(|| {
                        self.missing("published.method", "method = \"whose method, and where\"")
                    })?,
                    space,
                    steps: count("steps")?,
                    seconds,
                    solutions: count("solutions")?,
                })
            })
            .collect()
    }

    fn points(
        &self,
        root: &dyn TableLike,
        dimension: usize,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        const EXAMPLE: &str = "[points] and below it a line p1 = [0.0, 0.0, 0.0] for each point";
        let Some((line, item)) = self.get(root, "points") else {
            return match Self::needs_no_points(root) {
                true => Ok(builder),
                false => Err(self.missing("points", EXAMPLE)),
            };
        };
        places.points_table = line;
        let table = self.table(line, "points", item)?;
        // Before numbers are made of them: a file has room for many.
        if table.len() > MAX_POINTS {
            return Err(self.in_problem(places, ProblemError::TooManyPoints(table.len())));
        }
        for (index, (name, item)) in table.iter().enumerate() {
            let line = self.line(table.key(name).and_then(Key::span));
            let key = format!("points.{name}");
            self.is_in_place(line, "points", name, item)?;
            let wanted = "coordinates in brackets";
            let Some(array) = item.as_array() else {
                return Err(self.wrong_kind(line, &key, wanted, item));
            };
            places.points.push(line);
            if array.len() != dimension {
                let error = ProblemError::CoordinateCount {
                    index,
                    name: name.chars().take(MAX_NAME).collect(),
                    given: array.len(),
                    wanted: dimension,
                };
                return Err(self.in_problem(places, error));
            }
            let coordinates = array.iter().map(|value| self.number(line, &key, value));
            builder = builder.point(name, coordinates.collect::<Result<Vec<Decimal>, _>>()?);
        }
        Ok(builder)
    }

    fn constraints(
        &self,
        root: &dyn TableLike,
        objects: &HashSet<String>,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        const EXAMPLE: &str =
            "[constraints] and below it distances = [[\"p1\", \"p2\", 1.12], ...]";
        let none = toml_edit::Table::new();
        let table: &dyn TableLike = match self.get(root, "constraints") {
            None if places.equations.is_empty()
                && !root.contains_key("joints")
                && !root.contains_key("robots") =>
            {
                return Err(self.missing("constraints", EXAMPLE));
            }
            None => &none,
            Some((line, item)) => {
                places.constraints = line;
                self.table(line, "constraints", item)?
            }
        };
        self.known_keys(table, "constraints.", &Self::constraint_keys())?;
        for kind in KINDS {
            builder = match kind.key {
                EQUATIONS => self.own_equations(builder, places),
                _ => self.kind(kind, table, objects, builder, places)?,
            };
        }
        builder = self.squared_distances(table, builder, places)?;
        self.orientations(table, builder, places)
    }

    /// The signs of figures that are asked for.
    fn orientations(
        &self,
        table: &dyn TableLike,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        let key = "constraints.orientation";
        let Some((line, item)) = self.get(table, "orientation") else {
            return Ok(builder);
        };
        let wanted = match builder.dimension {
            2 => "[\"point\", \"point\", \"point\", \"+\" or \"-\"]",
            _ => "[\"point\", \"point\", \"point\", \"point\", \"+\" or \"-\"]",
        };
        let Some(array) = item.as_array() else {
            let wanted = format!("a list in brackets, each entry {wanted}");
            return Err(self.wrong_kind(line, key, &wanted, item));
        };
        for value in array {
            let line = self.line(value.span()).or(line);
            let wrong = |found: &Value| self.wrong_value(line, key, wanted, found);
            let parts = value.as_array().ok_or_else(|| wrong(value))?;
            let names = parts
                .iter()
                .map(|part| part.as_str().ok_or_else(|| wrong(part)));
            let mut names = names.collect::<Result<Vec<&str>, FileError>>()?;
            let is_positive = match names.pop() {
                Some("+") => true,
                Some("-") => false,
                _ => return Err(wrong(value)),
            };
            places.orientations.push(line);
            builder = builder.orientation(names, is_positive);
        }
        Ok(builder)
    }

    fn squared_distances(
        &self,
        table: &dyn TableLike,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        let key = "constraints.squared_distances";
        let Some((line, item)) = self.get(table, "squared_distances") else {
            return Ok(builder);
        };
        let wanted = "a list of [\"point\", \"point\", number] in brackets";
        let Some(array) = item.as_array() else {
            return Err(self.wrong_kind(line, key, wanted, item));
        };
        for value in array {
            let line = self.line(value.span());
            let wanted = "[\"point\", \"point\", number]";
            let Some(array) = value.as_array() else {
                return Err(self.wrong_value(line, key, wanted, value));
            };
            let parts: Vec<&Value> = array.iter().collect();
            let [a, b, number] = parts.as_slice() else {
                let found = format!("a list of {}", parts.len());
                return Err(self.wrong(line, key, wanted, found));
            };
            let ends = [a, b].map(|end| {
                let name = end.as_str();
                name.ok_or_else(|| self.wrong_value(line, key, "a point's name in quotes", end))
            });
            let [a, b] = ends;
            let (a, b) = (a?, b?);
            let shown = |name: &str| name.chars().take(40).collect::<String>();
            let here = format!("{key}: {}-{}", shown(a), shown(b));
            let number = self.number_of(line, &here, number, places)?;
            builder = builder.squared_distance(a, b, number);
            places.distances.push((key, line));
        }
        Ok(builder)
    }

    fn homotopy(
        &self,
        root: &dyn TableLike,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        let Some((line, item)) = self.get(root, "homotopy") else {
            return Ok(builder);
        };
        let table = self.table(line, "homotopy", item)?;
        self.known_keys(
            table,
            "homotopy.",
            &["reference", "bend", "bend_coefficient", "detour"],
        )?;
        if let Some((line, item)) = self.get(table, "reference") {
            places.reference = line;
            builder = builder.reference(self.point_names(line, "homotopy.reference", item)?);
        }
        if let Some((line, item)) = self.get(table, "bend") {
            places.bend = line;
            builder = builder.bend(self.point_names(line, "homotopy.bend", item)?);
        }
        if let Some((line, item)) = self.get(table, "bend_coefficient") {
            places.bend_coefficient = line;
            let key = "homotopy.bend_coefficient";
            let Some(value) = item.as_value() else {
                return Err(self.wrong_kind(line, key, "a number", item));
            };
            builder = builder.bend_coefficient(self.number(line, key, value)?);
        }
        if let Some((line, item)) = self.get(table, "detour") {
            places.detour = line;
            let key = "homotopy.detour";
            let Some(value) = item.as_value() else {
                return Err(self.wrong_kind(line, key, "a number", item));
            };
            builder = builder.detour(self.number(line, key, value)?);
        }
        Ok(builder)
    }

    fn parameters(&self, root: &dyn TableLike, places: &mut Places) -> Result<(), FileError> {
        let out = &mut places.parameters;
        let Some((line, item)) = self.get(root, "parameters") else {
            return Ok(());
        };
        for (name, item) in self.table(line, "parameters", item)?.iter() {
            let shown: String = name.chars().take(60).collect();
            let key = format!("parameters.{shown}");
            let line = self.line(item.span()).or(line);
            self.is_in_place(line, "parameters", name, item)?;
            if !expression::is_name(name) {
                let wanted = "a name of letters, digits and underscores, a letter first";
                return Err(self.wrong(line, &key, wanted, format!("`{shown}`")));
            }
            let wanted = "a number, or an expression in quotes of those before, \"width/2 + 3\"";
            let number = |value: &Value, out: &[(String, Decimal)]| match value {
                Value::String(text) => self.computed(line, &key, text.value(), out),
                Value::Integer(_) | Value::Float(_) => self.number(line, &key, value),
                _ => Err(self.wrong_kind(line, &key, wanted, item)),
            };
            let value = match item.as_table_like() {
                None => item.as_value(),
                Some(parts) => {
                    self.known_keys(parts, &format!("{key}."), &["value", "from"])?;
                    if let Some(from) = parts.get("from").and_then(Item::as_value) {
                        let from = number(from, out)?;
                        places.from.push((name.to_owned(), from, line));
                    }
                    parts.get("value").and_then(Item::as_value)
                }
            };
            let value = value.ok_or_else(|| self.wrong_kind(line, &key, wanted, item))?;
            let value = number(value, out)?;
            out.push((name.to_owned(), value));
        }
        Ok(())
    }

    /// The equations of one's own, as texts: before all tables, or among the constraints.
    fn equations(&self, root: &dyn TableLike, places: &mut Places) -> Result<(), FileError> {
        let constraints = root.get("constraints").and_then(Item::as_table_like);
        let tables = [
            ("constraints.equations", constraints),
            (EQUATIONS, Some(root)),
        ];
        for (key, table) in tables {
            let Some((line, item)) = table.and_then(|table| self.get(table, EQUATIONS)) else {
                continue;
            };
            let wanted = "a list of equations in quotes, [\"x^2 + y^2 = 2\", \"x*y = 1\"]";
            let list = item.as_array();
            let list = list.ok_or_else(|| self.wrong_kind(line, key, wanted, item))?;
            for value in list {
                let line = self.line(value.span()).or(line);
                let text = value.as_str();
                let text = text.ok_or_else(|| self.wrong_value(line, key, wanted, value))?;
                places.equations.push((key, line, text.to_owned()));
            }
        }
        Ok(())
    }

    /// A list of equations that stands in a table of something else, as everything below a table's heading does.
    pub(super) fn is_in_place(
        &self,
        line: Line,
        table: &str,
        name: &str,
        item: &Item,
    ) -> Result<(), FileError> {
        let is_list = item
            .as_array()
            .is_some_and(|list| list.iter().all(Value::is_str));
        if name != EQUATIONS || !is_list {
            return Ok(());
        }
        let wanted = "before the first [table] of the file, or under [constraints]";
        let found = format!("in [{table}], as all that follows its heading");
        Err(self.wrong(line, EQUATIONS, wanted, found))
    }

    /// Parameters that stand in equations are unknowns that are led to their values.
    fn numbers_of_parameters(
        &self,
        objects: &HashSet<String>,
        mut builder: ProblemBuilder,
        places: &mut Places,
    ) -> Result<ProblemBuilder, FileError> {
        for (name, value) in &places.parameters {
            let mut equations = places.equations.iter();
            let used = equations.find(|(_, _, text)| expression::names(text).any(|n| n == name));
            let from = places.from.iter().find(|(other, ..)| other == name);
            match (used, from) {
                (None, None) => continue,
                (None, Some((_, _, line))) => {
                    let key = format!("parameters.{name}.from");
                    let found = "one that stands in none".to_owned();
                    return Err(self.wrong(*line, &key, "of a parameter in `equations`", found));
                }
                (Some((key, line, _)), _) if objects.contains(name) => {
                    let found = format!("`{name}`, which is both");
                    let wanted = "names that mean one thing, an object or a parameter";
                    return Err(self.wrong(*line, key, wanted, found));
                }
                _ => {}
            }
            places.led.push(name.clone());
            places.objects.push(("parameters", None));
            builder = builder.unknown(name, from.map_or(value, |(_, from, _)| from).clone());
        }
        Ok(builder)
    }

    /// The values of those parameters, and the equations.
    fn own_equations(&self, mut builder: ProblemBuilder, places: &mut Places) -> ProblemBuilder {
        for name in &places.led {
            let mut parameters = places.parameters.iter();
            let found = parameters.find(|(other, _)| other == name);
            let (_, value) = found.expect("what is led is a parameter");
            places.constraints_of_kinds.push(("parameters", None));
            builder = builder.dimension("values", [name], value.clone().computed_by(name));
        }
        for (key, line, text) in &places.equations {
            places.constraints_of_kinds.push((key, *line));
            builder = builder.equation(text);
        }
        builder
    }

    /// The number that an expression says.
    fn computed(
        &self,
        line: Line,
        key: &str,
        text: &str,
        parameters: &[(String, Decimal)],
    ) -> Result<Decimal, FileError> {
        expression::evaluate(text, parameters).map_err(|why| {
            let fault = FileFault::Expression {
                key: key.to_owned(),
                why,
            };
            self.fail(line, fault)
        })
    }

    /// The number of a constraint, which may be an expression where the file has parameters.
    pub(super) fn number_of(
        &self,
        line: Line,
        key: &str,
        value: &Value,
        places: &Places,
    ) -> Result<Decimal, FileError> {
        match value.as_str() {
            Some(text) if !places.parameters.is_empty() => {
                let line = self.line(value.span()).or(line);
                self.computed(line, key, text, &places.parameters)
            }
            _ => self.number(line, key, value),
        }
    }

    fn measures(&self, root: &dyn TableLike) -> Result<Vec<(String, String)>, FileError> {
        let Some((line, item)) = self.get(root, "measures") else {
            return Ok(Vec::new());
        };
        let all = self.table(line, "measures", item)?;
        let all = all.iter().map(|(name, item)| {
            let line = self.line(item.span()).or(line);
            let key = format!("measures.{name}");
            let what = self.string(line, &key, item)?;
            if name.trim().is_empty() || name.contains(|c: char| c == '=' || c.is_control()) {
                let found = "one without a name, or with `=` in it".to_owned();
                return Err(self.wrong(line, &key, "of a measure with a name", found));
            }
            Ok((name.to_owned(), what))
        });
        all.collect()
    }

    fn tolerances(&self, root: &dyn TableLike) -> Result<Tolerances, FileError> {
        let mut out = Tolerances::default();
        let Some((line, item)) = self.get(root, "tolerances") else {
            return Ok(out);
        };
        for (name, item) in self.table(line, "tolerances", item)?.iter() {
            let key = format!("tolerances.{name}");
            let line = self.line(item.span()).or(line);
            let wanted = "a number, 0.1, or how far down and up, [-0.2, 0.1]";
            let deviation = |value: &Value| match value {
                Value::String(text) => {
                    let text = text.value().trim();
                    let number = text.strip_prefix('+').unwrap_or(text).parse();
                    number.map_err(|_| self.wrong_kind(line, &key, wanted, item))
                }
                value => self.number(line, &key, value),
            };
            let both = match item.as_value() {
                Some(Value::Array(both)) if both.len() == 2 => {
                    let numbers = both.iter().map(deviation).collect::<Result<Vec<_>, _>>()?;
                    let [a, b] = [&numbers[0], &numbers[1]];
                    match a.value() <= b.value() {
                        true => [a.clone(), b.clone()],
                        false => [b.clone(), a.clone()],
                    }
                }
                Some(value @ (Value::Integer(_) | Value::Float(_) | Value::String(_))) => {
                    let number = deviation(value)?;
                    match number.to_f64() >= 0.0 {
                        true => [number.negative(), number],
                        false => return Err(self.wrong_kind(line, &key, wanted, item)),
                    }
                }
                _ => return Err(self.wrong_kind(line, &key, wanted, item)),
            };
            match name {
                "default" => out.default = Some(both),
                name => out.named.push((name.to_owned(), both)),
            }
        }
        Ok(out)
    }

    /// The exact number that the text of `value` says.
    pub(super) fn number(
        &self,
        line: Line,
        key: &str,
        value: &Value,
    ) -> Result<Decimal, FileError> {
        let line = self.line(value.span()).or(line);
        let text = match value {
            Value::Integer(_) | Value::Float(_) => value.span().and_then(|s| self.text.get(s)),
            _ => None,
        };
        let Some(text) = text else {
            let wanted = match value.as_str() {
                Some(text) if text.parse::<Decimal>().is_ok() => "a number without quotes",
                _ => "a number",
            };
            return Err(self.wrong_value(line, key, wanted, value));
        };
        if text.starts_with("0x") || text.starts_with("0o") || text.starts_with("0b") {
            return Err(self.wrong(line, key, "a decimal number", format!("`{text}`")));
        }
        // TOML allows underscores between digits, and has checked that they are.
        text.replace('_', "").parse().map_err(|source| {
            self.fail(
                line,
                FileFault::Number {
                    key: key.to_owned(),
                    source,
                },
            )
        })
    }

    pub(super) fn point_names(
        &self,
        line: Line,
        key: &str,
        item: &Item,
    ) -> Result<Vec<String>, FileError> {
        let wanted = "names of points in brackets, each in quotes";
        let Some(array) = item.as_array() else {
            return Err(self.wrong_kind(line, key, wanted, item));
        };
        array
            .iter()
            .map(|value| match value.as_str() {
                Some(name) => Ok(name.to_owned()),
                None => Err(self.wrong_value(line, key, wanted, value)),
            })
            .collect()
    }

    pub(super) fn string(&self, line: Line, key: &str, item: &Item) -> Result<String, FileError> {
        match item.as_str() {
            Some(text) => Ok(text.to_owned()),
            None => Err(self.wrong_kind(line, key, "a text in quotes", item)),
        }
    }

    pub(super) fn table<'i>(
        &self,
        line: Line,
        key: &str,
        item: &'i Item,
    ) -> Result<&'i dyn TableLike, FileError> {
        let wrong = || self.wrong_kind(line, key, &format!("a table, [{key}]"), item);
        item.as_table_like().ok_or_else(wrong)
    }

    pub(super) fn get<'t>(&self, table: &'t dyn TableLike, name: &str) -> Option<(Line, &'t Item)> {
        let (key, item) = table.get_key_value(name)?;
        Some((self.line(key.span()), item))
    }

    pub(super) fn known_keys(
        &self,
        table: &dyn TableLike,
        prefix: &str,
        known: &[&str],
    ) -> Result<(), FileError> {
        for (name, _) in table.iter() {
            if !known.contains(&name) {
                let shown: String = name.chars().take(60).collect();
                // A constraint outside of the table where it belongs.
                let is_constraint = |key: &str| {
                    ["distances", "squared_distances"].contains(&key)
                        || KINDS.iter().any(|kind| kind.key == key)
                        || key == "orientation"
                };
                return Err(self.fail(
                    self.line(table.key(name).and_then(Key::span)),
                    FileFault::UnknownKey {
                        key: format!("{prefix}{shown}"),
                        nearest: match prefix.is_empty() && is_constraint(name) {
                            true => Some(format!("constraints.{name}")),
                            false => nearest(name, &mut known.iter().copied()),
                        },
                    },
                ));
            }
        }
        Ok(())
    }

    /// The line on which a span begins.
    pub(super) fn line(&self, span: Option<Range<usize>>) -> Line {
        let start = span?.start;
        Some(1 + self.line_ends.partition_point(|&end| end < start))
    }

    fn syntax(&self, error: &toml_edit::TomlError) -> FileError {
        let at = error
            .span()
            .and_then(|span| self.text.get(span))
            .unwrap_or("");
        let at: String = at.trim().chars().take(40).collect();
        let message = match error.message().trim() {
            "duplicate key" => format!("`{at}` is there twice: rename or remove one"),
            // Whole numbers beyond 64 bits; with a point they are read, exactly.
            "integer number overflowed" => {
                format!("`{at}` is too large without a decimal point: write {at}.0")
            }
            // Some of the parser's messages have two lines; krawl's have one.
            message if at.is_empty() => message.replace('\n', ", "),
            message => format!(
                "{} at `{}`",
                message.replace('\n', ", "),
                at.replace('\n', " ")
            ),
        };
        let fault = FileFault::Syntax(message);
        self.fail(self.line(error.span()), fault)
    }

    fn fail(&self, line: Line, fault: FileFault) -> FileError {
        FileError {
            file: self.file.to_owned(),
            line,
            fault: Box::new(fault),
        }
    }

    fn missing(&self, key: &str, example: &'static str) -> FileError {
        let fault = FileFault::MissingKey {
            key: key.to_owned(),
            example,
        };
        self.fail(None, fault)
    }

    pub(super) fn wrong_kind(
        &self,
        line: Line,
        key: &str,
        wanted: &str,
        found: &Item,
    ) -> FileError {
        match found.as_value() {
            Some(value) => self.wrong_value(line, key, wanted, value),
            None => self.wrong(line, key, wanted, format!("a {}", found.type_name())),
        }
    }

    pub(super) fn wrong_value(
        &self,
        line: Line,
        key: &str,
        wanted: &str,
        found: &Value,
    ) -> FileError {
        let text = found.span().and_then(|span| self.text.get(span));
        let text: String = text.unwrap_or("").chars().take(41).collect();
        let found = match text.as_str() {
            text if (1..=40).contains(&text.len()) && !text.contains('\n') => format!("`{text}`"),
            _ => format!("a value of type {}", found.type_name()),
        };
        self.wrong(line, key, wanted, found)
    }

    pub(super) fn wrong(&self, line: Line, key: &str, wanted: &str, found: String) -> FileError {
        self.fail(
            line,
            FileFault::WrongKind {
                key: key.to_owned(),
                wanted: wanted.to_owned(),
                found,
            },
        )
    }

    fn in_problem(&self, places: &Places, error: ProblemError) -> FileError {
        let point = |i: usize| places.points.get(i).copied().flatten();
        let named = |places: &[(&str, Line)], index: usize, within: &str| {
            let (key, line) = places.get(index).copied().unwrap_or(("constraints", None));
            (format!("{within}{key}: "), line)
        };
        let (key, line) = match error.place() {
            Place::Object(i) => {
                let (key, line) = named(&places.objects, i, "");
                return self.fail(line, FileFault::Problem { key, error });
            }
            Place::Constraint(i) => {
                let of = places.constraints_of_kinds.get(i).map_or("", |of| of.0);
                let is_whole = [EQUATIONS, "constraints.equations", "parameters"].contains(&of);
                let within = if is_whole { "" } else { "constraints." };
                let (key, line) = named(&places.constraints_of_kinds, i, within);
                return self.fail(line, FileFault::Problem { key, error });
            }
            Place::Orientation(i) => {
                let line = places.orientations.get(i).copied().flatten();
                ("constraints.orientation: ", line)
            }
            Place::Detour => ("homotopy.detour: ", places.detour),
            Place::Whole => ("", places.points_table),
            Place::Pose => {
                let line = match &error {
                    ProblemError::UnknownBody { name, .. } => places.poses.get(name).copied(),
                    _ => None,
                };
                ("", line.flatten())
            }
            Place::Name => ("name: ", places.name),
            Place::Dimension => ("dimension: ", places.dimension),
            Place::Point(i) => ("points: ", point(i)),
            Place::Distances => ("constraints: ", places.constraints),
            Place::Distance(i) => match places.distances.get(i) {
                Some(&("constraints.distances", line)) => ("constraints.distances: ", line),
                Some(&(_, line)) => ("constraints.squared_distances: ", line),
                None => ("constraints: ", places.constraints),
            },
            Place::Reference => ("homotopy.reference: ", places.reference),
            Place::Bend => ("homotopy.bend: ", places.bend),
            Place::BendCoefficient => ("homotopy.bend_coefficient: ", places.bend_coefficient),
        };
        let fault = FileFault::Problem {
            key: key.to_owned(),
            error,
        };
        self.fail(line, fault)
    }
}
