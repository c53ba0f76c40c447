//! Systems of polynomials as other programs of algebra read or print them, as problem files: PHCpack, msolve, Macaulay2 and
//! HomotopyContinuation.jl. Which one it is, is told by the text.

use std::fmt::Write;

/// A system of polynomials, each of which is to be zero.
struct System {
    unknowns: Vec<String>,
    polynomials: Vec<String>,
}

/// The system of a text as that of a problem file (docs/using/algebra.md), or nothing where it has none of the forms that are read. Unknowns begin at numbers that mean
/// nothing, as such systems have no sketch.
///
/// ```
/// use krawl::problem::Problem;
/// let text = krawl::import::polynomials::problem_file("x, y\n0\nx^2 + y^2 - 4,\nx*y - 1\n").unwrap().unwrap();
/// assert_eq!(Problem::parse(&text, "system.ms").unwrap().constraints.len(), 2);
/// ```
///
/// # Errors
/// What is missing in it, or is more than krawl reads.
pub fn problem_file(text: &str) -> Option<Result<String, String>> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let [first, second] = [(); 2].map(|()| lines.next().unwrap_or_default().trim());
    let numbers = first.split_whitespace().map(str::parse::<usize>);
    let has = |is_so: &dyn Fn(&str) -> bool| {
        let mut lines = text.lines().map(str::trim_start);
        lines.any(|line| !line.starts_with('#') && is_so(line))
    };
    let (program, system) = if first.starts_with(PRINTED) {
        (JULIA, printed(text))
    } else if has(&|line| declared(line).is_some()) {
        (JULIA, homotopy_continuation(text))
    } else if has(&|line| RINGS.iter().any(|ring| line.contains(ring))) && text.contains("ideal") {
        ("Macaulay2", macaulay2(text))
    } else if let Ok([_] | [_, _]) = numbers.collect::<Result<Vec<_>, _>>().as_deref() {
        ("PHCpack", phcpack(text))
    } else if second.parse::<u64>().is_ok() && !first.contains('=') {
        ("msolve", msolve(text))
    } else {
        return None;
    };
    let wrong = |what| format!("is read as a system of {program}: {what}");
    Some(system.map(|it| in_toml(program, &it)).map_err(wrong))
}

/// How HomotopyContinuation.jl begins to print a system.
const PRINTED: &str = "System of length";

/// What is told by declarations, and by what is printed.
const JULIA: &str = "HomotopyContinuation.jl";

/// How rings of polynomials begin in Macaulay2.
const RINGS: [&str; 4] = ["QQ[", "ZZ[", "RR[", "CC["];

fn in_toml(program: &str, system: &System) -> String {
    let quoted = |text: &String| serde_json::to_string(text).expect("a text");
    let mut out = format!("# A system of {program}.\nequations = [\n");
    for polynomial in &system.polynomials {
        writeln!(out, "    {},", quoted(polynomial)).expect("memory");
    }
    out += "]\n\n# It has no sketch: these numbers mean nothing.\n[unknowns]\n";
    for (k, name) in system.unknowns.iter().enumerate() {
        writeln!(out, "{} = {}", quoted(name), start(k)).expect("memory");
    }
    out
}

/// Where an unknown begins of which nothing is known: no two of the first hundred at the same number.
pub(crate) fn start(k: usize) -> f64 {
    (31 + 37 * k % 100) as f64 / 100.0
}

/// What stands between commas that are in no parentheses.
fn between_commas(text: &str) -> Vec<String> {
    let (mut depth, mut parts) = (0i32, vec![String::new()]);
    for c in text.chars() {
        depth += i32::from("([{".contains(c)) - i32::from(")]}".contains(c));
        match c {
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().expect("a first one").push(c),
        }
    }
    let parts = parts.iter().map(|part| part.trim().to_owned());
    parts.filter(|part| !part.is_empty()).collect()
}

/// A text on one line.
fn on_one_line(text: impl AsRef<str>) -> String {
    let words: Vec<&str> = text.as_ref().split_whitespace().collect();
    words.join(" ")
}

/// What stands behind an opening bracket, up to the one that closes it, and what follows on its line.
fn in_brackets(text: &str) -> Option<(&str, &str)> {
    let mut depth = 1i32;
    let end = text.char_indices().find(|(_, c)| {
        depth += i32::from("([{".contains(*c)) - i32::from(")]}".contains(*c));
        depth == 0
    });
    let (inner, rest) = text.split_at(end?.0);
    Some((inner, rest[1..].lines().next().unwrap_or_default().trim()))
}

