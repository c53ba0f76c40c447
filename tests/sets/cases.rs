//! Sketches that fall apart once something is decided that has more than one place: lengths that are sought, and as long as others. Counts are those of formulas, and of points
//! constructed one after the other on every side, in floats.

use crate::common::covers::{is_harmless, searched};
use crate::common::edits::Random;
use krawl::certificate::cover::coordinates::{Case, CoordinateCover};
use krawl::certificate::cover::verify_cover;
use krawl::complete::{Options, Status, all};
use krawl::problem::Problem;
use std::fmt::Write;

/// p has two places, at two distances from c; each q is as far from its d as p is from c, and as high. Then more points, equal lengths and distances.
fn gaps(count: usize, [points, more, distances]: [&str; 3]) -> Problem {
    let mut text = String::from(
        "name = \"gaps\"\ndimension = 2\n[points]\na = [0, 0]\nb = [10, 0]\nc = [3, 7]\np = [4, 3.2]\n",
    );
    let [mut fixed, mut level, mut equal] = [const { String::new() }; 3];
    for k in 0..count {
        writeln!(text, "d{k} = [{}, {k}]\nq{k} = [{}.2, {k}]", 20 + k, 24 + k).unwrap();
        write!(fixed, ", \"d{k}\"").unwrap();
        write!(level, "[\"d{k}\", \"q{k}\"], ").unwrap();
        write!(equal, "[\"p\", \"c\", \"d{k}\", \"q{k}\"], ").unwrap();
    }
    writeln!(
        text,
        "{points}\n[constraints]\nfixed = [\"a\", \"b\", \"c\"{fixed}]\nhorizontal = [{level}]\nequal = [{equal}{more}]\ndistances = [[\"a\", \"p\", 5], [\"b\", \"p\", 7]{distances}]"
    )
    .unwrap();
    Problem::parse(&text, "gaps.toml").unwrap()
}

const TWO_PLACES: [&str; 3] = ["", "", ""];

/// The number of figures, which the search and its cover both prove.
fn count(problem: &Problem) -> (Option<u64>, CoordinateCover) {
    let (result, cover) = searched(problem);
    assert_eq!(result.status, Status::Complete, "{:?}", result.undecided);
    let verdict = verify_cover(&cover.to_bytes()).unwrap();
    assert_eq!((verdict.flaw, verdict.undecided), (None, 0));
    assert_eq!(verdict.solutions, result.count);
    // The boxes listed are disjoint.
    for (k, one) in result.solutions.iter().enumerate().take(300) {
        for other in &result.solutions[..k] {
            let pairs = one.points.iter().zip(&other.points);
            let mut axes = pairs.flat_map(|(p, q)| p.iter().zip(q));
            assert!(axes.any(|(x, y)| x.disjoint(*y)));
        }
    }
    (result.count, cover)
}

#[test]
fn each_gap_as_long_as_a_sought_one_doubles_what_the_others_have() {
    each_gap_doubles(&[8, 12]);
    // More than can be counted.
    let result = all(&gaps(64, TWO_PLACES), &Options::default()).unwrap();
    assert_eq!((result.status, result.count), (Status::Complete, None));
}

#[test]
#[ignore = "half a minute"]
fn each_of_forty_gaps_doubles_what_the_others_have() {
    each_gap_doubles(&[20, 40]);
    let (number, _) = count(&gaps(70, TWO_PLACES));
    assert_eq!(number, None);
}

fn each_gap_doubles(counts: &[usize]) {
    for &gaps_of in counts {
        let problem = gaps(gaps_of, TWO_PLACES);
        let (number, cover) = count(&problem);
        assert_eq!(number, Some(2 << gaps_of));
        // Up to a thousand figures are put together one by one.
        let cases = if gaps_of < 10 { 0 } else { 2 };
        assert_eq!(cover.cases.len(), cases);
        let result = all(&problem, &Options::default()).unwrap();
        let first = result
            .first_choice
            .map(|choice| (choice.names, choice.count));
        let expected = (cases > 0).then(|| (vec!["p".to_owned()], 2));
        assert_eq!(first, expected);
        assert!(result.choices.is_empty());
        assert_eq!(result.solutions.len(), if cases > 0 { 1000 } else { 512 });
    }
}

/// |p c| is 3.8… or 10.3…, and |a c| and |b c| are 7.6… and 9.8…: a circle of that radius about a meets one of radius 2 about c in no case, and about b in one.
#[test]
fn a_case_may_have_no_figure() {
    for (from, cases) in [("a", 0), ("b", 1)] {
        let equal = format!("[\"p\", \"c\", \"{from}\", \"h\"]");
        let more = ["h = [2, 7]", &equal, ", [\"c\", \"h\", 2]"];
        let (number, _) = count(&gaps(11, more));
        assert_eq!(number, Some(cases * (2 << 11)), "{from}");
    }
}

