//! Every kind of sensor and of its errors, with simulated campaigns of differing robots.

use crate::common::{Case, EXTERNAL, cases};
use cdpr_calibration::{
    Estimate, Fit, FitSettings, Noise, Quantity, Reading, Row, SensorError, Simulated, Unknowns, drawn,
    drawn_errors, fit, simulate,
};
use cdpr_robot::{CableEnd, Parameter, Pose, Robot, Vector3};
use cdpr_statics::{Load, inverse};

/// A campaign with errors of the sensors.
struct Campaign<'a> {
    case: &'a Case,
    noise: Noise,
    errors: &'a [(SensorError, f64)],
    markers: &'a [Vector3<f64>],
    load: Load,
    at: CableEnd,
    poses: usize,
}

/// What is true, and what was found.
struct Outcome {
    fit: Fit,
    truth: Vec<f64>,
    errors: Vec<f64>,
}

impl<'a> Campaign<'a> {
    fn of(case: &'a Case, noise: Noise) -> Self {
        let load = Load::none();
        Self { case, noise, errors: &[], markers: &[], load, at: CableEnd::Anchor, poses: 30 }
    }

    fn run(&self, seed: u64, change: impl Fn(&mut Vec<Row>)) -> Outcome {
        let Self { case, .. } = self;
        let truth = drawn(&case.model(), seed);
        let errors = drawn_errors(&case.robot, self.errors, self.markers.len(), seed);
        let mut rows = simulate(&Simulated {
            load: self.load,
            markers: self.markers,
            errors: &errors,
            tension_at: self.at,
            ..case.simulated(&truth, &case.poses(self.poses), self.noise, seed)
        })
        .unwrap();
        change(&mut rows);
        let mut unknowns = Unknowns::of_model(&case.model());
        for (error, _) in self.errors {
            unknowns.add(&case.robot, *error, None, self.markers.len());
        }
        unknowns.set_markers(self.markers.to_vec());
        let fit = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
        Outcome { fit, truth, errors: errors.into_iter().flat_map(|(_, numbers)| numbers).collect() }
    }
}

impl Outcome {
    /// How far each number that is told lies from the truth, in its standard deviations.
    fn far(&self) -> Vec<f64> {
        let fit = &self.fit;
        let parameters = Parameter::of(&fit.robot);
        let of_robot = fit.unknowns.of_parameters();
        let mut far = Vec::new();
        for (k, estimate) in fit.estimates.iter().enumerate() {
            let Estimate { name, value, std: Some(std), .. } = estimate else { continue };
            let value = match name.as_str() {
                "frame.x" => fit.origin.x,
                "frame.y" => fit.origin.y,
                "frame.z" => fit.origin.z,
                _ => *value,
            };
            let truth = if k < of_robot {
                self.truth[parameters.iter().position(|p| p.to_string() == *name).unwrap()]
            } else {
                self.errors[k - of_robot]
            };
            // The rotation of a tracker stands in its frame.
            if estimate.is_identifiable() && !name.starts_with("frame.r") {
                far.push((value - truth) / std);
            }
        }
        far
    }
}

/// Campaigns with each robot: all numbers lie near the truth, and chi-square is as great as it should be.
fn check(name: &str, robots: &[&str], of: impl Fn(&Case, u64) -> Outcome) {
    const CAMPAIGNS: u64 = 2;
    for case in cases().iter().filter(|case| robots.is_empty() || robots.contains(&case.name)) {
        let outcomes: Vec<Outcome> = (1..=CAMPAIGNS).map(|seed| of(case, seed)).collect();
        let far: Vec<f64> = outcomes.iter().flat_map(Outcome::far).map(f64::abs).collect();
        let chi: f64 = outcomes.iter().map(|of| of.fit.chi_square).sum();
        let degrees = outcomes.iter().map(|of| of.fit.degrees_of_freedom).sum::<usize>() as f64;
        let steps = outcomes.iter().map(|of| of.fit.steps).max().unwrap();
        let farthest = far.iter().copied().fold(0.0, f64::max);
        println!(
            "{name}, {}: {} numbers, the farthest {farthest:.1} std off, chi-square per degree {:.3}, {steps} steps",
            case.name,
            far.len(),
            chi / degrees
        );
        assert!(outcomes.iter().all(|of| of.fit.converged()), "{name}, {}", case.name);
        assert!(farthest < 4.5, "{name}, {}: {farthest}", case.name);
        assert!((chi / degrees - 1.0).abs() < 4.0 * (2.0 / degrees).sqrt(), "{name}, {}: {chi}", case.name);
    }
}

/// A load under which a robot moves visibly.
fn heavy(case: &Case) -> Load {
    Load::payload(match case.name {
        "FAST" => 2000.0,
        "GRAB" => 0.5,
        _ => 50.0,
    })
}

#[test]
fn markers_tell_the_robot_wherever_they_and_the_tracker_are() {
    let markers = [[0.2, 0.1, 0.3], [-0.2, 0.15, 0.1], [0.1, -0.3, 0.0]].map(Vector3::from);
    let noise = Noise { marker: Some(1e-4), length: Some(1e-4), ..Noise::default() };
    let moved = [(SensorError::Markers, 0.02)];
    let tracked = [(SensorError::Markers, 0.02), (SensorError::Frame, 1.0), (SensorError::FrameScale, 1e-3)];
    for (name, errors) in
        [("markers", &[][..]), ("markers anywhere", &moved), ("markers and a tracker anywhere", &tracked)]
    {
        check(name, &[], |case, seed| {
            Campaign { markers: &markers, errors, ..Campaign::of(case, noise) }.run(seed, |_| {})
        });
    }
}

