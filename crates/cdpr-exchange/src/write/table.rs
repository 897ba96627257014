//! Unstrained lengths on a grid of positions, for firmware that interpolates.
//!
//! A line of the table has a position, the unstrained length L_i of each cable, and its correction c_i, which
//! is L_i less the distance d_i of the exit point from the anchor point: stretch, sag and pulleys. Firmware
//! that computes distances adds the corrections, interpolated linearly along each axis (multilinear, P = P_x
//! P_y P_z):
//!
//! ```text
//! I - P = (I - P_x) + P_x (I - P_y) + P_x P_y (I - P_z),      |P_k f| <= max |f|                    (FW2)
//! ```
//!
//! The error is therefore at most the sum of the errors along the axes. Along an axis it is a second
//! difference, which is greatest in the middle between two positions where the function is smooth. Where a
//! tension reaches its limit there, the function has a bend, and the error is at most twice the difference in
//! the middle. The bound is twice the greatest difference found in the middle between any two neighbours of
//! the grid, summed over the axes. It is measured there, and no proof. Errors of the lengths move the
//! platform, to first order, by
//!
//! ```text
//! |dp| <= sum |dp/dL_i| |dL_i|                                                                      (FW3)
//! ```

use crate::error::ExchangeError;
use crate::write::anchors::{anchors, millimetres};
use crate::write::scene::Exported;
use cdpr_robot::{Pose, Robot, Rotation3, Vector3, significant};
use cdpr_statics::{DirectProblem, InverseSolution, Load, StaticsError, inverse};
use std::fmt::Write;

/// A table of lengths and corrections, and what interpolation in it adds.
#[derive(Clone, Debug)]
pub struct CorrectionTable {
    /// The table, CSV in millimetres, and notes.
    pub exported: Exported,
    /// Bounds of the errors of interpolated values.
    pub errors: TableErrors,
}

/// Bounds of the errors of values that are interpolated linearly along each axis of a table: twice the
/// greatest error in the middle between two positions, summed over the axes. They are measured, and not
/// proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableErrors {
    /// Error of an interpolated length [m].
    pub length: f64,
    /// Way of the platform by errors of all interpolated lengths, to first order [m].
    pub position: f64,
    /// Error of a distance with its interpolated correction [m].
    pub corrected_length: f64,
    /// Way of the platform by errors of all corrected distances, to first order [m].
    pub corrected_position: f64,
}

/// Most positions of a table.
const MOST: usize = 100_000;

/// Error by which a length that is written is rounded [m].
const ROUNDING: f64 = 1e-9;

/// The unstrained lengths of a platform with this rotation, without load, at all positions with these
/// coordinates along x, y and z [m], and bounds of what interpolation in them adds.
///
/// Each line is a position `x_mm`, `y_mm`, `z_mm`, z fastest, the lengths `length_1_mm`, ... of the inverse
/// model, and the corrections `correction_1_mm`, ...: lengths less the straight distances of exit and anchor
/// points.
///
/// ```
/// use cdpr_exchange::correction_table;
/// use cdpr_robot::{Robot, Rotation3};
///
/// let robot = Robot::from_library("cogiro")?;
/// let coordinates = [vec![-1.0, 0.0, 1.0], vec![-0.5, 0.5], vec![2.0]];
/// let table = correction_table(&robot, &Rotation3::identity(), &coordinates)?;
/// assert_eq!(table.exported.files[0].1.lines().count(), 1 + 3 * 2);
/// assert!(table.errors.corrected_length < 1e-2 * table.errors.length);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ExchangeError::Grid`] unless the coordinates are finite and increase, and for more than 100 000
/// positions; [`ExchangeError::Position`] for a position that is not held, or at the border of stability.
pub fn correction_table(
    robot: &Robot,
    rotation: &Rotation3<f64>,
    coordinates: &[Vec<f64>; 3],
) -> Result<CorrectionTable, ExchangeError> {
    check(coordinates)?;
    let samples = Sampler { robot, rotation, anchors: anchors(robot, &at(rotation, Vector3::zeros())) };
    let nodes = samples.solve(coordinates)?;
    let (mut lengths, mut corrections) = (samples.zeros(), samples.zeros());
    for axis in (0..3).filter(|axis| coordinates[*axis].len() > 1) {
        let mut between = coordinates.clone();
        between[axis] = coordinates[axis].windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
        let middles = samples.solve(&between)?;
        let counts = [0, 1, 2].map(|k| coordinates[k].len());
        let [of_length, of_correction] = differences(&nodes, counts, &middles, axis);
        add(&mut lengths, &of_length);
        add(&mut corrections, &of_correction);
    }
    let bounds = |sums: &[f64]| sums.iter().map(|sum| 2.0 * sum + ROUNDING).collect::<Vec<_>>();
    let (lengths, corrections) = (bounds(&lengths), bounds(&corrections));
    let [position, corrected_position] = samples.ways(&nodes, [&lengths, &corrections])?;
    let greatest = |bounds: &[f64]| bounds.iter().copied().fold(0.0, f64::max);
    let errors = TableErrors {
        length: greatest(&lengths),
        position,
        corrected_length: greatest(&corrections),
        corrected_position,
    };
    let notes = notes(robot, &errors);
    let exported = Exported { files: vec![(".csv", text(&nodes))], notes };
    Ok(CorrectionTable { exported, errors })
}

