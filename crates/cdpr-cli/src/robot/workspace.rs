//! `cdpr workspace`: where the cables hold the platform, and how far it gives there, over a plane or a box.

use crate::answer::warn_of_cables;
use crate::arguments::{
    self, ErrorModelArguments, Format, FreeArguments, LoadArguments, Overwrite, Preference, Threads,
};
use crate::error::ProgramError;
use crate::output::{Details, Ending, drawn, narrow_table, patiently, progress, table};
use crate::poses::{self, Angles};
use crate::questions;
use crate::wrenches::WrenchArguments;
use cdpr_assess::{
    BoundarySummary, Further, HELD, TiltDirections, Way, Workspace, WorkspaceSummary, begin_workspace,
    compute_workspace, workspace_boundary, write_workspace,
};
use cdpr_report::{layers, workspace_maps};
use cdpr_robot::{Axis, Rotation3, broken, counted, listing, shown, significant};
use cdpr_study::{Extremes, Grid};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// The robot, the positions and the load.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("where").required(true).args(["plane", "box"]))]
pub(crate) struct Settings {
    /// Robot file (JSON, `cdpr-robot/1`).
    robot: PathBuf,
    /// Plane over the frame of the exit points: x=, y= or z= a coordinate [m].
    #[arg(long, value_parser = plane, allow_hyphen_values = true)]
    plane: Option<Plane>,
    /// Points of the plane along its two axes.
    #[arg(long, value_parser = points, default_value = "41x41", conflicts_with = "box")]
    grid: [usize; 2],
    /// Box, or a part of a plane: min:max:points of x, y and z [m], such as -2:2:9,-1:1:5,1.75:1.75:1.
    #[arg(long = "box", id = "box", value_name = "BOX", value_parser = arguments::grid)]
    #[arg(allow_hyphen_values = true)]
    within: Option<Grid>,
    /// Orientation of the platform at all positions, a quaternion: qw,qx,qy,qz; level if left out.
    #[arg(long, value_parser = poses::rotation, allow_hyphen_values = true, default_value = "1,0,0,0")]
    #[arg(conflicts_with = "rpy")]
    rotation: Rotation3<f64>,
    #[command(flatten)]
    angles: Angles,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    preference: Preference,
    #[command(flatten)]
    errors: ErrorModelArguments,
    #[command(flatten)]
    further: FurtherArguments,
    /// Layers of a box that are drawn, spread evenly from the lowest to the highest one; 0 draws nothing.
    #[arg(long, value_name = "LAYERS", default_value = "12", value_parser = arguments::count::<0, 10_000>)]
    draw: usize,
    /// Folder for the results, made if missing; NAME-workspace in the current folder if left out.
    #[arg(long)]
    out: Option<PathBuf>,
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

/// Columns of the table that take longer than the others, and the boundary.
#[derive(clap::Args)]
struct FurtherArguments {
    /// Greatest payload and margins of the tensions at each position, for the wrenches beside the load.
    #[arg(long)]
    capacity: bool,
    #[command(flatten)]
    set: WrenchArguments,
    /// Distances of the nearest two cables, and of the cable nearest to the platform, as they hang.
    #[arg(long)]
    distances: bool,
    /// How far the platform may tilt, to 0.1 degrees, in the worst of so many directions.
    #[arg(long, value_name = "DIRECTIONS", num_args = 0..=1, default_missing_value = "4")]
    #[arg(value_parser = clap::value_parser!(u16).range(1..=360))]
    tilt: Option<u16>,
    /// Boundary of the positions that are held under the load: polygons in a plane, a mesh in a box (STL).
    #[arg(long, value_enum, value_name = "WAY", num_args = 0..=1, default_missing_value = "anew")]
    boundary: Option<BoundaryWay>,
}

/// How the load is borne at the boundary.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum BoundaryWay {
    /// Tensions distributed anew.
    Anew,
    /// Lengths kept.
    Kept,
}

impl From<BoundaryWay> for Way {
    fn from(way: BoundaryWay) -> Self {
        match way {
            BoundaryWay::Anew => Self::Anew,
            BoundaryWay::Kept => Self::Kept,
        }
    }
}

/// Accuracy of the tilt in a map [degrees].
const TILT_ACCURACY: f64 = 0.1;

/// A plane on which one coordinate is constant.
#[derive(Clone, Copy)]
struct Plane {
    normal: Axis,
    coordinate: f64,
}

