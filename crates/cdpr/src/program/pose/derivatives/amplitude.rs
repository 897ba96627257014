//! Derivatives of the amplitude of a platform that is shaken.

use crate::program::arguments::{With, number};
use crate::program::error::ProgramError;
use crate::program::output::{print_sentence, table};
use crate::program::pose::derivatives::leading::{LEADING, handy_unit};
use crate::program::pose::modes::with_inertia;
use cdpr_dynamics::{AmplitudeAt, AmplitudeDerivatives, Damping, DynamicsError};
use cdpr_robot::{Axis, Parameter, Robot, significant};
use cdpr_statics::{Derivatives, Load, StaticsError};
use serde::Serialize;
use std::borrow::Cow;

/// The amplitude that is asked for.
pub(super) fn asked(
    with: &With,
    marker: Option<[f64; 3]>,
    is_table: bool,
) -> Result<Option<AmplitudeAt>, ProgramError> {
    let hertz = |text: &str| match number(text)? {
        frequency if frequency > 0.0 => Ok(frequency),
        _ => Err("expected a frequency above 0 Hz".to_owned()),
    };
    let axis = |text: &str| Axis::from_letter(text).ok_or_else(|| "expected x, y or z".to_owned());
    let (damping, along) = (with.damping()?, with.value("along", None, axis)?);
    let Some(frequency) = with.value("amplitude", None, hertz)? else {
        if damping.is_some() || along.is_some() || marker.is_some() {
            let expected = "expected --with amplitude=HZ, too, which these settings change";
            return Err(ProgramError::Usage(format!("--marker, damping, drag, along: {expected}")));
        }
        return Ok(None);
    };
    if is_table {
        let expected = "expected --format json, as the table has no columns for it";
        return Err(ProgramError::Usage(format!("--with amplitude: {expected}")));
    }
    let (damping, marker) = (damping.unwrap_or(Damping::USUAL), marker.unwrap_or_default().into());
    Ok(Some(AmplitudeAt { frequency, damping, marker, along }))
}

/// An amplitude with the load, and its derivatives.
#[derive(Serialize)]
pub(super) struct Amplitude {
    frequency_hz: f64,
    damping_s: f64,
    drag_per_s: f64,
    /// `x`, `y` or `z`; absent in the worst direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    along: Option<&'static str>,
    inertia_assumed: bool,
    /// Missing where `without` says why.
    #[serde(skip_serializing_if = "Option::is_none")]
    amplitude_mm_per_n: Option<f64>,
    /// By each parameter, in their order [mm/N per SI unit].
    #[serde(skip_serializing_if = "Option::is_none")]
    derivatives_mm_per_n: Option<Vec<f64>>,
    /// Why the derivatives are absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    without: Option<String>,
}

impl Amplitude {
    pub(super) fn new(
        robot: &Robot,
        load: &Load,
        found: &Derivatives,
        at: &AmplitudeAt,
    ) -> Result<Self, StaticsError> {
        let robot = with_inertia(robot);
        let parameters = found.inputs.parameters.len();
        let (amplitude, derivatives, without) =
            match AmplitudeDerivatives::of_deflection(&robot, load, found, at) {
                Ok(of) => {
                    let mut derivatives = of.with_lengths(&found.lengths);
                    derivatives.truncate(parameters);
                    let derivatives = derivatives.iter().map(|slope| 1e3 * slope).collect();
                    (Some(1e3 * of.amplitude), Some(derivatives), None)
                }
                Err(DynamicsError::Statics(error @ StaticsError::NoDerivative { .. })) => {
                    (None, None, Some(error.to_string()))
                }
                Err(error) => return Err(error.into()),
            };
        Ok(Self {
            frequency_hz: at.frequency,
            damping_s: at.damping.stretch,
            drag_per_s: at.damping.drag,
            along: at.along.map(Axis::letter),
            inertia_assumed: matches!(robot, Cow::Owned(_)),
            amplitude_mm_per_n: amplitude,
            derivatives_mm_per_n: derivatives,
            without,
        })
    }

    /// The amplitude, and the parameters that change it most, each by a unit of the size of its uncertainty.
    pub(super) fn print(&self, inputs: &[Parameter]) {
        let Self { frequency_hz, damping_s, drag_per_s, along, .. } = self;
        self.without.iter().for_each(|reason| print_sentence(reason));
        let (Some(amplitude), Some(derivatives)) = (self.amplitude_mm_per_n, &self.derivatives_mm_per_n)
        else {
            return;
        };
        let [direction, motion] = along.map_or_else(
            || ["in the worst direction".to_owned(), String::new()],
            |along| [format!("along {along}"), format!(" along {along}")],
        );
        print_sentence(&format!(
            "At {frequency_hz} Hz a force {direction} shakes the point by {} mm/N{motion}; damping of the \
             cables: stretch {damping_s} s, drag {drag_per_s} 1/s.",
            significant(amplitude, 4)
        ));
        let step = |(parameter, slope): (&Parameter, &f64)| {
            let (unit, step) = handy_unit(parameter);
            (parameter.to_string(), 1e3 * slope * step, unit)
        };
        let mut rows: Vec<_> = inputs.iter().zip(derivatives).map(step).collect();
        rows.sort_by(|one, other| other.1.abs().total_cmp(&one.1.abs()));
        let mut lines = table(&["parameter", "d amplitude [\u{b5}m/N]", "per"]);
        for (name, change, unit) in rows.iter().take(LEADING) {
            lines.add_row([name, &significant(*change, 4), *unit]);
        }
        println!("{lines}");
    }
}
