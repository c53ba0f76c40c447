//! Covers of searches for all solutions: verified by the check, and damaged ones refused.

use crate::common::edits::Random;
use crate::common::random::{Dice, recipe, same_each_time};
use crate::common::shipped;
use krawl::certificate::cover::{Cover, CoverVerdict, Kind, Left, Mark, Radius, verify_cover};
use krawl::complete::{Complete, Options, Status, all};
use krawl::problem::{Problem, Target};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::{Config, TestRunner};

fn searched(problem: &Problem) -> (Complete, Vec<u8>) {
    let options = Options {
        cover: true,
        ..Options::default()
    };
    let mut result = all(problem, &options).unwrap();
    let cover = result.cover.take().unwrap();
    (result, cover)
}

/// A mark without ranges, in bytes.
fn bytes_of(mark: Mark) -> Vec<u8> {
    let mut bytes = Vec::new();
    mark.put(0, &mut bytes);
    bytes
}

/// The next mark of a cover without folds. (What ranges it leaves is not told: those before are taken to be from -1 to 1.)
fn read(cover: &Cover, at: usize) -> Option<(Mark, usize)> {
    Mark::read(&cover.marks, at, &vec![[-1.0, 1.0]; cover.drives.len()])
}

fn proves_all(verdict: &CoverVerdict) -> bool {
    verdict.flaw.is_none() && verdict.undecided == 0
}

#[test]
fn shipped_problems_verify() {
    for name in ["octahedron", "k33", "prism", "disulfide"] {
        let problem = shipped(name);
        let (result, bytes) = searched(&problem);
        let verdict = verify_cover(&bytes).unwrap();
        assert_eq!(verdict.flaw, None, "{name}");
        assert_eq!(verdict.undecided, 0);
        assert_eq!(verdict.solutions, Some(result.solutions.len() as u64));
        assert_eq!(verdict.problem.distances, problem.distances);
    }
}

/// Nearly degenerate figures, in which bounds are made of what is rounded: nothing that the search says is too fine for the check.
#[test]
fn covers_of_hard_problems_are_proved_as_far_as_they_go() {
    let mut problems: Vec<Problem> = std::fs::read_dir("problems/hard")
        .unwrap()
        .map(|file| file.unwrap().path())
        .filter(|path| path.extension().is_some_and(|end| end == "toml"))
        .map(|path| Problem::read(path).unwrap())
        .filter(Problem::is_distances_only)
        .collect();
    assert!(problems.len() > 10);
    let mut random = Random(3);
    for _ in 0..60 {
        // Two of four or five points are near each other; lengths are those of the sketch.
        let count = 4 + random.below(2);
        let mut points: Vec<[f64; 2]> = (0..count)
            .map(|_| [0; 2].map(|_| random.below(2000) as f64 / 1000.0))
            .collect();
        let near = 10f64.powi(-3 - random.below(5) as i32);
        points[1] = [points[0][0] + near, points[0][1] + 0.5 * near];
        let name = |p: usize| format!("p{p}");
        let mut build = Problem::build("near", 2);
        for (p, at) in points.iter().enumerate() {
            build = build.point(
                &name(p),
                at.map(|x| format!("{x:e}")).each_ref().map(String::as_str),
            );
        }
        for p in 1..count {
            for q in p.saturating_sub(2)..p {
                let length = (points[p][0] - points[q][0]).hypot(points[p][1] - points[q][1]);
                build = build.distance(&name(p), &name(q), &*format!("{length:e}"));
            }
        }
        problems.extend(build.finish());
    }
    let (mut proved, mut complete) = (0, 0);
    for problem in problems {
        let options = Options {
            cover: true,
            most_boxes: 3000,
            ..Options::default()
        };
        let Ok(result) = all(&problem, &options) else {
            continue;
        };
        let Some(cover) = result.cover else { continue };
        let verdict = verify_cover(&cover).unwrap();
        assert_eq!(verdict.flaw, None, "{}", problem.to_toml());
        assert_eq!(verdict.undecided == 0, result.status == Status::Complete);
        (proved, complete) = (proved + 1, complete + usize::from(verdict.undecided == 0));
    }
    assert!(proved > 40 && complete > 20, "{proved}, {complete}");
}

