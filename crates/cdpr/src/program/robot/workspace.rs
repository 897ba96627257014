//! `cdpr workspace`: where the cables hold the platform, and how far it gives there, over a plane or a box.

mod ranges;

use crate::program::arguments::poses::Angles;
use crate::program::arguments::{
    self, FACTORS, FigureArgument, Format, FreeArguments, LoadArguments, NO_DRAG, Overwrite, Preference,
    Region, RobotArgument, Threads, UncertaintyArgument, WEATHER, With, any_weather, count, factors, figure,
    note_pulleys, number, region, with, write_figures,
};
use crate::program::error::ProgramError;
use crate::program::output::{Details, Ending, drawn, patiently, print_sentence, progress, table};
use crate::program::pose::modes::OWN;
use crate::program::questions;
use crate::program::robot::workspace::ranges::{print_details, ranges};
use crate::program::said::missing_frequencies;
use crate::program::wrenches::WrenchArguments;
use cdpr_assess::{
    AnyWeather, BoundarySummary, DIRECTIONS, Further, HELD, PartialFactors, Shaking, TiltDirections, Way,
    Workspace, WorkspaceSummary, begin_workspace, compute_workspace, workspace_boundary, write_workspace,
};
use cdpr_dynamics::Damping;
use cdpr_report::{MapQuantity, Sheet, layers, workspace_maps};
use cdpr_robot::{Axis, Robot, Rotation3, counted, listing, shown, significant};
use cdpr_study::{Extremes, Grid};
use std::path::PathBuf;
use std::time::Instant;

