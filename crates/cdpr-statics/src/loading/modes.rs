//! Natural frequencies of the platform on its cables.
//!
//! With the lengths constant, the stiffness K and the mass matrix M about P give the small free motions
//! `(dp, dφ) = v sin 2πft` of the platform,
//!
//! ```text
//! K v = (2π f)² M v,      M = [ m 1       -m [R c]  ]      J_P = R J_c Rᵀ - m [R c]²             (V1)
//!                             [ m [R c]    J_P      ]
//! ```
//!
//! with the inertia J_c about the centre of mass, in the platform frame. The cables have no mass in M. Their
//! stiffness, and that of the weight at its lever, which acts as on a pendulum, share the energy of a motion:
//!
//! ```text
//! vᵀ K v = sum vᵀ K_i v + vᵀ K_w v                                                               (V2)
//! ```
//!
//! K is the symmetric part of the stiffness, [`crate::stiffness::Linearization::symmetric_stiffness`].
//!
//! These frequencies are valid where the cables themselves vibrate much faster than the platform. The lowest
//! frequency of each cable between ends at rest, (C29) of `cdpr_cable` with the mean of its end tensions,
//! says whether they do: [`CableFrequency`].

use crate::direct::{DirectStart, Stability};
use crate::error::StaticsError;
use crate::inverse::{lengths_at, refuse_offsets};
use crate::loading::small_motions::SmallMotions;
use crate::problem::{DirectProblem, Unstable};
use crate::state::{Equilibrium, Load, WantedPose};
use cdpr_robot::{Robot, Vector3, Vector6};
use nalgebra::Matrix6;
use std::f64::consts::TAU;

/// A natural motion of the platform, of unit mass: `vᵀ M v = 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct NaturalMode {
    /// Natural frequency [Hz].
    pub frequency: f64,
    /// Translation of P [1/√kg].
    pub translation: Vector3<f64>,
    /// Rotation vector [rad/(m √kg)], in the base frame.
    pub rotation: Vector3<f64>,
    /// Share of each cable in the energy of the motion, (V2).
    pub cables: Vec<f64>,
    /// Share of the weight of platform and payload, (V2); all shares together are one.
    pub weight: f64,
}

/// Natural motions of a robot at a pose that the inverse model holds.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseModes {
    /// The free motions, the slowest first.
    pub modes: Vec<NaturalMode>,
    /// Unstrained lengths [m].
    pub lengths: Vec<f64>,
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// Lowest frequency of each cable between ends at rest [Hz]; `None` for one without mass.
    pub cable_frequencies: Vec<Option<f64>>,
}

/// The cable that vibrates slowest between ends at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CableFrequency {
    /// Its number, from 0.
    pub cable: usize,
    /// Its lowest natural frequency [Hz].
    pub frequency: f64,
}

/// Cables that vibrate at this multiple of the platform's frequency or faster act nearly as without mass: a
/// string whose end moves at half its own frequency pulls with 4/π instead of 1 of its inertia.
const MUCH_FASTER: f64 = 2.0;

impl CableFrequency {
    /// The slowest of all cables, in their order.
    pub fn slowest(frequencies: impl Iterator<Item = Option<f64>>) -> Option<Self> {
        let each = frequencies.enumerate();
        let each = each.filter_map(|(cable, frequency)| Some(Self { cable, frequency: frequency? }));
        each.min_by(|one, other| one.frequency.total_cmp(&other.frequency))
    }

    /// Whether it vibrates less than twice as fast as the platform, `platform` [Hz]: then its mass changes
    /// the frequencies of the platform, and adds others.
    pub fn is_near(&self, platform: f64) -> bool {
        self.frequency < MUCH_FASTER * platform
    }

    /// What follows for the platform's lowest frequency [Hz], if the cable is near it.
    pub fn warning(&self, platform: f64) -> Option<String> {
        self.is_near(platform).then(|| {
            format!(
                "cable {} itself vibrates at {:.3} Hz, less than twice {platform:.3} Hz:\nthe platform's \
                 frequencies are those on cables without mass; with it they differ, and there are others",
                self.cable + 1,
                self.frequency
            )
        })
    }
}

impl PoseModes {
    /// Those of a stable equilibrium.
    ///
    /// # Errors
    /// As [`DirectProblem::modes`].
    pub fn new(problem: &DirectProblem, equilibrium: Equilibrium) -> Result<Self, StaticsError> {
        let modes = problem.modes(&equilibrium)?;
        let cable_frequencies = problem.cable_frequencies(&equilibrium)?;
        Ok(Self { modes, lengths: problem.lengths.to_vec(), equilibrium, cable_frequencies })
    }

    /// The slowest cable, and the lowest frequency of the platform that is not zero [Hz].
    pub fn lowest(&self) -> (Option<CableFrequency>, Option<f64>) {
        let platform = self.modes.iter().map(|mode| mode.frequency).find(|frequency| *frequency > 0.0);
        (CableFrequency::slowest(self.cable_frequencies.iter().copied()), platform)
    }
}

