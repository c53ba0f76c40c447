//! The numbers of a document that expressions name or make: dimensions of all its sketches, cells of its spreadsheets, and variables of
//! its `VarSet` objects.

use super::formula::{Found, Part, Path, evaluate};
use super::quantity::Quantity;
use super::{constraints, degrees, is_sketch, label, listed, number, objects, property, whole};
use crate::import::drawing::decimal;
use roxmltree::{Document, Node};
use std::collections::HashMap;
use std::ops::Range;

/// So many numbers are computed from one another, each from one that is not known yet.
const MOST: usize = 50;

/// What kind of object it is, and so how expressions name its numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    /// A spreadsheet: `Spreadsheet.B1`.
    Sheet,
    /// A `VarSet`: `VarSet.width`.
    Variables,
    /// A sketch, `Sketch.Constraints.width`, or an object that has no numbers here.
    Sketch,
}

/// An object of the document.
#[derive(Debug, Clone)]
struct Object {
    name: String,
    label: String,
    kind: Kind,
    /// Its numbers, in the order of the file.
    entries: Range<usize>,
}

/// A dimension, a cell or a variable.
#[derive(Debug, Clone)]
struct Entry {
    object: usize,
    /// The name of a dimension; of a cell its alias, or its address where it has none.
    name: Option<String>,
    content: Content,
    /// Of a cell and a variable: its text, and where that is in the file.
    cell: (String, Range<usize>),
    /// Whether it has another text than in the file.
    is_set: bool,
    /// Whether it can be a whole number only.
    is_whole: bool,
}

#[derive(Debug, Clone)]
enum Content {
    Given(Quantity),
    /// By an expression; of a dimension with the number that the file has.
    Computed(String, Option<Quantity>),
    /// What it is in place of a number.
    Other(&'static str),
}

/// All numbers of a document.
#[derive(Debug, Clone, Default)]
pub struct Numbers {
    objects: Vec<Object>,
    entries: Vec<Entry>,
    /// The entries of each object by their names, the first of each.
    named: HashMap<(usize, String), usize>,
    /// Why each has no number in the file that can be used, if that is so; empty until that is found.
    faults: Vec<Option<String>>,
    /// The sketch that was read.
    own: usize,
}

/// What a cell's text says, and the unit behind its number.
fn cell(text: &str) -> (Content, &str) {
    let formula = text.strip_prefix('=');
    let plain = formula.unwrap_or(text).trim();
    let digits = plain.trim_end_matches(|c: char| !c.is_ascii_digit());
    let number = digits.parse().ok().filter(|x: &f64| x.is_finite());
    let name = plain[digits.len()..].trim();
    let unit = match name {
        "" => Some(Quantity::plain(1.0)),
        name => Quantity::unit(name),
    };
    let content = match (number, unit, formula) {
        (Some(number), Some(unit), _) => Content::Given(unit.with(number * unit.value)),
        (_, _, Some(formula)) => Content::Computed(formula.to_owned(), None),
        _ => Content::Other("is no number"),
    };
    (content, name)
}

/// The unit of a variable of this type, if it is one that is read.
fn unit_of(kind: &str) -> Option<Quantity> {
    match kind.strip_prefix("App::Property")? {
        "Length" | "Distance" => Some(Quantity::length(1.0)),
        "Angle" => Some(Quantity::angle(1.0)),
        "Float" | "Integer" => Some(Quantity::plain(1.0)),
        _ => None,
    }
}

/// The number of a constraint.
fn dimension(node: Node) -> Content {
    let value = number(node, "Value");
    match whole(node, "Type") {
        _ if node.attribute("IsDriving") == Some("0") => {
            Content::Other("is measured there, and not given")
        }
        6 | 7 | 8 | 11 | 18 => Content::Given(Quantity::length(value)),
        9 => Content::Given(Quantity::angle(degrees(value))),
        _ => Content::Other("is neither a length nor an angle"),
    }
}

impl Entry {
    /// A variable's new number as the file has it.
    fn written(&self, number: f64) -> String {
        match self.is_whole {
            true => format!("{number:.0}"),
            false => format!("{number:.16}"),
        }
    }

    /// Why a number cannot be its.
    fn refuses(&self, number: f64) -> Option<&'static str> {
        // FreeCAD has 64 bits for them.
        let is_whole = number.fract() == 0.0 && number.abs() < 9e18;
        (self.is_whole && !is_whole).then_some("is a whole number in the file")
    }
}

