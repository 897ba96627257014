//! The functions of an observer.

use super::{create, empty, free, given, list, numbers, optional, own, pose_of, valid, write};
use crate::data::{CdprPose, sized};
use crate::failure::{CdprStatus, Failure, guarded};
use crate::observer::{CdprObserved, CdprObserver, CdprObserverSetting};
use crate::robot::CdprRobot;

/// Creates an observer of a robot that rests without load with these lengths near `start`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_observer_new(
    robot: *const CdprRobot,
    lengths: *const f64,
    count: usize,
    start: *const CdprPose,
    setting: *const CdprObserverSetting,
    observer: *mut *mut CdprObserver,
) -> CdprStatus {
    guarded(|| unsafe {
        let observer = empty(observer, "observer")?;
        let (robot, start, setting) = (given(robot, "robot")?, pose_of(start)?, given(setting, "setting")?);
        let lengths = list(lengths, count, robot.cables())?;
        let tension_std = numbers(setting.tension_std, setting.count, robot.cables(), "setting.tension_std")?;
        create(observer, CdprObserver::new(&robot.robot, lengths, &start, tension_std, setting))
    })
}

/// Takes a sample without load: the mean difference between tensions and model over all such samples is the
/// constant error of each sensor, which later samples subtract.
///
/// `observed` may be null. Nothing is allocated, here and in `cdpr_observer_update`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_observer_tare(
    observer: *mut CdprObserver,
    lengths: *const f64,
    tensions: *const f64,
    count: usize,
    observed: *mut CdprObserved,
) -> CdprStatus {
    guarded(|| unsafe { sample((observer, true), lengths, tensions, count, observed) })
}

/// Takes a sample: unstrained lengths and measured tensions at the platform.
///
/// Where no rest is found for the lengths within 12 iterations of the last one, the sample changes nothing.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_observer_update(
    observer: *mut CdprObserver,
    lengths: *const f64,
    tensions: *const f64,
    count: usize,
    observed: *mut CdprObserved,
) -> CdprStatus {
    guarded(|| unsafe { sample((observer, false), lengths, tensions, count, observed) })
}

/// Writes what the last samples say about each cable: 0 it is taut, 1 it reads no more than noise and its own
/// weight as the model allows, 2 it reads no more than that although the model has it taut.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_observer_cables(
    observer: *const CdprObserver,
    states: *mut u8,
    count: usize,
) -> CdprStatus {
    guarded(|| unsafe {
        let observer = given(observer, "observer")?;
        valid(states, "states")?;
        sized("states", count, observer.cables())?;
        observer.states().enumerate().for_each(|(i, state)| states.add(i).write(state));
        Ok(())
    })
}

/// Frees an observer; null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_observer_free(observer: *mut CdprObserver) {
    unsafe { free(observer) }
}

unsafe fn sample(
    (observer, tares): (*mut CdprObserver, bool),
    lengths: *const f64,
    tensions: *const f64,
    count: usize,
    observed: *mut CdprObserved,
) -> Result<(), Failure> {
    unsafe {
        let (observer, observed) = (own(observer, "observer")?, optional(observed, "observed")?);
        let lengths = list(lengths, count, observer.cables())?;
        let tensions = numbers(tensions, count, observer.cables(), "tensions")?;
        write(observed, observer.sample(lengths, tensions, tares)?);
        Ok(())
    }
}
