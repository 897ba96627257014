//! `cdpr derivatives`: the derivatives of lengths and deflection with respect to each parameter.

use crate::answer::decimal;
use crate::error::ProgramError;
use crate::output::{Ending, table};
use crate::pose::at_pose::{RobotAtPose, Row, cells};
use cdpr_robot::{Parameter, Robot};
use cdpr_statics::{Derivatives, StaticsError, derivatives};
use serde::Serialize;

pub(crate) fn run(at: &RobotAtPose) -> Result<Ending, ProgramError> {
    let load = at.load.some_load()?;
    let solve = |robot: &Robot, pose: &_| {
        Slopes::new(&derivatives(robot, pose, &vec![0.0; robot.cables.len()], &load)?)
    };
    at.answer(solve, Slopes::print)
}

/// Derivatives with respect to each parameter; the outer lists are in the order of the parameters.
#[derive(Serialize)]
struct Slopes {
    /// |dp| under the load [mm].
    #[serde(skip)]
    deflection_rms_mm: f64,
    #[serde(skip)]
    inputs: Vec<Parameter>,
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
    fn new(found: &Derivatives) -> Result<Self, StaticsError> {
        let parameters = &found.inputs.parameters;
        let count = parameters.len();
        let mut rms = found.rms()?;
        rms.truncate(count);
        Ok(Self {
            deflection_rms_mm: 1e3 * found.deflection.rms(),
            inputs: parameters.clone(),
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

    fn print(&self, heading: &str) {
        println!("{heading}: |dp| = {:.5} mm under the load", self.deflection_rms_mm);
        let header = [
            "parameter",
            "d|dp| [\u{b5}m]",
            "per",
            "d dx [\u{b5}m]",
            "d dy [\u{b5}m]",
            "d dz [\u{b5}m]",
            "largest dL [mm]",
        ];
        let mut rows: Vec<_> = self.inputs.iter().map(handy_unit).enumerate().collect();
        rows.sort_by(|(i, (_, one)), (j, (_, other))| {
            (self.rms_mm[*j] * other).abs().total_cmp(&(self.rms_mm[*i] * one).abs())
        });
        let mut lines = table(&header);
        for (i, (unit, step)) in rows {
            let micrometres = |slope: f64| decimal(1e3 * slope * step, 5);
            let [dx, dy, dz] = self.deflection_mm[i].map(micrometres);
            let lengths = self.unstrained_lengths[i].iter();
            let largest = lengths.fold(0.0, |size: f64, slope| size.max(slope.abs()));
            lines.add_row([
                self.parameters[i].clone(),
                micrometres(self.rms_mm[i]),
                unit.to_owned(),
                dx,
                dy,
                dz,
                format!("{:.5}", 1e3 * largest * step),
            ]);
        }
        println!("{lines}");
    }
}

impl Row for Slopes {
    fn columns(robot: &Robot) -> Vec<String> {
        let parameters = Parameter::all(robot.cables.len());
        let lengths = (1..=robot.cables.len()).map(|i| format!("length_{i}_m"));
        let outputs: Vec<_> =
            ["rms_mm", "dx_mm", "dy_mm", "dz_mm"].map(str::to_owned).into_iter().chain(lengths).collect();
        let slopes = |parameter| {
            let slope = |output| format!("{output}/{parameter}");
            outputs.iter().map(slope).collect::<Vec<_>>()
        };
        parameters.iter().flat_map(slopes).collect()
    }

    fn cells(&self) -> Vec<String> {
        let rows = self.rms_mm.iter().zip(&self.deflection_mm).zip(&self.unstrained_lengths);
        cells(rows.flat_map(|((rms, dp), lengths)| [rms].into_iter().chain(dp).chain(lengths)))
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
