//! The process: what is taken from the queue, what comes of it, and when it ends.

use super::construction::Construction;
use super::follow::{Candidate, Job, Limits, SAME_LENGTHS, have_same_form, job, lengths_of};
use super::index::{Index, agree};
use super::record::{Class, End, Met, PathRecord, Sketch, bounds, intervals};
use super::store::{Change, Contents, Store, StoreError};
use super::way::Way;
use super::{ExploreError, Finish, Options, Progress, Share};
use crate::places::Each as _;
use crate::problem::Problem;
use crate::random::Random;
use crate::system::Homotopy;
use crate::track::{FigureBox, Relation, prove_figure};
use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Plans that ways take turns with.
const PLANS: usize = 8;
/// Branches of a plan that are followed from one solution.
const BRANCHES: usize = 4096;
/// Between two looks at the clock.
const TICK: Duration = Duration::from_millis(100);
/// Two sketches look the same where all numbers of their look agree so far, relatively.
const SAME_LOOK: f64 = 1e-9;
/// Numbers in a look.
const LOOK: usize = 4;

/// A process with its store.
#[derive(Debug)]
pub struct Explorer {
    problem: Problem,
    base: Homotopy,
    plans: Vec<Construction>,
    store: Store,
    contents: Contents,
    queue: BTreeSet<u64>,
    next: u64,
    looks: Index,
    /// Paths by the lengths of their sketches.
    lengths: Index,
}

/// Numbers that are the same for congruent figures, and hardly ever for others: sums of squares of all distances
/// between points, with weights by chance.
pub fn look(figure: &[[f64; 3]], unit: f64) -> Vec<f64> {
    let mut random = Random::new(1);
    let mut sums = vec![0.0; LOOK];
    for (i, a) in figure.iter().enumerate() {
        for b in &figure[..i] {
            let square: f64 = (0..3).map(|k| ((a[k] - b[k]) / unit).powi(2)).sum();
            for sum in &mut sums {
                *sum += (1.5 + 0.5 * random.symmetric()) * square;
            }
        }
    }
    sums
}

impl Explorer {
    /// Opens or makes the store in a folder. The process begins with the problem's sketch, or goes on.
    pub fn open(problem: &Problem, folder: &std::path::Path) -> Result<Self, ExploreError> {
        let base = servable(problem)?;
        let (store, contents) = Store::open(folder, &problem.to_toml())?;
        Ok(Self::with(problem.clone(), base, store, contents))
    }

    /// Opens the store in a folder that has one.
    pub fn existing(folder: &std::path::Path) -> Result<Self, ExploreError> {
        let (store, text, contents) = Store::existing(folder)?;
        let problem = Problem::parse(&text, "the store's problem")
            .map_err(|e| ExploreError::Problem(e.to_string()))?;
        let base = servable(&problem)?;
        Ok(Self::with(problem, base, store, contents))
    }

    fn with(problem: Problem, base: Homotopy, store: Store, contents: Contents) -> Self {
        let plans = Construction::some(&problem, PLANS);
        let mut explorer = Explorer {
            queue: contents.queue(),
            next: contents.sketches.keys().last().map_or(0, |last| last + 1),
            looks: Index::default(),
            lengths: Index::default(),
            problem,
            base,
            plans,
            store,
            contents,
        };
        let sketches: Vec<u64> = explorer.contents.sketches.keys().copied().collect();
        for id in sketches {
            explorer.enter_look(id);
            if explorer.contents.paths.contains_key(&id) {
                explorer.enter_lengths(id);
            }
        }
        explorer
    }

    /// The problem.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// All that was found so far.
    pub fn contents(&self) -> &Contents {
        &self.contents
    }

    /// The folder of the store.
    pub fn folder(&self) -> &std::path::Path {
        self.store.folder()
    }

    /// The way of a number.
    pub fn way(&self, number: usize) -> Way {
        Way::new(&self.problem, &self.plans, number)
    }

    /// The first way with the same bend: sketches of both have the same paths.
    fn group(&self, number: usize) -> usize {
        let way = self.way(number);
        (0..number)
            .find(|&k| self.way(k).bends_like(&way))
            .unwrap_or(number)
    }

    /// The problem of a path: its sketch, its bend.
    pub fn problem_of(&self, id: u64) -> Option<Problem> {
        let sketch = self.contents.sketches.get(&id)?;
        let way = self.way(sketch.way);
        Some(way.problem(&self.problem, sketch.places()))
    }

    fn enter_look(&mut self, id: u64) {
        let sketch = &self.contents.sketches[&id];
        let (group, at) = (self.group(sketch.way), sketch.look[0]);
        self.looks.insert(group, at, id);
    }

