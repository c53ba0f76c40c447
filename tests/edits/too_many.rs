//! What `krawl check` says of constraints that are too many: that they follow only where they were seen to, what may be removed only
//! where that cures it, nothing of drawings at which they depend on each other to first order, and how figures can move.

use assert_cmd::Command;
use krawl::blocks::{Census, Finding, Seen, surplus};
use krawl::edit::{Ending, Session, Setting};
use krawl::problem::Problem;

fn census(text: &str) -> Census {
    surplus(&Problem::parse_loosely(text, "drawing.toml").unwrap()).unwrap()
}

/// The exit code, and what is told of a file.
fn check(text: &str) -> (Option<i32>, String) {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    std::fs::write(file.path(), text).unwrap();
    let mut krawl = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = krawl.arg("check").arg(file.path()).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    (output.status.code(), text)
}

/// A fixed plate, and a bracket with its bolt's axis in that of the plate and its lower side on the plate.
const BRACKET: &str = "dimension = 3\n[points]\nb0 = [0,0,10]\nb1 = [100,0,10]\nb2 = [0,60,10]\nh0 = [30,30,10]\nh1 = [30,30,0]\n\
    q0 = [12,14,11]\nq1 = [52,13,12]\nq2 = [13,44,10]\nq3 = [12,14,41]\nk0 = [29,31,12]\nk1 = [29,31,20]\n[bodies]\n\
    bracket = { q0 = [0,0,0], q1 = [40,0,0], q2 = [0,30,0], q3 = [0,0,30], k0 = [20,15,0], k1 = [20,15,8] }\n[lines]\n\
    axis_base = [\"h0\",\"h1\"]\n[planes]\ntop = [\"b0\",\"b1\",\"b2\"]\nunder = [\"q0\",\"q1\",\"q2\"]\nside = [\"q0\",\"q1\",\"q3\"]\n\
    front = { point = [0,0,0], normal = [0,1,0] }\n[constraints]\nfixed = [\"b0\",\"b1\",\"b2\",\"h0\",\"h1\",\"front\"]\n\
    coplanar = [[\"b0\",\"b1\",\"b2\",\"q0\"]]\nparallel = [[\"top\",\"under\"]]\non = [[\"k0\",\"axis_base\"],[\"k1\",\"axis_base\"]]\n";
const TANGENT: &str = "dimension = 2\n[points]\nO = [0, 0]\nM = [12, 6]\nP = [12, 0]\nQ = [30, 0]\n[circles]\n\
    c = { center = \"M\", radius = 6 }\n[constraints]\nfixed = [\"O\"]\non = [[\"P\", \"x-axis\"], [\"Q\", \"x-axis\"], [\"P\", \"c\"]]\n\
    dx = [[\"O\", \"M\", 12], [\"O\", \"Q\", 30]]\ndy = [[\"O\", \"M\", 6]]\nradii = [[\"c\", 6]]\n";
const FACES: &str = "dimension = 3\n[points]\na0 = [0,0,20]\na1 = [40,0,20]\na2 = [0,30,20]\na3 = [0,0,0]\nc0 = [4,5,26]\nc1 = [24,6,25]\n\
    c2 = [3,15,25]\nc3 = [4,5,41]\n[bodies]\none = { a0 = [0,0,0], a1 = [40,0,0], a2 = [0,30,0], a3 = [0,0,-20] }\n\
    two = { c0 = [0,0,0], c1 = [20,0,0], c2 = [0,10,0], c3 = [0,0,15] }\n[planes]\ntop1 = [\"a0\",\"a1\",\"a2\"]\n\
    front1 = [\"a0\",\"a1\",\"a3\"]\nleft1 = [\"a0\",\"a2\",\"a3\"]\nbot2 = [\"c0\",\"c1\",\"c2\"]\nfront2 = [\"c0\",\"c1\",\"c3\"]\n\
    left2 = [\"c0\",\"c2\",\"c3\"]\n[constraints]\ndistances = [[\"top1\",\"bot2\",5],[\"front1\",\"front2\",3],[\"left1\",\"left2\",4]]\n";

