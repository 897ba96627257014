//! Result files of assessments: tables as CSV, summaries as JSON.

use crate::boundary::Boundary;
use crate::robustness::{Answer, Refusal, RobustnessResult, RobustnessSummary, in_degrees};
use crate::workspace::summary::WorkspaceSummary;
use cdpr_robot::{Pose, Vector3};
use cdpr_study::{IfExists, ResultsFolder, ResultsOf, StudyError, read_result};
use serde::Deserialize;
use std::path::Path;

const WORKSPACE: &str = "workspace.json";

/// The boundary in a plane.
const POLYGONS: &str = "boundary.csv";

/// The boundary in a box.
const MESH: &str = "boundary.stl";

const ROBUSTNESS: &str = "robustness.json";

/// Makes a folder for a workspace and maps of these names, or takes one of an earlier workspace: before
/// anything is computed.
///
/// # Errors
/// As [`ResultsFolder::begin`].
pub fn begin_workspace(
    folder: &Path,
    if_exists: IfExists,
    maps: &[&str],
) -> Result<ResultsFolder, StudyError> {
    let is_map = |name: &str| {
        let name = name.strip_suffix(".svg");
        name.is_some_and(|name| maps.contains(&name.split_once("_z").map_or(name, |(map, _)| map)))
    };
    ResultsFolder::begin(folder, ResultsOf::Workspace, if_exists, |name| {
        [WORKSPACE, "workspace.csv", POLYGONS, MESH].contains(&name) || is_map(name)
    })
}

/// Writes `workspace.csv`, one row for each position, the maps (name and text), the boundary if there is one
/// (`boundary.csv` in a plane, `boundary.stl` in a box), and, last of all, `workspace.json`, the rows with
/// settings and extremes. Maps of an earlier workspace that are not among these are removed.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_workspace(
    folder: &ResultsFolder,
    summary: &WorkspaceSummary,
    maps: &[(String, String)],
    boundary: Option<&Boundary>,
) -> Result<(), StudyError> {
    folder.remove(WORKSPACE)?;
    folder.write_rows("workspace.csv", &summary.rows)?;
    write_figures(folder, maps)?;
    if let Some(boundary) = boundary {
        write_boundary(folder, boundary)?;
    }
    folder.conclude(WORKSPACE, summary, &[]).map(|_| ())
}

/// Writes the polygons, a point a line and each closed by its first point, or the mesh.
fn write_boundary(folder: &ResultsFolder, boundary: &Boundary) -> Result<(), StudyError> {
    if !boundary.triangles.is_empty() {
        return folder.write(MESH, &boundary.stl()).map(|_| ());
    }
    let header = ["polygon", "x_m", "y_m", "z_m"].map(str::to_owned).to_vec();
    let points = boundary.polygons.iter().enumerate().flat_map(|(k, polygon)| {
        let closed = polygon.iter().chain(polygon.first());
        closed.map(move |p| vec![(k + 1).to_string(), p.x.to_string(), p.y.to_string(), p.z.to_string()])
    });
    folder.write_csv(POLYGONS, header, points).map(|_| ())
}

/// The region of a workspace in which the platform is held, as a folder of results has it.
#[derive(Clone, Debug, PartialEq)]
pub struct FoundRegion {
    /// Name of the robot.
    pub robot: String,
    /// Hash of the robot ([`cdpr_study::robot_hash`]).
    pub robot_hash: String,
    /// How the load is borne: `recomputed` or `kept`.
    pub way: String,
    /// Mass added at the platform's centre of mass [kg].
    pub payload: f64,
    /// Area [m²] of polygons, volume [m³] of triangles.
    pub measure: f64,
    /// Closed polygons [m].
    pub polygons: Vec<Vec<Vector3<f64>>>,
    /// Triangles [m].
    pub triangles: Vec<[Vector3<f64>; 3]>,
}

