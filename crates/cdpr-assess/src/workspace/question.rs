//! What is asked about the positions of a grid.

use crate::capacity::WrenchSet;
use crate::safety::factors::PartialFactors;
use crate::safety::winds::AnyWeather;
use cdpr_dynamics::Damping;
use cdpr_robot::{Coordinate, Robot, Rotation3, Vector3};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, Grid, StudyError};

/// The question about every position of a grid.
#[derive(Clone, Copy, Debug)]
pub struct Workspace<'a> {
    /// The robot.
    pub robot: &'a Robot,
    /// The positions.
    pub grid: Grid,
    /// The orientation at all positions.
    pub rotation: Rotation3<f64>,
    /// The load whose effect is the deflection. Without it only tensions and stiffness are computed.
    pub load: Load,
    /// The uncertain parameters; `None` if no tolerance is wanted.
    pub tolerances: Option<&'a ErrorModel>,
    /// Coordinates that are found at every position, for a robot with fewer cables than free motions: as many
    /// as cables are missing.
    pub free: &'a [Coordinate],
    /// What is asked for besides.
    pub further: Further<'a>,
}

/// Questions whose answers take longer than the others.
#[derive(Clone, Copy, Debug, Default)]
pub struct Further<'a> {
    /// The greatest payload and the margins of the tensions, for a set of wrenches beside the load.
    pub capacity: Option<&'a WrenchSet>,
    /// The distances of cables to each other and to the platform.
    pub distances: bool,
    /// How far the platform may tilt.
    pub tilt: Option<TiltDirections>,
    /// The largest amplitudes of a platform that is shaken.
    pub shaking: Option<Shaking>,
    /// How far weather and load displace the platform, the lengths kept.
    pub weather: Option<AnyWeather>,
    /// Utilizations by these factors, with all cables, each of them broken and in the weather, the winches
    /// holding each position under the load.
    pub breaks: Option<PartialFactors>,
}

/// What shakes the platform, and what damps its cables.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaking {
    /// The lowest and the highest frequency [Hz]; they may be one.
    pub band: [f64; 2],
    /// What damps the cables.
    pub damping: Damping,
    /// The point of the platform that is shaken and that moves, in its frame [m].
    pub marker: Vector3<f64>,
}

impl Shaking {
    fn check(&self) -> Result<(), StudyError> {
        let Self { band: [from, to], damping: Damping { stretch, drag }, marker } = *self;
        if !(from >= 0.0 && from <= to && to > 0.0 && to.is_finite()) {
            let expected = "two ascending frequencies from 0 on, or twice one above 0 [Hz]";
            return Err(StudyError::setting("band", format!("{from:?}, {to:?}"), expected));
        }
        for (field, value) in [("damping", stretch), ("drag", drag)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(StudyError::setting(
                    field,
                    format!("{value:?}"),
                    "a finite number, zero or more",
                ));
            }
        }
        if marker.iter().any(|component| !component.is_finite()) {
            let value = format!("{:?}", marker.as_slice());
            return Err(StudyError::setting("marker", value, "finite components [m]"));
        }
        Ok(())
    }
}

/// In how many directions, and how exactly, the tilt is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TiltDirections {
    /// Number of azimuths.
    pub count: usize,
    /// Accuracy [rad].
    pub accuracy: f64,
}

/// How a load comes onto the platform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// The winches hold the pose: tensions are recomputed.
    Recomputed,
    /// The lengths are kept.
    Kept,
}

impl Way {
    /// `recomputed` or `kept`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Recomputed => "recomputed",
            Self::Kept => "kept",
        }
    }
}

/// Checks the settings.
pub(super) fn check(workspace: &Workspace) -> Result<(), StudyError> {
    let Workspace { robot, grid, load, tolerances, free, further, .. } = *workspace;
    if !(load.payload.is_finite() && load.payload >= 0.0) {
        return Err(StudyError::setting("payload", load.payload, "a finite mass, zero or more [kg]"));
    }
    for (field, vector) in [("force", load.wrench.force), ("moment", load.wrench.moment)] {
        if vector.iter().any(|component| !component.is_finite()) {
            let value = format!("{:?}", vector.as_slice());
            return Err(StudyError::setting(field, value, "finite components [N, N m]"));
        }
    }
    if tolerances.is_some() && load == Load::none() {
        return Err(StudyError::setting(
            "load",
            "zero",
            "a load that displaces the platform, because tolerances act on its deflection",
        ));
    }
    let (cables, freedoms) = (robot.cables.len(), robot.freedoms().count());
    let missing = freedoms.saturating_sub(cables);
    if free.len() != missing {
        let names: Vec<_> = free.iter().map(ToString::to_string).collect();
        let expected = format!(
            "{missing} of x, y, z, roll, pitch, yaw, for {cables} cables and {freedoms} free motions"
        );
        return Err(StudyError::setting("free", format!("[{}]", names.join(", ")), expected));
    }
    if let Some((one, expected)) = grid.of_free(free) {
        return Err(StudyError::setting("free", one, expected));
    }
    if let Some(model) = tolerances {
        model.check(robot)?;
    }
    further.shaking.as_ref().map_or(Ok(()), Shaking::check)?;
    if let Some(Err(error)) = further.breaks.as_ref().map(PartialFactors::check) {
        return Err(StudyError::setting("breaks", error, "factors of a norm"));
    }
    if further.tilt.is_some() && !free.is_empty() {
        let named = free.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        let expected = "no tilt, because the platform with free coordinates tilts as it rests";
        return Err(StudyError::setting("free", format!("[{named}]"), expected));
    }
    Ok(())
}