/// One side after the other of the points of a long strip: no more than a thread's stack holds.
#[test]
fn sides_within_sides_are_bounded() {
    let mut build = Problem::build("strip", 2);
    for p in 0..200 {
        build = build.point(
            &format!("p{p}"),
            [&*format!("{}", p / 2), &*format!("{}", p % 2)],
        );
    }
    for p in 1..200usize {
        for q in p.saturating_sub(2)..p {
            let is_diagonal = p - q == 1 && p % 2 == 0;
            let length = if is_diagonal { "1.4142" } else { "1" };
            build = build.distance(&format!("p{p}"), &format!("p{q}"), length);
        }
    }
    let problem = build.finish().unwrap();
    let steps = (2..200usize).map(|p| {
        let centres = [p - 2, p - 1].map(|q| (q, Radius::Given));
        (p, Kind::Meet(centres.to_vec()))
    });
    let mut cover = Cover {
        problem: problem.to_toml(),
        base: vec![0, 1],
        steps: steps.collect(),
        drives: Vec::new(),
        figures: Vec::new(),
        unit_exponent: 0,
        marks: Vec::new(),
    };
    for step in 1..198 {
        Mark::Sides(step).put(0, &mut cover.marks);
    }
    Mark::Excluded(197).put(0, &mut cover.marks);
    let flaw = damaged(&cover).unwrap().flaw.unwrap();
    assert!(flaw.contains("more sides"), "{flaw}");
}

#[test]
fn the_cover_is_the_same_for_any_number_of_threads() {
    let problem = shipped("disulfide");
    let with = |threads| {
        let options = Options {
            cover: true,
            threads,
            ..Options::default()
        };
        all(&problem, &options).unwrap().cover.unwrap()
    };
    assert!(with(1) == with(3));
}

#[test]
fn random_problems_verify() {
    for dimension in [2, 3] {
        let config = Config {
            cases: 25,
            max_global_rejects: 100_000,
            failure_persistence: None,
            ..Config::default()
        };
        let mut runner = TestRunner::new_with_rng(config, same_each_time());
        let result = runner.run(&recipe(dimension, 4..=7), |recipe| {
            let Ok(problem) = recipe.build() else {
                return Err(TestCaseError::reject("not a problem"));
            };
            let Ok(result) = all(
                &problem,
                &Options {
                    cover: true,
                    ..Options::default()
                },
            ) else {
                return Ok(());
            };
            let Some(bytes) = &result.cover else {
                return Ok(());
            };
            let verdict = verify_cover(bytes).unwrap();
            prop_assert_eq!(&verdict.flaw, &None, "{}", problem.to_toml());
            prop_assert_eq!(verdict.undecided == 0, result.status == Status::Complete);
            prop_assert_eq!(verdict.solutions, Some(result.solutions.len() as u64));
            Ok(())
        });
        if let Err(error) = result {
            panic!("{error}");
        }
    }
}

/// Where each mark begins, following them as a reader does.
fn marks(cover: &Cover) -> Vec<(usize, Mark)> {
    let mut out = Vec::new();
    let mut at = 0;
    // Only covers without folds are damaged mark by mark: then the number of symbols never changes.
    while at < cover.marks.len() {
        let (mark, next) = read(cover, at).unwrap();
        assert!(!matches!(mark, Mark::Fold(..)));
        out.push((at, mark));
        at = next;
    }
    out
}

fn damaged(cover: &Cover) -> Option<CoverVerdict> {
    verify_cover(&cover.to_bytes()).ok()
}

/// The cover of a problem with solutions whose search needs no fold.
fn without_folds() -> Cover {
    without_folds_and(6..=7, |_| true)
}

/// The same, and its marks are such.
fn without_folds_and(
    points: std::ops::RangeInclusive<usize>,
    wanted: impl Fn(&[Mark]) -> bool,
) -> Cover {
    let mut runner = TestRunner::new_with_rng(Config::default(), same_each_time());
    loop {
        let tree = recipe(2, points.clone()).new_tree(&mut runner).unwrap();
        let Ok(problem) = tree.current().build() else {
            continue;
        };
        let result = all(
            &problem,
            &Options {
                cover: true,
                ..Options::default()
            },
        )
        .unwrap();
        let Some(bytes) = result.cover else { continue };
        let cover = Cover::from_bytes(&bytes).unwrap();
        assert_eq!(Cover::from_bytes(&cover.to_bytes()).unwrap(), cover);
        let (mut at, mut seen, mut folded) = (0, Vec::new(), false);
        while !folded && at < cover.marks.len() {
            let (mark, next) = read(&cover, at).unwrap();
            folded = matches!(mark, Mark::Fold(..));
            seen.push(mark);
            at = next;
        }
        let large = cover.figures.len() > 1 && cover.drives.len() == 1 && seen.len() > 40;
        if !folded && large && wanted(&seen) {
            return cover;
        }
    }
}

