//! Covers of the space of coordinates: of problems with other constraints than distances, verified by the check, and
//! damaged ones refused.

use crate::common::edits::Random;
use crate::common::mixed::Spec;
use crate::common::sketches::{ARC, LEG, PLATE, apollonius_text, isosceles_text};
use crate::common::wanted;
use krawl::certificate::cover::coordinates::{
    Block, Case, Change, CoordinateCover, Half, Image, Mark,
};
use krawl::certificate::cover::{CoverVerdict, verify_cover};
use krawl::complete::{Options, Status, Unserved, Why, all};
use krawl::problem::Problem;

fn parse(text: &str) -> Problem {
    Problem::parse(text, "test.toml").unwrap()
}

fn check(cover: &CoordinateCover) -> CoverVerdict {
    verify_cover(&cover.to_bytes()).unwrap()
}

/// The cover of a set that has to be complete, and proved by it.
fn proved(problem: &Problem) -> CoordinateCover {
    crate::common::covers::proved(problem).1
}

/// c on a ray from a, at a distance from b: two figures.
fn triangle() -> Problem {
    parse(
        r#"
        name = "triangle"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0]
        c = [3, 2]
        [constraints]
        distances = [["a", "b", 4], ["b", "c", 2.5]]
        angles = [["b", "a", "c", 30]]
        "#,
    )
}

/// A right angle at c, of which a leg vanishes where c is at a: that is a zero of the equations, and no figure.
fn leg() -> Problem {
    parse(LEG)
}

/// Three bars in a line, and equal gaps: equations that are one of two linear ones.
fn gaps() -> Problem {
    parse(
        r#"
        name = "gaps"
        dimension = 2
        [points]
        o = [0, 0]
        e = [9, 0]
        a = [2, 0]
        b = [3.5, 0]
        c = [6, 0]
        [constraints]
        fixed = ["o", "e"]
        horizontal = [["o", "a"], ["o", "b"], ["o", "c"]]
        distances = [["a", "b", 1.5], ["b", "c", 2.6]]
        equal = [["o", "a", "c", "e"]]
        "#,
    )
}

/// Marks that narrow a part and say nothing else are refused where they do not: a check takes no longer for them.
#[test]
fn marks_that_change_nothing_are_refused_at_once() {
    let cover = proved(&triangle());
    assert!(!cover.blocks.is_empty());
    for idle in [Mark::Block(0), Mark::Bound(0), Mark::Reduced(0)] {
        let mut hostile = cover.clone();
        hostile.marks.clear();
        (0..100_000).for_each(|_| idle.put(&mut hostile.marks));
        hostile.marks.extend(&cover.marks);
        let clock = std::time::Instant::now();
        let flaw = check(&hostile).flaw.unwrap();
        assert!(flaw.contains("changes nothing"), "{idle:?}: {flaw}");
        assert!(clock.elapsed().as_secs() < 5, "{:?}", clock.elapsed());
    }
}

#[test]
fn the_pentahedron_is_proved() {
    let pentahedron = Problem::read("problems/constraints/pentahedron.toml").unwrap();
    assert_eq!(proved(&pentahedron).figures.len(), 9);
    // Here a symmetry reverses coordinates that are 0 in all figures, so that some of them are met twice.
    let undefined = Problem::read("problems/constraints/6p7d3a2c-undefined.toml").unwrap();
    let cover = proved(&undefined);
    assert_eq!(cover.figures.len(), 4);
    assert!(!cover.images.is_empty());
}

/// Cones without a bound of their own: a circle that touches three.
#[test]
fn a_circle_that_touches_three_is_proved() {
    let cover = proved(&parse(&apollonius_text("[3, 2.2]", "2.3")));
    assert_eq!(cover.figures.len(), 1);
    assert!(
        marks(&cover)
            .iter()
            .any(|(_, mark)| matches!(mark, Mark::Bound(_)))
    );
}

#[test]
fn equations_divided_by_a_length_are_proved() {
    for sides in [
        r#"distances = [["a", "c", 5.3], ["b", "c", 5.3]]"#,
        r#"distances = [["a", "c", 5.3]]
           equal = [["c", "b", "a", "c"]]"#,
    ] {
        let cover = proved(&parse(&isosceles_text(sides, 40.0)));
        assert_eq!((cover.figures.len(), cover.others.len()), (1, 0));
    }
    // A cover of sides that are equal says nothing of sides that are nearly so.
    let sides = r#"distances = [["a", "c", 5.3], ["b", "c", 5.3]]"#;
    let mut cover = proved(&parse(&isosceles_text(sides, 40.0)));
    cover.problem = cover.problem.replacen("5.3]", "5.2999999]", 1);
    assert!(verify_cover(&cover.to_bytes()).is_ok_and(|verdict| verdict.flaw.is_some()));
}

