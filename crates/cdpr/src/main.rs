//! The program `cdpr`.

fn main() -> std::process::ExitCode {
    cdpr::program::run(std::env::args_os())
}
