//! Certificates of edits, of sweeps and of open paths: verified as they are written, refused where they are damaged.

use crate::common::QUADRANGLE;
use crate::common::certificate::Certificate;
use crate::common::edits::{Random, case};
use krawl::certificate::{Flaw, Outcome, Record, Settings, Verdict, Writer, verify};
use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::{Control, Options, Status, Witness};

fn check(bytes: &[u8]) -> Verdict {
    verify(bytes, &Settings::default(), &mut |_| ()).unwrap()
}

/// What a session does, with the certificate that it leaves.
fn certified<T>(
    problem: &Problem,
    work: impl FnOnce(&mut Session, &mut Control) -> T,
) -> (T, Vec<u8>) {
    let mut writer = Writer::new(Vec::new(), problem);
    let mut control = Control {
        witness: Some(&mut writer as &mut dyn Witness),
        ..Control::default()
    };
    let mut session = Session::open_with(problem, &Options::certified(), &mut control).unwrap();
    let done = work(&mut session, &mut control);
    (done, writer.finish().unwrap())
}

fn edit(problem: &Problem, sets: &[&str]) -> (Ending, Vec<u8>) {
    let (mut endings, bytes) = crate::common::certificate::of_edits(problem, &[sets]);
    (endings.remove(0), bytes)
}

fn plate() -> Problem {
    Problem::read("docs/examples/plate.toml").unwrap()
}

