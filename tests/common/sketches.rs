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
