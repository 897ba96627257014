//! Points of a cable, and the forces on them.
//!
//! With the place r of the material at the unstrained length s from the exit, the mass μ per unstrained length
//! and the ratio τ of the viscous to the elastic modulus,
//!
//! ```text
//! μ r̈ = n' + μ g,    r' = (1 + ε) t,    n = (T(ε) + τ dT/dε dε/dt) t                               (X1)
//! ```
//!
//! with T(ε) zero for a cable that nothing stretches. On elements of the length h, r is the polynomial through
//! Lobatto's points with the weights w_k, whose derivative at the point j is `2/h Σ D_jk r_k`. Integration with
//! the same points leaves a mass and a force at each,
//!
//! ```text
//! m_k = μ h w_k/2,    f_k = -Σ_j w_j D_jk n_j                                                      (X2)
//! ```
//!
//! A winch changes the length L of the free part. Points stay at their shares ξ of it, so that material flows
//! past them with `ds/dt = -(1 - ξ) dL/dt`:
//!
//! ```text
//! dr_k/dt = v_k + r' ds/dt,    dv_k/dt = f_k/m_k + g + v' ds/dt,    v_0 = r' dL/dt                 (X3)
//! ```

use crate::polynomial::{lobatto, lobatto_slopes};
use cdpr_cable::Cable;
use cdpr_robot::Vector3;

/// Lobatto's points of one degree, and the derivative through them.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) degree: usize,
    /// Points and weights over x from -1 to 1.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) slopes: Vec<Vec<f64>>,
}

impl Rule {
    pub(super) fn new(degree: usize) -> Self {
        Self { degree, points: lobatto(degree), slopes: lobatto_slopes(degree) }
    }
}

/// What a cable is made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Material<'a> {
    /// Without its guide.
    pub(super) cable: Cable<'a>,
    /// Mass per unstrained length [kg/m].
    pub(super) density: f64,
    /// Ratio of viscous to elastic modulus [s].
    pub(super) damping: f64,
    /// While a rest is searched for: the cable pushes, too, and resists motions across it as with this tension
    /// at least [N].
    pub(super) relaxing: Option<f64>,
}

/// Tension at a point and what it depends on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pull {
    /// Direction along growing s.
    pub(super) along: Vector3<f64>,
    /// Tension with its viscous part [N].
    pub(super) tension: f64,
    /// Elastic part [N].
    pub(super) elastic: f64,
    /// 1 + ε.
    pub(super) stretch: f64,
    /// dε/dt [1/s].
    pub(super) rate: f64,
    /// dT/dε [N], zero of a slack cable.
    pub(super) modulus: f64,
    /// What resists motions across the cable [N].
    pub(super) across: f64,
    /// Viscous modulus [N s].
    pub(super) viscosity: f64,
}

impl Material<'_> {
    /// Tension where `r' = slope` and its rate is `rate` [1/s].
    pub(super) fn pull(&self, slope: Vector3<f64>, rate: Vector3<f64>) -> Pull {
        let stretch = slope.norm();
        let along = if stretch > 0.0 { slope / stretch } else { Vector3::z() };
        self.stretched(along, stretch, along.dot(&rate))
    }

    pub(super) fn stretched(&self, along: Vector3<f64>, stretch: f64, rate: f64) -> Pull {
        let mut elastic = self.cable.tension(stretch - 1.0);
        if let (Some(_), true) = (self.relaxing, elastic <= 0.0) {
            elastic = self.cable.tangent_stiffness(0.0) * (stretch - 1.0 - self.cable.strain(0.0));
        }
        let slope = self.cable.tangent_stiffness(elastic);
        let viscosity = self.damping * slope;
        let tension = elastic + viscosity * rate;
        Pull {
            along,
            tension,
            elastic,
            stretch,
            rate,
            modulus: if elastic > 0.0 || self.relaxing.is_some() { slope } else { 0.0 },
            across: tension.max(self.relaxing.unwrap_or(0.0)),
            viscosity,
        }
    }

    /// Elastic energy per unstrained length [J/m].
    pub(super) fn energy(&self, pull: &Pull) -> f64 {
        pull.elastic * (pull.stretch - 1.0) - self.cable.energy_per_length(pull.elastic)
    }
}

/// Points of a cable from its exit to its anchor point and their material velocities.
#[derive(Clone, Debug)]
pub(super) struct Points {
    pub(super) positions: Vec<Vector3<f64>>,
    pub(super) velocities: Vec<Vector3<f64>>,
}

/// An element: its first point, its unstrained length [m] and its share of the whole before its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    pub(super) first: usize,
    pub(super) length: f64,
}

/// Velocities and accelerations of points.
type Flow = (Vec<Vector3<f64>>, Vec<Vector3<f64>>);

/// What acts on the points of a cable.
#[derive(Clone, Debug)]
pub(super) struct Forces {
    /// Internal force on each point [N].
    pub(super) forces: Vec<Vector3<f64>>,
    /// Mass of each point [kg].
    pub(super) masses: Vec<f64>,
    /// What the material that flows past the points adds to their velocity [m/s] and acceleration [m/s²].
    pub(super) flow: Option<Flow>,
    /// Tension at every point of every element.
    pub(super) pulls: Vec<Pull>,
}

