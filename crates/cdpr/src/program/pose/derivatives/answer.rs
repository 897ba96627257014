//! Derivatives at a pose, as JSON, as a line of a table and in words.

use super::amplitude::Amplitude;
use super::leading::{LEADING, handy_unit};
use super::uncertainty::Uncertainty;
use super::weather::InWeather;
use crate::program::answer::{OutOfLimits, bound_name, decimal};
use crate::program::output::{print_sentence, table, wide_table};
use crate::program::pose::at_pose::{Brief, Row};
use crate::program::pose::modes::swinging;
use cdpr_dynamics::{DynamicsError, FrequencyDerivatives};
use cdpr_robot::{Parameter, Robot, visible};
use cdpr_statics::derivatives::OneSided;
use cdpr_statics::{Derivatives, Load, StaticsError};
use cdpr_study::has_tolerance;
use serde::Serialize;

/// Why nothing is said of the displacement.
const NO_LOAD: &str = "the displacement and its derivatives need a load: --payload, --force or --moment";

/// Derivatives with respect to each parameter; the outer lists are in the order of the parameters.
///
/// Those of the parameters in `one_sided` are left derivatives.
#[derive(Serialize)]
pub(super) struct Slopes {
    /// |dp| under the load [mm]; none without a load.
    #[serde(skip)]
    deflection_magnitude_mm: Option<f64>,
    #[serde(skip)]
    inputs: Vec<Parameter>,
    /// Whether the text has each parameter: a point mass has no offsets of cables and of the centre of mass.
    #[serde(skip)]
    shown: Vec<bool>,
    parameters: Vec<String>,
    /// Derivative of |dp| [mm].
    #[serde(skip_serializing_if = "Option::is_none")]
    magnitude_mm: Option<Vec<f64>>,
    /// Derivative of dp [mm]; absent without a load.
    #[serde(skip_serializing_if = "Option::is_none")]
    deflection_mm: Option<Vec<[f64; 3]>>,
    /// Derivative of the unstrained length of each cable [m].
    #[serde(rename = "lengths")]
    unstrained_lengths: Vec<Vec<f64>>,
    /// Derivative of the lowest stiffness with the load [N/m].
    #[serde(rename = "least_stiffness_n_per_m", skip_serializing_if = "Option::is_none")]
    least_stiffness: Option<Vec<f64>>,
    /// Derivative of the frequency of the platform with the load [Hz].
    #[serde(skip_serializing_if = "Option::is_none")]
    frequency_hz: Option<Vec<f64>>,
    /// What has that frequency.
    #[serde(flatten)]
    swing: Option<Swing>,
    /// Why some derivatives are missing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    without: Vec<String>,
    /// Parameters whose left and right derivatives differ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    one_sided: Vec<TwoSlopes>,
    unit: &'static str,
    /// Of a platform that is shaken, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) amplitude: Option<Amplitude>,
    /// In weather, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) in_weather: Option<InWeather>,
    /// Absent without an error model.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) uncertainty: Option<Uncertainty>,
    /// Tensions of the nominal robot, without and with the load.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    out_of_limits: Vec<OutOfLimits>,
}

/// How the platform swings, the mass of cables included.
#[derive(Serialize)]
struct Swing {
    platform_frequency_hz: f64,
    /// Share of the platform in the kinetic energy of that motion.
    platform_share: f64,
    /// Distance of the nearest other frequency, relative to it: for larger changes the derivatives do not
    /// hold.
    frequency_gap: f64,
}

/// The two derivatives with respect to a parameter.
#[derive(Serialize)]
struct TwoSlopes {
    parameter: String,
    /// The cables, from 1, that leave a bound on one side.
    cables: Vec<usize>,
    /// The bound of each.
    bounds: Vec<&'static str>,
    /// As the parameter falls.
    left: Slope,
    /// As it grows.
    right: Slope,
    #[serde(skip)]
    index: usize,
}

/// The derivative with respect to one parameter.
#[derive(Clone, Serialize)]
struct Slope {
    #[serde(skip_serializing_if = "Option::is_none")]
    magnitude_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deflection_mm: Option<[f64; 3]>,
    #[serde(rename = "lengths")]
    unstrained_lengths: Vec<f64>,
    #[serde(rename = "least_stiffness_n_per_m", skip_serializing_if = "Option::is_none")]
    least_stiffness: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    frequency_hz: Option<f64>,
}

