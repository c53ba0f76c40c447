//! Certificates taken apart, to be damaged and put together again.

use krawl::certificate::{
    Reader, Record, Settings, SolutionClaim, TubeClaim, Writer, verify, write_header, write_record,
};
use krawl::edit::{Ending, Session, Setting};
use krawl::motion::Motion;
use krawl::problem::Problem;
use krawl::system::Gauge;
use krawl::track::{Control, Options, Outcome, solve};

/// The certificates in `certs/`.
pub const SHIPPED: [&str; 6] = [
    "octahedron",
    "disulfide",
    "dodecagon",
    "k33",
    "prism",
    "icosahedron-c1",
];

/// A certificate from `certs/`.
pub fn shipped(name: &str) -> Vec<u8> {
    std::fs::read(format!("certs/{name}.krawl")).unwrap()
}

/// A run with the certificate that it leaves.
pub fn of(problem: &Problem, options: &Options) -> (Outcome, Vec<u8>) {
    let mut writer = Writer::new(Vec::new(), problem);
    let mut control = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    let outcome = solve(problem, options, &mut control).unwrap();
    (outcome, writer.finish().unwrap())
}

/// Edits of a figure one after the other, each of dimensions like `a-b=5`, with the certificate that they leave.
pub fn of_edits(problem: &Problem, edits: &[&[&str]]) -> (Vec<Ending>, Vec<u8>) {
    let mut writer = Writer::new(Vec::new(), problem);
    let mut control = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    let mut session = Session::open_with(problem, &Options::certified(), &mut control).unwrap();
    let mut edit = |sets: &&[&str]| {
        let settings = sets
            .iter()
            .map(|text| Setting::parse(problem, text).unwrap());
        let settings: Vec<Setting> = settings.collect();
        session.edit_with(&settings, &mut control).ending
    };
    let endings = edits.iter().map(&mut edit).collect();
    (endings, writer.finish().unwrap())
}

/// A motion of a figure of which some dimensions are free, with the certificate that it leaves.
pub fn of_motion(problem: &Problem, free: &[&str]) -> (Motion, Vec<u8>) {
    let free: Vec<String> = free.iter().map(|&name| name.to_owned()).collect();
    let options = Options::certified();
    let motion = Motion::of(problem, &free, &[], &options, &mut Control::default()).unwrap();
    let mut writer = Writer::new(Vec::new(), motion.certified());
    let mut control = Control {
        witness: Some(&mut writer),
        ..Control::default()
    };
    motion.tell(&options, &mut control).unwrap();
    let bytes = writer.finish().unwrap();
    (motion, bytes)
}

/// The certificate of an edit of the plate in `docs/examples` to 0.001 beyond its limit, forged to one of an edit to a length that
/// differs by `off` from the limit: t is multiplied by the same factor throughout, and beyond 1 at the fold if `off` is positive.
pub fn plate_led_beside_its_limit(off: f64) -> Certificate {
    let plate = Problem::read("docs/examples/plate.toml").unwrap();
    let led_to = |length: &str| {
        let (endings, bytes) = of_edits(&plate, &[&[&format!("C-D={length}")]]);
        assert!(matches!(endings[..], [Ending::Limit(_)]));
        bytes
    };
    let verdict = verify(&led_to("30")[..], &Settings::default(), &mut |_| ()).unwrap();
    let limit = 49.5 - 19.5 * verdict.arcs[1].t.mid();
    let beyond = format!("{:.6}", limit - 1e-3);
    let mut forged = Certificate::read(&led_to(&beyond));
    let to: f64 = format!("{:.6}", limit + off).parse().unwrap();
    let factor = (49.5 - beyond.parse::<f64>().unwrap()) / (49.5 - to);
    let mut records = forged.records.iter_mut();
    let arc = records.rfind(|record| matches!(record, Record::Arc(_)));
    let Some(Record::Arc(arc)) = arc else {
        panic!("an edit has an arc");
    };
    arc.dimensions[0].1 = format!("{to:.6}").parse().unwrap();
    let behind = forged.records.iter_mut().rev();
    for record in behind.take_while(|record| !matches!(record, Record::Arc(_))) {
        match record {
            Record::Tube(tube) => {
                assert!(tube.low.is_empty());
                *tube.centre.last_mut().unwrap() *= factor;
                *tube.normal.last_mut().unwrap() /= factor as f32;
            }
            Record::Fold(fold) => fold.t *= factor,
            _ => {}
        }
    }
    forged
}