/// The robot, the positions and the load.
#[derive(clap::Args)]
pub(crate) struct Settings {
    #[command(flatten)]
    robot: RobotArgument,
    /// Where the platform is mapped: a plane, z=1.75, or x, y and z, each of them a coordinate, min:max or
    /// min:max:points [m], such as -2:2:9,-1:1:5,1.75.
    ///
    /// What is left out, such as in ::11,::7,1.75, is that of the frame of the exit points, and 41 points in
    /// a plane or 11 in a box.
    #[arg(long, value_parser = region, allow_hyphen_values = true)]
    region: Region,
    #[command(flatten)]
    angles: Angles,
    #[command(flatten)]
    free: FreeArguments,
    #[command(flatten)]
    load: LoadArguments,
    #[command(flatten)]
    preference: Preference,
    #[command(flatten)]
    errors: UncertaintyArgument,
    #[command(flatten)]
    set: WrenchArguments,
    /// Further results, which take longer: capacity, distances, tilt=N, amplitude=HZ:HZ, boundary, layers=N,
    /// wind=SPEED, breaks.
    ///
    /// capacity: greatest payload and margins of the tensions, for each --wrench on top of the load.
    /// distances: of the nearest two cables, and of the cable nearest to the platform. tilt: how far the
    /// platform may tilt, to 0.1 degrees, in the worst of N directions (4). amplitude: the largest one in a
    /// band of frequencies, or at one (amplitude=HZ), by a force at P or --marker and by a winch; damping=TAU
    /// and drag=RATE damp the cables, as those of `response` (2e-4 s, none). boundary: of the positions that
    /// are held under the load with the tensions distributed again, or boundary=kept, with the lengths kept:
    /// polygons in a plane, a mesh in a box (STL). layers: of a box that are drawn, spread evenly (12); 0
    /// draws nothing. wind=SPEED: how far wind on the cables and load displace the platform, the lengths
    /// kept, and the worst of all horizontal directions; wind=VX:VY:VZ: wind of one velocity; ice, creep and
    /// the others as those of `deflection`. breaks: the greatest tension over breaking force, with all
    /// cables, each of them broken alone and in the wind, and how far a break moves the platform; with
    /// permanent= and the other partial factors of `safety` the utilization.
    #[arg(long, value_name = "NAMES", value_parser = with)]
    with: Option<With>,
    /// Point of the platform whose amplitude is mapped: x,y,z in its frame [m]; P if left out.
    #[arg(long, value_parser = arguments::components::<3>, allow_hyphen_values = true)]
    marker: Option<[f64; 3]>,
    /// Folder for the results, made if missing; NAME-workspace in the current folder if left out.
    #[arg(short, long)]
    out: Option<PathBuf>,
    /// File for one of the maps, too, with the name that it has in the folder; behind its name: width=MM,
    /// untitled. It can be given several times.
    #[arg(long, value_name = "NAME.pdf", value_parser = figure)]
    figure: Vec<FigureArgument>,
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

/// What is computed besides the map.
struct Wanted {
    capacity: bool,
    distances: bool,
    /// Directions of the tilt.
    tilt: Option<usize>,
    shaking: Option<Shaking>,
    weather: Option<AnyWeather>,
    /// Factors of utilizations after breaks.
    breaks: Option<PartialFactors>,
    boundary: Option<Way>,
    /// Layers of a box that are drawn.
    layers: usize,
}

impl Wanted {
    fn new(with: &With, marker: Option<[f64; 3]>) -> Result<Self, ProgramError> {
        let own =
            ["capacity", "distances", "tilt", "amplitude", "damping", "drag", "boundary", "layers", "wind"];
        with.check(&[&own[..], &["breaks"], &FACTORS, &WEATHER].concat())?;
        let (breaks, factors) = (with.has("breaks")?, factors(with)?);
        if factors.is_some() && !breaks {
            let expected = "--with permanent: expected breaks, too, whose utilization it changes";
            return Err(ProgramError::Usage(expected.to_owned()));
        }
        let breaks = breaks.then(|| factors.unwrap_or(PartialFactors::ONE));
        let band = |text: &str| {
            let (from, to) = text.split_once(':').unwrap_or((text, text));
            let ends = number(from).ok().zip(number(to).ok()).map(<[f64; 2]>::from);
            ends.ok_or_else(|| {
                "expected one frequency [Hz] or two, such as amplitude=5 or amplitude=0:20".to_owned()
            })
        };
        let damping = with.damping()?;
        let band = with.value("amplitude", None, band)?;
        if band.is_none() && (marker.is_some() || damping.is_some()) {
            let expected = "expected --with amplitude=HZ:HZ, too, which these settings change";
            return Err(ProgramError::Usage(format!("--marker, damping, drag: {expected}")));
        }
        let shaking = |band| Shaking {
            band,
            damping: damping.unwrap_or(Damping::USUAL),
            marker: marker.unwrap_or_default().into(),
        };
        let way = |text: &str| match text {
            "kept" => Ok(Way::Kept),
            _ => Err("expected boundary or boundary=kept".to_owned()),
        };
        Ok(Self {
            capacity: with.has("capacity")?,
            distances: with.has("distances")?,
            tilt: with.value("tilt", Some(4), count::<1, 360>)?,
            shaking: band.map(shaking),
            weather: any_weather(with)?,
            breaks,
            boundary: with.value("boundary", Some(Way::Recomputed), way)?,
            layers: with.value("layers", None, count::<0, 10_000>)?.unwrap_or(12),
        })
    }
}

impl Wanted {
    /// Refuses what the map cannot have, before it is computed.
    fn check(&self, settings: &Settings, grid: &Grid) -> Result<(), ProgramError> {
        let usage = |reason: String| Err(ProgramError::Usage(reason));
        if settings.set.are_given() && !self.capacity {
            return usage("--wrench: expected --with capacity, too, whose figures it changes".to_owned());
        }
        let axes = Axis::ALL.into_iter().filter(|axis| grid.axis(*axis).points > 1).count();
        if self.boundary.is_some() && axes < 2 {
            let expected = "expected a plane or a box, with two points or more along two axes or three";
            return usage(format!("--with boundary: {expected}"));
        }
        let names = map_names();
        // Those of layers end in `_z00`, ....
        let is_of = |stem: &str, name: &str| {
            stem.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with("_z"))
        };
        let unknown = |file: &&FigureArgument| !names.iter().any(|name| is_of(file.stem(), name));
        match settings.figure.iter().find(unknown) {
            Some(file) => {
                let (file, names) = (file.path.display(), names.join(", "));
                usage(format!("--figure {file}: expected the name of a map: {names}"))
            }
            None => Ok(()),
        }
    }
}

/// Names of all maps that there may be.
fn map_names() -> Vec<&'static str> {
    [&MapQuantity::ALL.map(MapQuantity::name)[..], &["dominant_tolerance"]].concat()
}

/// Accuracy of the tilt in a map [degrees].
const TILT_ACCURACY: f64 = 0.1;

