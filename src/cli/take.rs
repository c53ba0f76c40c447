//! Taking a figure: it is written into the file that it is of.

use super::input;
use super::output::{self, Beside};
use crate::places::Each as _;
use krawl::import::Format;
use krawl::problem::{Problem, Shape};
use krawl::system::{Located, Placement};
use krawl::track::Solution;
use std::path::{Path, PathBuf};

/// Which figure is taken, and where it goes.
#[derive(clap::Args)]
pub(super) struct Take {
    /// Take a figure: write it into a file like FILE
    ///
    /// With the places of points and the radii of the figure. Where there are several, --pick or --nearest says which
    /// (with `solve` --first, too)
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Take the K-th of the solutions listed
    #[arg(long, value_name = "K", requires = "out", value_parser = clap::value_parser!(u64).range(1..))]
    pick: Option<u64>,
    /// Take the solution nearest to the sketch
    ///
    /// With the least sum of the squares of how far its points are from there. (Of figures that `all` lists up to
    /// mirror images, the one of both that is nearer is meant, by --pick too)
    #[arg(long, requires = "out", conflicts_with = "pick")]
    nearest: bool,
}

/// The figures of which one is taken.
#[derive(Clone, Copy)]
pub(super) struct Candidates {
    /// How many there are, numbered from 0.
    pub count: u64,
    /// The one that was asked for in another way, if it was.
    pub first: Option<u64>,
    /// Whether there is no other.
    pub is_all: bool,
}

/// A figure in the coordinates of its file.
pub(super) struct Taken {
    /// Points, in the order of the problem.
    pub points: Vec<[f64; 3]>,
    /// Where its objects are.
    pub objects: Vec<Located>,
}

impl Taken {
    /// A solution of a problem, where the sketch has its reference; with `either` it or its mirror image, whichever is nearer to the sketch.
    pub fn of(problem: &Problem, solution: &Solution, either: bool) -> Result<Self, String> {
        let own = Self::placed(problem, solution, false)?;
        if problem.is_absolute() || !either {
            return Ok(own);
        }
        let mirrored = Self::placed(problem, solution, true)?;
        match mirrored.off_sketch(problem) < own.off_sketch(problem) {
            true => Ok(mirrored),
            false => Ok(own),
        }
    }

    fn placed(problem: &Problem, solution: &Solution, mirrored: bool) -> Result<Self, String> {
        let points: Vec<[f64; 3]> = match problem.is_absolute() {
            true => solution
                .points
                .iter()
                .map(|p| p.each(|x| x.mid()))
                .collect(),
            false => {
                let placement = Placement::of(problem).map_err(|error| error.to_string())?;
                let last = problem.dimension - 1;
                let seen = solution.points.iter().map(|p| {
                    let mut seen = *p;
                    if mirrored {
                        seen[last] = -seen[last];
                    }
                    seen
                });
                let there = seen.map(|p| placement.to_problem(&p));
                there.map(|p| p.each(|x| x.mid())).collect()
            }
        };
        let objects = solution.objects.clone();
        Ok(Taken { points, objects })
    }

    /// The sum of the squares of how far points are from where the sketch has them.
    fn off_sketch(&self, problem: &Problem) -> f64 {
        let pairs = self.points.iter().zip(&problem.points);
        let squares = pairs.flat_map(|(at, point)| {
            let sketch = point.place();
            std::array::from_fn::<f64, 3, _>(|k| (at[k] - sketch[k]).powi(2))
        });
        let objects = self.objects.iter().zip(&problem.objects);
        let numbers = |located: &Located| match located {
            Located::Pose { at, axes } => Some([*at, axes[0], axes[1], axes[2]].concat()),
            _ => None,
        };
        let bodies = objects.filter_map(|(at, object)| {
            let Shape::Body { place, .. } = &object.shape else {
                return None;
            };
            let drawn = numbers(&Located::posed(place.as_ref()?))?;
            let pairs = numbers(at)?.into_iter().zip(drawn);
            let off = pairs.map(|(x, y)| (x.mid() - y.mid()).powi(2));
            Some(off.sum::<f64>())
        });
        squares.sum::<f64>() + bodies.sum::<f64>()
    }
}

