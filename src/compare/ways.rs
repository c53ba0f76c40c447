//! The modes and spaces that there are, and the settings at which a sweep tries them.

use crate::track::{Options, Space};

crate::named! {
    /// How the path is followed.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Method {
        /// Every step proved.
        Certified = "certified",
        /// Floating point.
        Float = "float",
        /// Floating point, stepping as in RR 8705.
        Paper = "paper",
    }
}

/// A method in a space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Way {
    /// How the path is followed.
    pub method: Method,
    /// The space in which the path is followed.
    pub space: Space,
}

impl Way {
    /// All ways, in the order of a comparison's rows. Certified ways are first: the others are judged against them.
    pub fn all() -> impl Iterator<Item = Way> {
        let of = |method| Space::ALL.map(|space| Way { method, space });
        Method::ALL.into_iter().flat_map(of)
    }

    /// The options of a run.
    pub fn options(self) -> Options {
        match self.method {
            Method::Certified => Options {
                space: self.space,
                ..Options::certified()
            },
            Method::Float => Options::float(self.space),
            Method::Paper => Options::paper(self.space),
        }
    }
}

crate::named! {
    /// What a sweep varies.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    pub enum Knob {
        /// [`Options::tube_radius`].
        TubeRadius = "tube-radius",
        /// [`Options::tolerance`].
        Tolerance = "tolerance",
        /// [`Options::max_step`].
        MaxStep = "max-step",
    }
}

/// A knob and where it is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Setting {
    /// What is set.
    pub knob: Knob,
    /// Its value in typical lengths of the problem, so that pictures of different problems compare.
    pub relative: f64,
    /// Its value in the lengths of the problem, as `krawl solve` takes it.
    pub value: f64,
}

impl Setting {
    /// Options with this set.
    pub fn apply(&self, options: Options) -> Options {
        match self.knob {
            Knob::TubeRadius => options.with_tube_radius(self.value),
            Knob::Tolerance => options.with_tolerance(self.value),
            Knob::MaxStep => options.with_max_step(self.value),
        }
    }
}

/// Powers of ten for tube radii and tolerances.
const DECADES: std::ops::RangeInclusive<i32> = 4..=14;

/// Bounds on the step. The paper's own are 0.1 and 0.05.
const STEPS: [f64; 9] = [5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01];

/// The settings of a sweep, the loosest first.
pub(super) fn settings(way: Way, typical_length: f64) -> impl Iterator<Item = Setting> {
    let accuracy = match way.method {
        Method::Certified => Knob::TubeRadius,
        Method::Float | Method::Paper => Knob::Tolerance,
    };
    let accuracies = DECADES.map(move |k| (accuracy, decade(-k)));
    let steps = STEPS.into_iter().map(|step| (Knob::MaxStep, step));
    accuracies
        .chain(steps)
        .map(move |(knob, relative)| Setting {
            knob,
            relative,
            value: relative * typical_length,
        })
}

/// 10ᵏ as the nearest float.
fn decade(k: i32) -> f64 {
    format!("1e{k}").parse().expect("a decimal")
}
