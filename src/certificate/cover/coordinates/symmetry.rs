//! Changes of sign that take figures to congruent ones.

use super::format::{Change, Half};
use crate::certificate::checker::equations::Equations;
use crate::constraint::{Entry, Symmetry};
use crate::problem::{Item, Problem, Shape};

/// The unknowns that may be taken as not negative: each is changed by a symmetry that changes none before it, so that
/// of the images of a figure under these symmetries one has none of them negative.
pub fn not_negative(
    eq: &Equations,
    allowed: Symmetry,
    halves: &[Half],
) -> Result<Vec<usize>, String> {
    let mut done: Vec<usize> = Vec::new();
    for half in halves {
        let fits = changes(eq, allowed, &half.by).is_some_and(|changes| {
            changes.get(half.unknown) == Some(&true) && done.iter().all(|&i| !changes[i])
        });
        if !fits {
            return Err(format!(
                "unknown {} may be negative in figures that are like no other",
                half.unknown
            ));
        }
        done.push(half.unknown);
    }
    Ok(done)
}

/// For each unknown whether a change of signs changes it; `None` where it is no symmetry: it has to be one that the problem
/// has, to keep the equations, and to keep lengths and radii positive.
pub fn changes(eq: &Equations, allowed: Symmetry, by: &Change) -> Option<Vec<bool>> {
    let homotopy = &eq.homotopy;
    let is_allowed = match allowed {
        _ if by.axes.iter().any(|&axis| axis >= homotopy.dimension) => false,
        Symmetry::Isometries => true,
        Symmetry::Motions => by.axes.len().is_multiple_of(2),
        Symmetry::Identity => by.axes.is_empty(),
    };
    let first = homotopy.gauge.place.len();
    let mut twins = Vec::new();
    for &k in &by.twins {
        twins.push(homotopy.tail.twins.get(k)?);
    }
    if !is_allowed {
        return None;
    }
    let change = |i: usize| {
        let of_axes = by.axes.iter().filter(|&&axis| homotopy.flips(i, axis));
        let of_twins = twins.iter().filter(|twin| i >= first && twin[i - first]);
        (of_axes.count() + of_twins.count()) % 2 == 1
    };
    let changes: Vec<bool> = (0..eq.m).map(change).collect();
    let stay = eq.positive.iter().all(|&i| !changes[i]);
    (stay && keeps(eq, &changes)).then_some(changes)
}

/// Whether the equations hold with these signs changed wherever they hold without: each stays as it is, or changes its sign
/// and has 0 on the right.
fn keeps(eq: &Equations, changes: &[bool]) -> bool {
    // The numbers 0 and 1 stand behind the unknowns, and 0 has both signs.
    let sign = |[i, j]: [usize; 2]| match (changes.get(i), changes.get(j)) {
        (Some(a), Some(b)) => (a == b).then_some(*a),
        (Some(a), None) | (None, Some(a)) => Some(*a),
        (None, None) => Some(false),
    };
    let is_nothing = |form: usize| {
        let [i, j] = eq.forms[form];
        i == j
    };
    (0..eq.m).all(|e| {
        let products = eq.products[e].iter();
        let mut all = products.filter(|(_, [l, r])| !is_nothing(*l) && !is_nothing(*r));
        let both = |&(_, [l, r]): &(i64, [usize; 2])| Some(sign(eq.forms[l])? ^ sign(eq.forms[r])?);
        let Some(first) = all.next() else {
            return true;
        };
        let zero = eq.right_at(e, crate::interval::point(1.0))[0] == crate::interval::ZERO;
        match both(first) {
            None => false,
            Some(change) => all.all(|p| both(p) == Some(change)) && (!change || zero),
        }
    })
}

/// A line or plane of its own whose two directions constraints tell apart, by name: a path keeps one of them, and the
/// equations have both.
pub fn directed<'a>(eq: &Equations, problem: &'a Problem) -> Option<&'a str> {
    let homotopy = &eq.homotopy;
    let first = homotopy.gauge.place.len();
    let unknown = |entry: &Entry| match *entry {
        Entry::Unknown(u) => Some(first + u),
        _ => None,
    };
    // The unknowns of its direction.
    let own = |object: usize| -> Vec<usize> {
        let entries = &homotopy.tail.objects[object];
        let split = homotopy.shapes[object].split_direction(entries, homotopy.dimension);
        split.map_or(Vec::new(), |[_, turn]| {
            turn.iter().filter_map(unknown).collect()
        })
    };
    let objects = 0..homotopy.tail.objects.len();
    let objects: Vec<(usize, Vec<usize>)> = objects
        .map(|object| (object, own(object)))
        .filter(|(_, own)| !own.is_empty())
        .collect();
    let twins = homotopy.twins().unwrap_or_default();
    let turns_alone = |object: usize| {
        twins.iter().any(|twin| {
            let turned = objects
                .iter()
                .filter(|(_, own)| own.iter().any(|&i| twin[i]));
            turned.map(|(other, _)| other).eq([&object]) && keeps(eq, twin)
        })
    };
    let is_fixed = |object: usize| {
        problem.constraints.iter().any(|constraint| {
            constraint.kind == "fixed" && constraint.items.first() == Some(&Item::Object(object))
        })
    };
    let free = problem.objects.iter().enumerate().filter(|(_, object)| {
        matches!(
            object.shape,
            Shape::FreeLine { .. } | Shape::FreePlane { .. }
        )
    });
    let fixed = free.map(|(object, _)| object).find(|&o| is_fixed(o));
    let told_apart = objects.iter().map(|(object, _)| *object);
    let found = fixed.or_else(|| told_apart.clone().find(|&object| !turns_alone(object)));
    found.map(|object| problem.objects[object].name.as_str())
}
