//! Maps of a plane, and workspaces that are not a plane.

use crate::figures::{lines as lines_of, rectangles, texts};
use cdpr_assess::{
    AnyWeather, BoundarySummary, Further, PartialFactors, ShakingSummary, TiltDirections, Way, Workspace,
    WorkspaceRow, WorkspaceSummary, WrenchSet, compute_workspace, workspace_boundary,
};
use cdpr_report::{MapQuantity, ReportError, Sheet, heat_map, tolerance_map, workspace_maps};
use cdpr_robot::{Axis, Matrix3, Robot, Rotation3, Vector3};
use cdpr_statics::Load;
use cdpr_study::{Grid, GridAxis};

fn caroca() -> Robot {
    Robot::from_json(include_str!("../../../data/robots/caroca.json")).unwrap()
}

fn summary(robot: &Robot, grid: Grid) -> WorkspaceSummary {
    summary_with(robot, grid, Further::default())
}

fn summary_with(robot: &Robot, grid: Grid, further: Further) -> WorkspaceSummary {
    let workspace = Workspace {
        robot,
        grid,
        rotation: Rotation3::identity(),
        load: Load::payload(50.0),
        tolerances: None,
        free: &[],
        further,
    };
    WorkspaceSummary::new(&workspace, &compute_workspace(&workspace, &|| (), &|| false).unwrap())
}

/// What shakes a platform whose amplitudes are given.
const SHAKING: ShakingSummary = ShakingSummary {
    band_hz: [0.0, 8.0],
    damping_s: 1e-3,
    drag_per_s: 0.5,
    marker: [0.0; 3],
    inertia_assumed: false,
};

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

#[test]
fn a_map_has_every_cell_the_hatching_the_frame_and_the_exit_points() {
    let mut robot = caroca();
    // Maps of natural frequencies need an inertia: that of a box of 0.4 m by 0.3 m by 0.25 m.
    robot.platform.inertia = Some(Matrix3::from_diagonal(&Vector3::new(2.3, 3.3, 3.8)));
    let further = Further {
        capacity: Some(&WrenchSet::of(Vec::new())),
        distances: true,
        tilt: Some(TiltDirections { count: 4, accuracy: 0.02 }),
        shaking: None,
        weather: Some(AnyWeather { speed: Some(15.0), ..AnyWeather::default() }),
        breaks: Some(PartialFactors::ONE),
    };
    let mut summary = summary_with(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap(), further);
    summary.shaking = Some(SHAKING);
    for row in &mut summary.rows {
        (row.amplitude_mm_per_n, row.winch_mm_per_mm) = (row.magnitude_mm, row.magnitude_mm);
    }
    let count_held = |of: &dyn Fn(&WorkspaceRow) -> bool| summary.rows.iter().filter(|row| of(row)).count();
    let kept = 63 - count_held(&|row| row.status == "held");
    let recomputed = 63 - count_held(&|row| row.recomputed_status == Some("held"));
    assert!(recomputed > 0 && kept >= recomputed && kept < 63, "{kept} {recomputed}");
    let without = |value: fn(&WorkspaceRow) -> Option<f64>| {
        summary.rows.iter().filter(|row| value(row).is_none()).count()
    };
    for quantity in MapQuantity::ALL {
        let (not_held, words) = match quantity {
            MapQuantity::GreatestTensionRecomputed => (recomputed, "tensions recomputed"),
            MapQuantity::PayloadRecomputed => {
                (without(|row| row.payload_recomputed_kg), "tensions recomputed")
            }
            MapQuantity::PayloadKept => (without(|row| row.payload_kept_kg), "lengths kept"),
            MapQuantity::MarginRecomputed => {
                (without(|row| row.margin_recomputed_n), "distance of the tensions")
            }
            MapQuantity::NearestCables => (without(|row| row.nearest_cables_mm), "nearest two cables"),
            MapQuantity::NearestToPlatform => (without(|row| row.nearest_to_platform_mm), "and platform"),
            MapQuantity::Tilt => (without(|row| row.tilt_deg), "worst direction"),
            MapQuantity::Amplitude => (without(|row| row.amplitude_mm_per_n), "shaken from 0 Hz to 8 Hz"),
            MapQuantity::WinchAmplitude => (without(|row| row.winch_mm_per_mm), "drag 0.5 1/s"),
            MapQuantity::Utilization => (without(|row| row.utilization), "after each break"),
            MapQuantity::AfterBreak => (without(|row| row.break_moved_mm), "after the worst break"),
            MapQuantity::Weather => {
                (without(|row| row.weather_moved_mm), "wind of 15 m/s from any direction")
            }
            _ => (kept, "lengths kept"),
        };
        assert!(not_held < 63, "{quantity:?}");
        let svg = heat_map(&robot, &summary, quantity, Sheet::SCREEN).unwrap();
        // The paper, 63 cells, 128 steps of the colour bar; grey for a cell without value and for the key's
        // bar as a line.
        assert_eq!(rectangles(&svg), 63 + 128, "{quantity:?}");
        assert_eq!(count(&svg, "fill=\"#B0B0B0\""), not_held);
        assert_eq!(count(&svg, "<circle"), 8);
        for words in
            ["CAROCA: ", "at z = 1.75 m, payload 50 kg", "x [m]", "y [m]", "frame of the exit points", words]
        {
            assert!(svg.contains(words), "{quantity:?}: {words}");
        }
        assert_eq!(svg, heat_map(&robot, &summary, quantity, Sheet::SCREEN).unwrap());
    }
}

