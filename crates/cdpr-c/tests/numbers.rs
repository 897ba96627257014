//! The digits of the C interface are those of the Rust interface.

use crate::common::{Digits, LOAD, ROBOTS_AT, STEPS, expected, level, load, robot, x_of_step};
use cdpr_c::border::path::{cdpr_path_free, cdpr_path_limit_change, cdpr_path_new, cdpr_path_next};
use cdpr_c::border::{
    cdpr_deflection, cdpr_derivatives, cdpr_direct, cdpr_inverse, cdpr_robot_cables, cdpr_robot_free,
    cdpr_robot_inputs, cdpr_robot_named, cdpr_stiffness, cdpr_tracker_free, cdpr_tracker_new,
    cdpr_tracker_shape, cdpr_tracker_state, cdpr_tracker_step,
};
use cdpr_c::{
    CdprCables, CdprDerivatives, CdprLoad, CdprMotion, CdprPose, CdprReport, CdprRobot, CdprStatus,
    CdprStiffness,
};
use cdpr_robot::{Pose, Vector3};
use cdpr_statics::{DirectProblem, DirectStart, Load, WantedPose, direct, inverse};
use std::ffi::CString;
use std::ptr::{null, null_mut};

const NO_REPORT: CdprReport =
    CdprReport { closure: f64::NAN, force: f64::NAN, moment: f64::NAN, iterations: 99, jump: 99 };

fn report(digits: &mut Digits, report: &CdprReport) {
    let CdprReport { closure, force, moment, iterations, jump } = *report;
    digits.line("report", &[closure, force, moment, f64::from(iterations), f64::from(jump)]);
}

fn pose(digits: &mut Digits, pose: &CdprPose) {
    digits.line("position", &pose.position);
    digits.line("quaternion", &pose.quaternion);
}

/// All results at a pose and along a path, by the C interface.
fn through_c(name: &str, position: [f64; 3]) -> String {
    let (name, mut robot, mut digits) = (CString::new(name).unwrap(), null_mut(), Digits::default());
    unsafe {
        assert_eq!(cdpr_robot_named(name.as_ptr(), &mut robot), CdprStatus::Ok);
        at_pose(robot, position, &mut digits);
        along_path(robot, position, &mut digits);
        cdpr_robot_free(robot);
    }
    digits.0
}

unsafe fn at_pose(robot: *const CdprRobot, position: [f64; 3], digits: &mut Digits) {
    let (n, inputs) = unsafe { (cdpr_robot_cables(robot), cdpr_robot_inputs(robot)) };
    let (mut lengths, mut tensions) = (vec![0.0; n], vec![0.0; n]);
    let cables = CdprCables { count: n, lengths: lengths.as_mut_ptr(), tensions: tensions.as_mut_ptr() };
    let (wanted, mut found, mut of) = (level(position), level(position), NO_REPORT);
    unsafe {
        assert_eq!(cdpr_inverse(robot, &wanted, null(), &cables, &mut of), CdprStatus::Ok);
        digits.line("lengths", &lengths);
        digits.line("tensions", &tensions);
        report(digits, &of);
        assert_eq!(cdpr_direct(robot, &cables, &LOAD, &mut found, &mut of), CdprStatus::Ok);
        pose(digits, &found);
        digits.line("tensions", &tensions);
        report(digits, &of);
        let mut motion = CdprMotion { translation: [0.0; 3], rotation: [0.0; 3] };
        assert_eq!(cdpr_deflection(robot, &wanted, &LOAD, &mut motion, &mut of), CdprStatus::Ok);
        digits.line("translation", &motion.translation);
        digits.line("rotation", &motion.rotation);
        report(digits, &of);
        let mut stiffness = CdprStiffness { matrix: [[0.0; 6]; 6], least: 0.0, is_stable: 9 };
        assert_eq!(cdpr_stiffness(robot, &wanted, &LOAD, &mut stiffness, &mut of), CdprStatus::Ok);
        digits.line("stiffness", stiffness.matrix.iter().flatten());
        digits.line("least", &[stiffness.least]);
        assert_eq!(stiffness.is_stable, 1);
        report(digits, &of);
        let [mut of_lengths, mut of_tensions, mut displacement, mut magnitude] =
            [n, n, 3, 1].map(|rows| vec![0.0; rows * inputs]);
        let slopes = CdprDerivatives {
            inputs,
            lengths: of_lengths.as_mut_ptr(),
            tensions: of_tensions.as_mut_ptr(),
            displacement: displacement.as_mut_ptr(),
            magnitude: magnitude.as_mut_ptr(),
        };
        assert_eq!(cdpr_derivatives(robot, &wanted, &LOAD, &slopes, &mut of), CdprStatus::Ok);
        digits.line("lengths", &of_lengths);
        digits.line("tensions", &of_tensions);
        digits.line("displacement", &displacement);
        digits.line("magnitude", &magnitude);
        report(digits, &of);
    }
}