#[test]
fn arcs_between_lines_are_proved() {
    assert_eq!(proved(&parse(ARC)).figures.len(), 4);
    assert_eq!(count(&proved(&parse(PLATE))), Some(1 << 10));
}

#[test]
fn figures_and_zeros_that_are_none_are_told_apart() {
    let cover = proved(&triangle());
    assert_eq!((cover.figures.len(), cover.others.len()), (2, 0));
    let cover = proved(&leg());
    // In one zero a leg has no length.
    assert!(!cover.others.is_empty());
}

/// Where each mark begins.
fn marks(cover: &CoordinateCover) -> Vec<(usize, Mark)> {
    let mut out = Vec::new();
    let mut at = 0;
    while at < cover.marks.len() {
        let (mark, next) = Mark::read(&cover.marks, at).unwrap();
        out.push((at, mark));
        at = next;
    }
    out
}

fn with_marks(cover: &CoordinateCover, all: impl Iterator<Item = Mark>) -> CoordinateCover {
    let mut cover = cover.clone();
    cover.marks.clear();
    all.for_each(|mark| mark.put(&mut cover.marks));
    cover
}

/// How many figures a cover lists, with all combinations of those of parts.
fn count(cover: &CoordinateCover) -> Option<u64> {
    let of_case = |case: &Case| -> u64 {
        let parts = case.parts.iter();
        parts.map(|part| part.figures.len() as u64 + 1).product()
    };
    match cover.cases.is_empty() {
        true => Some(cover.figures.len() as u64),
        false => Some(cover.cases.iter().map(of_case).sum()),
    }
}

/// What a damaged cover may still prove: the truth, or less.
fn is_harmless(damaged: &CoordinateCover, truth: &CoordinateCover) -> bool {
    let Ok(verdict) = verify_cover(&damaged.to_bytes()) else {
        return true;
    };
    !verdict.proves_all() || verdict.solutions == count(truth)
}

#[test]
fn no_mark_can_hide_a_solution() {
    for problem in [triangle(), leg(), gaps()] {
        let cover = proved(&problem);
        let all: Vec<Mark> = marks(&cover).into_iter().map(|(_, mark)| mark).collect();
        let (mut refused, mut tried) = (0, 0);
        let others = [
            Mark::Block(0),
            Mark::Halves(0),
            Mark::Figure(0),
            Mark::Figure(1),
            Mark::Other(0),
            Mark::Image(0),
            Mark::Bound(0),
            Mark::Reduced(0),
            Mark::Sides(0),
            Mark::Sides(1),
            Mark::Undecided,
        ];
        for k in 0..all.len() {
            let kept = all[..k].iter().chain(&all[k + 1..]).copied();
            let mut damaged = vec![with_marks(&cover, kept)];
            for other in others.into_iter().filter(|&other| other != all[k]) {
                let changed = (0..all.len()).map(|i| if i == k { other } else { all[i] });
                damaged.push(with_marks(&cover, changed));
            }
            for damaged in damaged {
                tried += 1;
                assert!(is_harmless(&damaged, &cover));
                refused += usize::from(!check(&damaged).proves_all());
            }
        }
        assert!(2 * refused > tried, "{refused} of {tried}");
        // A solution is left out, with all marks that name it.
        for gone in 0..cover.figures.len() {
            let mut damaged = cover.clone();
            damaged.figures.remove(gone);
            let kept = all.iter().filter(|&&mark| mark != Mark::Figure(gone));
            let kept = kept.map(|&mark| match mark {
                Mark::Figure(k) if k > gone => Mark::Figure(k - 1),
                mark => mark,
            });
            assert!(!check(&with_marks(&damaged, kept)).proves_all());
        }
    }
}

