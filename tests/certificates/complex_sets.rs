//! Certificates of complex sets: what they prove, and that none with a false claim passes.

use assert_cmd::Command;
use krawl::certificate::complex::{ComplexFlaw, ComplexSet, ComplexVerdict, verify_complex_set};
use krawl::problem::Problem;
use std::fs;
use std::path::Path;

fn krawl() -> Command {
    Command::new(env!("CARGO_BIN_EXE_krawl"))
}

/// The set that `krawl complex` writes from the shipped template.
fn set_of(name: &str, folder: &Path) -> ComplexSet {
    set_of_file(&format!("problems/{name}.toml"), name, folder)
}

/// The set that `krawl complex` writes for a file, from a shipped template.
fn set_of_file(file: &str, name: &str, folder: &Path) -> ComplexSet {
    set_from(file, &format!("problems/{name}.krawl-template"), folder)
}

fn set_from(file: &str, template: &str, folder: &Path) -> ComplexSet {
    let cert = folder.join("set.krawl");
    krawl()
        .args(["complex", file, "--float", "--quiet"])
        .args(["--template", template, "--cert"])
        .arg(&cert)
        .output()
        .unwrap();
    ComplexSet::from_bytes(&fs::read(cert).unwrap()).unwrap()
}

/// The set of the octahedron with another length of p2-p6.
fn octahedron(length: &str, folder: &Path) -> ComplexSet {
    octahedron_with(["p2", "p6", "1.18"], length, folder)
}

/// The set of the octahedron with another length in the place of this one.
fn octahedron_with([a, b, old]: [&str; 3], length: &str, folder: &Path) -> ComplexSet {
    let text = fs::read_to_string("problems/octahedron.toml").unwrap();
    let entry = |length: &str| format!("[\"{a}\", \"{b}\", {length}]");
    let changed = text.replace(&entry(old), &entry(length));
    assert_ne!(changed, text);
    let changed = &changed[..changed.find("[[published]]").unwrap()];
    let file = folder.join("octahedron.toml");
    fs::write(&file, changed).unwrap();
    set_of_file(&file.to_string_lossy(), "octahedron", folder)
}

