//! `krawl merge`: takes the results of work units back into the store.

use super::CLOSED;
use super::output;
use krawl::explore::{Explorer, read_result};
use std::path::PathBuf;

/// Take the results of work units into the store that the units are from
///
/// Every solution is proved again to exist before it counts, so that a wrong file cannot add one; how paths ended is
/// taken from the files. The same results may be merged twice, and those of a unit that is not done yet, too.
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl merge store store/*.krawl-result
  krawl explore problem.toml --store store      goes on from there

Exit codes: 0 merged, 2 bad input, or another process has the store open.")]
pub struct Arguments {
    /// The folder of the store
    store: PathBuf,
    /// Files that `krawl work` wrote
    #[arg(required = true)]
    results: Vec<PathBuf>,
    /// Print nothing but errors
    #[arg(long)]
    quiet: bool,
}

/// Runs the verb and returns the exit code.
pub fn run(arguments: &Arguments) -> Result<u8, String> {
    let mut explorer = Explorer::existing(&arguments.store).map_err(|e| e.to_string())?;
    let problem = explorer.problem().to_toml();
    let before = explorer.contents().classes.len();
    let (mut records, mut all) = (Vec::new(), 0);
    for path in &arguments.results {
        let at = |error: String| format!("{}: {error}", path.display());
        let text = std::fs::read_to_string(path).map_err(|e| at(e.to_string()))?;
        let read = read_result(&text, &problem).map_err(at)?;
        all += read.len();
        records.extend(read);
    }
    let new = explorer.merge(records).map_err(|e| e.to_string())?;
    if !arguments.quiet {
        let contents = explorer.contents();
        output::print(&format!(
            "{new} of {all} paths were new; {} solutions, {} of them new; {} sketches waiting, {} in work units\n",
            contents.classes.len(),
            contents.classes.len() - before,
            contents.queue().len(),
            contents.out.len()
        ));
    }
    Ok(CLOSED)
}
