//! Sketches that are loose or have more constraints than unknowns, past where the equations chosen first are singular.

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