unsafe fn along_path(robot: *const CdprRobot, position: [f64; 3], digits: &mut Digits) {
    let n = unsafe { cdpr_robot_cables(robot) };
    let (mut lengths, mut tensions) = (vec![0.0; n], vec![0.0; n]);
    let cables = CdprCables { count: n, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
    let (mut wanted, mut found, mut of) = (level(position), level([0.0; 3]), NO_REPORT);
    let (mut path, mut tracker) = (null_mut(), null_mut());
    unsafe {
        assert_eq!(cdpr_path_new(robot, &mut path), CdprStatus::Ok);
        assert_eq!(cdpr_path_next(path, &wanted, null(), null(), &cables, &mut of), CdprStatus::Ok);
        let created = cdpr_tracker_new(robot, lengths.as_ptr(), n, &LOAD, &wanted, &mut tracker);
        assert_eq!(created, CdprStatus::Ok);
        for k in 1..=STEPS {
            wanted.position[0] = x_of_step(position[0], k);
            assert_eq!(cdpr_path_next(path, &wanted, null(), null(), &cables, &mut of), CdprStatus::Ok);
            digits.line("lengths", &lengths);
            report(digits, &of);
            let stepped = cdpr_tracker_step(tracker, lengths.as_ptr(), n, &LOAD, &mut of);
            assert_eq!(stepped, CdprStatus::Ok);
            report(digits, &of);
            let state = cdpr_tracker_state(tracker, &mut found, tensions.as_mut_ptr(), n);
            assert_eq!(state, CdprStatus::Ok);
            pose(digits, &found);
            digits.line("tensions", &tensions);
        }
        cdpr_tracker_free(tracker);
        cdpr_path_free(path);
    }
}

#[test]
fn the_bits_are_those_of_the_rust_interface() {
    for (name, position) in ROBOTS_AT {
        let (found, expected) = (through_c(name, position), expected(name, position));
        for (found, expected) in found.lines().zip(expected.lines()) {
            assert_eq!(found, expected, "{name}");
        }
        assert_eq!(found.lines().count(), expected.lines().count(), "{name}");
    }
}

/// The shape in the state of a tracker ends at the anchor point and has the digits of the Rust interface.
#[test]
fn a_cable_hangs_from_its_exit_to_the_platform() {
    const POINTS: usize = 11;
    for (name, position) in ROBOTS_AT {
        let known = robot(name);
        let n = known.cables.len();
        let (handle_name, mut handle, mut tracker) = (CString::new(name).unwrap(), null_mut(), null_mut());
        let (mut lengths, mut points, mut at) = (vec![0.0; n], [0.0; 3 * POINTS], level(position));
        let cables = CdprCables { count: n, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
        unsafe {
            assert_eq!(cdpr_robot_named(handle_name.as_ptr(), &mut handle), CdprStatus::Ok);
            assert_eq!(cdpr_inverse(handle, &at, null(), &cables, null_mut()), CdprStatus::Ok);
            let created = cdpr_tracker_new(handle, lengths.as_ptr(), n, &LOAD, &at, &mut tracker);
            assert_eq!(created, CdprStatus::Ok);
            assert_eq!(cdpr_tracker_state(tracker, &mut at, null_mut(), 0), CdprStatus::Ok);
        }
        let [w, x, y, z] = at.quaternion;
        let pose = Pose::with_quaternion(at.position.into(), [w, x, y, z]).unwrap();
        let start = direct(&known, &lengths, &load(), DirectStart::Pose(&pose)).unwrap().equilibrium;
        let problem = DirectProblem::new(&known, &lengths, &load()).unwrap();
        for i in 0..n {
            let found = unsafe { cdpr_tracker_shape(tracker, i, points.as_mut_ptr(), POINTS) };
            assert_eq!(found, CdprStatus::Ok);
            let shape = problem.shape(&start, i, 2, POINTS).unwrap();
            let expected = &shape.points[shape.points.len() - POINTS..];
            for (point, expected) in points.chunks(3).zip(expected) {
                let apart = (Vector3::from_column_slice(point) - expected).norm();
                assert!(apart < 1e-9, "{name}, cable {i}: {point:?}, expected {expected}");
            }
            let anchor = pose.position + pose.rotation * known.cables[i].anchor_point;
            assert!((Vector3::from_column_slice(&points[30..]) - anchor).norm() < 1e-9, "{name}, cable {i}");
            if known.cables[i].guide(None).is_none() {
                let exit = &known.cables[i].exit_point;
                assert!((Vector3::from_column_slice(&points[..3]) - exit).norm() < 1e-12, "{name}");
            }
        }
        unsafe {
            cdpr_tracker_free(tracker);
            cdpr_robot_free(handle);
        }
    }
}

/// Measured tensions as a reference are approached by no more than the greatest change in each pose.
#[test]
fn tensions_of_a_path_approach_measured_ones_in_steps() {
    const CHANGE: f64 = 2.0;
    let (mut handle, mut path) = (null_mut(), null_mut());
    let (mut lengths, mut tensions, at) = ([0.0; 8], [0.0; 8], level([0.0, 0.0, 1.75]));
    let cables = CdprCables { count: 8, lengths: lengths.as_mut_ptr(), tensions: tensions.as_mut_ptr() };
    let measured = [700.0; 8];
    unsafe {
        assert_eq!(cdpr_robot_named(c"caroca".as_ptr(), &mut handle), CdprStatus::Ok);
        assert_eq!(cdpr_path_new(handle, &mut path), CdprStatus::Ok);
        assert_eq!(cdpr_path_limit_change(path, CHANGE), CdprStatus::Ok);
        assert_eq!(cdpr_path_next(path, &at, null(), null(), &cables, null_mut()), CdprStatus::Ok);
    }
    let known = robot("caroca");
    let pose = Pose::at(0.0, 0.0, 1.75);
    let wanted = WantedPose { tension_reference: Some(&measured), ..(&pose).into() };
    let goal = inverse(&known, wanted, &Load::none()).unwrap().tensions;
    let mut last = tensions;
    let apart = |tensions: &[f64; 8]| {
        let each = tensions.iter().zip(&goal).map(|(tension, goal)| (tension - goal).abs());
        each.fold(0.0, f64::max)
    };
    let first = apart(&tensions);
    assert!(first > 5.0 * CHANGE, "{first}");
    for _ in 0..30 {
        let next = unsafe { cdpr_path_next(path, &at, null(), measured.as_ptr(), &cables, null_mut()) };
        assert_eq!(next, CdprStatus::Ok);
        let changes = tensions.iter().zip(&last).map(|(now, last)| (now - last).abs());
        assert!(changes.fold(0.0, f64::max) <= CHANGE * (1.0 + 1e-9), "{tensions:?} after {last:?}");
        last = tensions;
    }
    assert!(apart(&tensions) < 1e-6, "{tensions:?}, expected {goal:?}");
    unsafe {
        cdpr_path_free(path);
        cdpr_robot_free(handle);
    }
}

#[test]
fn a_step_allocates_nothing_whether_it_converges_or_not() {
    let (mut robot, mut tracker) = (null_mut(), null_mut());
    let (mut lengths, mut tensions, mut pose) = ([0.0; 8], [0.0; 8], level([0.0, 0.0, 1.75]));
    let cables = CdprCables { count: 8, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
    let mut of = NO_REPORT;
    unsafe {
        assert_eq!(cdpr_robot_named(c"caroca".as_ptr(), &mut robot), CdprStatus::Ok);
        assert_eq!(cdpr_inverse(robot, &pose, null(), &cables, null_mut()), CdprStatus::Ok);
        let created = cdpr_tracker_new(robot, lengths.as_ptr(), 8, null(), &pose, &mut tracker);
        assert_eq!(created, CdprStatus::Ok);
        // The tracker keeps its robot.
        cdpr_robot_free(robot);
        let short = lengths.map(|length| length - 1.0);
        let mut not_a_number = lengths;
        not_a_number[3] = f64::NAN;
        let heavy = CdprLoad { payload: 1e13, ..LOAD };
        let mut ended = [CdprStatus::Panic; 6];
        let allocated = allocation_counter::measure(|| {
            lengths[0] -= 1e-3;
            ended[0] = cdpr_tracker_step(tracker, lengths.as_ptr(), 8, &LOAD, &mut of);
            ended[1] = cdpr_tracker_step(tracker, short.as_ptr(), 8, &LOAD, &mut of);
            ended[2] = cdpr_tracker_step(tracker, not_a_number.as_ptr(), 8, &LOAD, null_mut());
            ended[3] = cdpr_tracker_step(tracker, [0.0; 8].as_ptr(), 8, &LOAD, null_mut());
            ended[4] = cdpr_tracker_step(tracker, lengths.as_ptr(), 8, &heavy, null_mut());
            ended[5] = cdpr_tracker_state(tracker, &mut pose, tensions.as_mut_ptr(), 8);
        });
        let invalid = CdprStatus::Invalid;
        let expected = [CdprStatus::Ok, CdprStatus::NotConverged, invalid, invalid, invalid, CdprStatus::Ok];
        assert_eq!(ended, expected);
        assert_eq!(allocated.count_total, 0);
        // The report is that of the state before, with the iterations of the step that failed.
        assert!(of.iterations <= 12 && of.force < 1e-8 && tensions[0] > 0.0, "{of:?}");
        assert!((pose.position[2] - 1.75).abs() < 0.01 && pose.position != [0.0, 0.0, 1.75]);
        cdpr_tracker_free(tracker);
    }
}
