//! Figures for other programs: DXF, Wavefront OBJ and XYZ.

use super::Page;
use crate::import::ELEMENTS;
use crate::places::Each as _;

impl Page {
    /// The figures as Wavefront OBJ: an object for each, its points as vertices and its bars as lines.
    /// Coordinates are those of the sketch, as floats.
    pub fn to_obj(&self) -> String {
        let mut out = format!("# {}\n", one_line(&self.title));
        let mut first = 1;
        for figure in &self.figures {
            out += &format!("o {}\n", one_line(&figure.name).replace(' ', "_"));
            for p in figure.points.chunks_exact(3) {
                out += &format!("v {} {} {}\n", p[0], p[1], p[2]);
            }
            for bar in &self.bars {
                let [a, b] = bar.ends.each(|p| first + p);
                out += &format!("l {a} {b}\n");
            }
            first += self.points.len();
        }
        out
    }

    /// The solutions as DXF (of AutoCAD's release 12), each in a layer of its name, in the coordinates of the sketch: lines between the
    /// points that they go through, circles and arcs; of a figure without these its bars.
    pub fn to_dxf(&self) -> String {
        let mut out =
            "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n"
                .to_owned();
        let mut shapes = self.shapes.iter();
        let is_drawn = shapes
            .any(|shape| shape.ends.is_some() || matches!(shape.kind.as_str(), "circle" | "arc"));
        for figure in self.figures.iter().filter(|figure| figure.class.is_some()) {
            let plain = |c: char| {
                if c.is_ascii_alphanumeric() {
                    c.to_ascii_uppercase()
                } else {
                    '_'
                }
            };
            // Names of layers have 31 characters at most.
            let layer: String = figure.name.chars().map(plain).take(31).collect();
            // Groups of a code and a number.
            let mut entity = |kind: &str, groups: &[(u32, f64)]| {
                out += &format!("0\n{kind}\n8\n{layer}\n");
                for (code, number) in groups {
                    out += &format!("{code}\n{number}\n");
                }
            };
            let place = |p: usize, code: u32| {
                (0..3).map(move |k| (code + 10 * k, figure.points[3 * p + k as usize]))
            };
            let mut line = |[a, b]: [usize; 2]| {
                entity(
                    "LINE",
                    &place(a, 10).chain(place(b, 11)).collect::<Vec<_>>(),
                );
            };
            self.shapes
                .iter()
                .filter_map(|shape| shape.ends)
                .for_each(&mut line);
            if !is_drawn {
                self.bars.iter().map(|bar| bar.ends).for_each(line);
            }
            for (shape, numbers) in self.shapes.iter().zip(&figure.outlines) {
                let degrees = |k: usize| {
                    let (dx, dy) = (numbers[k] - numbers[0], numbers[k + 1] - numbers[1]);
                    dy.atan2(dx).to_degrees()
                };
                let middle = |radius: f64| {
                    [
                        (10, numbers[0]),
                        (20, numbers[1]),
                        (30, numbers[2]),
                        (40, radius),
                    ]
                };
                match (shape.kind.as_str(), &numbers[..]) {
                    ("circle", &[_, _, _, radius]) => entity("CIRCLE", &middle(radius)),
                    // Counter-clockwise from the first angle to the second.
                    ("arc", &[.., radius]) if numbers.len() == 10 => {
                        let (from, to) = if radius < 0.0 { (6, 3) } else { (3, 6) };
                        let angles = [(50, degrees(from)), (51, degrees(to))];
                        entity("ARC", &[&middle(radius.abs())[..], &angles].concat());
                    }
                    _ => {}
                }
            }
        }
        out + "0\nENDSEC\n0\nEOF\n"
    }

    /// The solutions as XYZ, one after the other. A point named `C12` or `H_a` is an atom of the element
    /// its name begins with; names that begin with no element's symbol are written as they are.
    pub fn to_xyz(&self) -> String {
        let mut out = String::new();
        for figure in self.figures.iter().filter(|figure| figure.class.is_some()) {
            let (title, name) = (one_line(&self.title), one_line(&figure.name));
            let note = one_line(&figure.note);
            out += &format!("{}\n{title}: {name}, {note}\n", self.points.len());
            for (name, p) in self.points.iter().zip(figure.points.chunks_exact(3)) {
                out += &format!(
                    "{:<6} {:18.12} {:18.12} {:18.12}\n",
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
        1 | 2 if ELEMENTS.split(' ').any(|known| known == symbol) => symbol,
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