impl Numbers {
    /// Those of a document of which the sketch `own` is read.
    pub fn read(document: &Document, own: &str) -> Self {
        let mut numbers = Numbers::default();
        let all = objects(document);
        for &(node, name, kind) in &all {
            let begin = numbers.entries.len();
            let dimensions = constraints(node).into_iter().filter(|_| is_sketch(kind));
            for node in dimensions {
                numbers.add(node, &["Name"], dimension(node), Default::default());
            }
            for node in listed(node, "cells", "Cell") {
                let text = node.attribute_node("content");
                let text = text.map(|text| (text.value().to_owned(), text.range_value()));
                let text = text.unwrap_or_default();
                numbers.add(node, &["alias", "address"], cell(&text.0).0, text);
            }
            let kind_of = match kind {
                Some("App::VarSet") => Kind::Variables,
                _ if property(node, "cells").is_some() => Kind::Sheet,
                _ => Kind::Sketch,
            };
            let properties = node.descendants().filter(|n| n.has_tag_name("Property"));
            for node in properties.filter(|_| kind_of == Kind::Variables) {
                let number = node.children().find_map(|n| n.attribute_node("value"));
                let unit = node.attribute("type").and_then(unit_of);
                if let (Some(number), Some(unit)) = (number, unit) {
                    let content = match number.value().parse().ok() {
                        Some(value) => Content::Given(unit.with(value)),
                        None => Content::Other("is no number"),
                    };
                    let text = (number.value().to_owned(), number.range_value());
                    numbers.add(node, &["name"], content, text);
                }
            }
            if name == own {
                numbers.own = numbers.objects.len();
            }
            numbers.objects.push(Object {
                name: name.to_owned(),
                label: label(node).unwrap_or("").to_owned(),
                kind: kind_of,
                entries: begin..numbers.entries.len(),
            });
        }
        for (object, (node, ..)) in all.iter().enumerate() {
            for node in listed(*node, "ExpressionEngine", "Expression") {
                let [path, text] =
                    ["path", "expression"].map(|key| node.attribute(key).unwrap_or(""));
                let path = Path::read(path).ok();
                if let Some((entry, _)) = path.and_then(|path| numbers.find(object, &path))
                    && let Content::Given(said) = numbers.entries[entry].content
                {
                    numbers.entries[entry].content = Content::Computed(text.to_owned(), Some(said));
                }
            }
        }
        let mut in_file = Evaluation::new(&numbers, []);
        let all = 0..numbers.entries.len();
        numbers.faults = all.map(|entry| in_file.value(entry).0.err()).collect();
        numbers
    }

    /// Adds an element of the next object, which is called what stands under these keys.
    fn add(&mut self, node: Node, keys: &[&str], content: Content, cell: (String, Range<usize>)) {
        let object = self.objects.len();
        let names = keys.iter().filter_map(|key| node.attribute(*key));
        let names = names.filter(|name| !name.is_empty());
        for name in names.clone() {
            let named = self.named.entry((object, name.to_owned()));
            named.or_insert(self.entries.len());
        }
        self.entries.push(Entry {
            object,
            name: names.map(str::to_owned).next(),
            content,
            cell,
            is_set: false,
            is_whole: node.attribute("type") == Some("App::PropertyInteger"),
        });
    }

    /// The entry that a name means in an expression of an object, and whether its number is meant without the unit.
    fn find(&self, of: usize, path: &Path) -> Option<(usize, bool)> {
        let named = |name: &str| self.objects.iter().position(|o| o.name == name);
        let labelled = |label: &str| {
            let mut all = (0..self.objects.len()).filter(|&o| self.objects[o].label == label);
            all.next().filter(|_| all.next().is_none())
        };
        let (object, parts) = match &path.parts[..] {
            [Part::Label(label), rest @ ..] if !path.is_own => (labelled(label)?, rest),
            [Part::Name(name), rest @ ..] if !path.is_own && !rest.is_empty() => {
                match named(name).or_else(|| labelled(name)) {
                    Some(other) => (other, rest),
                    None => (of, &path.parts[..]),
                }
            }
            all => (of, all),
        };
        let own = &self.objects[object];
        let (name, rest) = match parts {
            [Part::Name("Constraints"), name, rest @ ..] if own.kind == Kind::Sketch => {
                (name, rest)
            }
            [name, rest @ ..] if own.kind != Kind::Sketch => (name, rest),
            _ => return None,
        };
        let entry = match name {
            Part::Index(index) => own.entries.clone().nth(*index)?,
            Part::Name(name) | Part::Label(name) => {
                *self.named.get(&(object, name.replace('$', "")))?
            }
        };
        match rest {
            [] => Some((entry, false)),
            [Part::Name("Value")] => Some((entry, true)),
            _ => None,
        }
    }

