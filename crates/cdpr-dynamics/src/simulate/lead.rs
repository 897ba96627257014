//! How a cable comes to the point where its free part begins.
//!
//! Lead and arc are a spring of the unstrained length l that is longer by e than at rest. Material at its end
//! is at r_0, on the tangent of the wheel at the leave point B. The angle ψ of B follows the straight line to
//! the next point r_1 of the cable, with the constant difference that it has at rest. The wheel's yaw θ is an
//! unknown with the scale ρ_0, its distance from B at rest:
//!
//! ```text
//! r_0 = B(θ, ψ) + x u(θ, ψ),    x = e - arc(ψ) + arc at rest,    y = ρ_0 θ
//! dr_0 = u de + k dy + G dr_1,    k = (ρ + x sin ψ)/ρ_0 s,    G = x n dψ/dr_1                      (X4)
//! (m_0 + μ l/3) ë = (f_0 + m_0 g) u - T(e) - w u_z e/(1 + ε)
//! m_0 ÿ = (f_0 + m_0 g) k,    m_1 r̈_1 = f_1 + m_1 g + Gᵀ (f_0 + m_0 g)
//! ```
//!
//! with the distance ρ of B from the swivel axis, s across the wheel and n normal to u in its plane. All forces
//! are derivatives of one potential. The last term of ë is the weight of the cable that has come out. Cable on
//! a pulley has no mass, and the wheel has none. The first link of a chain shows where the wheel is: there θ
//! follows the line to r_1, too, and G has its part.
//!
//! The first point of a slack cable may come to the wheel. The line to it leans back towards the swivel axis
//! then, and the cable lies on more than half of the wheel; a point within the wheel is taken for the nearest
//! one on it. Without that the length of lead and arc would jump, and a chain gain the energy of its stretch.
//! Within the wheel it does jump, where the cable would lie on all of it: the first link of a chain is longer
//! than this, so that it is slack there.

use super::mesh::{Material, Pull};
use cdpr_cable::Guide;
use cdpr_robot::{Matrix3, Robot, Vector3};
use std::f64::consts::PI;

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
    bend: Bend,
    swivel: Option<Swivel>,
}

/// By how much a cable leaves otherwise than along the line to its next point, at rest.
#[derive(Clone, Copy, Debug)]
enum Bend {
    /// Without pulley: a vector that is added to the direction.
    Lean(Vector3<f64>),
    /// On a wheel: the angle of the leave point is greater by this [rad].
    Turned(f64),
}

/// A wheel whose yaw is an unknown.
#[derive(Clone, Copy, Debug)]
struct Swivel {
    /// Where the wheel is at rest: a unit vector from the swivel axis, in the levelled frame.
    outwards: Vector3<f64>,
    /// The unknown is its yaw times this distance [m].
    arm: f64,
}

/// Where the free part begins, for a place of its next point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) point: Vector3<f64>,
    pub(super) direction: Vector3<f64>,
    /// Stretched length before it [m], and that of a straight cable beyond it [m].
    pub(super) guided: f64,
    pub(super) free: f64,
    /// How it turns, by θ and by ψ.
    turns: [Turn; 2],
}

/// How the end of a lead moves where its direction turns.
#[derive(Clone, Copy, Debug)]
struct Turn {
    /// Unit vector of the motion, and towards the axis about which it turns.
    along: Vector3<f64>,
    inwards: Vector3<f64>,
    /// Distance of the leave point from this axis [m], and how much of the length beyond it counts.
    distance: f64,
    share: f64,
    /// Angle for each motion of the next point [rad/m].
    slope: Vector3<f64>,
}

