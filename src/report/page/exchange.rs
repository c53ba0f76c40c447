//! Figures for other programs: Wavefront OBJ and XYZ.

use super::Page;
use crate::places::Each as _;
use std::fmt::Write;

/// The symbols of the elements, as XYZ files have them.
const ELEMENTS: &str = " H He Li Be B C N O F Ne Na Mg Al Si P S Cl Ar K Ca Sc Ti V Cr Mn Fe Co Ni Cu Zn \
    Ga Ge As Se Br Kr Rb Sr Y Zr Nb Mo Tc Ru Rh Pd Ag Cd In Sn Sb Te I Xe Cs Ba La Ce Pr Nd Pm Sm Eu Gd Tb \
    Dy Ho Er Tm Yb Lu Hf Ta W Re Os Ir Pt Au Hg Tl Pb Bi Po At Rn Fr Ra Ac Th Pa U Np Pu Am Cm Bk Cf Es Fm \
    Md No Lr Rf Db Sg Bh Hs Mt Ds Rg Cn Nh Fl Mc Lv Ts Og ";

impl Page {
    /// The figures as Wavefront OBJ: an object for each, its points as vertices and its bars as lines.
    /// Coordinates are those of the sketch, as floats.
    pub fn to_obj(&self) -> String {
        let mut out = format!("# {}\n", one_line(&self.title));
        let mut first = 1;
        // Writing to a string cannot fail.
        for figure in &self.figures {
            let _ = writeln!(out, "o {}", one_line(&figure.name).replace(' ', "_"));
            for p in figure.points.chunks_exact(3) {
                let _ = writeln!(out, "v {} {} {}", p[0], p[1], p[2]);
            }
            for bar in &self.bars {
                let [a, b] = bar.ends.each(|p| first + p);
                let _ = writeln!(out, "l {a} {b}");
            }
            first += self.points.len();
        }
        out
    }

    /// The solutions as XYZ, one after the other. A point named `C12` or `H_a` is an atom of the element
    /// its name begins with; names that begin with no element's symbol are written as they are.
    pub fn to_xyz(&self) -> String {
        let mut out = String::new();
        for figure in self.figures.iter().filter(|figure| figure.class.is_some()) {
            let (title, name) = (one_line(&self.title), one_line(&figure.name));
            let note = one_line(&figure.note);
            let _ = writeln!(out, "{}\n{title}: {name}, {note}", self.points.len());
            for (name, p) in self.points.iter().zip(figure.points.chunks_exact(3)) {
                let _ = writeln!(
                    out,
                    "{:<6} {:18.12} {:18.12} {:18.12}",
                    atom(name),
                    p[0],
                    p[1],
                    p[2]
                );
            }
        }
        out
    }
}

/// What stands for a point in XYZ.
fn atom(name: &str) -> String {
    let letters: String = name.chars().take_while(char::is_ascii_alphabetic).collect();
    let mut symbol = letters.to_ascii_lowercase();
    if let Some(first) = symbol.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    match letters.len() {
        1 | 2 if ELEMENTS.contains(&format!(" {symbol} ")) => symbol,
        _ => one_line(name).replace(' ', "_"),
    }
}

fn one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control(), " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn atoms_by_their_names() {
        let atoms = ["C12", "h_a", "CL1", "p1", "apex", "x y"].map(atom);
        assert_eq!(atoms, ["C", "H", "Cl", "P", "apex", "x_y"]);
    }
}