#[test]
fn a_mark_left_out_or_turned_into_another_is_noticed() {
    let cover = without_folds();
    let all = marks(&cover);
    let ends: Vec<usize> = all
        .iter()
        .map(|m| m.0)
        .skip(1)
        .chain([cover.marks.len()])
        .collect();
    for ((at, mark), end) in all.iter().zip(&ends) {
        let mut less = cover.clone();
        less.marks.drain(*at..*end);
        // What a contraction leaves may be more than is needed: the proof without it is a proof still.
        let needed = !matches!(mark, Mark::Within(..));
        assert!(
            !needed || damaged(&less).is_none_or(|v| v.flaw.is_some()),
            "{mark:?} left out"
        );
        // A part with a figure in it is not excluded by any other reason.
        if *mark == Mark::Figure {
            for wrong in [
                Mark::Excluded(cover.steps.len() - 1),
                Mark::WrongDistance(cover.steps.len() - 1, 0),
                Mark::WrongPair(cover.steps.len() - 1, cover.base[0]),
            ] {
                let mut other = cover.clone();
                let mut bytes = Vec::new();
                wrong.put(cover.drives.len(), &mut bytes);
                other.marks.splice(*at..*end, bytes);
                assert!(
                    damaged(&other).is_none_or(|v| v.flaw.is_some()),
                    "{wrong:?}"
                );
            }
        }
        // And what is excluded holds no figure.
        if matches!(
            mark,
            Mark::NoPlace(_) | Mark::Excluded(_) | Mark::WrongDistance(..) | Mark::WrongPair(..)
        ) {
            let mut other = cover.clone();
            other.marks.splice(*at..*end, bytes_of(Mark::Figure));
            assert!(
                damaged(&other).is_none_or(|v| v.flaw.is_some()),
                "{mark:?} for a figure"
            );
            // Nothing claimed is no flaw, and no proof either.
            let mut open = cover.clone();
            open.marks.splice(*at..*end, bytes_of(Mark::Undecided));
            let verdict = damaged(&open).unwrap();
            assert!(verdict.flaw.is_none() && verdict.undecided == 1);
        }
    }
}

/// In place of each mark every so many-th other one is tried.
fn wrong_pairs_are_noticed(stride: usize) {
    let mut seen = 0;
    let is_pair = |mark: &Mark| matches!(mark, Mark::WrongPair(..));
    let with_pairs = without_folds_and(6..=8, |marks| marks.iter().any(is_pair));
    for cover in [without_folds(), with_pairs] {
        let (points, steps) = (cover.base.len() + cover.steps.len(), cover.steps.len());
        let all = marks(&cover);
        let ends = all.iter().map(|m| m.0).skip(1).chain([cover.marks.len()]);
        for (&(at, mark), end) in all.iter().zip(ends) {
            let mut others: Vec<Mark> = Vec::new();
            if mark == Mark::Figure {
                seen += 1;
                let pairs = |step| (0..points + 2).map(move |p| Mark::WrongPair(step, p));
                others.extend((0..steps).flat_map(pairs));
            }
            if let Mark::WrongPair(step, _) = mark {
                // A point from itself, from points that do not stand yet, and from none.
                let later = cover.steps[step..].iter().map(|s| s.0);
                others.extend(later.chain([points, 255]).map(|p| Mark::WrongPair(step, p)));
            }
            for other in others.into_iter().skip(at % stride).step_by(stride) {
                let mut bytes = Vec::new();
                other.put(cover.drives.len(), &mut bytes);
                let mut wrong = cover.clone();
                wrong.marks.splice(at..end, bytes);
                let verdict = damaged(&wrong);
                assert!(
                    verdict.is_none_or(|v| v.flaw.is_some()),
                    "{other:?} for {mark:?}"
                );
            }
        }
    }
    assert!(seen > 1, "{seen}");
}