/// The length of a radius follows from how far it goes along x only with the tangent, of which nothing is seen to first order.
#[test]
fn a_set_is_as_large_as_it_has_to_be() {
    let census = census(
        "dimension = 2\n[points]\nM = [0, 0]\nS = [8, 0]\nA = [8, 5]\n[constraints]\nfixed = [\"M\"]\nvertical = [[\"S\", \"A\"]]\n\
         perpendicular = [[\"M\", \"S\", \"S\", \"A\"]]\ndx = [[\"M\", \"S\", 8]]\ndistances = [[\"M\", \"S\", 8], [\"S\", \"A\", 5]]\n",
    );
    let [one] = &census.surplus[..] else {
        panic!("{census:?}")
    };
    assert_eq!((one.name.as_str(), one.finding), ("`M-S`", Finding::Met));
    for needed in [
        "`dx: M, S, 8`",
        "`vertical: S, A`",
        "`perpendicular: M, S, S, A`",
    ] {
        assert!(one.others.contains(&needed.to_owned()), "{one:?}");
    }
    assert!(!one.others.contains(&"`S-A`".to_owned()), "{one:?}");
    let cures = one.cures.as_deref().unwrap();
    assert_eq!(cures, ["`M-S`", "`dx: M, S, 8`"]);
    assert_eq!(census.freedom.ways, Ok(0));
}

/// The axes make the faces parallel; an angle between the bracket and the plate is needed, and without it the bracket turns.
#[test]
fn what_is_needed_is_not_to_be_removed() {
    let with = census(&format!("{BRACKET}angles = [[\"side\",\"front\",30]]\n"));
    assert_eq!((with.freedom.ways.clone(), &with.singular), (Ok(0), &None));
    assert!(!with.surplus.is_empty());
    for one in &with.surplus {
        let cures = one.cures.as_ref().unwrap();
        assert!(!cures.iter().any(|cure| cure.contains("angles")), "{one:?}");
        assert!(!one.name.contains("angles"), "{one:?}");
    }
    let parallel = "`parallel: top, under`".to_owned();
    let mut cures = with
        .surplus
        .iter()
        .flat_map(|one| one.cures.iter().flatten());
    assert!(cures.any(|cure| *cure == parallel), "{with:?}");
    let without = census(BRACKET);
    assert_eq!(without.freedom.ways, Ok(1));
    let text = format!("{BRACKET}angles = [[\"side\",\"front\",30]]\n");
    let cured = census(&text.replace("parallel = [[\"top\",\"under\"]]\n", ""));
    assert_eq!((cured.freedom.ways, cured.surplus), (Ok(0), Vec::new()));
    // `solve` refuses the fixed direction.
    let (_, text) = check(&text);
    assert!(text.contains("; `krawl edit` takes it as it is"), "{text}");
}

/// Two points of a body are as far apart as the body says: one of the coordinates at which they are fixed is too much, and neither of
/// the points.
#[test]
fn where_a_part_is_too_much_the_whole_is_not_to_be_removed() {
    let text = "dimension = 3\n[points]\nP = [0,0,0]\nQ = [2,0,0]\nR = [1,1,0.1]\n[bodies]\nb = { P = [0,0,0], Q = [2,0,0], R = [1,1,0] }\n\
                [constraints]\nfixed = [\"P\",\"Q\"]\nz = [[\"R\",0.2]]\n";
    let census = census(text);
    let [one] = &census.surplus[..] else {
        panic!("{census:?}")
    };
    assert_eq!((one.name.as_str(), one.in_part), ("`fixed: Q`", true));
    assert_eq!(one.cures, Some(Vec::new()));
    assert_eq!(census.freedom.ways, Ok(0));
    let (code, text) = check(text);
    assert_eq!(code, Some(6));
    assert!(text.contains("`fixed: Q` in part "), "{text}");
    assert!(!text.contains("To cure it, remove"), "{text}");
    assert!(!text.contains("remove one"), "{text}");
}

