//! `cdpr calibrate fit`: from measurements to a better robot, and to the accuracy that is left.

mod answer;

use crate::program::arguments::{
    Format, Overwrite, Preference, RobotArgument, Threads, UncertaintyArgument, With, count, seed, with,
};
use crate::program::calibrate::sensors::{NoiseArgument, SensorArguments};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, patiently};
use crate::program::said;
use answer::{print, print_details};
use cdpr_calibration::{
    Calibrated, CalibrationError, Campaign, FitSettings, Measurements, Quantity, RobustLoss, Unknowns,
    carry_out, read_measurements,
};
use cdpr_report::calibration_report;
use cdpr_robot::{Robot, listing};
use cdpr_study::{ErrorModel, InputKind, check_table, read_bytes};
use std::path::PathBuf;

/// The robot, the measurements and what is sought.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Measurements (a table with units in its header, or JSON): lengths, poses, tensions, loads, a row each;
    /// - for the standard input.
    measurements: PathBuf,
    /// What is uncertain, the prior: all that is sought without --parameters.
    ///
    /// Without both all anchor and exit points, mass and modulus are sought, without prior.
    #[command(flatten)]
    uncertainty: UncertaintyArgument,
    /// Seek these parameters or groups without prior, instead of those of --uncertainty: a,b,mass,r, or
    /// `none`.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "uncertainty")]
    parameters: Vec<String>,
    /// Parameters that share one deviation: groups, r, or lists, r1+r2,r3+r4.
    #[arg(long, value_name = "GROUPS", value_delimiter = ',')]
    share: Vec<String>,
    #[command(flatten)]
    noise: NoiseArgument,
    #[command(flatten)]
    sensors: SensorArguments,
    /// Least and greatest deviation of a parameter or group, or of an error of a sensor:
    /// mass=-2:2,r=-1e-3:1e-3.
    #[arg(long, value_delimiter = ',', value_parser = bounds, allow_hyphen_values = true)]
    bounds: Vec<(String, [f64; 2])>,
    /// Settings of the fit: loss=huber|cauchy, starts=N, folds=N, only-identifiable.
    ///
    /// loss: how great residuals (outliers) count, less than by their squares. starts: of the search, the
    /// robot file and others at random, twice as many at most, until two agree. folds: parts of the rows that
    /// are each predicted by robots calibrated without it (5; 0 for none). only-identifiable: parameters that
    /// the data do not identify keep their values, instead of being left to their priors.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    /// Seed of the random starts.
    #[arg(long, default_value_t = 1, value_parser = seed, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    preference: Preference,
    /// Folder for the results; made if missing.
    #[arg(short, long)]
    out: PathBuf,
    #[command(flatten)]
    overwrite: Overwrite,
    #[command(flatten)]
    threads: Threads,
    #[command(flatten)]
    details: Details,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

/// `name=least:greatest`.
fn bounds(text: &str) -> Result<(String, [f64; 2]), String> {
    let wrong = || format!("`{text}`: expected name=least:greatest");
    let (name, range) = text.split_once('=').ok_or_else(wrong)?;
    let (least, greatest) = range.split_once(':').ok_or_else(wrong)?;
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
    Ok((name.trim().to_owned(), [number(least)?, number(greatest)?]))
}

pub(super) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let (fit, folds) = settings.fit()?;
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let prior = settings.uncertainty.model(&robot)?;
    let path = &settings.measurements;
    let in_file = ProgramError::in_file(path);
    let bytes = read_bytes(path, InputKind::Measurements)?;
    check_table(path, &bytes, InputKind::Measurements)?;
    let measured = read_measurements(&bytes, &robot, settings.noise.named(&robot)).map_err(&in_file)?;
    let not_measured: Vec<String> = measured.not_measured(&robot).iter().map(Quantity::to_string).collect();
    if !not_measured.is_empty() {
        let columns = listing("not measured, though it is of other cables: ", &not_measured, "");
        said::note(format_args!("{}: {columns}", path.display()));
    }
    let unknowns = settings.unknowns(&robot, prior.as_ref(), &measured)?;
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let campaign = Campaign {
        robot: &robot,
        prior: prior.as_ref(),
        unknowns: &unknowns,
        measured: &measured,
        name: &name,
        settings: fit,
        folds,
    };
    let Calibrated { fit: found, summary, seconds, .. } = patiently("calibrating", || {
        carry_out(&campaign, Some((&settings.out, settings.overwrite.if_exists())), calibration_report)
    })
    .map_err(|error| match error {
        // Of the folder of results.
        CalibrationError::Study(error) => error.into(),
        error => in_file(error),
    })?;
    settings.format.print(&summary, |summary| {
        print(summary, fit.loss);
        if settings.details.details {
            print_details(summary, &found);
        }
        println!("fitted in {seconds:.3} s; results in {}", settings.out.display());
    })?;
    Ok(if summary.warnings.is_empty() { Ending::Well } else { Ending::SomethingWrong })
}

impl Settings {
    fn unknowns(
        &self,
        robot: &Robot,
        prior: Option<&ErrorModel>,
        measured: &Measurements,
    ) -> Result<Unknowns, ProgramError> {
        let [names, share] =
            [&self.parameters, &self.share].map(|list| list.iter().map(String::as_str).collect::<Vec<_>>());
        let mut unknowns = Unknowns::sought(robot, prior, &names, &share)?;
        for (error, std) in self.sensors.errors()? {
            unknowns.add(robot, error, std, measured.markers);
        }
        for (name, bounds) in &self.bounds {
            unknowns.bound(robot, name, *bounds)?;
        }
        unknowns.set_markers(self.sensors.markers(robot));
        Ok(unknowns)
    }

    /// The settings of the fit, and the number of folds.
    fn fit(&self) -> Result<(FitSettings, usize), ProgramError> {
        let with = With::known(self.with.as_ref(), &["loss", "starts", "folds", "only-identifiable"])?;
        let loss = |text: &str| match text {
            "squares" => Ok(RobustLoss::Squares),
            "huber" => Ok(RobustLoss::Huber),
            "cauchy" => Ok(RobustLoss::Cauchy),
            _ => Err("expected squares, huber or cauchy".to_owned()),
        };
        let usual = FitSettings::default();
        let starts = with.value("starts", None, count::<1, { FitSettings::MOST_STARTS }>)?;
        let folds = with.value("folds", None, count::<0, { Campaign::MOST_FOLDS }>)?;
        let settings = FitSettings {
            loss: with.value("loss", None, loss)?.unwrap_or(usual.loss),
            starts: starts.unwrap_or(FitSettings::STARTS),
            seed: self.seed,
            only_identifiable: with.has("only-identifiable")?,
            ..usual
        };
        Ok((settings, folds.unwrap_or(5)))
    }
}