/// Refuses a file to be written that would not be of the format of the one that was read.
pub(super) fn check_format(file: &Path, out: &Path) -> Result<(), String> {
    let of = |path: &Path| {
        let extension = path.extension().unwrap_or_default();
        extension.to_string_lossy().to_lowercase()
    };
    let name = file.display().to_string();
    let is_problem = file == Path::new("-") || Format::of(&name).is_none();
    if input::made(file).is_some() && of(out) != "toml" {
        return Err(format!(
            "{}: a robot or a system of polynomials is written as a problem file: give it the ending .toml",
            out.display()
        ));
    }
    let ending = match is_problem {
        true => "toml".to_owned(),
        false => of(file),
    };
    let is_so = of(out) == ending || (is_problem && (of(out).is_empty() || of(out) == of(file)));
    match is_so {
        true => Ok(()),
        false => Err(format!(
            "{}: is written in the format of {name}: give it the ending .{ending}",
            out.display()
        )),
    }
}

impl Take {
    /// Whether a figure is to be written.
    pub fn is_wanted(&self) -> bool {
        self.out.is_some()
    }

    /// Refuses what cannot be written, before anything runs.
    pub fn check(&self, file: &Path) -> Result<(), String> {
        match &self.out {
            Some(_) if file == Path::new("-") => Err(
                "`--out` keeps all of a file but its figure: name a file in place of standard input".to_owned(),
            ),
            Some(out) => check_format(file, out),
            None => Ok(()),
        }
    }

    /// Writes the figure that is wanted of those listed, if one is. Whether all went well; what did not is told.
    pub fn write(
        &self,
        (file, which): (&Path, &input::Which),
        problem: &Problem,
        listed: Candidates,
        figure: impl Fn(u64) -> Result<Taken, String>,
    ) -> bool {
        let Some(out) = &self.out else {
            return true;
        };
        let done = self.number(problem, listed, &figure).and_then(|number| {
            let bytes = rewritten((file, which), problem, &figure(number)?)?;
            Ok(Beside::new(out)?.write(&bytes))
        });
        done.unwrap_or_else(|error| {
            output::complain(&format!("{}: is not written: {error}", out.display()));
            false
        })
    }

    /// Which one is wanted, from 0.
    fn number(
        &self,
        problem: &Problem,
        listed: Candidates,
        figure: &impl Fn(u64) -> Result<Taken, String>,
    ) -> Result<u64, String> {
        const MOST: u64 = 100_000;
        let (count, is_all) = (listed.count, listed.is_all);
        match (self.pick, listed.first, count) {
            (_, _, 0) => Err("there is no figure to take".to_owned()),
            (Some(k), _, _) if k <= count => Ok(k - 1),
            (Some(k), _, _) if is_all => {
                Err(format!("there is no solution {k}: there are {count}"))
            }
            (Some(k), _, _) => Err(format!("solution {k} is not listed: the first {count} are")),
            (None, _, _) if self.nearest && (!is_all || count > MOST) => Err(
                "there are so many figures that the nearest one was not looked for: add `--pick K`"
                    .to_owned(),
            ),
            (None, _, _) if self.nearest => {
                let mut best = (f64::INFINITY, 0);
                for number in 0..count {
                    let off = figure(number)?.off_sketch(problem);
                    if off < best.0 {
                        best = (off, number);
                    }
                }
                Ok(best.1)
            }
            (None, Some(number), _) => Ok(number),
            (None, None, 1) if is_all => Ok(0),
            (None, None, _) => Err(
                "there are several solutions: add `--pick K`, the number of one, or `--nearest`"
                    .to_owned(),
            ),
        }
    }
}

/// The file with the figure in it, in its own format. Points and objects are told by their names, as a problem that was made from the file's may have
/// them in another order.
fn rewritten(
    (file, which): (&Path, &input::Which),
    problem: &Problem,
    taken: &Taken,
) -> Result<Vec<u8>, String> {
    let loaded = input::load_again(file, which)?;
    let of_point = |name: &str| problem.points.iter().position(|p| p.name == name);
    let of_object = |name: &str| problem.objects.iter().position(|o| o.name == name);
    let points = loaded
        .problem
        .points
        .iter()
        .map(|point| of_point(&point.name).map_or_else(|| point.place(), |p| taken.points[p]));
    let objects = loaded.problem.objects.iter().map(|object| {
        let there = of_object(&object.name).and_then(|o| taken.objects.get(o));
        // What there is none of stays as it is.
        there.copied().unwrap_or(Located::Body)
    });
    let (points, objects): (Vec<_>, Vec<_>) = (points.collect(), objects.collect());
    loaded.rewritten(file, &loaded.problem, &points, &objects)
}