fn plane(text: &str) -> Result<Plane, String> {
    let parts = text.split_once('=').and_then(|(name, coordinate)| {
        let normal = Axis::from_letter(name.trim())?;
        Some(Plane { normal, coordinate: arguments::number(coordinate).ok()? })
    });
    parts.ok_or_else(|| "expected x=, y= or z= a coordinate [m], such as z=1.75".to_owned())
}

fn points(text: &str) -> Result<[usize; 2], String> {
    let parts: Vec<_> =
        text.split('x').map(|count| count.trim().parse().ok().filter(|count| *count > 1)).collect();
    match parts[..] {
        [Some(first), Some(second)] => Ok([first, second]),
        _ => Err("expected two numbers of points, 2 or more, such as 41x41".to_owned()),
    }
}

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let robot = settings.preference.open_robot(&settings.robot)?;
    let grid = match (&settings.within, settings.plane) {
        (Some(grid), _) => *grid,
        (None, Some(Plane { normal, coordinate })) => {
            Grid::over_frame(&robot, normal, coordinate, settings.grid)?
        }
        (None, None) => return Err(ProgramError::Usage("expected --plane or --box".to_owned())),
    };
    questions::about_poses(&robot, "the map", &grid.corners());
    questions::about_load(&robot, &settings.load.load());
    let tolerances = settings.errors.model(&robot)?;
    if settings.further.set.are_given() && !settings.further.capacity {
        let usage =
            "--wrench, --wrenches and --wrench-box: expected with --capacity, whose figures they change";
        return Err(ProgramError::Usage(usage.to_owned()));
    }
    let out = settings.out.clone().unwrap_or_else(|| arguments::named_after(&settings.robot, "workspace"));
    let folder = begin_workspace(&out, settings.overwrite.if_exists())?;
    let set = settings.further.set.set()?;
    questions::about_wrenches(&robot, set.wrenches());
    let further = &settings.further;
    let workspace = Workspace {
        robot: &robot,
        grid,
        rotation: settings.angles.rotation().unwrap_or(settings.rotation),
        load: settings.load.load(),
        tolerances: tolerances.as_ref(),
        free: &settings.free.free,
        further: Further {
            capacity: further.capacity.then_some(&set),
            distances: further.distances,
            tilt: further
                .tilt
                .map(|count| TiltDirections { count: count.into(), accuracy: TILT_ACCURACY.to_radians() }),
        },
    };
    let progress = progress(grid.poses().len(), "poses");
    let clock = Instant::now();
    let poses = compute_workspace(&workspace, &|| progress.inc(1), &|| false)?;
    let seconds = clock.elapsed().as_secs_f64();
    progress.finish_and_clear();
    let held = poses.iter().filter_map(|pose| pose.outcome.as_ref().ok());
    warn_of_cables(held.filter_map(|held| held.lowest_cable_frequency.zip(held.lowest_frequency)));
    let mut summary = WorkspaceSummary::new(&workspace, &poses);
    questions::about_map(&summary);
    let mut boundary = None;
    if let Some(way) = further.boundary {
        let found = patiently("boundary", || workspace_boundary(&workspace, way.into(), &|| false))?;
        summary.boundary = Some(BoundarySummary::new(way.into(), &found));
        boundary = Some(found);
    }
    let maps = workspace_maps(&robot, &summary, settings.draw).into_iter();
    let maps: Vec<_> = maps.filter_map(|map| drawn(&map.name, map.svg)).collect();
    write_workspace(&folder, &summary, &maps, boundary.as_ref())?;
    settings.format.print(&summary, |summary| {
        print(summary);
        if settings.details.details {
            print_details(summary);
        }
        let (drawn, all) = (settings.draw, layers(summary));
        if drawn < all {
            println!("{drawn} of {all} layers are drawn: --draw {all} draws all of them");
        }
        println!("{} in {seconds:.2} s; results in {}", counted(poses.len(), "pose"), out.display());
    })?;
    Ok(if summary.too_much > 0 { Ending::SomethingWrong } else { Ending::Well })
}

