//! What `krawl check` says of files that have more constraints than they need: whether these follow from the others or
//! contradict them, the same on both streams, and what was understood.

use std::process::Command;

/// A rectangle with a circle and a line that touches it, and one constraint more than it needs.
fn rectangle(extra: &str) -> String {
    let text = "name = \"rectangle\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4.1, 0.1]\nc = [4, 3.1]\nd = [0.1, 3]\n\
                m = [2, 1.4]\n[lines]\nl1 = [\"a\", \"b\"]\nl2 = [\"b\", \"c\"]\nl3 = [\"c\", \"d\"]\nl4 = [\"d\", \"a\"]\n\
                f = { point = [0, 1], direction = [2, 1] }\n[circles]\nk = { center = \"m\", radius = 1 }\n[constraints]\n\
                fixed = [\"a\"]\nhorizontal = [\"l1\", \"l3\"]\nvertical = [\"l2\", \"l4\"]\n\
                distances = [[\"a\", \"b\", 4], [\"a\", \"d\", 3], [\"m\", \"l1\", 1.5], [\"m\", \"l4\", 2]]\n\
                tangent = [[\"k\", \"f\"]]\nradii = [[\"k\", 0.8]]\nangles = [[\"f\", \"l1\", 30]]\n";
    format!("{text}{extra}\n")
}

