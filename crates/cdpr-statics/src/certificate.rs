//! Proof, in floating point, that an exact equilibrium lies within a stated distance of a computed one.
//!
//! With the `6 + 2n` equations `g(x) = 0`, an approximate inverse `Y` of their Jacobian and a box
//! `X = x̃ + [-r, r]`, Krawczyk's operator
//!
//! ```text
//! K(X) = x̃ - Y g(x̃) + (I - Y g'(X)) (X - x̃)
//! ```
//!
//! maps the box into its own interior only if X contains exactly one solution, which then lies in K(X)
//! (Krawczyk 1969; Moore, Kearfott, Cloud 2009, theorem 8.2). `g(x̃)` and `g'(X)` are evaluated with
//! intervals that are rounded outwards, by the same code as the equations themselves: the proof is about the
//! catenary, not about an approximation of it. The inputs, as doubles, are taken as exact.
//!
//! Rotations near R̃ are `R = cay(δ) R̃` with Cayley's map
//!
//! ```text
//! cay(δ) = I + ([δ] + [δ]²/2)/(1 + |δ|²/4),      dφ = (I + [δ]/2) dδ/(1 + |δ|²/4)
//! ```
//!
//! which needs no angle functions; |δ| is never less than the angle. R̃ is the exact rotation of the
//! quaternion in doubles.
//!
//! The Hessian H of the potential over the box, `A + B C⁻¹ Bᵀ` from the blocks of g', gives the stability.
//! With any matrix M, such as the inverse factor of the middle of H, `|M H Mᵀ - I| <= η < 1` over the box
//! makes H positive definite, its eigenvalues no less than `(1 - η)/λ_max(MᵀM)`.

use crate::dense::Lu;
use crate::direct::DirectSolution;
use crate::equations::{NEAR_VERTICAL, State, closure_row, jacobian, residual, skew};
use crate::error::StaticsError;
use crate::problem::DirectProblem;
use crate::state::Equilibrium;
use cdpr_number::{Interval, Real};
use cdpr_robot::{Matrix3, Vector3};
use nalgebra::{DMatrix, DVector, Matrix6, UnitQuaternion, Vector2};

/// Proof that the `6 + 2n` equations have exactly one solution in a box around the computed one, with bounds
/// on its distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Bound on the distance of P [m].
    pub position: f64,
    /// Bound on the angle [rad].
    pub rotation: f64,
    /// Bound on the error of every cable's end force (fx, fz) in its own plane [N].
    pub force: f64,
    /// Lower bound of the smallest eigenvalue of the stiffness at the exact equilibrium [N/m], in the scaling
    /// of [`crate::Stability`]. Above zero the equilibrium is proved stable.
    pub least_stiffness: f64,
}

impl Certificate {
    /// Whether the exact equilibrium is proved stable.
    pub fn is_stable(&self) -> bool {
        self.least_stiffness > 0.0
    }
}

const MAX_BOXES: usize = 12;

impl DirectProblem<'_> {
    /// Proves that an exact equilibrium lies near `solution`, and how near.
    ///
    /// # Errors
    /// - [`StaticsError::Invalid`] unless the solution is finite and has one force for each cable.
    /// - [`StaticsError::NotCertified`] where no box could be proved to contain an equilibrium: a cable that
    ///   hangs vertically or folded, or stiffnesses so different that rounding hides the equilibrium.
    pub fn certify(&self, solution: &DirectSolution) -> Result<Certificate, StaticsError> {
        self.check("solution.equilibrium", &solution.equilibrium)?;
        if !self.robot.is_plain() {
            let reason = "a cable has an elastic law with pieces, a pulley or a lead, or the base is not level; \
                          certificates are for plain cables on a level base, so that no box is tried";
            return Err(StaticsError::NotCertified { reason, growth: None });
        }
        if !self.robot.freedoms().are_all() {
            let reason = "the robot is a point mass or planar; certificates are for six free motions, so that \
                          no box is tried";
            return Err(StaticsError::NotCertified { reason, growth: None });
        }
        prove(self, &solution.equilibrium)
    }
}

