//! A line that shows where a run is.

use crate::certificate::cover::CoverStage;
use crate::complete::Progress as Searched;
use crate::track::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::IsTerminal;
use std::time::Duration;

/// One line on standard error, where that is a terminal: a clock that ticks from the first moment on,
/// which run of how many, t, steps, solutions so far, length of the path. Elsewhere nothing at all.
///
/// How long a path is is known only at its end, so there is no bar that fills up.
pub struct ProgressLine {
    line: Option<ProgressBar>,
    /// What is at work, before the numbers.
    what: String,
}

/// Between two drawings.
const TICK: Duration = Duration::from_millis(125);

impl ProgressLine {
    /// The line, if standard error is a terminal and `wanted`; `what` says what is at work.
    pub fn new(wanted: bool, what: &str) -> Self {
        let what = match what {
            "" => String::new(),
            _ => format!("{what}   "),
        };
        let line = (wanted && std::io::stderr().is_terminal()).then(|| {
            let line = ProgressBar::new_spinner();
            let style = ProgressStyle::with_template("{spinner} {elapsed:>4}  {msg}");
            line.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
            line.set_message(format!("{what}at the sketch"));
            // A thread of its own: however long a step takes, the clock ticks.
            line.enable_steady_tick(TICK);
            line
        });
        ProgressLine { line, what }
    }

    fn say(&self, text: impl FnOnce() -> String) {
        if let Some(line) = &self.line {
            line.set_message(text());
        }
    }

    /// Shows where the run is.
    pub fn show(&self, now: Progress) {
        self.say(|| format!("{}{}", self.what, text(now)));
    }

    /// Shows where the check of a certificate is.
    pub fn show_check(&self, tubes: u64, solutions: usize) {
        let what = &self.what;
        self.say(|| format!("{what}tubes checked {tubes}   solutions {solutions}"));
    }

    /// Shows where the check of a cover is.
    pub fn show_cover(&self, now: CoverStage) {
        let (parts, percent) = (now.parts, 100.0 * now.share);
        self.say(|| format!("parts proved {parts}   {percent:.1} % of the cover"));
    }

    /// Shows where the search for all solutions is: what is left is guessed from what is done.
    pub fn show_search(&self, now: Searched, seconds: f64) {
        let (share, fresh) = (now.share, now.share - now.before);
        let left = seconds * (1.0 - share) / fresh.max(1e-9);
        self.say(|| {
            format!(
                "{:.4} % of the parameter space   boxes {}   perhaps {left:.0} s left",
                100.0 * share,
                now.boxes
            )
        });
    }

    /// Shows where the search for complex solutions is: the text says.
    pub fn show_text(&self, text: String) {
        self.say(|| text);
    }

    /// Takes the line away.
    pub fn clear(self) {
        if let Some(line) = &self.line {
            line.finish_and_clear();
        }
    }
}

fn text(now: Progress) -> String {
    let Progress {
        t,
        steps,
        solutions,
        length,
    } = now;
    format!("t {t:8.4}   steps {steps}   solutions {solutions}   path length {length:.2}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn says_where_the_run_is() {
        let now = Progress {
            t: 0.5,
            steps: 64,
            solutions: 2,
            length: 3.25,
        };
        assert_eq!(
            text(now),
            "t   0.5000   steps 64   solutions 2   path length 3.25"
        );
    }
}
