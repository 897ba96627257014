//! Natural motions of the platform on cables without mass.

use crate::program::answer::{self, OutOfLimits, decimal};
use crate::program::output::{print_sentence, table};
use crate::program::pose::at_pose::{Brief, Row, cells, numbered};
use cdpr_robot::Robot;
use cdpr_statics::vibration::PoseModes;
use serde::Serialize;

/// The natural motions.
#[derive(Serialize)]
pub(crate) struct Massless {
    /// Natural frequencies, ascending [Hz].
    frequencies_hz: Vec<f64>,
    /// The motion of each frequency.
    modes: Vec<Mode>,
    /// The lowest of each cable between ends at rest [Hz]; `null` for one without mass.
    cable_frequencies_hz: Vec<Option<f64>>,
    /// The lowest of these [Hz].
    lowest_cable_frequency_hz: Option<f64>,
    /// What follows where that is less than twice the lowest of the platform.
    #[serde(skip_serializing_if = "Option::is_none")]
    warning: Option<String>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// A natural motion of unit mass.
#[derive(Serialize)]
struct Mode {
    /// Translation of P [1/√kg].
    translation: [f64; 3],
    /// Rotation vector [rad/(m √kg)].
    rotation: [f64; 3],
    /// Share of each cable in the energy of the motion.
    cable_shares: Vec<f64>,
    /// Share of the weight.
    weight_share: f64,
}

impl Row for Massless {
    fn columns(robot: &Robot) -> Vec<String> {
        let platform = numbered("frequency", "hz", robot.freedoms().count());
        platform.chain(["lowest_cable_frequency_hz".to_owned()]).collect()
    }

    fn cells(&self) -> Vec<String> {
        let lowest = self.lowest_cable_frequency_hz.map(|frequency| format!("{frequency:?}"));
        cells(&self.frequencies_hz).into_iter().chain([lowest.unwrap_or_default()]).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        vec![Brief::Least("lowest", "Hz", self.frequencies_hz.first().copied())]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }

    fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }
}

impl Massless {
    pub(crate) fn new(robot: &Robot, found: &PoseModes) -> Self {
        let PoseModes { modes, lengths, equilibrium, cable_frequencies } = found;
        let (slowest, platform) = found.lowest();
        Self {
            cable_frequencies_hz: cable_frequencies.clone(),
            lowest_cable_frequency_hz: slowest.map(|cable| cable.frequency),
            warning: slowest.zip(platform).and_then(|(cable, platform)| cable.warning(platform)),
            out_of_limits: OutOfLimits::all(robot, lengths, &[equilibrium]),
            frequencies_hz: modes.iter().map(|mode| mode.frequency).collect(),
            modes: modes
                .iter()
                .map(|mode| Mode {
                    translation: mode.translation.into(),
                    rotation: mode.rotation.into(),
                    cable_shares: mode.cables.clone(),
                    weight_share: mode.weight,
                })
                .collect(),
        }
    }

    pub(crate) fn print(&self, heading: &str) {
        let lowest = self.frequencies_hz.iter().copied().min_by(f64::total_cmp).unwrap_or_default();
        print_sentence(&format!(
            "{heading}: lowest natural frequency {lowest:.4} Hz, of the platform on cables without mass."
        ));
        let names = [
            "frequency [Hz]",
            "translation [1/\u{221a}kg]",
            "rotation [rad/(m \u{221a}kg)]",
            "weight [%]",
            "cables [%]",
        ];
        let mut rows = table(&names);
        for (frequency, mode) in self.frequencies_hz.iter().zip(&self.modes) {
            let words = |vector: &[f64; 3]| answer::vector(vector, 4);
            let percent = |share: &f64| decimal(100.0 * share, 1);
            let cables: Vec<_> = mode.cable_shares.iter().map(percent).collect();
            let (translation, rotation) = (words(&mode.translation), words(&mode.rotation));
            let weight = percent(&mode.weight_share);
            rows.add_row([format!("{frequency:.4}"), translation, rotation, weight, cables.join(" ")]);
        }
        println!("{rows}");
        println!("motions of unit mass; weight and cables: share of each in the energy of the motion");
        let of_cable = |frequency: &Option<f64>| frequency.map_or("-".to_owned(), |f| format!("{f:.3}"));
        let cables: Vec<_> = self.cable_frequencies_hz.iter().map(of_cable).collect();
        println!("lowest of each cable itself, between ends at rest: {} Hz", cables.join(" "));
        self.warning.iter().for_each(|warning| println!("warning: {warning}"));
        OutOfLimits::print(&self.out_of_limits);
    }
}
