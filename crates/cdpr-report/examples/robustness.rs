//! How often the direct model finds the true pose from a wrong start:
//! `cargo run --release -p cdpr-report --example robustness -- [--robot ROBOT] [--poses N] [--modulus E]
//! [--free NAMES] [--seed N] [--out DIR] [--overwrite]`.
//!
//! By the protocol of Mahnke and Caverly (N poses of CoGiRo with the modulus E [Pa], starts up to 1 m and
//! 40 degrees away) and on thirty poses with the file's modulus. In the room of another robot distances
//! change with the room's size. It writes `solves.csv`, `refused.csv` (poses drawn that the robot does not
//! hold), `robustness.json` and two figures. Everything but the times follows from the seed.
//!
//! The example is here and not in `cdpr-assess`, which measures, because it draws the figures, too.

#![allow(clippy::print_stdout)]

use cdpr_assess::{
    ProtocolSummary, RobustnessRow, RobustnessSummary, Spread, begin_robustness, protocols, run_robustness,
    write_robustness,
};
use cdpr_report::{found_poses, success_share};
use cdpr_robot::Coordinate;
use cdpr_study::{IfExists, open_robot};
use std::path::PathBuf;
use std::time::Instant;

type Failed = Box<dyn std::error::Error>;

/// What the arguments say.
struct Settings {
    robot: PathBuf,
    poses: usize,
    modulus: Option<f64>,
    free: Vec<Coordinate>,
    seed: u64,
    out: PathBuf,
    if_exists: IfExists,
}

impl Settings {
    fn read(mut arguments: impl Iterator<Item = String>) -> Result<Self, Failed> {
        let mut settings = Self {
            robot: "cogiro".into(),
            poses: 10_000,
            modulus: None,
            free: Vec::new(),
            seed: 2017,
            out: "robustness".into(),
            if_exists: IfExists::Refuse,
        };
        while let Some(name) = arguments.next() {
            if name == "--overwrite" {
                settings.if_exists = IfExists::Overwrite;
                continue;
            }
            let value = arguments.next().ok_or_else(|| format!("{name}: expected a value behind it"))?;
            match name.as_str() {
                "--robot" => settings.robot = value.into(),
                "--poses" => settings.poses = value.parse()?,
                "--modulus" => settings.modulus = Some(value.parse()?),
                "--free" => settings.free = value.split(',').map(str::parse).collect::<Result<_, _>>()?,
                "--seed" => settings.seed = value.parse()?,
                "--out" => settings.out = value.into(),
                _ => {
                    let expected = "--robot, --poses, --modulus, --free, --seed, --out or --overwrite";
                    return Err(format!("{name}: expected {expected}").into());
                }
            }
        }
        Ok(settings)
    }
}

fn main() -> Result<(), Failed> {
    let Settings { robot, poses, modulus, free, seed, out, if_exists } =
        Settings::read(std::env::args().skip(1))?;
    let clock = Instant::now();
    let robot = open_robot(&robot)?;
    let protocols = protocols(&robot, poses, modulus, None, &free, seed);
    protocols.iter().try_for_each(cdpr_assess::Protocol::validate)?;
    let folder = begin_robustness(&out, if_exists)?;
    let mut results = Vec::new();
    for protocol in &protocols {
        results.push(run_robustness(&robot, protocol, &|| ())?);
    }
    let summary = RobustnessSummary {
        robot: robot.name.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        protocols: results.iter().map(|r| (r.protocol.name.to_owned(), ProtocolSummary::new(r))).collect(),
    };
    let figures = [
        ("found_poses".to_owned(), found_poses(&results[0])?),
        ("success_share".to_owned(), success_share(&summary.protocols[0])?),
    ];
    write_robustness(&folder, &summary, &results, &figures)?;
    for protocol in summary.protocols.values() {
        print(&summary.robot, protocol);
    }
    println!("{:.1} s; results in {}", clock.elapsed().as_secs_f64(), out.display());
    Ok(())
}

fn print(robot: &str, protocol: &ProtocolSummary) {
    let modulus =
        protocol.youngs_modulus.map_or("that of the file".to_owned(), |e| format!("{} GPa", e / 1e9));
    println!("{robot}: {}\nE: {modulus}; seed {}", protocol.title, protocol.seed);
    println!("{} poses of {} drawn", protocol.poses, protocol.draws.drawn);
    println!("start [m]  [deg]  solves  true pose  other  failed  iterations  max  time [us]     max");
    for row in protocol.rows.iter().chain([&protocol.total]) {
        println!("{}", line(row));
    }
    for (kind, count) in &protocol.total.failed {
        println!("{count} failed: {kind}");
    }
    println!();
}

fn line(row: &RobustnessRow) -> String {
    let number = |value: Option<f64>| value.map_or("all".to_owned(), |value| format!("{value:.2}"));
    let spread = |spread: Option<Spread>| spread.map_or((f64::NAN, f64::NAN), |of| (of.median, of.max));
    let ((iterations, most), (time, longest)) = (spread(row.iterations), spread(row.microseconds));
    let failed: usize = row.failed.values().sum();
    let published = row.published.map_or(String::new(), |published| {
        format!("  {}: {} of {}", published.program, published.found, published.of)
    });
    format!(
        "{:>9}{:>7}{:>8}{:>11}{:>7}{failed:>8}{iterations:>12.0}{most:>5.0}{time:>11.0}{longest:>8.0}{published}",
        number(row.distance),
        number(row.angle_deg),
        row.solves,
        row.true_pose,
        row.other_equilibrium
    )
}
