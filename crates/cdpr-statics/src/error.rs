//! Errors of the models.

pub use crate::blocked::Blocked;
pub use crate::rest_fault::RestFault;
use crate::state::Residual;
use cdpr_cable::CableError;
use cdpr_robot::{Pose, RobotError, counted, decimal, short, shortened, significant, visible};

/// Why a model has no solution.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StaticsError {
    /// The robot or its perturbation is invalid.
    #[error(transparent)]
    Robot(#[from] RobotError),
    /// A cable has no equilibrium for what it is given.
    #[error("cable {}: {source}", index + 1)]
    Cable {
        /// Index of the cable, from 0.
        index: usize,
        /// The reason.
        source: CableError,
    },
    /// A value of an input is invalid, or there is not one for each cable.
    #[error("{field} is {value}: expected {expected}")]
    Invalid {
        /// Name of the input.
        field: String,
        /// Its value.
        value: String,
        /// Values that are valid.
        expected: String,
    },
    /// No tensions within the limits that hold the pose were found.
    #[error(
        "at position ({x}, {y}, {z}) m: no tensions between {min} N and {max} N balance the wrench{why}: \
         the best tensions from {from}, up to {largest} N, leave a residual of {} N and \
         {} N m{blocked}; change the pose, the load or the limits",
        left(*force, tensions),
        left(*moment, tensions),
        x = short(position[0]), y = short(position[1]), z = short(position[2]),
        min = short(*min),
        max = short(*max),
        from = if *starts == 1 { "one start".to_owned() } else { format!("{starts} starts") },
        largest = visible(tensions.iter().copied().fold(0.0, f64::max), 3),
        why = if *rank_deficient { ", and cables at this pose cannot resist every wrench" } else { "" },
        blocked = Blocked::list(blocked)
    )]
    NoTensions {
        /// Position of the platform [m].
        position: [f64; 3],
        /// Least tension allowed in any cable [N].
        min: f64,
        /// Greatest tension allowed in any cable, at the platform [N].
        max: f64,
        /// Starts that were tried.
        starts: usize,
        /// Whether a direction was found in which the cables cannot pull enough: then the pose is infeasible.
        refuted: bool,
        /// Whether the wrenches of the cables leave a motion of the platform unresisted.
        rank_deficient: bool,
        /// Norm of the residual force in the best attempt [N].
        force: f64,
        /// Norm of the residual moment in the best attempt [N m].
        moment: f64,
        /// The tensions of that attempt [N].
        tensions: Vec<f64>,
        /// The limits that they rest on.
        blocked: Vec<Blocked>,
    },
    /// No tensions near those of the pose before hold the next pose of a path.
    #[error("within {} N of the tensions at the last pose that is held: {source}; or make smaller steps", short(*change))]
    TensionChange {
        /// Greatest change allowed [N].
        change: f64,
        /// Why not.
        source: Box<Self>,
    },
    /// Fewer cables than free motions: not all coordinates of a pose can be chosen.
    #[error(
        "{} for {} leave {} of the pose that cannot be chosen: \
         expected `--free` with as many names of x, y, z, roll, pitch, yaw, such as `--free roll,pitch`, or \
         as many names in `free` of a file, not {named}; inverse, deflection, \
         stiffness, derivatives, modes, response, simulate, capacity, safety, hysteresis, workspaces, designs, \
         robustness, calibrations and studies take them",
        counted(*cables, "cable"), counted(*freedoms, "free motion"),
        counted(freedoms.saturating_sub(*cables), "coordinate")
    )]
    FreeCoordinates {
        /// Number n of cables.
        cables: usize,
        /// Number m of free motions.
        freedoms: usize,
        /// Number of coordinates that were named.
        named: usize,
    },
    /// No lengths and free coordinates within the limits were found with which the platform rests at the
    /// others.
    #[error(
        "no rest with these coordinates was found {}: {nearest}",
        if *starts == 1 { "next to the known one".to_owned() } else { format!("from {starts} starts") }
    )]
    NoRest {
        /// Starts that were tried; 1 where only the rest that belongs to a known one is looked for.
        starts: usize,
        /// What the nearest attempt lacks.
        nearest: RestFault,
    },
    /// Infinitely many lengths or tensions hold the platform, because one equation of its balance follows
    /// from the others.
    #[error(
        "at position ({x}, {y}, {z}) m the rest is not unique: cable {} may have {l0} m and {t0} N, or \
         {l1} m and {t1} N, or what lies between; one equation of the balance follows from the others, and \
         these coordinates leave it open how the cables share the load or where they hold it; name other \
         coordinates as free",
        cable + 1,
        x = short(position[0]), y = short(position[1]), z = short(position[2]),
        l0 = decimal(lengths[0], 5), l1 = decimal(lengths[1], 5),
        t0 = decimal(tensions[0], 3), t1 = decimal(tensions[1], 3)
    )]
    NotUnique {
        /// Position of the platform in one of the solutions [m].
        position: [f64; 3],
        /// Index of the cable, from 0, that differs most between two of them.
        cable: usize,
        /// Its unstrained lengths there [m].
        lengths: [f64; 2],
        /// Its tensions there, at the platform [N].
        tensions: [f64; 2],
    },
    /// A cable's weight leaves no tension at the platform between the least one there and the greatest one at
    /// the exit point.
    #[error(
        "cable {}: its greatest tension at the exit point, {exit} N, leaves {} N at the platform, {} m \
         below, less than its least tension there, {min} N; change the pose or the limits",
        index + 1,
        visible(*max, 3),
        visible(*depth, 3),
        exit = short(*exit),
        min = short(*min)
    )]
    ExitLimit {
        /// Index of the cable, from 0.
        index: usize,
        /// Greatest tension at the exit point [N].
        exit: f64,
        /// How far the anchor point lies below the exit point [m].
        depth: f64,
        /// What this leaves at the platform [N]; zero if nothing.
        max: f64,
        /// Least tension at the platform [N].
        min: f64,
    },
    /// Tensions that hold the pose were found, but not the best of them.
    #[error(
        "inverse model: tensions hold the pose, but in {} their optimum was not found: the \
         best have a slope of {} N left",
        counted(*iterations, "iteration"),
        short(*stationarity)
    )]
    InverseNotConverged {
        /// Iterations made, from all starts.
        iterations: usize,
        /// What is left of the conditions of an optimum [N].
        stationarity: f64,
    },
    /// What was found strains a cable beyond [`cdpr_cable::MAX_STRAIN`].
    #[error(
        "cable {} is strained by {:.1} %, beyond the {:.0} % up to which the models are valid: its \
         unstrained length is {length} m, the distance of its points {} m; it is too short or too soft \
         for this",
        index + 1, 100.0 * strain, 100.0 * cdpr_cable::MAX_STRAIN,
        visible(*distance, 4), length = short(*length)
    )]
    Overstrained {
        /// Index of the cable, from 0.
        index: usize,
        /// Its unstrained length [m].
        length: f64,
        /// Distance of its points [m].
        distance: f64,
        /// Its largest strain: the larger of its two end tensions over EA.
        strain: f64,
    },
    /// The lengths hold the platform only as long as nothing disturbs it: it leaves the pose by itself.
    #[error(
        "the equilibrium at ({:.4}, {:.4}, {:.4}) m is unstable: its softest motion has a stiffness of \
        {} N/m, and the platform leaves the pose along it; change the pose, lower the \
        centre of mass or raise the tensions",
        pose.position.x, pose.position.y, pose.position.z, visible(*least_stiffness, 3)
    )]
    Unstable {
        /// The pose of the equilibrium.
        pose: Box<Pose>,
        /// Stiffness of the softest motion [N/m], see [`crate::Stability`].
        least_stiffness: f64,
    },
    /// No stable equilibrium was found under the load's moment, and the one without it disappears while the
    /// moment is raised.
    #[error(
        "direct model: the equilibrium at ({:.4}, {:.4}, {:.4}) m is lost at {:.3} % of the load's moment",
        pose.position.x, pose.position.y, pose.position.z, 100.0 * share
    )]
    EquilibriumLost {
        /// Share of the moment at which it is lost, 0 to 1.
        share: f64,
        /// The last stiffness of the softest motion [N/m], see [`crate::Stability`].
        least_stiffness: f64,
        /// The last stable pose.
        pose: Box<Pose>,
    },
    /// The equilibrium that was followed while the load was raised ends before the whole load, and the
    /// platform falls.
    #[error("{0}")]
    BranchEnds(Box<BranchEnd>),
    /// The distance to the exact equilibrium could not be bounded.
    #[error(
        "not certified: {reason}{}",
        growth.map_or_else(String::new, |growth| match growth.is_finite() {
            true => format!(
                " (closest attempt: the enclosing box maps to {growth:.3e} times itself, below 1 is a proof)"
            ),
            false => " (closest attempt: what the enclosing box maps to has no bounds)".to_owned(),
        })
    )]
    NotCertified {
        /// Why.
        reason: &'static str,
        /// Size of the image of the last box, relative to the box; `None` where the reason leaves no box to
        /// try.
        growth: Option<f64>,
    },
    /// A derivative that does not exist.
    #[error("{quantity} has no derivative: {reason}")]
    NoDerivative {
        /// Quantity that was to be differentiated.
        quantity: &'static str,
        /// Why it has no derivative.
        reason: &'static str,
    },
    /// Nothing determines the pose: every pose near this one is an equilibrium, as for a platform and slack
    /// cables without weight.
    #[error(
        "direct model: nothing determines the pose; every one near ({:.4}, {:.4}, {:.4}) m is an equilibrium",
        pose.position.x, pose.position.y, pose.position.z
    )]
    Indifferent {
        /// One of the poses.
        pose: Box<Pose>,
    },
    /// No equilibrium was found; the error has the pose where the search ended.
    #[error(
        "direct model: no equilibrium found in {}; the search ended at ({:.4}, {:.4}, {:.4}) m with a \
         residual of {} N and {} N m",
        counted(*iterations, "iteration"),
        pose.position.x, pose.position.y, pose.position.z, short(residual.force), short(residual.moment)
    )]
    DirectNotConverged {
        /// Iterations made.
        iterations: usize,
        /// The pose where the search ended.
        pose: Box<Pose>,
        /// The residual there.
        residual: Residual,
    },
}