/// The derivatives with respect to each parameter, on one side, and why some do not exist.
fn slopes(
    robot: &Robot,
    load: &Load,
    found: &Derivatives,
    frequency: &Result<FrequencyDerivatives, DynamicsError>,
) -> (Vec<Slope>, Vec<String>) {
    let is_loaded = *load != Load::none();
    let magnitude = found.magnitude();
    let displacement = found.displacement();
    let frequency = frequency.as_ref().map(|of| of.with_lengths(&found.lengths)).map_err(Clone::clone);
    let stiffness = found.least_stiffness(robot, load).map(|(_, slopes)| slopes);
    let each = [magnitude, stiffness, frequency.map_err(StaticsError::from)];
    let slope = |j: usize| {
        let [magnitude, least_stiffness, frequency_hz] =
            each.each_ref().map(|slopes| slopes.as_ref().ok().map(|slopes| slopes[j]));
        Slope {
            magnitude_mm: magnitude.map(|slope| 1e3 * slope),
            deflection_mm: is_loaded.then(|| (1e3 * displacement.column(j)).into()),
            unstrained_lengths: found.lengths.column(j).iter().copied().collect(),
            least_stiffness,
            frequency_hz,
        }
    };
    let [of_magnitude, others @ ..] = each.each_ref().map(|slopes| slopes.as_ref().err());
    let of_magnitude = match is_loaded {
        true => of_magnitude.map(ToString::to_string),
        false => Some(NO_LOAD.to_owned()),
    };
    let others = others.into_iter().flatten().map(ToString::to_string);
    let slopes = (0..found.inputs.parameters.len()).map(slope).collect();
    (slopes, of_magnitude.into_iter().chain(others).collect())
}

impl Slopes {
    pub(super) fn new(robot: &Robot, load: &Load, found: &Derivatives) -> Self {
        let parameters = &found.inputs.parameters;
        let frequency = FrequencyDerivatives::of_deflection(robot, load, found);
        let (left, without) = slopes(robot, load, found, &frequency);
        let (right, _) = slopes(robot, load, &found.right(), &frequency);
        let of_parameter = found.one_sided.iter().filter(|one| one.column < parameters.len());
        let both = |OneSided { column, cables }: &OneSided| TwoSlopes {
            parameter: parameters[*column].to_string(),
            cables: cables.iter().map(|at| at.cable + 1).collect(),
            bounds: cables.iter().map(|at| bound_name(at.bound)).collect(),
            left: left[*column].clone(),
            right: right[*column].clone(),
            index: *column,
        };
        let deflection = &found.deflection;
        let equilibria = [&deflection.unloaded.equilibrium, &deflection.loaded.equilibrium];
        Self {
            swing: frequency.ok().map(|of| Swing {
                platform_frequency_hz: of.frequency,
                platform_share: of.platform_share,
                frequency_gap: of.gap,
            }),
            deflection_magnitude_mm: (*load != Load::none()).then(|| 1e3 * found.deflection.magnitude()),
            inputs: parameters.clone(),
            shown: parameters.iter().map(|parameter| has_tolerance(robot, parameter)).collect(),
            parameters: parameters.iter().map(ToString::to_string).collect(),
            magnitude_mm: left.iter().map(|slope| slope.magnitude_mm).collect(),
            deflection_mm: left.iter().map(|slope| slope.deflection_mm).collect(),
            one_sided: of_parameter.map(both).collect(),
            least_stiffness: left.iter().map(|slope| slope.least_stiffness).collect(),
            frequency_hz: left.iter().map(|slope| slope.frequency_hz).collect(),
            without,
            unstrained_lengths: left.into_iter().map(|slope| slope.unstrained_lengths).collect(),
            unit: "per SI unit of the parameter",
            amplitude: None,
            in_weather: None,
            uncertainty: None,
            out_of_limits: OutOfLimits::all(robot, &deflection.lengths, &equilibria),
        }
    }

