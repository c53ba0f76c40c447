//! `krawl edit --serve`: edits as lines of JSON, one answer for each.

use super::input::Loaded;
use krawl::edit::{Drag, Ending, Session, Setting};
use krawl::import::Followed;
use krawl::report::document::{Answer, Standing};
use krawl::track::Control;
use serde::Deserialize;
use serde_json::value::RawValue;
use serde_json::{Value, json};
use std::collections::BTreeMap;
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
    /// Whatever it is, it comes back with the answer.
    #[serde(default)]
    id: Option<Value>,
}

/// Answers lines until there are no more, or nobody reads the answers. The result: whether all is well.
pub fn serve(session: &mut Session, loaded: &Loaded) -> bool {
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
        let answer = answer(session, loaded, &line);
        if writeln!(output, "{answer}")
            .and_then(|()| output.flush())
            .is_err()
        {
            return true;
        }
    }
}

fn answer(session: &mut Session, loaded: &Loaded, line: &[u8]) -> Value {
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
    let mut answer = match settings(session, loaded, &request) {
        _ if !request.drag.is_empty() => match drags(session, &request) {
            Err(reason) => json!({"status": "error", "reason": reason}),
            Ok(drags) => {
                let mut edited = session.drag(&drags, &mut Control::default());
                loaded.add_left_out(&mut edited.account, Some(&edited.points));
                let mut answer = Answer::of(session, &edited);
                let is_moved = edited.dragged.is_some_and(|dragged| dragged.legs > 0);
                answer.edit.committed = Some(is_moved);
                json!(answer)
            }
        },
        Err(reason) => json!({"status": "error", "reason": reason}),
        Ok((settings, _)) if settings.is_empty() => json!(Standing::new(session)),
        Ok((settings, mut followed)) => {
            let mut control = Control::default();
            let mut edited = match request.probe {
                true => session.probe(&settings, &mut control),
                false => session.edit_with(&settings, &mut control),
            };
            loaded.add_left_out(&mut edited.account, Some(&edited.points));
            if edited.ending != Ending::Reached {
                followed.note_way();
            }
            let mut answer = Answer::of(session, &edited);
            answer.edit.follow(session.problem(), &followed);
            let is_committed = !request.probe && edited.ending == Ending::Reached;
            answer.edit.committed = Some(is_committed);
            json!(answer)
        }
    };
    if let Some(id) = request.id {
        answer["id"] = id;
    }
    answer
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