/// The sketch is led to its dimensions first, then the edge to its new length.
#[test]
fn an_edit_is_verified() {
    let (ending, bytes) = edit(&plate(), &["C-D=40"]);
    assert_eq!(ending, Ending::Reached);
    let verdict = check(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert!(verdict.is_about(&plate()));
    let [correction, edit] = &verdict.arcs[..] else {
        panic!("{:?}", verdict.arcs);
    };
    assert!(correction.claim.dimensions.is_empty());
    assert_eq!(edit.claim.dimensions, [(2, "40".parse().unwrap())]);
    assert_eq!(edit.claim.kept.len(), 9);
    let [c, d] = [2, 3].map(|p| edit.figure[p]);
    let length = ((c[0] - d[0]).sqr() + (c[1] - d[1]).sqr()).sqrt();
    assert!(length.contains(40.0) && length.wid() < 1e-9);
}

/// Byte for byte: `certs/regenerate.sh` makes them again.
#[test]
fn shipped_edits_are_what_the_program_writes() {
    for (name, set) in [("plate-reached", "C-D=40"), ("plate-limit", "C-D=30")] {
        let (_, bytes) = edit(&plate(), &[set]);
        assert!(
            bytes == crate::common::certificate::shipped(name),
            "{name}: run certs/regenerate.sh"
        );
        assert_eq!(check(&bytes).outcome, Outcome::Verified);
    }
}

/// To the limit, which the checker encloses by itself.
#[test]
fn a_limit_is_verified() {
    let (ending, bytes) = edit(&plate(), &["C-D=30"]);
    assert!(matches!(ending, Ending::Limit(_)));
    let verdict = check(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified);
    let t = verdict.arcs[1].t;
    assert!(t.wid() < 1e-12);
    // 49.5 − 19.5 t, as long as `krawl edit` says.
    let limit = 49.5 - 19.5 * t.mid();
    assert!((limit - 35.246_909_533_501_8).abs() < 1e-9, "{limit}");
}

/// Random figures: whatever is proved of an edit is verified.
fn verified(count: usize, seed: u64, dimension: usize) {
    let mut random = Random(seed);
    let mut counts = [0; 3];
    for _ in 0..count {
        let points = 4 + random.below(6);
        let case = case(&mut random, dimension, points, (0.7, 1.4));
        let name = case.problem.distance_name(case.index);
        let set = format!("{name}={}", case.length);
        let (ending, bytes) = edit(&case.problem, &[&set]);
        let verdict = check(&bytes);
        let about = || {
            format!(
                "--set {set}\n{}{:?}",
                case.problem.to_toml(),
                verdict.outcome
            )
        };
        match ending {
            Ending::Reached | Ending::Limit(_) => {
                assert_eq!(verdict.outcome, Outcome::Verified, "{}", about());
                let t = verdict.arcs[0].t;
                assert!(
                    (t.inf() < 1.0) != (ending == Ending::Reached),
                    "{}",
                    about()
                );
            }
            Ending::Passes(_) | Ending::Stopped(_) => {
                assert!(
                    matches!(verdict.outcome, Outcome::Partial(_)),
                    "{}",
                    about()
                );
                counts[2] += 1;
                continue;
            }
        }
        counts[usize::from(ending == Ending::Reached)] += 1;
    }
    println!(
        "{} limits, {} reached, {} neither",
        counts[0], counts[1], counts[2]
    );
    assert!(counts[0] > count / 8 && counts[1] > count / 8 && counts[2] <= count / 20);
}

#[test]
fn random_edits_in_the_plane_are_verified() {
    verified(60, 71, 2);
}

#[test]
fn random_edits_in_space_are_verified() {
    verified(40, 72, 3);
}

/// Every frame is the continuation of the one before.
#[test]
fn a_sweep_is_verified_up_to_its_limit() {
    let problem = Problem::read("problems/mechanisms/four-bar.toml").unwrap();
    let index = Setting::find(&problem, "B-D").unwrap();
    let length = &problem.distances[index].target;
    let krawl::problem::Target::Length(length) = length else {
        panic!("{length:?}");
    };
    let from = length.to_f64();
    let [from, to] = [from, 100.0 * from].map(|x| format!("{x}").parse().unwrap());
    let (sweep, bytes) = certified(&problem, |session, control| {
        session.sweep(index, (&from, &to), 200, control)
    });
    let verdict = check(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert!(matches!(sweep.end.unwrap().ending, Ending::Limit(_)));
    let frames = verdict.arcs.iter().filter(|arc| arc.t.inf() == 1.0);
    assert!(frames.count() >= sweep.frames.len());
    assert!(verdict.arcs.last().unwrap().t.sup() < 1.0);
}

/// An angle stays what it is while a bar grows.
#[test]
fn edits_with_other_constraints_are_verified() {
    let problem = Problem::parse(
        r#"
dimension = 2
[points]
a = [0, 0]
b = [4, 0]
c = [4, 3]
d = [0.5, 3]
[constraints]
distances = [["a", "b", 4], ["b", "c", 3], ["a", "d", 3]]
angles = [["a", "b", "c", 90], ["b", "a", "d", 80]]
"#,
        "test.toml",
    )
    .unwrap();
    let (ending, bytes) = edit(&problem, &["a-b=5"]);
    assert_eq!(ending, Ending::Reached);
    let verdict = check(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert_eq!(verdict.arcs.len(), 2);
}

/// A crank with its angle, of a linkage: up to motions, or with the ground fixed.
fn crank(is_fixed: bool) -> Problem {
    let fixed = ["", "fixed = [\"A\"]\nhorizontal = [[\"A\", \"D\"]]"][usize::from(is_fixed)];
    let text = format!(
        r#"
dimension = 2
[points]
A = [0, 0]
D = [6, 0]
B = [1, 2.6]
C = [5, 4.1]
[constraints]
{fixed}
distances = [["A", "D", 6], ["A", "B", 3], ["B", "C", 4], ["C", "D", 4]]
angles = [["D", "A", "B", 70]]
"#
    );
    Problem::parse(&text, "crank.toml").unwrap()
}

/// A hole that touches an edge, its centre at a distance from a corner.
fn hole(is_fixed: bool) -> Problem {
    let fixed = ["", "fixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]"][usize::from(is_fixed)];
    let text = format!(
        r#"
dimension = 2
[points]
a = [0, 0]
b = [8, 0]
m = [4, 3]
[lines]
edge = ["a", "b"]
[circles]
hole = {{ center = "m", radius = 3 }}
[constraints]
{fixed}
distances = [["a", "b", 8], ["a", "m", 5]]
radii = [["hole", 3]]
tangent = [["hole", "edge"]]
"#
    );
    Problem::parse(&text, "hole.toml").unwrap()
}

/// A point at a distance from a line and one from its end.
fn height(is_fixed: bool) -> Problem {
    let fixed = ["", "fixed = [\"a\"]\nhorizontal = [[\"a\", \"b\"]]"][usize::from(is_fixed)];
    let text = format!(
        r#"
dimension = 2
[points]
a = [0, 0]
b = [8, 0]
p = [4, 3]
[lines]
edge = ["a", "b"]
[constraints]
{fixed}
distances = [["a", "b", 8], ["a", "p", 5], ["p", "edge", 2.9]]
"#
    );
    Problem::parse(&text, "height.toml").unwrap()
}

/// Figures, an edit that is reached, and one that is not, with the value at which it ends.
type Case = (fn(bool) -> Problem, &'static str, &'static str, f64);
const CASES: [Case; 3] = [
    // There B, C and D are on one line: 8² = 3² + 6² − 36 cos.
    (
        crank,
        "angles:D-A-B=80",
        "angles:D-A-B=150",
        121.855_430_824,
    ),
    (hole, "radii:hole=4.5", "radii:hole=6", 5.0),
    (height, "distances:p-edge=4", "distances:p-edge=7", 5.0),
];

/// Angles, radii and distances from lines, in both frames: reached, or up to the limit.
#[test]
fn edits_of_other_dimensions_are_verified() {
    for (problem, to, beyond, most) in CASES {
        for problem in [problem(false), problem(true)] {
            let (ending, bytes) = edit(&problem, &[to]);
            assert_eq!(ending, Ending::Reached, "{to}");
            let verdict = check(&bytes);
            assert_eq!(verdict.outcome, Outcome::Verified, "{to}");
            assert!(verdict.is_about(&problem));
            let last = verdict.arcs.last().unwrap();
            let (name, value) = to.split_once('=').unwrap();
            let index = Setting::find(&problem, name).unwrap();
            let led = [(index as u32, value.parse().unwrap())];
            assert_eq!((&last.claim.dimensions[..], last.t.mid()), (&led[..], 1.0));
            // A second edit sets out from where the first one came.
            let ((), bytes) = certified(&problem, |session, control| {
                for text in [to, beyond] {
                    let setting = Setting::parse(&problem, text).unwrap();
                    session.edit_with(&[setting], control);
                }
            });
            let twice = check(&bytes);
            assert_eq!(twice.outcome, Outcome::Verified, "{to}, {beyond}");
            assert_eq!(twice.arcs.len(), verdict.arcs.len() + 1);

            let mut session = Session::open(&problem).unwrap();
            let setting = Setting::parse(&problem, beyond).unwrap();
            let limit = session.edit(&[setting]).dimensions[0].value;
            assert!((limit.mid() - most).abs() < 1e-8, "{limit:?}");
            let (ending, bytes) = edit(&problem, &[beyond]);
            assert!(matches!(ending, Ending::Limit(_)), "{beyond}: {ending:?}");
            let verdict = check(&bytes);
            assert_eq!(verdict.outcome, Outcome::Verified, "{beyond}");
            assert!(verdict.arcs.last().unwrap().t.sup() < 1.0);
        }
    }
}

/// Everything in them that is damaged is refused.
#[test]
fn damaged_edits_of_other_dimensions_are_refused() {
    let outcome = |good: &Certificate, damage: &dyn Fn(&mut Vec<Record>)| {
        let mut broken = good.clone();
        damage(&mut broken.records);
        broken.recount();
        verify(&broken.bytes()[..], &Settings::default(), &mut |_| ()).map(|v| v.outcome)
    };
    for (problem, to, beyond, _) in CASES {
        for (problem, set) in [
            (problem(false), to),
            (problem(true), to),
            (problem(false), beyond),
            (problem(true), beyond),
        ] {
            let good = Certificate::read(&edit(&problem, &[set]).1);
            assert_eq!(outcome(&good, &|_| ()).unwrap(), Outcome::Verified);
            let refused = |what: &str, damage: &dyn Fn(&mut Vec<Record>)| {
                let outcome = outcome(&good, damage);
                println!("{set}, {what}: {outcome:?}");
                assert!(!matches!(outcome, Ok(Outcome::Verified)), "{set}: {what}");
            };
            let value: f64 = set.split_once('=').unwrap().1.parse().unwrap();
            let last = |records: &[Record]| {
                records
                    .iter()
                    .rposition(|r| matches!(r, Record::Arc(_)))
                    .unwrap()
            };
            let led = |records: &mut Vec<Record>, index: u32, value: f64| {
                let at = last(records);
                if let Record::Arc(arc) = &mut records[at] {
                    arc.dimensions = vec![(index, value.to_string().parse().unwrap())];
                }
            };
            let (name, _) = set.split_once('=').unwrap();
            let index = Setting::find(&problem, name).unwrap() as u32;
            for other in [value + 1e-3, value - 1e-3, 181.5 - value, -value, 0.0] {
                refused("another value", &|records| led(records, index, other));
            }
            let all = (problem.distances.len() + problem.constraints.len()) as u32;
            for other in (0..all + 1).filter(|&other| other != index) {
                refused("another dimension", &|records| led(records, other, value));
            }
            refused("no dimension", &|records| {
                let at = last(records);
                if let Record::Arc(arc) = &mut records[at] {
                    arc.dimensions.clear();
                }
            });
            refused("the other kind of record", &|records| {
                arcs(records)
                    .into_iter()
                    .for_each(|arc| arc.is_general = false);
            });
            let kept = good.records.iter().rev().find_map(|r| match r {
                Record::Arc(arc) => Some(arc.kept.len()),
                _ => None,
            });
            assert!(kept.unwrap() > 0, "{set}");
            for k in 0..kept.unwrap() {
                refused("a sign turned round", &|records| {
                    let at = last(records);
                    if let Record::Arc(arc) = &mut records[at] {
                        arc.kept[k].1 = !arc.kept[k].1;
                    }
                });
            }
            if arcs(&mut good.records.clone()).len() > 1 {
                refused("the first arc left out", &|records| {
                    drop(records.drain(..last(records)))
                });
            }
            for k in 0..good.tubes() {
                refused("a tube off the path", &|records| {
                    let tube = tube(records, k);
                    let r = f64::from(tube.r);
                    tube.centre.iter_mut().for_each(|x| *x += 30.0 * r);
                });
            }
            let end = good.records.len() - 2;
            match &good.records[end] {
                Record::Fold(fold) => {
                    let fold = fold.clone();
                    for by in [1e-7, -1e-7] {
                        refused("a fold moved", &|records| {
                            let mut moved = fold.clone();
                            moved.t += by;
                            records[end] = Record::Fold(moved);
                        });
                    }
                    refused("its figure moved", &|records| {
                        let mut moved = fold.clone();
                        moved.figure.centre[1] += 1e-4;
                        records[end] = Record::Fold(moved);
                    });
                    refused("a fold is no end", &|records| {
                        records[end] = Record::Reached(fold.figure.clone());
                    });
                }
                Record::Reached(figure) => refused("another end", &|records| {
                    let mut moved = figure.clone();
                    moved.centre[1] += 1e-4;
                    records[end] = Record::Reached(moved);
                }),
                other => panic!("{other:?}"),
            }
        }
    }
}

/// What nothing determines is held: the certificate is of the sketch made so.
#[test]
fn a_figure_that_is_not_held_is_completed() {
    let text = r#"
dimension = 2
[points]
a = [0, 0]
b = [8, 0]
p = [4, 3]
[constraints]
fixed = ["a"]
distances = [["a", "b", 8], ["a", "p", 5]]
"#;
    let loose = Problem::parse_loosely(text, "loose.toml").unwrap();
    let mut writer = Writer::new(Vec::new(), &loose);
    let mut control = Control {
        witness: Some(&mut writer as &mut dyn Witness),
        ..Control::default()
    };
    let error = Session::open_with(&loose, &Options::certified(), &mut control).unwrap_err();
    assert!(
        error.to_string().contains("as many equations as unknowns"),
        "{error}"
    );
    let whole = krawl::edit::completed(&loose).unwrap();
    let setting = Setting::parse(&loose, "a-p=6").unwrap();
    let setting = setting.carried(&loose, &whole).unwrap().unwrap();
    let (ending, bytes) = certified(&whole, |session, control| {
        session.edit_with(&[setting], control).ending
    });
    assert_eq!(ending, Ending::Reached);
    let verdict = check(&bytes);
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert!(verdict.is_about(&whole) && !verdict.is_about(&loose));
}

/// The program: what is held is said, what follows from others is left out, sketches of other programs are compared.
#[test]
fn the_program_certifies_sketches_that_are_not_complete() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let krawl = |arguments: &[&str]| {
        let mut command = assert_cmd::Command::cargo_bin("krawl").unwrap();
        let output = command.args(arguments).output().unwrap();
        let text = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
        (output.status.code().unwrap(), text.concat())
    };
    let (cert, out) = (path("c.krawl"), path("out.toml"));
    let (cert, out) = (cert.to_str().unwrap(), out.to_str().unwrap());
    let loose = path("loose.toml");
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [8, 0]\np = [4, 3]\n[constraints]\nfixed = [\"a\"]\n\
                distances = [[\"a\", \"b\", 8], [\"a\", \"p\", 5]]\n";
    std::fs::write(&loose, text).unwrap();
    let loose = loose.to_str().unwrap();
    let (code, text) = krawl(&[
        "edit", loose, "--set", "a-p=6", "--cert", cert, "--out", out,
    ]);
    assert!(
        code == 0 && text.contains("with y of b and y of p held where they are"),
        "{text}"
    );
    let edited = std::fs::read_to_string(out).unwrap();
    assert!(
        edited.contains("[\"a\", \"p\", 6.0]") && !edited.contains("x ="),
        "{edited}"
    );
    let (code, text) = krawl(&["verify", cert, loose]);
    assert!(
        code == 0 && text.contains("about the figure with y of b and y of p held where they are"),
        "{text}"
    );
    let (code, text) = krawl(&["verify", cert, out]);
    assert!(
        code == 1 && text.contains("REFUTED: the problem is not"),
        "{text}"
    );
    let (code, text) = krawl(&[
        "sweep", loose, "--vary", "a-p", "--from", "5", "--to", "9", "--frames", "5", "--cert",
        cert,
    ]);
    assert!(code == 0, "{text}");
    assert_eq!(krawl(&["verify", cert, loose]).0, 0);

    let bracket = "problems/sketches/bracket.slvs";
    let (code, text) = krawl(&["edit", bracket, "--set", "c011=52", "--cert", cert]);
    assert!(code == 0, "{text}");
    let (code, text) = krawl(&["verify", cert, bracket]);
    assert!(code == 0 && text.contains("exactly"), "{text}");

    let twice = path("twice.toml");
    let text = "dimension = 2\n[points]\na = [0, 0]\nb = [8, 0]\nc = [8, 5]\nd = [0, 5]\n[constraints]\nfixed = [\"a\"]\n\
                distances = [[\"a\", \"b\", 8], [\"b\", \"c\", 5], [\"a\", \"d\", 5]]\n\
                horizontal = [[\"a\", \"b\"], [\"c\", \"d\"]]\nvertical = [[\"a\", \"d\"], [\"b\", \"c\"]]\n";
    std::fs::write(&twice, text).unwrap();
    let twice = twice.to_str().unwrap();
    let (json, page) = (path("twice.json"), path("twice.html"));
    let (json, page) = (json.to_str().unwrap(), page.to_str().unwrap());
    let all = krawl(&[
        "edit", twice, "--set", "a-b=9", "--json", json, "--html", page,
    ]);
    assert_eq!(all.0, 0, "{}", all.1);
    let (code, text) = krawl(&["edit", twice, "--set", "a-b=9", "--cert", cert]);
    assert!(
        code == 0 && text.contains("follows from the others"),
        "{text}"
    );
    let (code, text) = krawl(&["verify", cert, twice]);
    assert!(
        code == 0 && text.contains("`a-d` was left out and follows from the others"),
        "{text}"
    );
    let sweep = ["--from", "7", "--to", "9", "--frames", "3", "--cert", cert];
    let (code, text) = krawl(&[&["sweep", twice, "--vary", "a-b"], &sweep[..]].concat());
    assert!(code == 0, "{text}");
    assert_eq!(krawl(&["verify", cert, twice]).0, 0);
    // What is left out would be missed.
    let none = path("none.krawl");
    let none = none.to_str().unwrap();
    let (code, text) = krawl(&["edit", twice, "--set", "a-d=6", "--cert", none]);
    assert!(
        code == 1 && text.contains("no certificate was written: ") && text.contains("`a-d`"),
        "{text}"
    );
    let sweep = ["--from", "5", "--to", "6", "--frames", "3", "--cert", none];
    let (code, text) = krawl(&[&["sweep", twice, "--vary", "a-d"], &sweep[..]].concat());
    assert!(code == 1 && text.contains("no certificate was"), "{text}");
    assert!(!path("none.krawl").exists());
    let both = [
        "edit", twice, "--set", "a-d=6", "--set", "b-c=6", "--cert", cert,
    ];
    let (code, text) = krawl(&both);
    assert!(code == 0, "{text}");
    assert_eq!(krawl(&["verify", cert, twice]).0, 0);
    let (code, text) = krawl(&["edit", twice, "--set", "b-c=6", "--cert", none]);
    assert!(code == 1 && text.contains("no certificate was"), "{text}");
}

/// Both ways from the sketch, to two ends.
#[test]
fn an_open_path_is_verified() {
    for name in ["constraints/3p3l", "quadrangle"] {
        let problem = match name {
            "quadrangle" => Problem::parse(QUADRANGLE, "test.toml").unwrap(),
            _ => Problem::read(format!("problems/{name}.toml")).unwrap(),
        };
        let (outcome, bytes) = crate::common::certificate::of(&problem, &Options::certified());
        let verdict = check(&bytes);
        assert_eq!(verdict.outcome, Outcome::Verified, "{name}");
        let is_open = matches!(outcome.status, Status::Open(_));
        assert_eq!(verdict.is_open, is_open, "{name}");
        assert_eq!(verdict.solutions.len(), outcome.solutions.len(), "{name}");
        assert!(is_open || name != "quadrangle");
    }
}

/// Everything in a certificate of an edit that is damaged is refused.
#[test]
fn damaged_edits_are_refused() {
    let reached = Certificate::read(&edit(&plate(), &["C-D=40"]).1);
    let limit = Certificate::read(&edit(&plate(), &["C-D=30"]).1);
    let change = |good: &Certificate, change: &dyn Fn(&mut Vec<Record>)| {
        let mut broken = good.clone();
        change(&mut broken.records);
        broken.recount();
        verify(&broken.bytes()[..], &Settings::default(), &mut |_| ()).map(|v| v.outcome)
    };
    let refused = |good: &Certificate, what: &str, damage: &dyn Fn(&mut Vec<Record>)| {
        let outcome = change(good, damage);
        println!("{what}: {outcome:?}");
        assert!(!matches!(outcome, Ok(Outcome::Verified)), "{what}");
    };
    for good in [&reached, &limit] {
        assert_eq!(change(good, &|_| ()).unwrap(), Outcome::Verified);
        // Another length, no length, another dimension.
        refused(good, "another length", &|records| {
            arcs(records)[1].dimensions[0].1 = "40.001".parse().unwrap();
        });
        refused(good, "another dimension", &|records| {
            arcs(records)[1].dimensions[0].0 = 3;
        });
        refused(good, "no length", &|records| {
            arcs(records)[1].dimensions.clear()
        });
        refused(good, "lengths in the first arc", &|records| {
            arcs(records)[0].dimensions = vec![(2, "49.5".parse().unwrap())];
        });
        for k in 0..9 {
            refused(good, "a sign turned round", &|records| {
                let kept = &mut arcs(records)[1].kept;
                if let Some(sign) = kept.get_mut(k) {
                    sign.1 = !sign.1;
                } else {
                    kept.push((vec![0, 0, 1], true));
                }
            });
        }
        refused(good, "the first arc left out", &|records| {
            let next = records.iter().rposition(|r| matches!(r, Record::Arc(_)));
            records.drain(..next.unwrap());
        });
        refused(good, "the last arc twice", &|records| {
            let from = records.iter().rposition(|r| matches!(r, Record::Arc(_)));
            let again = records[from.unwrap()..records.len() - 1].to_vec();
            let at = records.len() - 1;
            records.splice(at..at, again);
        });
        let tubes = good.tubes();
        for k in 0..tubes {
            refused(good, "a tube backwards", &|records| {
                let tube = tube(records, k);
                tube.normal.iter_mut().for_each(|c| *c = -*c);
            });
            refused(good, "a tube off the path", &|records| {
                let tube = tube(records, k);
                let r = f64::from(tube.r);
                tube.centre.iter_mut().for_each(|x| *x += 30.0 * r);
            });
        }
    }
    refused(&reached, "another end", &|records| {
        for record in records {
            if let Record::Reached(figure) = record {
                figure.centre[0] += 1e-6;
            }
        }
    });
    refused(&reached, "the last end left out", &|records| {
        let at = records.len() - 2;
        records.remove(at);
    });
    refused(&reached, "reached is no fold", &|records| {
        let at = records.len() - 2;
        let Record::Reached(figure) = &records[at] else {
            panic!();
        };
        let fold = krawl::certificate::FoldClaim {
            figure: figure.clone(),
            t: 1.0,
            t_radius: 1e-6,
        };
        records[at] = Record::Fold(fold);
    });
    type Change = fn(&mut krawl::certificate::FoldClaim);
    let folds: [(&str, Change); 5] = [
        ("t too high", |fold| fold.t += 1e-9),
        ("t too low", |fold| fold.t -= 1e-9),
        ("t at 1", |fold| fold.t = 1.0),
        ("the figure elsewhere", |fold| fold.figure.centre[1] += 1e-6),
        ("a box too narrow", |fold| fold.t_radius = 1e-30),
    ];
    for (what, damage) in folds {
        refused(&limit, what, &|records| {
            let at = records.len() - 2;
            if let Record::Fold(fold) = &mut records[at] {
                damage(fold);
            }
        });
    }
    refused(&limit, "a fold is no end", &|records| {
        let at = records.len() - 2;
        let Record::Fold(fold) = records[at].clone() else {
            panic!();
        };
        records[at] = Record::Reached(fold.figure);
    });
    // A sketch that does not meet its dimensions is no figure to begin with.
    let without = change(&reached, &|records| {
        let next = records.iter().rposition(|r| matches!(r, Record::Arc(_)));
        records.drain(..next.unwrap());
    });
    assert_eq!(without.unwrap(), Outcome::Refuted(Flaw::Met));
}

/// A path that turns back beyond t = 1 has met the figure wanted before: that is no limit.
#[test]
fn a_fold_beyond_the_figure_wanted_is_no_limit() {
    for (off, is_limit) in [(-2e-3, true), (1e-3, false)] {
        match check(&crate::common::certificate::plate_led_beside_its_limit(off).bytes()).outcome {
            Outcome::Verified => assert!(is_limit, "{off}"),
            Outcome::NotProved(Flaw::Fold(2, _)) => assert!(!is_limit, "{off}"),
            other => panic!("{off}: {other:?}"),
        }
    }
}

/// The way back is that from the sketch, and the other one.
#[test]
fn damaged_open_paths_are_refused() {
    let problem = Problem::parse(QUADRANGLE, "test.toml").unwrap();
    let good =
        Certificate::read(&crate::common::certificate::of(&problem, &Options::certified()).1);
    let turn = good
        .records
        .iter()
        .position(|r| *r == Record::Turn)
        .unwrap();
    let outcome = |damage: &dyn Fn(&mut Vec<Record>)| {
        let mut broken = good.clone();
        damage(&mut broken.records);
        broken.recount();
        verify(&broken.bytes()[..], &Settings::default(), &mut |_| ()).map(|v| v.outcome)
    };
    // The same way twice.
    let twice = outcome(&|records| {
        let again: Vec<Record> = records[..turn].to_vec();
        let tubes = again.into_iter().filter(|r| matches!(r, Record::Tube(_)));
        let end = records.pop().unwrap();
        records.truncate(turn + 1);
        records.extend(tubes);
        records.push(end);
    });
    assert!(!matches!(twice, Ok(Outcome::Verified)), "{twice:?}");
    // Neither without the turn, nor without what follows it.
    let joined = outcome(&|records| drop(records.remove(turn)));
    assert!(joined.is_err(), "{joined:?}");
    let alone = outcome(&|records| drop(records.drain(turn + 1..records.len() - 1)));
    assert!(alone.is_err(), "{alone:?}");
    let gap = outcome(&|records| drop(records.remove(turn + 2)));
    assert!(!matches!(gap, Ok(Outcome::Verified)), "{gap:?}");
}

fn arcs(records: &mut [Record]) -> Vec<&mut krawl::certificate::ArcClaim> {
    let arcs = records.iter_mut().filter_map(|record| match record {
        Record::Arc(arc) => Some(arc),
        _ => None,
    });
    arcs.collect()
}

fn tube(records: &mut [Record], k: usize) -> &mut krawl::certificate::TubeClaim {
    let mut tubes = records.iter_mut().filter_map(|record| match record {
        Record::Tube(tube) => Some(tube),
        _ => None,
    });
    tubes.nth(k).unwrap()
}