    /// The rows of the table: a parameter's name and index, and its derivative.
    fn rows(&self) -> Vec<(String, usize, Slope)> {
        let of = |index: usize| {
            let name = self.parameters[index].clone();
            if let Some(both) = self.one_sided.iter().find(|both| both.index == index) {
                let left = (format!("{name}, left"), index, both.left.clone());
                return vec![left, (format!("{name}, right"), index, both.right.clone())];
            }
            let slope = Slope {
                magnitude_mm: self.magnitude_mm.as_ref().map(|slopes| slopes[index]),
                deflection_mm: self.deflection_mm.as_ref().map(|slopes| slopes[index]),
                unstrained_lengths: self.unstrained_lengths[index].clone(),
                least_stiffness: self.least_stiffness.as_ref().map(|slopes| slopes[index]),
                frequency_hz: self.frequency_hz.as_ref().map(|slopes| slopes[index]),
            };
            vec![(name, index, slope)]
        };
        (0..self.parameters.len()).filter(|index| self.shown[*index]).flat_map(of).collect()
    }

    /// The deflection, and the parameters that change it most, each by a unit of the size of its uncertainty;
    /// without one the parameters that change the lowest stiffness most.
    pub(super) fn print(&self, heading: &str, details: bool) {
        match (&self.uncertainty, self.deflection_magnitude_mm) {
            (Some(uncertainty), Some(dp)) => uncertainty.print(heading, dp),
            (_, Some(dp)) => {
                print_sentence(&format!("{heading}: |dp| = {} mm under the load.", visible(dp, 5)));
            }
            (_, None) => print_sentence(&format!(
                "{heading}: derivatives of the lengths and of the motions, without a load."
            )),
        }
        self.print_table(details);
        for TwoSlopes { parameter, cables, bounds, .. } in &self.one_sided {
            let at =
                |(cable, bound): (&usize, &&str)| format!("cable {cable} leaves its {bound}imum tension");
            let cables: Vec<_> = cables.iter().zip(bounds).map(at).collect();
            print_sentence(&format!("{parameter}: {} on one side only", cables.join(", ")));
        }
        self.without.iter().for_each(|reason| print_sentence(reason));
        if let Some(Swing { platform_frequency_hz, platform_share, frequency_gap }) = &self.swing {
            print_sentence(&format!(
                "{}; the nearest other frequency is {} % away.",
                swinging(*platform_frequency_hz, *platform_share),
                decimal(100.0 * frequency_gap, 2)
            ));
        }
        self.amplitude.iter().for_each(|of| of.print(&self.inputs));
        self.in_weather.iter().for_each(|of| of.print(&self.inputs));
        OutOfLimits::print(&self.out_of_limits);
    }

    /// The parameters that change the first column most, or all of them with all derivatives.
    fn print_table(&self, details: bool) {
        let mut rows = self.rows();
        let is_there = |column: &&Column| rows.iter().any(|(_, _, slope)| (column.of)(slope).is_some());
        let wanted = match (details, self.magnitude_mm.is_some()) {
            (true, _) => &COLUMNS[..],
            (false, true) => &COLUMNS[..1],
            (false, false) => &COLUMNS[OF_DISPLACEMENT..],
        };
        let columns: Vec<&Column> = wanted.iter().filter(is_there).collect();
        let Some((first, others)) = columns.split_first() else { return };
        let size = |(_, index, slope): &(String, usize, Slope)| {
            (first.of)(slope).map_or(0.0, |slope| (slope * handy_unit(&self.inputs[*index]).1).abs())
        };
        rows.sort_by(|one, other| size(other).total_cmp(&size(one)));
        let others_names = others.iter().map(|column| column.name);
        let header: Vec<&str> = ["parameter", first.name, "per"].into_iter().chain(others_names).collect();
        let mut lines = if details { wide_table(&header) } else { table(&header) };
        let count = if details { rows.len() } else { LEADING };
        for (name, index, slope) in rows.iter().take(count) {
            let (unit, step) = handy_unit(&self.inputs[*index]);
            let cell = |column: &&Column| {
                (column.of)(slope).map_or_else(String::new, |slope| decimal(slope * step, column.decimals))
            };
            let row = [name.clone(), cell(first), unit.to_owned()];
            lines.add_row(row.into_iter().chain(others.iter().map(cell)));
        }
        println!("{lines}");
        if let Some(more) = rows.len().checked_sub(count).filter(|more| *more > 0) {
            println!("{more} more, and other derivatives: with --details");
        }
    }
}

