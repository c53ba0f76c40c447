//! One self-contained page with figures to turn, a path to travel, and the words that belong to them.
//!
//! A [`Page`] is made from a result as `--json` writes it ([`Page::of`]), whichever verb it is of: one file here
//! for each. What draws pages knows nothing of verbs. A page is written as HTML that needs no network: `page.html` with
//! `page.css`, `page.js` and the data in it.

mod banded;
mod complete;
mod cut;
mod edited;
mod exchange;
mod explored;
mod motion;
mod moving;
mod outlines;
mod path;
mod projection;
mod ranges;
mod reader;
mod result;
mod solved;
mod still;
mod swept;

pub use super::document::ShowError;

use serde::Serialize;

/// What a page shows.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Page {
    /// The name of the problem.
    pub title: String,
    /// A word or two on what the answer is worth: `proved`.
    pub badge: String,
    /// The colour of that.
    pub tone: Tone,
    /// The answer in a sentence.
    pub verdict: String,
    /// 2 or 3.
    pub dimension: usize,
    /// The points' names.
    pub points: Vec<String>,
    /// Lines between points.
    pub bars: Vec<Bar>,
    /// Dimensions that are no bars: angles, radii and others.
    pub labels: Vec<Label>,
    /// Lines, planes, circles, spheres and arcs.
    pub shapes: Vec<Shape>,
    /// The figures, in the order of the list.
    pub figures: Vec<Figure>,
    /// The paths on which they are, as far as there are any to travel.
    pub paths: Vec<Path>,
    /// The answer explained, below the figures.
    pub text: Vec<Text>,
    /// The sentence below a figure's coordinates: which axes, and what the digits are worth.
    pub digits: String,
    /// Numbers of the run, each with its label.
    pub rows: Vec<(String, String)>,
}

/// What an answer is worth.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Tone {
    /// All that is said is proved.
    Proved,
    /// What is said was observed in floating point, not proved.
    Observed,
    /// There is no full answer.
    #[default]
    Stopped,
}

/// A piece of text.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Text {
    /// A paragraph.
    Paragraph(String),
    /// A numbered list.
    List(Vec<String>),
}

/// A line between two points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Bar {
    /// The points, by number.
    pub ends: [usize; 2],
    /// The text on the bar: its dimension.
    pub label: String,
    /// The length that it has to have, if it has one.
    pub target: Option<f64>,
}

/// A dimension that is written in the middle of some points.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Label {
    /// The text.
    pub text: String,
    /// The text on the figure in the file, where that is another.
    pub was: Option<String>,
    /// The points, by number.
    pub points: Vec<usize>,
}

/// A line, plane, circle, sphere or arc.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Shape {
    /// Its name.
    pub name: String,
    /// `line`, `plane`, `circle`, `sphere` or `arc`.
    pub kind: String,
    /// Of a line through two points these: what is drawn of it for other programs.
    #[serde(skip)]
    pub ends: Option<[usize; 2]>,
}

/// A figure.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Figure {
    /// The figure's name in the list.
    pub name: String,
    /// A remark that stands below the name.
    pub note: String,
    /// `sketch`, which is drawn behind others, or `solution`.
    pub kind: &'static str,
    /// Figures of the same class have the same colour. `None`: it is no answer.
    pub class: Option<usize>,
    /// The path of the page on which it is.
    pub path: Option<usize>,
    /// Where it is on the path.
    pub at: Option<f64>,
    /// The parameter of the path there.
    pub t: Option<f64>,
    /// Folds between the beginning of the path and it.
    pub folds: Option<usize>,
    /// Three coordinates of each point, one after the other.
    pub points: Vec<f64>,
    /// For each of [`Page::shapes`] where it is drawn: both ends of a line, four corners of a plane, the centre of a
    /// circle or sphere and its radius, the centre, start and end of an arc and its radius, negative where the arc goes
    /// clockwise. A shape of which that is not known has no numbers.
    pub outlines: Vec<Vec<f64>>,
    /// The coordinates of each point as they are to be read.
    pub digits: Option<Vec<Vec<String>>>,
}

