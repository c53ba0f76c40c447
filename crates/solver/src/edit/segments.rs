//! Lines and arcs that shrink to nothing end an edit: beyond they would be turned round. If that is asked for, so do edges of closed
//! outlines, circles among them, that come to touch.
//!
//! The equations do not know which way a line along an axis runs, nor that the end of an arc comes after its start: a path goes
//! on through a line of length 0, and through an arc of 0 or 360 degrees. What is drawn is another figure then. So such a place is
//! an end, in every verb, unless a dimension with a sign says itself that this very line is to run the other way.

use crate::blocks::list_of;
use crate::interval::{Interval, enclose, point};
use crate::places::Each as _;
use crate::problem::{Item, Problem, Shape};
use crate::system::{Extent, Segment, sign_of};
use crate::track::arc::{ArcEnd, ArcRun, Kept};
use crate::track::{Stop, StopKind};

/// The lines along an axis, and the arcs. `is_same`: whether two points are known to have the same coordinate along an axis.
pub(super) fn segments(
    problem: &Problem,
    is_same: impl Fn(usize, usize, usize) -> bool,
) -> Vec<Segment> {
    let extent = |shape: &Shape| match *shape {
        Shape::Line([a, b]) if problem.dimension == 2 => {
            let same = [0, 1].each(|axis| is_same(a, b, axis));
            let axis = match same {
                [true, false] => 1,
                [false, true] => 0,
                _ => return None,
            };
            Some(Extent::Along { ends: [a, b], axis })
        }
        Shape::Arc { center, start, end } => Some(Extent::Sweep {
            points: [center, start, end],
        }),
        _ => None,
    };
    let objects = problem.objects.iter().enumerate();
    let found = objects.filter_map(|(object, of)| {
        let extent = extent(&of.shape)?;
        Some(Segment {
            object,
            other: None,
            extent,
        })
    });
    found.collect()
}

/// What of the closed outlines of a sketch is to stay apart.
pub(super) struct Outlines {
    /// All pairs of their edges that are apart as they are drawn: those without a common end, circles among them; and lines with one, which
    /// are not to fold onto each other.
    pub pairs: Vec<Segment>,
    /// The names of pairs that are not, or cannot be told to be.
    pub others: Vec<String>,
}

/// What edges of a sketch in the plane are between, by index of the object: the ends of a line; centre, start and end of an arc; the
/// centre of a circle.
fn edges(problem: &Problem) -> Vec<(usize, Vec<usize>)> {
    let objects = problem.objects.iter().enumerate();
    let edges = objects.filter_map(|(object, of)| match of.shape {
        Shape::Line([a, b]) => Some((object, vec![a, b])),
        Shape::Arc { center, start, end } => Some((object, vec![center, start, end])),
        Shape::Round { center, .. } => Some((object, vec![center])),
        _ => None,
    });
    edges.filter(|_| problem.dimension == 2).collect()
}

