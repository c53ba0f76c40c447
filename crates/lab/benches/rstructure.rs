//! R-structured against dense elimination, after table 2 of "Re-parameterization reduces
//! irreducible geometric constraint systems" (CAD 70, 2016): `cargo bench -p krawl-lab`.
//!
//! Entries are random, uniform in [−1, 1], the diagonal not favoured: pivots are looked
//! for. The paper does not say how many blocks of A below the diagonal are not zero; its times,
//! which grow like n, suggest few. Both ends are measured: `sparse`, where each block row has two
//! such blocks, and `full`, where it has all of them.
//!
//! Every time is the median of several runs (nalgebra's at n = 4002 is one run) with one
//! right-hand side, from the matrix in the solver's own format to the solution; copies that a
//! solver makes of it are included. All run on one thread: faer is told so (`Par::Seq`), and
//! chooses its SIMD kernels at run time. Dense elimination does not see structure, so that it is
//! timed once per n, in the same run just before the R-structured ones.
//!
//! `-- quick` leaves out n = 4002.

use faer::linalg::solvers::Solve;
use krawl_lab::rstructure::{Factors, RMatrix, Structure, backward_error};
use std::sync::Arc;
use std::time::Instant;

const SIZES: [(usize, f64); 4] = [(502, 3.7), (1002, 8.1), (2002, 21.1), (4002, 73.4)];
const KEYS: [usize; 3] = [2, 5, 10];
const BLOCKS: [usize; 3] = [10, 50, 100];
/// Milliseconds of table 2 for k = 2: Gauss's elimination and R-structured.
const PUBLISHED: [[(f64, f64); 3]; 4] = [
    [(18.1, 4.2), (17.2, 4.8), (17.4, 5.7)],
    [(71.5, 7.6), (83.2, 10.4), (83.5, 12.0)],
    [(407.3, 15.6), (426.8, 20.1), (402.2, 25.3)],
    [(2708.6, 33.0), (2672.4, 33.9), (2743.7, 46.3)],
];

#[derive(Clone, Copy, PartialEq)]
enum Below {
    Sparse,
    Full,
}

impl Below {
    fn name(self) -> &'static str {
        match self {
            Below::Sparse => "sparse",
            Below::Full => "full",
        }
    }
}

/// A reproducible stream of numbers in [−1, 1] (splitmix64).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn system(n: usize, k: usize, m: usize, below: Below) -> (RMatrix<f64>, Vec<f64>) {
    let mut random = Random((n * 1000 + k * 100 + m) as u64);
    // The last block takes what n − k leaves over.
    let order = n - k;
    let mut blocks = vec![m; order / m];
    blocks.extend(Some(order % m).filter(|&rest| rest > 0));
    let mut entries = Vec::new();
    let mut start = 0;
    for (index, &size) in blocks.iter().enumerate() {
        let left: Vec<usize> = match below {
            Below::Full => (0..index).collect(),
            Below::Sparse if index < 2 => (0..index).collect(),
            Below::Sparse => vec![random.next() as usize % (index - 1), index - 1],
        };
        for row in start..start + size {
            for &block in &left {
                entries.extend((block * m..(block + 1) * m).map(|column| (row, k + column)));
            }
        }
        start += size;
    }
    let structure = Arc::new(Structure::new(k, &blocks, entries.iter().copied()).unwrap());
    let mut matrix = RMatrix::zeros(structure);
    // Blocks of numbers with a mean near zero would make A's inverse grow by orders of magnitude
    // from block to block when all are there; entries left of the diagonal are scaled to keep
    // solutions of one size.
    let scale = match below {
        Below::Sparse => 1.0 / m as f64,
        Below::Full => 1.0 / order as f64,
    };
    for &(row, column) in &entries {
        matrix.set(row, column, scale * random.number());
    }
    let mut start = 0;
    for &size in &blocks {
        for row in start..start + size {
            for column in start..start + size {
                matrix.set(row, k + column, random.number());
            }
        }
        start += size;
    }
    for index in 0..n {
        for key in 0..k {
            matrix.set(index, key, random.number());
            matrix.set(order + key, index, random.number());
        }
    }
    let b = (0..n).map(|_| random.number()).collect();
    (matrix, b)
}