/// Of a constraint that says two things one may follow from others: not all of it does, whatever can be removed as a whole.
#[test]
fn a_part_that_follows_is_not_the_whole() {
    // C = (0, 5), D = (0, 0), E = (0, 1) meets both verticals, and E is not halfway.
    let halfway = "dimension = 2\n[points]\nC = [3,5]\nD = [3,0]\nE = [3,2.5]\n[constraints]\nvertical = [[\"D\",\"E\"],[\"C\",\"E\"]]\n\
                   midpoint = [[\"E\",\"C\",\"D\"]]\ndistances = [[\"C\",\"D\",5],[\"C\",\"E\",2.5]]\n";
    let (_, text) = check(halfway);
    assert!(
        text.contains("`midpoint: E, C, D` in part follows, proved, from"),
        "{text}"
    );
    // The axis need not be halfway for both of these.
    let mirrored = "dimension = 2\n[points]\nA = [0,0]\nB = [0,4]\nC = [-2,1]\nD = [2,1]\n[lines]\nax = [\"A\",\"B\"]\n[constraints]\n\
                    vertical = [\"ax\"]\nhorizontal = [[\"C\",\"D\"]]\nsymmetric = [[\"C\",\"D\",\"ax\"]]\n\
                    distances = [[\"A\",\"B\",4],[\"C\",\"D\",4],[\"A\",\"C\",2.2360679775],[\"A\",\"D\",2.2360679775]]\n";
    let (_, text) = check(mirrored);
    assert!(text.contains("`symmetric: C, D, ax` in part "), "{text}");
}

#[test]
fn nothing_follows_from_a_figure_that_is_singular() {
    let census = census(TANGENT);
    assert_eq!(census.surplus, []);
    assert_eq!(census.singular.unwrap().seen, Seen::FirstOrder);
    let (code, text) = check(TANGENT);
    assert_eq!(code, Some(0));
    assert!(!text.contains("seem"), "{text}");
    assert!(text.contains("the drawing is singular: "), "{text}");
    assert!(text.contains("to first order only"), "{text}");
}

/// Where they depend on each other at all figures they are too many, and the drawing is not said to be singular.
#[test]
fn what_depends_on_each_other_everywhere_is_too_much() {
    let census = census(FACES);
    assert_eq!(census.singular, None);
    assert_eq!(census.freedom.ways, Ok(0));
    assert!(
        census.surplus.iter().any(|one| !one.is_object),
        "{census:?}"
    );
    let (_, text) = check(FACES);
    assert!(!text.contains("is singular"), "{text}");
}

/// One line says it, and how the figure moves as a whole.
#[test]
fn degrees_of_freedom_are_told_once() {
    let told = |text: &str| {
        let (_, text) = check(text);
        let lines = text.lines().filter(|line| line.contains("of freedom"));
        let lines: Vec<String> = lines.map(|line| line.trim().to_owned()).collect();
        assert_eq!(lines.len(), 1, "{text}");
        lines[0].clone()
    };
    let points = "dimension = 2\n[points]\nA = [0, 0]\nB = [41, 1]\nC = [40, 22]\n[constraints]\n";
    let loose = told(&format!(
        "{points}dy = [[\"B\", \"C\", 21]]\ndistances = [[\"A\", \"B\", 41]]\n"
    ));
    assert_eq!(
        loose,
        "degrees of freedom  2, besides moving as a whole along x, y"
    );
    let triangle = "distances = [[\"A\", \"B\", 41], [\"B\", \"C\", 21], [\"A\", \"C\", 45]]\n";
    let square = told(&format!("{points}{triangle}"));
    assert_eq!(
        square,
        "degrees of freedom  0, besides moving and turning as a whole"
    );
    let crank = told(&format!("{points}fixed = [\"A\"]\n{triangle}"));
    assert_eq!(crank, "degrees of freedom  1");
    assert!(told(TANGENT).contains("not told: "));
}

