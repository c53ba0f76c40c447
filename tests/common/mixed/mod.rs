//! Random problems of mixed kinds, what their constraints mean, and the same problems written in other ways.

mod drawing;
mod meaning;
mod writing;

pub use writing::View;

use krawl::problem::Problem;

/// What a constraint names.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Name {
    Point(usize),
    Line(usize),
    Plane(usize),
    Circle(usize),
    Arc(usize),
    /// A line of its own.
    FreeLine(usize),
    /// A plane of its own.
    FreePlane(usize),
    /// A coordinate axis.
    Axis(usize),
}

/// A line or plane of its own in the sketch, in hundredths, and points that constraints put on it, enough to say where
/// it is.
#[derive(Debug, Clone)]
pub struct Free {
    pub point: [i64; 3],
    pub along: [i64; 3],
    pub through: Vec<usize>,
}

/// A rigid body: its points, and their coordinates in its own frame, in thousandths.
#[derive(Debug, Clone)]
pub struct Body {
    pub points: Vec<usize>,
    pub local: Vec<[i64; 3]>,
}

/// A number, in thousandths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Number {
    Length(i64),
    Degrees(i64),
}

#[derive(Debug, Clone)]
pub struct Constraint {
    pub kind: &'static str,
    pub names: Vec<Name>,
    pub number: Option<Number>,
}

/// A problem. Coordinates are in hundredths, lengths in thousandths.
#[derive(Debug, Clone)]
pub struct Spec {
    pub dimension: usize,
    pub points: Vec<[i64; 3]>,
    pub distances: Vec<(usize, usize, i64)>,
    pub lines: Vec<[usize; 2]>,
    pub planes: Vec<[usize; 3]>,
    /// Centre and radius.
    pub circles: Vec<(usize, i64)>,
    /// Centre, start and end.
    pub arcs: Vec<[usize; 3]>,
    pub free_lines: Vec<Free>,
    pub free_planes: Vec<Free>,
    pub bodies: Vec<Body>,
    pub constraints: Vec<Constraint>,
    pub bend: usize,
    /// The coefficient, in hundredths.
    pub c: i64,
    /// Fixed points, in the user's own frame.
    pub fixed: Vec<usize>,
}

type Vector = [f64; 3];

fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| a[k] - b[k])
}

fn dot(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

fn size(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

fn angle(a: Vector, b: Vector) -> f64 {
    size(cross(a, b)).atan2(dot(a, b)).to_degrees()
}

/// The smaller one of the two angles of lines.
fn acute(a: Vector, b: Vector) -> f64 {
    let x = angle(a, b);
    x.min(180.0 - x)
}

impl Spec {
    /// A random problem that krawl takes, if there is one among some tries.
    pub fn random(
        dimension: usize,
        below: &mut dyn FnMut(usize) -> usize,
    ) -> Option<(Spec, Problem)> {
        (0..20).find_map(|_| {
            let spec = Spec::draw(dimension, below);
            // Constraints that say where a point is relative to others, and that the sketch does not meet, are led to that
            // in the frame of the reference: another reference has another path.
            if spec.fixed.is_empty() && spec.reference().is_none() {
                return None;
            }
            let problem = Problem::parse(&spec.text(&View::same(&spec)), "random.toml").ok()?;
            Some((spec, problem))
        })
    }

    fn draw(dimension: usize, below: &mut dyn FnMut(usize) -> usize) -> Spec {
        let n = dimension + 1 + below(3);
        let mut coordinate = |axis: usize| match axis < dimension {
            true => below(401) as i64 - 200,
            false => 0,
        };
        let points: Vec<[i64; 3]> = (0..n)
            .map(|_| std::array::from_fn(&mut coordinate))
            .collect();
        let mut spec = Spec {
            dimension,
            points,
            distances: Vec::new(),
            lines: Vec::new(),
            planes: Vec::new(),
            circles: Vec::new(),
            arcs: Vec::new(),
            free_lines: Vec::new(),
            free_planes: Vec::new(),
            bodies: Vec::new(),
            constraints: Vec::new(),
            bend: 0,
            c: [200, 50, 10][below(3)],
            fixed: Vec::new(),
        };
        // Each point is joined to as many before it as there are dimensions.
        for p in 1..n {
            let mut before: Vec<usize> = (0..p).collect();
            while before.len() > dimension {
                before.swap_remove(below(before.len()));
            }
            for q in before {
                let length = spec.length(q, p) * (0.9 + 0.002 * below(101) as f64);
                spec.distances.push((q, p, (1000.0 * length) as i64));
            }
        }
        let is_absolute = below(4) == 0;
        if is_absolute {
            spec.fixed = (0..dimension).collect();
            spec.distances.retain(|&(_, q, _)| q >= dimension);
        }
        for _ in 0..1 + below(3) {
            spec.replace(is_absolute, below);
        }
        spec.bend = below(spec.distances.len().max(1));
        spec
    }

    fn length(&self, a: usize, b: usize) -> f64 {
        size(minus(self.at(a), self.at(b)))
    }

    fn at(&self, p: usize) -> Vector {
        self.points[p].map(|x| x as f64 / 100.0)
    }

    /// Points that are joined to each other, if there are enough.
    fn reference(&self) -> Option<Vec<usize>> {
        let joined = |a: usize, b: usize| {
            self.distances
                .iter()
                .any(|&(x, y, _)| (x, y) == (a.min(b), a.max(b)))
        };
        let n = self.points.len();
        let pairs = (0..n).flat_map(|b| (0..b).map(move |a| vec![a, b]));
        let mut pairs = pairs.filter(|p| joined(p[0], p[1]));
        match self.dimension {
            2 => pairs.next(),
            _ => pairs.find_map(|p| {
                let third =
                    (0..n).find(|&c| !p.contains(&c) && joined(p[0], c) && joined(p[1], c))?;
                Some(vec![p[0], p[1], third])
            }),
        }
    }
}
