//! Bad pointers, sizes, values and robots have a status and a message.

use crate::common::{LOAD, level};
use cdpr_c::border::path::{cdpr_path_free, cdpr_path_limit_change, cdpr_path_new, cdpr_path_next};
use cdpr_c::border::{
    cdpr_deflection, cdpr_derivatives, cdpr_direct, cdpr_inverse, cdpr_message, cdpr_robot_cables,
    cdpr_robot_free, cdpr_robot_from_json, cdpr_robot_input, cdpr_robot_inputs, cdpr_robot_named,
    cdpr_stiffness, cdpr_tracker_free, cdpr_tracker_new, cdpr_tracker_shape, cdpr_tracker_state,
    cdpr_tracker_step, cdpr_version,
};
use cdpr_c::{CdprCables, CdprDerivatives, CdprLoad, CdprRobot, CdprStatus};
use std::ffi::{CStr, CString};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

fn message() -> String {
    unsafe { CStr::from_ptr(cdpr_message()) }.to_str().unwrap().to_owned()
}

fn named(name: &str) -> *mut CdprRobot {
    let (name, mut robot) = (CString::new(name).unwrap(), null_mut());
    assert_eq!(unsafe { cdpr_robot_named(name.as_ptr(), &mut robot) }, CdprStatus::Ok);
    robot
}

/// Asserts that a call fails with a status and with words of a message.
fn fails(found: CdprStatus, status: CdprStatus, words: &str) {
    let message = message();
    assert_eq!(found, status, "{message}");
    assert!(message.contains(words), "{message}");
}

#[test]
fn a_text_that_is_no_robot_is_refused() {
    let mut robot = null_mut();
    let mut read = |text: &[u8]| unsafe {
        let status = cdpr_robot_from_json(text.as_ptr().cast(), text.len(), &mut robot);
        assert!(robot.is_null());
        status
    };
    fails(read(b"{"), CdprStatus::Robot, "line 1");
    fails(read(b""), CdprStatus::Robot, "the text ends");
    fails(read(b"\xff\xfe"), CdprStatus::Robot, "utf-8");
    fails(read(b"{\"format\": \"cdpr-robot/2\"}"), CdprStatus::Robot, "");
    let long = format!("{{\"{}\": 1}}", "é".repeat(5000));
    fails(read(long.as_bytes()), CdprStatus::Robot, "");
    assert!(message().len() < 1024);
    unsafe {
        fails(cdpr_robot_named(c"carroca".as_ptr(), &mut robot), CdprStatus::Robot, "caroca");
        // A handle that could not be created is null, whatever was there.
        robot = std::ptr::dangling_mut();
        fails(cdpr_robot_named(null(), &mut robot), CdprStatus::Pointer, "name");
        assert!(robot.is_null());
        fails(cdpr_robot_named(c"caroca".as_ptr(), null_mut()), CdprStatus::Pointer, "robot");
        fails(cdpr_robot_from_json(null(), 3, &mut robot), CdprStatus::Pointer, "text");
        fails(cdpr_robot_from_json(c"{}".as_ptr(), usize::MAX, &mut robot), CdprStatus::Size, "text");
    }
}

#[test]
fn a_robot_of_a_text_is_that_of_the_library() {
    let text = include_str!("../../../data/robots/caroca.json");
    let (mut robot, known) = (null_mut(), named("caroca"));
    unsafe {
        let status = cdpr_robot_from_json(text.as_ptr().cast(), text.len(), &mut robot);
        assert_eq!(status, CdprStatus::Ok);
        assert_eq!((cdpr_robot_cables(robot), cdpr_robot_inputs(robot)), (8, 69));
        assert_eq!((cdpr_robot_cables(null()), cdpr_robot_inputs(null())), (0, 0));
        let name = |index| CStr::from_ptr(cdpr_robot_input(robot, index)).to_str().unwrap();
        assert_eq!([name(0), name(62), name(68)], ["mass", "payload", "rz"]);
        assert!(cdpr_robot_input(robot, 69).is_null() && cdpr_robot_input(null(), 0).is_null());
        assert_eq!(CStr::from_ptr(cdpr_version()).to_str(), Ok(env!("CARGO_PKG_VERSION")));
        cdpr_robot_free(robot);
        cdpr_robot_free(known);
        cdpr_robot_free(null_mut());
    }
}