#[test]
fn no_pair_of_points_is_called_wrong_where_a_figure_is() {
    wrong_pairs_are_noticed(3);
}

#[test]
#[ignore = "some seconds"]
fn no_pair_at_all_is_called_wrong_where_a_figure_is() {
    wrong_pairs_are_noticed(1);
}

#[test]
fn a_parameter_that_ranges_over_less_than_it_must_is_noticed() {
    let (_, bytes) = searched(&shipped("octahedron"));
    let mut cover = Cover::from_bytes(&bytes).unwrap();
    // The distance from the third point of the hinge drives its point, in place of the angle; nothing is decided.
    let hinge = cover.steps[0].clone();
    let (_, Kind::Hinge([c1, c2, q], 0)) = hinge else {
        panic!("{hinge:?}");
    };
    let radii = [
        (c1, Radius::Given),
        (c2, Radius::Given),
        (q, Radius::Parameter(0)),
    ];
    cover.steps[0].1 = Kind::Meet(radii.to_vec());
    cover.figures.clear();
    cover.marks = bytes_of(Mark::Undecided);
    let flaw = |range: [f64; 2]| {
        let mut other = cover.clone();
        other.drives[0] = Some(range);
        let verdict = damaged(&other).unwrap();
        assert_eq!(verdict.undecided, u64::from(verdict.flaw.is_none()));
        verdict.flaw
    };
    // The two faces at the hinge, laid flat, give the bounds.
    assert_eq!(flaw([0.0, 100.0]), None);
    let bound = |good: &dyn Fn(f64) -> bool, mut yes: f64, mut no: f64| {
        for _ in 0..50 {
            let middle = 0.5 * (yes + no);
            *(if good(middle) { &mut yes } else { &mut no }) = middle;
        }
        yes
    };
    let most = bound(&|x| flaw([0.0, x]).is_none(), 100.0, 0.0);
    let least = bound(&|x| flaw([x, 100.0]).is_none(), 0.0, 100.0);
    let problem = shipped("octahedron");
    let unit = 2f64.powi(cover.unit_exponent.into());
    let length = |a: usize, b: usize| {
        let is_it = |d: &&krawl::problem::Distance| d.points == [a, b] || d.points == [b, a];
        let found = problem.distances.iter().find(is_it).unwrap();
        match &found.target {
            Target::Length(x) => x.to_f64() / unit,
            Target::SquaredLength(x) => x.to_f64().sqrt() / unit,
        }
    };
    let bar = length(c1, c2);
    let flat = |p: usize| {
        let (r, s) = (length(c1, p), length(c2, p));
        let x = (r * r - s * s + bar * bar) / (2.0 * bar);
        (x, (r * r - x * x).sqrt())
    };
    let ((x, h), (y, k)) = (flat(hinge.0), flat(q));
    let near = (x - y).powi(2) + (h - k).powi(2);
    let far = (x - y).powi(2) + (h + k).powi(2);
    // Other triangles may bring the bounds nearer to each other, not farther apart.
    assert!(near - 1e-9 < least && least < most && most < far + 1e-9);
    assert!(flaw([most, least]).is_some());
}

#[test]
fn a_solution_left_out_added_or_moved_is_noticed() {
    let (_, bytes) = searched(&shipped("disulfide"));
    let cover = Cover::from_bytes(&bytes).unwrap();
    for index in 0..cover.figures.len() {
        let mut less = cover.clone();
        less.figures.remove(index);
        assert!(damaged(&less).unwrap().flaw.is_some(), "{index} left out");
        let mut twice = cover.clone();
        twice.figures.push(cover.figures[index].clone());
        assert!(damaged(&twice).unwrap().flaw.is_some(), "{index} twice");
        let mut image = cover.clone();
        let mut other = cover.figures[index].clone();
        other.iter_mut().for_each(|p| p[2] = -p[2]);
        image.figures.push(other);
        assert!(
            damaged(&image).unwrap().flaw.is_some(),
            "{index} and its image"
        );
        let mut moved = cover.clone();
        moved.figures[index][cover.steps[0].0][0] += 1e-3;
        assert!(damaged(&moved).unwrap().flaw.is_some(), "{index} moved");
    }
}

