//! Drawings that are singular by chance, flat or at a dead centre, and constraints that are one too many: what is said of them,
//! against circles that meet, counted in floats.

use crate::common::edits::Random;
use crate::common::wanted;
use assert_cmd::Command;
use krawl::blocks::{Figures, Finding, Surplus, surplus};
use krawl::edit::{End, Ending, Session, Setting};
use krawl::problem::{Problem, Target};
use krawl::track::{Control, Options};
use proptest::prelude::*;

const TWO_TRIANGLES: &str = "dimension = 2\n[points]\nA = [0,0]\nB = [80,0]\nC = [40,0]\nD = [60,0]\n[constraints]\n\
    fixed = [\"A\"]\nhorizontal = [[\"A\",\"B\"]]\n\
    distances = [[\"A\",\"B\",80],[\"A\",\"C\",50],[\"B\",\"C\",50],[\"C\",\"D\",25],[\"B\",\"D\",35]]\n";
const SLIDER: &str = "dimension = 2\n[points]\nO = [0,0]\nB = [25,0]\nS = [95,0]\n[constraints]\nfixed = [\"O\"]\n\
    y = [[\"S\",0]]\nx = [[\"S\",90]]\ndistances = [[\"O\",\"B\",25],[\"B\",\"S\",70]]\n";
const TRUSS: &str = "dimension = 2\n[points]\nA = [0,0]\nB = [80,0]\nD = [26.6,0]\nE = [40,40]\n[constraints]\n\
    fixed = [\"A\",\"B\"]\ndistances = [[\"A\",\"D\",30],[\"B\",\"D\",60],[\"A\",\"E\",55],[\"D\",\"E\",38]]\n";
const SENSORS: &str = "dimension = 2\n[points]\na1 = [0, 0]\na2 = [10, 0]\na3 = [5, 9]\ns1 = [3, 3]\ns2 = [7, 3]\ns3 = [5, 6]\n\
    [constraints]\nfixed = [\"a1\",\"a2\",\"a3\"]\ndistances = [[\"a1\",\"s1\",4.2426],[\"a2\",\"s2\",4.2426],[\"a3\",\"s3\",3],\
    [\"s1\",\"s2\",4],[\"s2\",\"s3\",3.6056],[\"s1\",\"s3\",3.6056]]\n";

fn problem(text: &str) -> Problem {
    Problem::parse_loosely(text, "drawing.toml").unwrap()
}

fn figures(problem: &Problem) -> Figures {
    Figures::find(problem, &Options::certified(), &mut Control::default()).unwrap()
}

/// By how much a figure misses a distance at most.
fn missed(problem: &Problem, points: &[[f64; 3]]) -> f64 {
    let off = problem.distances.iter().map(|distance| {
        let [a, b] = distance.points.map(|p| points[p]);
        let squared: f64 = (0..3).map(|k| (a[k] - b[k]).powi(2)).sum();
        let Target::Length(length) = &distance.target else {
            panic!("they are lengths");
        };
        (squared.sqrt() - length.to_f64()).abs()
    });
    off.fold(0.0, f64::max)
}

fn edit(text: &str, setting: &str) -> (Session, krawl::edit::Edited) {
    let problem = problem(text);
    let mut session = Session::open(&problem).unwrap();
    let setting = Setting::parse(&problem, setting).unwrap();
    let edited = session.edit(&[setting]);
    (session, edited)
}

#[test]
fn triangles_drawn_flat_have_all_their_figures() {
    let found = figures(&problem(TWO_TRIANGLES));
    // Of the base's two directions the one that is drawn.
    assert_eq!((found.count(), found.doubt()), (Some(4), None));
    let singular = found.singular().unwrap();
    assert!(singular.moved.is_some_and(|moved| moved < 5.0));
    assert_eq!(singular.flat, [["A", "B", "C", "D"]]);
    assert_eq!(found.account().left_out.len(), 0);
    let (session, edited) = edit(TWO_TRIANGLES, "A-B=70");
    assert_eq!(edited.ending, Ending::Reached);
    assert!(missed(session.problem(), &session.figure()) < 1e-9);
    assert!(!session.singular().unwrap().other.is_empty());
}

