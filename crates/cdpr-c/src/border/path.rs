//! The functions of a path.

use super::{
    cables_of, create, empty, free, given, load_of, numbers, optional, own, pose_of, write, write_all,
};
use crate::data::{CdprCables, CdprLoad, CdprPose, CdprReport};
use crate::failure::{CdprStatus, guarded};
use crate::follow::CdprPath;
use crate::robot::CdprRobot;

/// Creates a path, whose first pose is the next one. Robots with fewer cables than free motions are refused.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_path_new(robot: *const CdprRobot, path: *mut *mut CdprPath) -> CdprStatus {
    guarded(|| unsafe {
        let path = empty(path, "path")?;
        create(path, CdprPath::new(&given(robot, "robot")?.robot))
    })
}

/// Allows no tension to change by more than `change` [N] from one pose to the next; infinity is no limit.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_path_limit_change(path: *mut CdprPath, change: f64) -> CdprStatus {
    guarded(|| unsafe { own(path, "path")?.limit_change(change) })
}

/// Writes lengths and tensions at the next pose of a path, on the branch of the last ones.
///
/// The tensions are those nearest to `reference`, one for each cable [N], such as measured ones; null stands
/// for the preferred ones of the robot. Where the branch ends, `report.jump` is 1. After a failure the path
/// continues from the last pose with a solution.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_path_next(
    path: *mut CdprPath,
    pose: *const CdprPose,
    load: *const CdprLoad,
    reference: *const f64,
    cables: *const CdprCables,
    report: *mut CdprReport,
) -> CdprStatus {
    guarded(|| unsafe {
        let (path, pose, load) = (own(path, "path")?, pose_of(pose)?, load_of(load)?);
        let (cables, report) = (cables_of(cables, path.cables())?, optional(report, "report")?);
        let reference = match reference.is_null() {
            true => None,
            false => Some(numbers(reference, path.cables(), path.cables(), "reference")?),
        };
        let found = path.next(&pose, &load, reference)?;
        write_all(cables.lengths, &found.solution.lengths);
        write_all(cables.tensions, &found.solution.tensions);
        let found_report = CdprReport::new(found.solution.residual, found.solution.iterations);
        write(report, CdprReport { jump: u32::from(found.jump), ..found_report });
        Ok(())
    })
}

/// Frees a path; null is ignored.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn cdpr_path_free(path: *mut CdprPath) {
    unsafe { free(path) }
}
