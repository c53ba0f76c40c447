//! Small problems with other constraints than distances that several tests look at.

/// c is on the circle over a-b, from which it sees a right angle, and 3 from d, as a is: where c is at a the equations hold, and
/// a leg of the angle has vanished.
pub const LEG: &str = r#"
name = "leg"
dimension = 2
[points]
a = [0, 0]
b = [4, 0]
d = [0.5, 2.9]
c = [1.5, 1.5]
[constraints]
fixed = ["a", "b"]
x = [["d", 0]]
y = [["d", 3]]
distances = [["c", "d", 3]]
angles = [["a", "c", "b", 90]]
"#;

/// A triangle with an angle at a, in degrees, and what is said of the sides at c: if these are equal, the equations also hold without
/// a base, where b is at a.
pub fn isosceles_text(sides: &str, angle: f64) -> String {
    format!(
        r#"
        name = "isosceles"
        dimension = 2
        [points]
        a = [0.1, 0.2]
        b = [7.7, 0]
        c = [3.8, 3.2]
        [constraints]
        angles = [["b", "a", "c", {angle}]]
        {sides}
        "#
    )
}

/// A circle that touches three fixed ones, all apart, from the sides that its sketch is on.
pub fn apollonius_text(center: &str, radius: &str) -> String {
    format!(
        r#"
        name = "apollonius"
        dimension = 2
        [points]
        a = [0, 0]
        b = [7, 0]
        c = [2, 6]
        m = {center}
        [circles]
        c1 = {{ center = "a", radius = 1 }}
        c2 = {{ center = "b", radius = 1.5 }}
        c3 = {{ center = "c", radius = 2 }}
        k = {{ center = "m", radius = {radius} }}
        [constraints]
        fixed = ["c1", "c2", "c3"]
        tangent = [["k", "c1"], ["k", "c2"], ["k", "c3"]]
        "#
    )
}

/// An arc whose ends are on two horizontal lines and whose centre is on a vertical one; at each end the radius is at a right angle to
/// the line to a fixed point.
pub const ARC: &str = r#"
name = "arc"
dimension = 2
[points]
c = [-5.2, 10]
p = [-12, 15]
q = [-12, 5.1]
r = [-10, 25]
s = [-10, -5]
p1 = [0, 15]
p2 = [2, 15]
q1 = [0, 5]
q2 = [3, 5]
c1 = [-5, 0]
c2 = [-5, 2]
[constraints]
fixed = ["r", "s", "p1", "p2", "q1", "q2", "c1", "c2"]
on = [["p", "p1", "p2"], ["q", "q1", "q2"], ["c", "c1", "c2"]]
perpendicular = [["r", "p", "c", "p"], ["s", "q", "c", "q"]]
equal = [["c", "p", "c", "q"]]
"#;

/// A plate with rounded corners: four lines along the axes, two of them with lengths, and arcs of one radius between them.
pub const PLATE: &str = r#"
name = "plate"
dimension = 2
[points]
m1 = [0, 0]
m2 = [20, 0.1]
m3 = [20.1, 10]
m4 = [0.1, 10.1]
a1 = [0, -1.5]
a2 = [20, -1.4]
b1 = [21.5, 0]
b2 = [21.6, 10]
c1 = [20, 11.5]
c2 = [0, 11.6]
d1 = [-1.5, 10]
d2 = [-1.4, 0]
[circles]
k1 = { center = "m1", radius = 1.5 }
k2 = { center = "m2", radius = 1.5 }
k3 = { center = "m3", radius = 1.5 }
k4 = { center = "m4", radius = 1.5 }
[constraints]
fixed = ["m1"]
horizontal = [["a1","a2"],["c1","c2"]]
vertical = [["b1","b2"],["d1","d2"]]
on = [["d2","k1"],["a1","k1"],["a2","k2"],["b1","k2"],["b2","k3"],["c1","k3"],["c2","k4"],["d1","k4"]]
perpendicular = [["a1","a2","a1","m1"],["a1","a2","a2","m2"],["b1","b2","b1","m2"],["b1","b2","b2","m3"],["c1","c2","c1","m3"],["c1","c2","c2","m4"],["d1","d2","d1","m4"],["d1","d2","d2","m1"]]
equal = [["k1","k2","k3","k4"]]
radii = [["k1", 1.5]]
distances = [["a1","a2",20],["b1","b2",10]]
"#;
