//! `krawl sweep --table`: several dimensions together, row by row.

use super::edit::{drawn_in_words, exit_code, open};
use super::input::Loaded;
use super::output::{self, Beside, Refusal, in_file};
use super::sweep::Arguments;
use super::{CLOSED, interrupt};
use krawl::edit::{Asked, Ending, Session, Setting};
use krawl::interval::Interval;
use krawl::problem::{Decimal, Problem};
use krawl::report::{Placed, account_in_words, edit_in_words, frames_to_csv};
use krawl::system::Located;
use std::collections::HashSet;
use std::fs;
use std::path::Path;

/// The cells of a table, of which the first line names dimensions or parameters.
struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    fn read(file: &Path) -> Result<Self, String> {
        let text = fs::read_to_string(file).map_err(in_file(file))?;
        // What comes behind # is a remark, but in the line of names, which may have it.
        let mut are_names = true;
        let lines = text.lines().map(|line| match line.split_once('#') {
            Some((row, _)) if row.is_empty() || !are_names => row,
            _ => {
                are_names &= line.trim().is_empty();
                line
            }
        });
        let text = lines.collect::<Vec<_>>().join("\n");
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
        let names: Vec<String> = reader.headers().map(cells).map_err(in_file(file))?;
        let mut seen = HashSet::new();
        if let Some(twice) = names.iter().find(|name| !seen.insert(name.as_str())) {
            let what = format!("there are two columns {twice}: leave out one of them");
            return Err(in_file(file)(what));
        }
        let rows = reader.records().map(|record| Ok(cells(&record?)));
        let rows = rows.collect::<Result<Vec<Vec<String>>, csv::Error>>();
        let rows = rows.map_err(in_file(file))?;
        for (row, cells) in rows.iter().enumerate() {
            for (name, cell) in names.iter().zip(cells) {
                if let Err(error) = cell.parse::<Decimal>() {
                    return Err(in_file(file)(format!("row {}, {name}: {error}", row + 1)));
                }
            }
        }
        match rows.is_empty() {
            true => Err(in_file(file)(
                "there is no row: the first line has the names of dimensions, each other one their values",
            )),
            false => Ok(Table { names, rows }),
        }
    }
}

/// Drives the dimensions of a table, and returns the exit code.
pub(super) fn run(arguments: &Arguments, file: &Path) -> Result<u8, Refusal> {
    let loaded = arguments.source.load()?;
    let table = Table::read(file)?;
    let cells = table
        .rows
        .iter()
        .flat_map(|row| table.names.iter().zip(row));
    let cells: Vec<(&str, &str)> = cells.map(|(name, cell)| (&**name, &**cell)).collect();
    let names = table.names.len();
    let asked = Asked::rows(&loaded.problem, &cells, names).map_err(in_file(file))?;
    // With a parameter all goes that is computed from it.
    let (columns, problem) = (asked.settings.len() / table.rows.len(), &asked.problem);
    let led = asked.given[..columns].iter().map(|setting| setting.index);
    let led: Vec<usize> = led.collect();
    loaded.check_numbers(&led).map_err(in_file(file))?;
    loaded.say_computed(&led);
    let measures = arguments.measured.of(problem)?;
    let mut results = arguments.results()?;
    let folder = arguments.out_folder.as_deref();
    if let Some(folder) = folder {
        fs::create_dir_all(folder).map_err(in_file(folder))?;
    }
    let mut control = interrupt::control();
    let options = arguments.left_out.options();
    let mut session = open(problem, &arguments.source.file, &options, &mut control)?;
    let (mut account, mut end) = (session.account(), None);
    let mut frames: Vec<(Vec<Interval>, Vec<[Interval; 3]>, Vec<Located>)> = Vec::new();
    for (number, settings) in asked.settings.chunks(columns).enumerate() {
        let row = number + 1;
        let in_row = |error| format!("{}: row {row}: {error}", file.display());
        if let Err(error) = Setting::check(session.problem(), settings) {
            // What was reached so far is not lost.
            output::complain(&in_row(error.to_string()));
            results.note(false);
            break;
        }
        let edited = session.lead(settings, &mut control);
        if edited.ending != Ending::Reached {
            end = Some((row, edited));
            break;
        }
        account.join(&edited.account);
        loaded.add_left_out(&mut account, Some(&edited.points));
        frames.push((
            edited.dimensions.iter().map(|d| d.value).collect(),
            edited.points,
            edited.objects,
        ));
        if let Some(folder) = folder {
            let given = &asked.given[number * columns..][..columns];
            let mut changed = Setting::applied(given, &loaded.problem);
            let cells = Asked::rows(&loaded.problem, &cells[number * names..][..names], names);
            changed.parameters = cells.map_err(in_file(file))?.parameters;
            results.note(write(
                arguments,
                &loaded,
                (&session, &changed),
                (folder, row),
            )?);
        }
    }
    let names: Vec<String> = asked.settings[..columns]
        .iter()
        .map(|setting| problem.dimension_name(setting.index))
        .collect();
    let frames: Vec<(&[Interval], Placed)> = frames
        .iter()
        .map(|(values, points, objects)| (&values[..], (&points[..], &objects[..])))
        .collect();
    results.write_csv(|| frames_to_csv(problem, &names, &frames, &measures));
    results.print(|| {
        let rows = (frames.len(), table.rows.len());
        let stop = end.as_ref().map_or(String::new(), |(row, edited)| {
            format!("Row {row}: {}\n", edit_in_words(problem, edited))
        });
        asked.in_words(&loaded.problem)
            + &drawn_in_words(problem, &session)
            + &in_words(&problem.name, rows, &account.clause_behind())
            + &stop
            + &measures.over(frames.iter().map(|&(_, figure)| figure))
            + &account_in_words(&account)
    });
    Ok(results.code(end.map_or(CLOSED, |(_, edited)| exit_code(&edited))))
}

fn in_words(name: &str, (done, all): (usize, usize), of: &str) -> String {
    match done {
        0 => format!("{name}: none of {all} rows was reached.\n"),
        _ => format!(
            "{name}: {done} of {all} rows, each figure proved to be the one and only continuation of the one before{of}.\n"
        ),
    }
}

/// Writes a row's figure into the file that it is of, by the number of the row.
fn write(
    arguments: &Arguments,
    loaded: &Loaded,
    (session, changed): (&Session, &Problem),
    (folder, row): (&Path, usize),
) -> Result<bool, String> {
    let (points, objects) = (session.figure(), session.objects());
    let bytes = loaded.rewritten(&arguments.source.file, changed, &points, &objects)?;
    let file = &arguments.source.file;
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let extension = file.extension().unwrap_or_default().to_string_lossy();
    let out = folder.join(format!("{stem}-{row}.{extension}"));
    Ok(Beside::new(&out)?.write(&bytes))
}
