//! `cdpr derivatives`: the derivatives of lengths and deflection with respect to each parameter.

use crate::answer::decimal;
use crate::arguments::RobotAtPose;
use crate::error::ProgramError;
use crate::output::table;
use cdpr_robot::Parameter;
use cdpr_statics::{Derivatives, derivatives};
use serde::Serialize;

pub(crate) fn run(at: &RobotAtPose) -> Result<(), ProgramError> {
    let load = at.load.some_load()?;
    let robot = at.open()?;
    let found = derivatives(&robot, &at.pose, &vec![0.0; robot.cables.len()], &load)?;
    at.print(&robot, &Slopes::new(&found)?, |slopes, heading| print(heading, &found, slopes))
}

/// Derivatives with respect to each parameter; the outer lists are in the order of the parameters.
#[derive(Serialize)]
struct Slopes {
    parameters: Vec<String>,
    /// Derivative of |dp| [mm].
    rms_mm: Vec<f64>,
    /// Derivative of dp [mm].
    deflection_mm: Vec<[f64; 3]>,
    /// Derivative of the unstrained length of each cable [m].
    unstrained_lengths: Vec<Vec<f64>>,
    unit: &'static str,
}

impl Slopes {
    fn new(found: &Derivatives) -> Result<Self, ProgramError> {
        let parameters = &found.inputs.parameters;
        let count = parameters.len();
        let mut rms = found.rms()?;
        rms.truncate(count);
        Ok(Self {
            parameters: parameters.iter().map(ToString::to_string).collect(),
            rms_mm: rms.iter().map(|slope| 1e3 * slope).collect(),
            deflection_mm: found
                .displacement()
                .column_iter()
                .take(count)
                .map(|dp| (1e3 * dp).into())
                .collect(),
            unstrained_lengths: found
                .lengths
                .column_iter()
                .take(count)
                .map(|lengths| lengths.iter().copied().collect())
                .collect(),
            unit: "per SI unit of the parameter",
        })
    }
}

/// A unit of the size by which such a parameter is uncertain, and its value in SI units.
fn handy_unit(parameter: &Parameter) -> (&'static str, f64) {
    match parameter.unit() {
        "kg/m" => ("g/m", 1e-3),
        "Pa" => ("GPa", 1e9),
        "m" => ("mm", 1e-3),
        unit => (unit, 1.0),
    }
}

fn print(heading: &str, found: &Derivatives, slopes: &Slopes) {
    println!("{heading}: |dp| = {:.5} mm under the load", 1e3 * found.deflection.rms());
    let header = [
        "parameter",
        "d|dp| [\u{b5}m]",
        "per",
        "d dx [\u{b5}m]",
        "d dy [\u{b5}m]",
        "d dz [\u{b5}m]",
        "largest dL [mm]",
    ];
    let mut rows: Vec<_> = found.inputs.parameters.iter().map(handy_unit).enumerate().collect();
    rows.sort_by(|(i, (_, one)), (j, (_, other))| {
        (slopes.rms_mm[*j] * other).abs().total_cmp(&(slopes.rms_mm[*i] * one).abs())
    });
    let mut lines = table(&header);
    for (i, (unit, step)) in rows {
        let micrometres = |slope: f64| decimal(1e3 * slope * step, 5);
        let [dx, dy, dz] = slopes.deflection_mm[i].map(micrometres);
        let lengths = slopes.unstrained_lengths[i].iter();
        let largest = lengths.fold(0.0, |size: f64, slope| size.max(slope.abs()));
        lines.add_row([
            slopes.parameters[i].clone(),
            micrometres(slopes.rms_mm[i]),
            unit.to_owned(),
            dx,
            dy,
            dz,
            format!("{:.5}", 1e3 * largest * step),
        ]);
    }
    println!("{lines}");
}