#[test]
fn a_slider_at_its_dead_centre_has_two_continuations() {
    let (session, edited) = edit(SLIDER, "x:S=80");
    assert_eq!(edited.ending, Ending::Reached);
    let singular = session.singular().unwrap();
    assert_eq!(singular.flat, [["O", "B", "S"]]);
    // Either way from 90: B at (21.25, ±13.17).
    let (name, other) = &singular.other[0];
    assert_eq!(name, "B");
    assert!((other[0] - 21.25).abs() < 1e-9 && (other[1].abs() - 13.1695671910659).abs() < 1e-9);
    assert!(other[1] * session.figure()[1][1] < 0.0);
    // Drawn with the dimension that it is a dead centre of: the figure itself is singular.
    let (session, edited) = edit(&SLIDER.replace("90", "95"), "x:S=90");
    assert_eq!(edited.ending, Ending::Reached);
    let singular = edited.singular.unwrap();
    assert!(singular.moved.is_some() && singular.other.len() == 1);
    assert!((session.figure()[1][0] - 21.25).abs() < 1e-9);
}

#[test]
fn no_constraint_is_blamed_for_a_singular_drawing() {
    for (text, setting) in [(TRUSS, "A-E=50"), (SENSORS, "a1-s1=4.3")] {
        let (session, edited) = edit(text, setting);
        let what = format!("{setting}: {:?}", edited.ending);
        assert!(
            matches!(edited.ending, Ending::Reached | Ending::Limit(_)),
            "{what}"
        );
        assert!(
            session
                .singular()
                .is_some_and(|singular| singular.moved.is_some())
        );
        assert_eq!(session.account().left_out, []);
        assert_eq!(surplus(&problem(text)).unwrap().surplus, []);
    }
}

fn one(text: &str) -> Surplus {
    let found = surplus(&problem(text)).unwrap().surplus;
    let [one] = &found[..] else {
        panic!("{found:?}")
    };
    one.clone()
}

/// A rectangle of which one thing is said twice.
fn rectangle(more: &str, distances: &str) -> String {
    format!(
        "dimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n[constraints]\nfixed = [\"a\"]\n\
         horizontal = [[\"a\", \"b\"], [\"d\", \"c\"]]\nvertical = [[\"b\", \"c\"], [\"a\", \"d\"]]\n{more}\n\
         distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3]{distances}]\n"
    )
}

#[test]
fn what_is_one_too_many_is_told_with_what_it_depends_on() {
    let found = one(&rectangle("dx = [[\"d\", \"c\", 4.5]]", ""));
    assert!(
        found.others.contains(&"`dx: d, c, 4.5`".to_owned()) || found.name == "`dx: d, c, 4.5`"
    );
    assert!(found.finding.is_contradiction(), "{found:?}");
    let found = one(&rectangle("", ", [\"c\", \"d\", 4]"));
    assert_eq!(found.name, "`c-d`");
    assert!(found.others.contains(&"`a-b`".to_owned()), "{found:?}");
    assert_eq!(found.finding, Finding::Follows);
    // Numbers that agree within their digits are no contradiction.
    let found = one(
        &rectangle("dx = [[\"a\", \"b\", 4.0], [\"d\", \"c\", 4.03]]", "")
            .replace("[\"a\", \"b\", 4], ", ""),
    );
    let Finding::Rounded { by } = found.finding else {
        panic!("{found:?}")
    };
    assert!((by - 0.03).abs() < 1e-9, "{found:?}");
    let found = one(
        &rectangle("dx = [[\"a\", \"b\", 4.00], [\"d\", \"c\", 4.03]]", "")
            .replace("[\"a\", \"b\", 4], ", ""),
    );
    let Finding::Contradicts { by } = found.finding else {
        panic!("{found:?}")
    };
    assert!((by - 0.03).abs() < 1e-9, "{found:?}");
    let census = surplus(&problem(&rectangle("", ""))).unwrap();
    assert_eq!((census.freedom.ways, census.surplus), (Ok(0), Vec::new()));
}

