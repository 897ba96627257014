//! The gateway for MATLAB, compiled by `mkoctfile --mex`: the bits of the Rust interface in Octave.
//!
//! `.ci/run` runs this test by its name; a plain `cargo test` leaves it out. It needs Octave with its headers,
//! and says so where they are missing.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

use cdpr_robot::{Pose, Robot};
use cdpr_statics::stiffness::stiffness_at;
use cdpr_statics::{DirectStart, Load, Tracker, deflection, derivatives, direct, inverse};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

fn folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of the compiled gateway; none where a program is missing.
static GATEWAY: LazyLock<Option<PathBuf>> = LazyLock::new(|| {
    let missing = ["octave-cli", "mkoctfile"]
        .into_iter()
        .find(|program| Command::new(program).arg("--version").output().is_err());
    match missing {
        None => Some(gateway()),
        Some(program) => {
            println!("not tested: there is no {program} (Debian's octave and octave-dev have it)");
            None
        }
    }
});

/// Compiles the gateway, and returns its folder.
fn gateway() -> PathBuf {
    let built = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("octave");
    std::fs::create_dir_all(&built).unwrap();
    let program = std::env::current_exe().unwrap();
    let candidates = program.ancestors().skip(1).take(2).map(|folder| folder.join("libcdpr_c.a"));
    let library = candidates.into_iter().find(|file| file.exists()).unwrap();
    let mut compile = Command::new("mkoctfile");
    compile.args(["--mex", "-Wall", "-Wextra"]).arg(format!("-I{}", folder().join("include").display()));
    compile.arg(folder().join("matlab/cdpr_mex.c")).arg(library).args(["-lpthread", "-ldl", "-lm", "-o"]);
    let output = compile.arg(built.join("cdpr_mex.mex")).current_dir(&built).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && !said.contains("cdpr_mex.c"), "{said}");
    built
}

/// What Octave prints for a script; nothing where it is missing.
fn octave(script: &str) -> Option<String> {
    let paths = [GATEWAY.as_ref()?, &folder().join("matlab")];
    let run = paths.map(|path| format!("addpath('{}');", path.display())).concat() + script;
    let output = Command::new("octave-cli").args(["--quiet", "--eval", &run]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap())
}

fn line<'a>(values: impl IntoIterator<Item = &'a f64>) -> String {
    values.into_iter().map(|value| format!("{:016x}", value.to_bits())).collect::<Vec<_>>().join(" ") + "\n"
}

