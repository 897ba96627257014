//! A cable of a robot between its two points, both held, as a function of its chord force.

use crate::equations::cable::{CablePlane, Span};
use crate::equations::spanned::{end, to_base};
use cdpr_cable::{Cable, CableError, Catenary, HeldCable, HeldSpatialCable, length_for_tension};
use cdpr_robot::{Matrix3, Pose, Robot, Vector2, Vector3};

/// Factor on the least tension that a span demands: at the least tension itself a cable's length does not
/// follow from its tension.
pub(crate) const ABOVE_LEAST: f64 = 1.001;

/// No span demands a tension above this, relative to the weight of a cable as long as the chord.
pub(crate) const ABOVE_ANY_LEAST: f64 = 1.3;

/// The two points of a cable at a pose, in the level frame.
#[derive(Clone, Copy)]
pub(crate) struct Ends<'a> {
    pub(crate) cable: Cable<'a>,
    /// From the exit point to the anchor point [m].
    pub(crate) end: Vector3<f64>,
    level: Option<&'a Matrix3<f64>>,
}

/// A cable between its two points with the derivatives by its chord force.
#[derive(Clone)]
pub(crate) struct Held<'a> {
    shape: Shape<'a>,
    level: Option<&'a Matrix3<f64>>,
}

#[derive(Clone)]
enum Shape<'a> {
    Planar(HeldCable<'a>, CablePlane<f64>),
    Spatial(Box<HeldSpatialCable<'a>>),
}

impl<'a> Ends<'a> {
    pub(crate) fn of(robot: &'a Robot, pose: &Pose, i: usize) -> Self {
        Self { cable: robot.cable(i), end: end(robot, pose, i), level: robot.gravity.level() }
    }

    fn span(&self) -> Span<f64> {
        Span::new(self.end.into())
    }

    fn held(&self, shape: Shape<'a>) -> Held<'a> {
        Held { shape, level: self.level }
    }

    /// The cable with the chord force `chord_force` [N].
    pub(crate) fn at_chord_force(&self, chord_force: f64) -> Result<Held<'a>, CableError> {
        Ok(self.held(if self.cable.leaves_its_plane() {
            Shape::Spatial(Box::new(HeldSpatialCable::at_chord_force(&self.cable, self.end, chord_force)?))
        } else {
            let Span { plane, end } = self.span();
            Shape::Planar(HeldCable::at_chord_force(&self.cable, end.into(), chord_force)?, plane)
        }))
    }

    /// The cable of least tension at A.
    pub(crate) fn at_least_tension(&self) -> Result<Held<'a>, CableError> {
        Ok(self.held(if self.cable.leaves_its_plane() {
            Shape::Spatial(Box::new(HeldSpatialCable::at_least_tension(&self.cable, self.end)?))
        } else {
            let Span { plane, end } = self.span();
            Shape::Planar(HeldCable::at_least_tension(&self.cable, end.into())?, plane)
        }))
    }

    /// Unstrained length [m] and force (fx, fz) [N] of the cable with the tension `tension` [N] at A.
    pub(crate) fn at_tension(&self, tension: f64) -> Result<Catenary<'a>, CableError> {
        if self.cable.leaves_its_plane() {
            return Ok(self.at_chord_force(tension)?.with_tension(tension)?.catenary());
        }
        Ok(length_for_tension(&self.cable, self.span().end.into(), tension)?.catenary)
    }

    /// Height of the leave point above the entry point with the tension `tension` [N] at A [m].
    pub(crate) fn leave_height(&self, tension: f64) -> Result<f64, CableError> {
        let catenary = self.at_tension(tension)?;
        if !self.cable.leaves_its_plane() {
            return Ok(catenary.leave_point().y);
        }
        let held = self.at_chord_force(tension)?.with_tension(tension)?;
        let Shape::Spatial(held) = held.shape else { return Ok(0.0) };
        Ok(held.cable.in_plane().0.leave_point().y)
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
}