/// Two parts of which the same is said are one, of which that is said: what the check does not see at once it sees in halves.
#[test]
fn parts_that_are_too_large_to_be_proved_at_once_are_proved_in_halves() {
    /// Goes over one claim; how many parts it leaves.
    fn claim(all: &[(usize, Mark)], next: &mut usize) -> usize {
        let mark = all[*next].1;
        *next += 1;
        match mark {
            Mark::Sides(_) => claim(all, next) + claim(all, next),
            Mark::Halves(..) => 2,
            Mark::Within(..) => 1,
            _ => 0,
        }
    }
    fn part(all: &[(usize, Mark)], next: &mut usize, firsts: &mut Vec<usize>) {
        firsts.push(*next);
        (0..claim(all, next)).for_each(|_| part(all, next, firsts));
    }
    let cover = without_folds();
    let all = marks(&cover);
    let (mut next, mut firsts, mut joined) = (0, Vec::new(), 0);
    while next < all.len() {
        part(&all, &mut next, &mut firsts);
    }
    for first in firsts {
        let [(at, Mark::Halves(..)), (one, said), (two, also)] =
            all[first..(first + 3).min(all.len())]
        else {
            continue;
        };
        let is_end = matches!(
            said,
            Mark::NoPlace(_) | Mark::WrongDistance(..) | Mark::WrongPair(..) | Mark::Excluded(_)
        );
        if said != also || !is_end {
            continue;
        }
        let mut whole = cover.clone();
        whole.marks.drain(at..two);
        assert!(proves_all(&damaged(&whole).unwrap()), "{said:?} at {one}");
        joined += 1;
    }
    assert!(joined > 0);
}

/// Numbers and steps of any kind in marks whose order is right: no panic, and nothing that is proved of a problem with figures but without any listed.
#[test]
fn marks_at_random_prove_nothing() {
    const NUMBERS: [f64; 12] = [
        0.0,
        1.0,
        -1.0,
        0.5,
        -0.25,
        1e300,
        -1e300,
        f64::MAX,
        f64::MIN,
        5e-324,
        -5e-324,
        1e-170,
    ];
    fn claim(
        random: &mut Random,
        depth: usize,
        symbols: usize,
        marks: &mut Vec<u8>,
        children: &mut Vec<usize>,
    ) {
        let step = random.below(12);
        let mut range = || {
            let [a, b] = [0; 2].map(|_| NUMBERS[random.below(NUMBERS.len())]);
            [a.min(b), a.max(b)]
        };
        let (one, all) = (
            range(),
            std::array::from_fn(|_| Left::holding(range(), range())),
        );
        let kind = random.below(if depth == 0 { 5 } else { 10 });
        let (other, stands) = (random.below(14), random.below(2) == 1);
        match kind {
            0 => Mark::NoPlace(step).put(symbols, marks),
            1 => Mark::WrongDistance(step, other % 3).put(symbols, marks),
            2 => Mark::Excluded(step).put(symbols, marks),
            3 => Mark::Figure.put(symbols, marks),
            4 => Mark::WrongPair(step, other).put(symbols, marks),
            5 => {
                Mark::Sides(step % 4).put(symbols, marks);
                (0..2).for_each(|_| claim(random, depth - 1, symbols, marks, children));
            }
            6 => {
                Mark::Fold(step, one).put(symbols, marks);
                children.push(symbols + 1);
            }
            7 => {
                Mark::Within(step, all).put(symbols, marks);
                children.push(symbols);
            }
            _ => {
                Mark::Halves(step, stands, other % symbols.max(1)).put(symbols, marks);
                children.extend([symbols; 2]);
            }
        }
    }
    fn part(random: &mut Random, depth: usize, symbols: usize, marks: &mut Vec<u8>) {
        let mut children = Vec::new();
        claim(random, depth, symbols, marks, &mut children);
        for symbols in children {
            part(random, depth.saturating_sub(1), symbols.min(6), marks);
        }
    }
    let mut random = Random(11);
    for name in ["octahedron", "k33", "dodecagon"] {
        let (_, bytes) = searched(&shipped(name));
        let mut cover = Cover::from_bytes(&bytes).unwrap();
        cover.figures.clear();
        for _ in 0..2000 {
            cover.marks.clear();
            for _ in 0..4 {
                part(&mut random, 3, cover.drives.len(), &mut cover.marks);
            }
            assert!(damaged(&cover).unwrap().flaw.is_some(), "{:?}", cover.marks);
        }
    }
}

