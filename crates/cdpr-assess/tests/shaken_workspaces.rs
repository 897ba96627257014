//! Maps of the largest amplitude of a platform that is shaken.

use cdpr_assess::{Further, HELD, Shaking, Workspace, WorkspaceSummary, compute_workspace};
use cdpr_dynamics::{Damping, LargestInBand};
use cdpr_robot::{Coordinate, Pose, Robot, Rotation3, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, WantedPose, inverse};
use cdpr_study::{Grid, GridAxis};

/// A robot, the middle of its region [m] and the half of its width, and the highest frequency [Hz].
type Case = (&'static str, [f64; 3], f64, f64, &'static [Coordinate]);

const CASES: [Case; 6] = [
    (include_str!("../../../data/robots/caroca.json"), [0.2, 0.1, 1.75], 0.3, 15.0, &[]),
    (include_str!("../../../data/robots/cogiro.json"), [0.0, 0.0, 2.0], 0.5, 6.0, &[]),
    (include_str!("../../../data/robots/fast.json"), [5.0, -2.0, 140.0], 1.0, 0.5, &[]),
    (include_str!("../../../data/robots/ipanema-1.json"), [0.2, 0.1, 1.0], 0.2, 15.0, &[]),
    (
        include_str!("../../../data/robots/four-cables.json"),
        [0.4, 0.35, 1.8],
        0.05,
        10.0,
        &[Coordinate::Roll, Coordinate::Pitch],
    ),
    (include_str!("../../../data/robots/expo2015-roberto.json"), [0.4, 0.0, 3.5], 0.1, 5.0, &[]),
];

fn axis(middle: f64, half: f64, points: usize) -> GridAxis {
    GridAxis { min: middle - half, max: middle + half, points }
}

#[test]
fn every_position_has_the_amplitudes_that_it_has_alone() {
    for (file, [x, y, z], half, highest, free) in CASES {
        let mut robot = Robot::from_json(file).unwrap();
        let damping = Damping { stretch: 5e-4, drag: 0.5 };
        let shaking =
            Shaking { band: [0.1 * highest, highest], damping, marker: Vector3::new(0.1, 0.0, -0.2) };
        let workspace = Workspace {
            robot: &robot,
            grid: Grid::new([axis(x, half, 2), axis(y, half, 2), axis(z, 0.0, 1)]).unwrap(),
            rotation: Rotation3::identity(),
            load: Load::none(),
            tolerances: None,
            free,
            further: Further { shaking: Some(shaking), ..Further::default() },
        };
        let poses = compute_workspace(&workspace, &|| (), &|| false).unwrap();
        let summary = WorkspaceSummary::new(&workspace, &poses);
        let poses: Vec<Pose> = poses.iter().map(|found| found.pose).collect();
        assert_eq!(summary.shaking.unwrap().inertia_assumed, robot.platform.inertia.is_none());
        robot.platform.inertia = Some(robot.platform.inertia.unwrap_or_else(|| robot.assumed_inertia()));
        let mut largest = 0.0_f64;
        for (pose, row) in poses.iter().zip(&summary.rows) {
            assert_eq!((row.status, &row.amplitude_reason), (HELD, &None), "{} {row:?}", robot.name);
            let held = inverse(&robot, WantedPose::at(pose).free(free), &Load::none()).unwrap();
            let problem = DirectProblem::new(&robot, &held.lengths, &Load::none()).unwrap();
            let rest = problem.direct(DirectStart::Near(&held.equilibrium)).unwrap().equilibrium;
            let alone = LargestInBand::new(&problem, &rest, shaking.band, damping, &shaking.marker).unwrap();
            let same = |found: Option<f64>, expected: f64| (found.unwrap() / expected - 1.0).abs() < 1e-4;
            assert!(same(row.amplitude_mm_per_n, 1e3 * alone.per_force.amplitude), "{alone:?} {row:?}");
            assert!(same(row.amplitude_at_hz, alone.per_force.frequency), "{alone:?} {row:?}");
            assert!(same(row.winch_mm_per_mm, alone.per_shortening.amplitude), "{alone:?} {row:?}");
            assert!(row.winch.is_some_and(|winch| (1..=robot.cables.len()).contains(&winch)));
            largest = largest.max(row.amplitude_mm_per_n.unwrap());
        }
        println!("{}: {:?}", robot.name, summary.amplitude_mm_per_n);
        assert_eq!(summary.amplitude_mm_per_n.unwrap().max, largest);
    }
}

#[test]
fn a_position_says_why_it_has_no_amplitude_and_wrong_settings_are_refused() {
    let robot = Robot::from_json(CASES[1].0).unwrap();
    let shaking =
        |band, stretch, drag| Shaking { band, damping: Damping { stretch, drag }, marker: Vector3::zeros() };
    let workspace = |shaking| Workspace {
        robot: &robot,
        grid: Grid::new([axis(0.0, 9.0, 2), axis(0.0, 0.0, 1), axis(2.0, 0.0, 1)]).unwrap(),
        rotation: Rotation3::identity(),
        load: Load::none(),
        tolerances: None,
        free: &[],
        further: Further { shaking: Some(shaking), ..Further::default() },
    };
    // Outside of the frame nothing is held.
    let outside = workspace(shaking([0.0, 5.0], 2e-4, 0.0));
    let poses = compute_workspace(&outside, &|| (), &|| false).unwrap();
    assert!(poses.iter().all(|found| found.outcome.is_err() && found.shaken.is_none()));
    let middle = Grid::new([axis(0.0, 0.0, 1), axis(0.0, 0.0, 1), axis(2.0, 0.0, 1)]).unwrap();
    let undamped = Workspace { grid: middle, ..workspace(shaking([0.0, 5.0], 0.0, 0.0)) };
    let poses = compute_workspace(&undamped, &|| (), &|| false).unwrap();
    let row = &WorkspaceSummary::new(&undamped, &poses).rows[0];
    assert_eq!((row.status, row.amplitude_mm_per_n, row.winch), (HELD, None, None));
    assert!(row.amplitude_reason.as_ref().unwrap().contains("natural frequency"), "{row:?}");
    for (wrong, field) in [
        (shaking([5.0, 1.0], 0.0, 0.0), "band"),
        (shaking([-1.0, 1.0], 0.0, 0.0), "band"),
        (shaking([0.0, f64::INFINITY], 0.0, 0.0), "band"),
        (shaking([0.0, 1.0], -1.0, 0.0), "damping"),
        (shaking([0.0, 1.0], 0.0, f64::NAN), "drag"),
        (Shaking { marker: Vector3::new(f64::NAN, 0.0, 0.0), ..shaking([0.0, 1.0], 0.0, 0.0) }, "marker"),
    ] {
        let refused = compute_workspace(&workspace(wrong), &|| (), &|| false).unwrap_err().to_string();
        assert!(refused.starts_with(&format!("{field} is ")), "{refused}");
    }
}