/// Where circles of two radii about two points meet; `None`: they nearly touch.
fn meet([p, q]: [[f64; 2]; 2], [d, r]: [f64; 2]) -> Option<Vec<[f64; 2]>> {
    let base = (q[0] - p[0]).hypot(q[1] - p[1]);
    let along = (base * base + d * d - r * r) / (2.0 * base);
    let square = d * d - along * along;
    if base < 1e-3 || square.abs() < 1e-2 {
        return None;
    }
    let (dx, dy) = ((q[0] - p[0]) / base, (q[1] - p[1]) / base);
    let sides: &[f64] = if square > 0.0 { &[-1.0, 1.0] } else { &[] };
    let place = |side: &f64| {
        let h = side * square.sqrt();
        [p[0] + along * dx - h * dy, p[1] + along * dy + h * dx]
    };
    Some(sides.iter().map(place).collect())
}

/// Points on two circles each, about points before: of a given radius, or of that which is sought. So many random figures, at least so many in
/// cases.
fn places_are_as_many_as_sides(count: usize, least: usize) {
    let mut random = Random(5);
    let (mut tried, mut with_cases) = (0, 0);
    while tried < count {
        let fixed = [[0.0, 0.0], [10.0, 0.0], [-2.0, 1.0]];
        // p first, from the first two of these; `None`: as far as p is from the third.
        let mut steps: Vec<([usize; 2], [Option<f64>; 2])> = vec![([0, 1], [Some(5.0), Some(7.0)])];
        let points = 12 + random.below(3);
        while steps.len() < points {
            let known = if random.below(4) == 0 {
                3 + steps.len()
            } else {
                3
            };
            let from = [random.below(known), random.below(known)];
            let given =
                |random: &mut Random| Some((random.between(4.0, 10.0) * 100.0).round() / 100.0);
            let radii = [
                if random.below(5) > 0 {
                    None
                } else {
                    given(&mut random)
                },
                given(&mut random),
            ];
            if from[0] != from[1] {
                steps.push((from, radii));
            }
        }
        // In floats.
        let mut figures = vec![fixed.to_vec()];
        let mut is_clear = true;
        for (k, (from, radii)) in steps.iter().enumerate() {
            let mut next = Vec::new();
            for figure in &figures {
                let at = |i: usize| -> [f64; 2] { figure[i] };
                let sought = || (at(3)[0] - at(2)[0]).hypot(at(3)[1] - at(2)[1]);
                let radii = radii
                    .map(|radius| radius.unwrap_or_else(|| if k > 0 { sought() } else { 0.0 }));
                match meet(from.map(at), radii) {
                    Some(places) => next.extend(
                        places
                            .into_iter()
                            .map(|place| [&figure[..], &[place]].concat()),
                    ),
                    None => is_clear = false,
                }
            }
            figures = next;
            if !is_clear || figures.len() > 60_000 {
                break;
            }
        }
        if !is_clear || figures.len() < 1000 || figures.len() > 60_000 {
            continue;
        }
        tried += 1;
        let mut text = String::from(
            "dimension = 2\n[points]\na = [0, 0]\nb = [10, 0]\nc = [-2, 1]\np3 = [4, 3.2]\n",
        );
        let name = |i: usize| match i {
            0..3 => ["a", "b", "c"][i].to_owned(),
            _ => format!("p{i}"),
        };
        let [mut distances, mut equal] = [const { String::new() }; 2];
        for (k, (from, radii)) in steps.iter().enumerate() {
            let own = name(3 + k);
            if k > 0 {
                writeln!(text, "{own} = [{}.5, {}.25]", k, 3 + k % 4).unwrap();
            }
            for (from, radius) in from.iter().zip(radii) {
                let from = name(*from);
                match radius {
                    Some(radius) => {
                        write!(distances, "[\"{from}\", \"{own}\", {radius:?}], ").unwrap()
                    }
                    None => write!(equal, "[\"p3\", \"c\", \"{from}\", \"{own}\"], ").unwrap(),
                }
            }
        }
        write!(text, "[constraints]\nfixed = [\"a\", \"b\", \"c\"]\ndistances = [{distances}]\nequal = [{equal}]\n").unwrap();
        let problem = Problem::parse(&text, "random.toml").unwrap();
        let (result, cover) = searched(&problem);
        if result.status != Status::Complete {
            // Those that are not given part by part may be too many.
            assert!(cover.cases.len() < 2 && figures.len() > 4000, "{text}");
            continue;
        }
        assert_eq!(result.count, Some(figures.len() as u64), "{text}");
        let verdict = verify_cover(&cover.to_bytes()).unwrap();
        assert!(verdict.proves_all(), "{:?}\n{text}", verdict.flaw);
        assert_eq!(verdict.solutions, result.count);
        with_cases += usize::from(cover.cases.len() > 1);
        println!("{} cases, {} figures", cover.cases.len(), figures.len());
    }
    println!("{with_cases} of {tried} in cases");
    assert!(with_cases >= least, "{with_cases}");
}