impl<'a> Held<'a> {
    /// The same cable with another chord force [N].
    pub(crate) fn with_chord_force(&self, chord_force: f64) -> Result<Self, CableError> {
        Ok(Self {
            shape: match &self.shape {
                Shape::Planar(held, plane) => Shape::Planar(held.with_chord_force(chord_force)?, *plane),
                Shape::Spatial(held) => Shape::Spatial(Box::new(held.with_chord_force(chord_force)?)),
            },
            level: self.level,
        })
    }

    /// The same cable with the tension `tension` [N] at A, on its taut branch.
    pub(crate) fn with_tension(&self, tension: f64) -> Result<Self, CableError> {
        Ok(Self {
            shape: match &self.shape {
                Shape::Planar(held, plane) => Shape::Planar(held.with_tension(tension)?, *plane),
                Shape::Spatial(held) => Shape::Spatial(Box::new(held.with_tension(tension)?)),
            },
            level: self.level,
        })
    }

    /// σ [N].
    #[inline]
    pub(crate) fn chord_force(&self) -> f64 {
        match &self.shape {
            Shape::Planar(held, _) => held.chord_force,
            Shape::Spatial(held) => held.chord_force,
        }
    }

    /// t [N].
    pub(crate) fn tension(&self) -> f64 {
        match &self.shape {
            Shape::Planar(held, _) => held.tension(),
            Shape::Spatial(held) => held.tension(),
        }
    }

    /// dt/dσ.
    pub(crate) fn tension_slope(&self) -> f64 {
        match &self.shape {
            Shape::Planar(held, _) => held.tension_slope(),
            Shape::Spatial(held) => held.tension_slope(),
        }
    }

    /// Unstrained length and force (fx, fz) on the cable at A. The guide of a cable over a tilted axis is
    /// that in the level frame.
    pub(crate) fn catenary(&self) -> Catenary<'a> {
        match &self.shape {
            Shape::Planar(held, _) => held.catenary,
            Shape::Spatial(held) => Catenary {
                cable: held.cable.cable,
                unstrained_length: held.cable.unstrained_length,
                force: Vector2::new(held.cable.force.xy().norm(), held.cable.force.z),
            },
        }
    }

    /// w c/2σ: half the angle, as a hyperbolic one, that the cable's direction turns through.
    pub(crate) fn slackness(&self) -> f64 {
        let (cable, chord) = match &self.shape {
            Shape::Planar(held, _) => (&held.catenary.cable, held.end.norm()),
            Shape::Spatial(held) => (&held.cable.cable, held.end.norm()),
        };
        0.5 * cable.weight_per_length * chord / self.chord_force()
    }

    /// F_i [N], the force on the platform.
    pub(crate) fn force(&self) -> [f64; 3] {
        match &self.shape {
            Shape::Planar(held, plane) => self.on_platform(plane.lift(held.catenary.force.into())),
            Shape::Spatial(held) => self.on_platform(held.cable.force.into()),
        }
    }

    /// dF_i/dσ.
    pub(crate) fn force_slope(&self) -> [f64; 3] {
        match &self.shape {
            Shape::Planar(held, plane) => self.on_platform(plane.lift(held.force_slope.into())),
            Shape::Spatial(held) => self.on_platform(held.force_slope.into()),
        }
    }

    /// d²F_i/dσ² [1/N] and d²t/dσ² [1/N].
    pub(crate) fn curvatures(&self) -> ([f64; 3], f64) {
        match &self.shape {
            Shape::Planar(held, plane) => {
                let force = held.force_curvature();
                (self.on_platform(plane.lift(force.into())), held.tension_curvature(&force))
            }
            Shape::Spatial(held) => {
                let force = held.force_curvature();
                (self.on_platform(force.into()), held.tension_curvature(&force))
            }
        }
    }

    fn on_platform(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        to_base(self.level, [-x, -y, -z])
    }
}