/// What is in the brackets of the one call of a function whose result is given a name, or is all of its line.
fn of_call<'a>(text: &'a str, function: &str) -> Result<&'a str, String> {
    let found = text.split_once(function).and_then(|(before, behind)| {
        let line = before
            .lines()
            .next_back()
            .filter(|_| !before.ends_with('\n'));
        let is_named = |line: &str| {
            let own = line.rsplit(';').next().unwrap_or_default();
            let name = own.trim_end().trim_end_matches([':', '=']).trim();
            name.chars().all(|c| c.is_alphanumeric() || c == '_')
        };
        let (inner, rest) = in_brackets(behind.trim_start().strip_prefix(['(', '{'])?)?;
        let is_one = !behind.contains(function) && line.is_none_or(is_named);
        (is_one && (rest.is_empty() || rest.starts_with(';'))).then_some(inner)
    });
    found.ok_or_else(|| {
        format!(
            "`{function}(…)` was expected, once and with nothing before or behind it but a name"
        )
    })
}

/// The lines without comments that end with them.
fn without_comments(text: &str, mark: &str, long: &str) -> Result<String, String> {
    if text.contains(long) {
        return Err(format!("comments of several lines, `{long}`, are not read"));
    }
    let lines = text
        .lines()
        .map(|line| line.split(mark).next().unwrap_or_default());
    Ok(lines.collect::<Vec<_>>().join("\n"))
}

/// Refuses unknowns that are several by one name, which has this mark.
fn one_by_one(unknowns: &[String], mark: &str) -> Result<(), String> {
    match unknowns.iter().find(|name| name.contains(mark)) {
        Some(range) => Err(format!(
            "name the unknowns one by one in place of `{range}`"
        )),
        None => Ok(()),
    }
}

/// The numbers of polynomials and of unknowns, which are as many where there is but one number; and the polynomials with a `;` behind each.
fn phcpack(text: &str) -> Result<System, String> {
    let (first, rest) = text.trim_start().split_once('\n').unwrap_or_default();
    let mut announced = first
        .split_whitespace()
        .filter_map(|n| n.parse::<usize>().ok());
    let count = announced.next().unwrap_or(0);
    let unknowns_announced = announced.next().unwrap_or(count);
    let parts: Vec<&str> = rest.split(';').collect();
    let polynomials: Vec<String> = parts[..parts.len() - 1].iter().map(on_one_line).collect();
    if count == 0 || polynomials.len() != count {
        return Err(format!(
            "{count} polynomials are announced, with a `;` behind each: there are {}",
            polynomials.len()
        ));
    }
    let is_part = |c: char| c.is_alphanumeric() || c == '_' || c == '.';
    let mut unknowns = Vec::new();
    for name in polynomials
        .iter()
        .flat_map(|text| text.split(|c| !is_part(c)))
    {
        if ["i", "I"].contains(&name) {
            return Err(format!(
                "`{name}` is the imaginary unit, and krawl reads real coefficients"
            ));
        }
        if name.starts_with(char::is_alphabetic) && !unknowns.iter().any(|known| known == name) {
            unknowns.push(name.to_owned());
        }
    }
    if unknowns.len() != unknowns_announced {
        return Err(format!(
            "{unknowns_announced} unknowns are announced, and these are named: {}",
            unknowns.join(", ")
        ));
    }
    Ok(System {
        unknowns,
        polynomials,
    })
}

/// The unknowns, the characteristic, and polynomials with commas between.
fn msolve(text: &str) -> Result<System, String> {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let unknowns = between_commas(lines.next().unwrap_or_default());
    let characteristic = lines.next().unwrap_or_default().trim();
    if characteristic != "0" {
        let what = format!(
            "its characteristic is {characteristic}, and that of real and complex numbers is 0"
        );
        return Err(what);
    }
    let polynomials = between_commas(&lines.collect::<Vec<_>>().join("\n"));
    let polynomials = polynomials.iter().map(on_one_line).collect();
    Ok(System {
        unknowns,
        polynomials,
    })
}

/// A ring of polynomials, and an ideal of them.
fn macaulay2(text: &str) -> Result<System, String> {
    let text = without_comments(text, "--", "-*")?;
    let rings = RINGS.iter().flat_map(|ring| text.match_indices(ring));
    let [(at, ring)] = rings.collect::<Vec<_>>()[..] else {
        return Err("one ring was expected, such as `QQ[x, y]`".to_owned());
    };
    let ring = in_brackets(&text[at + ring.len()..])
        .filter(|(_, rest)| rest.is_empty() || rest.starts_with(';'));
    let (ring, _) =
        ring.ok_or_else(|| "the ring was expected to end its line with `]`".to_owned())?;
    let mut unknowns = between_commas(ring);
    unknowns.retain(|name| !name.contains("=>"));
    one_by_one(&unknowns, "..")?;
    let ideal = of_call(&text, "ideal")?.trim();
    let list = match ideal.strip_prefix('{') {
        None => ideal,
        Some(list) => match ideal.strip_suffix('}').is_some().then(|| in_brackets(list)) {
            Some(Some((inner, ""))) if inner.len() + 2 == ideal.len() => inner,
            _ => {
                return Err("one list of polynomials was expected in `ideal({…})`".to_owned());
            }
        },
    };
    let polynomials = between_commas(list).iter().map(on_one_line).collect();
    Ok(System {
        unknowns,
        polynomials,
    })
}