#[test]
fn null_pointers_and_wrong_sizes_are_refused() {
    let (robot, pose, mut lengths) = (named("caroca"), level([0.0, 0.0, 1.75]), [4.0; 8]);
    let (mut tracker, mut path, mut at) = (null_mut(), null_mut(), pose);
    let cables = CdprCables { count: 8, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
    let few = CdprCables { count: 7, ..cables };
    let no_lengths = CdprCables { lengths: null_mut(), ..cables };
    let (pointer, size) = (CdprStatus::Pointer, CdprStatus::Size);
    unsafe {
        fails(cdpr_inverse(null(), &pose, null(), &cables, null_mut()), pointer, "robot");
        fails(cdpr_inverse(robot, null(), null(), &cables, null_mut()), pointer, "pose");
        fails(cdpr_inverse(robot, &pose, null(), null(), null_mut()), pointer, "cables");
        fails(cdpr_inverse(robot, &pose, null(), &no_lengths, null_mut()), pointer, "cables.lengths");
        fails(cdpr_inverse(robot, &pose, null(), &few, null_mut()), size, "7 values: expected 8");
        let misaligned = (&raw const pose).cast::<u8>().add(1).cast();
        fails(
            cdpr_inverse(robot, misaligned, null(), &cables, null_mut()),
            pointer,
            "pose is null or not aligned",
        );
        fails(cdpr_direct(robot, &few, null(), &mut at, null_mut()), size, "cables");
        fails(cdpr_direct(robot, &cables, null(), null_mut(), null_mut()), pointer, "pose");
        fails(cdpr_deflection(robot, &pose, null(), null_mut(), null_mut()), pointer, "motion");
        fails(cdpr_stiffness(robot, &pose, null(), null_mut(), null_mut()), pointer, "result");
        let nothing = null_mut();
        let mut slopes = CdprDerivatives {
            inputs: 68,
            lengths: nothing,
            tensions: nothing,
            displacement: nothing,
            magnitude: nothing,
        };
        fails(cdpr_derivatives(robot, &pose, null(), null(), null_mut()), pointer, "result");
        fails(cdpr_derivatives(robot, &pose, null(), &slopes, null_mut()), size, "result.inputs");
        slopes.inputs = 69;
        assert_eq!(cdpr_derivatives(robot, &pose, null(), &slopes, null_mut()), CdprStatus::Ok);
        // Without a load nothing is displaced, and the norm has no derivative.
        let mut magnitude = [0.0; 69];
        slopes.magnitude = magnitude.as_mut_ptr();
        let found = cdpr_derivatives(robot, &pose, null(), &slopes, null_mut());
        fails(found, CdprStatus::NoSolution, "no derivative");
        let start = |count, tracker| cdpr_tracker_new(robot, lengths.as_ptr(), count, null(), &pose, tracker);
        fails(start(9, &mut tracker), size, "9 values");
        fails(start(8, null_mut()), pointer, "tracker");
        fails(cdpr_tracker_step(null_mut(), lengths.as_ptr(), 8, null(), null_mut()), pointer, "tracker");
        fails(cdpr_tracker_state(null(), &mut at, null_mut(), 0), pointer, "tracker");
        fails(cdpr_path_new(robot, null_mut()), pointer, "path");
        fails(cdpr_tracker_shape(null(), 0, lengths.as_mut_ptr(), 2), pointer, "tracker");
        fails(cdpr_path_next(null_mut(), &pose, null(), null(), &cables, null_mut()), pointer, "path");
        fails(cdpr_path_limit_change(null_mut(), 1.0), pointer, "path");
        assert_eq!(cdpr_path_new(robot, &mut path), CdprStatus::Ok);
        fails(cdpr_path_next(path, &pose, null(), null(), &few, null_mut()), size, "cables");
        let not_a_number = [f64::NAN; 8];
        let near = cdpr_path_next(path, &pose, null(), not_a_number.as_ptr(), &cables, null_mut());
        fails(near, CdprStatus::Invalid, "reference[0]");
        for change in [0.0, -1.0, f64::NAN] {
            fails(cdpr_path_limit_change(path, change), CdprStatus::Invalid, "a positive tension");
        }
        assert_eq!(cdpr_path_limit_change(path, f64::INFINITY), CdprStatus::Ok);
        cdpr_path_free(path);
        cdpr_tracker_free(tracker);
        cdpr_robot_free(robot);
    }
}

#[test]
fn values_that_are_no_numbers_are_refused_and_change_nothing() {
    let (robot, mut lengths, invalid) = (named("caroca"), [4.0; 8], CdprStatus::Invalid);
    let cables = CdprCables { count: 8, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
    let pose = level([0.0, 0.0, 1.75]);
    let mut tracker = null_mut();
    unsafe {
        let at = |pose| cdpr_inverse(robot, &pose, null(), &cables, null_mut());
        fails(at(level([0.0, f64::NAN, 1.75])), invalid, "value 1 of pose.position");
        let mut turned = pose;
        turned.quaternion = [0.0; 4];
        fails(at(turned), invalid, "quaternion");
        turned.quaternion = [2.0, 0.0, 0.0, 0.0];
        fails(at(turned), invalid, "length");
        turned.quaternion[3] = f64::INFINITY;
        fails(at(turned), invalid, "value 3 of pose.quaternion");
        let under = |load: CdprLoad| cdpr_inverse(robot, &pose, &load, &cables, null_mut());
        fails(under(CdprLoad { payload: f64::NAN, ..LOAD }), invalid, "load.payload");
        fails(under(CdprLoad { force: [f64::NAN; 3], ..LOAD }), invalid, "value 0 of load.force");
        fails(under(CdprLoad { moment: [0.0, 0.0, f64::INFINITY], ..LOAD }), invalid, "load.moment");
        fails(under(CdprLoad { payload: 1e13, ..LOAD }), invalid, "load.payload");
        assert_eq!(lengths, [4.0; 8]);
        assert_eq!(at(pose), CdprStatus::Ok);
        let lengths = std::slice::from_raw_parts(cables.lengths, 8).to_vec();
        let created = cdpr_tracker_new(robot, lengths.as_ptr(), 8, null(), &pose, &mut tracker);
        assert_eq!(created, CdprStatus::Ok);
        let step = |lengths: &[f64]| cdpr_tracker_step(tracker, lengths.as_ptr(), 8, null(), null_mut());
        for value in [f64::NAN, 0.0, -1.0, f64::INFINITY] {
            let mut bad = lengths.clone();
            bad[2] = value;
            fails(step(&bad), invalid, "value 2 of lengths");
        }
        let mut state = pose;
        let mut tensions = [0.0; 8];
        fails(
            cdpr_tracker_state(tracker, &mut state, tensions.as_mut_ptr(), 7),
            CdprStatus::Size,
            "tensions",
        );
        assert_eq!(step(&lengths), CdprStatus::Ok);
        let mut points = [0.0; 6];
        let mut shape = |cable, count| cdpr_tracker_shape(tracker, cable, points.as_mut_ptr(), count);
        fails(shape(8, 2), invalid, "cable is 8: expected a cable of 0 to 7");
        fails(shape(0, 1), CdprStatus::Size, "expected 2");
        fails(shape(0, 1001), CdprStatus::Size, "expected 1000");
        cdpr_tracker_free(tracker);
        fails(at(level([0.0, 0.0, 50.0])), CdprStatus::NoSolution, "no tensions");
        cdpr_robot_free(robot);
    }
}

#[test]
fn a_robot_with_fewer_cables_than_free_motions_has_a_direct_model_and_a_tracker() {
    let (robot, mut pose, mut tensions) = (named("four-cables"), level([0.5, 0.3, 2.0]), [0.0; 4]);
    let mut lengths = [0.0; 4];
    let cables = CdprCables { count: 4, lengths: lengths.as_mut_ptr(), tensions: tensions.as_mut_ptr() };
    let (mut tracker, mut path, unsupported) = (null_mut(), null_mut(), CdprStatus::Unsupported);
    let mut of_one = null_mut();
    unsafe {
        let found = cdpr_inverse(robot, &pose, null(), &cables, null_mut());
        fails(found, unsupported, "fewer cables than free motions");
        fails(cdpr_path_new(robot, &mut path), unsupported, "fewer cables than free motions");
        assert!(path.is_null());
        // Lengths of straight cables to the pose: close to those that hold it.
        let known = crate::common::robot("four-cables");
        let at = cdpr_robot::Pose::at(0.5, 0.3, 2.0);
        let straight: Vec<f64> = (0..4).map(|i| known.span(&at, i).norm()).collect();
        cables.lengths.copy_from_nonoverlapping(straight.as_ptr(), 4);
        assert_eq!(cdpr_direct(robot, &cables, null(), &mut pose, null_mut()), CdprStatus::Ok);
        assert!(tensions.iter().all(|tension| *tension > 0.0));
        let created = cdpr_tracker_new(robot, straight.as_ptr(), 4, null(), &pose, &mut tracker);
        assert_eq!(created, CdprStatus::Ok, "{}", message());
        let shorter: Vec<f64> = straight.iter().map(|length| length - 1e-3).collect();
        let mut followed = pose;
        assert_eq!(cdpr_tracker_step(tracker, shorter.as_ptr(), 4, null(), null_mut()), CdprStatus::Ok);
        assert_eq!(cdpr_tracker_state(tracker, &mut followed, null_mut(), 0), CdprStatus::Ok);
        assert!(followed.position[2] > pose.position[2] + 1e-4);
        // A platform on one cable turns freely about it.
        let mut one = known.clone();
        one.cables.truncate(1);
        let text = one.to_json();
        let mut hung = null_mut();
        let read = cdpr_robot_from_json(text.as_ptr().cast(), text.len(), &mut hung);
        assert_eq!(read, CdprStatus::Ok, "{}", message());
        let below = level([one.cables[0].exit_point.x, one.cables[0].exit_point.y, 1.0]);
        let created = cdpr_tracker_new(hung, [2.0].as_ptr(), 1, null(), &below, &mut of_one);
        fails(created, unsupported, "a motion that nothing resists");
        assert!(of_one.is_null());
        cdpr_robot_free(hung);
        cdpr_tracker_free(tracker);
        cdpr_robot_free(robot);
    }
}

/// Values at which sums and squares overflow or vanish have a status, and no call panics.
#[test]
fn extreme_values_do_not_panic() {
    let (robot, mut lengths, mut tracker) = (named("caroca"), [4.0; 8], null_mut());
    let mut made = level([0.0, 0.0, 1.75]);
    let cables = CdprCables { count: 8, lengths: lengths.as_mut_ptr(), tensions: null_mut() };
    let mut seen = [0; 10];
    unsafe {
        assert_eq!(cdpr_inverse(robot, &made, null(), &cables, null_mut()), CdprStatus::Ok);
        let known = lengths;
        let created = cdpr_tracker_new(robot, known.as_ptr(), 8, null(), &made, &mut tracker);
        assert_eq!(created, CdprStatus::Ok);
        for value in [1e300, -1e300, 1e150, 1e12, -1e12, 1e-300, 5e-324, -0.0] {
            let (at, load) = (level([value, 0.0, 1.75]), CdprLoad { payload: value, ..LOAD });
            let (mut motion, mut stiffness) = (MaybeUninit::uninit(), MaybeUninit::uninit());
            let mut extreme = known;
            extreme[3] = value;
            made = level([0.0, 0.0, 1.75]);
            let given = CdprCables { lengths: extreme.as_mut_ptr(), ..cables };
            for status in [
                cdpr_inverse(robot, &at, null(), &cables, null_mut()),
                cdpr_inverse(robot, &made, &load, &cables, null_mut()),
                cdpr_deflection(robot, &made, &load, motion.as_mut_ptr(), null_mut()),
                cdpr_stiffness(robot, &at, &load, stiffness.as_mut_ptr(), null_mut()),
                cdpr_tracker_step(tracker, extreme.as_ptr(), 8, null(), null_mut()),
                cdpr_tracker_step(tracker, known.as_ptr(), 8, &load, null_mut()),
                cdpr_direct(robot, &given, null(), &mut made, null_mut()),
            ] {
                assert_ne!(status, CdprStatus::Panic, "{value:e}: {}", message());
                seen[status as usize] += 1;
            }
        }
        assert_eq!(cdpr_tracker_step(tracker, known.as_ptr(), 8, null(), null_mut()), CdprStatus::Ok);
        cdpr_tracker_free(tracker);
        cdpr_robot_free(robot);
    }
    println!("{seen:?}");
    assert!(seen[CdprStatus::Ok as usize] > 8 && seen[CdprStatus::Invalid as usize] > 8, "{seen:?}");
}

#[test]
fn each_thread_has_its_own_message() {
    unsafe { fails(cdpr_path_new(null(), null_mut()), CdprStatus::Pointer, "path") };
    std::thread::spawn(|| assert_eq!(message(), "")).join().unwrap();
    assert!(message().contains("path"));
}
