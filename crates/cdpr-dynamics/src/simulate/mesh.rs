//! Points of a cable, and the forces on them.
//!
//! With the place r of the material at the unstrained length s from the exit, the mass μ per unstrained
//! length and the ratio τ of the viscous to the elastic modulus,
//!
//! ```text
//! μ r̈ = n' + μ g,    r' = (1 + ε) t,    n = (T(ε) + τ dT/dε dε/dt) t                               (X1)
//! ```
//!
//! with T(ε) zero for a cable that nothing stretches. On elements of the length h, r is the polynomial
//! through Lobatto's points with the weights w_k, whose derivative at the point j is `2/h Σ D_jk r_k`.
//! Integration with the same points leaves a mass and a force at each,
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
use cdpr_robot::{Matrix3, Vector3};
use std::sync::Arc;

/// Lobatto's points of one degree, and the derivative through them.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) degree: usize,
    /// Points and weights over x from -1 to 1.
    pub(super) points: Vec<[f64; 2]>,
    /// Where the tension of an element is evaluated: weight, and derivative through the points. An element of
    /// degree 1 is straight: its tension is the same at both points.
    pub(super) pulls: Vec<(f64, Vec<f64>)>,
}

impl Rule {
    pub(super) fn new(degree: usize) -> Self {
        let points = lobatto(degree);
        let slopes = lobatto_slopes(degree);
        let pulls = if degree == 1 {
            slopes.into_iter().take(1).map(|row| (2.0, row)).collect()
        } else {
            points.iter().map(|[_, weight]| *weight).zip(slopes).collect()
        };
        Self { degree, points, pulls }
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
    /// While a rest is searched for: the cable pushes, too, and resists motions across it as with this
    /// tension at least [N].
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
    /// The least damping [s] of straight elements of a cable of a length [m] that goes slack. Such a cable
    /// has shocks when it is taut again, which no mesh resolves; without damping their waves stay for ever
    /// (the artificial viscosity of J. von Neumann, R. D. Richtmyer, *A method for the numerical calculation
    /// of hydrodynamic shocks*, 1950). It vanishes with the length of the elements.
    pub(super) fn damping_of_shocks(&self, mesh: &Mesh, length: f64) -> f64 {
        if mesh.rule.degree > 1 {
            return 0.0;
        }
        length / mesh.elements() as f64 * (self.density / self.cable.axial_stiffness).sqrt()
    }

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
#[derive(Clone, Debug, Default)]
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
#[derive(Clone, Debug, Default)]
pub(super) struct Forces {
    /// Internal force on each point [N].
    pub(super) forces: Vec<Vector3<f64>>,
    /// Mass of each point [kg].
    pub(super) masses: Vec<f64>,
    /// What the material that flows past the points adds to their velocity [m/s] and acceleration [m/s²].
    pub(super) flow: Option<Flow>,
    /// Tensions of every element, those of [`Rule::pulls`].
    pub(super) pulls: Vec<Pull>,
}

/// Elements of one degree, as shares of the free length.
#[derive(Clone, Debug)]
pub(super) struct Mesh {
    pub(super) rule: Arc<Rule>,
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
    pub(super) fn equal(rule: &Arc<Rule>, elements: usize) -> Self {
        let ends = (0..=elements).map(|k| k as f64 / elements as f64).collect();
        Self { rule: Arc::clone(rule), ends }
    }

    /// Elements of the same length, but for a first one that is longer where it is to have this share of the
    /// free length, up to a half.
    pub(super) fn beginning(rule: &Arc<Rule>, elements: usize, share: f64) -> Self {
        let (mut mesh, others) = (Self::equal(rule, elements), elements as f64 - 1.0);
        if elements > 1 && share > mesh.ends[1] {
            let first = share.min(0.5);
            let place = |(k, end): (usize, &mut f64)| *end = first + (1.0 - first) * k as f64 / others;
            mesh.ends[1..].iter_mut().enumerate().for_each(place);
        }
        mesh
    }

    /// Number of elements.
    pub(super) fn elements(&self) -> usize {
        self.ends.len() - 1
    }

    /// Whether the tensions at its points are those that a static shape has at these shares.
    pub(super) fn is_exact(
        &self,
        material: &Material,
        (length, points): (f64, &Points),
        tension_at: impl Fn(f64) -> f64,
    ) -> bool {
        /// Greatest error of a tension, relative to it, of points that are on the static shape. At the rest
        /// of the discrete cable, which begins the motion, the error is smaller by orders.
        const ERROR: f64 = 0.1;
        let (shares, degree) = (self.shares(), self.rule.degree);
        let mut forces = Forces::default();
        self.forces(material, (length, 0.0), points, &mut forces);
        let pulls = &forces.pulls;
        pulls.iter().enumerate().all(|(k, pull)| {
            let point = k / (degree + 1) * degree + k % (degree + 1);
            let expected = tension_at(shares[point]);
            (pull.tension - expected).abs() <= ERROR * expected
        })
    }

    pub(super) fn parts(&self, length: f64) -> impl Iterator<Item = Part> {
        let degree = self.rule.degree;
        self.ends
            .windows(2)
            .enumerate()
            .map(move |(e, ends)| Part { first: e * degree, length: length * (ends[1] - ends[0]) })
    }

    /// Number of points.
    pub(super) fn size(&self) -> usize {
        self.elements() * self.rule.degree + 1
    }

    /// The share of the free length at each point.
    pub(super) fn shares(&self) -> Vec<f64> {
        let mut shares = vec![0.0];
        for ends in self.ends.windows(2) {
            let share = |[x, _]: &[f64; 2]| ends[0] + 0.5 * (1.0 + x) * (ends[1] - ends[0]);
            shares.extend(self.rule.points.iter().skip(1).map(share));
        }
        shares
    }

    /// The vector at a share of the free length, of vectors at the points.
    pub(super) fn at(&self, share: f64, vectors: &[Vector3<f64>]) -> Vector3<f64> {
        let element = self.ends.partition_point(|end| *end <= share).clamp(1, self.elements()) - 1;
        let (begin, end) = (self.ends[element], self.ends[element + 1]);
        let x = 2.0 * (share - begin) / (end - begin) - 1.0;
        let points = &self.rule.points;
        let mut sum = Vector3::zeros();
        for (k, [own, _]) in points.iter().enumerate() {
            let others = points.iter().enumerate().filter(|(other, _)| *other != k);
            let weight: f64 = others.map(|(_, [other, _])| (x - other) / (own - other)).product();
            sum += vectors[element * self.rule.degree + k] * weight;
        }
        sum
    }

    /// Forces of a cable of this free length [m] that grows by `growth` [m/s] at its exit.
    pub(super) fn forces(
        &self,
        material: &Material,
        (length, growth): (f64, f64),
        points: &Points,
        found: &mut Forces,
    ) {
        let (rule, size) = (&*self.rule, self.size());
        let Forces { forces, masses, flow, pulls } = found;
        forces.clear();
        forces.resize(size, Vector3::zeros());
        masses.clear();
        masses.resize(size, 0.0);
        pulls.clear();
        for part in self.parts(length) {
            for (weight, row) in &rule.pulls {
                let (slope, rate) = part.slopes(row, points);
                let pull = material.pull(slope, rate);
                let tension = weight * pull.tension;
                let (x, y, z) = (tension * pull.along.x, tension * pull.along.y, tension * pull.along.z);
                for (force, share) in forces[part.first..].iter_mut().zip(row) {
                    force.x -= share * x;
                    force.y -= share * y;
                    force.z -= share * z;
                }
                pulls.push(pull);
            }
            for (mass, [_, weight]) in masses[part.first..].iter_mut().zip(&rule.points) {
                *mass += 0.5 * weight * material.density * part.length;
            }
        }
        *flow = (growth != 0.0).then(|| self.flow((length, growth), points));
    }

    /// What the material that flows past the points adds, with the derivatives of all elements at a point
    /// weighted by their masses there.
    fn flow(&self, (length, growth): (f64, f64), points: &Points) -> Flow {
        let (rule, size, shares) = (&*self.rule, self.size(), self.shares());
        let (mut velocities, mut accelerations) =
            (vec![Vector3::zeros(); size], vec![Vector3::zeros(); size]);
        let mut weights = vec![0.0; size];
        for part in self.parts(length) {
            for (j, [_, weight]) in rule.points.iter().enumerate() {
                let (slope, rate) = part.slopes(&rule.pulls[j.min(rule.pulls.len() - 1)].1, points);
                let (point, weight) = (part.first + j, weight * part.length);
                let passing = -(1.0 - shares[point]) * growth * weight;
                velocities[point] += slope * passing;
                accelerations[point] += rate * passing;
                weights[point] += weight;
            }
        }
        for (point, weight) in weights.iter().enumerate() {
            velocities[point] /= *weight;
            accelerations[point] /= *weight;
        }
        (velocities, accelerations)
    }
}

impl Part {
    /// r' and its rate at a point, whose row of derivatives is given.
    #[inline]
    pub(super) fn slopes(&self, row: &[f64], points: &Points) -> (Vector3<f64>, Vector3<f64>) {
        let scale = 2.0 / self.length;
        let sum = |vectors: &[Vector3<f64>]| {
            let mut sum = [0.0; 3];
            for (share, vector) in row.iter().zip(vectors) {
                sum[0] += share * vector.x;
                sum[1] += share * vector.y;
                sum[2] += share * vector.z;
            }
            Vector3::new(scale * sum[0], scale * sum[1], scale * sum[2])
        };
        (sum(&points.positions[self.first..]), sum(&points.velocities[self.first..]))
    }

    /// Stiffness and damping between two points.
    pub(super) fn blocks(&self, rule: &Rule, pulls: &[Pull], [a, b]: [usize; 2]) -> [Matrix3<f64>; 2] {
        let mut blocks = [Matrix3::zeros(); 2];
        for (pull, (weight, row)) in pulls.iter().zip(&rule.pulls) {
            let share = 2.0 / self.length * weight * row[a] * row[b];
            let along: Matrix3<f64> = pull.along * pull.along.transpose();
            let across = pull.across / pull.stretch;
            blocks[0] += (along * (pull.modulus - across) + Matrix3::identity() * across) * share;
            blocks[1] += along * (pull.viscosity * share);
        }
        blocks
    }
}

impl Pull {
    /// Stiffness of a straight cable of an unstrained length and a length across which it turns [m].
    pub(super) fn stiffness(&self, length: f64, free: f64) -> Matrix3<f64> {
        let along = self.along * self.along.transpose();
        along * (self.modulus / length) + (Matrix3::identity() - along) * (self.across / free)
    }

    /// Its damping.
    pub(super) fn damping(&self, length: f64) -> Matrix3<f64> {
        self.along * self.along.transpose() * (self.viscosity / length)
    }
}