/// Refuses coordinates that are no grid.
fn check(coordinates: &[Vec<f64>; 3]) -> Result<(), ExchangeError> {
    for (axis, along) in ["x", "y", "z"].into_iter().zip(coordinates) {
        let increase = along.windows(2).all(|pair| pair[0] < pair[1]);
        if along.is_empty() || !increase || !along.iter().all(|value| value.is_finite()) {
            return Err(ExchangeError::Grid {
                field: format!("coordinates along {axis}"),
                value: format!("a list of {}", along.len()),
                expected: "finite numbers that increase [m]".to_owned(),
            });
        }
    }
    let count = coordinates.iter().try_fold(1_usize, |count, along| count.checked_mul(along.len()));
    if count.is_none_or(|count| count > MOST) {
        return Err(ExchangeError::Grid {
            field: "positions".to_owned(),
            value: coordinates.each_ref().map(|along| along.len().to_string()).join(" x "),
            expected: format!("at most {MOST} of them in a table"),
        });
    }
    Ok(())
}

/// A pose with a rotation.
fn at(rotation: &Rotation3<f64>, position: Vector3<f64>) -> Pose {
    Pose { position, rotation: *rotation }
}

/// A position with its lengths.
struct Sample {
    solution: InverseSolution,
    /// Lengths less distances [m].
    corrections: Vec<f64>,
}

/// The inverse model on grids.
struct Sampler<'a> {
    robot: &'a Robot,
    rotation: &'a Rotation3<f64>,
    /// Exit points less the lever arms of the anchor points [m].
    anchors: Vec<Vector3<f64>>,
}

impl Sampler<'_> {
    /// One for each cable.
    fn zeros(&self) -> Vec<f64> {
        vec![0.0; self.anchors.len()]
    }

    /// Positions with these coordinates, z fastest.
    fn solve(&self, [x, y, z]: &[Vec<f64>; 3]) -> Result<Vec<Sample>, ExchangeError> {
        let mut poses = Vec::with_capacity(x.len() * y.len() * z.len());
        for x in x {
            for y in y {
                poses.extend(z.iter().map(|z| at(self.rotation, Vector3::new(*x, *y, *z))));
            }
        }
        let solutions = inverse(self.robot, &poses, &Load::none());
        let sample = |(pose, solution): (&Pose, Result<InverseSolution, _>)| {
            let solution = solution.map_err(|error: StaticsError| refusal(pose, error.to_string()))?;
            let correction =
                |(anchor, length): (&Vector3<f64>, &f64)| length - (pose.position - anchor).norm();
            let corrections = self.anchors.iter().zip(&solution.lengths).map(correction).collect();
            Ok(Sample { solution, corrections })
        };
        poses.iter().zip(solutions).map(sample).collect()
    }

    /// The greatest ways of the platform by errors of the lengths, (FW3) [m].
    fn ways(&self, nodes: &[Sample], errors: [&[f64]; 2]) -> Result<[f64; 2], ExchangeError> {
        let mut greatest = [0.0_f64; 2];
        for Sample { solution, .. } in nodes {
            let InverseSolution { lengths, equilibrium, .. } = solution;
            let found = DirectProblem::new(self.robot, lengths, &Load::none())
                .and_then(|problem| problem.linearize(equilibrium));
            let per_length =
                found.map_err(|error| refusal(&equilibrium.pose, error.to_string()))?.pose_per_length();
            let norms = per_length.column_iter().map(|column| column.fixed_rows::<3>(0).norm());
            let norms: Vec<f64> = norms.collect();
            for (greatest, errors) in greatest.iter_mut().zip(errors) {
                let way: f64 = norms.iter().zip(errors).map(|(norm, error)| norm * error).sum();
                if !way.is_finite() {
                    let reason = "the platform is at the border of stability".to_owned();
                    return Err(refusal(&equilibrium.pose, reason));
                }
                *greatest = greatest.max(way);
            }
        }
        Ok(greatest)
    }
}