/// A column of derivatives, in a unit for people.
struct Column {
    name: &'static str,
    decimals: usize,
    of: fn(&Slope) -> Option<f64>,
}

/// Columns that need a load.
const OF_DISPLACEMENT: usize = 4;

/// All columns. Without a displacement the first that exists orders the rows.
const COLUMNS: [Column; OF_DISPLACEMENT + 3] = [
    Column { name: "d|dp| [\u{b5}m]", decimals: 5, of: |slope| Some(1e3 * slope.magnitude_mm?) },
    Column { name: "d dx [\u{b5}m]", decimals: 5, of: |slope| Some(1e3 * slope.deflection_mm?[0]) },
    Column { name: "d dy [\u{b5}m]", decimals: 5, of: |slope| Some(1e3 * slope.deflection_mm?[1]) },
    Column { name: "d dz [\u{b5}m]", decimals: 5, of: |slope| Some(1e3 * slope.deflection_mm?[2]) },
    Column { name: "d stiffness [N/m]", decimals: 4, of: |slope| slope.least_stiffness },
    Column { name: "d frequency [mHz]", decimals: 4, of: |slope| Some(1e3 * slope.frequency_hz?) },
    Column {
        name: "largest dL [mm]",
        decimals: 5,
        of: |slope| {
            Some(slope.unstrained_lengths.iter().fold(0.0, |most, of| f64::max(most, 1e3 * of.abs())))
        },
    },
];

impl Row for Slopes {
    fn columns(robot: &Robot) -> Vec<String> {
        let parameters = Parameter::of(robot);
        let lengths = (1..=robot.cables.len()).map(|i| format!("length_{i}_m"));
        let displacement = ["magnitude_mm", "dx_mm", "dy_mm", "dz_mm"].map(str::to_owned);
        let softest = ["least_stiffness_n_per_m", "frequency_hz"].map(str::to_owned);
        let outputs: Vec<_> = displacement.into_iter().chain(lengths).chain(softest).collect();
        let slopes = |parameter| {
            let slope = |output| format!("{output}/{parameter}");
            outputs.iter().map(slope).collect::<Vec<_>>()
        };
        parameters
            .iter()
            .flat_map(slopes)
            .chain(
                ["one_sided", "platform_frequency_hz", "platform_share", "frequency_gap"].map(str::to_owned),
            )
            .collect()
    }

    fn cells(&self) -> Vec<String> {
        let cell = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:?}"));
        let at = |slopes: &Option<Vec<f64>>, index: usize| slopes.as_ref().map(|slopes| slopes[index]);
        let of = |index: usize| {
            let displaced = self.deflection_mm.as_ref().map(|slopes| slopes[index]);
            let displaced = (0..3).map(move |axis| displaced.map(|slope| slope[axis]));
            let lengths = self.unstrained_lengths[index].iter().copied().map(Some);
            let softest = [at(&self.least_stiffness, index), at(&self.frequency_hz, index)];
            let all =
                [at(&self.magnitude_mm, index)].into_iter().chain(displaced).chain(lengths).chain(softest);
            all.map(cell).collect::<Vec<_>>()
        };
        let slopes = (0..self.parameters.len()).flat_map(of);
        let one_sided: Vec<_> = self.one_sided.iter().map(|both| both.parameter.as_str()).collect();
        let swing = self.swing.as_ref();
        let swing = swing.map(|of| [of.platform_frequency_hz, of.platform_share, of.frequency_gap]);
        let swing = (0..3).map(|k| cell(swing.map(|all| all[k])));
        slopes.chain([one_sided.join(" ")]).chain(swing).collect()
    }

    fn brief(&self) -> Vec<Brief> {
        let swing = self.swing.as_ref().map(|of| of.platform_frequency_hz);
        vec![Brief::Shown("platform swings at", "Hz", swing)]
    }

    fn out_of_limits(&self) -> Vec<&[OutOfLimits]> {
        vec![&self.out_of_limits]
    }
}
