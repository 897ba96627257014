//! A tracker that is not in the base frame: its standard deviations, and what is said where it is not sought.

use crate::common::{EXTERNAL, cases};
use cdpr_calibration::{FitSettings, Quantity, Reading, Row, SensorError, Unknowns, drawn, fit, simulate};
use cdpr_robot::{Axis, Rotation3, UnitQuaternion, Vector3};

/// The rows as a tracker elsewhere reads them.
fn seen_from(rows: &mut [Row], turn: &Rotation3<f64>, origin: &Vector3<f64>) {
    for row in rows {
        let at = Axis::ALL.map(|axis| row.value(Quantity::Position(axis)).unwrap());
        let seen = turn * Vector3::from(at) + origin;
        for reading in &mut row.readings {
            if let Quantity::Position(axis) = reading.quantity {
                reading.value = seen[axis as usize];
            }
        }
        row.rotation = row.rotation.map(|rotation| turn * rotation);
    }
}

/// Campaigns whose scatter is compared with the standard deviations.
const CAMPAIGNS: u64 = 20;

#[test]
fn the_place_of_a_tracker_scatters_as_its_standard_deviations_say() {
    let case = &cases()[0];
    for turn in [Rotation3::identity(), Rotation3::from_euler_angles(0.4, -0.9, 2.0)] {
        let origin = Vector3::new(7.0, -3.0, 1.0);
        let (mut off, mut stds) = (vec![[0.0; 6]; 0], vec![[0.0; 6]; 0]);
        for seed in 0..CAMPAIGNS {
            let deviations = drawn(&case.model(), seed);
            let mut rows = simulate(&case.simulated(&deviations, &case.poses(30), EXTERNAL, seed)).unwrap();
            seen_from(&mut rows, &turn, &origin);
            let mut unknowns = Unknowns::of_model(&case.model());
            unknowns.add(&case.robot, SensorError::Frame, None, 0);
            let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap();
            let frame = &found.estimates[found.estimates.len() - 6..];
            let vector =
                |rotation: &Rotation3<f64>| UnitQuaternion::from_rotation_matrix(rotation).scaled_axis();
            let apart = vector(&found.frame) - vector(&turn);
            let moved = found.origin - origin;
            off.push([moved.x, moved.y, moved.z, apart.x, apart.y, apart.z]);
            stds.push([0, 1, 2, 3, 4, 5].map(|k| frame[k].std.unwrap()));
            // The data alone do not tell the place of the frame from that of all points.
            assert!(frame[0].std_of_data.is_none_or(|std| std > stds[0][0]));
        }
        for k in 0..6 {
            let rms =
                |of: &[[f64; 6]]| (of.iter().map(|of| of[k].powi(2)).sum::<f64>() / of.len() as f64).sqrt();
            let (scatter, std) = (rms(&off), rms(&stds));
            println!("{k}: scatter {scatter:.2e}, std {std:.2e}");
            assert!((0.55..1.6).contains(&(scatter / std)), "{k}: scatter {scatter}, std {std}");
        }
    }
}

#[test]
fn a_prior_of_the_frame_is_about_the_base_frame() {
    let case = &cases()[0];
    let mut rows = simulate(&case.simulated(&drawn(&case.model(), 1), &case.poses(30), EXTERNAL, 1)).unwrap();
    let turn = Rotation3::new(Vector3::new(0.0, 0.0, 0.01));
    seen_from(&mut rows, &turn, &Vector3::new(0.01, 0.0, 0.0));
    let with = |std| {
        let mut unknowns = Unknowns::of_model(&case.model());
        unknowns.add(&case.robot, SensorError::Frame, std, 0);
        fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap()
    };
    let (loose, tight) = (with(Some(0.1)), with(Some(1e-5)));
    let angle = |rotation: &Rotation3<f64>| rotation.angle();
    assert!((angle(&loose.frame) - 0.01).abs() < 3e-3 && loose.origin.x > 5e-3, "{}", loose.origin);
    // A prior that is so tight holds the frame.
    assert!(angle(&tight.frame) < 1e-3 && tight.origin.norm() < 1e-3, "{} {}", tight.frame, tight.origin);
    assert!(tight.chi_square > loose.chi_square);
}

#[test]
fn measurements_in_another_frame_are_refused_with_a_hint() {
    for case in cases().iter().filter(|case| case.name != "GRAB") {
        let mut rows =
            simulate(&case.simulated(&drawn(&case.model(), 1), &case.poses(20), EXTERNAL, 1)).unwrap();
        let unknowns = Unknowns::of_model(&case.model());
        assert!(fit(&case.robot, &rows, &unknowns, &FitSettings::default()).is_ok(), "{}", case.name);
        let away = cases().iter().map(|case| case.half.norm()).fold(0.0, f64::max);
        seen_from(&mut rows, &Rotation3::from_euler_angles(0.1, -0.2, 0.9), &Vector3::new(away, 2.0, 0.0));
        let error = fit(&case.robot, &rows, &unknowns, &FitSettings::default()).unwrap_err().to_string();
        assert!(error.contains("seek the place of the tracker, `frame`"), "{}: {error}", case.name);
    }
}

/// Of positions in a plane a mirror and a rotation by 180 degrees are the same. With the platform turned the
/// lengths alone do not show which coordinate it is.
#[test]
fn a_coordinate_with_the_other_sign_is_named_and_not_called_a_rotation() {
    let mut by_positions = 0;
    for case in cases().iter().filter(|case| case.name != "GRAB") {
        for (height, offset, turn) in [(0.0, 0.0, 1.2), (1.0, 0.03, 1.2), (0.0, 0.0, 0.0)] {
            let case = &case.within(Vector3::new(case.half.x, case.half.y, height * case.half.z));
            let rows =
                simulate(&case.simulated(&drawn(&case.model(), 1), &case.poses(20), EXTERNAL, 1)).unwrap();
            for axis in Axis::ALL {
                let mut rows = rows.clone();
                for row in &mut rows {
                    let is_mirrored = |of: &&mut Reading| of.quantity == Quantity::Position(axis);
                    row.readings.iter_mut().filter(is_mirrored).for_each(|of| of.value = offset - of.value);
                    let turn = Rotation3::from_euler_angles(0.0, 0.0, turn);
                    row.rotation = row.rotation.map(|rotation| rotation * turn);
                }
                let unknowns = Unknowns::of_model(&case.model());
                let found = fit(&case.robot, &rows, &unknowns, &FitSettings::default());
                let error = found.unwrap_err().to_string();
                let name = Quantity::Position(axis).to_string();
                println!("{} {height} {turn} {axis:?}: {error}", case.name);
                by_positions += usize::from(error.contains("with the lengths"));
                assert!(error.contains("other sign") && error.contains(&name), "{}: {error}", case.name);
            }
        }
    }
    assert!(by_positions >= 4, "{by_positions}");
}