pub(crate) fn run(settings: &Settings) -> Result<Ending, ProgramError> {
    settings.threads.start()?;
    let wanted = Wanted::new(&settings.with.clone().unwrap_or_default(), settings.marker)?;
    let robot = settings.preference.open_robot(settings.robot.path())?;
    let grid = settings.region.grid(&robot)?;
    questions::about_corners(&robot, "the map", &grid.corners());
    questions::about_load(&robot, &settings.load.load());
    let tolerances = settings.errors.model(&robot)?;
    wanted.check(settings, &grid)?;
    let out =
        settings.out.clone().unwrap_or_else(|| arguments::named_after(settings.robot.path(), "workspace"));
    let folder = begin_workspace(&out, settings.overwrite.if_exists(), &map_names())?;
    let set = settings.set.set()?;
    questions::about_wrenches(&robot, set.wrenches());
    let workspace = Workspace {
        robot: &robot,
        grid,
        rotation: settings.angles.rotation().unwrap_or_else(Rotation3::identity),
        load: settings.load.load(),
        tolerances: tolerances.as_ref(),
        free: &settings.free.free,
        further: Further {
            capacity: wanted.capacity.then_some(&set),
            distances: wanted.distances,
            tilt: wanted.tilt.map(|count| TiltDirections { count, accuracy: TILT_ACCURACY.to_radians() }),
            shaking: wanted.shaking,
            weather: wanted.weather,
            breaks: wanted.breaks,
        },
    };
    let progress = progress(grid.poses().len(), "poses");
    let clock = Instant::now();
    let poses = compute_workspace(&workspace, &|| progress.inc(1), &|| false)?;
    let seconds = clock.elapsed().as_secs_f64();
    progress.finish_and_clear();
    let mut summary = WorkspaceSummary::new(&workspace, &poses);
    questions::about_map(&summary);
    let mut boundary = None;
    if let Some(way) = wanted.boundary {
        let found = patiently("boundary", || workspace_boundary(&workspace, way, &|| false))?;
        summary.boundary = Some(BoundarySummary::new(way, &found));
        boundary = Some(found);
    }
    let drawn_for = |sheet: Sheet| workspace_maps(&robot, &summary, boundary.as_ref(), wanted.layers, sheet);
    let maps = drawn_for(Sheet::SCREEN).into_iter();
    let maps: Vec<_> = maps.filter_map(|map| drawn(&map.name, map.svg)).collect();
    write_workspace(&folder, &summary, &maps, boundary.as_ref())?;
    let of_sheet = |sheet: Sheet| -> Vec<_> {
        drawn_for(sheet).into_iter().filter_map(|map| Some((map.name, map.svg.ok()?))).collect()
    };
    write_figures(&settings.figure, of_sheet, &settings.overwrite)?;
    settings.format.print(&summary, |summary| {
        print(summary);
        missing_frequencies(&robot).iter().for_each(|why| print_sentence(why));
        least_norm(&robot, summary).iter().for_each(|why| print_sentence(why));
        if settings.details.details {
            print_details(summary);
        }
        let (drawn, all) = (wanted.layers, layers(summary));
        if drawn < all {
            println!("{drawn} of {all} layers are drawn: --with layers={all} draws all of them");
        }
        println!("{} in {seconds:.2} s; results in {}", counted(poses.len(), "pose"), out.display());
    })?;
    if let Some(AnyWeather { weather, speed }) = &workspace.further.weather {
        note_pulleys(&robot, speed.is_some() || !weather.wind.is_calm());
    }
    let few = questions::few_held(&summary);
    few.iter().for_each(|few| eprintln!("warning: {few}"));
    let is_wrong = summary.too_much > 0 || summary.crossing.is_some_and(|count| count > 0) || few.is_some();
    Ok(if is_wrong { Ending::SomethingWrong } else { Ending::Well })
}

/// At how many positions no motion is the platform's own.
fn print_shared(summary: &WorkspaceSummary) {
    let shares = || summary.rows.iter().filter_map(|row| row.platform_share);
    let shared = shares().filter(|share| *share < OWN).count();
    if shared > 0 {
        print_sentence(&format!(
            "At {shared} of {} positions no mode is mainly a platform mode, because cable modes are near it: \
             the frequency is that of the mode with the largest share, `platform_share`, down to {} %.",
            shares().count(),
            significant(100.0 * shares().fold(1.0, f64::min), 2)
        ));
    }
}