/// The unknowns that a line of Julia declares.
fn declared(line: &str) -> Option<&str> {
    let names = line.trim_start().strip_prefix("@var")?;
    names.starts_with(char::is_whitespace).then_some(names)
}

/// The program of HomotopyContinuation.jl's that declares unknowns and makes a system of them.
fn homotopy_continuation(text: &str) -> Result<System, String> {
    let text = without_comments(text, "#", "#=")?;
    let names = text.lines().filter_map(declared);
    let names = names.flat_map(|line| line.split([' ', '\t', ',', ';']));
    let unknowns: Vec<String> = names
        .filter(|name| !name.is_empty())
        .map(str::to_owned)
        .collect();
    one_by_one(&unknowns, "[")?;
    let all = of_call(&text, "System")?.trim();
    if all.contains("parameters") {
        return Err("put numbers for its parameters".to_owned());
    }
    let list = all.strip_prefix('[').and_then(in_brackets);
    let list = list.filter(|(_, rest)| rest.is_empty() || rest.starts_with([',', ';']));
    let (list, _) = list.ok_or_else(|| "`System([…])` was expected".to_owned())?;
    let polynomials = between_commas(list);
    // In brackets a new line begins a new entry in Julia, comma or not.
    if polynomials.iter().any(|text| text.contains('\n')) {
        return Err("write each polynomial on one line, with commas between them".to_owned());
    }
    let polynomials = polynomials.iter().map(|text| with_ratios(text)).collect();
    Ok(System {
        unknowns,
        polynomials,
    })
}

/// Julia's ratios of whole numbers, `3//4`, which bind closer than products do, as `(3/4)`.
fn with_ratios(text: &str) -> String {
    let Some((before, behind)) = text.split_once("//") else {
        return text.to_owned();
    };
    let begin = before.trim_end_matches(|c: char| c.is_ascii_digit()).len();
    let end = behind.len()
        - behind
            .trim_start_matches(|c: char| c.is_ascii_digit())
            .len();
    let rest = with_ratios(&behind[end..]);
    format!(
        "{}({}/{}){rest}",
        &before[..begin],
        &before[begin..],
        &behind[..end]
    )
}