impl Lead {
    /// Lead and pulley of cable `i`, with its direction behind them and its tension at rest; `None` for a
    /// cable that begins at its exit point.
    pub(super) fn new(
        robot: &Robot,
        i: usize,
        material: &Material,
        (direction, tension): (&Vector3<f64>, f64),
    ) -> Option<Self> {
        let level = robot.gravity.level().copied();
        let guide = robot.cables[i].guide(level.as_ref())?;
        let strain = material.cable.strain(tension);
        let mut lead = Self {
            guide,
            entry: robot.cables[i].exit_point,
            level,
            unstrained: 1.0,
            stretched: 1.0,
            slide: 0.0,
            bend: Bend::of(&guide),
            swivel: None,
        };
        let axis = Vector3::from(guide.entry.axis());
        let arc = guide.radius * (PI - angle_of(&lead.levelled(direction), &axis));
        let up = -robot.gravity.vector() / robot.gravity.magnitude().max(f64::MIN_POSITIVE);
        lead.stretched = guide.lead + arc;
        lead.unstrained = lead.stretched / (1.0 + strain);
        lead.slide = material.cable.weight_per_length * direction.dot(&up) / (1.0 + strain);
        Some(lead)
    }

    /// For a cable that leaves along `direction` where its next point is at `next`; its wheel swivels by
    /// itself.
    pub(super) fn bent(self, direction: &Vector3<f64>, next: &Vector3<f64>) -> Self {
        let way = self.straight().way(next, 0.0);
        let Guide { radius, lead, .. } = self.guide;
        if radius == 0.0 {
            return Self { bend: Bend::Lean(direction - way.direction), ..self };
        }
        let axis = Vector3::from(self.guide.entry.axis());
        let [direction, straight] = [direction, &way.direction].map(|direction| self.levelled(direction));
        let (angle, from) = (angle_of(&direction, &axis), PI - (way.guided - lead) / radius);
        let across = [direction, straight].map(|direction| direction - axis * axis.dot(&direction));
        let outwards = across.iter().find_map(|across| across.try_normalize(1e-9));
        let outwards = outwards.unwrap_or_else(|| perpendicular(&axis));
        let arm = radius * (1.0 + angle.cos()).max(LEAST_ARM);
        let swivel = Some(Swivel { outwards, arm });
        Self { bend: Bend::Turned(angle - from), swivel, ..self }
    }

    /// For a cable that leaves along the line to its next point.
    pub(super) fn straight(self) -> Self {
        Self { bend: Bend::of(&self.guide), swivel: None, ..self }
    }

    /// Whether it has a wheel that swivels by itself.
    pub(super) fn swivels(&self) -> bool {
        self.swivel.is_some()
    }

    fn levelled(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.level.map_or(*vector, |level| level * vector)
    }

    fn back(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.level.map_or(*vector, |level| level.tr_mul(vector))
    }

    /// The way of a cable to its next point; `swivelled` [m] is the unknown of a wheel that swivels by itself.
    pub(super) fn way(&self, next: &Vector3<f64>, swivelled: f64) -> Way {
        let Bend::Turned(more) = self.bend else { return self.towards(&(next - self.entry)) };
        let at = self.on_wheel(&self.levelled(&(next - self.entry)), [more, swivelled]);
        let turn = |turn: Turn| Turn {
            along: self.back(&turn.along),
            inwards: self.back(&turn.inwards),
            slope: self.back(&turn.slope),
            ..turn
        };
        Way {
            point: self.entry + self.back(&at.point),
            direction: self.back(&at.direction),
            turns: at.turns.map(turn),
            ..at
        }
    }