#[test]
fn displacements_by_a_load_tell_the_robot_with_and_without_poses() {
    let both = Noise { displacement: Some(1e-4), ..EXTERNAL };
    let alone = Noise { displacement: Some(1e-4), ..Noise::default() };
    // Which of CAROCA's stiff cables are slack cannot be told from displacements alone.
    let others = ["CoGiRo", "IPAnema", "FAST", "GRAB"];
    for (name, robots, noise) in
        [("displacements and poses", &[][..], both), ("displacements alone", &others, alone)]
    {
        check(name, robots, |case, seed| {
            Campaign { load: heavy(case), ..Campaign::of(case, noise) }.run(seed, |_| {})
        });
    }
}

#[test]
fn swivel_angles_and_inclinations_have_their_offsets_found() {
    let noise = Noise { swivel: Some(1e-3), ..EXTERNAL };
    let errors = [(SensorError::SwivelOffset, 0.05)];
    // Pulleys with vertical axes.
    check("swivel angles", &["IPAnema"], |case, seed| {
        Campaign { errors: &errors, ..Campaign::of(case, noise) }.run(seed, |_| {})
    });
    let errors = [(SensorError::AngleOffset, 0.02)];
    check("inclinations", &[], |case, seed| {
        Campaign { errors: &errors, ..Campaign::of(case, EXTERNAL) }.run(seed, |rows| {
            let errors = drawn_errors(&case.robot, &errors, 0, seed);
            for row in rows.iter_mut() {
                let (roll, pitch, yaw) = row.rotation.unwrap().euler_angles();
                row.readings.retain(|of| !matches!(of.quantity, Quantity::Rotation(_)));
                for (k, angle) in [roll, pitch, yaw].into_iter().enumerate() {
                    let value = angle + errors[0].1[k];
                    row.readings.push(Reading { quantity: Quantity::Angle(k), value, std: 1e-4 });
                }
                row.rotation = None;
            }
        })
    });
}

#[test]
fn load_cells_at_both_ends_of_the_cables_have_their_errors_found() {
    let errors = [(SensorError::TensionBias, 10.0), (SensorError::TensionGain, 0.05)];
    let noise = Noise { tension: Some(1.0), ..EXTERNAL };
    for at in [CableEnd::Anchor, CableEnd::Exit] {
        check(&format!("tensions at the {at:?}"), &[], |case, seed| {
            Campaign { errors: &errors, at, ..Campaign::of(case, noise) }.run(seed, |_| {})
        });
    }
}

#[test]
fn winches_that_count_from_anywhere_with_other_drums_are_found() {
    let errors = [(SensorError::LengthOffset, 0.3), (SensorError::DrumScale, 0.01)];
    check("relative lengths", &[], |case, seed| {
        Campaign { errors: &errors, ..Campaign::of(case, EXTERNAL) }.run(seed, |_| {})
    });
}

#[test]
fn lengths_and_tensions_alone_tell_the_robot_and_their_errors() {
    let noise = Noise { length: Some(2e-4), tension: Some(1.0), ..Noise::default() };
    let errors = [(SensorError::LengthOffset, 0.02), (SensorError::TensionBias, 10.0)];
    check("self-calibration", &["CAROCA", "CoGiRo", "IPAnema", "FAST"], |case, seed| {
        Campaign { errors: &errors, poses: 60, ..Campaign::of(case, noise) }.run(seed, |_| {})
    });
}

/// Where the limits of tensions do not allow a pose, the search for the winches begins with straight lengths.
#[test]
fn winches_are_found_where_poses_lie_beyond_the_limits_of_tensions() {
    let [mut case, ..] = cases();
    case.robot.cables.iter_mut().for_each(|cable| cable.lead = 4.0);
    let errors = [(SensorError::LengthOffset, 0.01), (SensorError::DrumScale, 0.01)];
    let errors = drawn_errors(&case.robot, &errors, 0, 1);
    let poses = case.poses(30);
    let truth = drawn(&case.model(), 1);
    let rows = simulate(&Simulated { errors: &errors, ..case.simulated(&truth, &poses, EXTERNAL, 1) });
    let held = |robot: &Robot, pose: &Pose| inverse(robot, pose, &Load::none());
    let greatest = |pose: &Pose| held(&case.robot, pose).unwrap().tensions.into_iter().fold(0.0, f64::max);
    let mut limited = case.robot.clone();
    limited.tension_limits.max = 1.1 * poses.iter().map(greatest).fold(f64::INFINITY, f64::min);
    let beyond = poses.iter().filter(|pose| held(&limited, pose).is_err()).count();
    assert!((3..=27).contains(&beyond), "{beyond} of 30");
    let mut unknowns = Unknowns::of_model(&case.model());
    errors.iter().for_each(|(error, _)| unknowns.add(&limited, *error, None, 0));
    let found = fit(&limited, &rows.unwrap(), &unknowns, &FitSettings::default()).unwrap();
    assert!(found.converged() && found.p_value().unwrap() > 1e-3, "{:?}", found.p_value());
}
