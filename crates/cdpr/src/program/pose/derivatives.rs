//! `cdpr derivatives`: the derivatives of lengths and deflection with respect to each parameter.

mod amplitude;
mod leading;
mod uncertainty;
mod weather;

use crate::program::answer::{OutOfLimits, bound_name, decimal};
use crate::program::arguments::{self, Format, UncertaintyArgument, WEATHER, WindArgument, With, with};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, print_sentence, table, wide_table};
use crate::program::pose::at_pose::{Brief, RobotAtFreePose, Row, cells};
use crate::program::pose::derivatives::amplitude::Amplitude;
use crate::program::pose::derivatives::leading::{LEADING, handy_unit};
use crate::program::pose::derivatives::uncertainty::Uncertainty;
use crate::program::pose::derivatives::weather::InWeather;
use crate::program::pose::modes::swinging;
use cdpr_dynamics::{DynamicsError, FrequencyDerivatives};
use cdpr_robot::{Parameter, Robot, visible};
use cdpr_statics::derivatives::OneSided;
use cdpr_statics::{Derivatives, Load, Observer, StaticsError, WantedPose, derivatives};
use cdpr_study::{explained_deflection, has_tolerance};
use serde::Serialize;

/// The robot, its poses, and what is uncertain.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    at: RobotAtFreePose,
    #[command(flatten)]
    errors: UncertaintyArgument,
    /// amplitude=HZ: derivatives of the amplitude of a platform that is shaken; damping, drag, along. ice=
    /// and others, with --wind or without: derivatives of the displacement in that weather.
    ///
    /// warmer=KELVIN with cable_expansion=, frame_expansion=, ice=METRES, creep=STRAIN, wind_profile=Z0:ZREF:
    /// as those of `deflection`. Of the point --marker with the load, per newton of a force there, in the
    /// worst direction or along=x, y or z. damping=TAU and drag=RATE damp the cables, as those of `response`
    /// (2e-4 s, none).
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    #[command(flatten)]
    wind: WindArgument,
    /// Point of the platform that is shaken: x,y,z in its frame [m]; P if left out.
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    marker: Option<[f64; 3]>,
    #[command(flatten)]
    details: Details,
}

pub(crate) fn run(
    Settings { at: RobotAtFreePose { at, free }, errors, with, wind, marker, details }: &Settings,
) -> Result<Ending, ProgramError> {
    let with =
        With::known(with.as_ref(), &[&["amplitude", "damping", "drag", "along"], &WEATHER[..]].concat())?;
    let weather = wind.weather(&with)?;
    let load = at.load.some_load()?;
    let is_table = match at.printing.format() {
        Format::Csv => true,
        Format::Text => at.pose()?.is_none(),
        Format::Json => false,
    };
    let shaken = amplitude::asked(&with, *marker, is_table)?;
    if weather.is_some() && is_table {
        let expected = "expected --format json, as the table has no columns for weather";
        return Err(ProgramError::Usage(format!("--wind, --with: {expected}")));
    }
    let robot = at.robot()?;
    let model = errors.model(&robot)?;
    model.as_ref().map(|model| model.check(&robot)).transpose()?;
    let solve = |robot: &Robot, pose: &_| {
        let found = derivatives(robot, WantedPose::at(pose).free(&free.free), &load)?;
        let mut slopes = Slopes::new(robot, &load, &found)?;
        slopes.amplitude = shaken.map(|at| Amplitude::new(robot, &load, &found, &at)).transpose()?;
        slopes.in_weather = weather
            .map(|weather| InWeather::new(robot, WantedPose::at(pose).free(&free.free), &load, &weather))
            .transpose()?;
        slopes.uncertainty = model.as_ref().map(|model| Uncertainty::new(model, &found)).transpose()?;
        // With free coordinates the scalar models search for each robot, which takes too long.
        if let (Some(uncertainty), Some(model), []) = (&mut slopes.uncertainty, &model, &free.free[..]) {
            let observer = Observer::new(robot, WantedPose::at(pose), &load)?;
            uncertainty.explained = explained_deflection(&observer, model, &found);
        }
        Ok(slopes)
    };
    at.answer(solve, |slopes, heading| slopes.print(heading, details.details))
}

