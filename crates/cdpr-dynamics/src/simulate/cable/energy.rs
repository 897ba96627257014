//! Energy of one cable, and what its winch and its damping do to it.
//!
//! Points of the mass m and the velocity v have the energy E, those with the unstrained length l and the
//! elastic energy u(ε) for each tension among them:
//!
//! ```text
//! E = Σ m (v²/2 - g·r) + Σ l u,    m ~ l ~ L,    dr/dt = v + c,    dv/dt = f/m + g + a
//! ```
//!
//! with what flows past the points, (X3). The point at the exit has no kinetic energy of its own there, as it
//! is no unknown; the end of a lead has that of its unknowns. The winch has to do the work by which E changes
//! then, without what viscosity loses,
//!
//! ```text
//! P = dL/dt/L (Σ m (v²/2 - g·r) + Σ l (u - (1 + ε) T)) + Σ m (v·a - g·c)
//!     + Σ l t·(T c' + τ dT/dε dε/dt b')                                                            (X7)
//! ```
//!
//! with the elastic tension T. At the exit c is the motion of the point, G c_1 of (X4) at the end of a lead;
//! b is its velocity by the winch, v_0 of (X3), and zero at other points. P tends to the force on the first
//! point times b, with the energy of the material that comes. Where the tension at the exit takes the place of
//! that force, the error of the elements is in the balance. With P, what is missing of E is due to the steps.

use super::{CableInMotion, Instant, Start};
use crate::simulate::mesh::{Mesh, Part, Points, Pull};
use cdpr_robot::Vector3;

impl CableInMotion<'_> {
    /// Kinetic energy without that of the anchor point's mass [J].
    pub(crate) fn kinetic(&self, at: &Instant, [_, rates]: [&[f64]; 2]) -> f64 {
        let before_last = at.points.positions.len().saturating_sub(1);
        let points = at.forces.masses.iter().zip(&at.points.velocities).take(before_last).skip(1);
        let mut twice: f64 = points.map(|(mass, velocity)| mass * velocity.norm_squared()).sum();
        twice += at.forces.masses.first().map_or(0.0, |mass| mass * self.square_at_start(rates));
        if let (Start::Led(lead), Some(_)) = (&self.start, &self.mesh) {
            twice += lead.mass(&self.material) * rates[0] * rates[0];
        }
        0.5 * twice
    }

    /// The square of the velocity of the first point, as far as its mass moves [m²/s²].
    fn square_at_start(&self, rates: &[f64]) -> f64 {
        rates[..self.of_start()].iter().map(|rate| rate * rate).sum()
    }

    /// Energy stored by stretch and height [J].
    pub(crate) fn stored(&self, at: &Instant, own: [&[f64]; 2], gravity: &Vector3<f64>) -> f64 {
        let stretched = self.lengths_of_pulls(at).map(|(length, pull)| length * self.material.energy(pull));
        let mut stored: f64 = stretched.sum();
        for (mass, position) in at.forces.masses.iter().zip(&at.points.positions) {
            stored -= mass * gravity.dot(position);
        }
        if let (Start::Led(lead), Some(_)) = (&self.start, &self.mesh) {
            stored += lead.energy(&self.material, own[0][0], own[1][0])[0];
        }
        stored
    }

    /// Power [W] of the winch, and power lost.
    pub(crate) fn powers(&self, at: &Instant, own: [&[f64]; 2], gravity: &Vector3<f64>) -> [f64; 2] {
        let mut lost = 0.0;
        for (length, pull) in self.lengths_of_pulls(at) {
            lost += length * pull.viscosity * pull.rate * pull.rate;
        }
        let given =
            match (&self.mesh, &self.start) {
                (None, _) => at.forces.pulls.first().map_or(0.0, |pull| {
                    at.length.1 * (self.material.energy(pull) - pull.tension * pull.stretch)
                }),
                (Some(mesh), start) => {
                    if let Start::Led(lead) = start {
                        lost += lead.energy(&self.material, own[0][0], own[1][0])[1];
                    }
                    self.power_of_winch(mesh, at, own[1], gravity)
                }
            };
        [given, lost]
    }

    /// P of (X7) [W].
    fn power_of_winch(&self, mesh: &Mesh, at: &Instant, rates: &[f64], gravity: &Vector3<f64>) -> f64 {
        let Some((flow, more)) = &at.forces.flow else { return 0.0 };
        let (length, growth) = at.length;
        let mut flowing = Points { positions: flow.clone(), velocities: vec![Vector3::zeros(); flow.len()] };
        flowing.velocities[0] = -flow[0];
        flowing.positions[0] = at.turning * flow[1];
        let (mut shrinking, mut power) = (0.0, 0.0);
        for (k, mass) in at.forces.masses.iter().enumerate() {
            let velocity = &at.points.velocities[k];
            let (square, more) = match k {
                0 => (self.square_at_start(rates), 0.0),
                _ => (velocity.norm_squared(), velocity.dot(&more[k])),
            };
            shrinking += mass * (0.5 * square - gravity.dot(&at.points.positions[k]));
            power += mass * (more - gravity.dot(&flowing.positions[k]));
        }
        let rows =
            mesh.parts(length).flat_map(|part| mesh.rule.pulls.iter().map(move |(_, row)| (part, row)));
        for ((length, pull), (part, row)) in self.lengths_of_pulls(at).zip(rows) {
            let (motion, by_winch) = part.slopes(row, &flowing);
            shrinking += length * (self.material.energy(pull) - pull.elastic * pull.stretch);
            let viscous = pull.viscosity * pull.rate;
            power += length * pull.along.dot(&(motion * pull.elastic + by_winch * viscous));
        }
        power + growth / length * shrinking
    }

    /// The tensions with the unstrained length [m] that each stands for.
    fn lengths_of_pulls<'s>(&'s self, at: &'s Instant) -> impl Iterator<Item = (f64, &'s Pull)> {
        let mut pulls = at.forces.pulls.iter();
        let parts = self.mesh.iter().flat_map(move |mesh| {
            let of_part =
                move |part: Part| mesh.rule.pulls.iter().map(move |(weight, _)| weight * part.length);
            mesh.parts(at.length.0).flat_map(of_part)
        });
        let whole = self.mesh.is_none().then_some(2.0 * at.length.0);
        parts.chain(whole).filter_map(move |length| Some((0.5 * length, pulls.next()?)))
    }
}