/// A certificate's parts.
#[derive(Debug, Clone)]
pub struct Certificate {
    pub program: String,
    pub problem: String,
    pub unit_exponent: i16,
    pub records: Vec<Record>,
}

impl Certificate {
    pub fn read(bytes: &[u8]) -> Self {
        let mut reader = Reader::new(bytes).unwrap();
        let header = reader.header().clone();
        let mut records = Vec::new();
        while let Some(record) = reader.next_record().unwrap() {
            records.push(record);
        }
        Certificate {
            program: header.program,
            problem: header.problem.to_toml(),
            unit_exponent: header.unit_exponent,
            records,
        }
    }

    /// The file, with hash and counts brought up to date unless they were changed on purpose.
    pub fn bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        write_header(&mut out, &self.program, &self.problem, self.unit_exponent).unwrap();
        for record in &self.records {
            write_record(&mut out, record).unwrap();
        }
        out
    }

    pub fn tubes(&self) -> usize {
        self.places(|r| matches!(r, Record::Tube(_))).len()
    }

    pub fn solutions(&self) -> usize {
        self.places(|r| matches!(r, Record::Solution(_))).len()
    }

    fn places(&self, wanted: impl Fn(&Record) -> bool) -> Vec<usize> {
        (0..self.records.len())
            .filter(|&k| wanted(&self.records[k]))
            .collect()
    }

    /// Where the k-th tube stands.
    pub fn tube_at(&self, k: usize) -> usize {
        self.places(|r| matches!(r, Record::Tube(_)))[k]
    }

    /// Where the k-th solution stands.
    pub fn solution_at(&self, k: usize) -> usize {
        self.places(|r| matches!(r, Record::Solution(_)))[k]
    }

    pub fn tube_mut(&mut self, k: usize) -> &mut TubeClaim {
        let at = self.tube_at(k);
        match &mut self.records[at] {
            Record::Tube(tube) => tube,
            _ => unreachable!(),
        }
    }

    pub fn solution_mut(&mut self, k: usize) -> &mut SolutionClaim {
        let at = self.solution_at(k);
        match &mut self.records[at] {
            Record::Solution(solution) => solution,
            _ => unreachable!(),
        }
    }

    pub fn classes_mut(&mut self) -> &mut Vec<u32> {
        match self.records.last_mut() {
            Some(Record::End(end)) => &mut end.classes,
            _ => unreachable!(),
        }
    }

    /// Makes the end's count of tubes right.
    pub fn recount(&mut self) {
        let tubes = self.tubes() as u64;
        if let Some(Record::End(end)) = self.records.last_mut() {
            end.tubes = tubes;
        }
    }

    /// Leaves some tubes out.
    pub fn keep_tubes(&mut self, keep: impl Fn(usize) -> bool) {
        let mut k = 0;
        self.records.retain(|record| {
            if !matches!(record, Record::Tube(_)) {
                return true;
            }
            k += 1;
            keep(k - 1)
        });
        self.recount();
    }

    /// The unknowns that change their sign in the mirror image.
    pub fn mirrored_unknowns(&self) -> Vec<usize> {
        let problem = krawl::problem::Problem::parse(&self.problem, "").unwrap();
        let d = problem.dimension;
        let place = Gauge::new(&problem).place;
        (0..place.len())
            .filter(|&i| place[i] % d == d - 1)
            .collect()
    }
}