/// Of an angle whose legs have given lengths, and a length that is left out, the angle stays what it is: its equation has no number of the length.
#[test]
fn what_a_length_that_is_left_out_gives_is_not_taken_for_given() {
    let triangle = |distances: &str, others: &str| {
        format!(
            "dimension = 2\n[points]\nA = [0,0]\nB = [3,0]\nC = [1,1.7]\n[constraints]\ndistances = [{distances}]\n{others}\n"
        )
    };
    let angles = |of: [&str; 3]| {
        let [a, b, c] = of;
        format!(
            "angles = [[\"A\",\"B\",\"C\",{b}],[\"B\",\"C\",\"A\",{c}],[\"C\",\"A\",\"B\",{a}]]"
        )
    };
    // Three angles that are 180 degrees together follow from each other, whatever lengths are given.
    let equilateral = triangle("[\"A\",\"B\",2]", &angles(["60", "60", "60"]));
    let found = census(&equilateral);
    let names: Vec<&str> = found.surplus.iter().map(|one| &*one.name).collect();
    assert_eq!(names, ["`angles: C, A, B, 60`"]);
    assert!(
        !found.surplus[0]
            .others
            .iter()
            .any(|other| other.contains("A-B"))
    );
    let (_, text) = check(&equilateral);
    assert!(!text.contains("remove the distance A-B"), "{text}");
    let problem = Problem::parse_loosely(&equilateral, "drawing.toml").unwrap();
    let mut session = Session::open(&problem).unwrap();
    let edited = session.edit(&[Setting::parse(&problem, "A-B=3").unwrap()]);
    assert_eq!(edited.ending, Ending::Reached);
    // Of 60, 40 and 80 degrees, AB = 3 and AC = 2 it is a length that contradicts: the sine rule has 1.958.
    let contradictory = triangle(
        "[\"A\",\"B\",3],[\"A\",\"C\",2]",
        &angles(["60", "40", "80"]),
    );
    let problem = Problem::parse_loosely(&contradictory, "drawing.toml").unwrap();
    let why = Session::open(&problem).unwrap_err().to_string();
    assert!(
        why.contains("`A-C` contradicts") && !why.contains("`angles"),
        "{why}"
    );
    // A difference of two lengths that are given as well.
    let found = census(&triangle(
        "[\"A\",\"B\",3],[\"A\",\"C\",3.2],[\"B\",\"C\",3.4]",
        "differences = [[\"A\",\"C\",\"A\",\"B\",0.4]]",
    ));
    assert!(
        found.surplus.iter().all(|one| !one.others.is_empty()),
        "{:?}",
        found.surplus
    );
}

/// A rhombus with the middle of its diagonals: one of its sides follows, at every figure near the drawing, which is not singular.
#[test]
fn a_rhombus_is_no_singular_drawing() {
    let text = "dimension = 2\n[points]\nA = [0,0]\nB = [4,0]\nC = [4,4]\nD = [0,4]\nE = [2,2]\n[constraints]\n\
        distances = [[\"A\",\"B\",4],[\"B\",\"C\",4],[\"C\",\"D\",4],[\"D\",\"A\",4]]\nfixed = [\"A\"]\n\
        horizontal = [[\"A\",\"B\"]]\nmidpoint = [[\"E\",\"A\",\"C\"]]\non = [[\"E\",\"B\",\"D\"]]\n";
    let found = census(text);
    assert!(found.singular.is_none() && found.surplus.len() == 1);
    let session = Session::open(&Problem::parse_loosely(text, "drawing.toml").unwrap()).unwrap();
    assert!(session.singular().is_none());
}
