//! Certificates: those that are shipped, damaged ones, and files that are none.

use crate::common::certificate::{Certificate, SHIPPED, shipped};
use krawl::certificate::{Flaw, FormatError, Outcome, Record, Settings, Verdict, Writer, verify};
use krawl::problem::Problem;
use krawl::track::{Options, Status, Stop, StopKind, Witness};

fn check(bytes: &[u8]) -> Result<Verdict, FormatError> {
    verify(bytes, &Settings::default(), &mut |_| ())
}

fn written(problem: &Problem, options: &Options) -> Vec<u8> {
    crate::common::certificate::of(problem, options).1
}

#[test]
fn shipped_certificates_prove_what_they_claim() {
    let mut total = 0;
    for (name, solutions) in crate::common::SHORT {
        let bytes = shipped(name);
        total += bytes.len();
        let verdict = check(&bytes).unwrap();
        assert_eq!(verdict.outcome, Outcome::Verified, "{name}");
        assert_eq!(verdict.solutions.len(), solutions, "{name}");
        assert!(verdict.is_about(&crate::common::shipped(name)), "{name}");
        assert!(verdict.margin > 0.0);
    }
    assert!(total < 5 << 20);
    assert_eq!(crate::common::SHORT.len(), SHIPPED.len());
}

/// Byte for byte, in debug and release builds alike: `certs/regenerate.sh` makes them again.
#[test]
fn shipped_certificates_are_what_the_program_writes() {
    let stale: Vec<&str> = SHIPPED
        .into_iter()
        .filter(|name| {
            written(&crate::common::shipped(name), &Options::certified()) != shipped(name)
        })
        .collect();
    assert!(
        stale.is_empty(),
        "{stale:?}: run certs/regenerate.sh, look at what changed, and commit it"
    );
}

#[test]
fn a_tube_takes_less_than_a_kilobyte() {
    // n entries of 8, 4 and 2 bytes, and 21 bytes more.
    let bytes = shipped("icosahedron-c1");
    let tubes = Certificate::read(&bytes).tubes();
    assert!(bytes.len() < tubes * 1024);
}

#[test]
fn verdicts_do_not_depend_on_the_number_of_threads() {
    let mut broken = Certificate::read(&shipped("disulfide"));
    broken.tube_mut(100).h *= 10.0;
    broken.tube_mut(150).h *= 10.0;
    for bytes in [shipped("disulfide"), broken.bytes()] {
        let with = |threads| verify(&bytes[..], &Settings { threads }, &mut |_| ()).unwrap();
        let one = with(1);
        for threads in [2, 3, 8] {
            assert_eq!(with(threads), one);
        }
    }
}

#[test]
fn other_ways_of_tracking_leave_certificates_too() {
    let problem = crate::common::shipped("prism");
    for options in [
        Options::certified().reversed(),
        Options::certified().with_max_step(0.05),
    ] {
        let verdict = check(&written(&problem, &options)).unwrap();
        assert_eq!(verdict.outcome, Outcome::Verified);
        assert_eq!(verdict.solutions.len(), 12);
    }
}

/// On the path the reference turns over, as the third point falls on the line of the others: the
/// two solutions are one figure, its two sides up.
#[test]
fn a_figure_that_turns_over_is_proved_congruent_to_itself() {
    let problem = crate::common::turning_triangle();
    let bytes = written(&problem, &Options::certified());
    let verdict = check(&bytes).unwrap();
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert_eq!(verdict.classes, [0, 0]);
    // And it is no other figure.
    let mut different = Certificate::read(&bytes);
    different.classes_mut()[1] = 1;
    let verdict = check(&different.bytes()).unwrap();
    assert_eq!(verdict.outcome, Outcome::Refuted(Flaw::Class(2, 1)));
}

/// The checker's bound on |A| once grew by 1/256 for each unknown, and refused what is larger than some
/// 200.
#[test]
fn certificates_of_large_problems_are_verified() {
    let recipe = krawl::generate::Recipe {
        family: krawl::generate::Family::Strip,
        size: 300,
        loops: 1,
        seed: 1,
    };
    let problem = recipe.problem().unwrap();
    let verdict = check(&written(&problem, &Options::certified())).unwrap();
    assert_eq!(verdict.outcome, Outcome::Verified);
    assert!(verdict.margin > 0.01, "{}", verdict.margin);
}

/// To test its tubes would take several matrices of 7000 rows and columns for each thread, and this is a
/// file of less than a megabyte.
#[test]
fn certificates_have_a_limit_on_memory() {
    let problem = krawl::generate::Recipe::new(krawl::generate::Family::Chain, 7000).problem();
    let problem = problem.unwrap();
    let mut writer = Writer::new(Vec::new(), &problem);
    writer.begin(1.0);
    writer.end(
        &Status::Stopped(Stop::new(StopKind::NoStep, "no tube was proved")),
        &[],
    );
    let bytes = writer.finish().unwrap();
    let refused = check(&bytes).unwrap_err().to_string();
    let free = problem.free_coordinates();
    assert!(free > 6000);
    assert!(
        refused.contains(&format!("{free} free coordinates, more than the 6000")),
        "{refused}"
    );
}

