//! Why a robot is left to the scalar models.

use cdpr_robot::{Coordinate, Robot};
use std::fmt;

/// Why an observation is made by the scalar models and not in the lanes of the vector unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ScalarReason {
    /// It was asked for alone.
    OneByOne,
    /// Another output than a displacement was asked for.
    Output,
    /// Coordinates of the pose are free, and no stable rest was found close to that of the nominal robot,
    /// with taut cables and tensions within their limits.
    FreeCoordinates,
    /// There are fewer cables than free motions and no coordinate is free, or one cable alone, or the
    /// platform moves in a plane and gravity is a vector.
    FewCables,
    /// The nominal robot has no tensions at the pose.
    NominalRobot,
    /// The parameters of the perturbed robot are out of their ranges.
    InvalidRobot,
    /// The tensions nearest to their reference were not found: a cable may hang at the least tension that its
    /// length allows.
    Tensions,
    /// A cable is folded, or the limits of its tension exclude each other.
    Folded,
    /// The lengths for the set-points were not found.
    Lengths,
    /// No stable equilibrium without the load was found.
    Unloaded,
    /// No stable equilibrium with the load was found that is close to what the unloaded one predicts, so
    /// that the platform may fall while the load is raised.
    Loaded,
    /// Derivatives were asked for that lanes do not have: with free coordinates, over tilted axes, where
    /// those by some parameter may differ on its two sides or do not exist, and where a tension is at its
    /// greatest value at the leave point of a pulley.
    Derivatives,
    /// It is observed in weather.
    Weather,
}

impl fmt::Display for ScalarReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.sentence())
    }
}

impl ScalarReason {
    /// All reasons with their names in files.
    const NAMES: [(Self, &'static str); 13] = [
        (Self::OneByOne, "one_by_one"),
        (Self::Output, "output"),
        (Self::FreeCoordinates, "free_coordinates"),
        (Self::FewCables, "few_cables"),
        (Self::NominalRobot, "nominal_robot"),
        (Self::InvalidRobot, "invalid_robot"),
        (Self::Tensions, "tensions"),
        (Self::Folded, "folded"),
        (Self::Lengths, "lengths"),
        (Self::Unloaded, "unloaded"),
        (Self::Loaded, "loaded"),
        (Self::Derivatives, "derivatives"),
        (Self::Weather, "weather"),
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        Self::NAMES.iter().find(|(reason, _)| *reason == self).map_or("", |(_, name)| name)
    }

    /// What about the robot or the question the lanes do not have, as the end of a sentence.
    fn sentence(self) -> &'static str {
        match self {
            Self::OneByOne => "they were asked for one by one",
            Self::Output => "only the output \"deflection\" has the fast models",
            Self::FreeCoordinates => "no stable rest with taut cables within their limits was found nearby",
            Self::FewCables => "there are fewer cables than free motions and no coordinate is free",
            Self::NominalRobot => "the nominal robot has no tensions at the pose",
            Self::InvalidRobot => "parameters are out of their ranges",
            Self::Tensions => "the best tensions were not found by the fast models",
            Self::Folded => "cables fold, or the limits of their tensions exclude each other",
            Self::Lengths => "the lengths for the set-points were not found by the fast models",
            Self::Unloaded => "no stable equilibrium without the load was found by the fast models",
            Self::Loaded => "the load changes the stiffness so much that it is raised in steps",
            Self::Derivatives => "the fast models do not have these derivatives",
            Self::Weather => "the fast models have no weather",
        }
    }

    /// The reason of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(reason, _)| *reason)
    }

    /// Why all robots like this one are left to the scalar models, if they are.
    pub(crate) fn of_all(robot: &Robot, free: &[Coordinate]) -> Option<Self> {
        // The level frame, which deviates with gravity, constrains other motions than the base frame.
        let inclined = robot.plane.is_some() && robot.gravity.is_vector();
        // Nothing resists the rotation about a single cable.
        let enough = robot.is_fully_actuated() || (robot.cables.len() > 1 && !free.is_empty());
        (inclined || !enough).then_some(Self::FewCables)
    }
}

/// Whether cables of a robot run over pulleys whose axes are not vertical.
pub(crate) fn has_tilted_axes(robot: &Robot) -> bool {
    (0..robot.cables.len()).any(|i| robot.cable(i).leaves_its_plane())
}
