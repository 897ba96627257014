//! The functions of `include/cdpr.h`: pointers become references and values here, and nowhere else.
//! # Safety
//!
//! A function checks every pointer for null and alignment, every number of values, and every value for NaN.
//! It cannot check that a pointer leads to as much memory as its type or the number says, that a handle is
//! one of this library and not freed, and that no other thread changes what it reads: the caller is
//! responsible for these. Inputs and results may share their memory, because results are written last.

#![allow(unsafe_code, clippy::missing_safety_doc)]

pub mod observer;
pub mod path;

use crate::data::{
    CdprCables, CdprDerivatives, CdprLoad, CdprMotion, CdprPose, CdprReport, CdprStiffness, LENGTHS, checked,
    sized,
};
use crate::failure::{CdprStatus, Failure, guarded, message};
use crate::follow::CdprTracker;
use crate::pose::{displacement, report, rows, stiffness};
use crate::robot::CdprRobot;
use cdpr_robot::Pose;
use cdpr_statics::{DirectStart, Load, deflection, derivatives, direct, inverse};
use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::ptr::{null, null_mut};

/// The version of the library.
#[unsafe(no_mangle)]
pub extern "C" fn cdpr_version() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// The message of the last call of this thread that did not return CDPR_STATUS_OK; it is empty before the
/// first one. It is valid until the next such call of this thread.
#[unsafe(no_mangle)]
pub extern "C" fn cdpr_message() -> *const c_char {
    message()
}

/// Creates the robot of the library with this name, such as "caroca".
///
/// Where a function that creates a handle fails, the handle is null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_named(name: *const c_char, robot: *mut *mut CdprRobot) -> CdprStatus {
    guarded(|| unsafe {
        let robot = empty(robot, "robot")?;
        valid(name, "name")?;
        create(robot, CdprRobot::named(CStr::from_ptr(name)))
    })
}

/// Creates the robot of a file cdpr-robot/1, whose text has `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_from_json(
    text: *const c_char,
    size: usize,
    robot: *mut *mut CdprRobot,
) -> CdprStatus {
    guarded(|| unsafe {
        let robot = empty(robot, "robot")?;
        valid(text, "text")?;
        if isize::try_from(size).is_err() {
            return Err(Failure::Size { field: "text", given: size, expected: isize::MAX.unsigned_abs() });
        }
        create(robot, CdprRobot::from_json(std::slice::from_raw_parts(text.cast(), size)))
    })
}

/// Frees a robot; null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_free(robot: *mut CdprRobot) {
    unsafe { free(robot) }
}

/// The number of cables; 0 for null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_cables(robot: *const CdprRobot) -> usize {
    unsafe { given(robot, "robot") }.map_or(0, CdprRobot::cables)
}

/// The number of inputs by which derivatives are taken: the parameters, the payload and the six coordinates
/// of the pose; 0 for null.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_inputs(robot: *const CdprRobot) -> usize {
    unsafe { given(robot, "robot") }.map_or(0, |robot| robot.inputs().len())
}

/// The name of an input, from 0, such as "mass" or "b1.z"; null beyond the last one. It is valid until the
/// robot is freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_robot_input(robot: *const CdprRobot, index: usize) -> *const c_char {
    let name = unsafe { given(robot, "robot") }.map(|robot| robot.inputs().get(index));
    name.ok().flatten().map_or(null(), |name| name.as_ptr())
}

/// Writes the unstrained lengths and the tensions that hold a pose under the platform's weight and `load`.
///
/// `load` may be null for none, and `report` where it is not wanted, here and below.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_inverse(
    robot: *const CdprRobot,
    pose: *const CdprPose,
    load: *const CdprLoad,
    cables: *const CdprCables,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (robot, pose, load) = (given(robot, "robot")?, pose_of(pose)?, load_of(load)?);
        let (cables, report) = (cables_of(cables, robot.cables())?, optional(report, "report")?);
        let found = inverse(&robot.robot, &pose, &load)?;
        write_all(cables.lengths, &found.lengths);
        write_all(cables.tensions, &found.tensions);
        write(report, CdprReport::new(found.residual, found.iterations));
        Ok(())
    })
}

/// Writes the pose and the tensions of the equilibrium for `cables.lengths` near `pose`, or to which the
/// platform descends from it: the result overwrites `pose`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_direct(
    robot: *const CdprRobot,
    cables: *const CdprCables,
    load: *const CdprLoad,
    pose: *mut CdprPose,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (robot, start, load) = (given(robot, "robot")?, pose_of(pose)?, load_of(load)?);
        let (cables, place) = (cables_of(cables, robot.cables())?, optional(report, "report")?);
        let lengths = list(cables.lengths, cables.count, robot.cables())?;
        let found = direct(&robot.robot, lengths, &load, DirectStart::Pose(&start))?;
        write_all(cables.tensions, &found.equilibrium.tensions());
        write(pose, CdprPose::from(&found.equilibrium.pose));
        write(place, self::report(&found));
        Ok(())
    })
}

