//! Certificates of complex sets: what they prove, and that none with a false claim passes.

use assert_cmd::Command;
use krawl::certificate::complex::{ComplexFlaw, ComplexSet, ComplexVerdict, verify_complex_set};
use std::fs;
use std::path::Path;

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

/// The set that `krawl complex` writes from the shipped template.
fn set_of(name: &str, folder: &Path) -> ComplexSet {
    let cert = folder.join("set.krawl");
    krawl()
        .args(["complex", &format!("problems/{name}.toml"), "--quiet"])
        .args(["--template", &format!("problems/{name}.krawl-template")])
        .arg("--cert")
        .arg(&cert)
        .output()
        .unwrap();
    ComplexSet::from_text(&fs::read_to_string(cert).unwrap()).unwrap()
}

fn verdict(set: &ComplexSet) -> ComplexVerdict {
    verify_complex_set(&set.to_text()).unwrap()
}

#[test]
fn the_checker_proves_what_was_found() {
    let folder = tempfile::tempdir().unwrap();
    for (name, counts, bound, all) in [
        ("octahedron", [8, 16, 4], 16, true),
        ("disulfide", [32, 64, 18], 128, false),
        // In the plane the number of realisations is the bound, and the checker knows Bézout's only.
        ("k33", [8, 16, 8], 32, false),
        ("prism", [12, 24, 12], 32, false),
    ] {
        let set = set_of(name, folder.path());
        let found = verdict(&set);
        assert_eq!(found.flaw, None, "{name}");
        assert_eq!(
            [found.isometry, found.rotation, found.real],
            counts,
            "{name}"
        );
        assert_eq!(
            (found.bound, found.proves_all()),
            (Some(bound), all),
            "{name}"
        );
        assert_eq!(set.complete, all, "{name}");
    }
}

#[test]
fn sabotage_never_passes() {
    let folder = tempfile::tempdir().unwrap();
    let set = set_of("octahedron", folder.path());
    let refused = |change: &dyn Fn(&mut ComplexSet), what: &str| {
        let mut changed = set.clone();
        change(&mut changed);
        assert_ne!(changed, set, "{what}");
        let found = verdict(&changed);
        assert!(found.flaw.is_some() && !found.proves_all(), "{what}");
        found.flaw.unwrap()
    };
    // A path that was dropped.
    for k in 0..set.solutions.len() {
        let flaw = refused(&|set| drop(set.solutions.remove(k)), "dropped");
        assert!(matches!(flaw, ComplexFlaw::NotProved(_)));
    }
    // Without the claim that these are all the rest is true, and proves less.
    let mut fewer = set.clone();
    fewer.solutions.pop();
    fewer.complete = false;
    assert!(verdict(&fewer).flaw.is_none() && !verdict(&fewer).proves_all());
    // Two paths that came to the same solution, or to its mirror image.
    for (k, mirrored) in [(1, false), (1, true), (5, true)] {
        let flaw = refused(
            &|set| {
                set.solutions[k] = set.solutions[0].clone();
                if mirrored {
                    for place in &mut set.solutions[k] {
                        place[2] = place[2].map(|x| -x);
                    }
                }
            },
            "twice",
        );
        assert!(matches!(flaw, ComplexFlaw::False(_)), "{flaw:?}");
    }
    // No solution at all.
    // (A place nearby would do: the box that is proved around it holds the solution.)
    let far = |set: &mut ComplexSet| set.solutions[3].iter_mut().for_each(|p| p[1][0] += 0.5);
    refused(&far, "moved");
    refused(&|set| set.solutions[3].swap(3, 5), "points swapped");
    let huge = |set: &mut ComplexSet| set.solutions[3].iter_mut().for_each(|p| p[1][0] = f64::MAX);
    refused(&huge, "huge");
    refused(&|set| drop(set.solutions[2].pop()), "a point less");
    refused(&|set| set.fixed = vec!["p1".into(), "p2".into()], "an edge");
    refused(
        &|set| set.fixed = vec!["p1".into(), "p2".into(), "p4".into()],
        "no triangle",
    );
    refused(
        &|set| set.problem = set.problem.replace("1.18", "1.19"),
        "another problem",
    );
    // Two of them that change places are the same set.
    let mut swapped = set.clone();
    swapped.solutions.swap(0, 1);
    assert!(verdict(&swapped).proves_all());
    for text in [
        "",
        "krawl complex set 1\n",
        "krawl complex set 2\n{}\n",
        "{}",
    ] {
        assert!(verify_complex_set(text).is_err());
    }
}

#[test]
fn verify_prints_the_theorem() {
    let folder = tempfile::tempdir().unwrap();
    let set = set_of("octahedron", folder.path());
    let cert = folder.path().join("set.krawl");
    let verify = |file: &str| {
        let run = krawl().arg("verify").arg(&cert).arg(file).output().unwrap();
        (
            run.status.code().unwrap(),
            String::from_utf8(run.stdout).unwrap(),
        )
    };
    let (code, said) = verify("problems/octahedron.toml");
    assert_eq!(code, 0);
    let theorem = "VERIFIED: octahedron has exactly 8 complex solutions up to isometry (4 of them real), 16 up to rotation";
    assert!(said.starts_with(theorem), "{said}");
    assert_eq!(verify("problems/disulfide.toml").0, 1);
    let mut fewer = set;
    fewer.solutions.pop();
    fs::write(&cert, fewer.to_text()).unwrap();
    let (code, said) = verify("problems/octahedron.toml");
    assert_eq!(code, 3, "{said}");
}

/// A bound that somebody cites is called so.
#[test]
fn cited_bounds_are_called_so() {
    let run = |bound: &str| {
        let run = krawl()
            .args(["complex", "problems/disulfide.toml", "--bound", bound])
            .args(["--template", "problems/disulfide.krawl-template"])
            .output()
            .unwrap();
        (
            run.status.code().unwrap(),
            String::from_utf8(run.stdout).unwrap(),
        )
    };
    let (code, said) = run("64");
    assert_eq!(code, 0);
    assert!(
        said.starts_with("disulfide: Complete if the bound that you cite holds: 32 complex"),
        "{said}"
    );
    // A larger one than is proved here says nothing.
    let (code, said) = run("200");
    assert_eq!(code, 4);
    assert!(said.contains("is 128 up to rotation"), "{said}");
    let (code, said) = run("63");
    assert_eq!(code, 4);
    assert!(said.contains("The bound that you cite is wrong"), "{said}");
}
