//! The tensions of a chain within a step.
//!
//! A link between the points a and b that has the direction t grows at the rate `t·(v_b - v_a)`. Where
//! velocities are greater by δ, it grows by x faster, and a time g later its tension has changed by τ(x),
//! and with it the accelerations a:
//!
//! ```text
//! x = B δ,    δ = g (a - M⁻¹ Bᵀ τ),    x + g A τ(x) = g B a,    A = B M⁻¹ Bᵀ                       (X6)
//! ```
//!
//! A has three diagonals, and couples the last links with the platform. The end of a lead moves along its
//! direction; it is a link, too. Newton's method is exact where no link goes slack or taut.

use super::cable::{CableInMotion, Instant, Start};
use cdpr_robot::Vector3;

/// An element of a chain, or a lead.
#[derive(Clone, Copy, Debug, Default)]
struct Link {
    along: Vector3<f64>,
    /// Unstrained length [m].
    length: f64,
    /// 1 over the mass at its end [1/kg], zero at the platform.
    lightness: f64,
    /// Elements of A on the diagonal and right of it.
    own: f64,
    next: f64,
    /// Right side [m/s].
    wanted: f64,
    /// x [m/s].
    change: f64,
    /// τ ≈ offset + slope x [N].
    offset: f64,
    slope: f64,
    pivot: f64,
    right: f64,
}

/// The links of a cable from its begin to its anchor point.
#[derive(Clone, Debug, Default)]
pub(super) struct Links(Vec<Link>);

impl Links {
    /// Links at an instant, with the accelerations of the unknowns and of the anchor point; the changes are
    /// those of the step before.
    pub(super) fn prepare(
        &mut self,
        cable: &CableInMotion,
        at: &Instant,
        (own, anchor): (&[f64], &Vector3<f64>),
        g: f64,
    ) {
        let Some(mesh) = &cable.mesh else { return };
        let masses = &at.forces.masses;
        let mut next = 0;
        // Acceleration and 1 over the mass of the point before a link, and the direction to which it is
        // bound.
        let (mut before, mut lightness, mut way) = (Vector3::zeros(), 0.0, None);
        self.0.resize(at.forces.pulls.len() + usize::from(cable.is_led()), Link::default());
        let mut links = self.0.iter_mut();
        match (&cable.start, &at.way) {
            (Start::Led(lead), Some(at_lead)) => {
                way = Some(at_lead.direction);
                (before, next) = (at_lead.direction * own[0], 1);
                lightness = 1.0 / (masses[0] + lead.mass(&cable.material));
                if let Some(link) = links.next() {
                    (link.along, link.length) = (at_lead.direction, lead.unstrained());
                    (link.lightness, link.own, link.wanted) = (lightness, lightness, g * own[0]);
                }
            }
            (Start::Loose, _) => {
                (before, next) = (Vector3::from_column_slice(&own[..3]), 3);
                lightness = 1.0 / masses[0];
            }
            _ => {}
        }
        for (k, (link, part)) in links.zip(mesh.parts(at.length.0)).enumerate() {
            let (after, last) = match own.get(next..next + 3) {
                Some(own) => (Vector3::from_column_slice(own), 1.0 / masses[k + 1]),
                None => (*anchor, 0.0),
            };
            next += 3;
            let along = at.forces.pulls[k].along;
            let share = way.take().map_or(1.0, |way| way.dot(&along).powi(2));
            (link.along, link.length, link.lightness) = (along, part.length, last);
            (link.own, link.wanted) = (lightness * share + last, g * along.dot(&(after - before)));
            (before, lightness) = (after, last);
        }
        for k in 1..self.0.len() {
            let coupling = self.0[k - 1].along.dot(&self.0[k].along);
            self.0[k - 1].next = -self.0[k - 1].lightness * coupling;
        }
    }