/// Writes the motion of the platform under `load`, with the lengths that hold `pose` without it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_deflection(
    robot: *const CdprRobot,
    pose: *const CdprPose,
    load: *const CdprLoad,
    motion: *mut CdprMotion,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (robot, pose, load) = (given(robot, "robot")?, pose_of(pose)?, load_of(load)?);
        let (motion, place) = (self::place(motion, "motion")?, optional(report, "report")?);
        let found = deflection(&robot.robot, &pose, &load)?;
        write(motion, found.motion().into());
        write(place, self::report(&found.loaded));
        Ok(())
    })
}

/// Writes the stiffness at a pose that the inverse model holds under the platform's weight and `load`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_stiffness(
    robot: *const CdprRobot,
    pose: *const CdprPose,
    load: *const CdprLoad,
    result: *mut CdprStiffness,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (robot, pose, load) = (given(robot, "robot")?, pose_of(pose)?, load_of(load)?);
        let (result, report) = (place(result, "result")?, optional(report, "report")?);
        let (found, found_report) = stiffness(&robot.robot, &pose, &load)?;
        write(result, found);
        write(report, found_report);
        Ok(())
    })
}

/// Writes the derivatives of lengths, tensions and deflection by all inputs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_derivatives(
    robot: *const CdprRobot,
    pose: *const CdprPose,
    load: *const CdprLoad,
    result: *const CdprDerivatives,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (robot, pose, load) = (given(robot, "robot")?, pose_of(pose)?, load_of(load)?);
        let (result, report) = (*given(result, "result")?, optional(report, "report")?);
        sized("result.inputs", result.inputs, robot.inputs().len())?;
        let lists = [result.lengths, result.tensions, result.displacement, result.magnitude];
        for list in lists {
            optional(list, "a matrix of result")?;
        }
        let found = derivatives(&robot.robot, &pose, &load)?;
        let magnitude = if result.magnitude.is_null() { Vec::new() } else { found.magnitude()? };
        let values = [rows(&found.lengths), rows(&found.set_points), displacement(&found), magnitude];
        for (list, values) in lists.into_iter().zip(&values) {
            write_all(list, values);
        }
        write(report, self::report(&found.deflection.loaded));
        Ok(())
    })
}

/// Creates a tracker at the equilibrium for these lengths and this load near `start`, or to which the platform
/// descends from it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_tracker_new(
    robot: *const CdprRobot,
    lengths: *const f64,
    count: usize,
    load: *const CdprLoad,
    start: *const CdprPose,
    tracker: *mut *mut CdprTracker,
) -> CdprStatus {
    guarded(|| unsafe {
        let tracker = empty(tracker, "tracker")?;
        let (robot, start, load) = (given(robot, "robot")?, pose_of(start)?, load_of(load)?);
        let lengths = list(lengths, count, robot.cables())?;
        create(tracker, CdprTracker::new(&robot.robot, lengths, &load, &start))
    })
}

/// Goes to the equilibrium for other lengths and another load, in at most 12 iterations.
///
/// Nothing is allocated for up to 16 cables (4 on x86-64 without AVX2). Where the iterations do not converge,
/// the last state is kept, and `report` has its residuals with the number of iterations made.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_tracker_step(
    tracker: *mut CdprTracker,
    lengths: *const f64,
    count: usize,
    load: *const CdprLoad,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (tracker, load, report) = (own(tracker, "tracker")?, load_of(load)?, optional(report, "report")?);
        let lengths = list(lengths, count, tracker.cables())?;
        let (found, outcome) = tracker.step(lengths, &load)?;
        write(report, found);
        outcome
    })
}

/// Writes the pose of the tracker and, where `tensions` is not null, the tensions at the platform.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_tracker_state(
    tracker: *const CdprTracker,
    pose: *mut CdprPose,
    tensions: *mut f64,
    count: usize,
) -> CdprStatus {
    guarded(|| unsafe {
        let (tracker, pose) = (given(tracker, "tracker")?, place(pose, "pose")?);
        let tensions = optional(tensions, "tensions")?;
        if !tensions.is_null() {
            sized("tensions", count, tracker.cables())?;
            for (i, tension) in tracker.tensions().enumerate() {
                tensions.add(i).write(tension);
            }
        }
        write(pose, CdprPose::from(tracker.pose()));
        Ok(())
    })
}

