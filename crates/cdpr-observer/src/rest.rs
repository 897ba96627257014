//! The rest of the platform for given lengths, load and modulus, and the derivatives of its tensions.
//!
//! The load is a mass m whose first moment about P is q in the platform's frame; gravity is γ. With the
//! wrench `G` of cables and weight about P and its derivative by the motion (dp, dφ) of the platform,
//!
//! ```text
//! G = sum [F_i; s_i x F_i] + [(m0 + m) γ; R (m0 c + q) x γ]                                        (O1)
//! H = -∂G/∂(dp, dφ) = sum [ K_i  -K_i [s_i]; [s_i] K_i  -[s_i] K_i [s_i] - [F_i][s_i] ]
//!                     - [ 0  0; 0  [γ][R (m0 c + q)] ]
//! ```
//!
//! Newton's method takes the steps `H (dp, dφ) = G`. Each cable is solved between its two points, so that no
//! cable has a residual. It starts where straight cables would move the platform when the lengths change,
//! `H (dp, dφ) = -sum [K_i u_i; s_i x K_i u_i] dL_i`. At rest an input θ at constant lengths moves the
//! platform by `H⁻¹ ∂G/∂θ`, and
//!
//! ```text
//! dt_i/dθ = g_i·H⁻¹ ∂G/∂θ + u_i·∂F_i/∂θ,      g_i = -[K_iᵀ u_i; s_i x K_iᵀ u_i]                    (O2)
//! ```

use cdpr_cable::{Property, SpatialCable, spatial_end_force};
use cdpr_robot::{Pose, Robot, Vector3, Vector6, Wrench};
use nalgebra::{Matrix3, Matrix6, Vector5};

/// Most iterations of Newton's method: the time of a sample is bounded.
pub(crate) const MOST_ITERATIONS: usize = 12;

/// Unbalanced force and moment at which a platform rests, as a share of the sum of all forces.
const BALANCED: f64 = 1e-10;

/// Mass of the load [kg], its first moment about the platform's centre of mass in the platform's frame
/// [kg m], and the modulus as a multiple of that of the robot.
pub(crate) type Unknowns = Vector5<f64>;

pub(crate) const MODULUS: usize = 4;

/// A cable between its two points, in the base frame.
#[derive(Clone, Copy)]
pub(crate) struct CableAtRest {
    /// s_i [m].
    pub(crate) arm: Vector3<f64>,
    /// F_i, on the platform [N].
    pub(crate) force: Vector3<f64>,
    /// |F_i| [N].
    pub(crate) tension: f64,
    /// u_i; zero for a slack cable without weight.
    direction: Vector3<f64>,
    /// K_i [N/m].
    stiffness: Matrix3<f64>,
    /// On the cable in the level frame: where the next search begins [N].
    level_force: Vector3<f64>,
}

impl CableAtRest {
    /// Wrench [f; s_i x f] of a force at the anchor point.
    fn wrench(&self, force: Vector3<f64>) -> Vector6<f64> {
        Wrench::of_force_at(&self.arm, force).to_vector()
    }

    /// g_i of (O2).
    fn per_motion(&self) -> Vector6<f64> {
        -self.wrench(self.stiffness.tr_mul(&self.direction))
    }
}

/// A robot at rest.
#[derive(Clone)]
pub(crate) struct Rest {
    /// With the modulus of the unknowns.
    robot: Robot,
    /// Of each cable, as the robot was given [Pa].
    moduli: Vec<f64>,
    pub(crate) pose: Pose,
    pub(crate) cables: Vec<CableAtRest>,
    /// H⁻¹, without the motions that the robot does not have.
    flexibility: Matrix6<f64>,
    /// Lengths at rest [m].
    lengths: Vec<f64>,
}

impl Rest {
    /// The robot at a pose, not yet at rest.
    pub(crate) fn new(robot: &Robot, pose: Pose, lengths: &[f64]) -> Self {
        let o = Vector3::zeros();
        let stiffness = Matrix3::zeros();
        let cable = CableAtRest { arm: o, force: o, tension: 0.0, direction: o, stiffness, level_force: o };
        let moduli = robot.cables.iter().map(|cable| cable.properties.youngs_modulus).collect();
        let cables = vec![cable; robot.cables.len()];
        let (robot, lengths) = (robot.clone(), lengths.to_vec());
        Self { robot, moduli, pose, cables, flexibility: Matrix6::zeros(), lengths }
    }

