//! The numbers of a document that expressions name or make: dimensions of all its sketches, and cells of its spreadsheets.

use super::formula::{Found, Path, evaluate};
use super::quantity::Quantity;
use super::{constraints, degrees, is_sketch, listed, number, objects, property, whole};
use crate::import::drawing::decimal;
use roxmltree::{Document, Node};
use std::collections::HashMap;
use std::ops::Range;

/// So many numbers are computed from one another, each from one that is not known yet.
const MOST: usize = 50;

/// An object of the document.
#[derive(Debug, Clone)]
struct Object {
    name: String,
    label: String,
    is_sheet: bool,
    /// Its numbers, in the order of the file.
    entries: Range<usize>,
}

/// A dimension, by its name, or a cell, by its alias and its address.
#[derive(Debug, Clone)]
struct Entry {
    object: usize,
    names: [String; 2],
    content: Content,
    /// Of a cell: its text, and where that is in the file.
    cell: (String, Range<usize>),
    /// Whether the cell has another text than in the file.
    is_set: bool,
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
    /// Why each has no number in the file that can be used, if that is so.
    faults: Vec<Option<String>>,
    /// The sketch that was read.
    own: usize,
}

/// The number and the unit that a cell's text is, if it is no more than these.
fn plain(text: &str) -> Option<(f64, &str)> {
    let text = text.strip_prefix('=').unwrap_or(text).trim();
    let digits = text.trim_end_matches(|c: char| !c.is_ascii_digit());
    let number = digits.parse().ok().filter(|x: &f64| x.is_finite())?;
    Some((number, text[digits.len()..].trim()))
}