    /// What people call an entry.
    pub fn shown(&self, entry: usize) -> String {
        let object = self.entries[entry].object;
        let Object { name, entries, .. } = &self.objects[object];
        let own = self.entries[entry].name.clone();
        let own = own.unwrap_or_else(|| format!("Constraint{}", entry - entries.start + 1));
        match object == self.own {
            true => own,
            false => format!("{name}.{own}"),
        }
    }

    /// The entry of a constraint of the sketch, by its place in the file.
    pub fn entry(&self, source: usize) -> usize {
        self.objects[self.own].entries.start + source
    }

    /// The number of a constraint of the sketch as it is in the file.
    pub fn said(&self, source: usize) -> Option<Quantity> {
        match self.entries.get(self.entry(source))?.content {
            Content::Given(said) | Content::Computed(_, Some(said)) => Some(said),
            _ => None,
        }
    }

    /// The constraints of the sketch that have expressions, with these.
    pub fn tied(&self) -> impl Iterator<Item = (usize, &str)> {
        let own = self.objects[self.own].entries.clone();
        let all = self.entries[own].iter().enumerate();
        all.filter_map(|(source, entry)| match &entry.content {
            Content::Computed(text, _) => Some((source, &text[..])),
            _ => None,
        })
    }

    /// Why the expression of a constraint of the sketch is not used, if that is so.
    pub fn fault(&self, source: usize) -> Option<&String> {
        self.faults[self.entry(source)].as_ref()
    }

    /// Gives a cell or a variable another number, in the unit that it has. `None`: that is the name of neither.
    pub fn set_cell(&mut self, name: &str, value: &str) -> Option<Result<(), String>> {
        let (entry, _) = self.find(self.own, &Path::read(name).ok()?)?;
        let entry = &mut self.entries[entry];
        let kind = self.objects[entry.object].kind;
        let text = match (&entry.content, value.trim().parse().ok().and_then(decimal)) {
            _ if kind == Kind::Sketch => return None,
            (Content::Computed(text, _), _) => Err(format!(
                "{name} is computed, by `{text}`: set what is in it"
            )),
            (_, None) => Err(format!("{name}: `{value}` is no number")),
            (Content::Other(_), _) => Err(format!("{name} is no number in the file")),
            (Content::Given(_), _) if entry.is_set => Err(format!("{name} is set twice")),
            (Content::Given(unit), Some(number)) if kind == Kind::Variables => {
                let number = number.to_f64();
                match entry.refuses(number) {
                    Some(why) => Err(format!("{name} {why}")),
                    None => Ok((Content::Given(unit.with(number)), entry.written(number))),
                }
            }
            (_, Some(number)) => {
                let text = format!("={number} {}", cell(&entry.cell.0).1);
                Ok((cell(&text).0, text.trim_end().to_owned()))
            }
        };
        Some(text.map(|(content, text)| {
            (entry.content, entry.cell.0) = (content, text);
            entry.is_set = true;
        }))
    }

    /// The cells that were set: their text, and where it is in the file.
    pub fn set_cells(&self) -> impl Iterator<Item = &(String, Range<usize>)> {
        let set = self.entries.iter().filter(|entry| entry.is_set);
        set.map(|entry| &entry.cell)
    }
}

/// Whether what an expression gives is what the file, or the figure, has: they differ by no more than roundings do.
pub fn is_same(by_it: f64, has: f64) -> bool {
    (by_it - has).abs() <= 1e-9 * by_it.abs().max(has.abs()) + 1e-12
}

/// What numbers come to where some are set.
pub struct Evaluation<'a> {
    numbers: &'a Numbers,
    /// What each entry comes to, once that is known, and whether something new is in it.
    known: Vec<Option<(Found, bool)>>,
    /// What is being computed, each from the next one.
    way: Vec<usize>,
}

