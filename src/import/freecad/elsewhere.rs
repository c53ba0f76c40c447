//! Geometry of other objects that a sketch of an older FreeCAD names and does not keep: seen in the sketch's plane from the shapes in the
//! file, as `SketchObject::rebuildExternalGeometry` sees it. Newer ones keep it with the sketch.

use super::shape::{Plane, Seen, Shape};
use super::{archive, number, objects, property};
use roxmltree::{Document, Node};
use std::cell::RefCell;
use std::collections::HashMap;
use std::io::Read as _;

/// The shapes of a document's objects in the plane of a sketch, each read when it is first asked for.
pub struct Shapes<'a> {
    plane: Plane,
    bytes: &'a [u8],
    /// The files of shapes, by the names of objects.
    files: HashMap<&'a str, &'a str>,
    read: RefCell<HashMap<&'a str, Option<Shape>>>,
}

impl<'a> Shapes<'a> {
    /// Those of a document in these bytes. `None`: the plane of the sketch is not known.
    pub fn new(document: &'a Document<'a>, bytes: &'a [u8], sketch: Node) -> Option<Self> {
        let files = objects(document).into_iter();
        let files = files.filter_map(|(object, name, _)| {
            let shape = property(object, "Shape")?;
            let part = shape.children().find(|n| n.has_tag_name("Part"))?;
            Some((name, part.attribute("file")?))
        });
        Some(Shapes {
            plane: plane(sketch)?,
            bytes,
            files: files.collect(),
            read: RefCell::default(),
        })
    }

    /// What FreeCAD draws for a link of the sketch. `None`: that is not known.
    pub fn seen(&self, link: Node) -> Option<Seen> {
        let file = *self.files.get(link.attribute("obj")?)?;
        let mut read = self.read.borrow_mut();
        let shape = read.entry(file).or_insert_with(|| self.shape(file));
        shape.as_ref()?.seen(link.attribute("sub")?, &self.plane)
    }

    fn shape(&self, file: &str) -> Option<Shape> {
        let mut archive = archive(self.bytes).ok()?;
        let part = archive.by_name(file).ok()?;
        let mut text = String::new();
        let most = super::super::MAX_SIZE as u64;
        part.take(most).read_to_string(&mut text).ok()?;
        Shape::read(&text)
    }
}

/// The plane of a sketch, in which it has its coordinates.
fn plane(sketch: Node) -> Option<Plane> {
    let placement = property(sketch, "Placement")?;
    let placement = placement.children().find(|n| n.is_element())?;
    let [x, y, z, w] = {
        let q: [f64; 4] = ["Q0", "Q1", "Q2", "Q3"].map(|key| number(placement, key));
        let long = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        q.map(|x| x / long)
    };
    let axes = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + w * z),
            2.0 * (x * z - w * y),
        ],
        [
            2.0 * (x * y - w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + w * x),
        ],
        [
            2.0 * (x * z + w * y),
            2.0 * (y * z - w * x),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    let is_turned = axes.iter().flatten().all(|x| x.is_finite());
    is_turned.then_some(Plane {
        origin: ["Px", "Py", "Pz"].map(|key| number(placement, key)),
        axes,
    })
}
