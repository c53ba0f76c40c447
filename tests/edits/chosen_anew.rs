//! Sketches that are loose or have more constraints than unknowns, past where the equations chosen first are singular.

use crate::common::edits::Random;
use krawl::blocks::Verdict;
use krawl::edit::{End, Ending, Session, Setting};
use krawl::problem::Problem;
use krawl::track::Control;

fn session(text: &str) -> (Problem, Session) {
    let problem = Problem::parse_loosely(text, "test").unwrap();
    let session = Session::open(&problem).unwrap();
    (problem, session)
}

fn apart(points: &[[krawl::interval::Interval; 3]], a: usize, b: usize) -> f64 {
    let square = |k: usize| (points[a][k].mid() - points[b][k].mid()).powi(2);
    (0..3).map(square).sum::<f64>().sqrt()
}

const ARM: &str = "dimension = 2\n[points]\nA = [0, 0]\nB = [0.8, 0.6]\nC = [1.5, 1.2]\nD = [2.2, 0.5]\n[constraints]\n\
                   fixed = [\"A\"]\ndistances = [[\"A\", \"B\", 1], [\"B\", \"C\", 1], [\"C\", \"D\", 1], [\"A\", \"D\", 2.3]]\n";

/// Three bars of length 1 in a chain reach from 0 to 3, whatever is held at first.
#[test]
fn an_arm_reaches_as_far_as_it_is_long() {
    let (problem, mut session) = session(ARM);
    let index = Setting::find(&problem, "A-D").unwrap();
    let range = session.range(index, &mut Control::default());
    let (low, high) = (range.low.value(), range.high.value());
    assert!(low.sup() < 0.01 && low.inf() > 0.0, "{low:?}");
    assert!(high.inf() > 2.99 && high.sup() <= 3.0 + 1e-12, "{high:?}");
    assert!(range.account.chosen_anew > 0 && !range.account.held.is_empty());
    // The bars are as long as they were in what is printed.
    for figure in [&range.low_figure, &range.high_figure] {
        for (a, b) in [(0, 1), (1, 2), (2, 3)] {
            assert!((apart(figure, a, b) - 1.0).abs() < 1e-9);
        }
    }
}