/// The share of the positions that is held, and what ranges over them.
fn print(summary: &WorkspaceSummary) {
    let all = summary.rows.len();
    let held = summary.status.get(HELD).copied().unwrap_or(0);
    let percent = 100.0 * held as f64 / all.max(1) as f64;
    let of =
        format!("{} holds {held} of {} ({percent:.1} %)", shown(&summary.robot), counted(all, "position"));
    say(&format!("{of}, {}.", summary.conditions()));
    let others = summary.status.iter().filter(|(status, _)| **status != HELD);
    let others: Vec<String> =
        others.map(|(status, count)| format!("{count} {}", status.replace('_', " "))).collect();
    if !others.is_empty() {
        say(&listing("Not held: ", &others, "."));
    }
    if summary.too_much > 0 {
        let positions = counted(summary.too_much, "position");
        say(&format!("At {positions} tensions are above tension_limits.max or a breaking force."));
    }
    let mut rows = narrow_table(&["over the positions held", "least", "greatest"]);
    for (name, extremes) in ranges(summary) {
        if let Some(Extremes { min, max, .. }) = extremes {
            rows.add_row([name.to_owned(), significant(min, 4), significant(max, 4)]);
        }
    }
    if rows.row_count() > 0 {
        println!("{rows}");
    }
    if let Some(BoundarySummary { measure, error, unit, .. }) = &summary.boundary {
        say(&format!("The region held has {measure:.4} {unit}, with an error of {error:.1e}."));
    }
}

/// Prints a sentence in lines of 80 columns.
fn say(sentence: &str) {
    broken(sentence).iter().for_each(|line| println!("{line}"));
}

/// What ranges over the positions held.
fn ranges(summary: &WorkspaceSummary) -> [(&'static str, Option<Extremes>); 14] {
    [
        ("|dp| [mm]", summary.rms_mm),
        ("least stiffness [N/m]", summary.least_stiffness),
        ("lowest natural frequency [Hz]", summary.lowest_frequency_hz),
        ("that of the slowest cable [Hz]", summary.lowest_cable_frequency_hz),
        ("greatest tension [N]", summary.greatest_tension),
        ("least tension [N]", summary.least_tension),
        ("greatest tension, distributed anew [N]", summary.anew_greatest_tension),
        ("greatest payload, distributed anew [kg]", summary.payload_anew_kg),
        ("greatest payload, lengths kept [kg]", summary.payload_kept_kg),
        ("margin, distributed anew [N]", summary.margin_anew),
        ("margin, lengths kept [N]", summary.margin_kept),
        ("distance of the nearest cables [mm]", summary.nearest_cables_mm),
        ("distance of cables and platform [mm]", summary.nearest_to_platform_mm),
        ("tilt in the worst direction [deg]", summary.tilt_deg),
    ]
}

fn print_details(summary: &WorkspaceSummary) {
    println!("\n{}: {} positions, {}", shown(&summary.robot), summary.rows.len(), summary.conditions());
    let counts = |status: &BTreeMap<&str, usize>| {
        for (status, count) in status {
            println!("{count:8} {status}");
        }
    };
    if summary.is_loaded() {
        println!("with the lengths kept under the load:");
    }
    counts(&summary.status);
    if summary.too_much > 0 {
        let positions = summary.too_much;
        println!(
            "{positions:8} with tensions above tension_limits.max or a breaking force: see workspace.csv"
        );
    }
    if summary.is_loaded() {
        println!("with the tensions distributed anew:");
    }
    counts(&summary.anew_status);
    // Without a load these are the counts above, unless they say more.
    let says_more = summary.left_out.keys().any(|why| !summary.status.contains_key(why.as_str()));
    if says_more || summary.is_loaded() && !summary.left_out.is_empty() {
        println!("left out{}:", if summary.is_loaded() { ", with the lengths kept" } else { "" });
        for (why, count) in &summary.left_out {
            println!("{count:8} {why}");
        }
    }
    let mut rows = table(&["over the positions held", "least", "at [m]", "greatest", "at [m]"]);
    let position = |[x, y, z]: [f64; 3]| format!("{x:.3}, {y:.3}, {z:.3}");
    for (name, extremes) in ranges(summary) {
        if let Some(Extremes { min, min_at, max, max_at }) = extremes {
            rows.add_row([
                name.to_owned(),
                format!("{min:.4}"),
                position(min_at),
                format!("{max:.4}"),
                position(max_at),
            ]);
        }
    }
    if rows.row_count() > 0 {
        println!("{rows}");
    }
    if let Some(BoundarySummary { way, measure, error, unit, parts, evaluations }) = &summary.boundary {
        let (name, parts) = match *unit {
            "m2" => ("area", format!("{parts} polygons in boundary.csv")),
            _ => ("volume", format!("{parts} triangles in boundary.stl")),
        };
        println!(
            "{name} of the region held ({way}): {measure:.4} {unit}, error {error:.1e}; {parts}; \
             {evaluations} positions asked for"
        );
    }
    let mut dominant: Vec<_> = summary.dominant.iter().collect();
    dominant.sort_by_key(|(_, count)| std::cmp::Reverse(**count));
    for (name, count) in dominant.into_iter().take(5) {
        println!("{name} dominates the tolerance of |dp| at {count} positions");
    }
}