#[test]
fn solutions_that_are_none_or_twice_there_are_noticed() {
    let cover = proved(&triangle());
    for k in 0..cover.figures[0].len() {
        let mut moved = cover.clone();
        moved.figures[0][k] += 0.1;
        assert!(is_harmless(&moved, &cover));
    }
    let mut twice = cover.clone();
    twice.figures.push(cover.figures[0].clone());
    assert!(check(&twice).flaw.is_some());
    // The mirror image is the same figure.
    let mut mirrored = cover.clone();
    mirrored
        .figures
        .push(cover.figures[0].iter().map(|x| -x).collect());
    assert!(check(&mirrored).flaw.is_some());
    // A solution is no zero that is none.
    let mut other = cover.clone();
    other.others.push(cover.figures[0].clone());
    assert!(check(&other).flaw.is_some());
    // Nor the other way round.
    let cover = proved(&leg());
    let mut figure = cover.clone();
    figure.figures.push(cover.others[0].clone());
    assert!(check(&figure).flaw.is_some());
    let mut empty = cover.clone();
    empty.blocks.push(Block {
        equations: Vec::new(),
        unknowns: Vec::new(),
    });
    assert!(check(&empty).flaw.is_some());
    let mut short = cover.clone();
    short.figures[0].pop();
    assert!(check(&short).flaw.is_some());
}

#[test]
fn symmetries_that_are_none_are_refused() {
    for problem in [triangle(), leg()] {
        let cover = proved(&problem);
        let unknowns = cover.figures[0].len();
        for unknown in 0..=unknowns {
            for axes in [vec![], vec![0], vec![1], vec![2], vec![0, 1]] {
                for twins in [vec![], vec![0], vec![7]] {
                    let by = Change {
                        axes: axes.clone(),
                        twins,
                    };
                    let mut more = cover.clone();
                    more.halves.push(Half {
                        unknown,
                        by: by.clone(),
                    });
                    assert!(is_harmless(&more, &cover));
                    let mut seen = cover.clone();
                    seen.images.push(Image { figure: 0, by });
                    assert!(is_harmless(&seen, &cover));
                    seen.images.push(Image {
                        figure: usize::MAX,
                        by: Change::default(),
                    });
                    assert!(check(&seen).flaw.is_some());
                }
            }
        }
        // Half of the space is left out, and nothing says that it may be: all unknowns but those halved have
        // solutions on both sides, or on one that is not proved to be the only one.
        let mut wrong = cover.clone();
        wrong.halves.push(Half {
            unknown: 0,
            by: Change::default(),
        });
        assert!(check(&wrong).flaw.is_some());
    }
}

#[test]
fn another_problem_is_noticed() {
    let cover = proved(&triangle());
    let verdict = check(&cover);
    // One figure, not two. (A cover may prove another problem whose figures are as many and near these: what it then says is true.)
    let text = cover.problem.replace("2.5", "5");
    assert_ne!(text, cover.problem);
    let mut other = cover.clone();
    other.problem = text.clone();
    assert!(!check(&other).proves_all());
    assert!(verdict.is_about(&triangle()));
    assert!(!verdict.is_about(&parse(&text)));
    let angle = parse(&cover.problem.replace("30", "31"));
    assert!(!verdict.is_about(&angle));
}

