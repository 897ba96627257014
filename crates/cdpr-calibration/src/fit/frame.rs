//! The place of a tracker: the rigid motion between the positions that it measures and those of the model.

use crate::campaign::Quantity;
use crate::error::CalibrationError;
use crate::fit::problem::Problem;
use crate::plausible::MissingLength;
use crate::sensor_error::size;
use cdpr_robot::{Axis, Pose, Rotation3, Vector3};
use nalgebra::Matrix3;

/// A misfit above this share of the robot's size is more than sag and tolerances make.
const FAR: f64 = 0.05;

/// Share of the misfit that is left where a rigid motion explains it.
const LEFT: f64 = 0.2;

/// Coordinates of which the sign is changed: none, or one of them.
const SIGNS: [[f64; 3]; 4] = [[1.0; 3], [-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0]];

/// Rows that are looked at.
const FEW: usize = 12;

/// `y = rotation x + translation`, where it fits pairs (x, y) best.
pub(super) struct RigidMotion {
    pub(super) rotation: Rotation3<f64>,
    pub(super) translation: Vector3<f64>,
    /// Root mean square of `y - x`, and of what the motion leaves of it.
    misfit: [f64; 2],
}

impl RigidMotion {
    /// The best motion between three pairs or more (Kabsch 1976).
    pub(super) fn between(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Self> {
        if pairs.len() < 3 {
            return None;
        }
        let count = pairs.len() as f64;
        let sum = pairs.iter().fold((Vector3::zeros(), Vector3::zeros()), |s, p| (s.0 + p.0, s.1 + p.1));
        let (from, to) = (sum.0 / count, sum.1 / count);
        let scatter: Matrix3<f64> = pairs.iter().map(|(a, b)| (b - to) * (a - from).transpose()).sum();
        let svd = scatter.svd(true, true);
        let (u, v) = (svd.u?, svd.v_t?);
        let sign = (u * v).determinant().signum();
        let turn = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v;
        let translation = to - turn * from;
        let squares = pairs.iter().fold([0.0; 2], |[apart, left], (a, b)| {
            [apart + (b - a).norm_squared(), left + (b - turn * a - translation).norm_squared()]
        });
        let misfit = squares.map(|sum| (sum / count).sqrt());
        Some(Self { rotation: Rotation3::from_matrix_unchecked(turn), translation, misfit })
    }

    /// What it does for positions that are off by `before` [m], and the remedy.
    fn needed(&self, before: f64) -> String {
        let [x, y, z] = [self.translation.x, self.translation.y, self.translation.z];
        format!(
            "with the lengths they fit to {:.3} m after a rotation by {:.1} degrees and a translation by ({x:.3}, \
             {y:.3}, {z:.3}) m, to {before:.3} m without; seek the place of the tracker, `frame`",
            self.misfit[1],
            self.rotation.angle().to_degrees()
        )
    }
}

impl Problem<'_> {
    /// The positions of the model and those that are measured, of P or else of the first marker.
    pub(super) fn seen(&self, poses: &[Pose]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let seen = |(row, pose): (&crate::Row, &Pose)| {
            let marker = |axis| row.value(Quantity::Marker(0, axis));
            let measured = self.model.measured_pose(row).map(|pose| pose.position);
            let seen = measured.or_else(|| {
                let [x, y, z] = Axis::ALL.map(marker);
                Some(Vector3::new(x?, y?, z?))
            });
            Some((pose.position, seen?))
        };
        self.rows.iter().zip(poses).filter_map(seen).collect()
    }

    /// Refuses positions of rows that are not those of the lengths, but are after a rigid motion: they are in
    /// the frame of a tracker. So it does where one coordinate has the other sign, and where a constant in
    /// all lengths explains more than any motion.
    ///
    /// # Errors
    /// [`CalibrationError::Column`] that says which coordinate has the other sign, how far the frame is and
    /// by how much it is turned, or the constant.
    pub(super) fn check_frame(
        &self,
        rows: &[crate::Row],
        constant: Option<MissingLength>,
    ) -> Result<(), CalibrationError> {
        let x = vec![0.0; self.model.unknowns.all.len()];
        let far = FAR * size(self.model.robot);
        let read = |row: &&crate::Row| row.lengths.is_some() && self.model.measured_pose(row).is_some();
        let every = rows.len().div_ceil(FEW).max(1);
        let mut pairs = Vec::new();
        for row in rows.iter().filter(read).step_by(every) {
            let (Some(measured), Ok(pose)) = (self.model.measured_pose(row), self.model.by_lengths(row, &x))
            else {
                continue;
            };
            pairs.push((pose.position, measured.position));
        }
        let with_signs = |sign: [f64; 3]| {
            let pairs: Vec<_> =
                pairs.iter().map(|(at, seen)| (*at, seen.component_mul(&Vector3::from(sign)))).collect();
            RigidMotion::between(&pairs)
        };
        let found: Vec<RigidMotion> = SIGNS.into_iter().filter_map(with_signs).collect();
        let left = found.iter().map(|of| of.misfit[1]).fold(f64::INFINITY, f64::min);
        if let Some(constant) = constant.filter(|constant| constant.left < left) {
            return Err(constant.refusal());
        }
        let [as_read, mirrored @ ..] = &found[..] else { return Ok(()) };
        let [before, after] = as_read.misfit;
        if before < far {
            return Ok(());
        }
        // Of positions in a plane a mirror is a rotation, too: the smaller change is the likelier one.
        let fits = |left: f64| left <= LEFT * before;
        let other_sign = |is: &dyn Fn(&RigidMotion) -> bool| {
            let all = Axis::ALL.into_iter().zip(mirrored).filter(|(_, of)| is(of));
            all.min_by(|one, other| one.1.misfit[0].total_cmp(&other.1.misfit[0]))
        };
        if let Some((axis, RigidMotion { misfit: [left, _], .. })) = other_sign(&|of| fits(of.misfit[0])) {
            let expected = format!(
                "the other sign: with the lengths the positions then fit to {left:.3} m, to {before:.3} m as they \
                 are"
            );
            return Err(CalibrationError::Column { column: Quantity::Position(axis).to_string(), expected });
        }
        if !fits(after) {
            let Some((axis, moved)) = other_sign(&|of| fits(of.misfit[1])) else { return Ok(()) };
            let expected = format!(
                "a frame of the other hand: {} with the other sign, then {}",
                Quantity::Position(axis),
                moved.needed(before)
            );
            return Err(CalibrationError::Column { column: "x_m, y_m, z_m".to_owned(), expected });
        }
        let expected = format!("positions in the base frame of the robot: {}", as_read.needed(before));
        Err(CalibrationError::Column { column: "x_m, y_m, z_m".to_owned(), expected })
    }
}
