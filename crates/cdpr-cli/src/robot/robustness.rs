//! `cdpr robustness`: how often the direct model finds the true pose from a wrong start.

use crate::arguments::{self, Format, FreeArguments, Overwrite, Preference};
use crate::error::ProgramError;
use crate::output::{drawn, progress, table};
use crate::questions;
use cdpr_assess::{
    PoseRegion, ProtocolSummary, RobustnessRow, RobustnessSummary, Spread, begin_robustness, protocols,
    run_robustness, write_robustness,
};
use cdpr_robot::{Pose, plausible, rounded, shown};
use std::path::PathBuf;
use std::time::Instant;

/// The robot and the sizes of the protocols.
#[derive(clap::Args)]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`) or name.
    ///
    /// The protocols are made for CoGiRo. In the room of another robot their distances change with its size.
    #[arg(long)]
    robot: PathBuf,
    /// Poses of the protocol of Mahnke and Caverly.
    #[arg(long, default_value_t = 10_000, value_parser = arguments::count::<1, 1_000_000>)]
    poses: usize,
    /// Young's modulus of all cables in that protocol [Pa]; the thirty poses keep the robot's [default: 35e9
    /// for CoGiRo, else the robot's].
    #[arg(long, allow_negative_numbers = true)]
    modulus: Option<f64>,
    /// Box from which poses are drawn, min:max of x, y and z [m]: -2:2,-1:1,0.5:2.5 [default: for CoGiRo the
    /// published one, else the box of the exit points].
    #[arg(long, value_parser = arguments::region, allow_hyphen_values = true)]
    region: Option<PoseRegion>,
    #[command(flatten)]
    free: FreeArguments,
    /// Seed of poses and starts. The same seed gives the same numbers, but for the times.
    #[arg(long, default_value_t = 2017, value_parser = arguments::seed, allow_negative_numbers = true)]
    seed: u64,
    #[command(flatten)]
    preference: Preference,
    /// Folder for the results, made if missing; NAME-robustness in the current folder if left out.
    #[arg(long)]
    out: Option<PathBuf>,
    #[command(flatten)]
    overwrite: Overwrite,
    /// How the results are printed.
    #[arg(long, value_enum, default_value_t = Format::Text)]
    format: Format,
}

pub(crate) fn run(settings: &Settings) -> Result<(), ProgramError> {
    let clock = Instant::now();
    let robot = settings.preference.open_robot(&settings.robot)?;
    let Settings { poses, modulus, region, free, seed, .. } = settings;
    questions::ask(modulus.and_then(|modulus| plausible::modulus("--modulus", modulus)));
    if let Some(PoseRegion { low: [x, y, z], high: [to_x, to_y, to_z], .. }) = region {
        questions::about_poses(&robot, "--region", &[Pose::at(*x, *y, *z), Pose::at(*to_x, *to_y, *to_z)]);
    }
    let protocols = protocols(&robot, *poses, *modulus, *region, &free.free, *seed);
    for protocol in &protocols {
        protocol.validate()?;
    }
    let out = settings.out.clone().unwrap_or_else(|| arguments::named_after(&settings.robot, "robustness"));
    let folder = begin_robustness(&out, settings.overwrite.if_exists())?;

    let steps = protocols.iter().map(|protocol| protocol.poses + protocol.solves()).sum();
    let progress = progress(steps, "poses and solves");
    let mut results = Vec::new();
    for protocol in &protocols {
        progress.set_message(protocol.name);
        results.push(run_robustness(&robot, protocol, &|| progress.inc(1))?);
    }
    progress.finish_and_clear();
    let summary = RobustnessSummary {
        robot: robot.name.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        protocols: results.iter().map(|r| (r.protocol.name.to_owned(), ProtocolSummary::new(r))).collect(),
    };
    let figures = [
        ("found_poses", cdpr_report::found_poses(&results[0])),
        ("success_share", cdpr_report::success_share(&summary.protocols[0])),
    ];
    let figures: Vec<_> = figures.into_iter().filter_map(|(name, svg)| drawn(name, svg)).collect();
    write_robustness(&folder, &summary, &results, &figures)?;
    Ok(settings.format.print(&summary, |summary| {
        print_results(summary);
        println!("{:.1} s; results in {}", clock.elapsed().as_secs_f64(), out.display());
    })?)
}

fn print_results(summary: &RobustnessSummary) {
    for protocol in summary.protocols.values() {
        println!("{}: {}", shown(&summary.robot), protocol.title);
        print_settings(protocol);
        print_rows(protocol);
        for (kind, count) in &protocol.total.failed {
            println!("{count} failed: {kind}");
        }
        if let (Some(distance), Some(angle)) =
            (protocol.total.true_pose_distance, protocol.total.true_pose_angle_deg)
        {
            println!("true poses are found to {:.1e} m and {:.1e} degrees at worst", distance.max, angle.max);
        }
        println!();
    }
}

fn print_settings(protocol: &ProtocolSummary) {
    let modulus =
        protocol.youngs_modulus.map_or_else(|| "that of the file".to_owned(), |e| format!("{} GPa", e / 1e9));
    println!(
        "E: {modulus}; seed {}; found: within {} m and {} degrees",
        protocol.seed,
        rounded(protocol.found_distance, 4),
        protocol.found_angle_deg
    );
    let draws = &protocol.draws;
    // Rests of few cables are refused as unstable, too, before the direct model looks at them.
    const UNSTABLE: &str = "unstable";
    let kinds = |counts: &std::collections::BTreeMap<String, usize>| {
        let others = counts.iter().filter(|(kind, _)| kind.as_str() != UNSTABLE);
        others.map(|(kind, count)| format!(", {count} {kind}")).collect::<String>()
    };
    let unstable = draws.unstable + draws.infeasible.get(UNSTABLE).copied().unwrap_or(0);
    println!(
        "{} poses of {} drawn{}; {} unstable{}",
        protocol.poses,
        draws.drawn,
        kinds(&draws.infeasible),
        unstable,
        kinds(&draws.unanswered)
    );
}

fn print_rows(protocol: &ProtocolSummary) {
    let published = protocol.rows.iter().find_map(|row| row.published);
    let mut header = vec![
        "start [m]",
        "[deg]",
        "solves",
        "true pose",
        "[%]",
        "other",
        "failed",
        "Newton",
        "trust r.",
        "iterations",
        "max",
        "time [\u{b5}s]",
        "max",
    ];
    header.extend(published.map(|published| published.program));
    let mut rows = table(&header);
    for row in protocol.rows.iter().chain([&protocol.total]) {
        let mut cells = cells(row);
        if published.is_some() {
            cells.push(row.published.map_or_else(String::new, |p| format!("{} of {}", p.found, p.of)));
        }
        rows.add_row(cells);
    }
    println!("{rows}");
}

fn cells(row: &RobustnessRow) -> Vec<String> {
    let number = |value: Option<f64>| {
        value.map_or_else(
            || "all".to_owned(),
            |value| format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned(),
        )
    };
    let spread = |spread: Option<Spread>| {
        spread.map_or_else(Default::default, |s| [format!("{:.0}", s.median), format!("{:.0}", s.max)])
    };
    let mut cells =
        vec![number(row.distance), number(row.angle_deg), row.solves.to_string(), row.true_pose.to_string()];
    cells.push(row.success().map_or_else(String::new, |share| format!("{:.2}", 100.0 * share)));
    let counts = [row.other_equilibrium, row.failed.values().sum(), row.newton, row.trust_region];
    cells.extend(counts.map(|count| count.to_string()));
    cells.extend(spread(row.iterations).into_iter().chain(spread(row.microseconds)));
    cells
}
