//! Derivatives of an equilibrium by all inputs, and by the lengths of its cables.

use crate::equations::{CableDerivatives, Inputs, Partials, Pins, Reading, read, solve};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_robot::{CableEnd, Matrix6xX, Vector3};
use nalgebra::DMatrix;

/// Derivatives of an equilibrium; columns as in [`super::Derivatives`].
#[derive(Clone, Debug, PartialEq)]
pub struct EquilibriumDerivatives {
    /// Derivatives of the pose: (dp, dφ) in the base frame, `R <- exp(dφ) R`, 6 x count [m, rad per unit].
    pub pose: Matrix6xX<f64>,
    /// Derivatives of the tensions at the platform, n x count [N per unit].
    pub tensions: DMatrix<f64>,
}

impl DirectProblem<'_> {
    /// Derivatives of an equilibrium for *given* lengths, which do not change with the parameters: neither
    /// tension offsets nor the wanted pose matter. Along constrained motions and those that nothing resists
    /// they are
    /// zero.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable;
    /// [`StaticsError::NoDerivative`] at the border of stability.
    pub fn derivatives(&self, equilibrium: &Equilibrium) -> Result<EquilibriumDerivatives, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        EquilibriumDerivatives::new(self, &Inputs::of(self.robot), equilibrium, None)
    }
}

/// Derivatives of an equilibrium by all inputs and by the unstrained length of every cable.
///
/// Each matrix has the columns of [`Inputs`] followed by one for each length. A length changes alone; so does
/// an input, while all lengths stay the same.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceDerivatives {
    /// Derivatives of the pose: (dp, dφ) in the base frame, `R <- exp(dφ) R` [m, rad per unit].
    pub pose: Matrix6xX<f64>,
    /// Force with which each cable pulls at that end, in the base frame [N]: on the platform, or on its
    /// guide.
    pub forces: Vec<Vector3<f64>>,
    /// Derivatives of these forces, rows 3i to 3i + 2 for cable i [N per unit].
    pub per_input: DMatrix<f64>,
}

impl DirectProblem<'_> {
    /// Derivatives of an equilibrium, with those by the lengths and with the forces at an end of the cables
    /// as vectors: what measurements of any kind are compared with.
    ///
    /// # Errors
    /// As [`DirectProblem::derivatives`].
    pub fn force_derivatives(
        &self,
        equilibrium: &Equilibrium,
        end: CableEnd,
    ) -> Result<ForceDerivatives, StaticsError> {
        self.vector_derivatives(equilibrium, |i, cable| match end {
            CableEnd::Anchor => cable.clone(),
            CableEnd::Exit => {
                let at = self.catenary(i, equilibrium.cable_forces[i]);
                cable.of_pull(self.robot, &equilibrium.pose, i, &at)
            }
        })
    }

    /// The same of `-K3_i d_i`, the change of the force of cable i on the platform by a motion d_i of its
    /// anchor point [m] that is constant in the base frame, in the place of the forces.
    ///
    /// # Errors
    /// As [`DirectProblem::derivatives`].
    pub fn resistance_derivatives(
        &self,
        equilibrium: &Equilibrium,
        motions: &[Vector3<f64>],
    ) -> Result<ForceDerivatives, StaticsError> {
        let given = motions.len();
        if given != self.cables() {
            let expected = format!("{} of them, one for each cable", self.cables());
            return Err(StaticsError::invalid("motions".to_owned(), given.to_string(), expected));
        }
        self.vector_derivatives(equilibrium, |i, cable| {
            let at = self.catenary(i, equilibrium.cable_forces[i]);
            cable.of_stiffness(self.robot, &equilibrium.pose, i, &at, motions[i])
        })
    }

    /// Derivatives of one vector of each cable, in the place of its force.
    fn vector_derivatives(
        &self,
        equilibrium: &Equilibrium,
        vector: impl Fn(usize, &CableDerivatives) -> CableDerivatives,
    ) -> Result<ForceDerivatives, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let inputs = Inputs::of(self.robot);
        let (n, count) = (self.cables(), inputs.count());
        let mut lengths = DMatrix::zeros(n, count + n);
        (0..n).for_each(|i| lengths[(i, count + i)] = 1.0);
        let pose = EquilibriumDerivatives::new(self, &inputs, equilibrium, Some(&lengths))?.pose;
        let cables = CableDerivatives::all(self, &equilibrium.pose, &equilibrium.cable_forces);
        let cables: Vec<_> = cables.iter().enumerate().map(|(i, cable)| vector(i, cable)).collect();
        let mut per_input = DMatrix::zeros(3 * n, count + n);
        let columns = inputs.pose();
        for (axis, unit) in [Vector3::x(), Vector3::y(), Vector3::z()].into_iter().enumerate() {
            let along = |_: &CableDerivatives| Reading { per_force: unit, per_arm: Vector3::zeros() };
            let mut at_rest = read(&inputs, &equilibrium.pose, &cables, along);
            let per_motion = at_rest.columns(columns.start, 6).into_owned();
            at_rest.columns_mut(columns.start, 6).fill(0.0);
            let moved = per_motion * &pose;
            for (i, cable) in cables.iter().enumerate() {
                let mut row = per_input.row_mut(3 * i + axis);
                row += moved.row(i);
                let mut of_inputs = row.columns_mut(0, count);
                of_inputs += at_rest.row(i);
                row[count + i] += cable.per_actuation[axis];
            }
        }
        Ok(ForceDerivatives { pose, forces: cables.iter().map(|cable| cable.force).collect(), per_input })
    }
}

