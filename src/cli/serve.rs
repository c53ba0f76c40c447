//! `krawl edit --serve`: edits as lines of JSON, one answer for each.

use super::input::Loaded;
use krawl::edit::{Drag, Ending, Session, Setting};
use krawl::import::Followed;
use krawl::report::document::{Answer, Standing};
use krawl::track::Control;
use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use std::collections::{BTreeMap, VecDeque};
use std::io::{self, BufRead, Write};

/// Longest line that is read.
const LONGEST: u64 = 1 << 20;

/// A line.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request<'a> {
    /// New values by name: numbers, or texts with numbers in them.
    #[serde(borrow, default)]
    set: BTreeMap<String, &'a RawValue>,
    /// Places for points by name, lists of numbers: they are dragged there.
    #[serde(borrow, default)]
    drag: BTreeMap<String, Vec<&'a RawValue>>,
    /// Whether the figure stays what it is.
    #[serde(default)]
    probe: bool,
    /// From here on each figure is remembered, for `undo`.
    #[serde(default)]
    remember: bool,
    /// Goes back to the figure before the last one that was taken.
    #[serde(default)]
    undo: bool,
    /// Keeps the figure under this name.
    #[serde(default)]
    keep: Option<String>,
    /// Goes back to the figure that was kept under this name.
    #[serde(default)]
    back: Option<String>,
    /// Whatever it is, it comes back with the answer.
    #[serde(default)]
    id: Option<Value>,
}

/// So many figures can be gone back to by `undo`, and so many are kept by name.
const MOST_KEPT: usize = 100;

/// A session, and figures that can be gone back to.
struct Figures<'a> {
    session: &'a mut Session,
    /// Whether figures are remembered, which takes about as long as an edit.
    remembers: bool,
    before: VecDeque<Session>,
    kept: BTreeMap<String, Session>,
}

impl Figures<'_> {
    /// Does something that may give the session another figure: whether it has.
    fn changed<T>(&mut self, does: impl FnOnce(&mut Session) -> (T, bool)) -> (T, bool) {
        let before = self.remembers.then(|| self.session.clone());
        let (result, is_changed) = does(self.session);
        if let Some(before) = before.filter(|_| is_changed) {
            self.remember(before);
        }
        (result, is_changed)
    }

    fn remember(&mut self, before: Session) {
        if self.before.len() == MOST_KEPT {
            self.before.pop_front();
        }
        self.before.push_back(before);
    }

    /// Goes back, or keeps a figure, if that is asked for: the figure as it then is. `None`: neither is.
    fn recall(&mut self, request: &Request) -> Option<Result<Value, String>> {
        let asked = [
            request.remember,
            request.undo,
            request.keep.is_some(),
            request.back.is_some(),
        ];
        let count = asked.iter().filter(|asked| **asked).count();
        let is_alone = request.set.is_empty() && request.drag.is_empty() && !request.probe;
        match count {
            0 => return None,
            1 if is_alone => {}
            _ => {
                let why = "`remember`, `undo`, `keep` and `back` each stand in a line of their own";
                return Some(Err(why.to_owned()));
            }
        }
        if request.remember {
            self.remembers = true;
        } else if let Some(name) = &request.keep {
            if self.kept.len() == MOST_KEPT && !self.kept.contains_key(name) {
                return Some(Err(format!("{MOST_KEPT} figures are kept at most")));
            }
            self.kept.insert(name.clone(), self.session.clone());
        } else if let Some(name) = &request.back {
            let Some(kept) = self.kept.get(name) else {
                let names: Vec<&str> = self.kept.keys().map(String::as_str).collect();
                let names = match names.is_empty() {
                    true => "none are".to_owned(),
                    false => names.join(", "),
                };
                return Some(Err(format!("no figure is kept as `{name}`; kept: {names}")));
            };
            let now = std::mem::replace(self.session, kept.clone());
            if self.remembers {
                self.remember(now);
            }
        } else {
            let Some(before) = self.before.pop_back() else {
                let why = match self.remembers {
                    true => "there is nothing to undo",
                    false => {
                        "there is nothing to undo: figures are remembered from a line {\"remember\": true} on"
                    }
                };
                return Some(Err(why.to_owned()));
            };
            *self.session = before;
        }
        Some(Ok(self.standing()))
    }

    /// The figure as it is, and what can be gone back to.
    fn standing(&self) -> Value {
        let mut standing = json!(Standing::new(self.session));
        standing["undo"] = json!(self.before.len());
        standing["kept"] = json!(self.kept.keys().collect::<Vec<_>>());
        standing
    }
}

