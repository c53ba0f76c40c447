//! Robots in URDF, the Unified Robot Description Format, as problem files.
//!
//! Links become bodies and joints joints; each joint that moves has the value 0 for a dimension, at which URDF draws it. What links look like, what they weigh and how far
//! joints go is not read. Angles are radians: one that is a multiple of π/2, rounded to the digits that it is written with (three at least), is taken for that multiple.

use crate::interval::vector::{cross, dot, length};
use crate::problem::{Decimal, Formula, JointSort, Pose};
use roxmltree::{Document, Node};
use std::collections::{HashMap, HashSet};
use std::f64::consts::FRAC_PI_2;

/// The robot of a file as the text of a problem file (docs/using/robots.md).
///
/// # Errors
/// What is wrong with it, and in which line.
pub fn problem_file(xml: &str) -> Result<String, String> {
    let document = Document::parse(xml).map_err(|error| format!("is no XML: {error}"))?;
    let root = document.root_element();
    if root.tag_name().name() != "robot" {
        return Err(format!(
            "line {}: the outermost element of a URDF file is `robot`, and not `{}`",
            line(root),
            root.tag_name().name()
        ));
    }
    let children = |tag: &'static str| {
        let all = root.children();
        all.filter(move |node| node.tag_name().name() == tag)
    };
    let mut names = HashSet::new();
    let (mut bodies, mut joints) = (Vec::new(), String::new());
    let (mut turns, mut travels, mut follows) = (Vec::new(), Vec::new(), Vec::new());
    // What joints that follow no other one are called, and what they do.
    let mut does_of = HashMap::new();
    for link in children("link") {
        let name = attribute(link, "name")?;
        names.insert(name.to_owned());
        bodies.push(name.to_owned());
    }
    // What is first stands: the link that is no other one's child.
    let mut is_child = HashSet::new();
    for joint in children("joint") {
        is_child.insert(end(joint, "child")?);
    }
    bodies.sort_by_key(|body| is_child.contains(body));
    for joint in children("joint") {
        let own = attribute(joint, "name")?;
        let name = match names.contains(own) {
            true => format!("{own}_joint"),
            false => own.to_owned(),
        };
        let sort = match attribute(joint, "type")? {
            "revolute" | "continuous" => JointSort::Revolute,
            "prismatic" => JointSort::Prismatic,
            "fixed" => JointSort::Rigid,
            "planar" => JointSort::Planar,
            other => {
                return Err(format!(
                    "line {}: the joint `{own}` is of the type `{other}`, which is not read: revolute, continuous, prismatic, planar and fixed are",
                    line(joint)
                ));
            }
        };
        let ends = [end(joint, "parent")?, end(joint, "child")?];
        if let Some(unknown) = ends.iter().find(|end| !names.contains(*end)) {
            return Err(format!(
                "line {}: the joint `{own}` is of the link `{unknown}`, which there is not",
                line(joint)
            ));
        }
        let frames = frames(joint, sort)?;
        let moves = match sort {
            JointSort::Revolute => Some(("turn", &mut turns)),
            JointSort::Prismatic => Some(("travel", &mut travels)),
            _ => None,
        };
        let (mut children, mut sketch) = (joint.children(), String::new());
        match (
            moves,
            children.find(|node| node.tag_name().name() == "mimic"),
        ) {
            (Some((does, _)), Some(mimic)) => {
                let one = Follower::read(mimic, &name, does)?;
                // Where the other one is drawn, at 0, it is off by so much.
                sketch = format!(", sketch = {}", one.offset);
                follows.push(one);
            }
            (Some((does, all)), None) => {
                all.push(name.clone());
                does_of.insert(own.to_owned(), (name.clone(), does));
            }
            (None, Some(mimic)) => {
                return Err(format!(
                    "line {}: the joint `{own}` neither turns nor travels, and cannot follow another one",
                    line(mimic)
                ));
            }
            (None, None) => {}
        }
        let [first, second] = ends.each_ref().map(|end| quoted(end));
        let pair = |of: fn(&Pose) -> &[Decimal; 3]| {
            let [a, b] = frames.each_ref().map(|frame| {
                let [x, y, z] = of(frame).each_ref().map(Decimal::to_string);
                format!("[{x}, {y}, {z}]")
            });
            format!("[{a}, {b}]")
        };
        joints += &format!(
            "{} = {{ {} = [{first}, {second}], at = {}, z = {}, x = {}{sketch} }}\n",
            quoted(&name),
            sort.name(),
            pair(|p| &p.at),
            pair(|p| &p.z),
            pair(|p| &p.x)
        );
    }
    if joints.is_empty() {
        return Err("there is no joint in it".to_owned());
    }
    let equations = follows.iter().map(|one| one.equation(&does_of));
    let equations = equations.collect::<Result<Vec<_>, String>>()?;
    let mut out = String::new();
    let name = root.attribute("name").unwrap_or("robot");
    out += &format!("name = {}\ndimension = 3\n\n[bodies]\n", quoted(name));
    for body in bodies {
        out += &format!("{} = {{}}\n", quoted(&body));
    }
    out += &format!("\n[joints]\n{joints}\n[constraints]\n");
    for (key, names) in [("turns", turns), ("travels", travels)] {
        let entries: Vec<String> = names
            .iter()
            .map(|name| format!("[{}, 0]", quoted(name)))
            .collect();
        if !entries.is_empty() {
            out += &format!("{key} = [{}]\n", entries.join(", "));
        }
    }
    if !equations.is_empty() {
        out += &format!("equations = [{}]\n", equations.join(", "));
    }
    Ok(out)
}