/// Reads the boundary of a workspace from its folder.
///
/// # Errors
/// [`StudyError::Read`] for a folder without the results of a workspace; [`StudyError::Invalid`] for a
/// workspace without a boundary; [`StudyError::Changed`] for a file that was changed since.
pub fn read_region(folder: &Path) -> Result<FoundRegion, StudyError> {
    #[derive(Deserialize)]
    struct Summary {
        robot: String,
        robot_hash: String,
        payload: f64,
        boundary: Option<Region>,
    }
    #[derive(Deserialize)]
    struct Region {
        way: String,
        measure: f64,
        unit: String,
    }
    let read = |name: &str| read_result(folder, name);
    let wrong = |name: &str, field: &str, value: String, expected: &str| {
        StudyError::invalid(&folder.join(name), field, value, expected)
    };
    let summary: Summary = serde_json::from_slice(&read(WORKSPACE)?)
        .map_err(|error| wrong(WORKSPACE, "the file", error.to_string(), "the summary of a workspace"))?;
    let expected = "that of a workspace with its boundary";
    let missing = || wrong(WORKSPACE, "boundary", "null".to_owned(), expected);
    let Region { way, measure, unit } = summary.boundary.ok_or_else(missing)?;
    let (mut polygons, mut triangles) = (Vec::new(), Vec::new());
    if unit == "m2" {
        let text = read(POLYGONS)?;
        let mut reader = csv::Reader::from_reader(&text[..]);
        let mut last = 0;
        for row in reader.deserialize() {
            let (polygon, x, y, z): (usize, f64, f64, f64) =
                row.map_err(|error| wrong(POLYGONS, "a row", error.to_string(), "polygon,x_m,y_m,z_m"))?;
            if polygon != last {
                polygons.push(Vec::new());
            }
            last = polygon;
            polygons
                .last_mut()
                .into_iter()
                .for_each(|points: &mut Vec<_>| points.push(Vector3::new(x, y, z)));
        }
    } else {
        let mesh = Boundary::triangles_of(&read(MESH)?);
        triangles =
            mesh.ok_or_else(|| wrong(MESH, "the file", "of another form".to_owned(), "a binary STL file"))?;
    }
    let Summary { robot, robot_hash, payload, .. } = summary;
    Ok(FoundRegion { robot, robot_hash, way, payload, measure, polygons, triangles })
}

/// Makes a folder for the robustness of the direct model, or takes one of an earlier run.
///
/// # Errors
/// As [`ResultsFolder::begin`].
pub fn begin_robustness(folder: &Path, if_exists: IfExists) -> Result<ResultsFolder, StudyError> {
    let names = [ROBUSTNESS, "solves.csv", "refused.csv", "found_poses.svg", "success_share.svg"];
    ResultsFolder::begin(folder, ResultsOf::Robustness, if_exists, |name| names.contains(&name))
}

/// Writes `solves.csv`, `refused.csv`, the figures (name and text), and, last of all, `robustness.json`.
///
/// # Errors
/// As [`ResultsFolder::claim`].
pub fn write_robustness(
    folder: &ResultsFolder,
    summary: &RobustnessSummary,
    results: &[RobustnessResult],
    figures: &[(String, String)],
) -> Result<(), StudyError> {
    folder.remove(ROBUSTNESS)?;
    write_solves(folder, results)?;
    write_refused(folder, results)?;
    write_figures(folder, figures)?;
    folder.conclude(ROBUSTNESS, summary, &[]).map(|_| ())
}

fn write_figures(folder: &ResultsFolder, figures: &[(String, String)]) -> Result<(), StudyError> {
    figures.iter().try_for_each(|(name, svg)| {
        folder.write(&format!("{name}.svg"), svg.as_bytes())?;
        Ok(())
    })
}