    fn enter_lengths(&mut self, id: u64) {
        let has_starts = self
            .contents
            .paths
            .get(&id)
            .is_some_and(|path| !path.starts.is_empty());
        let Some(problem) = self.problem_of(id).filter(|_| has_starts) else {
            return;
        };
        let group = self.group(self.contents.sketches[&id].way);
        self.lengths.insert(group, self.sum(&problem), id);
    }

    fn sum(&self, problem: &Problem) -> f64 {
        lengths_of(problem).iter().sum::<f64>() / self.base.unit
    }

    /// Adds a sketch to a change, unless one that looks the same was drawn before for the same paths.
    fn draw(
        &mut self,
        change: &mut Change,
        (number, from): (usize, Option<(u64, u64)>),
        figure: Option<Vec<[f64; 3]>>,
    ) {
        let places = figure.clone().unwrap_or_else(|| self.problem.places());
        let look = look(&places, self.base.unit);
        let group = self.group(number);
        let known = &self.contents.sketches;
        let mut near = self.looks.near(group, look[0]);
        if near.any(|id| agree(&known[&id].look, &look, SAME_LOOK)) {
            self.contents.state.repeated += 1;
            return;
        }
        drop(near);
        let id = self.next;
        self.next += 1;
        let way = self.way(number);
        let points = figure.map(|mut figure| {
            let mut random = Random::new(id);
            let size = way.shake * self.base.unit;
            for place in &mut figure {
                let off = random.jitter(self.problem.dimension, size);
                (0..3).for_each(|k| place[k] += off[k]);
            }
            figure
        });
        let sketch = Sketch {
            id,
            way: number,
            from,
            points: points.unwrap_or_default(),
            look,
        };
        self.contents.sketches.insert(id, sketch.clone());
        self.queue.insert(id);
        self.enter_look(id);
        change.sketches.push(sketch);
    }

    /// Adds the sketches of a way that a solution gives.
    fn expand(&mut self, change: &mut Change, class: &Class, number: usize) {
        let way = self.way(number);
        let middles = |p: &[[f64; 2]; 3]| p.each(|[a, b]| 0.5 * (a + b));
        let figure: Vec<[f64; 3]> = class.points.iter().map(middles).collect();
        let plan = &self.plans[way.plan];
        let branches = plan.branches(self.problem.dimension, &figure, BRANCHES);
        for (branch, figure) in branches {
            self.draw(change, (number, Some((class.id, branch))), Some(figure));
        }
    }

    /// Opens the next way: the problem's sketch, and those of all solutions.
    fn open_way(&mut self, change: &mut Change) {
        let number = self.contents.state.ways;
        self.contents.state.ways += 1;
        self.contents.state.known_before = self.contents.classes.len();
        self.draw(change, (number, None), None);
        for class in self.contents.classes.clone() {
            self.expand(change, &class, number);
        }
    }

    /// Takes what came of a sketch into account: its solutions that are new, and their sketches.
    fn take(&mut self, change: &mut Change, record: PathRecord) {
        let id = record.id;
        self.queue.remove(&id);
        self.contents.out.remove(&id);
        let same_form = match record.solutions.is_empty() {
            true => true,
            false => self
                .problem_of(id)
                .and_then(|problem| Homotopy::new(&problem).ok())
                .is_some_and(|homotopy| have_same_form(&homotopy, &self.base)),
        };
        for met in &record.solutions {
            if !same_form {
                self.contents.state.undecided += 1;
                continue;
            }
            match self.class_of(met) {
                Ok(Some(_)) => {}
                Ok(None) => {
                    let class = Class {
                        id: self.contents.classes.len() as u64,
                        path: id,
                        points: met.points.clone(),
                        figure: met.figure.clone(),
                    };
                    self.contents.classes.push(class.clone());
                    change.classes.push(class.clone());
                    for number in 0..self.contents.state.ways {
                        self.expand(change, &class, number);
                    }
                }
                Err(Undecided) => self.contents.state.undecided += 1,
            }
        }
        self.contents.paths.insert(id, record.clone());
        self.enter_lengths(id);
        change.paths.push(record);
    }

    /// The class that a solution is in, or `None` where it is proved to be in none of those known.
    fn class_of(&self, met: &Met) -> Result<Option<u64>, Undecided> {
        let figure = met.figure.figure();
        match self.compare(&figure) {
            Ok(answer) => Ok(answer),
            // A box made anew may be tighter.
            Err(Undecided) => {
                let again = prove_figure(&self.base, &figure.figure.centre, false);
                self.compare(&again.map_err(|_| Undecided)?)
            }
        }
    }

    fn compare(&self, figure: &FigureBox) -> Result<Option<u64>, Undecided> {
        let mut all_differ = true;
        for class in &self.contents.classes {
            match figure.relation(&class.figure.figure(), &self.base) {
                Relation::Congruent => return Ok(Some(class.id)),
                Relation::Different => {}
                Relation::Unknown => all_differ = false,
            }
        }
        match all_differ {
            true => Ok(None),
            false => Err(Undecided),
        }
    }