fn verdict(set: &ComplexSet) -> ComplexVerdict {
    verify_complex_set(&set.to_bytes()).unwrap()
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

/// The third fixed point may be on either side of the first one.
#[test]
fn obtuse_triangles_may_be_fixed() {
    let folder = tempfile::tempdir().unwrap();
    let set = octahedron_with(["p2", "p3", "1.12"], "1.7", folder.path());
    assert_eq!(set.fixed, ["p1", "p2", "p3"]);
    assert!(set.solutions[0][2][0][0] < -0.1);
    let found = verdict(&set);
    assert_eq!(found.flaw, None);
    assert!(set.complete && found.proves_all() && found.isometry == 8);
    // Mirrored in the fixed points' plane it is the same figure, in other ways it is not where it should be.
    for (axis, passes) in [(0, false), (1, false), (2, true)] {
        let mut mirrored = set.clone();
        for place in &mut mirrored.solutions[3] {
            place[axis].iter_mut().for_each(|x| *x = -*x);
        }
        assert_eq!(verdict(&mirrored).proves_all(), passes);
        assert_eq!(verdict(&mirrored).flaw.is_none(), passes);
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
                        place[2].iter_mut().for_each(|x| *x = -*x);
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
    let bytes = set.to_bytes();
    let json = bytes.iter().rposition(|&byte| byte == 14).unwrap() + 1;
    let mut another = bytes.clone();
    another[json - 1] = 13;
    let of_path = fs::read("certs/octahedron.krawl").unwrap();
    let [empty, braces]: [Vec<u8>; 2] = [&b""[..], b"{}"].map(|end| [&bytes[..json], end].concat());
    let cut = bytes[..bytes.len() - 9].to_vec();
    for bytes in [
        Vec::new(),
        b"{}".to_vec(),
        another,
        of_path,
        empty,
        braces,
        cut,
    ] {
        assert!(verify_complex_set(&bytes).is_err());
    }
}

/// 1.12 + 1.22 = 1.17 + 1.17 around p4; 1.12 + 1.17 = 1.17 + 1.12 in two ways.
#[test]
fn figures_at_infinity_count() {
    let folder = tempfile::tempdir().unwrap();
    for (length, isometry, away) in [("1.22", 7, 1), ("1.12", 6, 2)] {
        let set = octahedron(length, folder.path());
        assert!(set.complete && set.at_infinity.len() == away);
        let found = verdict(&set);
        assert_eq!(found.flaw, None, "{length}");
        assert!(found.proves_all());
        assert_eq!((found.isometry, found.rotation), (isometry, 2 * isometry));
        assert_eq!(found.rotation_at_infinity(), 2 * away);
        assert_eq!(found.at_infinity, vec![(vec![3], 1); away]);
        // Without them the rest is true, and not all that there can be.
        let mut fewer = set.clone();
        fewer.at_infinity.clear();
        let flaw = verdict(&fewer).flaw;
        assert!(matches!(flaw, Some(ComplexFlaw::NotProved(_))), "{flaw:?}");
        fewer.complete = false;
        assert!(verdict(&fewer).flaw.is_none() && !verdict(&fewer).proves_all());
    }
}

#[test]
fn sabotage_at_infinity_never_passes() {
    let folder = tempfile::tempdir().unwrap();
    let set = octahedron("1.22", folder.path());
    let twice = octahedron("1.12", folder.path());
    let near = octahedron("1.22001", folder.path());
    let refused = |set: &ComplexSet, change: &dyn Fn(&mut ComplexSet), what: &str| {
        let mut changed = set.clone();
        change(&mut changed);
        assert_ne!(changed, *set, "{what}");
        let found = verdict(&changed);
        assert!(found.flaw.is_some() && !found.proves_all(), "{what}");
        found.flaw.unwrap()
    };
    let is_false = |flaw: ComplexFlaw, why: &str| {
        assert!(
            matches!(&flaw, ComplexFlaw::False(text) if text.contains(why)),
            "{flaw:?}"
        );
    };
    let is_doubt = |flaw: ComplexFlaw, why: &str| {
        assert!(
            matches!(&flaw, ComplexFlaw::NotProved(text) if text.contains(why)),
            "{flaw:?}"
        );
    };
    // Solutions or figures at infinity that were dropped, with others counted twice in their stead.
    for k in 0..set.solutions.len() {
        let dropped = |set: &mut ComplexSet| drop(set.solutions.remove(k));
        is_doubt(
            refused(&set, &dropped, "dropped"),
            "all solutions are claimed",
        );
        let figure = |set: &mut ComplexSet| {
            dropped(set);
            let again = set.at_infinity[0].figures[0].clone();
            set.at_infinity[0].figures.push(again);
        };
        is_false(refused(&set, &figure, "figure twice"), "are the same");
        let departure = |set: &mut ComplexSet| {
            dropped(set);
            set.at_infinity.push(set.at_infinity[0].clone());
        };
        is_false(refused(&set, &departure, "departure twice"), "are the same");
        // A figure at infinity is no solution.
        let solution =
            |set: &mut ComplexSet| set.solutions[k] = set.at_infinity[0].figures[0].clone();
        refused(&set, &solution, "as a solution");
    }
    let dropped = |set: &mut ComplexSet| drop(set.at_infinity.pop());
    is_doubt(
        refused(&twice, &dropped, "a departure dropped"),
        "all solutions",
    );
    let none = |set: &mut ComplexSet| set.at_infinity[0].figures.clear();
    is_doubt(refused(&set, &none, "no figure"), "all solutions");
    // The same figure with other signs, mirrored, and as a departure of its own.
    let mirrored = |set: &mut ComplexSet| {
        set.solutions.pop();
        let mut again = set.at_infinity[0].clone();
        again.rises.iter_mut().for_each(|rise| rise.reverse());
        for place in &mut again.figures[0] {
            place[1].iter_mut().for_each(|x| *x = -*x);
        }
        set.at_infinity.push(again);
    };
    is_false(refused(&set, &mirrored, "mirrored"), "is not positive");
    for k in 0..4 {
        let sign = |set: &mut ComplexSet| set.at_infinity[0].rises[k].reverse();
        is_false(refused(&set, &sign, "a sign"), "add up to zero");
        let without = |set: &mut ComplexSet| drop(set.at_infinity[0].rises.remove(k));
        is_false(refused(&set, &without, "a sign less"), "how a distance");
        let other = |set: &mut ComplexSet| set.at_infinity[0].rises[k][0] = "p4".into();
        is_false(refused(&set, &other, "another edge"), "how a distance");
    }
    let more = |set: &mut ComplexSet| {
        let again = set.at_infinity[0].rises[0].clone();
        set.at_infinity[0].rises.push(again);
    };
    is_false(refused(&set, &more, "a sign twice"), "something else");
    let exchanged = |set: &mut ComplexSet| {
        let (first, second) = set.at_infinity.split_at_mut(1);
        std::mem::swap(&mut first[0].rises, &mut second[0].rises);
    };
    is_doubt(
        refused(&twice, &exchanged, "signs exchanged"),
        "not proved to be one",
    );
    let same = |set: &mut ComplexSet| set.at_infinity[1] = set.at_infinity[0].clone();
    is_false(refused(&twice, &same, "one of two twice"), "are the same");
    // Other points.
    for (away, why) in [
        (vec!["p1"], "a fixed point goes"),
        (vec!["p4", "p1"], "a fixed point goes"),
        (vec!["p4", "p5"], "all of them have neighbours that go"),
        (vec![], "no point goes"),
    ] {
        let away: Vec<String> = away.into_iter().map(String::from).collect();
        let changed = |set: &mut ComplexSet| set.at_infinity[0].away = away.clone();
        is_doubt(refused(&set, &changed, "points"), why);
    }
    for away in [vec!["p4", "p4"], vec!["p7"]] {
        let away: Vec<String> = away.into_iter().map(String::from).collect();
        let changed = |set: &mut ComplexSet| set.at_infinity[0].away = away.clone();
        is_false(refused(&set, &changed, "no points"), "a point that goes");
    }
    // Another place.
    for p in 0..6 {
        for k in 0..3 {
            for to in [f64::MAX, -3.0] {
                let moved = |set: &mut ComplexSet| set.at_infinity[0].figures[0][p][k][0] = to;
                is_doubt(refused(&set, &moved, "moved"), "not proved to be one");
            }
            let gone = |set: &mut ComplexSet| drop(set.at_infinity[0].figures[0][p].pop());
            is_doubt(
                refused(&set, &gone, "a number less"),
                "not proved to be one",
            );
        }
    }
    let swapped = |set: &mut ComplexSet| set.at_infinity[0].figures[0].swap(0, 3);
    is_doubt(refused(&set, &swapped, "swapped"), "not proved to be one");
    // Lengths that do not add up to zero, where the figure that is not at infinity is left out.
    assert!(near.complete && near.at_infinity.is_empty() && near.solutions.len() == 8);
    assert!(verdict(&near).proves_all());
    for k in 0..8 {
        let claimed = |changed: &mut ComplexSet| {
            changed.solutions.remove(k);
            changed.at_infinity = set.at_infinity.clone();
        };
        is_false(refused(&near, &claimed, "no sum"), "add up to zero");
    }
    // In the plane.
    let plane = set_of("k33", folder.path());
    let claimed = |changed: &mut ComplexSet| changed.at_infinity = set.at_infinity.clone();
    is_doubt(refused(&plane, &claimed, "plane"), "in space only");
}

/// An octahedron with a figure at infinity, and three points more: p7 goes with p4, p8 stays with p1, and p9 is a neighbour of p4 that
/// is in no cycle, so that it may be on either side of p2.
#[test]
fn figures_at_infinity_with_more_points() {
    let folder = tempfile::tempdir().unwrap();
    let text = fs::read_to_string("problems/octahedron.toml").unwrap();
    let text = text[..text.find("[[published]]").unwrap()]
        .replace("[\"p2\", \"p6\", 1.18]", "[\"p2\", \"p6\", 1.22]")
        .replace(
            "p6 = [-0.2, -0.7, 1.3]",
            "p6 = [-0.2, -0.7, 1.3]\np7 = [1.9, 1.1, 0.9]\np8 = [0.6, 0.4, -0.9]\np9 = [0.8, -0.8, 0.7]",
        )
        .replace(
            "distances = [",
            "distances = [[\"p4\", \"p7\", 1.03], [\"p2\", \"p7\", 1.31], [\"p3\", \"p7\", 1.37], [\"p1\", \"p8\", 1.09], \
             [\"p2\", \"p8\", 0.98], [\"p3\", \"p8\", 1.27], [\"p4\", \"p9\", 1.43], [\"p2\", \"p9\", 0.83], [\"p1\", \"p9\", 1.19],",
        );
    let [file, template] = ["nine.toml", "nine.krawl-template"]
        .map(|name| folder.path().join(name).to_string_lossy().into_owned());
    fs::write(&file, text).unwrap();
    krawl()
        .args(["template", &file, "--float", "--quiet", "--out", &template])
        .assert()
        .success();
    let set = set_from(&file, &template, folder.path());
    let found = verdict(&set);
    assert_eq!(found.flaw, None);
    assert!(set.complete && found.proves_all());
    assert_eq!((found.isometry, found.rotation), (56, 112));
    assert_eq!(found.bound, Some(128));
    assert_eq!(found.at_infinity, vec![(vec![3, 6], 4); 2]);
    let refused = |change: &dyn Fn(&mut ComplexSet), why: &str| {
        let mut changed = set.clone();
        change(&mut changed);
        let found = verdict(&changed);
        assert!(!found.proves_all());
        let (ComplexFlaw::False(text) | ComplexFlaw::NotProved(text)) = found.flaw.unwrap();
        assert!(text.contains(why), "{text}, not {why}");
    };
    // The other sign of what is in no cycle makes the other departure of it.
    let hanging = |rise: &&mut [String; 2]| rise.contains(&"p9".to_owned());
    for (departure, why) in [(0, "not proved to be one"), (1, "are the same")] {
        let sign = |set: &mut ComplexSet| {
            let rises = set.at_infinity[departure].rises.iter_mut();
            rises.filter(hanging).for_each(|rise| rise.reverse());
        };
        refused(&sign, why);
    }
    let exchanged = |set: &mut ComplexSet| {
        let (one, other) = set.at_infinity.split_at_mut(1);
        std::mem::swap(&mut one[0].figures[1], &mut other[0].figures[2]);
    };
    refused(&exchanged, "not proved to be one");
    for departure in 0..2 {
        for k in 0..4 {
            let dropped = |set: &mut ComplexSet| drop(set.at_infinity[departure].figures.remove(k));
            refused(&dropped, "all solutions are claimed");
            let again = |set: &mut ComplexSet| {
                let figures = &mut set.at_infinity[departure].figures;
                figures[k] = figures[(k + 1) % 4].clone();
            };
            refused(&again, "are the same");
        }
    }
    // Other points go: their neighbours make no cycle, or two.
    let away = |points: &[&str]| {
        let points: Vec<String> = points.iter().map(|&p| p.to_owned()).collect();
        move |set: &mut ComplexSet| set.at_infinity[0].away = points.clone()
    };
    refused(&away(&["p4"]), "it is not said how a distance");
    refused(&away(&["p4", "p7", "p8"]), "all of them have neighbours");
    refused(&away(&["p9"]), "it is not said how a distance");
}

/// Lengths that nearly add up to zero, with coordinates of up to 10⁶: twice a float's digits are needed.
#[test]
fn large_solutions_are_proved() {
    let folder = tempfile::tempdir().unwrap();
    for (length, size) in [("1.22001", 1e3), ("1.2200001", 1e5), ("1.22000001", 1e6)] {
        let set = octahedron(length, folder.path());
        let parts = || set.solutions.iter().flatten().flatten();
        let largest = parts().flatten().fold(0.0, |max: f64, x| max.max(x.abs()));
        assert!(largest > size, "{length}");
        let found = verdict(&set);
        assert_eq!(found.flaw, None, "{length}");
        assert!(found.proves_all() && set.complete, "{length}");
        assert_eq!((found.isometry, found.rotation), (8, 16), "{length}");
        let doubles = parts().filter(|parts| parts.len() == 4).count();
        println!("{length}: {largest:.1e}, {doubles} numbers with low parts");
        // Where floats are not near enough, they are not all that is written.
        let floats = ComplexSet {
            solutions: set
                .solutions
                .iter()
                .map(|places| {
                    let short = |parts: &Vec<f64>| parts[..2].to_vec();
                    let place = |place: &Vec<Vec<f64>>| place.iter().map(short).collect();
                    places.iter().map(place).collect()
                })
                .collect(),
            ..set.clone()
        };
        println!("{length}: floats alone: {:?}", verdict(&floats).flaw);
        // A place that is near it only beside its size is none.
        for k in 0..set.solutions.len() {
            let mut moved = set.clone();
            moved.solutions[k]
                .iter_mut()
                .for_each(|place| place[1][0] *= 1.5);
            assert!(!verdict(&moved).proves_all(), "{length}");
        }
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
    // With figures at infinity.
    fs::write(&cert, octahedron("1.22", folder.path()).to_bytes()).unwrap();
    let (code, said) = verify(&folder.path().join("octahedron.toml").to_string_lossy());
    assert_eq!(code, 0);
    let theorem = "VERIFIED: octahedron has exactly 7 complex solutions up to isometry";
    assert!(said.starts_with(theorem), "{said}");
    let reason = "and no other isolated one: the multi-homogeneous Bézout bound of the graph is 16, of which 2 are at infinity: \
                  1 figure where p4 goes away, up to isometry.";
    assert!(said.contains(reason), "{said}");
    let mut fewer = set;
    fewer.solutions.pop();
    fs::write(&cert, fewer.to_bytes()).unwrap();
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

/// With other constraints than distances solutions are told by all unknowns of the paths' equations, also those that were found in a
/// frame of three lines.
#[test]
fn sets_of_other_constraints_are_proved() {
    let folder = tempfile::tempdir().unwrap();
    for (name, count, real) in [
        ("constraints/3p3l-orthogonal", 120, 4),
        ("constraints/3p3l", 480, 16),
        ("constraints/pentahedron", 34, 9),
        ("mechanisms/dietmaier", 40, 40),
    ] {
        let set = set_of(name, folder.path());
        let verdict = verdict(&set);
        assert_eq!(verdict.flaw, None, "{name}");
        assert_eq!((verdict.isometry, verdict.real), (count, real), "{name}");
        assert!(verdict.is_general && !verdict.proves_all());
        assert_eq!(set.unknowns.len(), count);
        let problem = Problem::read(format!("problems/{name}.toml")).unwrap();
        assert!(verdict.is_about(&problem));
    }
}

#[test]
fn false_sets_of_other_constraints_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let set = set_of("constraints/3p3l-orthogonal", folder.path());
    let is_false = |set: &ComplexSet| matches!(verdict(set).flaw, Some(ComplexFlaw::False(_)));
    let is_unproved =
        |set: &ComplexSet| matches!(verdict(set).flaw, Some(ComplexFlaw::NotProved(_)));
    let with = |change: &dyn Fn(&mut ComplexSet)| {
        let mut other = set.clone();
        change(&mut other);
        other
    };
    // One twice, as it is and as its mirror image: the reference is in a plane, and a line's direction may be reversed.
    assert!(is_false(&with(&|set| set
        .unknowns
        .push(set.unknowns[0].clone()))));
    let problem = Problem::parse(&set.problem, "set").unwrap();
    let homotopy = krawl::system::Homotopy::new(&problem).unwrap();
    let mirrored = with(&|set| {
        let mut image = set.unknowns[3].clone();
        for (k, number) in image.iter_mut().enumerate() {
            if homotopy.flips(k, 2) {
                number.iter_mut().for_each(|part| *part = -*part);
            }
        }
        assert_ne!(image, set.unknowns[3]);
        set.unknowns.push(image);
    });
    assert!(is_false(&mirrored));
    // Moved, cut off, of another problem, with more claims than are defined.
    assert!(is_unproved(&with(&|set| set.unknowns[7][0][0] += 0.01)));
    assert!(is_unproved(&with(&|set| set.unknowns[7][5][1] += 1e-4)));
    assert!(is_unproved(&with(&|set| drop(set.unknowns[7].pop()))));
    assert!(is_unproved(&with(&|set| set.unknowns[7][2].clear())));
    assert!(is_unproved(&with(
        &|set| set.problem = set.problem.replace("2.14", "2.24")
    )));
    assert!(is_unproved(&with(&|set| set.complete = true)));
    assert!(is_unproved(&with(&|set| set.fixed.push("p1".to_owned()))));
    // As many as are cited, or fewer, may be there; not more.
    let cited = |cited: u64| with(&|set| set.cited = Some(cited));
    assert!(is_false(&cited(119)));
    assert_eq!(verdict(&cited(120)).cited, Some(120));
    let more = verdict(&cited(121));
    assert_eq!((more.flaw, more.cited), (None, None));
    // One that is left out leaves a set that is true.
    assert_eq!(
        verdict(&with(&|set| drop(set.unknowns.pop()))).isometry,
        119
    );
    // Distances are told by places.
    let mut distances = set_of("octahedron", folder.path());
    distances.unknowns = set.unknowns.clone();
    assert!(is_unproved(&distances));
}

/// A set is about a problem however that writes a length: `squared_distances` before `distances` are the same, and another sketch, of which
/// sides and senses are read, is not.
#[test]
fn sets_of_other_constraints_are_about_their_problem() {
    let file = fs::read_to_string("problems/constraints/pentahedron.toml").unwrap();
    let squared = file
        .replace(
            "[constraints]\n",
            "[constraints]\nsquared_distances = [[\"p2\", \"p4\", 6.76]]\n",
        )
        .replace("    [\"p2\", \"p4\", 2.6],\n", "");
    let moved = file.replace("p5 = [0.5, 0.5, 0.4]", "p5 = [0.5, 0.5, 0.5]");
    assert!(squared.len() > file.len() && moved != file);
    let problems = [squared, file, moved].map(|text| Problem::parse(&text, "file").unwrap());
    let set = ComplexSet {
        problem: problems[0].to_toml(),
        fixed: Vec::new(),
        solutions: Vec::new(),
        unknowns: Vec::new(),
        cited: None,
        at_infinity: Vec::new(),
        complete: false,
    };
    let verdict = verdict(&set);
    assert_eq!(verdict.flaw, None);
    let about = problems.map(|problem| verdict.is_about(&problem));
    assert_eq!(about, [true, false, false]);
}

/// Between lines angles have the sense of the sketch: three lines of which any two have 80° between them, where directions can be
/// given all three of which have acute angles, and where they cannot, are different.
#[test]
fn three_lines_have_the_angles_of_the_sketch() {
    let text = fs::read_to_string("problems/constraints/3p3l.toml").unwrap();
    let old = "direction = [-0.9, 0.9, -0.9] }";
    assert!(text.contains(old));
    let angles = |text: &str| {
        text.replace(
            r#"[["l1", "l2", 8], ["l1", "l3", 88], ["l2", "l3", 86]]"#,
            r#"[["l1", "l2", 70], ["l1", "l3", 75], ["l2", "l3", 80]]"#,
        )
    };
    let mut parities = Vec::new();
    for direction in ["[-0.9, 0.9, -0.9]", "[-0.9, 0.9, 0.9]", "[0.9, 0.1, -0.1]"] {
        let text = angles(&text).replace(old, &format!("direction = {direction} }}"));
        let problem = Problem::parse(&text, "lines.toml").unwrap();
        let lowered = krawl::complex::lower(&problem).unwrap();
        let filling = krawl::complex::Filling {
            patience: 1,
            enough: Some(8),
            ..krawl::complex::Filling::default()
        };
        let fibre = krawl::complex::fill(&lowered.system, &filling).unwrap();
        let template = krawl::complex::Template::new("lines", fibre);
        let solutions =
            krawl::complex::solve(&lowered, &template, &krawl::complex::Ways::default());
        let set = krawl::complex::to_certificate(&problem, &lowered, &solutions).unwrap();
        // The checker has the equations of paths, whatever frame solutions were found in.
        let verdict = verdict(&set);
        assert_eq!(verdict.flaw, None, "{direction}");
        assert!(verdict.isometry > 0, "{direction}");
        let seen = |a: usize, b: usize| {
            let along = |k: usize| match &problem.objects[k].shape {
                krawl::problem::Shape::FreeLine { direction, .. } => {
                    direction.each_ref().map(|x| x.to_f64())
                }
                _ => panic!("three lines"),
            };
            let (u, v) = (along(a), along(b));
            (0..3).map(|k| u[k] * v[k]).sum::<f64>() < 0.0
        };
        parities.push(seen(0, 1) ^ seen(0, 2) ^ seen(1, 2));
    }
    assert!(
        parities.contains(&true) && parities.contains(&false),
        "{parities:?}"
    );
}

/// The unknowns of the one figure of three lines of their own, e, f and g, with signs for the directions of the lines and for the mirror
/// image. f is at a right angle to e, and g is because the angle of e and g is said to be that of e and f.
fn lines_with_directions([e, f, g, mirror]: [f64; 4]) -> Vec<Vec<f64>> {
    let (first, third) = (1.01f64.sqrt(), 1.25f64.sqrt());
    let x = 1.59375;
    let y = mirror * f64::sqrt(9.0 - x * x);
    let unknowns = [
        [4.0, x, y, 0.0, 0.0, e * first, 0.0],
        [x, 0.0, 0.0, f * first, 4.0, 0.0, 0.0],
        [
            g * third,
            first,
            first,
            first * first,
            0.0,
            third,
            first * third,
        ],
    ];
    let all = unknowns.iter().flatten().chain(&[0.0]);
    all.map(|&x| vec![x, 0.0]).collect()
}

#[test]
fn a_line_is_the_same_the_other_way_round() {
    let problem = r#"name = "N"
dimension = 2
[points]
a = [0, 0]
b = [4, 0]
c = [1, 3]
[lines]
e = { point = [0.1, 0.1], direction = [1, 0.1] }
f = { point = [1.2, 1], direction = [0.1, 1] }
g = { point = [4.1, 0.5], direction = [-0.2, 1.1] }
[constraints]
distances = [["a","b",4],["a","c",3],["b","c",3.5]]
on = [["a","e"],["b","e"],["c","f"],["b","g"]]
perpendicular = [["e","f"]]
equal_angles = [["e","f","e","g"]]
"#;
    let set = |all: &[[f64; 4]]| ComplexSet {
        problem: problem.to_owned(),
        fixed: Vec::new(),
        solutions: Vec::new(),
        unknowns: all
            .iter()
            .map(|&signs| lines_with_directions(signs))
            .collect(),
        cited: None,
        at_infinity: Vec::new(),
        complete: false,
    };
    let one = verdict(&set(&[[1.0; 4]]));
    assert_eq!((one.flaw, one.isometry, one.real), (None, 1, 1));
    // Each is the same figure, or its mirror image.
    for mask in 1..16 {
        let other = [0, 1, 2, 3].map(|k| if mask >> k & 1 == 1 { -1.0 } else { 1.0 });
        let two = verdict(&set(&[[1.0; 4], other]));
        assert!(
            matches!(two.flaw, Some(ComplexFlaw::False(_))),
            "{other:?}: {:?}",
            two.flaw
        );
    }
}

/// What `krawl complex` says of a file, and the verdict of its certificate, if it leaves one.
fn counted(text: &str, folder: &Path) -> (serde_json::Value, Option<ComplexVerdict>) {
    let (file, cert) = (folder.join("problem.toml"), folder.join("set.krawl"));
    let _ = fs::remove_file(&cert);
    fs::write(&file, text).unwrap();
    let out = krawl()
        .arg("complex")
        .arg(&file)
        .args(["--float", "--quiet", "--json", "-", "--cert"])
        .arg(&cert)
        .output()
        .unwrap();
    let json = serde_json::from_slice(&out.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&out.stderr)));
    let set = fs::read(cert).ok();
    (json, set.map(|set| verify_complex_set(&set).unwrap()))
}

/// A plane of its own is the same with its normal reversed; three points in space are their own mirror image, turned over.
#[test]
fn figures_that_are_the_same_seen_otherwise_count_once() {
    let plane = r#"
        name = "a plane of its own"
        dimension = 3
        [points]
        a = [0, 0, 0]
        b = [4, 0, 0]
        c = [1, 3, 0]
        d = [1, 1, 3]
        [planes]
        e = { point = [0.3, 0.2, 1], normal = [0.1, 0.2, 1] }
        [constraints]
        distances = [["a","b",4],["a","c",3],["b","c",3.5],["a","d",3],["b","d",4],["c","d",3.2]]
        on = [["a","e"],["b","e"],["d","e"]]
    "#;
    let three_points = |constraints: &str| {
        format!(
            r#"
            name = "three points in space"
            dimension = 3
            [points]
            a = [0, 0, 0]
            b = [4, 0, 0]
            c = [1, 3, 0]
            [constraints]
            {constraints}
            "#
        )
    };
    let angle = three_points(
        r#"distances = [["a","b",4],["b","c",3]]
           angles = [["a","b","c",70]]"#,
    );
    let no_triangle = three_points(r#"distances = [["a","b",1],["b","c",1],["a","c",3]]"#);
    let folder = tempfile::tempdir().unwrap();
    for (text, isometry, rotation, real) in
        [(plane, 1, 2, 1), (&angle, 1, 1, 1), (&no_triangle, 1, 1, 0)]
    {
        let (json, verdict) = counted(text, folder.path());
        let counts = &json["counts"];
        assert_eq!(counts["isometry"], isometry, "{text}");
        assert_eq!(counts["rotation"], rotation, "{text}");
        assert_eq!(json["real"].as_array().unwrap().len(), real, "{text}");
        // Of lengths of no real triangle there is no certificate.
        assert_eq!(verdict.is_some(), real > 0);
        if let Some(verdict) = verdict {
            assert_eq!(verdict.flaw, None, "{text}");
            assert_eq!((verdict.isometry, verdict.real), (isometry, real));
        }
    }
}

/// Where c is at d there is no line through both to be at a right angle to another one, and the equations hold.
#[test]
fn solutions_that_are_no_figures_are_told() {
    let kite = r#"
        name = "kite"
        dimension = 2
        [points]
        a = [0, 0]
        b = [4, 0.1]
        c = [1.9, 2.2]
        d = [2.1, -2.3]
        [constraints]
        distances = [["a","b",4],["a","c",3],["b","c",3.5],["a","d",3]]
        perpendicular = [["a","b","c","d"]]
    "#;
    let folder = tempfile::tempdir().unwrap();
    let (json, verdict) = counted(kite, folder.path());
    let solutions = json["solutions"].as_array().unwrap();
    let vanishing = solutions.iter().map(|s| s["vanishing"].as_array().unwrap());
    let mut vanishing: Vec<usize> = vanishing.map(Vec::len).collect();
    vanishing.sort_unstable();
    assert_eq!(vanishing, [0, 1]);
    let verdict = verdict.unwrap();
    assert_eq!((verdict.flaw, verdict.isometry), (None, 2));
    let out = krawl()
        .arg("complex")
        .arg(folder.path().join("problem.toml"))
        .arg("--float")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&out.stdout);
    assert!(
        text.contains("1 of them (1 of the real ones) is no figure"),
        "{text}"
    );
}