/// A fixed line with a direction of its own has the sign that the sketch has; a line that something is on one side of has both.
#[test]
fn directions_have_the_signs_that_figures_have() {
    let fixed = |direction: &str, held: &str, more: &str| {
        parse(&format!(
            r#"
        name = "fixed"
        dimension = 2
        [points]
        p = [1, 2]
        q = [3, 1]
        [lines]
        l = {{ point = [0, 0], direction = {direction} }}
        [constraints]
        fixed = [{held}]
        {more}
        distances = [["p", "l", 1], ["p", "q", 2]]
        "#
        ))
    };
    let problem = fixed("[1, 0.5]", r#""l", "q""#, "");
    let cover = proved(&problem);
    assert_eq!(cover.figures.len(), 2);
    // The same line the other way is not where the cover looked.
    let mut turned = cover.clone();
    turned.problem = fixed("[-1, -0.5]", r#""l", "q""#, "").to_toml();
    assert!(check(&turned).flaw.is_some());
    let mut fewer = cover.clone();
    fewer.figures.pop();
    assert!(check(&fewer).flaw.is_some());
    // Level through q, with p above and below, and each of these left and right of q.
    let level = fixed(
        "[1, 0]",
        r#""q""#,
        "horizontal = [\"l\"]\non = [[\"q\", \"l\"]]",
    );
    let cover = proved(&level);
    assert_eq!(cover.figures.len(), 4);
    let mut fewer = cover.clone();
    fewer.figures.pop();
    assert!(check(&fewer).flaw.is_some());
}

#[test]
fn any_byte_may_be_wrong() {
    for problem in [triangle(), leg()] {
        let cover = proved(&problem);
        let bytes = cover.to_bytes();
        for at in 0..bytes.len() {
            for bit in [0, 3, 6] {
                let mut damaged = bytes.clone();
                damaged[at] ^= 1 << bit;
                // No panic, and nothing proved of the problem but the truth.
                let Ok(verdict) = verify_cover(&damaged) else {
                    continue;
                };
                let same = verdict.is_about(&problem) && verdict.proves_all();
                assert!(!same || verdict.solutions == count(&cover), "{at}");
            }
        }
    }
}

/// a and b are 2 apart on a line of its own, and c, on the line through a and b, is beside it: where c is far away the search leaves parts
/// open, and the check none.
const BESIDE: &str = r#"name = "beside"
dimension = 2
[points]
a = [0.0, 0.0]
b = [0.5, 1.9]
c = [-0.5, 2.0]
[lines]
f = { point = [0.1, 0.0], direction = [0.2, 1.0] }
ac = ["a", "c"]
[constraints]
distances = [["a", "b", 2], ["c", "f", 1.5]]
on = [["b", "ac"], ["a", "f"], ["b", "f"]]
"#;

#[test]
fn a_cover_settles_what_the_search_left_open() {
    let problem = Problem::parse(BESIDE, "beside").unwrap();
    let options = Options {
        cover: true,
        ..Options::default()
    };
    let before = all(&problem, &options).unwrap();
    assert_eq!((before.status, before.count), (Status::Partial, Some(0)));
    let verdict = verify_cover(before.cover.as_ref().unwrap()).unwrap();
    // Nothing is settled by the cover of another set, or by one that is not proved or leaves something.
    let others = [
        CoverVerdict {
            solutions: Some(1),
            ..verdict.clone()
        },
        CoverVerdict {
            solutions: None,
            ..verdict.clone()
        },
        CoverVerdict {
            undecided: 1,
            ..verdict.clone()
        },
        CoverVerdict {
            flaw: Some("some".to_owned()),
            ..verdict.clone()
        },
    ];
    for other in &others {
        let mut result = before.clone();
        assert!(!result.settle(other) && result.status == Status::Partial);
        assert_eq!(result.undecided, before.undecided);
    }
    let mut result = before.clone();
    assert!(result.settle(&verdict) && !result.settle(&verdict));
    assert_eq!((result.status, result.count), (Status::Complete, Some(0)));
    assert!(result.undecided.is_empty());

    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("beside.toml"), BESIDE).unwrap();
    let run = |more: &[&str], code: i32| {
        let mut krawl = assert_cmd::Command::cargo_bin("krawl").unwrap();
        krawl.current_dir(folder.path());
        let arguments = ["all", "beside.toml", "--cert", "C", "--json", "J"];
        let assert = krawl.args(arguments).args(more).assert().code(code);
        let told = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        (
            told,
            std::fs::read_to_string(folder.path().join("J")).unwrap(),
        )
    };
    let (told, json) = run(&[], 0);
    assert!(
        told.starts_with("beside: Complete")
            && told.contains("The check of the certificate in C decided"),
        "{told}"
    );
    assert!(json.contains("\"status\":\"complete\""), "{json}");
    let (told, json) = run(&["--no-verify"], 1);
    assert!(
        told.starts_with("beside: Partial") && !told.contains("certificate"),
        "{told}"
    );
    assert!(json.contains("\"status\":\"partial\""), "{json}");
}

/// For people: what the command says, and the check.
#[test]
fn the_commands_write_and_check_covers() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("triangle.toml"), triangle().to_toml()).unwrap();
    let krawl = || {
        let mut krawl = assert_cmd::Command::cargo_bin("krawl").unwrap();
        krawl.current_dir(folder.path());
        krawl
    };
    let all = ["all", "triangle.toml", "--quiet", "--cert", "all.cover"];
    krawl().args(all).assert().success();
    let verify = ["verify", "all.cover", "triangle.toml"];
    let assert = krawl().args(verify).assert().success();
    let told = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(
        told.starts_with("VERIFIED: triangle has exactly 2 solutions"),
        "{told}"
    );
    // What is written is checked, if nobody says otherwise.
    let said = |more: &[&str]| {
        let all = ["all", "triangle.toml", "--cert", "all.cover"];
        let assert = krawl().args(all).args(more).assert().success();
        String::from_utf8(assert.get_output().stdout.clone()).unwrap()
    };
    let checked = "The certificate in all.cover was checked";
    assert!(said(&[]).contains(checked) && !said(&["--no-verify"]).contains(checked));
    let alone = ["all", "triangle.toml", "--no-verify"];
    krawl().args(alone).assert().code(2);
    // A problem that has one constraint more is another one, and may have no figure.
    let more = triangle()
        .to_toml()
        .replace("angles = [", "x = [[\"a\", 0], [\"b\", 7]]\nangles = [");
    std::fs::write(at("more.toml"), more).unwrap();
    let more = ["verify", "all.cover", "more.toml"];
    krawl().args(more).assert().code(2);
    // The last mark is another one.
    let mut bytes = std::fs::read(at("all.cover")).unwrap();
    let cover = CoordinateCover::from_bytes(&bytes).unwrap();
    let last = marks(&cover).last().unwrap().0;
    let end = bytes.len() - cover.marks.len();
    bytes[end + last + 1] ^= 1;
    std::fs::write(at("damaged.cover"), bytes).unwrap();
    let assert = krawl().args(["verify", "damaged.cover"]).assert().code(3);
    let told = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
    assert!(told.starts_with("NOT PROVED: triangle"), "{told}");
}

