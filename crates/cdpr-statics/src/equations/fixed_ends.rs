//! A cable of a robot between its two points, both fixed, as a function of its chord force.

use crate::equations::cable::Span;
use crate::equations::spanned::{end, to_base};
use cdpr_cable::{
    Cable, CableError, Catenary, HeldCable, HeldSpatialCable, LONGEST_TAUT, length_for_tension,
};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};

/// Factor on the least tension that a span demands: at the least tension itself a cable's length does not
/// follow from its tension.
pub(crate) const ABOVE_LEAST: f64 = 1.001;

/// No span demands a tension above this, relative to the weight of a cable as long as the chord.
pub(crate) const ABOVE_ANY_LEAST: f64 = 1.3;

/// Bounds of the force of a cable without a guide on the platform, `σ along + V sag` with V from zero to the
/// cable's weight: with W that weight and x its centre of gravity as a share of the horizontal distance from
/// the exit point, moments about the exit point give V = x W.
pub(crate) struct Bounds {
    pub(crate) along: [f64; 3],
    pub(crate) sag: [f64; 3],
    /// Of the longest cable [N].
    pub(crate) weight: f64,
}

/// The two points of a cable at a pose, in the level frame.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    pub(crate) cable: Cable<'a>,
    /// From the exit point to the anchor point [m].
    pub(crate) end: Vector3<f64>,
    span: Span<f64>,
    level: Option<&'a Matrix3<f64>>,
}

/// A cable between its two points with the derivatives by its chord force.
#[derive(Clone)]
pub(crate) enum FixedEnds<'a> {
    /// In the vertical plane of its points.
    Planar(HeldCable<'a>),
    /// Over a tilted axis.
    Spatial(Box<HeldSpatialCable<'a>>),
}

impl<'a> Ends<'a> {
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize) -> Self {
        let end = end(robot, pose, i);
        Self { cable: robot.cable(i), end, span: Span::new(end.into()), level: robot.gravity.level() }
    }

    /// The cable with the chord force `chord_force` [N].
    pub(crate) fn at_chord_force(&self, chord_force: f64) -> Result<FixedEnds<'a>, CableError> {
        if self.cable.leaves_its_plane() {
            let fixed = HeldSpatialCable::at_chord_force(&self.cable, self.end, chord_force)?;
            return Ok(FixedEnds::Spatial(Box::new(fixed)));
        }
        Ok(FixedEnds::Planar(HeldCable::at_chord_force(&self.cable, self.span.end.into(), chord_force)?))
    }

    /// The cable of least tension at A.
    pub(crate) fn at_least_tension(&self) -> Result<FixedEnds<'a>, CableError> {
        if self.cable.leaves_its_plane() {
            let fixed = HeldSpatialCable::at_least_tension(&self.cable, self.end)?;
            return Ok(FixedEnds::Spatial(Box::new(fixed)));
        }
        Ok(FixedEnds::Planar(HeldCable::at_least_tension(&self.cable, self.span.end.into())?))
    }

    /// Unstrained length [m] and force (fx, fz) [N] of the cable with the tension `tension` [N] at A.
    pub(crate) fn at_tension(&self, tension: f64) -> Result<Catenary<'a>, CableError> {
        if self.cable.leaves_its_plane() {
            return Ok(self.at_chord_force(tension)?.with_tension(tension)?.catenary());
        }
        Ok(length_for_tension(&self.cable, self.span.end.into(), tension)?.catenary)
    }

    /// Height of the leave point above the entry point with the tension `tension` [N] at A [m].
    pub(crate) fn leave_height(&self, tension: f64) -> Result<f64, CableError> {
        let catenary = self.at_tension(tension)?;
        if !self.cable.leaves_its_plane() {
            return Ok(catenary.leave_point().y);
        }
        let fixed = self.at_chord_force(tension)?.with_tension(tension)?;
        let FixedEnds::Spatial(fixed) = fixed else { return Ok(0.0) };
        Ok(fixed.cable.in_plane().0.leave_point().y)
    }

    /// A tension [N] above which no cable over this span comes near its least one.
    pub(crate) fn floor(&self) -> f64 {
        let longest = self.cable.straight_length_in_space(self.end);
        ABOVE_ANY_LEAST * ABOVE_LEAST * self.cable.weight_per_length * longest
    }

    /// `tension` [N], or [`ABOVE_LEAST`] times the least tension that the span demands, if that is more.
    pub(crate) fn least_allowed(&self, tension: f64) -> Result<f64, CableError> {
        if self.floor() <= tension {
            return Ok(tension);
        }
        Ok(tension.max(ABOVE_LEAST * self.at_least_tension()?.tension()))
    }

    /// Bounds of the force on the platform; `None` for a cable with a guide.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        if self.cable.guide.is_some() {
            return None;
        }
        Some(Bounds {
            along: self.chord_pull(),
            sag: self.on_platform([0.0, 0.0, 1.0]),
            weight: LONGEST_TAUT * self.cable.weight_per_length * self.end.norm(),
        })
    }

    /// The force on the platform of a straight cable from the exit point, of one newton.
    pub(crate) fn chord_pull(&self) -> [f64; 3] {
        self.on_platform((self.end / self.end.norm()).into())
    }

    /// F_i [N], the force on the platform.
    #[inline]
    pub(crate) fn force(&self, fixed: &FixedEnds) -> [f64; 3] {
        match fixed {
            FixedEnds::Planar(fixed) => self.on_platform(self.span.plane.lift(fixed.catenary.force.into())),
            FixedEnds::Spatial(fixed) => self.on_platform(fixed.cable.force.into()),
        }
    }

    /// dF_i/dσ.
    #[inline]
    pub(crate) fn force_slope(&self, fixed: &FixedEnds) -> [f64; 3] {
        match fixed {
            FixedEnds::Planar(fixed) => self.on_platform(self.span.plane.lift(fixed.force_slope.into())),
            FixedEnds::Spatial(fixed) => self.on_platform(fixed.force_slope.into()),
        }
    }

    /// d²F_i/dσ² [1/N] and d²t/dσ² [1/N].
    pub(crate) fn curvatures(&self, fixed: &FixedEnds) -> ([f64; 3], f64) {
        match fixed {
            FixedEnds::Planar(fixed) => {
                let force = fixed.force_curvature();
                (self.on_platform(self.span.plane.lift(force.into())), fixed.tension_curvature(&force))
            }
            FixedEnds::Spatial(fixed) => {
                let force = fixed.force_curvature();
                (self.on_platform(force.into()), fixed.tension_curvature(&force))
            }
        }
    }

    fn on_platform(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        to_base(self.level, [-x, -y, -z])
    }
}