#[test]
fn a_unit_that_makes_lengths_huge_is_noticed() {
    let triangle = Problem::build("triangle", 2)
        .point("a", ["0", "0"])
        .point("b", ["1e40", "0"])
        .point("c", ["5e39", "8e39"])
        .distance("a", "b", "1e40")
        .distance("b", "c", "1e40")
        .distance("c", "a", "1e40")
        .finish()
        .unwrap();
    let (_, bytes) = searched(&triangle);
    let mut cover = Cover::from_bytes(&bytes).unwrap();
    assert!(proves_all(&damaged(&cover).unwrap()));
    // The third point turns about the first, and wherever it is, it is said to be farther away than any figure's.
    cover.unit_exponent = -220;
    cover.figures.clear();
    cover.drives = vec![None];
    let (centre, new) = (cover.base[0], 3 - cover.base[0] - cover.base[1]);
    cover.steps = vec![(new, Kind::Arm(centre, 0))];
    cover.marks.clear();
    fn halved(times: usize, centre: usize, marks: &mut Vec<u8>) {
        if times == 0 {
            return Mark::WrongPair(0, centre).put(1, marks);
        }
        Mark::Halves(0, false, 0).put(1, marks);
        (0..2).for_each(|_| halved(times - 1, centre, marks));
    }
    halved(8, centre, &mut cover.marks);
    let flaw = damaged(&cover).unwrap().flaw.unwrap();
    assert!(flaw.contains("unit"), "{flaw}");
    cover.unit_exponent = 132;
    assert!(damaged(&cover).unwrap().flaw.is_some());
}

#[test]
fn another_problem_or_plan_is_noticed() {
    // Nothing has these lengths, and something has others: the cover of the one is none of the other.
    let problem = |d: &str| {
        Problem::build("tetrahedron", 3)
            .point("a", ["0", "0", "0"])
            .point("b", ["1", "0", "0"])
            .point("c", ["0", "1", "0"])
            .point("d", ["0", "0", "1"])
            .distance("a", "b", "1")
            .distance("b", "c", "1")
            .distance("c", "a", "1")
            .distance("a", "d", d)
            .distance("b", "d", d)
            .distance("c", "d", d)
            .finish()
            .unwrap()
    };
    let (result, bytes) = searched(&problem("0.57"));
    assert_eq!(
        (result.status, result.solutions.len()),
        (Status::Complete, 0)
    );
    assert!(proves_all(&verify_cover(&bytes).unwrap()));
    let mut cover = Cover::from_bytes(&bytes).unwrap();
    cover.problem = problem("0.58").to_toml();
    assert!(damaged(&cover).unwrap().flaw.is_some());

    let (_, bytes) = searched(&shipped("k33"));
    let cover = Cover::from_bytes(&bytes).unwrap();
    let mut other = cover.clone();
    other.base.swap(0, 1);
    assert!(damaged(&other).unwrap().flaw.is_some());
    let mut other = cover.clone();
    other.steps.swap(0, 1);
    assert!(damaged(&other).is_none_or(|v| v.flaw.is_some()));
    let mut other = cover.clone();
    other.steps.pop();
    assert!(damaged(&other).unwrap().flaw.is_some());
    let mut other = cover;
    other.problem = other
        .problem
        .replacen("distances = [", "distances = [\n", 1);
    // Only the text differs: the same problem.
    assert!(proves_all(&damaged(&other).unwrap()));
}

#[test]
fn any_byte_may_be_wrong() {
    let (result, bytes) = searched(&shipped("octahedron"));
    let mut dice = Dice(7);
    for _ in 0..400 {
        let bits = dice.bits();
        let mut other = bytes.clone();
        let at = (bits >> 33) as usize % other.len();
        other[at] ^= 1 << ((bits >> 20) % 8);
        // It is refused, or harmless: never another number of solutions of the same problem.
        if let Ok(verdict) = verify_cover(&other)
            && proves_all(&verdict)
            && verdict.problem.distances == shipped("octahedron").distances
        {
            assert_eq!(verdict.solutions, Some(result.solutions.len() as u64));
        }
    }
}
