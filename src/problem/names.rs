//! Names in messages: lists that stay short, and guesses at what was meant.

/// `a, b, c and 5 more`: at most `most` of the names.
pub(crate) fn list<S: AsRef<str>>(names: &[S], most: usize) -> String {
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

/// The known name most similar to `name`, if one is similar at all.
pub(super) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    // The work is bounded, whatever the input: neither names nor differences are long.
    let length = name.chars().count();
    let limit = (length / 2).clamp(1, 3);
    known
        .filter(|k| k.chars().count().abs_diff(length) <= limit && length <= 64)
        .map(|k| (edits(name, k), k))
        .filter(|&(edits, _)| edits <= limit)
        .min_by_key(|&(edits, _)| edits)
        .map(|(_, k)| k.to_owned())
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
            nearest("distance", known.into_iter()).as_deref(),
            Some("distances")
        );
        assert_eq!(nearest("angles", known.into_iter()), None);
        assert_eq!(nearest("", known.into_iter()), None);
    }

    #[test]
    fn lists_stay_short() {
        assert_eq!(list(&["a", "b"], 2), "a, b");
        assert_eq!(list(&["a", "b", "c"], 2), "a, b and 1 more");
    }
}