/// A path of figures.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Path {
    /// What the path is called, where there are several.
    pub name: String,
    /// What the parameter is called.
    pub parameter: String,
    /// What the path's length is, under its picture.
    pub along: String,
    /// What the picture's signs mean.
    pub legend: String,
    /// Values of the parameter that mean something.
    pub levels: Vec<Level>,
    /// Figures along the path, in its order.
    pub samples: Vec<Sample>,
    /// Places where the path turns back in the parameter.
    pub marks: Vec<Mark>,
    /// How narrowly the path and the figures on it are enclosed, where that is proved.
    pub accuracy: Option<Accuracy>,
    /// Whether its figure at 0 stands for the sketch, not that of the page.
    pub has_own_sketch: bool,
}

/// How narrowly a path is enclosed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Accuracy {
    /// For each sample, how far the path may be from it in any coordinate.
    pub samples: Vec<f64>,
    /// For each figure of the page half the width of its widest bounds. `None`: it has none.
    pub figures: Vec<Option<f64>>,
    /// What the picture's signs mean.
    pub legend: String,
}

/// A value of the parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Level {
    /// The value.
    pub t: f64,
    /// The text at the level.
    pub label: String,
}

/// A figure of the path.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sample {
    /// Length of the path up to it.
    pub at: f64,
    /// The parameter.
    pub t: f64,
    /// Three coordinates of each point, one after the other.
    pub points: Vec<f64>,
    /// As in [`Figure::outlines`].
    pub outlines: Vec<Vec<f64>>,
}

/// A place on the path.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Mark {
    /// Length of the path up to it.
    pub at: f64,
    /// The parameter.
    pub t: f64,
}

impl Page {
    /// Says what the answer is worth.
    fn rate(&mut self, (badge, tone): (&str, Tone)) {
        (self.badge, self.tone) = (badge.into(), tone);
    }

    /// A paragraph more.
    fn say(&mut self, words: impl Into<String>) {
        self.text.push(Text::Paragraph(words.into()));
    }

    /// A number of the run more.
    fn row(&mut self, label: &str, value: impl ToString) {
        self.rows.push((label.to_owned(), value.to_string()));
    }

    /// The page, as the text of one file.
    ///
    /// # Panics
    /// Never: the data are strings, numbers and lists.
    pub fn to_html(&self) -> String {
        let data = serde_json::to_string(&self.rounded()).expect("this has a form in JSON");
        // Nothing in the data may end the element that it is in.
        let data = data.replace('<', "\\u003c");
        let title = self.title.replace('&', "&amp;").replace('<', "&lt;");
        let mut html = include_str!("page.html").to_owned();
        for (place, text) in [
            ("@style@", include_str!("page.css")),
            ("@script@", include_str!("page.js")),
            // The data last: what is in them is not looked at any more.
            ("@title@", &title),
            ("@data@", &data),
        ] {
            html = html.replacen(place, text, 1);
        }
        html
    }

    /// With no more digits in coordinates than a screen shows many times enlarged.
    fn rounded(&self) -> Page {
        let size = self
            .figures
            .iter()
            .flat_map(|figure| &figure.points)
            .fold(f64::MIN_POSITIVE, |max: f64, x| max.max(x.abs()));
        let unit = 10f64.powi(6 - size.log10().ceil() as i32);
        let round = |points: &mut Vec<f64>| {
            for x in points {
                *x = (*x * unit).round() / unit + 0.0;
            }
        };
        let mut page = self.clone();
        for figure in &mut page.figures {
            round(&mut figure.points);
            figure.outlines.iter_mut().for_each(round);
        }
        for sample in page.paths.iter_mut().flat_map(|path| &mut path.samples) {
            round(&mut sample.points);
            sample.outlines.iter_mut().for_each(round);
            sample.at = (sample.at * 1e7).round() / 1e7;
            sample.t = (sample.t * 1e7).round() / 1e7;
        }
        page
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_ends_its_element() {
        let evil = "</script><script>alert(1)</script>@data@";
        let page = Page {
            title: evil.into(),
            verdict: evil.into(),
            dimension: 2,
            points: vec![evil.into()],
            text: vec![Text::Paragraph(evil.into())],
            ..Page::default()
        };
        let html = page.to_html();
        assert_eq!(html.matches("</script>").count(), 2);
        assert!(!html.contains("<script>alert"));
        // Nothing is fetched.
        assert!(!html.contains("http://") || html.contains("http://www.w3.org/2000/svg"));
        assert_eq!(html.matches("https://").count(), 0);
    }
}
