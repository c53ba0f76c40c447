//! Linkages drawn bar by bar, as in CAD programs: each bar with two ends of its own, and ends of bars put in one place. Sets of their
//! figures take no more than where each pin is one point.

use crate::common::covers::proved;
use krawl::complete::{Options, Status, all};
use krawl::problem::Problem;
use std::fmt::Write;

/// The bars of a leg of Jansen's walking machine, with their lengths: O and F are fixed, M is the crank's pin, T the foot.
const BARS: [(&str, &str, f64); 11] = [
    ("O", "M", 15.0),
    ("M", "U", 50.0),
    ("F", "U", 41.5),
    ("U", "W", 55.8),
    ("F", "W", 40.1),
    ("M", "L", 61.9),
    ("F", "L", 39.3),
    ("W", "K", 39.4),
    ("L", "K", 36.7),
    ("K", "T", 65.7),
    ("L", "T", 49.0),
];

/// Where the pins are in the sketch.
const PINS: [(&str, [f64; 2]); 8] = [
    ("O", [0.0, 0.0]),
    ("F", [-38.0, -7.8]),
    ("M", [1.36, -14.94]),
    ("U", [-20.71, 29.93]),
    ("W", [-73.29, 11.24]),
    ("L", [-53.3, -44.0]),
    ("K", [-85.41, -26.25]),
    ("T", [-69.92, -90.09]),
];

/// Where the foot is above or below.
const FOOT: f64 = -60.0;

fn place(pin: &str) -> [f64; 2] {
    PINS.iter().find(|(name, _)| *name == pin).unwrap().1
}