/// Looks for a box around the equilibrium that Krawczyk's operator maps into its own interior.
fn prove(problem: &DirectProblem, equilibrium: &Equilibrium) -> Result<Certificate, StaticsError> {
    let failed = |reason, growth| StaticsError::NotCertified { reason, growth };
    let state = State::from(equilibrium);
    let rotation = exact_rotation(&state.rotation);
    let at = |radius: &DVector<f64>| enclose(&state, &rotation, radius);
    let size = 6 + 2 * problem.cables();

    let inverse = Lu::new(&jacobian(problem, &state)).inverse();
    if inverse.iter().any(|y| !y.is_finite()) {
        return Err(failed(
            "the equations are singular here: a motion of the platform has no stiffness, and no box is tried",
            None,
        ));
    }
    let multiplier = Multiplier::new(inverse);
    let open = residual(problem, &at(&DVector::zeros(size)).state);
    let (middle, error) = multiplier.times(&DMatrix::from_column_slice(size, 1, open.as_slice()));
    let defect = DVector::from_fn(size, |i, _| (middle[i].abs() + error[i]).next_up());
    // No component of the box is much smaller than rounding: the others would push it out of itself.
    let floor = DVector::from_fn(size, |i, _| match i {
        0..3 => f64::EPSILON * problem.size(),
        3..6 => f64::EPSILON * problem.size() / problem.characteristic_length(),
        _ => f64::EPSILON * equilibrium.cable_forces[(i - 6) / 2].norm(),
    });
    let mut radius = floor.zip_map(&defect, |floor, defect| 2.0 * defect + floor);
    let mut growth: Option<f64> = None;
    for _ in 0..MAX_BOXES {
        let boxed = at(&radius);
        if let Some(reason) = degenerate(problem, &boxed.state) {
            return Err(failed(reason, growth));
        }
        let jacobian = jacobian(problem, &boxed.state);
        // (I - Y g'(X)) (X - x̃), by magnitudes.
        let (product, error) = multiplier.times(&turned(jacobian.clone(), &boxed.per_delta));
        let mut image = defect.clone();
        for column in 0..size {
            for row in 0..size {
                let one = if row == column { 1.0 } else { 0.0 };
                let left = ((one - product[(row, column)]).abs().next_up() + error[(row, column)]).next_up();
                image[row] = (image[row] + (left * radius[column]).next_up()).next_up();
            }
        }
        growth = Some(image.iter().zip(&radius).map(|(image, radius)| image / radius).fold(0.0, f64::max));
        if image.iter().zip(&radius).all(|(image, radius)| image < radius) {
            let least_stiffness = least_stiffness(problem, &boxed.state, &jacobian);
            return Ok(bounds(&state, &rotation, &image, least_stiffness));
        }
        if !image.iter().all(|image| image.is_finite()) {
            break;
        }
        radius = floor.zip_map(&image, |floor, image| 1.5 * image + floor);
    }
    Err(failed("no box maps into itself", growth))
}

/// A box of states, with the derivative dφ/dδ over it.
struct Boxed {
    state: State<Interval>,
    per_delta: Matrix3<Interval>,
}

fn enclose(state: &State<f64>, rotation: &Matrix3<Interval>, radius: &DVector<f64>) -> Boxed {
    let half = |value: f64| Interval::of(value);
    let delta = Vector3::from_fn(|i, _| Interval::around(0.0, radius[3 + i]));
    let skew = skew(&delta);
    let denominator = Interval::of(1.0) + (delta.x * delta.x + delta.y * delta.y + delta.z * delta.z) * 0.25;
    let factor = Interval::of(1.0) / denominator;
    let one = Matrix3::identity();
    let turn = one + (skew + skew * skew * half(0.5)) * factor;
    Boxed {
        state: State {
            position: Vector3::from_fn(|i, _| Interval::around(state.position[i], radius[i])),
            rotation: turn * rotation,
            forces: state
                .forces
                .iter()
                .enumerate()
                .map(|(i, f)| Vector2::from_fn(|j, _| Interval::around(f[j], radius[6 + 2 * i + j])))
                .collect(),
        },
        per_delta: (one + skew * half(0.5)) * factor,
    }
}

