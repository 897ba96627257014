//! `cargo xtask bench-moordyn`: the same motions by `cdpr simulate` and by MoorDyn.
//!
//! `xtask/peers/motion.py` runs both, prints a table and writes it to `data/benchmarks/moordyn.json`. It runs in an
//! environment of its own, `target/peers/moordyn`, into which pip installs MoorDyn.

use crate::cargo::{cargo_command, done, root};
use crate::statistics::environment;
use std::error::Error;
use std::process::{Command, ExitCode};

const PACKAGES: [&str; 2] = ["moordyn==2.7.2", "numpy"];

pub(crate) fn bench() -> ExitCode {
    match compare() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn compare() -> Result<(), Box<dyn Error>> {
    let python = environment("moordyn", &PACKAGES)?;
    done(&mut cargo_command(&["build", "--release", "--bin", "cdpr"]))?;
    let folder = root().join("target/peers/moordyn-files");
    std::fs::create_dir_all(&folder)?;
    let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), Into::into);
    let program = target.join("release").join(format!("cdpr{}", std::env::consts::EXE_SUFFIX));
    let script = Command::new(python)
        .arg(root().join("xtask/peers/motion.py"))
        .arg(program)
        .arg("release")
        .arg(folder)
        .arg(root().join("data/benchmarks/moordyn.json"))
        .status()?;
    if script.success() { Ok(()) } else { Err("xtask/peers/motion.py has failed".into()) }
}
