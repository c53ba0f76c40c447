//! Pages and pictures that verbs with figures can write.

use super::output::{self, Destination};
use krawl::report::page::Page;
use std::path::{Path, PathBuf};

const HEADING: &str = "Pictures and figures";

/// Where pages, pictures and figures go.
#[derive(clap::Args)]
pub struct Pictures {
    /// Write a page to look at, for any browser
    ///
    /// Turn the figures, travel the path, pick solutions; it needs no network
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    html: Option<PathBuf>,
    /// Write a still picture of the first figures (SVG)
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    svg: Option<PathBuf>,
    /// Write a picture of the figure moving along its path (animated SVG)
    #[arg(long, value_name = "FILE", help_heading = HEADING, hide_short_help = true)]
    animation: Option<PathBuf>,
    /// Write the figures, the sketch first, as Wavefront OBJ
    #[arg(long, value_name = "FILE", help_heading = HEADING, hide_short_help = true)]
    obj: Option<PathBuf>,
    /// Write the solutions as DXF, lines, circles and arcs in their size
    #[arg(long, value_name = "FILE", help_heading = HEADING, hide_short_help = true)]
    dxf: Option<PathBuf>,
    /// Write the solutions as XYZ, as programs for molecules read it
    #[arg(long, value_name = "FILE", help_heading = HEADING)]
    xyz: Option<PathBuf>,
}

/// Destinations of pages, pictures and figures that are known to be possible.
#[derive(Default)]
pub struct Places<'a> {
    all: Vec<(Kind, Destination, &'a Path)>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Html,
    Svg,
    Animation,
    Obj,
    Dxf,
    Xyz,
}

impl Pictures {
    /// The files that will be written.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.all().into_iter().map(|(_, path)| path)
    }

    fn all(&self) -> Vec<(Kind, &PathBuf)> {
        [
            (Kind::Html, &self.html),
            (Kind::Svg, &self.svg),
            (Kind::Animation, &self.animation),
            (Kind::Obj, &self.obj),
            (Kind::Dxf, &self.dxf),
            (Kind::Xyz, &self.xyz),
        ]
        .into_iter()
        .filter_map(|(kind, path)| Some((kind, path.as_ref()?)))
        .collect()
    }

    /// Whether there is one that moves, and so needs a path.
    pub fn has_animation(&self) -> bool {
        self.animation.is_some()
    }

    /// Whether the path is needed, not the solutions only.
    pub fn want_path(&self) -> bool {
        self.html.is_some() || self.animation.is_some()
    }

    /// Says early that something cannot be written where it is wanted: where it is not possible, or where one
    /// of the files is that are read.
    pub fn places<'f>(
        &self,
        read: impl IntoIterator<Item = &'f PathBuf> + Clone,
    ) -> Result<Places<'_>, String> {
        for path in self.files() {
            output::refuse_read(read.clone(), Some(path))?;
        }
        let all = self.all().into_iter();
        let all = all.map(|(kind, path)| Ok((kind, Destination::new(path)?, path.as_path())));
        Ok(Places {
            all: all.collect::<Result<_, String>>()?,
        })
    }
}

impl Places<'_> {
    /// Whether there is nothing to write.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether something goes to standard output.
    pub fn use_standard_output(&self) -> bool {
        let mut all = self.all.iter();
        all.any(|(_, destination, _)| *destination == Destination::StandardOutput)
    }

    /// Writes all of it. Returns whether all is well, having complained otherwise.
    pub fn write(&self, page: &Page) -> bool {
        let mut well = true;
        for (kind, destination, path) in &self.all {
            let text = match kind {
                Kind::Html => Some(page.to_html()),
                Kind::Svg => Some(page.to_svg()),
                Kind::Animation => page.to_moving_svg(),
                Kind::Obj => Some(page.to_obj()),
                Kind::Dxf => Some(page.to_dxf()),
                Kind::Xyz => Some(page.to_xyz()),
            };
            well &= match text {
                Some(text) => destination.write(&text),
                None => {
                    output::complain(&format!(
                        "{}: not written, as the result has no path (certified runs have one; a JSON \
                         result has it with `--samples N`)",
                        path.display()
                    ));
                    false
                }
            };
        }
        well
    }
}