#[derive(Clone, Copy)]
struct Measured {
    seconds: f64,
    error: f64,
}

fn median(mut seconds: Vec<f64>) -> f64 {
    seconds.sort_by(f64::total_cmp);
    seconds[seconds.len() / 2]
}

fn timed<X>(f: impl FnOnce() -> X) -> (f64, X) {
    let clock = Instant::now();
    let x = f();
    (clock.elapsed().as_secs_f64(), x)
}

/// R-structured: the median of enough runs for a tenth of a second.
fn structured(matrix: &RMatrix<f64>, b: &[f64]) -> Measured {
    let mut x = b.to_vec();
    // The memory of the run before is used again, as Newton's iterations do.
    let mut factors = Some(Factors::solving(matrix, &mut x).expect("a regular matrix"));
    let mut seconds = Vec::new();
    while seconds.len() < 5 || seconds.iter().sum::<f64>() < 0.1 {
        x.copy_from_slice(b);
        let last = factors.take().expect("factors");
        let (s, next) = timed(|| last.again(matrix, Some(&mut x)).expect("a regular matrix"));
        seconds.push(s);
        factors = Some(next);
    }
    Measured {
        seconds: median(seconds),
        error: backward_error(matrix, &x, b),
    }
}

/// Dense: faer and nalgebra in turns.
fn dense(matrix: &RMatrix<f64>, b: &[f64]) -> [Measured; 2] {
    let n = b.len();
    let mut one = faer::Mat::<f64>::zeros(n, n);
    matrix.for_each(|row, column, x| one[(row, column)] = x);
    let other = nalgebra::DMatrix::from_fn(n, n, |i, j| one[(i, j)]);
    let right = faer::Mat::from_fn(n, 1, |i, _| b[i]);
    let right_other = nalgebra::DVector::from_column_slice(b);
    let repeats = match n {
        0..=600 => 9,
        601..=1100 => 5,
        _ => 3,
    };
    let (mut seconds, mut seconds_other) = (Vec::new(), Vec::new());
    let mut errors = [0.0; 2];
    // nalgebra's elimination is the slower by far: where it takes seconds, once will do.
    let repeats_other = if n > 3000 { 1 } else { repeats };
    for repeat in 0..repeats {
        let (s, x) = timed(|| one.partial_piv_lu().solve(&right));
        seconds.push(s);
        let x: Vec<f64> = (0..n).map(|i| x[(i, 0)]).collect();
        errors[0] = backward_error(matrix, &x, b);
        if repeat < repeats_other {
            let (s, x) = timed(|| {
                other
                    .clone()
                    .lu()
                    .solve(&right_other)
                    .expect("a regular matrix")
            });
            seconds_other.push(s);
            errors[1] = backward_error(matrix, x.as_slice(), b);
        }
    }
    [
        Measured {
            seconds: median(seconds),
            error: errors[0],
        },
        Measured {
            seconds: median(seconds_other),
            error: errors[1],
        },
    ]
}

/// The slope of a least-squares line through logarithms.
fn exponent(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs = || points.iter().map(|&(x, y)| (x.ln(), y.ln()));
    let mean = logs().fold((0.0, 0.0), |s, (x, y)| (s.0 + x / n, s.1 + y / n));
    let (xy, xx) = logs().fold((0.0, 0.0), |s, (x, y)| {
        (
            s.0 + (x - mean.0) * (y - mean.1),
            s.1 + (x - mean.0) * (x - mean.0),
        )
    });
    xy / xx
}