/// Writes points of a cable, from 0, in the state of the tracker: x, y, z of each in the base frame [m], at
/// equal distances along the cable from its exit point, or where it leaves its pulley, to its anchor point.
///
/// `points` has room for 3 `count` values; `count` is 2 to 1000. Memory is allocated.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_tracker_shape(
    tracker: *const CdprTracker,
    cable: usize,
    points: *mut f64,
    count: usize,
) -> CdprStatus {
    guarded(|| unsafe {
        let (tracker, points) = (given(tracker, "tracker")?, place(points, "points")?);
        if !(2..=1000).contains(&count) {
            return Err(Failure::Size { field: "points", given: count, expected: count.clamp(2, 1000) });
        }
        for (k, point) in tracker.shape(cable, count)?.iter().enumerate() {
            write_all(points.add(3 * k), point.as_slice());
        }
        Ok(())
    })
}

/// Frees a tracker; null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_tracker_free(tracker: *mut CdprTracker) {
    unsafe { free(tracker) }
}

fn valid<T>(pointer: *const T, field: &'static str) -> Result<(), Failure> {
    if pointer.is_null() || !pointer.is_aligned() { Err(Failure::Pointer(field)) } else { Ok(()) }
}

/// What a pointer leads to.
unsafe fn given<'a, T>(pointer: *const T, field: &'static str) -> Result<&'a T, Failure> {
    valid(pointer, field)?;
    Ok(unsafe { &*pointer })
}

/// A handle that changes.
unsafe fn own<'a, T>(pointer: *mut T, field: &'static str) -> Result<&'a mut T, Failure> {
    valid(pointer, field)?;
    Ok(unsafe { &mut *pointer })
}

/// A pointer to where a result is written.
fn place<T>(pointer: *mut T, field: &'static str) -> Result<*mut T, Failure> {
    valid(pointer, field)?;
    Ok(pointer)
}

/// A pointer to where a result is written, null where it is not wanted.
fn optional<T>(pointer: *mut T, field: &'static str) -> Result<*mut T, Failure> {
    if pointer.is_null() { Ok(pointer) } else { place(pointer, field) }
}

unsafe fn pose_of(pose: *const CdprPose) -> Result<Pose, Failure> {
    unsafe { given(pose, "pose") }?.checked()
}

unsafe fn load_of(load: *const CdprLoad) -> Result<Load, Failure> {
    if load.is_null() { Ok(Load::none()) } else { unsafe { given(load, "load") }?.checked() }
}

/// Lists of a value for each cable.
unsafe fn cables_of(cables: *const CdprCables, count: usize) -> Result<CdprCables, Failure> {
    let cables = *unsafe { given(cables, "cables") }?;
    sized("cables", cables.count, count)?;
    place(cables.lengths, "cables.lengths")?;
    optional(cables.tensions, "cables.tensions")?;
    Ok(cables)
}

/// Lengths, one for each cable.
unsafe fn list<'a>(lengths: *const f64, given: usize, cables: usize) -> Result<&'a [f64], Failure> {
    valid(lengths, "lengths")?;
    sized("lengths", given, cables)?;
    let lengths = unsafe { std::slice::from_raw_parts(lengths, given) };
    checked("lengths", lengths, LENGTHS)?;
    Ok(lengths)
}

/// Numbers of any kind, one for each cable.
unsafe fn numbers<'a>(
    numbers: *const f64,
    count: usize,
    cables: usize,
    field: &'static str,
) -> Result<&'a [f64], Failure> {
    valid(numbers, field)?;
    sized(field, count, cables)?;
    Ok(unsafe { std::slice::from_raw_parts(numbers, count) })
}

/// Writes a result, unless the pointer is null.
unsafe fn write<T>(to: *mut T, value: T) {
    if !to.is_null() {
        unsafe { to.write(value) };
    }
}

/// Writes a list, unless the pointer is null.
unsafe fn write_all(to: *mut f64, values: &[f64]) {
    if !to.is_null() {
        unsafe { to.copy_from_nonoverlapping(values.as_ptr(), values.len()) };
    }
}

/// Where a handle is written, which is null until then.
unsafe fn empty<T>(to: *mut *mut T, field: &'static str) -> Result<*mut *mut T, Failure> {
    valid(to, field)?;
    unsafe { to.write(null_mut()) };
    Ok(to)
}

/// Writes a new handle.
unsafe fn create<T>(to: *mut *mut T, handle: Result<T, Failure>) -> Result<(), Failure> {
    let handle = Box::into_raw(Box::new(handle?));
    unsafe { to.write(handle) };
    Ok(())
}

unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        let dropped = || drop(unsafe { Box::from_raw(handle) });
        let _ = catch_unwind(AssertUnwindSafe(dropped));
    }
}
