//! Torsions with their sign: against angles computed in floats from the figures.

use krawl::certificate::cover::verify_cover;
use krawl::complete::{Options, Status, all};
use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::Control;

/// A chain of carbon atoms, bonds of 1.54 at 112 degrees, with these torsions.
fn chain(torsions: &[f64]) -> String {
    let places = [
        "0, 0, 0",
        "1.5, 0.1, 0",
        "2.0, 1.5, 0.2",
        "3.4, 1.6, 0.8",
        "4.1, 2.9, 0.5",
    ];
    let count = torsions.len() + 3;
    let mut text = "name = \"chain\"\ndimension = 3\n[points]\n".to_owned();
    for (k, place) in places.iter().enumerate().take(count) {
        text += &format!("c{k} = [{place}]\n");
    }
    text += "[constraints]\n";
    let list = |key: &str, each: &dyn Fn(usize) -> String, count: usize| {
        let all: Vec<String> = (0..count).map(each).collect();
        format!("{key} = [{}]\n", all.join(", "))
    };
    text += &list(
        "distances",
        &|k| format!("[\"c{k}\", \"c{}\", 1.54]", k + 1),
        count - 1,
    );
    let angle = |k: usize| format!("[\"c{k}\", \"c{}\", \"c{}\", 112]", k + 1, k + 2);
    text += &list("angles", &angle, count - 2);
    let torsion = |k: usize| {
        let [a, b, c] = [1, 2, 3].map(|step| k + step);
        format!("[\"c{k}\", \"c{a}\", \"c{b}\", \"c{c}\", {}]", torsions[k])
    };
    text + &list("torsions", &torsion, count - 3)
}

fn parsed(torsions: &[f64]) -> Problem {
    Problem::parse(&chain(torsions), "chain.toml").unwrap()
}

/// The torsion of four points in a row, in degrees, by the formula of the textbooks: the turn of one half plane into the other, measured
/// in coordinates across the axis.
fn torsion(figure: &[[f64; 3]]) -> f64 {
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|k| a[k] - b[k]);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let cross =
        |a: [f64; 3], b: [f64; 3]| [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i]);
    let axis = minus(figure[2], figure[1]);
    let axis = axis.map(|x| x / dot(axis, axis).sqrt());
    let across = |v: [f64; 3]| {
        let along = dot(v, axis);
        [0, 1, 2].map(|k| v[k] - along * axis[k])
    };
    let (from, to) = (
        across(minus(figure[0], figure[1])),
        across(minus(figure[3], figure[2])),
    );
    dot(axis, cross(from, to)).atan2(dot(from, to)).to_degrees()
}

fn near(one: f64, other: f64) -> bool {
    ((one - other + 180.0).rem_euclid(360.0) - 180.0).abs() < 1e-9
}

#[test]
fn one_figure_for_each_choice_of_signs() {
    let options = Options {
        cover: true,
        ..Options::default()
    };
    for torsions in [[-60.0, 170.0], [60.0, -65.0], [180.0, 250.0]] {
        let result = all(&parsed(&torsions), &options).unwrap();
        assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
        let [figure] = &result.solutions[..] else {
            panic!("{torsions:?}: {} figures", result.solutions.len())
        };
        let middles: Vec<[f64; 3]> = figure.points.iter().map(|p| p.map(|x| x.mid())).collect();
        for (k, wanted) in torsions.into_iter().enumerate() {
            let found = torsion(&middles[k..]);
            assert!(near(found, wanted), "{torsions:?}: {found}");
        }
        let verdict = verify_cover(&result.cover.unwrap()).unwrap();
        assert_eq!((verdict.undecided, verdict.flaw), (0, None));
    }
}

#[test]
fn a_torsion_turns_all_the_way_round() {
    let mut session = Session::open(&parsed(&[-60.0])).unwrap();
    let index = Setting::find(session.problem(), "torsions:c0-c1-c2-c3").unwrap();
    let ends = ["-60", "300"].map(|value| value.parse().unwrap());
    let sweep = session.sweep(index, (&ends[0], &ends[1]), 37, &mut Control::default());
    assert!(sweep.end.is_none());
    let figure = |k: usize| -> Vec<[f64; 3]> {
        sweep.frames[k]
            .points
            .iter()
            .map(|p| p.map(|x| x.mid()))
            .collect()
    };
    for k in 0..37 {
        let wanted = -60.0 + 10.0 * k as f64;
        let found = torsion(&figure(k));
        assert!(near(found, wanted), "{wanted}: {found}");
    }
    for (one, other) in figure(0).iter().flatten().zip(figure(36).iter().flatten()) {
        assert!((one - other).abs() < 1e-9);
    }
    let setting = Setting::parse(session.problem(), "torsions:c0-c1-c2-c3=-100").unwrap();
    assert_eq!(session.edit(&[setting]).ending, Ending::Reached);
}

#[test]
fn what_has_no_torsion_is_refused() {
    let refused = |text: &str, words: &str| {
        let message = Problem::parse(text, "chain.toml").unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    let text = chain(&[-60.0]);
    refused(
        &text.replace("2.0, 1.5, 0.2", "3.0, 0.2, 0"),
        "the points are on one line in the sketch",
    );
    refused(
        &text.replace("\"c1\", \"c2\", \"c3\", -60", "\"c1\", \"c2\", \"c0\", -60"),
        "the first and the last",
    );
    let flat = "name = \"flat\"\ndimension = 2\n[points]\na = [0, 0]\nb = [1, 0]\nc = [1, 1]\nd = [0, 2]\n[constraints]\n\
                distances = [[\"a\", \"b\", 1], [\"b\", \"c\", 1], [\"c\", \"d\", 1], [\"a\", \"c\", 1]]\n\
                torsions = [[\"a\", \"b\", \"c\", \"d\", 20]]\n";
    refused(flat, "say `turns`");
}
