//! Plans as text.

use super::{Arm, Plan};
use crate::problem::Problem;

impl Plan {
    /// The plan, one instruction per line, with its driving parameters k1, k2, … and its removed
    /// constraints. A prime marks a reference point.
    ///
    /// ```text
    /// p2 = interCL(p1, a(p1-p2), l1)
    /// p5 = interCC(p2, a(p2-p5), p5', k1)
    /// driving parameters: k1
    /// removed constraints: p4-p5
    /// ```
    pub fn describe(&self, problem: &Problem) -> String {
        let mut text = String::new();
        let name = |p: usize| problem.points[p].name.as_str();
        let space = self.dimension == 3;
        let first = name(problem.homotopy.reference[0]);
        let (mut driving, mut circles) = (0, 0);
        for instruction in &self.instructions {
            let p = name(instruction.point);
            let mut primes = String::new();
            let arms: Vec<String> = instruction
                .arms()
                .iter()
                .map(|arm| match *arm {
                    Arm::Edge { centre, edge } => {
                        format!("{}, a({})", name(centre), problem.distance_name(edge))
                    }
                    Arm::Driving { .. } => {
                        driving += 1;
                        primes.push('\'');
                        let centre = if instruction.arity == 1 {
                            first.to_owned()
                        } else {
                            format!("{p}{primes}")
                        };
                        format!("{centre}, k{driving}")
                    }
                })
                .collect();
            text += &match (space, arms.as_slice()) {
                (false, [a]) => format!("{p} = interCL({a}, l1)\n"),
                (true, [a]) => format!("{p} = interSL({a}, l1)\n"),
                (false, [a, b]) => format!("{p} = interCC({a}, {b})\n"),
                (_, [a, b]) => format!("{p} = interSSP({a}, {b}, pl1)\n"),
                (_, [a, b, c]) => {
                    circles += 1;
                    format!("c{circles} = interSS({a}, {b})\n{p} = interCS(c{circles}, {c})\n")
                }
                _ => String::new(),
            };
        }
        let list = |items: Vec<String>| {
            if items.is_empty() {
                "none".to_owned()
            } else {
                items.join(", ")
            }
        };
        let parameters = list((1..=driving).map(|k| format!("k{k}")).collect());
        let removed = list(
            self.removed()
                .into_iter()
                .map(|e| problem.distance_name(e))
                .collect(),
        );
        text += &format!("driving parameters: {parameters}\nremoved constraints: {removed}\n");
        text
    }
}