impl<'a> Evaluation<'a> {
    /// Where constraints of the sketch have these numbers, in the sense and the units of the file, some of them new.
    pub fn new(
        numbers: &'a Numbers,
        set: impl IntoIterator<Item = (usize, Quantity, bool)>,
    ) -> Self {
        let mut evaluation = Evaluation {
            numbers,
            known: vec![None; numbers.entries.len()],
            way: Vec::new(),
        };
        for (source, number, is_new) in set {
            evaluation.known[numbers.entry(source)] = Some((Ok(number), is_new));
        }
        // Cells in the order of the file, in which columns go down as a rule: most of what each names is known then.
        let tables = numbers.objects.iter().filter(|o| o.kind != Kind::Sketch);
        for entry in tables.flat_map(|table| table.entries.clone()) {
            let _ = evaluation.value(entry);
        }
        evaluation
    }

    /// The dimensions of other sketches that follow from what is new, by name.
    pub fn elsewhere(&mut self) -> Vec<String> {
        let numbers = self.numbers;
        let all = numbers.entries.iter().enumerate();
        let computed = all.filter(|(_, entry)| {
            let kind = numbers.objects[entry.object].kind;
            entry.object != numbers.own
                && kind == Kind::Sketch
                && matches!(entry.content, Content::Computed(..))
        });
        let follow = computed.filter(|(entry, _)| self.value(*entry).1);
        follow.map(|(entry, _)| numbers.shown(entry)).collect()
    }

    /// The variables that are computed to another number than the file has: that as text, and where it is in the file.
    pub fn variables(&mut self) -> Vec<(String, Range<usize>)> {
        let numbers = self.numbers;
        let all = numbers.entries.iter().enumerate();
        let variables =
            all.filter(|(_, entry)| numbers.objects[entry.object].kind == Kind::Variables);
        let changed = variables.filter_map(|(index, entry)| {
            let Content::Computed(_, Some(said)) = entry.content else {
                return None;
            };
            let value = self.value(index).0.ok()?.value;
            let text = || (entry.written(value), entry.cell.1.clone());
            (!is_same(value, said.value)).then(text)
        });
        changed.collect()
    }

    /// The number of a constraint of the sketch, and whether it follows from what is new.
    pub fn number(&mut self, source: usize) -> (Found, bool) {
        self.value(self.numbers.entry(source))
    }

    fn value(&mut self, entry: usize) -> (Found, bool) {
        if let Some(known) = &self.known[entry] {
            return known.clone();
        }
        if let Some(at) = self.way.iter().position(|&other| other == entry) {
            let round = self.way[at..].iter().chain([&entry]);
            let names: Vec<String> = round.map(|&entry| self.numbers.shown(entry)).collect();
            let names = names.join(" from ");
            return (Err(format!("it goes round in a circle, {names}")), false);
        }
        if self.way.len() > MOST {
            let why = format!("more than {MOST} numbers are computed from one another");
            return (Err(why), false);
        }
        self.way.push(entry);
        let mut is_new = self.numbers.entries[entry].is_set;
        let found = self.compute(entry, &mut is_new);
        self.way.pop();
        self.known[entry].insert((found, is_new)).clone()
    }

    fn compute(&mut self, entry: usize, is_new: &mut bool) -> Found {
        let numbers = self.numbers;
        let shown = || numbers.shown(entry);
        let of = &numbers.entries[entry];
        let (text, said) = match &of.content {
            Content::Given(number) => return Ok(*number),
            Content::Other(what) => return Err(format!("{} {what}", shown())),
            Content::Computed(text, said) => (text, said),
        };
        let value = evaluate(text, &mut |path| {
            let found = numbers.find(of.object, path).ok_or_else(|| {
                let name = path.text;
                format!("`{name}` is neither a dimension of a sketch nor a cell of a spreadsheet nor a variable of a VarSet")
            });
            let (other, is_bare) = found?;
            let (value, is_other_new) = self.value(other);
            *is_new |= is_other_new;
            match is_bare {
                true => value.map(|value| Quantity::plain(value.value)),
                false => value,
            }
        });
        let fault = numbers.faults.get(entry);
        if let Some(Some(why)) = fault {
            return Err(why.clone());
        }
        let Some(said) = *said else {
            return value;
        };
        let value = value?.like(said)?;
        if let Some(why) = of.refuses(value.value) {
            return Err(format!("{} {why}, and {value} by it", shown()));
        }
        match fault.is_some() || is_same(value.value, said.value) {
            true => Ok(value),
            false => Err(format!(
                "by it {} is {value}, and the file has {said}",
                shown()
            )),
        }
    }
}