/// The closed outlines of a sketch in the plane: all circles; and what is left of the lines and arcs where all are taken away, again and
/// again, of which an end is not the end of another one; with lines across them if there are such. `is_same`: as of [`segments`].
/// `radius`: the unknown that is the radius of a circle.
pub(super) fn outlines(
    problem: &Problem,
    is_same: impl Fn(usize, usize, usize) -> bool,
    radius: impl Fn(usize) -> Option<usize>,
) -> Outlines {
    let mut edges = edges(problem);
    // A circle has none.
    let ends = |edge: &[usize]| match *edge {
        [.., a, b] => vec![a, b],
        _ => Vec::new(),
    };
    // Points that are in one place, by the first of them.
    let mut place: Vec<usize> = (0..problem.points.len()).collect();
    for p in 0..place.len() {
        for q in 0..p {
            if (0..2).all(|axis| is_same(p, q, axis)) {
                let [from, to] = [place[p], place[q]];
                place
                    .iter_mut()
                    .filter(|at| **at == from)
                    .for_each(|at| *at = to);
            }
        }
    }
    loop {
        let mut count = vec![0; problem.points.len()];
        for end in edges.iter().flat_map(|(_, edge)| ends(edge)) {
            count[place[end]] += 1;
        }
        let before = edges.len();
        edges.retain(|(_, edge)| ends(edge).iter().all(|&end| count[place[end]] > 1));
        if edges.len() == before {
            break;
        }
    }
    let drawn_radius = |object: &usize| match &problem.objects[*object].shape {
        Shape::Round { radius, .. } => Some([enclose(radius); 3]),
        _ => None,
    };
    let (mut pairs, mut others) = (Vec::new(), Vec::new());
    for (k, (object, one)) in edges.iter().enumerate() {
        for (other, two) in &edges[..k] {
            let [of_one, of_two] = [ends(one), ends(two)];
            let common = (0..of_one.len()).flat_map(|i| (0..of_two.len()).map(move |j| [i, j]));
            let common = common.filter(|&[i, j]| place[of_one[i]] == place[of_two[j]]);
            let extent = match &common.collect::<Vec<_>>()[..] {
                [] => Extent::Apart {
                    points: [&one[..], two].concat(),
                    first: one.len(),
                    radii: [object, other]
                        .into_iter()
                        .filter_map(|&o| radius(o))
                        .collect(),
                },
                [[i, j]] if one.len() == 2 && two.len() == 2 => Extent::Sweep {
                    points: [one[*i], one[1 - i], two[1 - j]],
                },
                _ => continue,
            };
            let radii: Vec<_> = [object, other]
                .into_iter()
                .filter_map(drawn_radius)
                .collect();
            let count = extent.points().len();
            let drawn = |k: usize| match k.checked_sub(count) {
                None => problem.points[extent.points()[k]].place().each(point),
                Some(k) => radii[k],
            };
            if extent.radii().len() != radii.len() || extent.sign(drawn, sign_of) == 0 {
                others.push(both(problem, *other, *object));
                continue;
            }
            pairs.push(Segment {
                object: *object,
                other: Some(*other),
                extent,
            });
        }
    }
    Outlines { pairs, others }
}

fn both(problem: &Problem, a: usize, b: usize) -> String {
    let [a, b] = [a, b].each(|k| &problem.objects[k].name);
    format!("{a} and {b}")
}

/// Whether points are said to have the same coordinate along an axis, by a constraint that names both, or the line between them.
pub(super) fn is_same_by_constraint(
    problem: &Problem,
) -> impl Fn(usize, usize, usize) -> bool + '_ {
    move |a, b, axis| {
        let keys = [["vertical", "horizontal"][axis], "coincident"];
        let constraints = problem.constraints.iter();
        let mut constraints = constraints.filter(|c| keys.contains(&&*c.kind));
        constraints.any(|c| match c.items[..] {
            [Item::Object(o)] => {
                matches!(problem.objects[o].shape, Shape::Line(ends) if ends == [a, b] || ends == [b, a])
            }
            [Item::Point(p), Item::Point(q)] => [p, q] == [a, b] || [p, q] == [b, a],
            _ => false,
        })
    }
}

/// A dimension with a sign that is set to the other one: on which coordinates it is, and along which axis.
pub(super) struct Reversed {
    /// The two points, or the one whose own coordinate it is.
    points: Vec<usize>,
    axis: usize,
}

impl Reversed {
    /// The dimension of a constraint that goes from a value to another, if it comes to zero or beyond.
    pub fn new(problem: &Problem, constraint: usize, from: Interval, to: Interval) -> Option<Self> {
        let constraint = &problem.constraints[constraint];
        let axis = match constraint.kind.as_str() {
            "dx" | "x" => 0,
            "dy" | "y" => 1,
            _ => return None,
        };
        let point = |item: &Item| match *item {
            Item::Point(p) => Some(p),
            _ => None,
        };
        let points: Option<Vec<usize>> = constraint.items.iter().map(point).collect();
        let is_reversed =
            !((from.inf() > 0.0 && to.inf() > 0.0) || (from.sup() < 0.0 && to.sup() < 0.0));
        let points = points.filter(|_| is_reversed)?;
        Some(Reversed { points, axis })
    }