/// Where a followed equilibrium ends.
#[derive(Clone, Debug, PartialEq)]
pub struct BranchEnd {
    /// Share of the change at which it ends, 0 to 1.
    pub share: f64,
    /// Whether the load alone changes, and not the lengths.
    pub of_load: bool,
    /// The last pose.
    pub pose: Pose,
    /// The pose downhill, or the reason why it was not found.
    pub falls_to: Result<Pose, StaticsError>,
}

impl BranchEnd {
    /// What the platform does, as the end of a sentence.
    pub fn fall(&self) -> String {
        let place = |pose: &Pose| {
            let p = pose.position;
            format!("({:.4}, {:.4}, {:.4}) m", p.x, p.y, p.z)
        };
        let from = place(&self.pose);
        let Ok(to) = &self.falls_to else { return format!("falls from {from}, to where is not known") };
        let turned = self.pose.motion_to(to).fixed_rows::<3>(3).norm().to_degrees();
        format!("falls from {from} to {} and turns by {turned:.1} degrees", place(to))
    }
}

impl std::fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let change = if self.of_load { "load" } else { "change of lengths and load" };
        write!(f, "at {:.2} % of the {change} the platform {}", 100.0 * self.share, self.fall())
    }
}

/// A residual in words: one that is small next to the tensions has its own digits, unless it is rounding.
fn left(residual: f64, tensions: &[f64]) -> String {
    let largest = tensions.iter().copied().fold(0.0, f64::max);
    if (1e-12 * largest..5e-4).contains(&residual) {
        significant(residual, 2)
    } else {
        format!("{residual:.3}")
    }
}