/// A joint that follows another one.
struct Follower {
    name: String,
    /// `turn` or `travel`.
    does: &'static str,
    /// The other one, as it is called in the file.
    leader: String,
    /// How often it goes as far as that.
    times: Decimal,
    /// And how much further: degrees, or a length.
    offset: String,
    line: u32,
}

impl Follower {
    fn read(mimic: Node, name: &str, does: &'static str) -> Result<Self, String> {
        let number = |key: &str, otherwise: i32| match mimic.attribute(key) {
            None => Ok(Decimal::from(otherwise)),
            Some(text) => text.parse::<Decimal>().map_err(|error| {
                format!("line {}: `{name}`: {key}=\"{text}\": {error}", line(mimic))
            }),
        };
        let (times, offset) = (number("multiplier", 1)?, number("offset", 0)?);
        let parts = [
            times.value().numer().magnitude(),
            times.value().denom().magnitude(),
        ];
        if does == "turn"
            && parts
                .iter()
                .any(|part| **part > Formula::MOST_TURNS.unsigned_abs().into())
        {
            return Err(format!(
                "line {}: `{name}`: multiplier=\"{times}\": a joint follows another one by a ratio of whole numbers up to {}",
                line(mimic),
                Formula::MOST_TURNS
            ));
        }
        Ok(Follower {
            name: name.to_owned(),
            does,
            leader: attribute(mimic, "joint")?.to_owned(),
            times,
            offset: match (does, quarters(&offset)) {
                ("turn", Some(quarters)) => (90.0 * quarters).to_string(),
                ("turn", None) => offset.to_f64().to_degrees().to_string(),
                _ => offset.to_string(),
            },
            line: line(mimic),
        })
    }

    /// The equation, as a text in quotes. `others`: what joints that move by themselves are called, by their names in the file, and what they do.
    fn equation(&self, others: &HashMap<String, (String, &'static str)>) -> Result<String, String> {
        let Follower {
            name,
            does,
            leader,
            times,
            offset,
            line,
        } = self;
        let (led, by) = others.get(leader).ok_or_else(|| {
            format!(
                "line {line}: `{name}` follows `{leader}`, which is no joint that moves by itself"
            )
        })?;
        match by == does {
            true => Ok(quoted(&format!(
                "{does}({name}) = {times} * {does}({led}) + {offset}"
            ))),
            false => Err(format!(
                "line {line}: `{name}` follows `{leader}`, and one of them turns, the other one travels: a screw, which is not read"
            )),
        }
    }
}

/// A text in quotes; what JSON escapes TOML escapes likewise.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn line(node: Node) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Result<&'a str, String> {
    node.attribute(name).ok_or_else(|| {
        let tag = node.tag_name().name();
        format!("line {}: `{tag}` has no `{name}`", line(node))
    })
}

/// A link of a joint.
fn end(joint: Node, which: &str) -> Result<String, String> {
    let mut children = joint.children();
    let end = children.find(|node| node.tag_name().name() == which);
    let end = end.ok_or_else(|| {
        let name = joint.attribute("name").unwrap_or("?");
        format!("line {}: the joint `{name}` has no `{which}`", line(joint))
    })?;
    Ok(attribute(end, "link")?.to_owned())
}

/// Three numbers of an attribute as they are written; `None`: there is no such.
fn three(joint: Node, element: &str, name: &str) -> Result<Option<[Decimal; 3]>, String> {
    let mut children = joint.children();
    let Some(node) = children.find(|node| node.tag_name().name() == element) else {
        return Ok(None);
    };
    let Some(text) = node.attribute(name) else {
        return Ok(None);
    };
    let numbers: Vec<Decimal> = text
        .split_whitespace()
        .map(|number| number.parse())
        .collect::<Result<_, _>>()
        .map_err(|error| format!("line {}: {name}=\"{text}\": {error}", line(node)))?;
    let three = <[Decimal; 3]>::try_from(numbers);
    let wanted = |_| {
        format!(
            "line {}: {name}=\"{text}\": three numbers are wanted",
            line(node)
        )
    };
    three.map(Some).map_err(wanted)
}

/// How many quarter turns an angle in radians is, if it is so many as far as its digits tell.
fn quarters(angle: &Decimal) -> Option<f64> {
    let x = angle.to_f64();
    let text = angle.text();
    let digits = text.split_once('.').map_or(0, |(_, behind)| {
        behind.chars().take_while(char::is_ascii_digit).count()
    });
    let quarters = (x / FRAC_PI_2).round();
    let off = (x - quarters * FRAC_PI_2).abs();
    // Half a unit of the last digit, and what a float is off by.
    let is_rounded = x == 0.0 || digits >= 3 && off <= 0.5 * 10f64.powi(-(digits as i32)) + 1e-15;
    is_rounded.then_some(quarters)
}