/// The rotation matrix of the quaternion nearest to `rotation`, exactly: of any quaternion, divided by its
/// own square.
fn exact_rotation(rotation: &Matrix3<f64>) -> Matrix3<Interval> {
    let matrix = cdpr_robot::Rotation3::from_matrix_unchecked(*rotation);
    let q = UnitQuaternion::from_rotation_matrix(&matrix);
    let [w, x, y, z] = [q.w, q.i, q.j, q.k].map(Interval::of);
    let square = w * w + x * x + y * y + z * z;
    let two = |a: Interval| a * 2.0 / square;
    Matrix3::new(
        (w * w + x * x - y * y - z * z) / square,
        two(x * y - w * z),
        two(x * z + w * y),
        two(x * y + w * z),
        (w * w - x * x + y * y - z * z) / square,
        two(y * z - w * x),
        two(x * z - w * y),
        two(y * z + w * x),
        (w * w - x * x - y * y + z * z) / square,
    )
}

/// Why the equations cannot be enclosed, if they cannot.
fn degenerate(problem: &DirectProblem, state: &State<Interval>) -> Option<&'static str> {
    for (i, force) in state.forces.iter().enumerate() {
        let middle = Vector2::new(force.x.value(), force.y.value());
        let catenary = problem.catenary(i, middle);
        let span = state.cable(problem, i).span;
        let [h, z] = span.end;
        if catenary.is_slack_and_weightless() {
            if span.chord().high >= catenary.length_at_rest() {
                return Some("a slack cable without weight is about to become taut");
            }
            continue;
        }
        // Far above the guards of `cdpr_cable::kernel::response` and of the Jacobian; NaN is refused, too.
        let regular = force.x.low > 1e-15 * (middle.norm() + catenary.weight())
            && h.low > 2.0 * NEAR_VERTICAL * z.magnitude();
        if !regular {
            return Some("a cable hangs vertically or folded");
        }
    }
    None
}

/// Y, ready to multiply matrices of intervals.
struct Multiplier {
    matrix: DMatrix<f64>,
    magnitudes: DMatrix<f64>,
}

impl Multiplier {
    fn new(matrix: DMatrix<f64>) -> Self {
        Self { magnitudes: matrix.abs(), matrix }
    }

    /// Middles and error bounds of Y times a matrix of intervals: the product of the middles in ordinary
    /// arithmetic, and `|Y| (radii + (n + 2) ε |middles|)`, which covers the radii and its rounding in
    /// whatever order it sums (Rump 1999). The bound is raised by its own rounding.
    fn times(&self, factor: &DMatrix<Interval>) -> (DMatrix<f64>, DMatrix<f64>) {
        let share = (self.matrix.nrows() + 2) as f64 * f64::EPSILON;
        let middles = factor.map(Interval::value);
        let errors =
            factor.zip_map(&middles, |interval, middle| interval.radius_about(middle) + share * middle.abs());
        let bounds = (&self.magnitudes * errors).map(|bound| bound * (1.0 + 2.0 * share) + f64::MIN_POSITIVE);
        (&self.matrix * middles, bounds)
    }
}