    /// The job of a sketch, with the paths that may pass through it.
    fn job(&self, id: u64) -> Job {
        let sketch = self.contents.sketches[&id].clone();
        let way = self.way(sketch.way);
        let problem = way.problem(&self.problem, sketch.places());
        let lengths = lengths_of(&problem);
        let group = self.group(sketch.way);
        let near = self.lengths.near(group, self.sum(&problem));
        let candidates = near.filter_map(|other| {
            let problem = self.problem_of(other)?;
            agree(&lengths_of(&problem), &lengths, SAME_LENGTHS).then(|| Candidate {
                id: other,
                starts: self.contents.paths[&other].starts.clone(),
                problem,
            })
        });
        let candidates = candidates.collect();
        job(&self.problem, &way, sketch, candidates)
    }

    fn commit(&mut self, change: &mut Change) -> Result<(), StoreError> {
        self.store
            .commit(std::mem::take(change), &self.contents.state)
    }

    /// Follows sketches until nothing new comes, or the budget ends.
    ///
    /// Every path is in the store before it counts as done.
    pub fn run(&mut self, options: &Options) -> Result<Finish, ExploreError> {
        let clock = Instant::now();
        let before = self.contents.state.seconds;
        let limits = Limits {
            most_tubes: options.most_tubes,
            cancel: options.cancel,
            deadline: options.time.map(|time| clock + time),
        };
        let pool = super::pool(options.jobs)?;
        let jobs = pool.current_num_threads();
        let mut change = Change::default();
        if options.take_back {
            change.back = std::mem::take(&mut self.contents.out).into_keys().collect();
            self.queue.extend(&change.back);
        }
        if self.contents.state.ways == 0 {
            self.open_way(&mut change);
        }
        self.commit(&mut change)?;
        let (send, receive) = channel::<(u64, Option<PathRecord>)>();
        let mut busy: BTreeSet<u64> = BTreeSet::new();
        let (mut followed, mut shown) = (0u64, None::<Instant>);
        let limits = &limits;
        pool.in_place_scope(|scope| {
            loop {
                let may_start = |started: u64| {
                    !limits.is_over() && options.paths.is_none_or(|most| started < most)
                };
                // Some more than there are threads, so that none waits for this one.
                while busy.len() < 2 * jobs && may_start(followed + busy.len() as u64) {
                    let Some(&id) = self.queue.iter().find(|id| !busy.contains(*id)) else {
                        break;
                    };
                    busy.insert(id);
                    let (job, send) = (self.job(id), send.clone());
                    scope.spawn(move |_| {
                        let run = catch_unwind(AssertUnwindSafe(|| job.run(limits)));
                        let record = run.unwrap_or_else(|_| Some(broken(id)));
                        // Nobody listens where the process has failed.
                        let _ = send.send((id, record));
                    });
                }
                if busy.is_empty() {
                    if limits.is_over() || !may_start(followed) {
                        return Ok(match limits.was_cancelled() {
                            true => Finish::Interrupted,
                            false => Finish::Budget,
                        });
                    }
                    if !self.contents.out.is_empty() {
                        return Ok(Finish::Shared(self.contents.out.len()));
                    }
                    // The ways opened so far give nothing that was not followed.
                    if let Some(finish) = self.next_way(options, &mut change) {
                        self.contents.state.seconds = before + clock.elapsed().as_secs_f64();
                        self.commit(&mut change)?;
                        return Ok(finish);
                    }
                    self.commit(&mut change)?;
                    continue;
                }
                let mut arrived = Vec::new();
                match receive.recv_timeout(TICK) {
                    Ok(first) => {
                        arrived.push(first);
                        // What else is there goes into the same transaction.
                        arrived.extend(receive.try_iter());
                    }
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => unreachable!("a sender is kept here"),
                }
                for (id, record) in arrived {
                    busy.remove(&id);
                    if let Some(record) = record {
                        followed += u64::from(record.end != End::Recognised);
                        self.take(&mut change, record);
                    }
                }
                if !change.is_empty() {
                    self.contents.state.seconds = before + clock.elapsed().as_secs_f64();
                    self.commit(&mut change)?;
                }
                if let Some(progress) = options.progress
                    && shown.is_none_or(|last| last.elapsed() >= TICK)
                {
                    shown = Some(Instant::now());
                    let seconds = clock.elapsed().as_secs_f64();
                    progress(Progress {
                        paths: followed,
                        solutions: self.contents.classes.len(),
                        queue: self.queue.len(),
                        way: self.contents.state.ways - 1,
                        rate: followed as f64 / seconds.max(1e-9),
                    });
                }
            }
        })
    }