/// The sine and cosine of an angle in radians.
fn turn(angle: &Decimal) -> (f64, f64) {
    match quarters(angle).map(|quarters| quarters.rem_euclid(4.0) as u8) {
        Some(0) => (0.0, 1.0),
        Some(1) => (1.0, 0.0),
        Some(2) => (0.0, -1.0),
        Some(_) => (-1.0, 0.0),
        None => angle.to_f64().sin_cos(),
    }
}

/// The frames of a joint in the link before it and in the one behind it.
fn frames(joint: Node, sort: JointSort) -> Result<[Pose; 2], String> {
    let zero = || [0, 0, 0].map(Decimal::from);
    let at = three(joint, "origin", "xyz")?.unwrap_or_else(zero);
    let angles = three(joint, "origin", "rpy")?.unwrap_or_else(zero);
    let [(sr, cr), (sp, cp), (sy, cy)] = angles.each_ref().map(turn);
    // About the axes of the link before: first x, then y, then z.
    let columns = [
        [cy * cp, sy * cp, -sp],
        [cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr],
        [cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr],
    ];
    let turned = |v: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|k| (0..3).map(|i| v[i] * columns[i][k]).sum::<f64>() + 0.0)
    };
    let axis = match sort {
        JointSort::Rigid => [0.0, 0.0, 1.0],
        _ => three(joint, "axis", "xyz")?
            .map_or([1.0, 0.0, 0.0], |axis| axis.each_ref().map(Decimal::to_f64)),
    };
    if length(axis) == 0.0 {
        return Err(format!("line {}: the axis is 0 0 0", line(joint)));
    }
    // An axis of the link that is well across.
    let all = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let across = all.into_iter().max_by(|&a, &b| {
        let far = |v| length(cross(v, axis)) - 0.1 * dot(v, [0.0, 1.0, 2.0]);
        far(a).total_cmp(&far(b))
    });
    let x = across.expect("there are three axes");
    let three = |v: [f64; 3]| v.map(|x| x.to_string().parse().unwrap_or(Decimal::from(0)));
    Ok([
        Pose {
            at,
            z: three(turned(axis)),
            x: three(turned(x)),
        },
        Pose {
            at: zero(),
            z: three(axis),
            x: three(x),
        },
    ])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;

    #[test]
    fn right_angles_are_told_by_their_digits() {
        let of = |text: &str| turn(&text.parse().unwrap());
        for text in ["1.5708", "1.571", "1.57079632679", "1.5707963267948966"] {
            assert_eq!(of(text), (1.0, 0.0), "{text}");
        }
        assert_eq!(of("-3.14159"), (0.0, -1.0));
        assert_eq!(of("-1.5708"), (-1.0, 0.0));
        for text in ["1.57", "1.5709", "1.57079", "1.5707963268949"] {
            assert_eq!(of(text), text.parse::<f64>().unwrap().sin_cos(), "{text}");
        }
    }

    #[test]
    fn a_robot_becomes_a_problem() {
        let xml = r#"<robot name="two">
            <link name="arm"/><link name="base"/><link name="hand"/>
            <joint name="shoulder" type="continuous"><parent link="base"/><child link="arm"/>
                <origin xyz="0 0 0.5" rpy="1.5708 0 0"/><axis xyz="0 1 0"/></joint>
            <joint name="hand" type="prismatic"><parent link="arm"/><child link="hand"/><origin xyz="0.25 0 0"/></joint>
        </robot>"#;
        let text = problem_file(xml).unwrap();
        let problem = Problem::parse(&text, "two.toml").unwrap();
        // The one that is no child stands, and a joint that has a link's name gets another.
        assert_eq!(problem.objects[problem.standing_bodies()[0]].name, "base");
        assert_eq!(problem.objects.last().unwrap().name, "hand_joint");
        assert!(text.contains("z = [[0, 0, 1], [0, 1, 0]]"), "{text}");
        for (old, new, words) in [
            (
                "continuous",
                "floating",
                "line 3: the joint `shoulder` is of the type `floating`",
            ),
            ("<parent link=\"base\"/>", "", "has no `parent`"),
            (
                "link=\"arm\"/><child",
                "link=\"leg\"/><child",
                "line 5: the joint `hand` is of the link `leg`",
            ),
            ("0.25 0 0", "0.25 0", "three numbers"),
            ("0.25 0 0", "0.25 a 0", "line 5"),
            ("</robot>", "", "is no XML"),
            ("0 1 0", "0 0 0", "the axis is 0 0 0"),
            ("robot", "sdf", "and not `sdf`"),
        ] {
            let said = problem_file(&xml.replace(old, new)).unwrap_err();
            assert!(said.contains(words), "{said}");
        }
    }
}