/// Derivatives with respect to each parameter; the outer lists are in the order of the parameters.
///
/// Those of the parameters in `one_sided` are left derivatives.
#[derive(Serialize)]
struct Slopes {
    /// |dp| under the load [mm].
    #[serde(skip)]
    deflection_magnitude_mm: f64,
    #[serde(skip)]
    inputs: Vec<Parameter>,
    /// Whether the text has each parameter: a point mass has no offsets of cables and of the centre of mass.
    #[serde(skip)]
    shown: Vec<bool>,
    parameters: Vec<String>,
    /// Derivative of |dp| [mm].
    magnitude_mm: Vec<f64>,
    /// Derivative of dp [mm].
    deflection_mm: Vec<[f64; 3]>,
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
    /// Why one of the two derivatives is missing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    without: Vec<String>,
    /// Parameters whose left and right derivatives differ.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    one_sided: Vec<TwoSlopes>,
    unit: &'static str,
    /// Of a platform that is shaken, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    amplitude: Option<Amplitude>,
    /// In weather, if asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    in_weather: Option<InWeather>,
    /// Absent without an error model.
    #[serde(skip_serializing_if = "Option::is_none")]
    uncertainty: Option<Uncertainty>,
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
    magnitude_mm: f64,
    deflection_mm: [f64; 3],
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
) -> Result<(Vec<Slope>, Vec<String>), StaticsError> {
    let each = found.magnitude()?.into_iter().enumerate().take(found.inputs.parameters.len());
    let displacement = found.displacement();
    let frequency = frequency.as_ref().map(|of| of.with_lengths(&found.lengths)).map_err(Clone::clone);
    let stiffness = found.least_stiffness(robot, load).map(|(_, slopes)| slopes);
    let softest = [stiffness, frequency.map_err(StaticsError::from)];
    let slope = |(j, magnitude): (usize, f64)| {
        let [least_stiffness, frequency_hz] =
            softest.each_ref().map(|slopes| slopes.as_ref().ok().map(|slopes| slopes[j]));
        Slope {
            magnitude_mm: 1e3 * magnitude,
            deflection_mm: (1e3 * displacement.column(j)).into(),
            unstrained_lengths: found.lengths.column(j).iter().copied().collect(),
            least_stiffness,
            frequency_hz,
        }
    };
    let without = softest.iter().filter_map(|slopes| slopes.as_ref().err()).map(ToString::to_string);
    Ok((each.map(slope).collect(), without.collect()))
}