/// The share of the positions that is held, and what ranges over them.
fn print(summary: &WorkspaceSummary) {
    let all = summary.rows.len();
    let held = summary.status.get(HELD).copied().unwrap_or(0);
    let percent = 100.0 * held as f64 / all.max(1) as f64;
    let again = summary.recomputed_status.get(HELD).copied().unwrap_or(0);
    let ways = match summary.is_loaded() && again != held {
        true => format!(" with the lengths kept, {again} with tensions for the load"),
        false => String::new(),
    };
    let positions = counted(all, "position");
    let of = format!("{} holds {held} of {positions} ({percent:.1} %){ways}", shown(&summary.robot));
    print_sentence(&format!("{of}, {}.", summary.conditions()));
    let others = summary.status.iter().filter(|(status, _)| **status != HELD);
    let others: Vec<String> =
        others.map(|(status, count)| format!("{count} {}", status.replace('_', " "))).collect();
    if !others.is_empty() {
        print_sentence(&listing("Not held: ", &others, "."));
    }
    if summary.too_much > 0 {
        let positions = counted(summary.too_much, "position");
        print_sentence(&format!("At {positions} tensions are above tension_limits.max or a breaking force."));
    }
    crossing(summary, held).iter().for_each(|crossing| print_sentence(crossing));
    let mut rows = table(&["over the positions held", "least", "greatest"]);
    for (name, extremes) in ranges(summary) {
        if let Some(Extremes { min, max, .. }) = extremes {
            rows.add_row([name.to_owned(), significant(min, 4), significant(max, 4)]);
        }
    }
    if rows.row_count() > 0 {
        println!("{rows}");
    }
    print_shared(summary);
    if let Some(shaking) = &summary.shaking {
        print_sentence(&format!("Amplitudes from {}.", shaking.conditions()));
        if shaking.inertia_assumed {
            print_sentence("The robot has no inertia: that of a ball as large as the platform is assumed.");
        }
        if shaking.drag_per_s == 0.0 {
            print_sentence(NO_DRAG);
        }
    }
    if let Some(weather) = &summary.weather {
        let wrong = match weather.wrong {
            0 => "at no position held is a tension out of its limits".to_owned(),
            count => format!(
                "at {count} of {held} positions held a tension is out of its limits or no rest was found"
            ),
        };
        let directions =
            weather.speed.map_or_else(String::new, |_| format!(" ({DIRECTIONS} directions and searches)"));
        print_sentence(&format!("In the weather, {}{directions}: {wrong}.", weather.conditions()));
    }
    if summary.factors.is_some() {
        let exceeds =
            summary.rows.iter().filter(|row| row.utilization.is_some_and(|most| most > 1.0)).count();
        let open = summary.rows.iter().filter(|row| row.utilization.is_none() && row.status == HELD).count();
        let open = match open {
            0 => String::new(),
            count => format!("; at {count} positions held it is not known (break_reason in workspace.csv)"),
        };
        print_sentence(&format!(
            "With all cables and without each of them, the utilization exceeds 1 at {}{open}.",
            counted(exceeds, "position")
        ));
    }
    print_region(summary);
}

/// At how many of the positions held cables cross or meet the platform, with the first one of them.
fn crossing(summary: &WorkspaceSummary, held: usize) -> Option<String> {
    let count = summary.crossing.filter(|count| *count > 0)?;
    let first = summary.rows.iter().find(|row| row.status == HELD && row.is_crossed())?;
    let met = |near: Option<f64>, what: String| near.filter(|near| *near < 0.0).map(|_| what);
    let pair = first.nearest_cables.iter().map(|pair| format!("cables {}", pair.replace(' ', " and ")));
    let pair = met(first.nearest_cables_mm, format!("{} touch or cross", pair.collect::<String>()));
    let cable = first.nearest_to_platform.unwrap_or_default();
    let platform = met(first.nearest_to_platform_mm, format!("cable {cable} crosses the platform"));
    let what = pair.into_iter().chain(platform).collect::<Vec<_>>().join(", ");
    let [x, y, z] = [first.x_m, first.y_m, first.z_m].map(|at| significant(at, 4));
    Some(format!(
        "At {count} of {held} positions held cables touch or cross each other or the platform, first at \
         ({x}, {y}, {z}) m: {what}."
    ))
}

/// How large the region held is.
fn print_region(summary: &WorkspaceSummary) {
    if let Some(BoundarySummary { way, measure, error, doubtful, unit, .. }) = &summary.boundary {
        let with = match (summary.is_loaded(), *way) {
            (false, _) => "",
            (true, "kept") => " with the lengths kept",
            (true, _) => " with tensions for the load",
        };
        let [measure, smooth, unseen] =
            [(measure, 5), (error, 2), (doubtful, 2)].map(|(x, n)| significant(*x, n));
        let more = format!("{unseen} {unit} are in doubt; more points show it");
        let doubt = if *doubtful > *error { more.as_str() } else { "none were found" };
        print_sentence(&format!(
            "The region held{with} has {measure} {unit}, with an error of {smooth} where its boundary is smooth. \
             Parts thinner than a step of the grid are not seen: {doubt}."
        ));
    }
}

/// Why kept lengths hold a load at few positions: tensions of least norm are at their limit without it.
fn least_norm(robot: &Robot, summary: &WorkspaceSummary) -> Option<String> {
    let is_below = |words: &str| words.contains("below tension_limits.min");
    let below = summary.rows.iter().filter(|row| row.out_of_limits.as_deref().is_some_and(is_below)).count();
    let held = summary.status.get(HELD).copied().unwrap_or(0);
    (robot.tension_reference.is_none() && summary.is_loaded() && below > held).then(|| {
        format!(
            "Tensions of least norm without the load are near tension_limits.min: with the lengths kept the \
             load takes some below it at {}. --tension-reference mid chooses others.",
            counted(below, "position")
        )
    })
}