/// What is said of a file, on the one and the other stream.
fn check(name: &str, text: &str) -> [String; 2] {
    let folder = std::env::temp_dir().join(format!("krawl-miscounted-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("{name}.toml"));
    std::fs::write(&file, text).unwrap();
    let mut krawl = Command::new(env!("CARGO_BIN_EXE_krawl"));
    let output = krawl.arg("check").arg(&file).output().unwrap();
    // Too many has a code of its own.
    let code = if name == "missing" { 2 } else { 6 };
    assert_eq!(output.status.code(), Some(code), "{name}");
    [output.stderr, output.stdout].map(|text| String::from_utf8(text).unwrap())
}

/// Both streams say the same of the file: what is wrong, without the place in it.
fn both_say(streams: &[String; 2], words: &str) {
    for stream in streams {
        assert!(stream.contains(words), "{words}\n{streams:?}");
    }
    let [message, text] = streams;
    let fault = &message[message.find("there are").unwrap()..];
    assert!(text.contains(fault.trim_end()), "{streams:?}");
    assert!(!text.contains("the input is in order"), "{text}");
}

const TAKEN: &str = "`krawl solve` and `krawl edit` take it as it is";

#[test]
fn contradictions_are_called_so() {
    let streams = check("place", &rectangle("x = [[\"a\", 5]]"));
    let words = "any of `x: a, 5`, `fixed: a` contradicts the others, remove `x: a, 5`";
    both_say(&streams, words);
    assert!(!streams[1].contains(TAKEN), "{}", streams[1]);
    // Of a rectangle's sides of 4 and 3.
    let streams = check("equal", &rectangle("equal = [[\"l1\", \"l2\"]]"));
    both_say(
        &streams,
        "`equal: l1, l2` contradicts the others, remove one of them",
    );
    assert!(!streams[1].contains(TAKEN), "{}", streams[1]);
    // These need the figure.
    for (name, extra) in [
        ("parallel", "parallel = [[\"l1\", \"l2\"]]"),
        ("coincident", "coincident = [[\"a\", \"b\"]]"),
    ] {
        let streams = check(name, &rectangle(extra));
        both_say(
            &streams,
            "contradicts the others at the figure to which the sketch leads",
        );
        for stream in &streams {
            assert!(!stream.contains("follows from"), "{stream}");
        }
        assert!(!streams[1].contains(TAKEN), "{}", streams[1]);
    }
    // Distances alone, by another count.
    let four = "name = \"four\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4, 0]\nc = [4, 3]\nd = [0, 3]\n[constraints]\n\
                distances = [[\"a\", \"b\", 4], [\"b\", \"c\", 3], [\"c\", \"d\", 4], [\"a\", \"d\", 3], [\"a\", \"c\", 5], [\"b\", \"d\", 6]]\n";
    let [message, text] = check("four", four);
    for stream in [&message, &text] {
        assert!(stream.contains("contradicts the others at"), "{stream}");
        assert!(!stream.contains("follows from"), "{stream}");
    }
}

#[test]
fn what_follows_is_called_so() {
    let streams = check("follows", &rectangle("parallel = [[\"l1\", \"l3\"]]"));
    both_say(
        &streams,
        "`parallel: l1, l3` follows from the others, remove one of them",
    );
    assert!(streams[1].contains(TAKEN), "{}", streams[1]);
    // Bars of 3 and 4 at a right angle, and the third one: as far as floats tell.
    let streams = check(
        "seems",
        &rectangle("equal_distances = [[\"c\", \"l1\", \"b\", \"a\", \"d\"]]")
            .replace("[\"a\", \"d\", 3]", "[\"a\", \"d\", 4]"),
    );
    both_say(&streams, "follows from the others or contradicts them");
}

/// Which constraints were understood is told of files that are not in order, too.
#[test]
fn what_was_understood_is_listed() {
    let [_, text] = check("listed", &rectangle("x = [[\"a\", 5]]"));
    for line in [
        "  points              5\n",
        "  object              l1, the line through a, b\n",
        "  constraint          x: a, 5 (a coordinate of a point is that number)\n",
        "  constraint          angles: f, l1, 30 (",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let missing = rectangle("").replace("radii = [[\"k\", 0.8]]\n", "");
    let [message, text] = check("missing", &missing);
    assert!(message.contains("under-constrained"), "{message}");
    assert!(
        text.contains("  constraint          tangent: k, f ("),
        "{text}"
    );
    assert!(text.contains(TAKEN), "{text}");
}

#[test]
fn no_contradiction_is_seen_where_there_is_none() {
    let streams = check("twice", &rectangle("dx = [[\"d\", \"c\", 4]]"));
    for stream in &streams {
        assert!(!stream.contains("contradicts the others"), "{stream}");
    }
}

/// All distances of six points of a figure, with 4 digits: what one misses by where the others are met is more than half a unit of its own
/// last digit, as all are rounded, and no contradiction; with one of them made wrong it is one.
#[test]
fn the_digits_of_all_numbers_are_looked_at() {
    let points: [(f64, f64); 6] = [
        (2.7362, 2.687),
        (-2.6607, -2.4908),
        (2.013, 1.4158),
        (1.0184, -1.1512),
        (0.6357, 0.6408),
        (0.4872, -2.0497),
    ];
    let all = |off: f64| {
        let mut text = "name = \"all\"\ndimension = 2\n[points]\n".to_owned();
        for (k, (x, y)) in points.iter().enumerate() {
            text += &format!("P{k} = [{x:.3}, {y:.3}]\n");
        }
        text += "[constraints]\ndistances = [\n";
        for (i, a) in points.iter().enumerate() {
            for (j, b) in points.iter().enumerate().skip(i + 1) {
                let off = if (i, j) == (3, 4) { off } else { 0.0 };
                let length = (a.0 - b.0).hypot(a.1 - b.1) + off;
                text += &format!("[\"P{i}\", \"P{j}\", {length:.4}],\n");
            }
        }
        text + "]\n"
    };
    let [message, text] = check("rounded", &all(0.0));
    assert_eq!(text.matches("seems to follow").count(), 6, "{text}");
    assert!(!message.contains("contradicts the others"), "{message}");
    assert!(
        message.contains("than the digits of the others explain"),
        "{message}"
    );
    let [message, text] = check("wrong", &all(0.01));
    assert!(text.contains("contradicts"), "{text}");
    assert!(message.contains("contradicts the others"), "{message}");
}

/// Of two groups of constraints that depend on each other the one that is listed need not be the one with the contradiction.
#[test]
fn a_contradiction_is_not_laid_to_others() {
    let text = "name = \"two\"\ndimension = 2\n[points]\na = [0, 0]\nb = [4.1, 0.3]\nc = [3, 2]\n[constraints]\nfixed = [\"a\"]\n\
                x = [[\"b\", 4], [\"c\", 3]]\ny = [[\"b\", 1], [\"c\", 2]]\ndx = [[\"b\", \"c\", -1], [\"a\", \"c\", 5]]\n";
    let streams = check("two", text);
    both_say(
        &streams,
        "`dx: b, c, -1` follows from the others or contradicts them",
    );
    for stream in &streams {
        assert_eq!(stream.matches("contradicts the others").count(), 1);
        assert!(
            stream.contains("; `x: c, 3` contradicts the others")
                || stream.contains("; `dx: a, c, 5` contradicts the others"),
            "{stream}"
        );
    }
    // The sketch has p above the axis.
    let text = "name = \"side\"\ndimension = 2\n[points]\na = [0, 0]\np = [2, 3]\n[constraints]\nfixed = [\"a\"]\n\
                x = [[\"p\", 2]]\ny = [[\"p\", -3]]\ndistances = [[\"p\", \"x-axis\", 3]]\n";
    let streams = check("side", text);
    both_say(
        &streams,
        "contradicts the others, with all on the side where the sketch has it",
    );
}
