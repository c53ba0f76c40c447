//! Names in messages: lists that stay short, and guesses at what was meant.

/// What is said of any one of constraints that depend on each other, as long as it is not known which of the two it is.
pub const DEPENDS: &str = "follows from the others or contradicts them";

/// What is said of one thing, or of none or several.
pub fn either<'a>(n: usize, one: &'a str, several: &'a str) -> &'a str {
    if n == 1 { one } else { several }
}

/// `1 point`, `2 points`, `2 boxes`, `2 sketches`.
pub fn counted(n: usize, what: &str) -> String {
    match what {
        _ if n == 1 => format!("1 {what}"),
        _ if what.ends_with('x') || what.ends_with("ch") => format!("{n} {what}es"),
        _ => format!("{n} {what}s"),
    }
}

/// `a, b, c and 5 more`: at most `most` of the names.
pub fn list<S: AsRef<str>>(names: &[S], most: usize) -> String {
    let join = |names: &[S]| {
        let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
        names.join(", ")
    };
    if names.len() <= most {
        join(names)
    } else {
        format!("{} and {} more", join(&names[..most]), names.len() - most)
    }
}

/// The known name most similar to `name`, if there is one that is similar, and only one: a guess that
/// may as well be another is of no help.
pub fn nearest(name: &str, known: &mut dyn Iterator<Item = &str>) -> Option<String> {
    // The work is bounded, whatever the input: neither names nor differences are long.
    let length = name.chars().count();
    if length > 64 {
        return None;
    }
    // More than half of the name is as it was meant.
    let limit = (length.saturating_sub(1) / 2).min(3);
    let lower = name.to_lowercase();
    let mut best: Option<(usize, &str)> = None;
    let mut alone = true;
    for known in known.filter(|k| k.chars().count().abs_diff(length) <= limit) {
        let edits = match known.to_lowercase() == lower {
            true => 0,
            false => edits(name, known),
        };
        if edits > limit || best.is_some_and(|(least, _)| edits > least) {
            continue;
        }
        alone = best.is_none_or(|(least, _)| edits < least);
        best = Some((edits, known));
    }
    best.filter(|_| alone).map(|(_, known)| known.to_owned())
}

/// Levenshtein's distance: insertions, deletions and replacements from one text to the other.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &y) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(x != y);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_edits() {
        assert_eq!(edits("bend", "bend"), 0);
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
    }

    #[test]
    fn guesses_only_what_is_near() {
        let known = ["distances", "squared_distances"];
        assert_eq!(
            nearest("distance", &mut known.into_iter()).as_deref(),
            Some("distances")
        );
        assert_eq!(nearest("angles", &mut known.into_iter()), None);
        assert_eq!(nearest("", &mut known.into_iter()), None);
        // One letter for another is no likeness, and one of two is none either.
        assert_eq!(nearest("D", &mut ["A", "B", "C"].into_iter()), None);
        assert_eq!(
            nearest("c", &mut ["A", "B", "C"].into_iter()).as_deref(),
            Some("C")
        );
        assert_eq!(nearest("knee3", &mut ["knee1", "knee2"].into_iter()), None);
        assert_eq!(
            nearest("kneee1", &mut ["knee1", "knee2"].into_iter()).as_deref(),
            Some("knee1")
        );
    }

    #[test]
    fn lists_stay_short() {
        assert_eq!(list(&["a", "b"], 2), "a, b");
        assert_eq!(list(&["a", "b", "c"], 2), "a, b and 1 more");
    }
}