/// Answers lines until there are no more, or nobody reads the answers. The result: whether all is well.
pub fn serve(session: &mut Session, loaded: &Loaded) -> bool {
    let mut figures = Figures {
        session,
        remembers: false,
        before: VecDeque::new(),
        kept: BTreeMap::new(),
    };
    let mut input = io::stdin().lock();
    let mut output = io::stdout().lock();
    let mut line = Vec::new();
    loop {
        line.clear();
        let read = io::Read::take(&mut input, LONGEST).read_until(b'\n', &mut line);
        match read {
            Err(error) => {
                super::output::complain(&format!("standard input cannot be read: {error}"));
                return false;
            }
            Ok(0) => return true,
            Ok(_) => {}
        }
        if line.len() as u64 == LONGEST && line.last() != Some(&b'\n') {
            super::output::complain("a line is longer than 1 MiB: this is no list of edits");
            return false;
        }
        if line.iter().all(u8::is_ascii_whitespace) {
            continue;
        }
        let answer = answer(&mut figures, loaded, &line);
        if writeln!(output, "{answer}")
            .and_then(|()| output.flush())
            .is_err()
        {
            return true;
        }
    }
}

fn answer(figures: &mut Figures, loaded: &Loaded, line: &[u8]) -> Value {
    // A list would be taken for the values of an object.
    let is_object = line.trim_ascii_start().starts_with(b"{");
    let request: Request = match serde_json::from_slice(line) {
        Ok(request) if is_object => request,
        Ok(_) => {
            return json!({"status": "error", "reason": "a line is a JSON object, as `{}`, not a list"});
        }
        Err(error) => {
            let example = r#"write a line such as {"set": {"a-b": 5.2}}"#;
            return json!({"status": "error", "reason": format!("{error}; {example}")});
        }
    };
    let mut answer = match answered(figures, loaded, &request) {
        Ok(answer) => answer,
        Err(reason) => json!({"status": "error", "reason": reason}),
    };
    if let Some(id) = request.id {
        answer["id"] = id;
    }
    answer
}

fn answered(figures: &mut Figures, loaded: &Loaded, request: &Request) -> Result<Value, String> {
    if let Some(recalled) = figures.recall(request) {
        return recalled;
    }
    let mut control = Control::default();
    if !request.drag.is_empty() {
        let drags = drags(figures.session, request)?;
        let (mut edited, is_moved) = figures.changed(|session| {
            let edited = session.drag(&drags, &mut control);
            let is_moved = edited
                .dragged
                .as_ref()
                .is_some_and(|dragged| dragged.legs > 0);
            (edited, is_moved)
        });
        loaded.add_left_out(&mut edited.account, Some(&edited.points));
        let mut answer = Answer::of(figures.session, &edited);
        answer.edit.committed = Some(is_moved);
        return Ok(json!(answer));
    }
    let (settings, mut followed) = settings(figures.session, loaded, request)?;
    if settings.is_empty() {
        return Ok(figures.standing());
    }
    let (mut edited, is_committed) = match request.probe {
        true => (figures.session.probe(&settings, &mut control), false),
        false => figures.changed(|session| {
            let edited = session.edit_with(&settings, &mut control);
            let is_reached = edited.ending == Ending::Reached;
            (edited, is_reached)
        }),
    };
    loaded.add_left_out(&mut edited.account, Some(&edited.points));
    if edited.ending != Ending::Reached {
        followed.note_way();
    }
    let mut answer = Answer::of(figures.session, &edited);
    answer.edit.follow(figures.session.problem(), &followed);
    answer.edit.committed = Some(is_committed);
    Ok(json!(answer))
}

/// The text of a number, never a float: 5.2 is 52/10.
fn number(value: &RawValue) -> String {
    let text = value.get();
    serde_json::from_str::<String>(text).unwrap_or_else(|_| text.to_owned())
}

/// Where points are to be dragged.
fn drags(session: &Session, request: &Request) -> Result<Vec<Drag>, String> {
    if !request.set.is_empty() || request.probe {
        return Err(
            "points are dragged in a line of its own, without `set` and `probe`".to_owned(),
        );
    }
    if !session.can_drag() {
        return Err(
            "the sketch has no place of its own, so that no point is at one either: fix a point of it, as `fixed = [\"A\"]` does"
                .to_owned(),
        );
    }
    let all = request.drag.iter().map(|(name, to)| {
        let to: Vec<String> = to.iter().map(|x| number(x)).collect();
        let to: Vec<&str> = to.iter().map(String::as_str).collect();
        Drag::new(session.problem(), name, &to)
    });
    let all = all.collect::<Result<Vec<_>, _>>()?;
    Drag::check(session.problem(), &all).map(|()| all)
}

/// What is to be set, with what follows from it in the file.
fn settings(
    session: &Session,
    loaded: &Loaded,
    request: &Request,
) -> Result<(Vec<Setting>, Followed), String> {
    let problem = session.problem();
    let settings = request.set.iter().map(|(name, value)| {
        Setting::named(problem, name, &number(value)).map_err(|error| error.to_string())
    });
    let mut settings = settings.collect::<Result<Vec<_>, _>>()?;
    if settings.is_empty() {
        return Ok((settings, Followed::default()));
    }
    let followed = loaded.followed(problem, &settings);
    for (index, value) in followed.numbers() {
        let setting = Setting::new(problem, index, value);
        settings.push(setting.map_err(|error| followed.in_error(&error))?);
    }
    Setting::check(problem, &settings).map_err(|error| error.to_string())?;
    let led: Vec<usize> = settings.iter().map(|setting| setting.index).collect();
    loaded.check_numbers(&led)?;
    Ok((settings, followed))
}