/// The leg with the foot below a mark: pin by pin, or bar by bar.
fn leg(is_bar_by_bar: bool) -> Problem {
    let (mut points, mut distances) = (String::new(), Vec::new());
    let mut ends: Vec<(&str, String)> = Vec::new();
    let mut add = |name: &str, [x, y]: [f64; 2]| writeln!(points, "{name} = [{x}, {y}]").unwrap();
    add("N", [FOOT, 0.0]);
    for (pin, at) in PINS {
        if !is_bar_by_bar || ["O", "F"].contains(&pin) {
            add(pin, at);
        }
    }
    for (bar, (a, b, length)) in BARS.iter().enumerate() {
        let own = [a, b].map(|&pin| match is_bar_by_bar {
            true => {
                let end = format!("{pin}{bar}");
                add(&end, place(pin));
                ends.push((pin, end.clone()));
                end
            }
            false => pin.to_owned(),
        });
        distances.push(format!(r#"["{}", "{}", {length}]"#, own[0], own[1]));
    }
    let together = PINS.iter().filter_map(|&(pin, _)| {
        let own = ends.iter().filter(|(of, _)| *of == pin);
        let fixed = ["O", "F"].contains(&pin).then(|| pin.to_owned());
        let names: Vec<String> = fixed
            .into_iter()
            .chain(own.map(|(_, end)| end.clone()))
            .collect();
        (names.len() > 1).then(|| format!(r#"["{}"]"#, names.join(r#"", ""#)))
    });
    let together: Vec<String> = together.collect();
    let foot = if is_bar_by_bar { "T9" } else { "T" };
    let together = match is_bar_by_bar {
        true => format!("coincident = [{}]\n", together.join(", ")),
        false => String::new(),
    };
    let text = format!(
        "name = \"leg\"\ndimension = 2\n[points]\n{points}[constraints]\nfixed = [\"O\", \"F\", \"N\"]\n\
         vertical = [[\"N\", \"{foot}\"]]\n{together}distances = [{}]\n",
        distances.join(", ")
    );
    Problem::parse(&text, "leg.toml").unwrap()
}

/// The two points at these distances from two others.
fn meet([p, r]: [[f64; 2]; 2], [a, b]: [f64; 2]) -> Option<[[f64; 2]; 2]> {
    let [x, y] = [r[0] - p[0], r[1] - p[1]];
    let square = x * x + y * y;
    let along = (a * a - b * b + square) / (2.0 * square);
    let across = (a * a / square - along * along).sqrt();
    (!across.is_nan())
        .then(|| [across, -across].map(|h| [p[0] + along * x - h * y, p[1] + along * y + h * x]))
}

/// How often the foot passes below the mark while the crank turns once, whatever the other bars do: for every angle of the crank and
/// every choice of sides.
fn passes(steps: usize) -> usize {
    let foot = |angle: f64, sides: usize| -> Option<f64> {
        let side = |k: usize| sides >> k & 1;
        let fixed = place("F");
        let m = [15.0 * angle.cos(), 15.0 * angle.sin()];
        let u = meet([m, fixed], [50.0, 41.5])?[side(0)];
        let w = meet([u, fixed], [55.8, 40.1])?[side(1)];
        let l = meet([m, fixed], [61.9, 39.3])?[side(2)];
        let k = meet([w, l], [39.4, 36.7])?[side(3)];
        Some(meet([k, l], [65.7, 49.0])?[side(4)][0] - FOOT)
    };
    let angle = |step: usize| std::f64::consts::TAU * step as f64 / steps as f64;
    let each = (0..32).map(|sides| {
        let goes_by = |step: &usize| {
            let both = foot(angle(*step), sides).zip(foot(angle(step + 1), sides));
            both.is_some_and(|(a, b)| (a < 0.0) != (b < 0.0))
        };
        (0..steps).filter(goes_by).count()
    });
    each.sum()
}

#[test]
fn a_leg_drawn_bar_by_bar_has_the_figures_of_one_drawn_pin_by_pin() {
    let counts = [false, true].map(|is_bar_by_bar| {
        let result = all(&leg(is_bar_by_bar), &Options::default()).unwrap();
        assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
        println!("{} figures, {} parts", result.solutions.len(), result.boxes);
        (result.solutions.len(), result.boxes)
    });
    let [pins, bars] = counts;
    assert_eq!(pins.0, bars.0);
    // The same equations but for names.
    assert!(
        bars.1 < 2 * pins.1,
        "{} parts, {} pin by pin",
        bars.1,
        pins.1
    );
    let passes = [20_001, 80_021].map(passes);
    assert_eq!(passes, [pins.0, pins.0]);
}

#[test]
fn a_leg_drawn_bar_by_bar_is_proved_by_its_cover() {
    proved(&leg(true));
}

/// Dietmaier's platform, each of its legs a bar with ends of its own.
#[test]
fn a_platform_on_legs_drawn_bar_by_bar_has_its_forty_figures() {
    let text = std::fs::read_to_string("problems/mechanisms/dietmaier.toml").unwrap();
    let shipped = Problem::parse(&text, "dietmaier.toml").unwrap();
    let (mut points, mut together) = (String::new(), Vec::new());
    for point in &shipped.points {
        let [x, y, z] = point.sketch.each_ref().map(|x| x.to_f64());
        writeln!(points, "end-{} = [{x}, {y}, {z}]", point.name).unwrap();
        together.push(format!(r#"["{0}", "end-{0}"]"#, point.name));
    }
    let text = text.replace("\n[bodies]", &format!("{points}\n[bodies]"));
    let (before, distances) = text.split_once("distances =").unwrap();
    let distances = distances
        .replace("\"A", "\"end-A")
        .replace("\"B", "\"end-B");
    let text = format!(
        "{before}coincident = [{}]\ndistances ={distances}",
        together.join(", ")
    );
    let problem = Problem::parse(&text, "bars.toml").unwrap();
    assert_eq!(problem.distance_name(0), "end-A1-end-B1");
    let (result, _) = proved(&problem);
    assert_eq!(
        (result.solutions.len(), result.turned),
        (40, vec!["platform".to_owned()])
    );
}