#[test]
fn each_position_has_the_colour_of_its_dominant_tolerance() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    assert!(matches!(tolerance_map(&robot, &summary, Sheet::SCREEN), Err(ReportError::Empty { .. })));
    let held = |row: &&mut WorkspaceRow| row.status == "held";
    for (k, row) in summary.rows.iter_mut().filter(held).enumerate() {
        row.dominant = Some(if k < 2 { "a1.x" } else { "youngs_modulus" }.to_owned());
    }
    let svg = tolerance_map(&robot, &summary, Sheet::SCREEN).unwrap();
    let held = summary.rows.iter().filter(|row| row.status == "held").count();
    // Cells; the key has a bar of each name.
    assert_eq!(rectangles(&svg), 63);
    let blue = count(&svg, "fill=\"#0072B2\"");
    assert_eq!((blue, count(&svg, "fill=\"#56B4E9\"")), (held - 2, 2));
    assert!(svg.contains("youngs_modulus") && svg.contains("a1.x") && svg.contains("of 63 positions"));
}

#[test]
fn a_load_beyond_the_limits_is_coloured_and_hatched() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    let lines = |summary: &WorkspaceSummary| {
        lines_of(&heat_map(&robot, summary, MapQuantity::Deflection, Sheet::SCREEN).unwrap())
    };
    let before = lines(&summary);
    summary.rows[31].status = "beyond_limits";
    assert_eq!(lines(&summary), before + 1);
}

#[test]
fn a_box_and_a_plane_without_any_held_position_have_no_map() {
    let robot = caroca();
    let axis = |min, max, points| GridAxis { min, max, points };
    let solid = Grid::new([axis(0.0, 1.0, 2), axis(0.0, 1.0, 2), axis(1.0, 2.0, 2)]).unwrap();
    let error =
        heat_map(&robot, &summary(&robot, solid), MapQuantity::Deflection, Sheet::SCREEN).unwrap_err();
    assert!(error.to_string().ends_with("expected one coordinate along one axis: a plane"), "{error}");
    let above = Grid::over_frame(&robot, Axis::Z, 9.0, [3, 3]).unwrap();
    let error =
        heat_map(&robot, &summary(&robot, above), MapQuantity::Deflection, Sheet::SCREEN).unwrap_err();
    assert!(matches!(error, ReportError::Empty { .. }), "{error}");
}