/// Elements of one degree, as shares of the free length.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    /// Ends of the elements, from 0 at the exit to 1 at the anchor point.
    pub(super) ends: Vec<f64>,
}

impl Points {
    /// Points that do not move.
    pub(super) fn still(positions: impl Iterator<Item = Vector3<f64>>) -> Self {
        let positions: Vec<_> = positions.collect();
        Self { velocities: vec![Vector3::zeros(); positions.len()], positions }
    }
}

impl Mesh {
    /// Elements of the same length.
    pub(super) fn equal(elements: usize) -> Self {
        Self { ends: (0..=elements).map(|k| k as f64 / elements as f64).collect() }
    }

    /// Whether the tensions at its points are those that a static shape has at these shares.
    pub(super) fn is_exact(
        &self,
        rule: &Rule,
        material: &Material,
        (length, points): (f64, &Points),
        tension_at: impl Fn(f64) -> f64,
    ) -> bool {
        /// Greatest error of a tension, relative to it.
        const ERROR: f64 = 1e-3;
        let shares = self.shares(rule);
        let pulls = self.forces(rule, material, (length, 0.0), points).pulls;
        pulls.iter().enumerate().all(|(k, pull)| {
            let point = k / (rule.degree + 1) * rule.degree + k % (rule.degree + 1);
            let expected = tension_at(shares[point]);
            (pull.tension - expected).abs() <= ERROR * expected
        })
    }

    pub(super) fn parts(&self, rule: &Rule, length: f64) -> impl Iterator<Item = Part> {
        self.ends
            .windows(2)
            .enumerate()
            .map(move |(e, ends)| Part { first: e * rule.degree, length: length * (ends[1] - ends[0]) })
    }

    /// Number of points.
    pub(super) fn size(&self, rule: &Rule) -> usize {
        (self.ends.len() - 1) * rule.degree + 1
    }

    /// The share of the free length at each point.
    pub(super) fn shares(&self, rule: &Rule) -> Vec<f64> {
        let mut shares = vec![0.0];
        for ends in self.ends.windows(2) {
            let share = |[x, _]: &[f64; 2]| ends[0] + 0.5 * (1.0 + x) * (ends[1] - ends[0]);
            shares.extend(rule.points.iter().skip(1).map(share));
        }
        shares
    }

    /// Forces of a cable of this free length [m] that grows by `growth` [m/s] at its exit.
    pub(super) fn forces(
        &self,
        rule: &Rule,
        material: &Material,
        (length, growth): (f64, f64),
        points: &Points,
    ) -> Forces {
        let size = self.size(rule);
        let mut forces = vec![Vector3::zeros(); size];
        let mut masses = vec![0.0; size];
        let mut pulls = Vec::with_capacity(size + self.ends.len());
        let mut flow = (growth != 0.0).then(|| (vec![Vector3::zeros(); size], vec![Vector3::zeros(); size]));
        let shares = if flow.is_some() { self.shares(rule) } else { Vec::new() };
        for part in self.parts(rule, length) {
            let (mut slope, mut rate) = part.slopes(&rule.slopes[0], points);
            let mut pull = material.pull(slope, rate);
            for (j, row) in rule.slopes.iter().enumerate() {
                let weight = rule.points[j][1];
                // An element of degree 1 is straight.
                if j > 0 && rule.degree > 1 {
                    (slope, rate) = part.slopes(row, points);
                    pull = material.pull(slope, rate);
                }
                let tension = pull.along * (weight * pull.tension);
                for (k, share) in row.iter().enumerate() {
                    forces[part.first + k] -= tension * *share;
                }
                let mass = 0.5 * weight * material.density * part.length;
                let point = part.first + j;
                masses[point] += mass;
                if let Some((velocities, accelerations)) = &mut flow {
                    let passing = -(1.0 - shares[point]) * growth;
                    velocities[point] += slope * (mass * passing);
                    accelerations[point] += rate * (mass * passing);
                }
                pulls.push(pull);
            }
        }
        if let Some((velocities, accelerations)) = &mut flow {
            for (point, mass) in masses.iter().enumerate() {
                velocities[point] /= *mass;
                accelerations[point] /= *mass;
            }
        }
        Forces { forces, masses, flow, pulls }
    }
}

impl Part {
    /// r' and its rate at a point, whose row of derivatives is given.
    pub(super) fn slopes(&self, row: &[f64], points: &Points) -> (Vector3<f64>, Vector3<f64>) {
        let (mut slope, mut rate) = (Vector3::zeros(), Vector3::zeros());
        for (k, share) in row.iter().enumerate() {
            slope += points.positions[self.first + k] * *share;
            rate += points.velocities[self.first + k] * *share;
        }
        let scale = 2.0 / self.length;
        (slope * scale, rate * scale)
    }
}