fn main() {
    faer::set_global_parallelism(faer::Par::Seq);
    let quick = std::env::args().any(|a| a == "quick");
    let sizes = &SIZES[..if quick { 3 } else { 4 }];
    println!(
        "{:>5} {:>3} {:>4} {:<7} {:>10} {:>9} {:>9} {:>7} {:>9}   {:>8} {:>8} {:>8}",
        "n",
        "k",
        "m",
        "below",
        "R ms",
        "faer ms",
        "nalg. ms",
        "faster",
        "published",
        "error R",
        "faer",
        "nalg."
    );
    let mut means = Vec::new();
    let mut growth: Vec<(Below, usize, usize, usize, f64)> = Vec::new();
    for (index, &(n, published)) in sizes.iter().enumerate() {
        let (matrix, b) = system(n, 2, 50, Below::Full);
        let dense = dense(&matrix, &b);
        let fastest = dense[0].seconds.min(dense[1].seconds);
        let mut ratios = [Vec::new(), Vec::new()];
        for k in KEYS {
            for (column, m) in BLOCKS.into_iter().enumerate() {
                for below in [Below::Sparse, Below::Full] {
                    let (matrix, b) = system(n, k, m, below);
                    let r = structured(&matrix, &b);
                    growth.push((below, n, k, m, r.seconds));
                    let ratio = fastest / r.seconds;
                    ratios[usize::from(below == Below::Full)].push((k, ratio));
                    let (slow, fast) = PUBLISHED[index][column];
                    println!(
                        "{n:>5} {k:>3} {m:>4} {:<7} {:>10.3} {:>9.2} {:>9.2} {:>6.1}× {:>8.1}×   {:>8.1e} {:>8.1e} {:>8.1e}",
                        below.name(),
                        1e3 * r.seconds,
                        1e3 * dense[0].seconds,
                        1e3 * dense[1].seconds,
                        ratio,
                        slow / fast,
                        r.error,
                        dense[0].error,
                        dense[1].error,
                    );
                }
            }
        }
        means.push((n, published, ratios));
    }

    println!("\nSpeed-up over the faster of the two dense solvers, mean over block sizes:");
    println!(
        "{:>5} {:>9}   {:>28}   {:>28}",
        "n", "published", "sparse: k = 2, 5, 10", "full: k = 2, 5, 10"
    );
    for (n, published, ratios) in &means {
        let mean = |below: usize, k: usize| {
            let of = ratios[below].iter().filter(|r| r.0 == k);
            of.clone().map(|r| r.1).sum::<f64>() / of.count() as f64
        };
        let cells = |below: usize| {
            KEYS.iter()
                .map(|&k| format!("{:>8.1}×", mean(below, k)))
                .collect::<String>()
        };
        let met = |below: usize| match mean(below, 2) >= *published {
            true => "met",
            false => "MISSED",
        };
        println!(
            "{n:>5} {published:>8.1}×   {} {:<6} {} {:<6}",
            cells(0),
            met(0),
            cells(1),
            met(1)
        );
    }

    println!(
        "\nGrowth of cost, exponent fitted over all n (k = 2, 5, 10) and over all k (largest n):"
    );
    for below in [Below::Sparse, Below::Full] {
        for m in BLOCKS {
            let own = growth.iter().filter(|g| g.0 == below && g.3 == m);
            let in_n = KEYS.map(|k| {
                let of = own.clone().filter(|g| g.2 == k);
                exponent(&of.map(|g| (g.1 as f64, g.4)).collect::<Vec<_>>())
            });
            let last = sizes[sizes.len() - 1].0;
            let of = own.filter(|g| g.1 == last);
            let of: Vec<(f64, f64)> = of.map(|g| (g.2 as f64, g.4)).collect();
            println!(
                "  {:<6} m = {m:>3}: n^{:.2}, n^{:.2}, n^{:.2}; k^{:.2}",
                below.name(),
                in_n[0],
                in_n[1],
                in_n[2],
                exponent(&of),
            );
        }
    }
}