fn refusal(pose: &Pose, reason: String) -> ExchangeError {
    ExchangeError::Position { position: pose.position.into(), reason }
}

/// Greatest differences, along an axis, of each cable's length and correction in the middle between two nodes
/// from the mean of the two [m].
fn differences(nodes: &[Sample], counts: [usize; 3], middles: &[Sample], axis: usize) -> [Vec<f64>; 2] {
    let cables = nodes.first().map_or(0, |node| node.corrections.len());
    let mut greatest = [vec![0.0; cables], vec![0.0; cables]];
    // Nodes that follow each other along the axis are this many apart, and so are middles.
    let step: usize = counts[axis + 1..].iter().product();
    for (k, middle) in middles.iter().enumerate() {
        let (outer, inner) = (k / step, k % step);
        let (block, along) = (outer / (counts[axis] - 1), outer % (counts[axis] - 1));
        let first = (block * counts[axis] + along) * step + inner;
        let ends = [&nodes[first], &nodes[first + step]];
        let lengths = |sample: &Sample| sample.solution.lengths.clone();
        let values = [ends.map(lengths), ends.map(|end| end.corrections.clone())];
        let means = [&middle.solution.lengths, &middle.corrections];
        for ((greatest, [one, other]), middle) in greatest.iter_mut().zip(values).zip(means) {
            for (i, greatest) in greatest.iter_mut().enumerate() {
                let difference = middle[i] - 0.5 * (one[i] + other[i]);
                *greatest = f64::max(*greatest, difference.abs());
            }
        }
    }
    greatest
}

fn add(sums: &mut [f64], terms: &[f64]) {
    sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
}

/// The table as CSV.
fn text(nodes: &[Sample]) -> String {
    let cables = nodes.first().map_or(0, |node| node.corrections.len());
    let names = |name: &str| (1..=cables).map(|i| format!(",{name}_{i}_mm")).collect::<String>();
    let mut text = format!("x_mm,y_mm,z_mm{}{}\n", names("length"), names("correction"));
    for Sample { solution, corrections } in nodes {
        let position = solution.equilibrium.pose.position;
        let row =
            position.iter().chain(&solution.lengths).chain(corrections).map(|value| millimetres(*value));
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{}", row.collect::<Vec<_>>().join(","));
    }
    text
}

fn notes(robot: &Robot, errors: &TableErrors) -> Vec<String> {
    let mm = |value: f64| significant(1e3 * value, 3);
    let mut notes = vec![
        format!(
            "interpolated lengths are wrong by at most {} mm, which moves the platform by at most {} mm",
            mm(errors.length),
            mm(errors.position)
        ),
        format!(
            "distances with interpolated corrections are wrong by at most {} mm, which moves it by at most \
             {} mm",
            mm(errors.corrected_length),
            mm(errors.corrected_position)
        ),
        "these bounds are twice the greatest errors in the middle between neighbours, summed over the axes: \
         measured, not proved"
            .to_owned(),
    ];
    if robot.cables.len() > robot.freedoms().count() {
        notes.push(format!(
            "with {} cables for {} motions, errors of lengths change tensions, too",
            robot.cables.len(),
            robot.freedoms().count()
        ));
    }
    notes
}