    /// Tensions at the changes; by how much they differ from what was expected, relative to the modulus.
    pub(super) fn pull(&mut self, cable: &CableInMotion, at: &Instant, stage: [&[f64]; 2], g: f64) -> f64 {
        let mut off = 0.0_f64;
        let material = &cable.material;
        let mut update = |link: &mut Link, tension: f64, slope: f64, modulus: f64| {
            off = off.max((tension - link.offset - link.slope * link.change).abs() / modulus);
            (link.offset, link.slope) = (tension - slope * link.change, slope);
        };
        let mut links = self.0.iter_mut();
        if let (Start::Led(lead), Some(link)) =
            (&cable.start, if cable.is_led() { links.next() } else { None })
        {
            let (longer, rate) = (stage[0][0], stage[1][0]);
            let before = lead.pull(material, longer, rate).0.tension;
            let (pull, [stiffness, damping]) =
                lead.pull(material, longer + g * link.change, rate + link.change);
            let modulus = material.cable.tangent_stiffness(pull.elastic);
            update(link, pull.tension - before, g * stiffness + damping, modulus);
        }
        for (link, before) in links.zip(&at.forces.pulls) {
            let faster = link.change / link.length;
            let pull = material.stretched(before.along, before.stretch + g * faster, before.rate + faster);
            let modulus = material.cable.tangent_stiffness(pull.elastic);
            let slope = (g * pull.modulus + pull.viscosity) / link.length;
            update(link, pull.tension - before.tension, slope, modulus);
        }
        off
    }

    /// Eliminates all changes but the last one: the tension on the platform and its slope, by how much faster
    /// than expected its anchor point moves away.
    pub(super) fn eliminate(&mut self, g: f64) -> [f64; 2] {
        let mut before: Option<Link> = None;
        let mut links = self.0.iter_mut().peekable();
        while let Some(link) = links.next() {
            let after = links.peek().map_or(0.0, |after| link.next * after.offset);
            link.pivot = 1.0 + g * link.own * link.slope;
            link.right = link.wanted - g * (link.own * link.offset + after);
            if let Some(before) = &before {
                let coupling = g * before.next;
                let factor = coupling * before.slope / before.pivot;
                link.pivot -= factor * coupling * link.slope;
                link.right -= coupling * before.offset + factor * before.right;
            }
            before = Some(*link);
        }
        before.map_or([0.0; 2], |last| {
            let slope = last.slope / last.pivot;
            [last.offset + slope * last.right, slope]
        })
    }

    /// The changes, by how much faster than expected its anchor point moves away.
    pub(super) fn solve(&mut self, g: f64, faster: f64) {
        let mut after: Option<Link> = None;
        for link in self.0.iter_mut().rev() {
            let known = match &after {
                Some(after) => -g * link.next * after.slope * after.change,
                None => faster,
            };
            link.change = (link.right + known) / link.pivot;
            after = Some(*link);
        }
    }

    /// Adds what the changes of the tensions do to the accelerations of the unknowns, and keeps the tensions.
    pub(super) fn apply(&self, cable: &CableInMotion, at: &mut Instant, own: &mut [f64], g: f64) {
        let tension = |link: &Link| link.offset + link.slope * link.change;
        let mut next = 0;
        if let (Start::Loose, Some(link)) = (&cable.start, self.0.first()) {
            let acceleration = link.along * (tension(link) / at.forces.masses[0]);
            (0..3).for_each(|k| own[k] += acceleration[k]);
            next = 3;
        }
        for pair in self.0.windows(2) {
            let force = pair[1].along * tension(&pair[1]) - pair[0].along * tension(&pair[0]);
            let acceleration = force * pair[0].lightness;
            if cable.is_led() && next == 0 {
                own[0] += pair[0].along.dot(&acceleration);
                next = 1;
            } else {
                (0..3).for_each(|k| own[next + k] += acceleration[k]);
                next += 3;
            }
        }
        let first = usize::from(cable.is_led());
        for (link, pull) in self.0[first..].iter().zip(&mut at.forces.pulls) {
            let faster = link.change / link.length;
            *pull = cable.material.stretched(pull.along, pull.stretch + g * faster, pull.rate + faster);
        }
    }

    /// Direction of the last link.
    pub(super) fn last(&self) -> Vector3<f64> {
        self.0.last().map_or_else(Vector3::zeros, |link| link.along)
    }
}