    pub(crate) fn robot(&self) -> &Robot {
        &self.robot
    }

    /// The rest for these lengths [m] and unknowns that is reached from the last one, and the number of
    /// iterations. Where no rest is found nearby, `None`, and the state stays the last one.
    pub(crate) fn solve(&mut self, lengths: &[f64], unknowns: &Unknowns) -> Option<usize> {
        for (cable, modulus) in self.robot.cables.iter_mut().zip(&self.moduli) {
            cable.properties.youngs_modulus = modulus * unknowns[MODULUS];
        }
        let before = self.pose;
        let changes = lengths.iter().zip(&self.lengths).map(|(now, before)| now - before);
        let wrench: Vector6<f64> =
            self.cables.iter().zip(changes).map(|(cable, change)| cable.per_motion() * change).sum();
        self.move_by(&(self.flexibility * self.robot.freedoms().of_vector(&wrench)));
        let found = self.newton(lengths, unknowns);
        match found {
            Some(_) => self.lengths.copy_from_slice(lengths),
            None => self.pose = before,
        }
        found
    }

    fn newton(&mut self, lengths: &[f64], unknowns: &Unknowns) -> Option<usize> {
        let freedoms = self.robot.freedoms();
        let size = self.robot.platform_size();
        for iteration in 0..=MOST_ITERATIONS {
            self.cables_between_ends(lengths)?;
            let (wrench, mut stiffness) = self.balance(unknowns);
            let wrench = freedoms.of_vector(&wrench);
            stiffness = freedoms.of_matrix(&stiffness);
            (0..6).filter(|k| !freedoms.contains(*k)).for_each(|k| stiffness[(k, k)] = 1.0);
            let forces: f64 = self.cables.iter().map(|cable| cable.tension).sum();
            let [force, moment] = [0, 3].map(|first| wrench.fixed_rows::<3>(first).norm());
            if force <= BALANCED * forces && moment <= BALANCED * forces * size.max(1.0) {
                // A rest that is not stable is left at once.
                (0.5 * (stiffness + stiffness.transpose())).cholesky()?;
                self.flexibility = stiffness.try_inverse()?;
                return Some(iteration);
            }
            self.move_by(&(stiffness.try_inverse()? * wrench));
        }
        None
    }

    fn move_by(&mut self, motion: &Vector6<f64>) {
        let [translation, turn] = [0, 3].map(|first| motion.fixed_rows::<3>(first).into_owned());
        self.pose = self.pose.moved(translation, turn);
    }

    /// Solves each cable between its two points; `None` where one cannot be.
    fn cables_between_ends(&mut self, lengths: &[f64]) -> Option<()> {
        let Self { robot, pose, cables, .. } = self;
        let level = robot.gravity.level();
        for (i, at) in cables.iter_mut().enumerate() {
            let span = robot.span(pose, i);
            let end = level.map_or(span, |level| level * span);
            let near = Some(at.level_force).filter(|force| force.norm() > 0.0);
            let found = spatial_end_force(&robot.cable(i), lengths[i], end, near).ok()?;
            let tension = found.anchor_tension();
            if found.cable.overstrain(tension).is_some() {
                return None;
            }
            let (arm, level_force) = (robot.anchor_arm(pose, i), found.force);
            let (mut direction, mut stiffness) = (Vector3::zeros(), Matrix3::zeros());
            if !found.is_slack_and_weightless() {
                stiffness = found.response().flexibility.try_inverse()?;
                direction = -level_force / tension;
            }
            if let Some(level) = level {
                stiffness = level.transpose() * stiffness * level;
                direction = level.tr_mul(&direction);
            }
            let force = tension * direction;
            *at = CableAtRest { arm, force, tension, direction, stiffness, level_force };
        }
        Some(())
    }

