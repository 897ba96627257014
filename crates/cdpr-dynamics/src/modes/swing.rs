//! How fast a platform swings, in few numbers.

use crate::error::DynamicsError;
use crate::modes::{Mode, Modes, Wanted};
use cdpr_statics::{DirectProblem, Equilibrium};

/// How fast a platform on cables with mass swings.
///
/// The slowest motion may be that of a cable, in which the platform hardly takes part. The second one is that
/// of [`Modes::of_platform`] among those up to twice the lowest frequency on cables without mass: it contains
/// most of the platform's slowest motion there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    /// The lowest natural frequency of platform and cables [Hz], without motions that nothing resists.
    pub lowest: f64,
    /// Share of platform and payload in the kinetic energy of that motion.
    pub lowest_share: f64,
    /// The frequency with which the platform swings [Hz].
    pub platform: f64,
    /// Share of platform and payload in the kinetic energy of that motion.
    pub platform_share: f64,
}

impl Swing {
    /// About a stable equilibrium.
    ///
    /// # Errors
    /// As [`Modes::new`]; [`DynamicsError::NotStable`] where nothing resists any motion.
    pub fn new(problem: &DirectProblem, equilibrium: &Equilibrium) -> Result<Self, DynamicsError> {
        let found = Modes::new(problem, equilibrium, Wanted::OfPlatform)?;
        Self::of(&found)
            .ok_or_else(|| DynamicsError::NotStable { what: "nothing resists any motion".to_owned() })
    }

    /// That of natural motions; `None` where nothing resists any of them.
    pub fn of(found: &Modes) -> Option<Self> {
        let (lowest, platform): (&Mode, &Mode) = (found.lowest()?, found.of_platform()?);
        Some(Self {
            lowest: lowest.frequency,
            lowest_share: lowest.platform_share,
            platform: platform.frequency,
            platform_share: platform.platform_share,
        })
    }
}
