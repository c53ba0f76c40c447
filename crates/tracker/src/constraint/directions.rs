//! Which lines and planes constraints say to be parallel, by their words: a distance between two that are parallel anyway
//! must not say so a second time.
//!
//! Directions (of lines, and normals of planes) fall into classes that agree. `parallel` puts two lines or two planes into
//! one class, `perpendicular` a line and a plane, and so does a distance that implies it. Two classes may be at
//! a right angle, and in the plane all that are at a right angle to one class are one. What follows in other
//! ways, as from angles or coordinates, is not seen: then the equations are too many, and that is said.

use super::arguments::{Arguments, Flat, LineName, Thing};
use crate::places::Each as _;
use crate::sets::Joined;
use crate::statement::Problem;

/// The directions that constraints name.
pub struct Directions {
    flats: Vec<Flat>,
    /// Those that agree are one class.
    class: Joined,
    /// Classes at a right angle, by one of each.
    right: Vec<[usize; 2]>,
    in_plane: bool,
}

impl Directions {
    /// What all constraints say, of distances between lines and planes only those before this one, by index.
    pub fn before(problem: &Problem, index: usize) -> Self {
        let mut out = Directions {
            flats: Vec::new(),
            class: Joined::default(),
            right: Vec::new(),
            in_plane: problem.dimension == 2,
        };
        if out.in_plane {
            let [x, y] = [0, 1].each(|axis| Flat::Line(LineName::Axis(axis)));
            out.say(x, y, true);
        }
        for (other, constraint) in problem.constraints.iter().enumerate() {
            let items = Arguments::new(problem, &constraint.items);
            out.take(problem, &constraint.kind, items, other < index);
        }
        out
    }

    fn take(&mut self, problem: &Problem, kind: &str, mut items: Arguments, is_before: bool) {
        match kind {
            "horizontal" | "vertical" => {
                if let Ok(line) = items.line() {
                    let axis = Flat::Line(LineName::Axis(usize::from(kind == "vertical")));
                    self.say(Flat::Line(line), axis, false);
                }
            }
            "parallel" | "perpendicular" => {
                if let (Ok(a), Ok(b)) = (items.flat(), items.flat()) {
                    let mixed = matches!(a, Flat::Line(_)) != matches!(b, Flat::Line(_));
                    self.say(a, b, (kind == "perpendicular") != mixed);
                }
            }
            "distances" if is_before => {
                let Ok([Thing::Flat(a), Thing::Flat(b)]) = items.two_things() else {
                    return;
                };
                let is_line = |flat| matches!(flat, Flat::Line(_));
                // Two lines in space are not parallel because of it.
                if problem.dimension == 2 || !(is_line(a) && is_line(b)) {
                    self.say(a, b, is_line(a) != is_line(b));
                }
            }
            _ => {}
        }
    }

    fn number(&mut self, flat: Flat) -> usize {
        if let Some(known) = self.flats.iter().position(|other| other.is(flat)) {
            return known;
        }
        self.flats.push(flat);
        self.class.add()
    }

    /// Two directions agree, or with `right` are at a right angle.
    fn say(&mut self, a: Flat, b: Flat, right: bool) {
        let (a, b) = (self.number(a), self.number(b));
        match right {
            true => self.right.push([a, b]),
            false => _ = self.class.join([a, b]),
        }
        // In the plane, whatever is at a right angle to one class agrees.
        while let Some(pair) = self.next_to_join() {
            self.class.join(pair);
        }
    }

    fn next_to_join(&self) -> Option<[usize; 2]> {
        if !self.in_plane {
            return None;
        }
        let both = |&[a, b]: &[usize; 2]| [[a, b], [b, a]];
        let all: Vec<[usize; 2]> = self.right.iter().flat_map(both).collect();
        let mut pairs = all.iter().flat_map(|one| all.iter().map(move |b| (one, b)));
        pairs.find_map(|([a, u], [b, v])| {
            let agree = self.class.of(*a) == self.class.of(*b);
            (agree && self.class.of(*u) != self.class.of(*v)).then_some([*u, *v])
        })
    }