    /// Whether it is exactly the length of a segment along its axis. `is_zero`: whether a point's coordinate is 0 and stays so.
    pub fn is_of(
        &self,
        segment: &Segment,
        is_same: impl Fn(usize, usize, usize) -> bool,
        is_zero: impl Fn(usize, usize) -> bool,
    ) -> bool {
        let Extent::Along { ends: [a, b], axis } = segment.extent else {
            return false;
        };
        let same = |p: usize, q: usize| p == q || is_same(p, q, axis);
        axis == self.axis
            && match self.points[..] {
                [p, q] => (same(p, a) && same(q, b)) || (same(p, b) && same(q, a)),
                [p] => (same(p, a) && is_zero(b, axis)) || (same(p, b) && is_zero(a, axis)),
                _ => false,
            }
    }
}

/// Where two edges come to touch and one is nothing at values of t no further apart than this, it is the latter that is named. Which is
/// first cannot be told by the tubes of the smallest radius, [`NARROWER`].
const SAME: f64 = 1e-8;

/// The segment that is the first not proved to keep its sense, before a path comes to its own end: at t = 1, or at `end`.
pub(super) fn first_lost(
    kept: &[Kept],
    end: (f64, f64),
    is_asked: impl Fn(usize) -> bool,
) -> Option<(&Kept, (f64, f64))> {
    let lost = kept.iter().filter_map(|kept| match kept.sign {
        // Two edges that were apart as they were drawn.
        0 if kept.other.is_some() => Some((kept, (0.0, 0.0))),
        0 => None,
        _ => Some((kept, kept.lost?)),
    });
    let lost: Vec<(&Kept, (f64, f64))> = lost.collect();
    // What cannot be told from the end of the path is no end before it; but t = 1 is to be reached by a figure.
    let is_before = |t: (f64, f64)| t.1 <= end.0 || end.0 >= 1.0;
    let is_asked = |kept: &Kept| kept.other.is_none() && is_asked(kept.object);
    let by_time = |a: &(&Kept, (f64, f64)), b: &(&Kept, (f64, f64))| a.1.0.total_cmp(&b.1.0);
    let ends = lost.iter().copied();
    let ends = ends.filter(|(kept, t)| is_before(*t) && !is_asked(kept));
    let (first, t) = ends.min_by(by_time)?;
    // Where an edge vanishes its neighbours come to touch.
    let vanishing = lost.into_iter();
    let vanishing =
        vanishing.filter(|(kept, at)| kept.other.is_none() && (at.0 - t.0).abs() <= SAME);
    let kept = match first.other {
        Some(_) => vanishing.min_by(by_time).map_or(first, |(kept, _)| kept),
        None => first,
    };
    Some((kept, (t.0.max(0.0), t.1.min(1.0))))
}

/// In wide tubes a line or arc cannot be told from nothing long before it vanishes, or where it never does. Where that is so the way is
/// followed again in tubes of at most these radii, as parts of the unit of length.
const NARROWER: [f64; 2] = [1e-4, 1e-9];

/// What becomes of segments in a run, told in narrower tubes as long as one seems to be lost. `again`: follows the run in tubes of at most such a
/// radius, as a part of the unit of length.
pub(super) fn in_narrower_tubes<W: ?Sized>(
    way: &mut W,
    run: &mut ArcRun,
    is_lost: impl Fn(&W, &ArcRun) -> bool,
    mut again: impl FnMut(&mut W, f64) -> ArcRun,
) {
    for radius in NARROWER {
        if !is_lost(way, run) {
            return;
        }
        let again = again(way, radius);
        run.steps += again.steps;
        let is_told = matches!(again.end, ArcEnd::Reached(_) | ArcEnd::Limit(_));
        if !is_told && !is_lost(way, &again) {
            return;
        }
        run.segments = again.segments;
    }
}

