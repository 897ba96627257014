//! A plane through the workspace, a few rows at a time.

use crate::answers::failure::Failure;
use crate::question::Slice;
use cdpr_robot::{Pose, Robot, Vector3};
use cdpr_statics::limits::out_of_limits;
use cdpr_statics::{Deflection, WantedPose, deflection};
use cdpr_study::free_along;
use serde::Serialize;
use std::collections::BTreeMap;

/// Positions of the plane, row by row.
#[derive(Default, Serialize)]
pub(crate) struct Cells {
    /// 1 where tensions within the limits hold the platform and bear the load with the lengths kept.
    held: Vec<u8>,
    /// |dp| [mm].
    deflection_mm: Vec<Option<f64>>,
    /// Stiffness of the softest motion with the load [N/m].
    least_stiffness: Vec<Option<f64>>,
    /// Least and greatest tension at the platform, without and with the load [N].
    tension_min: Vec<Option<f64>>,
    tension_max: Vec<Option<f64>>,
    /// Number of positions that are not held, by the kind of the reason.
    reasons: BTreeMap<String, usize>,
}

/// Positions along one axis of a plane.
const MOST: usize = 1000;

pub(crate) fn slice(robot: &Robot, given: &Slice) -> Result<Cells, Failure> {
    for (field, (_, _, count)) in [("u", given.u), ("v", given.v)] {
        if !(2..=MOST).contains(&count) {
            return Err(Failure::invalid(field, format!("{count} positions"), "2 to 1000 positions"));
        }
    }
    let [first, end] = given.rows;
    if !(first <= end && end <= given.v.2) {
        return Err(Failure::invalid("rows", format!("{first} to {end}"), "rows of the plane"));
    }
    let Some(level) = Pose::with_quaternion(Vector3::zeros(), given.quaternion) else {
        let value = format!("{:?}", given.quaternion);
        return Err(Failure::invalid("quaternion", value, "one that is not zero"));
    };
    let [across, along_u, along_v] = given.normal.axes();
    if let Some((one, expected)) = free_along(&given.free, |axis| axis as usize != across) {
        return Err(Failure::invalid("free", one, &expected));
    }
    let mut cells = Cells::default();
    for row in first..end {
        for column in 0..given.u.2 {
            let mut position = Vector3::zeros();
            position[across] = given.at;
            position[along_u] = place(given.u, column);
            position[along_v] = place(given.v, row);
            cells.add(robot, &Pose { position, ..level }, given);
        }
    }
    Ok(cells)
}

/// The position `k` of an axis, whose last one is exactly its greatest.
fn place((least, greatest, count): (f64, f64, usize), k: usize) -> f64 {
    let last = (count - 1) as f64;
    least * ((last - k as f64) / last) + greatest * (k as f64 / last)
}

impl Cells {
    fn add(&mut self, robot: &Robot, pose: &Pose, given: &Slice) {
        let found = deflection(robot, WantedPose::at(pose).free(&given.free), &given.load.load());
        let mut none = |kind: &str| *self.reasons.entry(kind.to_owned()).or_default() += 1;
        let held = match &found {
            Ok(found) => {
                let Deflection { lengths, unloaded, loaded } = found;
                let states = [&unloaded.equilibrium, &loaded.equilibrium];
                let beyond = out_of_limits(robot, lengths, &states);
                let within =
                    !beyond.iter().any(|beyond| beyond.limit != cdpr_statics::limits::Limit::MaxElsewhere);
                if !within {
                    none("beyond_limits");
                }
                within
            }
            Err(error) => {
                none(error.kind());
                false
            }
        };
        let found = found.ok();
        self.held.push(u8::from(held));
        self.deflection_mm.push(found.as_ref().map(|found| 1e3 * found.magnitude()));
        self.least_stiffness.push(found.as_ref().map(|found| found.loaded.stability.least_stiffness()));
        let tensions = found.as_ref().map(|found| {
            let states = [&found.unloaded, &found.loaded];
            let tensions = states.iter().flat_map(|state| state.equilibrium.tensions());
            tensions.fold([f64::INFINITY, 0.0_f64], |[least, most], t| [least.min(t), most.max(t)])
        });
        self.tension_min.push(tensions.map(|[least, _]| least));
        self.tension_max.push(tensions.map(|[_, most]| most));
    }
}