    /// Whether two lines, two planes, or a line and a plane are said to be parallel.
    pub fn are_parallel(&mut self, a: Flat, b: Flat) -> bool {
        let mixed = matches!(a, Flat::Line(_)) != matches!(b, Flat::Line(_));
        let classes = [a, b].each(|flat| {
            let number = self.number(flat);
            self.class.of(number)
        });
        if !mixed {
            return classes[0] == classes[1];
        }
        self.right.iter().any(|pair| {
            let pair = pair.each(|flat| self.class.of(flat));
            pair == classes || pair == [classes[1], classes[0]]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a distance at the end of these constraints finds its lines or planes parallel.
    fn are_parallel(dimension: usize, constraints: &str, last: &str) -> bool {
        let z = |x| if dimension == 3 { x } else { "" };
        let text = format!(
            "name = \"d\"\ndimension = {dimension}\n[points]\na = [0, 0{0}]\nb = [4, 1{0}]\nc = [5, 3{0}]\nd = [1, 5{1}]\n\
             e = [2, 9{1}]\nf = [7, 6{1}]\n[lines]\ng = [\"a\", \"b\"]\nh = [\"c\", \"d\"]\nk = [\"e\", \"f\"]\n{2}[constraints]\n\
             {constraints}\ndistances = {last}\n",
            z(", 0.5"),
            z(", 3.1"),
            z("[planes]\np = [\"a\", \"b\", \"c\"]\nq = [\"d\", \"e\", \"f\"]\n"),
        );
        let problem = Problem::parse_loosely(&text, "d.toml").unwrap();
        let mut kinds = problem.constraints.iter().map(|c| c.kind == "distances");
        let index = kinds.rposition(|is_it| is_it).unwrap();
        let mut directions = Directions::before(&problem, index);
        let mut items = Arguments::new(&problem, &problem.constraints[index].items);
        let [Thing::Flat(a), Thing::Flat(b)] = items.two_things().unwrap() else {
            panic!("two lines or planes are wanted");
        };
        directions.are_parallel(a, b)
    }

    #[test]
    fn in_the_plane() {
        let gh = "[[\"g\", \"h\", 2]]";
        for (constraints, expected) in [
            ("", false),
            ("horizontal = [\"g\"]", false),
            ("horizontal = [\"g\", \"h\"]", true),
            ("horizontal = [\"g\"]\nvertical = [\"h\"]", false),
            ("parallel = [[\"b\", \"a\", \"h\"]]", true),
            ("parallel = [[\"g\", \"k\"], [\"k\", \"h\"]]", true),
            ("perpendicular = [[\"g\", \"k\"], [\"k\", \"h\"]]", true),
            (
                "perpendicular = [[\"g\", \"k\"]]\nparallel = [[\"k\", \"h\"]]",
                false,
            ),
            (
                "horizontal = [\"g\"]\nperpendicular = [[\"h\", \"y-axis\"]]",
                true,
            ),
        ] {
            assert_eq!(are_parallel(2, constraints, gh), expected, "{constraints}");
        }
        let ring = "[[\"g\", \"h\", 2], [\"h\", \"k\", 2], [\"k\", \"g\", 4]]";
        assert!(are_parallel(2, "", ring));
        assert!(!are_parallel(
            2,
            "",
            "[[\"g\", \"h\", 2], [\"h\", \"k\", 2]]"
        ));
    }

    #[test]
    fn in_space() {
        let (gh, hp, pq) = (
            "[[\"g\", \"h\", 2]]",
            "[[\"h\", \"p\", 2]]",
            "[[\"p\", \"q\", 2]]",
        );
        for (constraints, last, expected) in [
            ("parallel = [[\"g\", \"h\"]]", gh, true),
            (
                "perpendicular = [[\"g\", \"k\"], [\"k\", \"h\"]]",
                gh,
                false,
            ),
            ("perpendicular = [[\"g\", \"q\"], [\"h\", \"q\"]]", gh, true),
            ("perpendicular = [[\"g\", \"p\"], [\"g\", \"q\"]]", pq, true),
            ("parallel = [[\"p\", \"q\"]]", pq, true),
            ("", pq, false),
            ("parallel = [[\"h\", \"p\"]]", hp, true),
            ("parallel = [[\"h\", \"q\"], [\"q\", \"p\"]]", hp, true),
            ("perpendicular = [[\"h\", \"k\"], [\"k\", \"p\"]]", hp, true),
            ("perpendicular = [[\"h\", \"p\"]]", hp, false),
        ] {
            assert_eq!(
                are_parallel(3, constraints, last),
                expected,
                "{constraints}"
            );
        }
        // The first makes planes parallel, two lines' does not make those so.
        assert!(are_parallel(
            3,
            "",
            "[[\"p\", \"q\", 2], [\"q\", \"p\", 3]]"
        ));
        assert!(!are_parallel(
            3,
            "",
            "[[\"g\", \"h\", 2], [\"h\", \"g\", 3]]"
        ));
    }
}
