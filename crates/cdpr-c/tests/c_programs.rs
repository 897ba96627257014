//! C programs that use the header and the static library: compiled without a warning, with the same digits.

use crate::common::{ROBOTS_AT, STEPS, expected};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Compilers with the language and the standard that each compiles.
const COMPILERS: [(&str, &[&str]); 3] = [
    ("gcc", &["-x", "c", "-std=c11"]),
    ("clang", &["-x", "c", "-std=c11"]),
    ("g++", &["-x", "c++", "-std=c++17"]),
];

/// What the static library needs of the system.
const SYSTEM: [&str; 5] = ["-lpthread", "-ldl", "-lm", "-lc", "-lgcc_s"];

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The static library, which cargo has built for this test.
fn library() -> PathBuf {
    let program = std::env::current_exe().unwrap();
    let candidates = program.ancestors().skip(1).take(2).map(|folder| folder.join("libcdpr_c.a"));
    candidates.into_iter().find(|file| file.exists()).unwrap()
}

/// Compiles and links a program, or returns `None` where the compiler is missing.
fn compile(compiler: (&str, &[&str]), source: &Path, program: &Path) -> Option<Output> {
    let mut command = Command::new(compiler.0);
    command.args(compiler.1).args(["-O1", "-Wall", "-Wextra", "-Werror", "-pedantic"]);
    command.arg("-I").arg(folder().join("include")).arg(source).args(["-x", "none"]).arg(library());
    command.args(SYSTEM).arg("-o").arg(program).output().ok()
}

/// The programs of a source by all compilers that are installed, by the names of these. Programs are those of
/// Linux.
fn programs(source: &str) -> Vec<(&'static str, PathBuf)> {
    if !cfg!(target_os = "linux") {
        println!("not tested: {source} is compiled on Linux alone");
        return Vec::new();
    }
    let (source, temporary) = (folder().join(source), Path::new(env!("CARGO_TARGET_TMPDIR")));
    let name = source.file_stem().unwrap().to_str().unwrap();
    let mut programs = Vec::new();
    for compiler in COMPILERS {
        let program = temporary.join(format!("{name}-{}", compiler.0));
        match compile(compiler, &source, &program) {
            None => println!("not tested: there is no {}", compiler.0),
            Some(output) => {
                let said = String::from_utf8_lossy(&output.stderr);
                assert!(output.status.success() && said.is_empty(), "{}: {said}", compiler.0);
                programs.push((compiler.0, program));
            }
        }
    }
    programs
}

/// What a program prints.
fn printed(program: &Path, arguments: &[String]) -> String {
    let output = Command::new(program).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn programs_in_c_and_cpp_print_the_digits_of_the_rust_interface() {
    let programs = programs("tests/c/digits.c");
    for (name, position) in ROBOTS_AT {
        let expected = expected(name, position);
        let mut arguments = vec![name.to_owned()];
        arguments.extend(position.map(|coordinate| coordinate.to_string()));
        arguments.push(STEPS.to_string());
        for (compiler, program) in &programs {
            let printed = printed(program, &arguments);
            for (printed, expected) in printed.lines().zip(expected.lines()) {
                assert_eq!(printed, expected, "{name} by {compiler}");
            }
            assert_eq!(printed.lines().count(), expected.lines().count(), "{name} by {compiler}");
        }
    }
}

#[test]
fn the_control_loop_prints_what_the_page_shows() {
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    for (compiler, program) in programs("examples/control_loop.c") {
        let printed = printed(&program, &[]);
        assert!(printed.contains("1000 cycles, 0 without convergence"), "{compiler}: {printed}");
        assert!(page.contains(&printed), "{compiler}, docs/c.md: {printed}");
    }
}

#[test]
fn the_load_observer_prints_what_the_page_shows() {
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    for (compiler, program) in programs("examples/load_observer.c") {
        let printed = printed(&program, &[]);
        assert!(page.contains(&printed), "{compiler}, docs/c.md: {printed}");
    }
}

#[test]
fn the_page_shows_the_examples() {
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    for name in ["control_loop", "load_observer"] {
        assert!(page.contains(&format!("{{{{#include ../crates/cdpr-c/examples/{name}.c}}}}")), "{name}");
    }
}
