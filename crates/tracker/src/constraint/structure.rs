//! Whether there are as many equations as unknowns, and none of them says what others say already.
//!
//! The rank of the Jacobian is taken at random values of all unknowns modulo a prime. Where it is too
//! small there, it is too small everywhere: the determinant is the zero polynomial (but for bad luck with
//! a probability below m / 2⁶⁰ for m equations; Schwartz, Zippel). The converse does not hold: at random values
//! right-hand sides are random too, and a constraint may follow from others only where those are met, as the
//! third of three parallelisms does.

use super::lowering::Lowered;
use super::quadratic::{Entry, Form};
use super::{Owner, try_lower, try_lower_apart, try_lower_editable};
use crate::elimination::Echelon;
use crate::equations::{Product, Ring};
use crate::places::Each as _;
use crate::residues::{Residue, Residues};
use crate::statement::{DEPENDS, Problem, counted, list};

/// Most names in one list of a message.
const LISTED: usize = 8;

/// All equations of a problem, distances among them, as their Jacobian sees them.
struct System<'a> {
    problem: &'a Problem,
    lowered: Lowered,
    /// For each coordinate of each point its column, if it is free.
    columns: Vec<Option<usize>>,
    /// How many columns there are: free coordinates, then auxiliary unknowns.
    width: usize,
}

impl<'a> System<'a> {
    fn new(problem: &'a Problem) -> Result<Self, (Owner, String)> {
        Ok(Self::of(problem, try_lower(problem)?))
    }

    fn of(problem: &'a Problem, lowered: Lowered) -> Self {
        let mut columns = vec![None; problem.points.len() * problem.dimension];
        let mut width = 0;
        for point in 0..problem.points.len() {
            let reference = &problem.homotopy.reference;
            let free = reference.iter().position(|&r| r == point);
            for axis in 0..free.unwrap_or(problem.dimension) {
                columns[point * problem.dimension + axis] = Some(width);
                width += 1;
            }
        }
        width += lowered.tail.unknowns.len();
        System {
            problem,
            lowered,
            columns,
            width,
        }
    }

    fn equations(&self) -> usize {
        self.problem.distances.len() + self.lowered.tail.equations.len()
    }

    /// The column of an entry, if it is an unknown.
    fn column(&self, entry: Entry) -> Option<usize> {
        match entry {
            Entry::Zero => None,
            Entry::Coordinate { point, axis } => {
                self.columns[point * self.problem.dimension + axis]
            }
            Entry::Unknown(u) => Some(self.width - self.lowered.tail.unknowns.len() + u),
        }
    }

    /// The products of an equation, of columns.
    fn products(&self, equation: usize) -> Vec<Product<Option<usize>>> {
        let by_column = |product: Product<Entry>| product.map(|entry| self.column(entry));
        match equation.checked_sub(self.problem.distances.len()) {
            Some(equation) => {
                let products = self.lowered.tail.equations[equation].products.iter();
                products.copied().map(by_column).collect()
            }
            None => {
                let [a, b] = self.problem.distances[equation].points;
                let along = (0..self.problem.dimension).map(|axis| {
                    let [from, to] = [a, b].each(|point| Entry::Coordinate { point, axis });
                    let form = Form::Difference(from, to);
                    Product::new(1, form, form)
                });
                along.map(by_column).collect()
            }
        }
    }

    /// What people call the source of an equation.
    fn name(&self, equation: usize) -> String {
        let distances = self.problem.distances.len();
        if equation < distances {
            return format!("the distance {}", self.problem.distance_name(equation));
        }
        let (owner, objects) = (
            self.lowered.owners[equation - distances],
            self.problem.objects.len(),
        );
        if owner < objects {
            return format!("`{}`", self.problem.objects[owner].name);
        }
        match owner - objects {
            index if index < self.problem.constraints.len() => {
                format!("`{}`", self.problem.constraint_name(index))
            }
            _ => self.lowered.tail.equations[equation - distances]
                .name
                .clone(),
        }
    }

    /// Whether an equation is all that its source says, and that is no object.
    fn is_whole(&self, equation: usize) -> bool {
        let Some(equation) = equation.checked_sub(self.problem.distances.len()) else {
            return true;
        };
        let owners = &self.lowered.owners;
        let owner = owners[equation];
        let count = owners.iter().filter(|&&other| other == owner).count();
        count == 1 && owner >= self.problem.objects.len()
    }

