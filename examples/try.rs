use krawl::problem::*;
use krawl::system::Homotopy;
pub fn load(path: &str) -> Problem {
    let doc: toml_edit::DocumentMut = std::fs::read_to_string(path).unwrap().parse().unwrap();
    let dim = doc["dimension"].as_integer().unwrap() as usize;
    let dec = |v: &toml_edit::Value| -> Decimal { v.to_string().trim().parse().unwrap() };
    let mut points = vec![];
    for (k, v) in doc["points"].as_table().unwrap() {
        let a: Vec<Decimal> = v.as_array().unwrap().iter().map(dec).collect();
        points.push(Point {
            name: k.to_string(),
            sketch: std::array::from_fn(|i| a.get(i).cloned().unwrap_or(Decimal::from(0))),
        });
    }
    let idx = |s: &str| points.iter().position(|p| p.name == s).unwrap();
    let mut distances = vec![];
    for key in ["distances", "squared_distances"] {
        if let Some(a) = doc["constraints"].get(key).and_then(|x| x.as_array()) {
            for row in a {
                let r = row.as_array().unwrap();
                let g = |i: usize| idx(r.get(i).unwrap().as_str().unwrap());
                let l = dec(r.get(2).unwrap());
                distances.push(Distance {
                    points: [g(0), g(1)],
                    target: if key == "distances" {
                        Target::Length(l)
                    } else {
                        Target::SquaredLength(l)
                    },
                });
            }
        }
    }
    let h = &doc["homotopy"];
    let reference = h["reference"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| idx(x.as_str().unwrap()))
        .collect();
    let b: Vec<usize> = h["bend"]
        .as_array()
        .unwrap()
        .iter()
        .map(|x| idx(x.as_str().unwrap()))
        .collect();
    let bend = distances
        .iter()
        .position(|d| d.points == [b[0], b[1]])
        .unwrap();
    let c = dec(h["bend_coefficient"].as_value().unwrap());
    Problem {
        name: path.into(),
        dimension: dim,
        source: String::new(),
        points,
        distances,
        homotopy: HomotopyChoices {
            reference,
            bend,
            bend_coefficient: c,
        },
    }
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let p = load(&a[1]);
    let mut o = krawl::track::Options::certified();
    if let Some(x) = a.get(2) {
        if x == "r" {
            o = o.reversed()
        } else {
            o = o.with_max_step(x.parse().unwrap())
        }
    }
    for _ in 0..std::env::var("N").map_or(0, |x| x.parse().unwrap()) {
        krawl::track::solve(&p, &o, &mut Default::default()).unwrap();
    }
    let r = krawl::track::solve(&p, &o, &mut Default::default()).unwrap();
    println!(
        "{} {:?} steps {} rej {} sol {} classes {:?} len {:.4} t {:?} ms {:.2} us/step {:.2} width {:.1e} {:?}",
        a[1],
        r.status,
        r.steps,
        r.rejected,
        r.solutions.len(),
        r.solutions.iter().map(|s| s.class).max(),
        r.length,
        r.t_range,
        r.seconds * 1e3,
        r.seconds * 1e6 / (r.steps + r.rejected) as f64,
        r.solutions.iter().map(|s| s.width).fold(0.0, f64::max),
        r.switched_on
    );
}
