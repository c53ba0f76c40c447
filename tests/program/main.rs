//! The program: its command line, files, pages and documents.

#[path = "../common/mod.rs"]
mod common;

mod arrows;
mod command_line;
#[cfg(unix)]
mod equations;
mod help;
mod json_schema;
mod motion;
mod page;
mod problem_files;
mod readme;
mod robustness;
mod taking;