    /// The names of the sources of equations, each once.
    fn names(&self, equations: impl Iterator<Item = usize>) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for equation in equations {
            let name = self.name(equation);
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    /// What moves where these columns do: points, then auxiliary unknowns that no equation gives.
    fn movers(&self, moves: impl Fn(usize) -> bool) -> Vec<String> {
        let dimension = self.problem.dimension;
        let points = (0..self.problem.points.len()).filter(|point| {
            let columns = &self.columns[point * dimension..(point + 1) * dimension];
            columns.iter().flatten().any(|&column| moves(column))
        });
        let mut names: Vec<String> = points
            .map(|point| format!("`{}`", self.problem.points[point].name))
            .collect();
        for (index, object) in self.problem.objects.iter().enumerate() {
            let mut own = self.lowered.tail.objects[index].iter();
            if own.any(|&entry| self.column(entry).is_some_and(&moves)) {
                names.push(format!("`{}`", object.name));
            }
        }
        names
    }
}

/// The number of unknowns and of equations of a checked problem, distances among them.
pub fn size(problem: &Problem) -> (usize, usize) {
    match System::new(problem) {
        Ok(system) => (system.width, system.equations()),
        Err((_, fault)) => panic!("the problem has not been checked: {fault}"),
    }
}

/// The number of unknowns where dimensions of a checked problem are edited: with left-hand sides that depend on no value
/// there may be more of them.
pub fn size_in_edits(problem: &Problem) -> usize {
    match try_lower_editable(problem, None) {
        Ok(lowered) => problem.free_coordinates() + lowered.tail.unknowns.len(),
        Err((_, fault)) => panic!("the problem has not been checked: {fault}"),
    }
}

/// What to point at, and whether it is at fault by itself.
type Blame = Option<(Owner, bool)>;

/// What is wrong with a constraint, or with all of them together: what to point at, and a message.
pub fn check_structure(problem: &Problem) -> Result<(), (Blame, String)> {
    let at_fault = |(owner, fault): (Owner, String)| (Some((owner, true)), fault);
    let mut system = System::new(problem).map_err(at_fault)?;
    let mut found = system.eliminate();
    let (equations, unknowns) = (system.equations(), system.width);
    if equations == unknowns && found.rows.rank == unknowns {
        return Ok(());
    }
    let auxiliary = system.lowered.tail.unknowns.len();
    let (to_spare, is_loose) = (equations - found.rows.rank, found.rows.rank < unknowns);
    // Which constraints depend on each other is told from equations that have no number of a distance in them.
    let gives_lengths = system.lowered.gives_lengths;
    if found.circuit.is_some() && gives_lengths {
        system = System::of(problem, try_lower_apart(problem).map_err(at_fault)?);
        found = system.eliminate();
    }
    let mut parts = Vec::new();
    let mut place = None;
    if let Some(circuit) = &found.circuit {
        let names = system.names(circuit.iter().copied());
        let distances = problem.distances.len();
        let in_part = |equation: &usize| !system.is_whole(*equation);
        let whole = system.names(circuit.iter().copied().filter(|e| !in_part(e)));
        let remove = match whole.as_slice() {
            [] => String::new(),
            whole if whole.len() == names.len() => ", remove one of them".to_owned(),
            // At figures of other lengths these may say something new.
            _ if gives_lengths && circuit.iter().all(|e| in_part(e) || *e < distances) => {
                String::new()
            }
            [one] => format!(", remove {one}"),
            whole => format!(", remove one of {}", list(whole, LISTED)),
        };
        let part = match circuit.iter().all(in_part) {
            true => "in part ",
            false => "",
        };
        parts.push(match names.as_slice() {
            [one] => format!("over-constrained: {one} says something twice, or contradicts itself"),
            _ => format!(
                "over-constrained: any of {} {part}{DEPENDS}{remove}{}",
                list(&names, LISTED),
                match to_spare {
                    1 => String::new(),
                    n => format!(" ({n} equations in all are to spare)"),
                }
            ),
        });
        let last = *circuit.last().expect("a circuit has members");
        let objects = problem.objects.len();
        place = last
            .checked_sub(problem.distances.len())
            .map(|e| system.lowered.owners[e])
            .and_then(|owner| match owner.checked_sub(objects) {
                None => Some(Owner::Object(owner)),
                Some(c) if c < problem.constraints.len() => Some(Owner::Constraint(c)),
                _ => None,
            });
    }
    if is_loose {
        let motion = found.motion();
        let movers = system.movers(|column| motion[column] != Residue::whole(0));
        let against = if problem.is_absolute() {
            String::new()
        } else {
            let names = problem.homotopy.reference.iter();
            let names: Vec<String> = names
                .map(|&p| format!("`{}`", problem.points[p].name))
                .collect();
            format!(" against {}", list(&names, LISTED))
        };
        parts.push(format!(
            "under-constrained: {} can still move{against}",
            list(&movers, LISTED),
        ));
    }
    let kinds = match problem.points.is_empty() {
        true => String::new(),
        false => format!(
            " ({} of points, {auxiliary} auxiliary)",
            unknowns - auxiliary
        ),
    };
    let message = format!(
        "there are {}{kinds} and {}: {}",
        counted(unknowns, "unknown"),
        counted(equations, "equation"),
        parts.join("; ")
    );
    Err((place.map(|owner| (owner, false)), message))
}

/// The Jacobian at random values modulo a prime, in row echelon form.
struct Eliminated {
    /// Columns are in the order of elimination, auxiliary unknowns first.
    rows: Echelon<Residue>,
    /// The equations that depend on each other, the last of which is the first that adds nothing.
    circuit: Option<Vec<usize>>,
    /// How many auxiliary unknowns there are.
    auxiliary: usize,
}

impl System<'_> {
    fn eliminate(&self) -> Eliminated {
        let mut residues = Residues::new(0x6b72_6177_6c00_0003);
        let at: Vec<Residue> = (0..self.width).map(|_| residues.draw()).collect();
        let (width, equations) = (self.width, self.equations());
        // Auxiliary unknowns first: they have pivots of their own.
        let auxiliary = self.lowered.tail.unknowns.len();
        let order = |column: usize| (column + auxiliary) % width.max(1);
        let value = |column: Option<usize>| column.map_or(Residue::whole(0), |c| at[c]);
        let (rows, circuit) = Echelon::of((equations, width), |equation, row| {
            for product in self.products(equation) {
                for (column, sign, slope) in product.derivatives(value) {
                    if let Some(column) = column {
                        let entry = &mut row[order(column)];
                        *entry = *entry + Residue::whole(sign * product.factor) * slope;
                    }
                }
            }
        });
        Eliminated {
            rows,
            circuit,
            auxiliary,
        }
    }
}

impl Eliminated {
    /// A random element of the null space, by column.
    fn motion(&self) -> Vec<Residue> {
        let mut residues = Residues::new(0x6b72_6177_6c00_0004);
        let eliminated = self.rows.null_vector(|_| residues.draw());
        let width = eliminated.len();
        (0..width)
            .map(|column| eliminated[(column + self.auxiliary) % width])
            .collect()
    }
}