#[test]
fn a_stopped_run_leaves_a_partial_certificate() {
    let problem = crate::common::shipped("octahedron");
    for max_steps in [1, 10, 60] {
        let options = Options {
            max_steps,
            ..Options::certified()
        };
        let verdict = check(&written(&problem, &options)).unwrap();
        assert!(matches!(&verdict.outcome, Outcome::Partial(why) if why.contains("the limit")));
        assert_eq!(verdict.tubes, max_steps as u64 + 1);
    }
}

#[test]
fn boxes_hold_those_of_the_run() {
    let problem = crate::common::shipped("k33");
    let verdict = check(&shipped("k33")).unwrap();
    let outcome = crate::common::solve(&problem, &Options::certified());
    for (ours, theirs) in verdict.solutions.iter().zip(&outcome.solutions) {
        for (a, b) in ours.iter().flatten().zip(theirs.points.iter().flatten()) {
            assert!(b.subset(*a) && a.wid() <= 1e-11, "{a:?} {b:?}");
        }
    }
}

#[test]
fn a_certificate_is_about_its_problem_only() {
    let verdict = check(&shipped("octahedron")).unwrap();
    let mut problem = crate::common::shipped("octahedron");
    problem.name = "another title".into();
    assert!(verdict.is_about(&problem));
    problem.points[0].sketch[0] = "1e-30".parse().unwrap();
    assert!(!verdict.is_about(&problem));
    assert!(!verdict.is_about(&crate::common::shipped("k33")));
}

/// The mirror image of a tube is a tube around the mirror image of the path, another component
/// or another part of the same: every tube is true, only the jump is not.
#[test]
fn a_chain_that_jumps_to_the_mirror_image_is_refused() {
    for name in ["octahedron", "disulfide", "k33", "prism"] {
        let good = Certificate::read(&shipped(name));
        let mirrored = good.mirrored_unknowns();
        let tubes = good.tubes();
        // All of it in the mirror image: it does not begin at the sketch.
        for (from, to) in [(0, tubes), (tubes / 3, 2 * tubes / 3), (tubes / 2, tubes)] {
            let mut jumped = good.clone();
            for k in from..to {
                let tube = jumped.tube_mut(k);
                for &i in &mirrored {
                    tube.centre[i] *= -1.0;
                    tube.normal[i] *= -1.0;
                }
            }
            let verdict = check(&jumped.bytes()).unwrap();
            let jump = from as u64 + 1;
            match verdict.outcome {
                Outcome::Refuted(Flaw::Start) => assert_eq!(from, 0),
                Outcome::Refuted(Flaw::Link(k) | Flaw::Direction(k)) => assert_eq!(k, jump),
                // Solutions of the other part are not those listed.
                Outcome::Refuted(Flaw::Unlisted(k, ..)) => assert!(k > jump),
                other => panic!("{name}: {other:?}"),
            }
            assert!(verdict.tubes < tubes as u64);
        }
    }
}

/// A float run with steps that are too long loses its path near another part of it, and closes
/// nevertheless: tubes around all of its points, each a true one where such a tube exists.
#[test]
fn a_chain_with_tubes_left_out_is_refused() {
    for name in ["octahedron", "k33", "prism"] {
        let good = Certificate::read(&shipped(name));
        for every in [2, 3, 5] {
            // As a run with long steps saw the path: the points between are missing.
            let mut jumped = good.clone();
            jumped.keep_tubes(|k| k % every == 0);
            let verdict = check(&jumped.bytes()).unwrap();
            assert!(
                matches!(verdict.outcome, Outcome::Refuted(_)),
                "{name} {every}"
            );
        }
    }
}

#[test]
fn files_that_are_none_are_told_from_refuted_ones() {
    let good = shipped("dodecagon");
    let error = |bytes: &[u8]| check(bytes).unwrap_err();
    assert!(matches!(error(b""), FormatError::NotACertificate));
    assert!(matches!(
        error(b"name = \"x\"\n"),
        FormatError::NotACertificate
    ));
    let mut future = good.clone();
    future[18] = 4;
    assert!(matches!(error(&future), FormatError::Version(4)));
    for length in (0..good.len()).step_by(97) {
        assert!(check(&good[..length]).is_err(), "{length}");
    }
    let mut longer = good.clone();
    longer.push(0);
    assert!(matches!(error(&longer), FormatError::Malformed(_)));

    // Enormous counts.
    let certificate = Certificate::read(&good);
    let text = 18 + 4 + 4 + certificate.program.len();
    for at in [18 + 4, text + 32] {
        let mut enormous = good.clone();
        enormous[at..at + 4].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(matches!(error(&enormous), FormatError::Malformed(_)));
    }
    let mut counts = certificate.clone();
    let Some(Record::End(end)) = counts.records.last_mut() else {
        panic!()
    };
    end.tubes = u64::MAX;
    assert!(matches!(error(&counts.bytes()), FormatError::Malformed(_)));

    // Numbers that are none.
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300] {
        let with = |damage: &dyn Fn(&mut krawl::certificate::TubeClaim)| {
            let mut broken = certificate.clone();
            damage(broken.tube_mut(3));
            broken.bytes()
        };
        for bytes in [
            with(&|tube| tube.centre[1] = bad),
            with(&|tube| tube.normal[1] = bad as f32),
            with(&|tube| tube.h = bad),
            with(&|tube| tube.r = bad as f32),
            with(&|tube| tube.exit = bad),
            with(&|tube| tube.weights[0] = 0),
        ] {
            assert!(matches!(error(&bytes), FormatError::Malformed(_)), "{bad}");
        }
    }
}