#[test]
fn check_has_an_exit_code_of_its_own_for_too_many() {
    let code = |text: &str| {
        let mut krawl = Command::new(env!("CARGO_BIN_EXE_krawl"));
        let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
        std::fs::write(file.path(), text).unwrap();
        let output = krawl.arg("check").arg(file.path()).output().unwrap();
        (
            output.status.code(),
            String::from_utf8(output.stdout).unwrap(),
        )
    };
    let (over, text) = code(&rectangle("", ", [\"c\", \"d\", 4]"));
    assert_eq!(over, Some(6), "{text}");
    assert!(text.contains("too many\n  `c-d` "), "{text}");
    assert_eq!(code(&rectangle("", "")).0, Some(0));
    let (flat, text) = code(TWO_TRIANGLES);
    assert_eq!(flat, Some(0), "{text}");
    assert!(text.contains("A, B, C, D are on one line in it"), "{text}");
}

/// A chain of triangles on a base along the axis, with the number of its figures, by circles.
struct Chain {
    points: Vec<[f64; 2]>,
    parents: Vec<[usize; 2]>,
    lengths: Vec<[String; 2]>,
    base: String,
}

fn chain(random: &mut Random, count: usize) -> Chain {
    let mut points = vec![[0.0, 0.0], [random.between(30.0, 90.0), 0.0]];
    let base = format!("{:.2}", points[1][0]);
    points[1][0] = base.parse().unwrap();
    let (mut parents, mut lengths) = (Vec::new(), Vec::new());
    while points.len() < count {
        let a = random.below(points.len());
        let b = random.below(points.len());
        let p = [random.between(-80.0, 80.0), random.between(-80.0, 80.0)];
        let [u, v] = [a, b].map(|q| [points[q][0] - p[0], points[q][1] - p[1]]);
        let size = |v: [f64; 2]| v[0].hypot(v[1]);
        let sine = (u[0] * v[1] - u[1] * v[0]) / (size(u) * size(v));
        if a == b || sine.abs() < 0.2 || size(u) < 10.0 || size(v) < 10.0 {
            continue;
        }
        points.push(p);
        parents.push([a, b]);
        lengths.push([u, v].map(|side| format!("{:.2}", size(side))));
    }
    Chain {
        points,
        parents,
        lengths,
        base,
    }
}

impl Chain {
    /// As a problem, with points drawn at these places, and more distances.
    fn problem(&self, drawn: &[[f64; 2]], more: &str) -> Problem {
        let points = drawn.iter().enumerate();
        let points: String = points
            .map(|(k, [x, y])| format!("p{k} = [{x}, {y}]\n"))
            .collect();
        let sides = self.parents.iter().zip(&self.lengths).enumerate();
        let sides: String = sides
            .map(|(k, ([a, b], [u, v]))| {
                let p = k + 2;
                format!(", [\"p{p}\", \"p{a}\", {u}], [\"p{p}\", \"p{b}\", {v}]")
            })
            .collect();
        problem(&format!(
            "dimension = 2\n[points]\n{points}[constraints]\nfixed = [\"p0\"]\nhorizontal = [[\"p0\", \"p1\"]]\n\
             distances = [[\"p0\", \"p1\", {}]{sides}{more}]\n",
            self.base
        ))
    }

    /// All its figures, by circles that meet; `None` if some nearly touch.
    fn figures(&self) -> Option<Vec<Vec<[f64; 2]>>> {
        let base: f64 = self.base.parse().unwrap();
        // In the direction in which the base is drawn.
        let mut all = vec![vec![[0.0, 0.0], [base, 0.0]]];
        for ([a, b], sides) in self.parents.iter().zip(&self.lengths) {
            let [r, s] = sides.each_ref().map(|side| side.parse::<f64>().unwrap());
            let mut next = Vec::new();
            for figure in &all {
                let (p, q) = (figure[*a], figure[*b]);
                let d = (q[0] - p[0]).hypot(q[1] - p[1]);
                let along = (r * r - s * s + d * d) / (2.0 * d);
                let height = r * r - along * along;
                if height.abs() < 1.0 {
                    return None;
                }
                if height < 0.0 {
                    continue;
                }
                let e = [(q[0] - p[0]) / d, (q[1] - p[1]) / d];
                for h in [height.sqrt(), -height.sqrt()] {
                    let mut figure = figure.clone();
                    figure.push([
                        p[0] + along * e[0] - h * e[1],
                        p[1] + along * e[1] + h * e[0],
                    ]);
                    next.push(figure);
                }
            }
            all = next;
        }
        Some(all)
    }
}

