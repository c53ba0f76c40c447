//! Pictures (SVG).
pub fn cost_against_accuracy(_: &crate::compare::Comparison) -> String {
    String::new()
}
pub fn time_along_path(_: &crate::compare::RecordedPath) -> String {
    String::new()
}
pub fn projection(_: &crate::compare::RecordedPath) -> String {
    String::new()
}
