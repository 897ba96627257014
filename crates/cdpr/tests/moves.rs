//! `cdpr path --with seconds=1` and `cdpr simulate --lengths FILE` as a user types them.

use crate::common::{cdpr, data_path, text, unwrapped};
use crate::models::answer;
use crate::safety::point_mass;
use serde_json::Value;
use tempfile::TempDir;

#[test]
fn a_move_is_planned_for_a_controller_and_simulated_from_its_table() {
    let folder = TempDir::new().unwrap();
    let robot = data_path("robots/cogiro.json");
    let poses = data_path("poses/one-metre.csv");
    let out = folder.path().join("move.csv");
    let out = out.to_str().unwrap();
    let plan = ["path", &robot, "--poses", &poses];
    let with = "seconds=1,shaper=zvd,rate=100,residual=0.3";
    let printed = cdpr(&[&plan[..], &["--with", with, "--out", out]].concat());
    let summary = text(printed.stdout);
    assert_eq!(printed.status.code(), Some(0), "{}", unwrapped(printed.stderr));
    assert!(
        summary.contains("\nCoGiRo: 1.000 m in 1 s, at up to 2.21 m/s, 101 set points\nShaper for "),
        "{summary}"
    );
    assert!(summary.starts_with("CoGiRo: in 0.300 s after the move P swings by up to 0."), "{summary}");
    assert!(summary.lines().all(|line| line.chars().count() <= 80), "{summary}");
    let table = std::fs::read_to_string(out).unwrap();
    let mut lines = table.lines();
    assert!(lines.next().unwrap().starts_with("t_s,x_m,y_m,z_m,qw,qx,qy,qz,length_1_m,length_2_m,"));
    assert!(lines.next().unwrap().starts_with("0.0,-0.5,0.0,2.0,1.0,0.0,0.0,0.0,"), "{table}");
    assert!(lines.next_back().unwrap().starts_with("1.0,0.5,0.0,2.0,1.0,0.0,0.0,0.0,"), "{table}");
    assert_eq!(lines.count(), 99);

    let simulated = cdpr(&[
        "simulate",
        &robot,
        "--lengths",
        out,
        "--until",
        "1.2",
        "--with",
        "degree=5,elements=2",
        "--format",
        "json",
    ]);
    assert_eq!(simulated.status.code(), Some(0), "{}", unwrapped(simulated.stderr));
    let whole: Value = serde_json::from_str(&text(simulated.stdout)).unwrap();
    let farthest = whole["greatest_distance_m"].as_f64().unwrap();
    assert!((farthest - 1.0).abs() < 2e-3, "{farthest}");
    assert!(whole["cables"].as_array().unwrap().iter().all(|cable| cable["slack"] == false), "{whole}");
}

#[test]
fn the_length_of_a_move_is_that_of_the_curve_on_which_the_platform_moves() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[3.0, 2.0, 4.0], [-3.0, 2.0, 4.0], [0.0, -2.0, 4.0]], false);
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x,y,z\n-0.5,0,1\n0.5,0,1\n0.5,0.8,1\n").unwrap();
    let out = folder.path().join("move.csv");
    let call = ["path", &robot, "--poses", poses.to_str().unwrap(), "--with", "seconds=4,rate=100"];
    let said = text(cdpr(&[&call[..], &["--out", out.to_str().unwrap()]].concat()).stdout);
    let table = std::fs::read_to_string(&out).unwrap();
    let place = |row: &str| -> Vec<f64> { row.split(',').map(|cell| cell.parse().unwrap()).collect() };
    let rows: Vec<Vec<f64>> = table.lines().skip(1).map(place).collect();
    let way = |pair: &[Vec<f64>]| (1..4).map(|k| (pair[1][k] - pair[0][k]).powi(2)).sum::<f64>().sqrt();
    let moved: f64 = rows.windows(2).map(way).sum();
    let found = answer(&call)["way_m"].as_f64().unwrap();
    // The straight distances are 1.8 m together.
    assert!(found > 1.82 && (found / moved - 1.0).abs() < 1e-3, "{found} {moved}");
    assert!(said.contains(&format!("Point mass: {found:.3} m in 4 s, at up to ")), "{said}");
}

#[test]
fn a_curve_that_dips_into_the_ground_between_its_poses_is_questioned() {
    let folder = TempDir::new().unwrap();
    let robot = point_mass(&folder, &[[3.0, 2.0, 4.0], [-3.0, 2.0, 4.0], [0.0, -2.0, 4.0]], false);
    let mut file: Value = serde_json::from_str(&std::fs::read_to_string(&robot).unwrap()).unwrap();
    file["ground_z"] = 0.0.into();
    std::fs::write(&robot, file.to_string()).unwrap();
    let poses = folder.path().join("poses.csv");
    let run = |low: f64| {
        std::fs::write(&poses, format!("x,y,z\n-1,0,2\n-0.5,0,{low}\n0.5,0,{low}\n1,0,2\n")).unwrap();
        cdpr(&["path", &robot, "--poses", poses.to_str().unwrap(), "--with", "seconds=20"])
    };
    let low = run(0.05);
    let said = unwrapped(low.stderr);
    assert!(
        said.contains("question: the move at 10 s is at z = -0.") && said.contains("more poses"),
        "{said}"
    );
    assert_eq!(low.status.code(), Some(3));
    assert_eq!(run(1.2).status.code(), Some(0));
}

