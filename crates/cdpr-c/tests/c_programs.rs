//! C programs that use the header and the static library: compiled without a warning, with the same digits.

use crate::common::{Digits, ROBOTS_AT, STEPS, expected, followed, robot};
use cdpr_statics::Equilibrium;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// Compilers with the language and the standard that each compiles.
const COMPILERS: [Compiler; 3] = [
    ("gcc", &["-x", "c", "-std=c11"]),
    ("clang", &["-x", "c", "-std=c11"]),
    ("g++", &["-x", "c++", "-std=c++17"]),
];
const CPP_COMPILERS: [Compiler; 2] =
    [("g++", &["-x", "c++", "-std=c++17"]), ("clang++", &["-x", "c++", "-std=c++17"])];

type Compiler = (&'static str, &'static [&'static str]);

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

/// Compiles and links a program with more arguments, or returns `None` where the compiler is missing.
fn compile(compiler: Compiler, more: &[&str], source: &Path, program: &Path) -> Option<Output> {
    let mut command = Command::new(compiler.0);
    command.args(compiler.1).args(["-O1", "-Wall", "-Wextra", "-Werror", "-pedantic"]);
    command
        .current_dir(folder())
        .args(["-I", "include"])
        .args(more)
        .arg(source)
        .args(["-x", "none"])
        .arg(library());
    command.args(SYSTEM).arg("-o").arg(program).output().ok()
}

/// The programs of a source by these compilers, where they are installed, by the names of these. Programs are
/// those of Linux.
fn programs(source: &str, compilers: &[Compiler], more: &[&str]) -> Vec<(&'static str, PathBuf)> {
    if !cfg!(target_os = "linux") {
        println!("not tested: {source} is compiled on Linux alone");
        return Vec::new();
    }
    let (source, temporary) = (folder().join(source), Path::new(env!("CARGO_TARGET_TMPDIR")));
    let name = source.file_stem().unwrap().to_str().unwrap();
    let mut programs = Vec::new();
    for compiler in compilers {
        let program = temporary.join(format!("{name}-{}", compiler.0));
        match compile(*compiler, more, &source, &program) {
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
    let programs = programs("tests/c/digits.c", &COMPILERS, &[]);
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
fn sanitizers_find_nothing_and_change_no_digit() {
    let sanitize = "-fsanitize=address,undefined";
    let (source, temporary) = (folder().join("tests/c/digits.c"), Path::new(env!("CARGO_TARGET_TMPDIR")));
    let arguments = |name: &str, position| [vec![name.to_owned()], steps_at(position)].concat();
    for compiler in COMPILERS {
        let empty = temporary.join("empty.c");
        std::fs::write(&empty, "int main(void) { return 0; }").unwrap();
        let program = temporary.join(format!("digits-sanitized-{}", compiler.0));
        // Debian has the sanitizers of clang in a package of their own.
        let compiles = |source| compile(compiler, &[sanitize, "-fno-sanitize-recover=all"], source, &program);
        if !cfg!(target_os = "linux") || !compiles(&empty).is_some_and(|output| output.status.success()) {
            println!("not tested: there are no sanitizers of {}", compiler.0);
            continue;
        }
        let output = compiles(&source).unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        for (name, position) in ROBOTS_AT {
            let printed = printed(&program, &arguments(name, position));
            assert!(printed == expected(name, position), "{name} by {}", compiler.0);
        }
    }
}

#[test]
fn the_control_loop_prints_what_the_page_shows() {
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    for (compiler, program) in programs("examples/control_loop.c", &COMPILERS, &[]) {
        let printed = printed(&program, &[]);
        assert!(printed.contains("1000 cycles, 0 without convergence"), "{compiler}: {printed}");
        assert!(page.contains(&printed), "{compiler}, docs/c.md: {printed}");
    }
}

#[test]
fn the_load_observer_prints_what_the_page_shows() {
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    for (compiler, program) in programs("examples/load_observer.c", &COMPILERS, &[]) {
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

/// Arguments of a program that follows the lengths of [`followed`], after the robot.
fn steps_at(position: [f64; 3]) -> Vec<String> {
    position.iter().map(ToString::to_string).chain([STEPS.to_string()]).collect()
}

/// A line of digits.
fn line(name: &str, values: &[f64]) -> String {
    let mut digits = Digits::default();
    digits.line(name, values);
    digits.0
}

#[test]
fn the_block_of_simulink_has_the_digits_of_the_rust_interface() {
    let more = ["-DMATLAB_MEX_FILE", "-I", "tests/c/simulink"];
    for (compiler, program) in programs("matlab/cdpr_sfun.c", &COMPILERS, &more) {
        for (name, position) in ROBOTS_AT {
            let (_, states) = followed(name, position, 0);
            let pose_of = |state: &Equilibrium| {
                let pose = &state.pose;
                let values: Vec<f64> = pose.position.iter().copied().chain(pose.quaternion()).collect();
                line("pose", &values)
            };
            let each = states
                .iter()
                .map(|state| pose_of(state) + &line("tensions", &state.tensions()) + &line("status", &[0.0]));
            // After the steps a length is NaN: the pose is kept. Then two blocks are refused.
            let kept = pose_of(&states[STEPS]) + &line("status", &[3.0]) + "0.001 s, no error\n";
            let refused = "the first parameter is the name of a robot or the text of a robot file\n";
            let expected = each.collect::<String>() + &kept + refused;
            let printed = printed(&program, &[vec![name.to_owned()], steps_at(position)].concat());
            let (found, message) = printed.split_at(expected.len().min(printed.len()));
            assert!(found == expected, "{name} by {compiler}: {printed}");
            assert!(message.contains("no robot"), "{message}");
        }
    }
}

#[test]
fn the_node_of_ros_has_the_digits_of_the_rust_interface() {
    let more = ["-I", "ros2/cdpr_ros/include"];
    for (compiler, program) in programs("tests/c/ros_logic.cpp", &CPP_COMPILERS, &more) {
        for (name, position) in ROBOTS_AT {
            let file = folder().join(format!("../../data/robots/{name}.json")).display().to_string();
            let printed = printed(&program, &[vec![file], steps_at(position)].concat());
            // The node makes a step at the first lengths, too.
            let (wanted, states) = followed(name, position, 1);
            let mut expected = line("lengths", &wanted.lengths) + &line("tensions", &wanted.tensions);
            for (k, state) in states[1..].iter().enumerate() {
                expected += &line("position", state.pose.position.as_slice());
                expected += &line("quaternion", &state.pose.quaternion());
                expected += &line("tensions", &state.tensions());
                expected += &format!("restarted {}, residual below 1e-6: 1\n", u8::from(k == 0));
            }
            let (found, rest) = printed.split_at(expected.len().min(printed.len()));
            assert!(found == expected, "{name} by {compiler}: {printed}");
            let (pose, cables) = (&states[STEPS + 1].pose, robot(name).cables);
            let (points, said): (Vec<&str>, Vec<&str>) =
                rest.lines().partition(|line| line.starts_with("line "));
            let point = |line: &&str| -> Vec<f64> {
                line.split(' ').skip(1).map(|value| value.parse().unwrap()).collect()
            };
            let points: Vec<_> = points.iter().map(point).collect();
            // Four pieces of each cable, each from the end of the one before to the platform.
            assert_eq!(points.len(), 8 * cables.len());
            for (points, cable) in points.chunks(8).zip(&cables) {
                let anchor = pose.position + pose.rotation * cable.anchor_point;
                assert!((0..3).all(|i| (points[7][i] - anchor[i]).abs() < 2e-9), "{name}: {points:?}");
                assert!(points[1] == points[2] && points[3] == points[4] && points[5] == points[6]);
            }
            let expected = [
                "joint cable_1",
                "a length for each",
                "positive unstrained length",
                "nothing.json",
                "no robot",
            ];
            assert_eq!(said.len(), expected.len(), "{said:?}");
            let refused = |(said, why): (&&str, &&str)| said.starts_with("0 ") && said.contains(*why);
            assert!(said.iter().zip(&expected).all(refused), "{said:?}");
        }
    }
}
