//! `krawl completions` and `krawl man`: what shells and `man` want to know of the program.

use super::{CLOSED, output};
use clap::CommandFactory;
use std::path::PathBuf;

/// Print the completions for a shell
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl completions bash > ~/.local/share/bash-completion/completions/krawl
  krawl completions zsh > ~/.zfunc/_krawl
  krawl completions fish > ~/.config/fish/completions/krawl.fish

Exit codes: 0 printed, 2 it could not be written.")]
pub struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: clap_complete::Shell,
}

/// Print the manual page, or write one for each verb
#[derive(clap::Args)]
#[command(after_long_help = "\
Examples:
  krawl man | man -l -
  krawl man --dir ~/.local/share/man/man1

Exit codes: 0 printed or written, 2 it could not be written.")]
pub struct Man {
    /// Write the pages of the program and of each verb into this directory
    #[arg(long, value_name = "DIR")]
    dir: Option<PathBuf>,
}

/// Prints the completions and returns the exit code.
pub fn completions(arguments: &Completions) -> Result<u8, String> {
    let mut text = Vec::new();
    let mut command = super::Arguments::command();
    clap_complete::generate(arguments.shell, &mut command, "krawl", &mut text);
    let is_printed = output::print(&String::from_utf8_lossy(&text));
    Ok(output::code(is_printed, CLOSED))
}

/// Prints or writes the manual pages and returns the exit code.
pub fn man(arguments: &Man) -> Result<u8, String> {
    let command = super::Arguments::command();
    let Some(folder) = &arguments.dir else {
        let mut text = Vec::new();
        clap_mangen::Man::new(command)
            .render(&mut text)
            .map_err(|error| format!("the manual page could not be made: {error}"))?;
        let is_printed = output::print(&String::from_utf8_lossy(&text));
        return Ok(output::code(is_printed, CLOSED));
    };
    std::fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(command, folder))
        .map_err(output::in_file(folder))?;
    Ok(CLOSED)
}