    /// The way from a wheel, in the levelled frame from D.
    fn on_wheel(&self, end: &Vector3<f64>, [more, swivelled]: [f64; 2]) -> Way {
        let axis = Vector3::from(self.guide.entry.axis());
        let (height, radius) = (axis.dot(end), self.guide.radius);
        let away = end - axis * height;
        let (least, x) = (NEAREST * radius, away.norm());
        let outwards = away.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| perpendicular(&axis));
        // As `Guide::straight`, from any place.
        let from_center = x - radius;
        let free = from_center.mul_add(from_center, height * height - radius * radius).max(0.0).sqrt();
        let from = height.atan2(from_center) + free.atan2(radius);
        let (x, free) = (x.max(least), free.max(least));
        let turned = self.swivel.map_or(outwards, |Swivel { outwards, arm }| {
            let (sin, cos) = (swivelled / arm).sin_cos();
            outwards * cos + axis.cross(&outwards) * sin
        });
        let (sin, cos) = (from + more).sin_cos();
        let (normal, direction) = (turned * cos + axis * sin, turned * sin - axis * cos);
        let about_axis = Turn {
            along: axis.cross(&turned),
            inwards: -turned,
            distance: radius * (1.0 + cos),
            share: sin,
            slope: axis.cross(&outwards) / x,
        };
        let about_leave = Turn {
            along: normal,
            inwards: -direction,
            distance: 0.0,
            share: 1.0,
            slope: (outwards * from.cos() + axis * from.sin()) / free,
        };
        Way {
            point: turned * (radius * (1.0 + cos)) + axis * (radius * sin),
            direction,
            guided: self.guide.lead + radius * (PI - from - more),
            free,
            turns: [about_axis, about_leave],
        }
    }

    /// The way from the entry, to a point from there.
    fn towards(&self, end: &Vector3<f64>) -> Way {
        let free = end.norm().max(f64::MIN_POSITIVE);
        let to_end = end / free;
        let leaning = to_end + if let Bend::Lean(lean) = self.bend { lean } else { Vector3::zeros() };
        let direction = leaning.normalize();
        let first = perpendicular(&direction);
        let turn = |along: Vector3<f64>| Turn {
            along,
            inwards: -direction,
            distance: 0.0,
            share: 1.0,
            slope: (along - to_end * to_end.dot(&along)) / (free * leaning.norm()),
        };
        let turns = [turn(first), turn(direction.cross(&first))];
        Way { point: self.entry, direction, guided: self.guide.lead, free, turns }
    }

    /// Unstrained length [m].
    pub(super) fn unstrained(&self) -> f64 {
        self.unstrained
    }

    /// Place of the end of lead and arc that are longer by `longer` [m] than at rest.
    pub(super) fn end(&self, way: &Way, longer: f64) -> Vector3<f64> {
        way.point + way.direction * self.beyond(way, longer)
    }

    /// Length between the leave point and the end [m].
    fn beyond(&self, way: &Way, longer: f64) -> f64 {
        longer - (way.guided - self.stretched)
    }

    /// How the end moves with the next point, G, and with the unknown of a wheel that swivels by itself.
    pub(super) fn turning(&self, way: &Way, longer: f64) -> (Matrix3<f64>, Option<Vector3<f64>>) {
        let beyond = self.beyond(way, longer);
        // Behind its next point the end would turn by more than that, without bound at the wheel.
        let radius = |turn: &Turn| {
            let most = 1.0 / turn.slope.norm();
            turn.radius(beyond).min(most).max(-most)
        };
        let by = |turn: &Turn| turn.along * turn.slope.transpose() * radius(turn);
        let [about_axis, about_leave] = &way.turns;
        match &self.swivel {
            Some(Swivel { arm, .. }) => {
                (by(about_leave), Some(about_axis.along * (about_axis.radius(beyond) / arm)))
            }
            None => (by(about_axis) + by(about_leave), None),
        }
    }

    /// Stiffness that a force on the end has for the next point, because the end goes along circles; that of
    /// a wheel that swivels by itself with the first unknown, and its own.
    pub(super) fn bending(
        &self,
        way: &Way,
        longer: f64,
        force: &Vector3<f64>,
    ) -> (Matrix3<f64>, Option<[f64; 2]>) {
        let beyond = self.beyond(way, longer);
        let own = |turn: &Turn| -turn.radius(beyond) * turn.inwards.dot(force);
        let of = |turn: &Turn| turn.slope * turn.slope.transpose() * own(turn);
        let [about_axis, about_leave] = &way.turns;
        match &self.swivel {
            Some(Swivel { arm, .. }) => {
                let with_longer = -about_axis.share * about_axis.along.dot(force) / arm;
                (of(about_leave), Some([with_longer, own(about_axis) / (arm * arm)]))
            }
            None => (of(about_axis) + of(about_leave), None),
        }
    }

    /// Most by which the line to a point near the wheel is longer than at rest, with a quarter of a turn to
    /// spare [m].
    pub(super) fn around(&self) -> f64 {
        self.guide.lead + 2.5 * PI * self.guide.radius - self.stretched
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

    /// The unknown of its wheel where that is as at the rest of another state [m].
    pub(super) fn swivelled_for(&self, other: &Self) -> f64 {
        let (Some(Swivel { outwards, arm }), Some(other)) = (&self.swivel, &other.swivel) else { return 0.0 };
        let axis = Vector3::from(self.guide.entry.axis());
        arm * axis.dot(&outwards.cross(&other.outwards)).atan2(outwards.dot(&other.outwards))
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

impl Turn {
    /// Distance of the end from the axis about which it turns [m].
    fn radius(&self, beyond: f64) -> f64 {
        self.distance + self.share * beyond
    }
}

impl Bend {
    /// That of a cable which leaves along the line to its next point.
    fn of(guide: &Guide) -> Self {
        if guide.radius > 0.0 { Self::Turned(0.0) } else { Self::Lean(Vector3::zeros()) }
    }
}

/// Least distance of a leave point from its swivel axis with which the unknown is scaled, relative to the
/// radius of the wheel.
const LEAST_ARM: f64 = 0.1;

/// Least distance of the next point from the swivel axis, and along the line to it, with which turns are
/// computed, relative to the radius of the wheel.
const NEAREST: f64 = 1e-3;

/// The angle of the leave point of a cable that leaves in a direction, from the wheel's outermost point.
fn angle_of(direction: &Vector3<f64>, axis: &Vector3<f64>) -> f64 {
    let along = axis.dot(direction);
    (direction - axis * along).norm().atan2(-along)
}

/// A unit vector across a unit vector.
fn perpendicular(direction: &Vector3<f64>) -> Vector3<f64> {
    direction.cross(&if direction.x.abs() < 0.8 { Vector3::x() } else { Vector3::y() }).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At rest a cable leaves the wheel along a horizontal line.
    fn on_wheel() -> Lead {
        let guide = Guide { lead: 1.0, radius: 0.05, entry: cdpr_cable::Entry::Upwards };
        let (entry, stretched, bend) = (Vector3::zeros(), 1.0 + 0.025 * PI, Bend::of(&guide));
        Lead { guide, entry, level: None, unstrained: 1.0, stretched, slide: 0.0, bend, swivel: None }
    }

    #[test]
    fn a_cable_that_leans_back_under_its_wheel_grows_no_more_than_its_point_moves() {
        const STEP: f64 = 1e-3;
        for z in [-0.051, -0.1, -1.0, 0.051] {
            let way = |k: i32| on_wheel().way(&Vector3::new(STEP * f64::from(k), 0.0, z), 0.0);
            let lengths: Vec<f64> = (-300..300).map(way).map(|way| way.guided + way.free).collect();
            let most = lengths.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
            assert!(most <= STEP * (1.0 + 1e-9), "{z} m: {most} m");
        }
    }

    #[test]
    fn at_the_wheel_a_cable_is_shorter_than_its_first_link_and_turns_no_more_than_its_point() {
        for (i, k) in (-30..30).flat_map(|i| (-30..30).map(move |k| (i, k))) {
            let ([x, z], lead) = ([i, k].map(|of| 2e-3 * f64::from(of)), on_wheel());
            let way = lead.way(&Vector3::new(x, 1e-4, z), 0.0);
            let longer = way.guided + way.free - lead.stretched;
            let turning = lead.turning(&way, 0.0).0.norm();
            assert!(longer < lead.around() && turning < 2.0, "({x}, {z}) m: {longer} m, {turning}");
        }
    }
}
