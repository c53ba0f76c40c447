//! What a construction plan consists of.

/// One of the circles or spheres that an instruction intersects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Arm {
    /// Around a point placed before; the radius is a distance of the problem.
    Edge {
        /// The point at the centre.
        centre: usize,
        /// Index of the distance.
        edge: usize,
    },
    /// Around a reference point of its own, which stands still; the radius is a driving
    /// parameter. (RR 8705, definition 3, conditions (i) and (ii).)
    Driving {
        /// Where the reference point is, in the homotopy's unit (the third coordinate is zero in
        /// the plane).
        place: [f64; 3],
    },
}

impl Arm {
    /// Whether the radius is a driving parameter.
    pub fn is_driving(&self) -> bool {
        matches!(self, Arm::Driving { .. })
    }
}

/// The construction of one point (RR 8705, sections 2.3.1 and 6).
///
/// By the number of arms: one is interCL or interSL (the second reference point, on the x axis),
/// two is interCC or interSSP (every later point of the plane; in space the third reference
/// point, in the xy plane), three is interSSS, made of the elementary instructions interSS (the
/// first two arms) and interCS (the third).
#[derive(Debug, Clone, PartialEq)]
pub struct Instruction {
    /// The point constructed.
    pub point: usize,
    /// The number of arms in use: 1, 2 or 3.
    pub arity: usize,
    /// The arms; those beyond `arity` are unused.
    pub arms: [Arm; 3],
    /// The table T of original instructions (RR 8705, section 4.3.1): for the first elementary
    /// instruction the arm that the driving parameter in the second place stands in for, and for
    /// interCS the arm that the one in the third place stands in for.
    pub original: [Option<Arm>; 2],
}

impl Instruction {
    /// The elementary instructions that have boundary configurations: none for interCL, one for
    /// interCC, two for interSSS. Elementary instruction k is driven by arm `k + 1`.
    pub fn elementary(&self) -> usize {
        self.arity - 1
    }

    /// The arms in use.
    pub fn arms(&self) -> &[Arm] {
        &self.arms[..self.arity]
    }
}

/// A reparameterized construction plan (RR 8705, definition 3): the instructions in their order.
/// Driving parameters are numbered as they occur; the removed constraints are the distances that
/// no instruction uses.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// 2 or 3.
    pub dimension: usize,
    /// The number of points, the first reference point (at the origin) included.
    pub points: usize,
    /// The number of distances of the problem.
    pub edges: usize,
    /// One per point but the first reference point.
    pub instructions: Vec<Instruction>,
}

impl Plan {
    /// The number d of driving parameters.
    pub fn driving(&self) -> usize {
        self.instructions
            .iter()
            .flat_map(|i| i.arms())
            .filter(|arm| arm.is_driving())
            .count()
    }

    /// Whether no instruction is replaced at present: the table T is empty.
    pub fn is_original(&self) -> bool {
        self.instructions.iter().all(|i| i.original == [None; 2])
    }

    /// The removed constraints C⁻: as many as driving parameters.
    pub fn removed(&self) -> Vec<usize> {
        let mut used = vec![false; self.edges];
        for arm in self.instructions.iter().flat_map(|i| i.arms()) {
            if let Arm::Edge { edge, .. } = arm {
                used[*edge] = true;
            }
        }
        (0..self.edges).filter(|&e| !used[e]).collect()
    }
}
