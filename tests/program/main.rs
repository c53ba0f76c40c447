//! The program: its command line, files, pages and documents.

mod arrows;
mod command_line;
#[cfg(unix)]
mod equations;
mod help;
mod joints;
mod json_schema;
mod molecules;
mod motion;
mod page;
mod problem_files;
mod readme;
mod robustness;
mod taking;
mod tolerance;

/// Runs the program: its exit code, and what it wrote to standard output and to standard error.
fn krawl(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_krawl"))
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}
