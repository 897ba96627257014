//! How a cable comes to the point where its free part begins.
//!
//! Lead and arc are a spring of the unstrained length l that is longer by e than at rest. Its end moves along
//! the direction u of a straight cable to the anchor point, from its leave point B, both corrected by what
//! sag changes at rest:
//!
//! ```text
//! r_0 = B + (e - arc + arc at rest) u
//! (m_0 + μ l/3) ë = (f_0 + m_0 g) u - T(e) - w u_z e/(1 + ε)                                       (X4)
//! ```
//!
//! The last term is the weight of the cable that has come out. Cable on a pulley has no mass.

use super::mesh::{Material, Pull};
use cdpr_cable::Guide;
use cdpr_robot::{Matrix3, Robot, Vector3};

/// A lead and a pulley. Cable on them has no mass of its own; a third of that of a lead is at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lead {
    guide: Guide,
    entry: Vector3<f64>,
    /// From the base frame to one in which gravity acts along -z.
    level: Option<Matrix3<f64>>,
    /// Unstrained and stretched length at rest [m].
    unstrained: f64,
    stretched: f64,
    /// Change of the tension by the weight of the cable that comes out [N/m].
    slide: f64,
    /// Direction and leave point at rest, minus those of a straight cable.
    lean: Vector3<f64>,
    shift: Vector3<f64>,
}

/// Where the free part begins, for a place of the anchor point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) point: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
    /// Stretched length before it [m], and that of a straight cable beyond it [m].
    pub(super) guided: f64,
    pub(super) free: f64,
}

/// A cable at rest where its free part begins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    pub(super) anchor: Vector3<f64>,
    pub(super) leave: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
    pub(super) tension: f64,
}

impl Lead {
    /// Lead and pulley of cable `i`; `None` for a cable that begins at its exit point.
    pub(super) fn new(robot: &Robot, i: usize, material: &Material, rest: &Rest) -> Option<Self> {
        let level = robot.gravity.level().copied();
        let guide = robot.cables[i].guide(level.as_ref())?;
        let strain = material.cable.strain(rest.tension);
        let mut lead = Self {
            guide,
            entry: robot.cables[i].exit_point,
            level,
            unstrained: 1.0,
            stretched: 1.0,
            slide: 0.0,
            lean: Vector3::zeros(),
            shift: Vector3::zeros(),
        };
        let straight = lead.way(&rest.anchor);
        let up = -robot.gravity.vector() / robot.gravity.magnitude().max(f64::MIN_POSITIVE);
        lead.stretched = straight.guided;
        lead.unstrained = straight.guided / (1.0 + strain);
        lead.slide = material.cable.weight_per_length * rest.direction.dot(&up) / (1.0 + strain);
        lead.lean = rest.direction - straight.direction;
        lead.shift = rest.leave - straight.point;
        Some(lead)
    }

    /// The way of a straight cable to `anchor`, corrected by what sag changes at rest.
    pub(super) fn way(&self, anchor: &Vector3<f64>) -> Way {
        let span = anchor - self.entry;
        let end = self.level.map_or(span, |level| level * span);
        let (leave, free, guided) = match self.guide.straight(end) {
            Some(straight) => (straight.leave, straight.free, straight.guided),
            None => (Vector3::zeros(), end.norm(), self.guide.lead),
        };
        let back = |vector: Vector3<f64>| self.level.map_or(vector, |level| level.tr_mul(&vector));
        let direction = back(end - leave) / free.max(f64::MIN_POSITIVE) + self.lean;
        Way { point: self.entry + back(leave) + self.shift, direction: direction.normalize(), guided, free }
    }

    /// Unstrained length [m].
    pub(super) fn unstrained(&self) -> f64 {
        self.unstrained
    }

    /// Place of the end of lead and arc that are longer by `longer` [m] than at rest.
    pub(super) fn end(&self, way: &Way, longer: f64) -> Vector3<f64> {
        way.point + way.direction * (longer - (way.guided - self.stretched))
    }

    /// Tension of the lead, and its slopes by `longer` and by its rate.
    pub(super) fn pull(&self, material: &Material, longer: f64, rate: f64) -> (Pull, [f64; 2]) {
        let stretch = (self.stretched + longer) / self.unstrained;
        let mut pull = material.stretched(Vector3::zeros(), stretch, rate / self.unstrained);
        let slopes = [pull.modulus / self.unstrained + self.slide, pull.viscosity / self.unstrained];
        pull.tension += self.slide * longer;
        (pull, slopes)
    }

    /// By how much it is longer where it carries the tension of another state.
    pub(super) fn longer_for(&self, other: &Self) -> f64 {
        self.unstrained * other.stretched / other.unstrained - self.stretched
    }

    /// Energy [J] of the lead, and power lost in it [W].
    pub(super) fn energy(&self, material: &Material, longer: f64, rate: f64) -> [f64; 2] {
        let (pull, _) = self.pull(material, longer, rate);
        let stored = material.energy(&pull) * self.unstrained + 0.5 * self.slide * longer * longer;
        [stored, pull.viscosity * pull.rate * pull.rate * self.unstrained]
    }

    /// A third of its mass moves with its end [kg].
    pub(super) fn mass(&self, material: &Material) -> f64 {
        material.density * self.guide.lead * (self.unstrained / self.stretched) / 3.0
    }
}