#[test]
fn what_a_move_cannot_be_is_refused_with_what_would_be_right() {
    let robot = data_path("robots/cogiro.json");
    let poses = data_path("poses/one-metre.csv");
    for (with, further, expected) in [
        ("profile=cosine", &[][..], "expected seconds=S"),
        ("seconds=1,profile=linear", &[], "expected trapezoid, cosine, polynomial"),
        ("seconds=1,shaper=zvdd", &[], "expected zv, zvd, ei"),
        ("seconds=1,profile=cosine,feed-forward", &[], "expected polynomial with feed-forward"),
        ("seconds=0.3,feed-forward=platform", &[], "the move is too fast at 0."),
        ("seconds=1,speed=2", &[], "--with speed: expected seconds, profile"),
        ("seconds=1,shaper", &["--uncertainty", "mass=1"], "expected --with residual"),
        ("seconds=1,residual", &["--uncertainty", "mass=1"], "expected seed=N"),
        ("seconds=1,residual=-0.5", &[], "--with residual=-0.5: expected a time above 0 s"),
        ("seconds=1,damping=-1", &[], "--with damping=-1: expected a time of 0 s or more"),
        ("seconds=1,modes=2", &[], "--with modes: expected shaper, too"),
    ] {
        let call = [&["path", &robot, "--poses", &poses, "--with", with], further].concat();
        let printed = cdpr(&call);
        let error = unwrapped(printed.stderr);
        assert!(printed.status.code() == Some(1) || printed.status.code() == Some(2), "{with}: {error}");
        assert!(error.replace('\n', " ").contains(expected), "{with}: {error}");
    }
    let none = cdpr(&["simulate", &robot, "--pose", "0,0,2", "--until", "1"]);
    assert!(unwrapped(none.stderr).contains("expected --events"));
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("lengths.csv");
    let file = file.to_str().unwrap();
    std::fs::write(file, "t_s,length_1_m\n0,9\n1,9\n").unwrap();
    let error = unwrapped(cdpr(&["simulate", &robot, "--lengths", file, "--until", "1"]).stderr);
    assert!(error.contains("no length_2_m") && error.contains("lengths.csv"), "{error}");
}

#[test]
fn few_set_points_hide_no_tension_of_the_motion() {
    let (robot, poses) = (data_path("robots/cogiro.json"), data_path("poses/one-metre.csv"));
    let plan = |rate: &str| {
        let with = format!("seconds=1,rate={rate}");
        answer(&["path", &robot, "--poses", &poses, "--with", &with])
    };
    let [few, many] = ["3", "500"].map(plan);
    assert_eq!(few["set_points"].as_array().unwrap().len(), 4);
    for name in ["least_tension_n", "greatest_exit_tension_n"] {
        let [few, many] = [&few, &many].map(|of| of[name].as_f64().unwrap());
        assert!((few / many - 1.0).abs() < 0.01, "{name}: {few} {many}");
    }
}

#[test]
fn a_shaper_that_is_left_out_is_named() {
    let (robot, poses) = (data_path("robots/cogiro.json"), data_path("poses/one-metre.csv"));
    let found = cdpr(&["path", &robot, "--poses", &poses, "--with", "seconds=0.2,shaper"]);
    let summary = text(found.stdout);
    assert!(
        summary.contains("\nNo shaper: of those that take less than 0.2 s none leaves less"),
        "{summary}"
    );
}

/// A shaper makes the profile faster, and cables slack, of which the linear motions that it is for know
/// nothing.
#[test]
fn a_shaper_that_makes_cables_slack_and_the_swing_worse_is_said_to() {
    let folder = TempDir::new().unwrap();
    let exits = [[-3.0, -2.0, 5.0], [3.0, -2.0, 5.0], [0.0, 3.0, 5.5]];
    let robot = point_mass(&folder, &exits, false);
    let heavier = std::fs::read_to_string(&robot).unwrap().replace("\"mass\":10", "\"mass\":30");
    std::fs::write(&robot, heavier.replace("1e9", "4.8e10").replace("1000000000.0", "4.8e10")).unwrap();
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x_m,y_m,z_m\n-0.5,0,2\n0.5,0.3,2.5\n").unwrap();
    let plan = ["path", &robot, "--poses", poses.to_str().unwrap(), "--with"];
    let worse = cdpr(&[&plan[..], &["seconds=1,shaper=ei,modes=3,damping=1e-3,residual=0.5"]].concat());
    let said = text(worse.stdout).replace('\n', " ");
    assert_eq!(worse.status.code(), Some(3), "{said}");
    assert!(said.contains("The shaper makes it worse: take more seconds, fewer modes or none."), "{said}");
    assert!(said.contains(" times) and "), "{said}");
    assert!(said.contains("Without shaper and feed-forward cable 1 loses its tension."), "{said}");
}

#[test]
fn a_motion_below_the_error_of_its_simulation_has_no_ratio() {
    let poses = data_path("poses/one-metre.csv");
    let plan = |with| ["path", "cogiro", "--poses", &poses, "--with", with];
    let quiet = plan("seconds=2,shaper,feed-forward,residual=0.3,rate=50");
    let whole = answer(&quiet);
    let found = &whole["residual"];
    assert!(found["amplitude_m"].as_f64() < found["difference_m"].as_f64(), "{found}");
    assert!(found["ratio"].is_null(), "{found}");
    let said = text(cdpr(&quiet).stdout).replace('\n', " ");
    // Of the two motions that the sentence compares, the one is known, and the other is not.
    assert!(said.contains(" P swings by less than "), "{said}");
    assert!(
        said.contains(" mm, the error of the simulation; without shaper and feed-forward by up to "),
        "{said}"
    );
    let whole = answer(&plan("seconds=1,residual=0.3,rate=50"));
    let found = &whole["residual"];
    assert!(found["amplitude_m"].as_f64() > found["difference_m"].as_f64(), "{found}");
    assert!((found["ratio"].as_f64().unwrap() - 1.0).abs() < 1e-6, "{found}");
}