    /// G and H, (O1).
    fn balance(&self, unknowns: &Unknowns) -> (Vector6<f64>, Matrix6<f64>) {
        let gravity = self.robot.gravity.vector();
        let platform = &self.robot.platform;
        let mass = platform.mass + unknowns[0];
        let moment = mass * platform.center_of_mass + unknowns.fixed_rows::<3>(1);
        let moment = self.pose.rotation * moment;
        let turning = moment.cross(&gravity);
        let weight = mass * gravity;
        let mut wrench = Vector6::new(weight.x, weight.y, weight.z, turning.x, turning.y, turning.z);
        let mut stiffness = Matrix6::zeros();
        let mut rotations = -gravity.cross_matrix() * moment.cross_matrix();
        for cable in &self.cables {
            let (k, s) = (cable.stiffness, cable.arm.cross_matrix());
            wrench += cable.wrench(cable.force);
            let mut block = stiffness.fixed_view_mut::<3, 3>(0, 0);
            block += k;
            let mut block = stiffness.fixed_view_mut::<3, 3>(0, 3);
            block -= k * s;
            let mut block = stiffness.fixed_view_mut::<3, 3>(3, 0);
            block += s * k;
            rotations -= s * k * s + cable.force.cross_matrix() * s;
        }
        stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&rotations);
        (wrench, stiffness)
    }

    /// ∂G/∂θ of the load's mass and first moment.
    fn wrench_per_load(&self, k: usize) -> Vector6<f64> {
        let gravity = self.robot.gravity.vector();
        let lever = match k {
            0 => self.pose.rotation * self.robot.platform.center_of_mass,
            k => self.pose.rotation.matrix().column(k - 1).into_owned(),
        };
        let moment = lever.cross(&gravity);
        let force = if k == 0 { gravity } else { Vector3::zeros() };
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }

    /// Cable i as `cdpr-cable` has it.
    fn cable(&self, i: usize, length: f64) -> SpatialCable<'_> {
        SpatialCable {
            cable: self.robot.cable(i),
            unstrained_length: length,
            force: self.cables[i].level_force,
        }
    }

    /// A vector of the level frame in the base frame.
    fn to_base(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.robot.gravity.level().map_or(v, |level| level.tr_mul(&v))
    }

    /// Derivatives of the tensions by the unknowns, (O2), one row for each cable.
    pub(crate) fn tensions_per_unknown(&self, lengths: &[f64], rows: &mut [Unknowns]) {
        let freedoms = self.robot.freedoms();
        let mut per_modulus = Vector6::zeros();
        for (i, (cable, row)) in self.cables.iter().zip(rows.iter_mut()).enumerate() {
            *row = Unknowns::zeros();
            if cable.tension > 0.0 && cable.direction != Vector3::zeros() {
                let at = self.cable(i, lengths[i]);
                let stretch = at.slopes().column(Property::Stiffness as usize) * at.cable.axial_stiffness;
                // dF = K ∂A/∂EA dEA, and EA is in proportion to the unknown.
                let force = cable.stiffness * self.to_base(stretch) / self.modulus();
                row[MODULUS] = cable.direction.dot(&force);
                per_modulus += cable.wrench(force);
            }
        }
        for k in 0..5 {
            let wrench = if k == MODULUS { per_modulus } else { self.wrench_per_load(k) };
            let motion = self.flexibility * freedoms.of_vector(&wrench);
            for (cable, row) in self.cables.iter().zip(rows.iter_mut()) {
                row[k] += cable.per_motion().dot(&motion);
            }
        }
    }

    /// Derivatives of all tensions by the length of cable j [N/m].
    pub(crate) fn tensions_per_length(&self, j: usize, lengths: &[f64], column: &mut [f64]) {
        let own = &self.cables[j];
        column.fill(0.0);
        if own.direction == Vector3::zeros() {
            return;
        }
        let force = own.stiffness * self.to_base(self.cable(j, lengths[j]).response().end_per_length);
        let motion = self.flexibility * self.robot.freedoms().of_vector(&own.wrench(force));
        for (value, cable) in column.iter_mut().zip(&self.cables) {
            *value = cable.per_motion().dot(&motion);
        }
        column[j] += own.direction.dot(&force);
    }

    /// The modulus as a multiple of the given one.
    fn modulus(&self) -> f64 {
        self.robot.cables[0].properties.youngs_modulus / self.moduli[0]
    }

    /// The wrench about P, in the base frame, that these tensions hold besides the platform's weight; zero
    /// along motions that the platform does not have.
    pub(crate) fn residual_wrench(&self, tensions: impl Iterator<Item = f64>) -> Wrench {
        let held: Vector6<f64> =
            self.cables.iter().zip(tensions).map(|(cable, t)| cable.wrench(t * cable.direction)).sum();
        let open = held + self.robot.weight(&self.pose, 0.0).to_vector();
        Wrench::from_vector(&-self.robot.freedoms().of_vector(&open))
    }
}