/// What a cell's text says.
fn cell(text: &str) -> Content {
    let with_unit = |(number, unit): (f64, &str)| match unit {
        "" => Some(Quantity::plain(number)),
        unit => Quantity::unit(unit).map(|unit| unit.with(number * unit.value)),
    };
    match (plain(text).and_then(with_unit), text.strip_prefix('=')) {
        (Some(number), _) => Content::Given(number),
        (None, Some(text)) => Content::Computed(text.to_owned(), None),
        (None, None) => Content::Other("is no number"),
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

impl Numbers {
    /// Those of a document of which the sketch `own` is read.
    pub fn read(document: &Document, own: &str) -> Self {
        let mut numbers = Numbers::default();
        let all = objects(document);
        for (object, &(node, name, kind)) in all.iter().enumerate() {
            let begin = numbers.entries.len();
            let of_sketch = constraints(node).into_iter().filter(|_| is_sketch(kind));
            let of_sketch = of_sketch.map(|node| {
                let names = [node.attribute("Name").unwrap_or(""), ""];
                (names, dimension(node), (String::new(), 0..0))
            });
            let of_sheet = listed(node, "cells", "Cell").into_iter().map(|node| {
                let names = ["alias", "address"].map(|key| node.attribute(key).unwrap_or(""));
                let content = node.attribute_node("content");
                let content = content.map_or((String::new(), 0..0), |content| {
                    (content.value().to_owned(), content.range_value())
                });
                (names, cell(&content.0), content)
            });
            let entries = of_sketch
                .chain(of_sheet)
                .map(|(names, content, cell)| Entry {
                    object,
                    names: names.map(str::to_owned),
                    content,
                    cell,
                    is_set: false,
                });
            numbers.entries.extend(entries);
            if name == own {
                numbers.own = object;
            }
            let label = listed(node, "Label", "String").into_iter().next();
            let label = label.and_then(|label| label.attribute("value"));
            numbers.objects.push(Object {
                name: name.to_owned(),
                label: label.unwrap_or("").to_owned(),
                is_sheet: property(node, "cells").is_some(),
                entries: begin..numbers.entries.len(),
            });
        }
        for (entry, Entry { object, names, .. }) in numbers.entries.iter().enumerate() {
            for name in names.iter().filter(|name| !name.is_empty()) {
                let named = numbers.named.entry((*object, name.clone()));
                named.or_insert(entry);
            }
        }
        for (object, (node, ..)) in all.iter().enumerate() {
            for node in listed(*node, "ExpressionEngine", "Expression") {
                let [path, text] =
                    ["path", "expression"].map(|key| node.attribute(key).unwrap_or(""));
                let found = Path::read(path).and_then(|path| numbers.find(object, &path));
                if let Ok((entry, _)) = found
                    && let Content::Given(said) = numbers.entries[entry].content
                {
                    numbers.entries[entry].content = Content::Computed(text.to_owned(), Some(said));
                }
            }
        }
        let mut in_file = Evaluation::new(&numbers, []);
        in_file.cells();
        let all = 0..numbers.entries.len();
        numbers.faults = all.map(|entry| in_file.value(entry).err()).collect();
        numbers
    }

    /// The entry that a name means in an expression of an object, and whether its number is meant without the unit.
    fn find(&self, of: usize, path: &Path) -> Result<(usize, bool), String> {
        let named = |name: &str| self.objects.iter().position(|o| o.name == name);
        let labelled = |label: &str| {
            let mut all = (0..self.objects.len()).filter(|&o| self.objects[o].label == label);
            all.next().filter(|_| all.next().is_none())
        };
        let parts = &path.parts[..];
        let (object, parts) = match *parts {
            [label, ref rest @ ..] if path.is_label && !path.is_own => (labelled(label), rest),
            [name, ref rest @ ..] if !path.is_own && !rest.is_empty() => {
                match named(name).or_else(|| labelled(name)) {
                    Some(other) => (Some(other), rest),
                    None => (Some(of), parts),
                }
            }
            _ => (Some(of), parts),
        };
        let is_sheet = object.is_some_and(|object| self.objects[object].is_sheet);
        let parts = match (is_sheet, parts) {
            (false, ["Constraints", rest @ ..]) => rest,
            (true, all) => all,
            _ => &[],
        };
        let found = object.and_then(|object| {
            let name = parts.first()?.replace('$', "");
            let entry = match Path::index(&name) {
                Some(index) => self.objects[object].entries.clone().nth(index),
                None => self.named.get(&(object, name)).copied(),
            }?;
            matches!(parts, [_] | [_, "Value"]).then(|| (entry, parts.len() > 1))
        });
        found.ok_or_else(|| {
            let name = path.text;
            format!("`{name}` is neither a dimension of a sketch nor a cell of a spreadsheet")
        })
    }

    /// What people call an entry.
    pub fn shown(&self, entry: usize) -> String {
        let Entry { object, names, .. } = &self.entries[entry];
        let Object { name, entries, .. } = &self.objects[*object];
        let own = names.iter().find(|name| !name.is_empty()).cloned();
        let own = own.unwrap_or_else(|| format!("Constraint{}", entry - entries.start + 1));
        match *object == self.own {
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
    pub fn fault(&self, source: usize) -> Option<String> {
        self.faults[self.entry(source)].clone()
    }

    /// The constraints of the sketch that an expression of it names.
    pub fn named_in(&self, expression: &str) -> Vec<usize> {
        let own = self.objects[self.own].entries.clone();
        let mut named = Vec::new();
        let _ = evaluate(expression, &mut |path| {
            let (entry, _) = self.find(self.own, path)?;
            named.extend(own.clone().position(|other| other == entry));
            Err(String::new())
        });
        named
    }

    /// Gives a cell another number, in the unit that it has. `None`: that is no name of a cell.
    pub fn set_cell(&mut self, name: &str, value: &str) -> Option<Result<(), String>> {
        let path = Path::read(name).ok()?;
        let (entry, _) = self.find(self.own, &path).ok()?;
        let entry = &mut self.entries[entry];
        if !self.objects[entry.object].is_sheet {
            return None;
        }
        let number = value.trim().parse().ok().filter(|x: &f64| x.is_finite());
        let text = match (
            number.and_then(decimal),
            plain(&entry.cell.0),
            &entry.content,
        ) {
            (_, _, Content::Computed(text, _)) => {
                return Some(Err(format!(
                    "{name} is computed, by `{text}`: set the cells in it"
                )));
            }
            (Some(number), Some((_, unit)), _) => format!("={number} {unit}"),
            (None, ..) => return Some(Err(format!("{name}: `{value}` is no number"))),
            (_, None, _) => return Some(Err(format!("{name} is no number in the file"))),
        };
        entry.content = cell(&text);
        entry.cell.0 = text.trim_end().to_owned();
        entry.is_set = true;
        Some(Ok(()))
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
    /// What is known, by entry, and whether something new is in it.
    known: HashMap<usize, (Found, bool)>,
    /// What is being computed, each from the next one.
    way: Vec<usize>,
    /// Whether something new was used.
    is_new: bool,
}

impl<'a> Evaluation<'a> {
    /// Where constraints of the sketch have these numbers, in the sense and the units of the file, some of them new.
    pub fn new(
        numbers: &'a Numbers,
        set: impl IntoIterator<Item = (usize, Quantity, bool)>,
    ) -> Self {
        let known = set.into_iter();
        let known =
            known.map(|(source, number, is_new)| (numbers.entry(source), (Ok(number), is_new)));
        Evaluation {
            numbers,
            known: known.collect(),
            way: Vec::new(),
            is_new: false,
        }
    }

    /// The dimensions of other sketches that follow from what is new, by name.
    pub fn elsewhere(&mut self) -> Vec<String> {
        let numbers = self.numbers;
        let mut names = Vec::new();
        for (
            entry,
            Entry {
                object, content, ..
            },
        ) in numbers.entries.iter().enumerate()
        {
            let is_elsewhere = *object != numbers.own && !numbers.objects[*object].is_sheet;
            if is_elsewhere && matches!(content, Content::Computed(..)) {
                self.is_new = false;
                let _ = self.value(entry);
                names.extend(self.is_new.then(|| numbers.shown(entry)));
            }
        }
        names
    }

    /// The number of a constraint of the sketch.
    pub fn number(&mut self, source: usize) -> Found {
        self.value(self.numbers.entry(source))
    }

    /// The number of a constraint of the sketch that follows from what is new; `None`: nothing of that is in it.
    pub fn follows(&mut self, source: usize) -> Option<Found> {
        self.cells();
        self.is_new = false;
        let value = self.value(self.numbers.entry(source));
        self.is_new.then_some(value)
    }

    /// Computes all cells in the order of the file, in which columns go down as a rule: most of what each names is known then.
    fn cells(&mut self) {
        let sheets = self.numbers.objects.iter().filter(|o| o.is_sheet);
        for entry in sheets.flat_map(|sheet| sheet.entries.clone()) {
            let _ = self.value(entry);
        }
    }

    fn value(&mut self, entry: usize) -> Found {
        if let Some((found, is_new)) = self.known.get(&entry) {
            self.is_new |= is_new;
            return found.clone();
        }
        if let Some(at) = self.way.iter().position(|&other| other == entry) {
            let round = self.way[at..].iter().chain([&entry]);
            let names: Vec<String> = round.map(|&entry| self.numbers.shown(entry)).collect();
            return Err(format!(
                "it goes round in a circle, {}",
                names.join(" from ")
            ));
        }
        if self.way.len() > MOST {
            return Err(format!(
                "more than {MOST} numbers are computed from one another"
            ));
        }
        let before = std::mem::replace(&mut self.is_new, self.numbers.entries[entry].is_set);
        self.way.push(entry);
        let value = self.compute(entry);
        self.way.pop();
        self.known.insert(entry, (value.clone(), self.is_new));
        self.is_new |= before;
        value
    }

    fn compute(&mut self, entry: usize) -> Found {
        let numbers = self.numbers;
        let fault = numbers.faults.get(entry).cloned().flatten();
        let Entry {
            object, content, ..
        } = &numbers.entries[entry];
        let (text, said) = match content {
            Content::Given(number) => return Ok(*number),
            Content::Other(what) => return Err(format!("{} {what}", numbers.shown(entry))),
            Content::Computed(text, said) => (text, said),
        };
        let value = evaluate(text, &mut |path| {
            let (other, is_bare) = numbers.find(*object, path)?;
            let value = self.value(other)?;
            Ok(if is_bare {
                Quantity::plain(value.value)
            } else {
                value
            })
        });
        let value = fault.map_or(value, Err)?;
        let Some(said) = *said else {
            return Ok(value);
        };
        let value = value.like(said)?;
        match is_same(value.value, said.value) || !numbers.faults.is_empty() {
            true => Ok(value),
            false => Err(format!(
                "by it {} is {value}, and the file has {said}",
                numbers.shown(entry)
            )),
        }
    }
}