#[test]
fn amplitudes_over_powers_of_ten_have_colours_by_their_logarithm() {
    let robot = caroca();
    let grid = Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap();
    let mut summary = summary(&robot, grid);
    summary.shaking = Some(SHAKING);
    let mut draw = |least: f64| {
        for (k, row) in summary.rows.iter_mut().enumerate() {
            row.amplitude_mm_per_n = Some(least.powf(1.0 - k as f64 / 62.0));
        }
        heat_map(&robot, &summary, MapQuantity::Amplitude, Sheet::SCREEN).unwrap()
    };
    // One color for each cell: equal ratios are equal steps.
    let colors = |svg: &str| {
        let cells = svg.split("<rect").skip(2).take(63);
        cells.map(|cell| cell.split("fill=").nth(1).unwrap()[1..8].to_owned()).collect::<Vec<_>>()
    };
    let (four, two) = (draw(1e-4), draw(1e-2));
    assert_eq!(colors(&four), colors(&two));
    let less = draw(0.2);
    assert_ne!(colors(&two), colors(&less));
    let has = |svg: &str, text: &str| svg.lines().any(|line| line.trim() == text);
    assert!(has(&four, "0.001") && has(&four, "0.01") && !has(&four, "0.02"), "{four}");
    assert!(has(&two, "0.02") && has(&two, "0.5") && has(&less, "0.5"), "{two}");
}

/// Rows with these values, spread over all of them.
fn with_values(
    summary: &mut WorkspaceSummary,
    set: impl Fn(&mut WorkspaceRow, f64),
    value: impl Fn(f64) -> f64,
) {
    let last = (summary.rows.len() - 1) as f64;
    for (k, row) in summary.rows.iter_mut().enumerate() {
        set(row, value(k as f64 / last));
    }
}

#[test]
fn every_quantity_over_powers_of_ten_has_colours_by_them_and_its_bar_says_so() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    // Stiffness [N/m] from 266 to 67363.
    let stiffness = |row: &mut WorkspaceRow, value| row.least_stiffness_n_per_m = Some(value);
    with_values(&mut summary, stiffness, |share| 266.0 * (67_363.0_f64 / 266.0).powf(share));
    let svg = heat_map(&robot, &summary, MapQuantity::LeastStiffness, Sheet::SCREEN).unwrap();
    let texts = texts(&svg);
    assert!(texts.iter().any(|text| text.starts_with("0.266 kN/m to 67.36 kN/m, colours by powers of ten")));
    for tick in ["0.5", "1", "10", "50"] {
        assert!(texts.contains(&tick), "{tick}: {texts:?}");
    }
    with_values(&mut summary, stiffness, |share| 1000.0 + 500.0 * share);
    let svg = heat_map(&robot, &summary, MapQuantity::LeastStiffness, Sheet::SCREEN).unwrap();
    assert!(!svg.contains("powers of ten"));
}

#[test]
fn margins_of_both_signs_have_a_line_at_zero_and_colours_for_both() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    let margin = |row: &mut WorkspaceRow, value| row.margin_recomputed_n = Some(value);
    with_values(&mut summary, margin, |share| 270.0 - 14_131.0 * share.powi(4));
    let svg = heat_map(&robot, &summary, MapQuantity::MarginRecomputed, Sheet::SCREEN).unwrap();
    for tick in ["0", "100", "\u{2212}100", "\u{2212}1000", "\u{2212}10000"] {
        assert!(texts(&svg).contains(&tick), "{tick}");
    }
    let colors: std::collections::BTreeSet<&str> = svg
        .split("<rect")
        .skip(2)
        .take(63)
        .filter_map(|cell| cell.split("fill=").nth(1))
        .map(|c| &c[1..8])
        .collect();
    assert!(colors.len() > 40, "{} colours of 63 cells", colors.len());
}

