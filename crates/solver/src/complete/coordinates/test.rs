//! Equations that were left out, as there are more than unknowns: how far each figure found is from meeting them.

use crate::blocks::{Account, LeftOut, Ruler, Verdict, Whose};
use crate::constraint::Spare;
use crate::interval::{Interval, ZERO, point};
use crate::order::add_new;
use crate::problem::Problem;
use crate::system::Homotopy;
use crate::track::FigureBox;

/// What figures are tested against.
pub struct Test<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// Its equations.
    pub homotopy: &'a Homotopy,
    /// Within what an equation counts as met, where that is not told by the digits of its number.
    pub tolerance: Option<f64>,
}

impl Test<'_> {
    /// What was left out, by whose it is.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for spare in &self.homotopy.spare {
            add_new(&mut names, self.name(spare));
        }
        names
    }

    fn name(&self, spare: &Spare) -> String {
        Whose::of(self.problem, spare.owner).name(self.problem)
    }

    /// How a figure stands to each constraint of which equations were left out: the worst of these.
    pub fn account(&self, figure: &FigureBox) -> Vec<LeftOut> {
        let mut account = Account::default();
        for spare in &self.homotopy.spare {
            account.leave_out(self.name(spare), self.verdict(spare, figure));
        }
        account.left_out
    }

    fn verdict(&self, spare: &Spare, figure: &FigureBox) -> Verdict {
        let Spare { equation, owner } = spare;
        let owner = Whose::of(self.problem, *owner);
        let unknown = |e| self.homotopy.entry(e);
        let at = |e| unknown(e).map_or(ZERO, |i| figure.figure.enclosure(i));
        let products = equation.products.iter();
        let left = products.fold(ZERO, |sum, product| {
            let half = point(0.5 * f64::from(product.factor));
            // A square is not negative.
            let both = match product.left == product.right {
                true => product.left.value(at).sqr(),
                false => product.value(at),
            };
            sum + half * both
        });
        // Powers of two.
        let unit = point(self.homotopy.unit.powi(equation.power));
        let right = equation.right.iter().fold(ZERO, |sum, e| sum + e.enclose());
        let off = left * unit - right;
        // A distance's equation has half its square on both sides.
        let twice = |x: Interval| {
            if matches!(owner, Whose::Distance(_)) {
                x * point(2.0)
            } else {
                x
            }
        };
        let about = (self.homotopy.unit, equation.power);
        let ruler = Ruler::new(self.problem, owner, about, self.tolerance);
        ruler.verdict(twice(off), twice(right))
    }
}