/// Random problems: how many complete sets came with a cover, and of how many of these it proves that. (Where a length is
/// longer than others allow nothing is searched, and there is no cover.)
fn mixed(dimension: usize, tries: usize, seed: u64, most_boxes: u64) -> [usize; 2] {
    let mut random = Random(seed);
    let (mut complete, mut verified) = (0, 0);
    for number in 0..tries {
        let Some((_, problem)) = Spec::random(dimension, &mut |n| random.below(n)) else {
            continue;
        };
        let options = Options {
            most_boxes,
            cover: true,
            ..Options::default()
        };
        let result = match all(&problem, &options) {
            Err(Unserved::Refused(_)) => continue,
            result => result.unwrap(),
        };
        let Some(bytes) = &result.cover else {
            continue;
        };
        complete += usize::from(result.status == Status::Complete);
        let verdict = verify_cover(bytes).unwrap();
        assert_eq!(verdict.flaw, None, "{number}\n{}", problem.to_toml());
        assert_eq!(verdict.solutions, Some(result.solutions.len() as u64));
        if verdict.undecided == 0 {
            // The space is parted anew for a cover, which may prove what a search left open that was ended, or could not bound.
            let mut open = result.undecided.iter().map(|part| part.why);
            let is_left = open.all(|why| matches!(why, Why::Unfinished | Why::Unbounded));
            assert!(is_left, "{number}: {:?}", result.undecided);
            verified += usize::from(result.status == Status::Complete);
        }
    }
    [complete, verified]
}

/// Covers of random problems are proved again; at least `some` of so many are complete.
fn verify_some(dimension: usize, (tries, some): (usize, usize), seed: u64) {
    let [complete, verified] = mixed(dimension, tries, seed, 3000);
    println!("{verified} of {complete}");
    assert!(verified >= some && 20 * verified >= 19 * complete);
}

#[test]
fn random_problems_in_the_plane_verify() {
    verify_some(2, (60, 6), 17);
}

#[test]
fn random_problems_in_space_verify() {
    verify_some(3, (5, 1), 5);
}

#[test]
fn more_random_problems_in_space_verify() {
    verify_some(3, (10, 3), 6);
}

#[test]
#[ignore = "minutes: KRAWL_COUNT problems (1000), those of KRAWL_SEED"]
fn many_random_problems_verify() {
    let [complete, verified] = mixed(
        wanted("KRAWL_DIMENSION", 2),
        wanted("KRAWL_COUNT", 1000),
        wanted("KRAWL_SEED", 1),
        20_000,
    );
    println!("{verified} of {complete}");
    assert!(20 * verified >= 19 * complete);
}

/// A cover of solutions in a range says the range, and proves nothing of a wider one.
#[test]
fn a_cover_of_a_range_is_one_of_no_other() {
    let curves = |x: &str| {
        parse(&format!(
            "equations = [\"x^2 + y^2 = 4\", \"x*y = 1\"]\n[unknowns]\nx = {x}\ny = 0.5\n"
        ))
    };
    let problem = curves("[-1, 2]");
    let mut cover = proved(&problem);
    let verdict = check(&cover);
    assert_eq!(verdict.solutions, Some(3));
    assert!(verdict.proves_all() && verdict.is_about(&problem));
    assert!(!verdict.is_about(&curves("[-3, 2]")) && !verdict.is_about(&curves("1.2")));
    for wider in ["within = [-3.0", "within = [-inf"] {
        assert!(cover.problem.contains("within = [-1.0"));
        let other = cover.problem.replace("within = [-1.0", wider);
        let before = std::mem::replace(&mut cover.problem, other);
        assert!(!check(&cover).proves_all(), "{wider}");
        cover.problem = before;
    }
    // Solutions that are out of a narrower one are none.
    cover.problem = cover.problem.replace("within = [-1.0", "within = [0.0");
    assert!(!check(&cover).proves_all());
}