/// What is left out counts as met within a tolerance: figures go beyond what the others would allow, so nothing is said of that.
#[test]
fn what_is_left_out_bounds_nothing() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [4, 0]\nC = [4, 3]\nD = [0, 3]\n[constraints]\n\
                distances = [[\"A\", \"B\", 4], [\"B\", \"C\", 3], [\"C\", \"D\", 4], [\"D\", \"A\", 3], \
                [\"A\", \"C\", 5], [\"B\", \"D\", 5]]\n";
    let (problem, mut session) = session(text);
    let index = Setting::find(&problem, "A-B").unwrap();
    let range = session.range(index, &mut Control::default());
    assert!(!range.account.left_out.is_empty());
    assert_eq!(range.reach, [None, None]);
}

/// A distance goes by the names of its points, whatever else is between these; what has no distance needs its kind in front only
/// where there are two.
#[test]
fn a_name_without_a_kind_is_a_distance() {
    let text = "dimension = 2\n[points]\nA = [0, 0]\nB = [3, 1]\nC = [3, 4]\n[constraints]\n\
                distances = [[\"A\", \"B\", 3.2]]\ndx = [[\"A\", \"B\", 3], [\"A\", \"C\", 3]]\ndy = [[\"A\", \"B\", 1]]\n";
    let problem = Problem::parse_loosely(text, "test").unwrap();
    let find = |name: &str| Setting::find(&problem, name);
    assert_eq!((find("A-B").unwrap(), find("B-A").unwrap()), (0, 0));
    assert_eq!((find("dx:A-B").unwrap(), find("A-C").unwrap()), (1, 2));
    assert_eq!(find("dy:A-B").unwrap(), 3);
}

/// A figure is never claimed for a value that no figure has.
#[test]
fn an_arm_does_not_reach_further() {
    let (problem, mut session) = session(ARM);
    let edited = session.edit(&[Setting::parse(&problem, "A-D=3.0001").unwrap()]);
    assert_ne!(edited.ending, Ending::Reached);
    assert!(edited.dimensions[0].value.inf() <= 3.0);
    let edited = session.edit(&[Setting::parse(&problem, "A-D=2.9").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    assert!((apart(&edited.points, 0, 3) - 2.9).abs() < 1e-12);
    assert!((apart(&edited.points, 1, 2) - 1.0).abs() < 1e-12);
    // And from there back: the session's figure is the one that was reached.
    let edited = session.edit(&[Setting::parse(&problem, "A-D=2.3").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
}

/// A and B are held by nothing but their distance, whatever their heights are in the sketch.
#[test]
fn a_loose_distance_goes_below_what_is_held_at_first() {
    let (problem, mut session) = session(
        "dimension = 2\n[points]\nA = [0, 0]\nB = [41, 1]\nC = [40, 22]\n[constraints]\ndy = [[\"B\", \"C\", 21]]\n\
         distances = [[\"A\", \"B\", 41]]\n",
    );
    let edited = session.edit(&[Setting::parse(&problem, "A-B=0.5").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached, "{edited:?}");
    assert!((apart(&edited.points, 0, 1) - 0.5).abs() < 1e-12);
    assert!((edited.points[2][1].mid() - edited.points[1][1].mid() - 21.0).abs() < 1e-12);
    assert!(edited.account.chosen_anew > 0);
    assert!(
        edited
            .switched_on
            .iter()
            .any(|text| text.contains("other coordinates held"))
    );
}

/// Three equal parallel cranks and a coupler. In the equations of two of them branches meet at a dead centre, in all three
/// together it is a limit.
#[test]
fn a_third_crank_leads_past_where_two_are_singular() {
    let (problem, mut session) = session(
        "dimension = 2\n[points]\nA1 = [0, 0]\nA2 = [4, 0]\nA3 = [9, 1]\nB1 = [1.2, 1.6]\nB2 = [5.2, 1.6]\nB3 = [10.2, 2.6]\n\
         [bodies]\ncoupler = { B1 = [0, 0], B2 = [4, 0], B3 = [9, 1] }\n[constraints]\nfixed = [\"A1\", \"A2\", \"A3\"]\n\
         distances = [[\"A1\", \"B1\", 2], [\"A2\", \"B2\", 2], [\"A3\", \"B3\", 2], [\"A2\", \"B1\", 3.2249]]\n",
    );
    let index = Setting::find(&problem, "A2-B1").unwrap();
    let range = session.range(index, &mut Control::default());
    let End::Limit(high, _) = range.high else {
        panic!("{:?}", range.high)
    };
    assert!(high.contains(6.0) && high.wid() < 1e-6, "{high:?}");
}

/// What is fixed stays where it is exactly; a distance is left out, the one written last.
#[test]
fn anchors_stay() {
    let (problem, mut session) = session(
        "dimension = 2\n[points]\na = [0, 0]\nb = [10, 0]\nc = [0, 10]\np = [3, 4]\n[constraints]\n\
         fixed = [\"a\", \"b\", \"c\"]\n\
         distances = [[\"a\", \"p\", 5], [\"b\", \"p\", 8.062258], [\"c\", \"p\", 6.708204]]\n",
    );
    let edited = session.edit(&[Setting::parse(&problem, "a-p=5.0").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    for (point, place) in [(0, [0.0, 0.0]), (1, [10.0, 0.0]), (2, [0.0, 10.0])] {
        for (own, at) in edited.points[point].iter().zip(place) {
            assert!(own.contains(at) && own.wid() < 1e-14, "{own:?}");
        }
    }
    assert_eq!(edited.account.names_left_out(), ["`c-p`"]);
}

/// Chains of two to five bars, fixed at one end: their reach is from zero, or what the longest bar leaves, to the sum of the lengths. What is
/// printed of them is within that, every figure meets all lengths, and most limits are near the true ones whatever is held.
#[test]
fn chains_reach_no_further_than_they_are_long() {
    let mut random = Random(43);
    let (mut near, mut all) = (0, 0);
    for _ in 0..40 {
        let bars = 2 + random.below(4);
        let lengths: Vec<String> = (0..bars)
            .map(|_| format!("{:.2}", random.between(0.5, 2.0)))
            .collect();
        let number: Vec<f64> = lengths.iter().map(|text| text.parse().unwrap()).collect();
        let (mut points, mut distances) = ("p0 = [0, 0]\n".to_owned(), String::new());
        let mut at = [0.0, 0.0];
        for (k, length) in number.iter().enumerate() {
            let turn = random.between(-3.0, 3.0);
            at = [
                at[0] + length * f64::cos(turn),
                at[1] + length * f64::sin(turn),
            ];
            points += &format!("p{} = [{:.12}, {:.12}]\n", k + 1, at[0], at[1]);
            distances += &format!("[\"p{k}\", \"p{}\", {}], ", k + 1, lengths[k]);
        }
        let reach = at[0].hypot(at[1]);
        let text = format!(
            "dimension = 2\n[points]\n{points}[constraints]\nfixed = [\"p0\"]\n\
             distances = [{distances}[\"p0\", \"p{bars}\", {reach:.12}]]\n"
        );
        let problem = Problem::parse_loosely(&text, "chain").unwrap();
        let Ok(mut session) = Session::open(&problem) else {
            panic!("{text}");
        };
        let index = Setting::find(&problem, &format!("p0-p{bars}")).unwrap();
        let range = session.range(index, &mut Control::default());
        let most: f64 = number.iter().sum();
        let least = number
            .iter()
            .fold(0.0, |least: f64, x| least.max(2.0 * x - most));
        let (low, high) = (range.low.value(), range.high.value());
        assert!(
            low.sup() >= least - 1e-9 && low.inf() > 0.0,
            "{low:?} {text}"
        );
        assert!(high.inf() <= most + 1e-9, "{high:?} {text}");
        // That none goes further is said whatever is held.
        let bounds = range
            .reach
            .each_ref()
            .map(|one| one.as_ref().map(|r| r.bound));
        let is_near = |bound: krawl::interval::Interval, x: f64| (bound.mid() - x).abs() < 1e-12;
        assert!(is_near(bounds[1].unwrap(), most), "{bounds:?} {text}");
        let is_told = match bounds[0] {
            Some(bound) => is_near(bound, least),
            None => least < 1e-12,
        };
        assert!(is_told, "{bounds:?} {text}");
        for (figure, value) in [(&range.low_figure, low), (&range.high_figure, high)] {
            for (k, length) in number.iter().enumerate() {
                assert!((apart(figure, k, k + 1) - length).abs() < 1e-9, "{text}");
            }
            let is_known =
                !matches!(&range.low, End::Unknown(..)) && !matches!(&range.high, End::Unknown(..));
            assert!(
                !is_known || (apart(figure, 0, bars) - value.mid()).abs() < 1e-7,
                "{text}"
            );
        }
        all += 1;
        near += usize::from(high.inf() > 0.99 * most);
    }
    println!("{near} of {all} reach 99 % of their length");
    assert!(
        4 * near >= 3 * all,
        "{near} of {all} reach 99 % of their length"
    );
}

/// A point measured from more anchors than it needs, each distance rounded to three digits, one of them changed: what was left out is
/// within what is said of it, by the figure's own coordinates, and nothing is reached that misses a distance by more than its last digit.
#[test]
fn distances_to_spare_are_met_within_what_is_said() {
    let mut random = Random(44);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..60 {
        let anchors = 3 + random.below(3);
        let place =
            |random: &mut Random| [random.between(-10.0, 10.0), random.between(-10.0, 10.0)];
        let p = place(&mut random);
        let (mut points, mut names, mut distances) = (String::new(), Vec::new(), Vec::new());
        let mut at = Vec::new();
        for k in 0..anchors {
            let a = place(&mut random).map(|x| (x * 100.0).round() / 100.0);
            points += &format!("a{k} = [{}, {}]\n", a[0], a[1]);
            names.push(format!("\"a{k}\""));
            distances.push((p[0] - a[0]).hypot(p[1] - a[1]));
            at.push(a);
        }
        points += &format!("p = [{}, {}]\n", p[0], p[1]);
        let list = distances.iter().enumerate();
        let list: Vec<String> = list
            .map(|(k, x)| format!("[\"a{k}\", \"p\", {x:.3}]"))
            .collect();
        let text = format!(
            "dimension = 2\n[points]\n{points}[constraints]\nfixed = [{}]\ndistances = [{}]\n",
            names.join(", "),
            list.join(", ")
        );
        let problem = Problem::parse_loosely(&text, "anchors").unwrap();
        let Ok(mut session) = Session::open(&problem) else {
            continue;
        };
        let k = random.below(2);
        let by = [0.0, 0.0004, 0.1][random.below(3)];
        let value = format!("{:.4}", (distances[k] * 1000.0).round() / 1000.0 + by);
        let edited = session.edit(&[Setting::parse(&problem, &format!("a{k}-p={value}")).unwrap()]);
        let off = |k: usize| {
            let now = [0, 1].map(|axis| edited.points[anchors][axis].mid() - at[k][axis]);
            let asked = match edited.dimensions[0].index == k {
                true => value.parse::<f64>().unwrap(),
                false => (distances[k] * 1000.0).round() / 1000.0,
            };
            (now[0].hypot(now[1]) - asked).abs()
        };
        if edited.ending == Ending::Reached {
            met += 1;
            for one in &edited.account.left_out {
                let name = one.name.trim_matches('`');
                let k: usize = name[1..2].parse().unwrap();
                match one.verdict {
                    Verdict::Met { within } => {
                        assert!(off(k) <= within && within <= 5.001e-4, "{one:?} {text}");
                    }
                    Verdict::Undecided { at_most } => assert!(off(k) <= at_most, "{one:?} {text}"),
                    _ => panic!("{one:?} {text}"),
                }
            }
            for (k, a) in at.iter().enumerate() {
                let fixed = &edited.points[k];
                assert!(fixed[0].contains(a[0]) && fixed[1].contains(a[1]), "{text}");
            }
        } else {
            missed += 1;
        }
    }
    assert!(met >= 10 && missed >= 10, "{met} {missed}");
}