#[test]
fn payloads_below_a_gram_are_none() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    with_values(&mut summary, |row, value| row.payload_kept_kg = Some(value), |share| 1.7e-5 * share);
    let svg = heat_map(&robot, &summary, MapQuantity::PayloadKept, Sheet::SCREEN).unwrap();
    assert!(texts(&svg).iter().any(|text| text.starts_with("0 kg to 0 kg; ")), "{:?}", texts(&svg));
    assert_eq!(texts(&svg).iter().filter(|text| text.starts_with("payload [")).count(), 1);
    // The title says once how the load is borne.
    assert_eq!(count(&texts(&svg).join(" "), "lengths kept"), 1, "{:?}", texts(&svg));
}

#[test]
fn a_map_of_one_value_has_one_colour_and_one_tick() {
    let robot = caroca();
    let mut summary = summary(&robot, Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap());
    for (value, tick) in [(0.0, "0"), (12.5, "12.5"), (2e-9, "2\u{d7}10\u{207b}\u{2079}")] {
        // Rounding is no difference.
        with_values(
            &mut summary,
            |row, value| row.margin_recomputed_n = Some(value),
            |share| value * (1.0 + 1e-13 * share),
        );
        let svg = heat_map(&robot, &summary, MapQuantity::MarginRecomputed, Sheet::SCREEN).unwrap();
        let colors: std::collections::BTreeSet<&str> = svg
            .split("<rect")
            .skip(2)
            .filter_map(|cell| cell.split("fill=").nth(1))
            .map(|c| &c[1..8])
            .collect();
        assert_eq!(colors.len(), 1, "{value}: {colors:?}");
        // The last texts are those of the colour bar.
        let texts = texts(&svg);
        let bar = texts.iter().position(|text| text.starts_with("margin [N]")).unwrap();
        let numbers = |all: &[&str]| all.iter().filter(|text| **text == tick).count();
        assert!(numbers(&texts) >= 1, "{value}: {texts:?}");
        assert!(!texts[bar..].contains(&"0.4") && !texts[bar..].contains(&"\u{2212}0.4"), "{texts:?}");
    }
}

#[test]
fn a_boundary_that_is_computed_is_a_line_in_every_map_with_its_entry_in_the_key() {
    let robot = caroca();
    let plane = Grid::over_frame(&robot, Axis::Z, 1.75, [9, 7]).unwrap();
    let axis = |min, max, points| GridAxis { min, max, points };
    let solid = Grid::new([axis(-3.0, 3.0, 5), axis(-1.5, 1.5, 5), axis(1.0, 2.5, 4)]).unwrap();
    for (grid, count) in [(plane, 1), (solid, 4)] {
        let workspace = Workspace {
            robot: &robot,
            grid,
            rotation: Rotation3::identity(),
            load: Load::payload(50.0),
            tolerances: None,
            free: &[],
            further: Further::default(),
        };
        let mut summary =
            WorkspaceSummary::new(&workspace, &compute_workspace(&workspace, &|| (), &|| false).unwrap());
        let found = workspace_boundary(&workspace, Way::Recomputed, &|| false).unwrap();
        summary.boundary = Some(BoundarySummary::new(Way::Recomputed, &found));
        let without = workspace_maps(&robot, &summary, None, count, Sheet::SCREEN);
        let with = workspace_maps(&robot, &summary, Some(&found), count, Sheet::SCREEN);
        assert!(with.len() >= count && with.len() == without.len());
        for (with, without) in with.iter().zip(&without) {
            let ([with, without], name) = ([with, without].map(|map| map.svg.as_ref().unwrap()), &with.name);
            assert!(texts(with).contains(&"boundary, tensions recomputed"), "{name}");
            assert!(!texts(without).contains(&"boundary, tensions recomputed"), "{name}");
            // The line in the key, and the boundary twice, in black on white.
            assert!(lines_of(with) >= lines_of(without) + 3, "{name}");
            assert!(with.contains("stroke=\"#010101\" stroke-width=\"18\""), "{name}");
        }
    }
}