/// The derivatives with respect to φ turned into those with respect to δ.
fn turned(mut jacobian: DMatrix<Interval>, per_delta: &Matrix3<Interval>) -> DMatrix<Interval> {
    for mut row in jacobian.row_iter_mut() {
        let by_phi = [row[3], row[4], row[5]];
        for j in 0..3 {
            row[3 + j] =
                by_phi[0] * per_delta[(0, j)] + by_phi[1] * per_delta[(1, j)] + by_phi[2] * per_delta[(2, j)];
        }
    }
    jacobian
}

/// Lower bound of the smallest eigenvalue of the symmetric Hessian over the box, in (dp, ℓ dφ).
fn least_stiffness(problem: &DirectProblem, state: &State<Interval>, jacobian: &DMatrix<Interval>) -> f64 {
    let mut hessian: Matrix6<Interval> = jacobian.fixed_view::<6, 6>(0, 0).into_owned();
    for i in 0..problem.cables() {
        let at = closure_row(i);
        // A slack cable without weight resists nothing.
        let Some(cable) = state.cable(problem, i).planar() else { continue };
        let [xx, xz, zz] = cable.stiffness;
        let stiffness = [[xx, xz], [xz, zz]];
        for row in 0..6 {
            for column in 0..6 {
                for (j, stiffness) in stiffness.iter().enumerate() {
                    for (k, stiffness) in stiffness.iter().enumerate() {
                        hessian[(row, column)] +=
                            jacobian[(row, at + j)] * *stiffness * jacobian[(at + k, column)];
                    }
                }
            }
        }
    }
    let length = problem.characteristic_length();
    let scale = |i: usize| if i < 3 { 1.0 } else { 1.0 / length };
    let symmetric = Matrix6::from_fn(|i, j| {
        (hessian[(i, j)] + hessian[(j, i)]) * 0.5 * Interval::of(scale(i)) * Interval::of(scale(j))
    });
    let middle = symmetric.map(Interval::value);
    let by_factor = middle.cholesky().and_then(|factor| factor.l().try_inverse()).map(|inverse| {
        let enclosed = inverse.map(Interval::of);
        let eta = row_norm(&(enclosed * symmetric * enclosed.transpose() - Matrix6::identity()));
        // The largest eigenvalue is computed to a few roundings of itself.
        (1.0 - eta).next_down()
            / ((inverse.transpose() * inverse).symmetric_eigenvalues().max() * (1.0 + 1e-13))
    });
    match by_factor {
        Some(bound) if bound > 0.0 => bound,
        // Weyl: the eigenvalues differ from those of the middle by no more than the norm of the radii; those
        // are computed to within 64 roundings of the norm.
        _ => {
            let radii = row_norm(&(symmetric - middle.map(Interval::of)));
            middle.symmetric_eigenvalues().min() - radii - 64.0 * f64::EPSILON * middle.norm()
        }
    }
}

/// An upper bound of the largest sum of magnitudes in a row, and so of the matrix's norm if it is symmetric.
fn row_norm(matrix: &Matrix6<Interval>) -> f64 {
    let sum = |row: nalgebra::RowVector6<Interval>| {
        row.iter().fold(0.0, |sum: f64, x| (sum + x.magnitude()).next_up())
    };
    matrix.row_iter().map(|row| sum(row.into_owned())).fold(0.0, f64::max)
}

fn bounds(
    state: &State<f64>,
    rotation: &Matrix3<Interval>,
    image: &DVector<f64>,
    least_stiffness: f64,
) -> Certificate {
    let up = |x: f64| x * (1.0 + 4.0 * f64::EPSILON);
    let norm = |from: usize, count: usize| up(image.rows(from, count).norm());
    // The rotation that was handed out is not exactly that of its quaternion.
    let off = Matrix3::from_fn(|i, j| (rotation[(i, j)] - Interval::of(state.rotation[(i, j)])).magnitude());
    Certificate {
        position: norm(0, 3),
        rotation: up(norm(3, 3) + off.norm()),
        force: (0..state.forces.len()).map(|i| norm(closure_row(i), 2)).fold(0.0, f64::max),
        least_stiffness,
    }
}