/// Chains drawn flat, or with one point on the line of its parents: as many figures as circles have, edits that begin, and no
/// constraint that is too many; with one more distance that one alone is, and it is not blamed where a figure meets it.
fn look_at(seed: u64) {
    let mut random = Random(seed);
    let count = 3 + random.below(3);
    let chain = chain(&mut random, count);
    let Some(all) = chain.figures() else {
        return;
    };
    let mut drawn = chain.points.clone();
    let round = |x: f64| (x * 8.0).round() / 8.0;
    for at in &mut drawn {
        *at = at.map(round);
    }
    if random.below(2) == 0 {
        drawn.iter_mut().for_each(|at| at[1] = 0.0);
    } else {
        let k = random.below(chain.parents.len());
        let [a, b] = chain.parents[k].map(|p| drawn[p]);
        drawn[k + 2] = [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0];
    }
    let is_apart = |a: usize, b: usize| drawn[a] != drawn[b];
    let children = chain.parents.iter().enumerate();
    if !children
        .flat_map(|(k, pair)| pair.map(|p| (k + 2, p)))
        .all(|(a, b)| is_apart(a, b))
    {
        // Points of one distance drawn in one place are refused.
        return;
    }
    let flat = chain.problem(&drawn, "");
    let found = figures(&flat);
    let is_none = found.doubt().is_none() && found.count() == Some(0);
    assert!(!is_none, "{seed}: {} figures are there", all.len());
    if found.doubt().is_none() && !found.has_paths() && found.account().left_out.is_empty() {
        assert_eq!(found.count(), Some(all.len() as u64), "{seed}");
    }
    assert_eq!(surplus(&flat).unwrap().surplus, [], "{seed}");
    if let Ok(session) = Session::open(&flat) {
        assert!(missed(&flat, &session.figure()) < 1e-9, "{seed}");
        assert_eq!(session.account().left_out, [], "{seed}");
    }
    // One more: the true distance in the figure that was drawn, by nine digits.
    let joined = |a: usize, b: usize| {
        let parents = |p: usize, q: usize| p >= 2 && chain.parents[p - 2].contains(&q);
        parents(a, b) || parents(b, a) || a + b == 1
    };
    let free = (2..count).flat_map(|b| (0..b).map(move |a| (a, b)));
    let mut free = free.filter(|&(a, b)| !joined(a, b));
    if let Some((a, b)) = free.next() {
        let figure = &all[random.below(all.len())];
        let length = (figure[a][0] - figure[b][0]).hypot(figure[a][1] - figure[b][1]);
        if length > 1.0 && drawn[a] != drawn[b] {
            let more = format!(", [\"p{a}\", \"p{b}\", {length:.9}]");
            let over = surplus(&chain.problem(&drawn, &more)).unwrap().surplus;
            assert_eq!(over.len(), 1, "{seed}: {over:?}");
            let of = |p: [f64; 2], q: [f64; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
            let met = all.iter().any(|f| (of(f[a], f[b]) - length).abs() < 1e-7);
            let is_proved = matches!(over[0].finding, Finding::Contradicts { .. });
            assert!(!(met && is_proved), "{seed}: {over:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn drawings_singular_by_chance_lead_to_figures(seed in any::<u64>()) {
        look_at(seed);
    }
}

/// `KRAWL_COUNT` of them, 2000 unless it says otherwise.
#[test]
#[ignore = "minutes"]
fn many_drawings_singular_by_chance() {
    (0..wanted("KRAWL_COUNT", 2000)).for_each(look_at);
}

/// P is on the x-axis and on a circle that touches it there: the contact goes along with the circle, and one figure has it.
#[test]
fn a_circle_that_touches_by_its_numbers_keeps_the_contact() {
    let text = "dimension = 2\n[points]\nO = [0, 0]\nM = [12, 6]\nP = [12, 0]\nQ = [30, 0]\n[circles]\n\
                c = { center = \"M\", radius = 6 }\n[constraints]\nfixed = [\"O\"]\n\
                on = [[\"P\", \"x-axis\"], [\"Q\", \"x-axis\"], [\"P\", \"c\"]]\n\
                dx = [[\"O\", \"M\", 12], [\"O\", \"Q\", 30]]\ndy = [[\"O\", \"M\", 6]]\nradii = [[\"c\", 6]]\n";
    let problem = Problem::parse_loosely(text, "test").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "dx:O-M=14").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached, "{edited:?}");
    let at = |p: usize| [0, 1].map(|k| edited.points[p][k].mid());
    let near = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12;
    assert!(
        near(at(1), [14.0, 6.0]) && near(at(2), [14.0, 0.0]),
        "{edited:?}"
    );
    assert_eq!(edited.account.names_left_out(), ["`on: P, c`"]);
    assert!(edited.account.scope().contains("equations used"));
    assert!(edited.switched_on[0].contains("that contact is kept"));
    let scope = edited.account.scope();
    assert!(
        scope.contains("equations used, among them that the radius of `c` at P"),
        "{scope}"
    );
    assert_eq!(edited.account.added.len(), 1);
    // The problem is the one that was given, but for the number.
    assert_eq!(
        session.problem().constraints.len(),
        problem.constraints.len()
    );
    // A larger circle cuts the axis in two points: the contact is left, and P is in either.
    let edited = session.edit(&[Setting::parse(&problem, "radii:c=7").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached, "{edited:?}");
    let x = edited.points[2][0].mid();
    assert!(((x - 14.0).abs() - 13f64.sqrt()).abs() < 1e-9, "{x}");
    assert!(edited.singular.is_some());
    // No range and no frame goes through that: there is no path from the one to the other.
    let mut again = Session::open(&problem).unwrap();
    let radius = Setting::find(&problem, "radii:c").unwrap();
    let range = again.range(radius, &mut Control::default());
    assert!(
        matches!(&range.high, End::Unknown(value, why) if (value.mid() - 6.0).abs() < 1e-5 && why.contains("contact cannot be kept")),
        "{range:?}"
    );
    assert!(
        range
            .account
            .left_out
            .iter()
            .all(|one| !one.verdict.is_missed())
    );
    let sweep = again.sweep(radius, (&6.into(), &7.into()), 3, &mut Control::default());
    assert_eq!(sweep.frames.len(), 1);
    // None reaches the axis from farther away than it is large.
    let edited = session.edit(&[Setting::parse(&problem, "radii:c=5").unwrap()]);
    assert_ne!(edited.ending, Ending::Reached);
}

/// Of a drawing that is singular several figures may be the continuation: every claim about what comes from one of them says so.
#[test]
fn a_claim_from_a_singular_drawing_says_so() {
    let problem = problem(SLIDER);
    let mut session = Session::open(&problem).unwrap();
    let wanted = Setting::parse(&problem, "x:S=89").unwrap();
    let edited = session.edit(&[wanted]);
    assert_eq!(edited.ending, Ending::Reached);
    let words = krawl::report::edit_in_words(&problem, &edited);
    assert!(
        words.contains("with the first figure one of those to which the singular drawing leads"),
        "{words}"
    );
    let drawing = edited.account.drawing.as_ref().unwrap();
    assert!(
        drawing.contains("either continues the drawing"),
        "{drawing}"
    );
    // From a drawing that is not singular nothing of that is said.
    let regular = self::problem(&SLIDER.replace("[25,0]", "[20,15]"));
    let mut session = Session::open(&regular).unwrap();
    let edited = session.edit(&[Setting::parse(&regular, "x:S=89").unwrap()]);
    assert!(edited.ending == Ending::Reached && edited.account.drawing.is_none());
}