impl DirectProblem<'_> {
    /// The natural motions of the platform about a stable equilibrium of its own, the slowest first: six, or
    /// as many as are not constrained.
    ///
    /// A payload moves as a point at the centre of mass. Motions that nothing resists have the frequency zero
    /// and no shares.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] for a robot that rotates without `platform.inertia`, an equilibrium that is
    /// not finite or has not one force for each cable, and one that is not stable.
    pub fn modes(&self, equilibrium: &Equilibrium) -> Result<Vec<NaturalMode>, StaticsError> {
        let SmallMotions { mass, weight, cables, free } = self.small_motions(equilibrium)?;
        let cables: Vec<_> = cables.iter().map(|cable| cable.stiffness).collect();
        let freedoms = self.robot.freedoms();
        let stiffness = freedoms.of_matrix(&cables.iter().fold(weight, |sum, cable| sum + cable));
        let neutral = Stability::new(self, equilibrium, &stiffness).neutral().len();
        let not_positive = || {
            let expected = "an inertia that is positive definite [kg m²]";
            StaticsError::invalid("platform.inertia".to_owned(), "not positive definite", expected)
        };
        let factor = mass.cholesky().ok_or_else(not_positive)?.l();
        let inverse = factor.try_inverse().ok_or_else(not_positive)?;
        let eigen = freedoms.block(&(inverse * stiffness * inverse.transpose())).symmetric_eigen();
        let mut order: Vec<_> = (0..free.len()).collect();
        let rounding = ROUNDING * eigen.eigenvalues.amax();
        // The squares of neutral motions are rounding, of either sign.
        order.sort_by(|one, other| eigen.eigenvalues[*one].abs().total_cmp(&eigen.eigenvalues[*other].abs()));
        order[neutral..].sort_by(|one, other| eigen.eigenvalues[*one].total_cmp(&eigen.eigenvalues[*other]));
        let resisted = order[neutral..].first().map_or(0.0, |k| eigen.eigenvalues[*k]);
        if resisted < -rounding {
            let value = format!("unstable ({resisted:.3e} 1/s²)");
            let expected = "a stable equilibrium: others have no natural frequencies";
            return Err(StaticsError::invalid("equilibrium".to_owned(), value, expected));
        }
        let mode = |(rank, k): (usize, &usize)| {
            let square = if rank < neutral { 0.0 } else { eigen.eigenvalues[*k].max(0.0) };
            let mut vector = Vector6::zeros();
            free.iter().zip(eigen.eigenvectors.column(*k).iter()).for_each(|(i, v)| vector[*i] = *v);
            let shape = inverse.transpose() * vector;
            // Of the two signs, the one that makes the largest component positive.
            let shape = shape * shape[shape.iamax()].signum();
            let share = |part: &Matrix6<f64>| {
                if square > rounding { (shape.transpose() * part * shape)[0] / square } else { 0.0 }
            };
            NaturalMode {
                frequency: square.sqrt() / TAU,
                translation: shape.fixed_rows::<3>(0).into(),
                rotation: shape.fixed_rows::<3>(3).into(),
                cables: cables.iter().map(share).collect(),
                weight: share(&weight),
            }
        };
        Ok(order.iter().enumerate().map(mode).collect())
    }

    /// Lowest natural frequency of each cable between ends at rest [Hz]; `None` for one without mass.
    ///
    /// # Errors
    /// [`StaticsError::Invalid`] unless the equilibrium is finite and has one force for each cable.
    pub fn cable_frequencies(&self, equilibrium: &Equilibrium) -> Result<Vec<Option<f64>>, StaticsError> {
        self.check("equilibrium", equilibrium)?;
        let forces = equilibrium.cable_forces.iter().enumerate();
        let frequency = |(i, force): (usize, &_)| {
            let catenary = self.catenary_at(&equilibrium.pose, i, *force);
            let mean = 0.5 * (catenary.anchor_tension() + catenary.exit_tension());
            let density = self.robot.cables[i].properties.linear_density;
            catenary.cable.lowest_frequency(density, catenary.free_length(), mean)
        };
        Ok(forces.map(frequency).collect())
    }
}

/// Squares of frequencies below this share of the greatest one are rounding.
const ROUNDING: f64 = 1e-12;

/// The natural motions of a robot at a wanted pose under the platform's weight and `load`.
///
/// # Errors
/// Those of [`crate::inverse`], of [`DirectProblem::direct`] and of [`DirectProblem::modes`].
pub fn modes_at<'a>(
    robot: &Robot,
    wanted: impl Into<WantedPose<'a>>,
    load: &Load,
) -> Result<PoseModes, StaticsError> {
    let wanted = lengths_at(robot, &refuse_offsets(wanted.into())?, load)?;
    let problem = DirectProblem::new(robot, &wanted.lengths, load)?;
    let found = problem.with_unstable(Unstable::Accepted).direct(DirectStart::Near(&wanted.equilibrium))?;
    PoseModes::new(&problem, found.equilibrium)
}