impl EquilibriumDerivatives {
    /// Equation (D8), for lengths with these derivatives.
    pub(super) fn new(
        problem: &DirectProblem,
        inputs: &Inputs,
        equilibrium: &Equilibrium,
        length_derivatives: Option<&DMatrix<f64>>,
    ) -> Result<Self, StaticsError> {
        let Equilibrium { pose, cable_forces } = equilibrium;
        let cables = CableDerivatives::all(problem, pose, cable_forces);
        let mut partials =
            Partials::new(problem.robot, inputs, pose, &problem.load, &cables, Reading::tension);
        let (hessian, tensions_per_motion) = partials.take_pose(inputs);
        let pins = Pins::new(problem, equilibrium, &(-0.5 * (hessian + hessian.transpose())));
        let Partials { mut balance, readings: mut tensions } = partials;
        if let Some(lengths) = length_derivatives {
            if lengths.ncols() > inputs.count() {
                balance.resize_horizontally_mut(lengths.ncols(), 0.0);
                tensions.resize_horizontally_mut(lengths.ncols(), 0.0);
            }
            let per_actuation: Vec<_> = cables.iter().map(CableDerivatives::wrench_per_actuation).collect();
            balance.gemm(1.0, &Matrix6xX::from_columns(&per_actuation), lengths, 1.0);
            for (i, cable) in cables.iter().enumerate() {
                let mut row = tensions.row_mut(i);
                row += lengths.row(i) * cable.direction.dot(&cable.per_actuation);
            }
        }
        balance.neg_mut();
        pins.take(&mut balance);
        solve(pins.pinned(&hessian, -1.0), &mut balance, "the equilibrium")?;
        tensions.gemm(1.0, &tensions_per_motion, &balance, 1.0);
        Ok(Self { pose: balance, tensions })
    }

    /// The columns from `count` on, which the derivatives lose.
    pub(super) fn split_off(&mut self, count: usize) -> Self {
        let last = self.pose.columns(count, self.pose.ncols() - count).into_owned();
        if last.ncols() > 0 {
            self.pose.resize_horizontally_mut(count, 0.0);
        }
        Self { pose: last, tensions: split_off(&mut self.tensions, count) }
    }
}

/// The columns from `count` on, which the matrix loses.
pub(super) fn split_off(matrix: &mut DMatrix<f64>, count: usize) -> DMatrix<f64> {
    let last = matrix.columns(count, matrix.ncols() - count).into_owned();
    if last.ncols() > 0 {
        matrix.resize_horizontally_mut(count, 0.0);
    }
    last
}
