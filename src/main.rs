//! The program.

fn main() -> std::process::ExitCode {
    krawl::cli::run()
}