impl Slopes {
    fn new(robot: &Robot, load: &Load, found: &Derivatives) -> Result<Self, StaticsError> {
        let parameters = &found.inputs.parameters;
        let frequency = FrequencyDerivatives::of_deflection(robot, load, found);
        let (left, without) = slopes(robot, load, found, &frequency)?;
        let (right, _) = slopes(robot, load, &found.right(), &frequency)?;
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
        Ok(Self {
            swing: frequency.ok().map(|of| Swing {
                platform_frequency_hz: of.frequency,
                platform_share: of.platform_share,
                frequency_gap: of.gap,
            }),
            deflection_magnitude_mm: 1e3 * found.deflection.magnitude(),
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
        })
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
                magnitude_mm: self.magnitude_mm[index],
                deflection_mm: self.deflection_mm[index],
                unstrained_lengths: self.unstrained_lengths[index].clone(),
                least_stiffness: self.least_stiffness.as_ref().map(|slopes| slopes[index]),
                frequency_hz: self.frequency_hz.as_ref().map(|slopes| slopes[index]),
            };
            vec![(name, index, slope)]
        };
        (0..self.parameters.len()).filter(|index| self.shown[*index]).flat_map(of).collect()
    }

    /// The deflection, and the parameters that change it most, each by a unit of the size of its uncertainty.
    fn print(&self, heading: &str, details: bool) {
        let dp = self.deflection_magnitude_mm;
        match &self.uncertainty {
            Some(uncertainty) => uncertainty.print(heading, dp),
            None => print_sentence(&format!("{heading}: |dp| = {} mm under the load.", visible(dp, 5))),
        }
        let mut rows = self.rows();
        let size = |(_, index, slope): &(String, usize, Slope)| {
            (slope.magnitude_mm * handy_unit(&self.inputs[*index]).1).abs()
        };
        rows.sort_by(|one, other| size(other).total_cmp(&size(one)));
        if details {
            self.print_all(&rows);
        } else {
            let mut lines = table(&["parameter", "d|dp| [\u{b5}m]", "per"]);
            for (name, index, slope) in rows.iter().take(LEADING) {
                let (unit, step) = handy_unit(&self.inputs[*index]);
                lines.add_row([name, &micrometres(slope.magnitude_mm * step), unit]);
            }
            println!("{lines}");
            if let Some(more) = rows.len().checked_sub(LEADING).filter(|more| *more > 0) {
                println!("{more} more, and other derivatives: with --details");
            }
        }
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

    /// All derivatives of all parameters.
    fn print_all(&self, rows: &[(String, usize, Slope)]) {
        let mut header = vec![
            "parameter",
            "d|dp| [\u{b5}m]",
            "per",
            "d dx [\u{b5}m]",
            "d dy [\u{b5}m]",
            "d dz [\u{b5}m]",
            "largest dL [mm]",
        ];
        header.extend(self.least_stiffness.as_ref().map(|_| "d stiffness [N/m]"));
        header.extend(self.frequency_hz.as_ref().map(|_| "d frequency [mHz]"));
        let mut lines = wide_table(&header);
        for (name, index, slope) in rows {
            let (unit, step) = handy_unit(&self.inputs[*index]);
            let [dx, dy, dz] = slope.deflection_mm.map(|slope| micrometres(slope * step));
            let lengths = slope.unstrained_lengths.iter();
            let largest = lengths.fold(0.0, |size: f64, slope| size.max(slope.abs()));
            let softest = [slope.least_stiffness, slope.frequency_hz.map(|slope| 1e3 * slope)];
            let row = [
                name.clone(),
                micrometres(slope.magnitude_mm * step),
                unit.to_owned(),
                dx,
                dy,
                dz,
                format!("{:.5}", 1e3 * largest * step),
            ];
            let softest = softest.into_iter().flatten().map(|slope| decimal(slope * step, 4));
            lines.add_row(row.into_iter().chain(softest));
        }
        println!("{lines}");
    }
}

/// A length [mm] in micrometres.
fn micrometres(millimetres: f64) -> String {
    decimal(1e3 * millimetres, 5)
}

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
        let softest = |slopes: &Option<Vec<f64>>, index: usize| slopes.as_ref().map(|slopes| slopes[index]);
        let of = |index: usize| {
            let displacement = [self.magnitude_mm[index]].into_iter().chain(self.deflection_mm[index]);
            let lengths = self.unstrained_lengths[index].iter().copied();
            let softest = [softest(&self.least_stiffness, index), softest(&self.frequency_hz, index)];
            let softest = softest.map(|slope| slope.map_or_else(String::new, |slope| format!("{slope:?}")));
            let known: Vec<f64> = displacement.chain(lengths).collect();
            cells(&known).into_iter().chain(softest)
        };
        let slopes = (0..self.parameters.len()).flat_map(of);
        let one_sided: Vec<_> = self.one_sided.iter().map(|both| both.parameter.as_str()).collect();
        let swing = self.swing.as_ref();
        let swing = swing.map(|of| [of.platform_frequency_hz, of.platform_share, of.frequency_gap]);
        let swing = (0..3).map(|k| swing.map_or_else(String::new, |all| format!("{:?}", all[k])));
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