/// A system as HomotopyContinuation.jl prints it.
fn printed(text: &str) -> Result<System, String> {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let length = lines
        .next()
        .and_then(|line| line.strip_prefix(PRINTED)?.trim().parse().ok());
    let variables = lines.next().and_then(|line| line.split_once("variables:"));
    let (number, variables) =
        variables.ok_or_else(|| "a line of variables was expected".to_owned())?;
    let unknowns = between_commas(variables);
    let polynomials: Vec<String> = lines.map(with_ratios).collect();
    if polynomials.iter().any(|line| line.contains("parameters:")) {
        return Err("put numbers for its parameters".to_owned());
    }
    if length != Some(polynomials.len()) || number.trim().parse() != Ok(unknowns.len()) {
        return Err(
            "there are not as many variables and lines of polynomials as it says".to_owned(),
        );
    }
    Ok(System {
        unknowns,
        polynomials,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use proptest::prelude::*;

    /// x² + y² = 4 and xy = 1, in all forms.
    const FORMS: [&str; 7] = [
        "2\n x^2 + 1.0E+00*y**2 - 4;\nx*y -\n 1;\n\nTITLE : two curves\n",
        " 2 2\nx^2+y^2-4;x*y-1;",
        "x, y\n0\nx^2+y^2-4,\nx*y-1\n",
        "R = QQ[x, y, MonomialOrder => Lex] -- two\nI = ideal(x^2+y^2-4, -- a circle\n x*y-1)\n",
        "R = RR[x,y]; I = ideal({x^2+y^2-4, x*(y)-1});",
        "using HomotopyContinuation\n@var x y # two\nF = System([x^2+y^2-4, x*y-1]; variables = [x, y])\n",
        "System of length 2\n 2 variables: x, y\n\n -4 + x^2 + y^2\n -1 + x*y\n",
    ];

    #[test]
    fn all_forms_are_read() {
        let wanted = r#"equations = ["x^2 + y^2 - 4", "x*y - 1"]
            [unknowns]
            x = 1
            y = 2"#;
        // Unknowns have one order in all, so that polynomials are those of the same numbers.
        let of = |text: &str| {
            let problem = Problem::parse(text, "system").unwrap();
            let names: Vec<String> = problem.objects.iter().map(|o| o.name.clone()).collect();
            let formulas = problem
                .constraints
                .iter()
                .map(|c| c.formula.as_ref().unwrap());
            let polynomials: Vec<_> = formulas
                .map(|f| (f.atoms.clone(), f.zero.clone()))
                .collect();
            (names, polynomials)
        };
        for form in FORMS {
            assert_eq!(
                of(&problem_file(form).unwrap().unwrap()),
                of(wanted),
                "{form}"
            );
        }
        assert_eq!(
            with_ratios("-25//4 + 2*x//3//y - 7//10*y"),
            "-(25/4) + 2*x(/3)(/)y - (7/10)*y"
        );
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (form, words) in [
            (
                "3\nx^2 - 1;\ny - 1;\n",
                "3 polynomials are announced, with a `;` behind each: there are 2",
            ),
            ("2\nx^2 - 1;\ny - 1\n", "there are 1"),
            ("1\nx^2 - 1;\nx - 1;\n", "there are 2"),
            ("0\n", "0 polynomials are announced"),
            (
                "1 2\nx^2 - 1;\n",
                "2 unknowns are announced, and these are named: x",
            ),
            ("2\nx*y*z - 1;\nx + y + z;\n", "named: x, y, z"),
            ("1\n(1.0 + 2.0*i)*x - 1;\n", "`i` is the imaginary unit"),
            ("x\n65521\nx^2 - 1\n", "characteristic is 65521"),
            ("R = QQ[x_1..x_3]\nI = ideal(x_1)", "in place of `x_1..x_3`"),
            ("R = QQ[x\nI = ideal(x)", "end its line with `]`"),
            ("R = QQ[x]/(x^2 - 1)\nI = ideal(x)", "end its line with `]`"),
            (
                "R = QQ[x,y]/ideal(x^2+y^2-4)\nI = ideal(x*y-1, x-y)",
                "end its line with `]`",
            ),
            (
                "R = QQ[x]\nS = QQ[y]\nI = ideal(x)",
                "one ring was expected",
            ),
            ("R = QQ[x]\nI = ideal x", "`ideal(…)` was expected"),
            (
                "R = QQ[x]\nI = ideal(x^2-1) + ideal(x-1)",
                "`ideal(…)` was expected, once",
            ),
            (
                "R = QQ[x]\nI = saturate(ideal(x^2-1), x)",
                "`ideal(…)` was expected, once",
            ),
            (
                "R = QQ[x]\nI = ideal(x^2-x) : x",
                "`ideal(…)` was expected, once",
            ),
            (
                "R = QQ[x]\nI = ideal({x^2-1} | {x-1})",
                "one list of polynomials",
            ),
            (
                "R = QQ[x]\n-* I = ideal(x) *-\nI = ideal(x-1)",
                "comments of several lines",
            ),
            ("@var x[1:3]\nSystem([x[1]])", "in place of `x[1:3]`"),
            (
                "@var x a\nF = System([x - a]; parameters = [a])",
                "put numbers for its parameters",
            ),
            ("@var x\nx^2", "`System(…)` was expected"),
            (
                "@var x\nF = System([x^2-1] .- 3)",
                "`System([…])` was expected",
            ),
            (
                "@var x\nF = System([x^2-1])\nF = System([x^2-2])",
                "`System(…)` was expected, once",
            ),
            (
                "@var x\n#=\nF = System([x^2-1])\n=#\nF = System([x^2-2])",
                "comments of several lines",
            ),
            (
                "@var x y\nF = System([\n x^2 - 1\n -y + 2\n])",
                "with commas between them",
            ),
            (
                "System of length 1\n 1 variables: x\n 1 parameters: a\n\n x - a",
                "put numbers",
            ),
            (
                "System of length 2\n 1 variables: x\n\n x^2 - 1",
                "not as many variables and lines",
            ),
            ("System of length 1\n", "a line of variables"),
        ] {
            let error = problem_file(form).unwrap().unwrap_err();
            assert!(error.contains(words), "{form}: {error}");
        }
        for other in [
            "",
            "dimension = 2\n[points]\na = [0, 0]\n",
            "x = 1\n0\n",
            "# @var x, of QQ[x], an ideal\nx = 1",
            "@vars x\n",
            "<robot/>",
        ] {
            assert!(problem_file(other).is_none(), "{other}");
        }
    }

    proptest! {
        /// No text makes it panic, nor what becomes of it.
        #[test]
        fn no_text_panics(start in 0..FORMS.len(), cut in any::<prop::sample::Index>(), more in "[-+*/^().,;0-9xyé \n\\[\\]{}\"]{0,20}") {
            let form = FORMS[start];
            let text = format!("{}{more}", &form[..cut.index(form.len() + 1)]);
            if let Some(Ok(text)) = problem_file(&text) {
                let _ = Problem::parse(&text, "system");
            }
        }
    }
}