const SCRIPT: &str = "
    function show(values)
        text = num2hex(reshape(values.', [], 1));
        printf('%s\\n', strjoin(cellstr(text).', ' '));
    end
    robot = cdpr.Robot('caroca');
    [lengths, tensions] = robot.inverse([0.25 -0.125 1.75]); show(lengths); show(tensions);
    [pose, tensions] = robot.direct(lengths, [0.25 -0.125 1.75], 50); show(pose); show(tensions);
    [moved, turned] = robot.deflection([0.25 -0.125 1.75], 50); show(moved); show(turned);
    [matrix, least] = robot.stiffness([0.25 -0.125 1.75], 50); show(matrix); show(least);
    matrices = robot.derivatives([0.25 -0.125 1.75], 50);
    show(matrices.lengths); show(matrices.tensions); show(matrices.displacement); show(matrices.magnitude);
    tracker = cdpr.Tracker(robot, lengths, [0.25 -0.125 1.75], 50);
    for k = 1:200
        lengths(1) = lengths(1) - 1e-5;
        [pose, tensions, report, converged] = tracker.step(lengths, 50);
        show(pose); show(tensions); assert(converged);
    end
    show(tracker.shape(2, 5));
";

#[test]
fn octave_gets_the_bits_of_the_rust_interface() {
    let robot = Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap();
    let (load, none) = (Load::payload(50.0), Load::none());
    let pose = Pose::with_quaternion([0.25, -0.125, 1.75].into(), [1.0, 0.0, 0.0, 0.0]).unwrap();
    let mut expected = String::new();
    let of_pose = |pose: &Pose| {
        line(pose.position.iter().chain(&pose.quaternion()).copied().collect::<Vec<_>>().iter())
    };
    let wanted = inverse(&robot, &pose, &none).unwrap();
    expected += &(line(&wanted.lengths) + &line(&wanted.tensions));
    let found = direct(&robot, &wanted.lengths, &load, DirectStart::Pose(&pose)).unwrap().equilibrium;
    expected += &(of_pose(&found.pose) + &line(&found.tensions()));
    let motion = deflection(&robot, &pose, &load).unwrap().motion();
    expected += &(line(motion.fixed_rows::<3>(0)) + &line(motion.fixed_rows::<3>(3)));
    let stiffness = stiffness_at(&robot, pose, &load).unwrap();
    expected += &line(stiffness.matrix.transpose().as_slice());
    expected += &line(&[stiffness.stability.least_stiffness()]);
    let matrices = derivatives(&robot, &pose, &load).unwrap();
    expected += &line(matrices.lengths.transpose().as_slice());
    expected += &line(matrices.set_points.transpose().as_slice());
    expected += &line(matrices.displacement().transpose().as_slice());
    expected += &line(&matrices.magnitude().unwrap());
    let mut lengths = wanted.lengths.clone();
    let mut tracker = Tracker::new(&robot, &lengths, &load, &found).unwrap();
    for _ in 0..200 {
        lengths[0] -= 1e-5;
        assert!(tracker.step(&lengths, &load).unwrap().converged);
        let equilibrium = tracker.equilibrium();
        expected += &(of_pose(&equilibrium.pose) + &line(&equilibrium.tensions()));
    }
    let points = tracker.shape(1, 2, 5).unwrap().points;
    expected += &line(points.iter().flatten());
    let Some(printed) = octave(SCRIPT) else { return };
    for (printed, expected) in printed.lines().zip(expected.lines()) {
        assert_eq!(printed, expected);
    }
    assert_eq!(printed.lines().count(), expected.lines().count());
}

#[test]
fn the_example_prints_what_the_page_shows() {
    let Some(printed) = octave("cdpr_example") else { return };
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    assert!(page.contains(&printed), "docs/c.md: {printed}");
}

#[test]
fn octave_gets_errors_and_no_crash() {
    let Some(printed) = octave(
        "function show(run), try, run(); catch e, printf('%s: %s\\n', e.identifier, e.message); end, end
        robot = cdpr.Robot('caroca');
        show(@() cdpr.Robot('carroca')); show(@() robot.inverse([0 0 50]));
        show(@() robot.inverse([0 NaN 1]));
        show(@() robot.inverse([0 0])); show(@() robot.direct([1 2 3], [0 0 1.75]));
        show(@() cdpr_mex('inverse', 77, [0 0 1], [])); show(@() cdpr_mex('fly', robot.id, [0 0 1], []));
        show(@() cdpr.Robot(7)); delete(robot); show(@() robot.inverse([0 0 1.75]));",
    ) else {
        return;
    };
    let kinds: Vec<_> = printed.lines().map(|line| line.split(": ").next().unwrap()).collect();
    let expected =
        ["robot", "noSolution", "invalid", "invalid", "size", "invalid", "invalid", "invalid", "invalid"];
    assert_eq!(kinds, expected.map(|kind| format!("cdpr:{kind}")), "{printed}");
}

#[test]
fn the_study_of_the_paper_prints_what_the_page_shows() {
    let file = folder().join("../../data/robots/caroca.json");
    let Some(printed) = octave(&format!("cdpr_study('{}', 2000);", file.display())) else { return };
    let page = std::fs::read_to_string(folder().join("../../docs/c.md")).unwrap();
    assert!(page.contains(&printed), "docs/c.md: {printed}");
    // The figures of the paper, data/reference/published.json, but for the extremes of another sample.
    assert!(printed.starts_with("1.35 mm, from 1.1"), "{printed}");
    assert!(printed.contains("largest effects: a4, a2\n") || printed.contains("largest effects: a2, a4\n"));
    assert!(printed.contains("largest effects: b4, b2\n") || printed.contains("largest effects: b2, b4\n"));
}

#[test]
fn the_solvers_of_octave_find_the_same_poses() {
    let robots = folder().join("../../data/robots");
    let rows = "for k = 1:size(rows, 1), printf('row;%s;%s;%g;%g;%g;%d\\n', rows{k, :}); end";
    let run = format!("rows = cdpr_compare('{}'); {rows}", robots.display());
    let Some(printed) = octave(&run) else { return };
    let rows: Vec<Vec<&str>> = printed
        .lines()
        .filter(|line| line.starts_with("row;"))
        .map(|line| line.split(';').collect())
        .collect();
    let others: Vec<_> = rows.iter().filter(|row| !row[2].starts_with("libcdpr")).collect();
    assert!(others.len() >= 4 && rows.len() - others.len() == 8, "{printed}");
    let mut same = 0;
    for row in others {
        let [apart, pushing] = [5, 6].map(|column| row[column].parse::<f64>().unwrap());
        // A solver may end at another root, at which a cable would have to push.
        assert!(apart < 1e-5 || pushing > 0.0, "{row:?}");
        same += usize::from(apart < 1e-5);
    }
    assert!(same >= 4, "{printed}");
}