    /// Closes the way opened last and opens another one, unless so many in a row found nothing new.
    fn next_way(&mut self, options: &Options, change: &mut Change) -> Option<Finish> {
        let state = &mut self.contents.state;
        let grew = self.contents.classes.len() > state.known_before;
        let idle = if grew { 0 } else { state.idle + 1 };
        if idle >= options.patience {
            return Some(Finish::Ended);
        }
        state.idle = idle;
        self.open_way(change);
        None
    }

    /// Puts the sketches of the queue into work units, as many as wanted and no more than there are sketches. Each is
    /// handed to `write` with its number before the store knows of it. Tells how many they are.
    pub fn share(
        &mut self,
        count: usize,
        write: &mut dyn FnMut(u64, &Share) -> Result<(), ExploreError>,
    ) -> Result<usize, ExploreError> {
        let mut change = Change::default();
        if self.contents.state.ways == 0 {
            self.open_way(&mut change);
        }
        let waiting: Vec<u64> = self.queue.iter().copied().collect();
        let count = count.min(waiting.len());
        for k in 0..count {
            let unit = self.contents.state.units;
            self.contents.state.units += 1;
            // One in turn to each: neighbours take about as long.
            let ids: Vec<u64> = waiting.iter().copied().skip(k).step_by(count).collect();
            let sketches = ids.iter().map(|id| {
                let sketch = self.contents.sketches[id].clone();
                let way = self.way(sketch.way);
                (sketch, way.bend, way.coefficient)
            });
            let sketches = sketches.collect();
            let problem = self.problem.to_toml();
            write(unit, &Share { problem, sketches })?;
            for id in ids {
                change.out.push((id, unit));
                self.contents.out.insert(id, unit);
                self.queue.remove(&id);
            }
        }
        self.commit(&mut change)?;
        Ok(count)
    }

    /// Takes results of work units into the store: every box is proved again here, and what is known already is left
    /// alone. Tells how many paths were new.
    pub fn merge(&mut self, records: Vec<PathRecord>) -> Result<usize, ExploreError> {
        let (mut change, mut new) = (Change::default(), 0);
        for mut record in records {
            let is_open = self.contents.sketches.contains_key(&record.id)
                && !self.contents.paths.contains_key(&record.id);
            if !is_open {
                continue;
            }
            new += 1;
            let own = self
                .problem_of(record.id)
                .and_then(|problem| Homotopy::new(&problem).ok());
            // Where files come from is not known: boxes are taken from a proof made here, and that a path passes
            // through a figure is not proved again.
            record.starts.clear();
            if record.end == End::Recognised {
                record.end = End::Stopped;
            }
            record.solutions.retain_mut(|met| match &own {
                Some(homotopy) => prove_again(homotopy, met),
                None => false,
            });
            self.take(&mut change, record);
        }
        self.commit(&mut change)?;
        Ok(new)
    }
}

/// Proves a solution's box anew and replaces it. False: it could not be proved.
fn prove_again(homotopy: &Homotopy, met: &mut Met) -> bool {
    if met.figure.centre.len() != homotopy.equations {
        return false;
    }
    let Ok(figure) = prove_figure(homotopy, &met.figure.centre, false) else {
        return false;
    };
    let points = figure.points(homotopy);
    let overlap = points
        .iter()
        .flatten()
        .zip(intervals(&met.points).iter().flatten())
        .all(|(a, b)| a.inf() <= b.sup() && b.inf() <= a.sup());
    met.points = bounds(&points);
    met.figure = super::record::BoxRecord::of(&figure);
    overlap
}

struct Undecided;

fn broken(id: u64) -> PathRecord {
    let reason = "this is a bug in krawl, please report it".to_owned();
    PathRecord::new(id, End::Stopped, Some(reason))
}

/// The homotopy of a problem for which sketches can be made.
fn servable(problem: &Problem) -> Result<Homotopy, ExploreError> {
    let no = |why: &str| Err(ExploreError::Unserved(why.to_owned()));
    if problem.distances.is_empty() {
        return no("there are no distances between points, from which plans are made");
    }
    if problem.is_absolute() {
        return no("constraints fix the figure in a frame of its own");
    }
    use crate::problem::Shape;
    let own = |shape: &Shape| {
        matches!(
            shape,
            Shape::FreeLine { .. }
                | Shape::FreePlane { .. }
                | Shape::Round { .. }
                | Shape::Body { .. }
        )
    };
    match problem.objects.iter().find(|object| own(&object.shape)) {
        Some(object) => no(&format!(
            "{} has coordinates of its own, and plans place points only",
            object.name
        )),
        None => Homotopy::new(problem).map_err(|e| ExploreError::Problem(e.to_string())),
    }
}