/// That a segment ends an edit, in words.
pub(super) fn stop(problem: &Problem, kept: &Kept) -> Stop {
    let object = &problem.objects[kept.object];
    let name = &object.name;
    if let Some(other) = kept.other {
        let words = format!(
            "there the edges {} come to touch (or so near to it that it cannot be told)",
            both(problem, other, kept.object)
        );
        return Stop::new(StopKind::Touches, words);
    }
    let words = match (&object.shape, kept.sign) {
        (Shape::Arc { .. }, ..=-1) => format!(
            "there the arc {name} grows to a whole circle (or so near to it that it cannot be told), and beyond it would begin anew"
        ),
        (Shape::Arc { .. }, _) => format!(
            "there the arc {name} shrinks to nothing (or so near to it that it cannot be told), and beyond it would come out turned \
             round, as the rest of its circle"
        ),
        _ => format!(
            "there the line {name} shrinks to nothing (or so near to it that it cannot be told), and beyond it would come out turned \
             round, its end before its start"
        ),
    };
    Stop::new(StopKind::Vanishes, words)
}

/// Of how many pairs of edges it is proved that they stay apart as far as a run goes, in words, and which are not looked at; nothing where that was
/// not asked for.
pub(super) fn apart_in_words(problem: &Problem, run: &ArcRun, others: &[String]) -> Option<String> {
    let pairs = run.segments.iter().filter(|kept| kept.other.is_some());
    let is_told = |kept: &&Kept| kept.sign != 0 && kept.lost.is_none();
    let (told, not): (Vec<&Kept>, Vec<&Kept>) = pairs.partition(is_told);
    let far = match run.end {
        ArcEnd::Reached(_) => "",
        _ => " up to there",
    };
    let not = not
        .iter()
        .filter_map(|kept| Some(both(problem, kept.other?, kept.object)));
    let not = match not.collect::<Vec<_>>() {
        names if names.is_empty() => String::new(),
        names => format!(", not of {}", list_of(&names, 3)),
    };
    let unseen = match others {
        [] => String::new(),
        others => format!("; not looked at: {}", list_of(others, 3)),
    };
    let count = told.len();
    (count > 0 || !not.is_empty()).then(|| {
        format!("edges of closed outlines stay apart{far}, proved of {count} pairs{not}{unseen}")
    })
}

/// What is kept apart in all that a session does, in words: so many pairs, and what is not.
pub(super) fn kept_apart_in_words(problem: &Problem, pairs: usize, others: &[String]) -> String {
    const DECLARED: &str = "edges are the lines, arcs and circles that a file declares (problem files: under [lines], as in `ab = [\"a\", \"b\"]`, \
                            [arcs] and [circles]), not distances or constraints between points";
    let edges = edges(problem).len();
    let not = match others {
        [] => String::new(),
        others => format!(
            " Not {}, which touch as they are drawn, or cannot be told from it.",
            list_of(others, 3)
        ),
    };
    match (pairs, edges) {
        (0, _) if problem.dimension != 2 => {
            "Nothing is kept apart: edges of closed outlines are those of sketches in the plane."
                .to_owned()
        }
        (0, 0) => format!("Nothing is kept apart: {DECLARED}, and here there are none."),
        (0, edges) => format!(
            "Nothing is kept apart: {DECLARED}; here there are {edges}, of which no two are of closed outlines and apart as they are drawn.{not}"
        ),
        (pairs, _) => format!(
            "Edges of closed outlines are kept apart: {pairs} pairs of lines, arcs and circles, not an arc and its neighbours.{not}"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interval::hull;

    #[test]
    fn an_arc_vanishes_at_0_and_360_degrees_and_not_at_180() {
        let extent = Extent::Sweep { points: [0, 1, 2] };
        let sign = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let around = |x: f64| hull(x - 1e-3, x + 1e-3);
            let at = |k| match k {
                0 => [point(0.0); 3],
                1 => [point(2.0), point(0.0), point(0.0)],
                _ => [around(3.0 * cos), around(3.0 * sin), point(0.0)],
            };
            extent.sign(at, sign_of)
        };
        for (degrees, wanted) in [
            (0.0, 0),
            (1.0, 1),
            (170.0, 1),
            (180.0, 1),
            (190.0, -1),
            (359.0, -1),
            (360.0, 0),
        ] {
            assert_eq!(sign(degrees), wanted, "{degrees}");
        }
    }
}