/// Writes `solves.csv`: one row for each solve, with the true pose, the start, the pose found (position [m],
/// rotation vector [rad]), how
/// far it is from the true one, outcome, reason of a failure, method, iterations, residuals and wall time.
fn write_solves(folder: &ResultsFolder, results: &[RobustnessResult]) -> Result<(), StudyError> {
    let pose = |name: &str| Pose::COORDINATES.map(|axis| format!("{name}_{axis}"));
    let header = ["protocol", "draw", "start_distance_m", "start_angle_deg", "start_anchor_distance_m"];
    let header = header
        .into_iter()
        .map(str::to_owned)
        .chain(["true", "start", "found"].iter().flat_map(|name| pose(name)));
    let rest = [
        "error_m",
        "error_deg",
        "error_anchor_distance_m",
        "outcome",
        "reason",
        "method",
        "iterations",
        "closure_m",
        "force_n",
        "moment_nm",
        "us",
    ];
    let header = header.chain(rest.map(str::to_owned)).collect();
    let rows = results.iter().flat_map(|result| {
        result.solves.iter().map(|solve| {
            let offset = &result.protocol.starts[solve.start_offset];
            let mut record = vec![result.protocol.name.to_owned(), solve.draw.to_string()];
            let start = [offset.distance, in_degrees(offset.angle), solve.start_distance];
            record.extend(start.iter().map(ToString::to_string));
            record.extend(pose_cells(&solve.wanted).into_iter().chain(pose_cells(&solve.start)));
            let (answer, reason) = match &solve.answer {
                Ok(answer) => (Some(answer), solve.failure().unwrap_or_default().to_owned()),
                Err(error) => (None, format!("{}: {error}", error.kind())),
            };
            let found = answer.map(|a| pose_cells(&a.pose));
            record.extend(found.unwrap_or_default());
            let cell = |value: fn(&Answer) -> String| answer.map(value).unwrap_or_default();
            record.extend([
                cell(|a| format!("{:e}", a.distance)),
                cell(|a| format!("{:e}", a.angle.to_degrees())),
            ]);
            record.extend([
                cell(|a| format!("{:e}", a.anchor_distance)),
                solve.outcome(result.protocol.found_distance).name().to_owned(),
                reason,
            ]);
            record.extend([cell(|a| format!("{:?}", a.method)), cell(|a| a.iterations.to_string())]);
            record.extend([
                cell(|a| format!("{:e}", a.residual.closure)),
                cell(|a| format!("{:e}", a.residual.force)),
            ]);
            record
                .extend([cell(|a| format!("{:e}", a.residual.moment)), format!("{:.1}", solve.microseconds)]);
            record
        })
    });
    folder.write_csv("solves.csv", header, rows).map(|_| ())
}

/// Writes `refused.csv`: the rejected poses with the reason.
fn write_refused(folder: &ResultsFolder, results: &[RobustnessResult]) -> Result<(), StudyError> {
    let header = ["protocol", "draw"].into_iter().chain(Pose::COORDINATES).chain(["status", "reason"]);
    let rows = results.iter().flat_map(|result| {
        result.refused.iter().map(|refused| {
            let reason = match &refused.refusal {
                Refusal::Infeasible(error) => error.to_string(),
                Refusal::Unanswered(error) => format!("from the equilibrium: {error}"),
                Refusal::Unstable => "the direct model leaves the equilibrium".to_owned(),
            };
            let mut record = vec![result.protocol.name.to_owned(), refused.draw.to_string()];
            record.extend(pose_cells(&refused.pose));
            record.extend([refused.refusal.name().to_owned(), reason]);
            record
        })
    });
    folder.write_csv("refused.csv", header.map(str::to_owned).collect(), rows).map(|_| ())
}

/// Position [m] and rotation vector [rad].
fn pose_cells(pose: &Pose) -> [String; 6] {
    let motion = Pose::at(0.0, 0.0, 0.0).motion_to(pose);
    <[f64; 6]>::from(motion).map(|value| value.to_string())
}