#[test]
fn points_constructed_with_a_sought_radius_have_as_many_places_as_sides() {
    places_are_as_many_as_sides(6, 1);
}

#[test]
#[ignore = "a quarter of a minute"]
fn many_points_constructed_with_a_sought_radius_have_as_many_places_as_sides() {
    places_are_as_many_as_sides(12, 2);
}

#[test]
fn damaged_cases_prove_no_other_number() {
    let (_, cover) = searched(&gaps(10, TWO_PLACES));
    assert!(cover.cases.len() == 2 && verify_cover(&cover.to_bytes()).unwrap().proves_all());
    let mut refused = 0;
    let mut is_refused = |what: &str, changed: CoordinateCover| {
        assert!(is_harmless(&changed, 2048), "{what}");
        let verdict = verify_cover(&changed.to_bytes());
        let is = !verdict.is_ok_and(|verdict| verdict.proves_all());
        refused += usize::from(is);
        is
    };
    let of = |case: &Case| -> Vec<usize> {
        let others = case.parts.iter().flat_map(|part| part.figures.clone());
        [case.first].into_iter().chain(others).collect()
    };
    for k in 0..2 {
        let mut fewer = cover.clone();
        fewer.cases.remove(k);
        assert!(is_refused("a case less", fewer.clone()));
        // And its solutions.
        let kept = of(&cover.cases[1 - k]);
        fewer.figures = kept
            .iter()
            .map(|&figure| cover.figures[figure].clone())
            .collect();
        let place = |figure: &mut usize| *figure = kept.iter().position(|k| k == figure).unwrap();
        place(&mut fewer.cases[0].first);
        fewer.cases[0]
            .parts
            .iter_mut()
            .flat_map(|part| &mut part.figures)
            .for_each(place);
        assert!(is_refused("a case less, with its solutions", fewer));
        // A case twice: its solutions again, or none but the first.
        let mut twice = cover.clone();
        twice.cases.push(cover.cases[k].clone());
        assert!(is_refused("a case twice", twice));
        let mut again = cover.clone();
        let own = of(&cover.cases[k]);
        let count = cover.figures.len();
        again
            .figures
            .extend(own.iter().map(|&figure| cover.figures[figure].clone()));
        let mut case = cover.cases[k].clone();
        let moved =
            |figure: &mut usize| *figure = count + own.iter().position(|o| o == figure).unwrap();
        moved(&mut case.first);
        case.parts
            .iter_mut()
            .flat_map(|part| &mut part.figures)
            .for_each(moved);
        again.cases.push(case);
        assert!(is_refused("a case again", again.clone()));
        // The same place of p, and others of the gaps: the first solution is another one of the same case.
        let last = own[own.len() - 1];
        again.figures[count] = cover.figures[last].clone();
        assert!(is_refused("a case from elsewhere", again));
        for part in 0..cover.cases[k].parts.len() {
            let mut other = cover.clone();
            if let Some(figure) = other.cases[k].parts[part].figures.pop() {
                assert!(is_refused("a place less", other.clone()));
                other.cases[1 - k].parts[part].figures.push(figure);
                assert!(is_refused("a place of the other case", other));
            }
        }
        let mut swapped = cover.clone();
        swapped.cases.swap(0, 1);
        is_refused("the other order", swapped);
    }
    let mut swapped = cover.clone();
    (swapped.cases[0].first, swapped.cases[1].first) = (cover.cases[1].first, cover.cases[0].first);
    assert!(is_refused("firsts exchanged", swapped));
    let mut none = cover.clone();
    none.cases.push(Case::default());
    assert!(is_refused("an empty case", none));
    // Unknowns that there are not, or twice.
    for unknown in [cover.base[0], cover.figures[0].len(), usize::MAX] {
        let mut other = cover.clone();
        other.base.push(unknown);
        assert!(is_refused("an unknown that is none", other));
    }
    for unknown in 0..cover.figures[0].len() {
        let mut other = cover.clone();
        match other.base.iter().position(|&i| i == unknown) {
            Some(place) => drop(other.base.remove(place)),
            None => other.base.push(unknown),
        }
        is_refused("another base", other);
    }
    assert!(refused > 40, "{refused}");
}