impl StaticsError {
    /// Name of the kind of failure, for counting: `infeasible_tension`, `tension_too_small` and others.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Robot(_) => "invalid_robot",
            Self::Cable { source: CableError::TensionTooSmall { .. }, .. } => "tension_too_small",
            Self::Cable { source: CableError::Overstrained { .. }, .. } | Self::Overstrained { .. } => {
                "cable_overstrained"
            }
            Self::Cable { source: CableError::AtPulley { .. }, .. } => "cable_at_its_pulley",
            Self::Cable { .. } => "cable",
            Self::Invalid { .. } => "invalid_input",
            Self::NoRest { nearest: RestFault::TurnedOver { is_stable: false, .. }, .. } => "unstable",
            Self::NoTensions { .. } | Self::ExitLimit { .. } | Self::NoRest { .. } => "infeasible_tension",
            Self::TensionChange { source, .. } => source.kind(),
            Self::NotUnique { .. } => "not_unique",
            Self::FreeCoordinates { .. } => "free_coordinates",
            Self::InverseNotConverged { .. } => "inverse_not_converged",
            Self::Indifferent { .. } => "indifferent",
            Self::Unstable { .. } => "unstable",
            Self::EquilibriumLost { .. } => "equilibrium_lost",
            Self::BranchEnds(_) => "branch_ends",
            Self::NoDerivative { .. } => "no_derivative",
            Self::NotCertified { .. } => "not_certified",
            Self::DirectNotConverged { .. } => "direct_not_converged",
        }
    }

    /// With the share of a change of load as that of another one.
    #[must_use]
    pub fn with_share(mut self, of: impl Fn(f64) -> f64) -> Self {
        if let Self::BranchEnds(end) = &mut self {
            end.share = of(end.share);
        }
        self
    }

    /// With the cables of an error of the direct model renumbered, as where it is about some cables of a
    /// robot.
    #[must_use]
    pub fn with_cables(mut self, of: impl Fn(usize) -> usize) -> Self {
        if let Self::Cable { index, .. } | Self::Overstrained { index, .. } = &mut self {
            *index = of(*index);
        }
        self
    }

    pub(crate) fn invalid(field: String, value: impl ToString, expected: impl ToString) -> Self {
        Self::Invalid {
            field,
            value: shortened(&value.to_string()),
            expected: shortened(&expected.to_string()),
        }
    }

    /// Refuses a pose that is not finite.
    pub(crate) fn finite_pose(field: &str, pose: &Pose) -> Result<(), Self> {
        if pose.is_finite() {
            return Ok(());
        }
        let position = format!("{:?}", pose.position.as_slice());
        Err(Self::invalid(field.to_owned(), position, "a finite pose"))
    }

    pub(crate) fn cable(index: usize) -> impl Fn(CableError) -> Self {
        move |source| Self::Cable { index, source }
    }

    pub(crate) fn one_per_cable(field: &str, values: &[f64], cables: usize) -> Result<(), Self> {
        if values.len() == cables {
            return Ok(());
        }
        let given = format!("a list of {}", values.len());
        Err(Self::invalid(field.to_owned(), given, format!("one value for each of the {cables} cables")))
    }
}