impl<'a> FixedEnds<'a> {
    /// The same cable with another chord force [N].
    pub(crate) fn with_chord_force(&self, chord_force: f64) -> Result<Self, CableError> {
        Ok(match self {
            Self::Planar(fixed) => Self::Planar(fixed.with_chord_force(chord_force)?),
            Self::Spatial(fixed) => Self::Spatial(Box::new(fixed.with_chord_force(chord_force)?)),
        })
    }

    /// The same cable with the tension `tension` [N] at A, on its taut branch.
    pub(crate) fn with_tension(&self, tension: f64) -> Result<Self, CableError> {
        Ok(match self {
            Self::Planar(fixed) => Self::Planar(fixed.with_tension(tension)?),
            Self::Spatial(fixed) => Self::Spatial(Box::new(fixed.with_tension(tension)?)),
        })
    }

    /// σ [N].
    #[inline]
    pub(crate) fn chord_force(&self) -> f64 {
        match self {
            Self::Planar(fixed) => fixed.chord_force,
            Self::Spatial(fixed) => fixed.chord_force,
        }
    }

    /// t [N].
    pub(crate) fn tension(&self) -> f64 {
        match self {
            Self::Planar(fixed) => fixed.tension(),
            Self::Spatial(fixed) => fixed.tension(),
        }
    }

    /// dt/dσ.
    pub(crate) fn tension_slope(&self) -> f64 {
        match self {
            Self::Planar(fixed) => fixed.tension_slope(),
            Self::Spatial(fixed) => fixed.tension_slope(),
        }
    }

    /// Unstrained length and force (fx, fz) on the cable at A. The guide of a cable over a tilted axis is
    /// that in the level frame.
    pub(crate) fn catenary(&self) -> Catenary<'a> {
        match self {
            Self::Planar(fixed) => fixed.catenary,
            Self::Spatial(fixed) => Catenary {
                cable: fixed.cable.cable,
                unstrained_length: fixed.cable.unstrained_length,
                force: Vector2::new(fixed.cable.force.xy().norm(), fixed.cable.force.z),
            },
        }
    }

    /// w c/2σ: half the angle, as a hyperbolic one, that the cable's direction turns through.
    pub(crate) fn slackness(&self) -> f64 {
        let (cable, chord) = match self {
            Self::Planar(fixed) => (&fixed.catenary.cable, fixed.end.norm()),
            Self::Spatial(fixed) => (&fixed.cable.cable, fixed.end.norm()),
        };
        0.5 * cable.weight_per_length * chord / self.chord_force()
    }
}
