//! `cdpr response`: the answer of the library, at a pose and at many.

use crate::common::{cdpr, data_path, data_text, text, unwrapped};
use crate::equilibria::number;
use crate::models::{answer, close};
use cdpr_dynamics::{Damping, FrequencyResponse};
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, Unstable, inverse};
use tempfile::TempDir;

#[test]
fn a_shaken_platform_answers_as_the_library_says_in_json_csv_and_figure() {
    let file = data_path("robots/cogiro.json");
    let robot = Robot::from_json(&data_text("robots/cogiro.json")).unwrap();
    let load = Load::payload(10.0);
    let held = inverse(&robot, &Pose::at(0.5, 0.2, 2.0), &load).unwrap();
    let problem = DirectProblem::new(&robot, &held.lengths, &load).unwrap();
    let rest = problem
        .with_unstable(Unstable::Accepted)
        .direct(DirectStart::Near(&held.equilibrium))
        .unwrap()
        .equilibrium;
    let damping = Damping { stretch: 1e-3, drag: 0.2 };
    let response = FrequencyResponse::new(&problem, &rest, 8.0, damping).unwrap();
    let lever = rest.pose.rotation * Vector3::new(0.1, 0.2, 0.3);
    let folder = TempDir::new().unwrap();
    let figure = folder.path().join("response.svg");
    let given =
        ["response", &file, "--pose", "0.5,0.2,2", "--payload", "10", "--below", "8", "--number", "16"];
    let given = [&given[..], &["--with", "damping=1e-3,drag=0.2", "--marker", "0.1,0.2,0.3"]].concat();
    let found = answer(&[&given[..], &["--figure", figure.to_str().unwrap()]].concat());
    let frequencies = found["frequencies"].as_array().unwrap();
    // Those of equal distances, and the natural ones.
    assert!(frequencies.len() > 25, "{}", frequencies.len());
    for at in frequencies {
        let (per_force, per_shortening) = response.at(number(&at["frequency_hz"])).unwrap().at_point(&lever);
        let worst = per_force.singular_values().max();
        assert!(close(number(&at["amplitude_m_per_n"]), worst, 1e-6));
        assert!(close(number(&at["per_force"][0][1][0]), per_force[(0, 1)].re, 1e-6));
        assert!(close(number(&at["per_shortening"][3][2][1]), per_shortening[(2, 3)].im, 1e-6));
    }
    let svg = std::fs::read_to_string(&figure).unwrap();
    assert!(svg.contains("amplitude [mm/N]") && svg.contains("worst direction"));
    let rows = text(cdpr(&[&given[..], &["--format", "csv"]].concat()).stdout);
    assert_eq!(rows.lines().count(), frequencies.len() + 1);
    assert!(rows.starts_with("frequency_hz,amplitude_m_per_n,x_m_per_n,y_m_per_n,z_m_per_n,winch_1_m_per_m"));
    let shown = text(cdpr(&given).stdout);
    assert!(shown.contains("The largest peaks") && shown.contains("0.001 s"), "{shown}");
    // A table of poses has the largest peak of each.
    let poses = folder.path().join("poses.csv");
    std::fs::write(&poses, "x_m,y_m,z_m\n0.5,0.2,2\n0,0,2\n").unwrap();
    let table =
        cdpr(&["response", &file, "--poses", poses.to_str().unwrap(), "--below", "8", "--payload", "10"]);
    let table = text(table.stdout);
    assert!(table.lines().count() == 3 && table.contains("peak_frequency_hz,peak_m_per_n,static_m_per_n"));
    for refused in [
        ["--below", "0"],
        ["--below", "nan"],
        ["--with", "drag=-1"],
        ["--with", "air"],
        ["--with", "damping=-1"],
    ] {
        let below = if refused[0] == "--below" { &[][..] } else { &["--below", "5"] };
        let refused = cdpr(&[&["response", &file, "--pose", "0,0,2"], below, &refused].concat());
        assert!(matches!(refused.status.code(), Some(1 | 2)));
        assert!(unwrapped(refused.stderr).contains("expected"));
    }
}

#[test]
fn a_peak_that_nothing_damps_has_no_number() {
    let call =
        ["response", &data_path("robots/cogiro.json"), "--pose", "0,0,2", "--below", "5", "--number", "9"];
    let shown = text(cdpr(&[&call[..], &["--with", "damping=0"]].concat()).stdout).replace('\n', " ");
    assert!(
        shown.contains("a force shakes the point without a bound, at ") && !shown.contains("e1"),
        "{shown}"
    );
    let undamped =
        |format: &str| text(cdpr(&[&call[..], &["--with", "damping=0", "--format", format]].concat()).stdout);
    let json: serde_json::Value = serde_json::from_str(&undamped("json")).unwrap();
    let without = |at: &&serde_json::Value| at["amplitude_m_per_n"].is_null();
    let unbounded = json["frequencies"].as_array().unwrap().iter().filter(without).count();
    assert!(
        unbounded > 0 && undamped("csv").lines().filter(|line| line.contains(",,,")).count() == unbounded
    );
    let shown = text(cdpr(&[&call[..], &["--with", "drag=0.5"]].concat()).stdout);
    assert!(!shown.contains("bound"), "{shown}");
}
