//! `krawl show`: pictures of a result.

use super::pictures::Pictures;
use super::{BAD_INPUT, CLOSED, output};
use krawl::report::page::Page;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Make a page, pictures or files of figures from a result that a verb wrote with `--json`
///
/// Without any option the page goes beside the result, as RESULT.html.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl solve sketch.toml --json out.json --samples 1000
  krawl show out.json                        writes out.html, to be opened in a browser
  krawl show out.json --svg figures.svg --xyz figures.xyz
  krawl solve sketch.toml --json - --samples 500 | krawl show - --html page.html
  krawl all sketch.toml --json all.json      results of edit, sweep, limits, all and explore too
  krawl show all.json --html all.html

Exit codes: 0 written, 2 not a result, or it could not be written.")]
pub struct Arguments {
    /// The result (JSON, docs/using/programs.md); `-` is standard input
    result: PathBuf,
    #[command(flatten)]
    pictures: Pictures,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let file = &arguments.result;
    let places = arguments.pictures.places([file])?;
    let text = match file == Path::new("-") {
        true => {
            let mut text = String::new();
            let read = std::io::stdin().lock().read_to_string(&mut text);
            read.map(|_| text)
        }
        false => std::fs::read_to_string(file),
    };
    let text = text.map_err(|error| format!("{}: cannot be read: {error}", file.display()))?;
    let lines: Vec<&str> = text
        .lines()
        .filter(|line| !line.trim().is_empty())
        .collect();
    if lines.len() > 1 && lines.iter().all(|line| line.starts_with('{')) {
        return Err(format!(
            "{}: holds {} results, one on each line; give `show` one of them",
            file.display(),
            lines.len()
        ));
    }
    let page = Page::from_json(&text).map_err(output::in_file(file))?;
    let written = match places.is_empty() {
        false => places.write(&page),
        true if file == Path::new("-") => {
            return Err("name a file for the page: `--html FILE`".to_owned());
        }
        true => {
            let html = file.with_extension("html");
            let written = output::Destination::new(&html)?.write(&page.to_html());
            written && output::print(&format!("{}\n", html.display()))
        }
    };
    Ok(if written { CLOSED } else { BAD_INPUT })
}
