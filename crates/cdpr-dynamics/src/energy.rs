//! How the energy of a motion of one cable changes with the cable.
//!
//! With its end moving by u, a cable vibrates as y(s) at the frequency ω. What it resists with is
//!
//! ```text
//! Q = uᵀ K_dyn u = ∫ ( y'ᵀ A y' - ω² μ |y|² ) ds + (what moves where it begins)                    (N8)
//! ```
//!
//! As y makes Q stationary, it may be held constant over `ξ = s/L` while the cable changes. The tension is
//! `n = (1 - ξ) n_0 + ξ n_L`. With `q = A y'`, `N = |n|`, `φ = (1 + ε)/N`, `ψ = φ'/N` and the lengths of the
//! law's pieces constant,
//!
//! ```text
//! y'ᵀ dA y' = -qᵀ dA⁻¹ q,      A⁻¹ = φ 1 + ψ n nᵀ
//! ∂(qᵀ A⁻¹ q)/∂n = ψ ( |q|² - 3 (n·q)²/N² ) n + 2 ψ (n·q) q                                        (N9)
//! ```
//!
//! Where the cable begins on a pulley, its point gives way by the compliance `C = K3⁻¹ - ∫ A⁻¹ ds`: the
//! difference of the static compliances of the whole cable and of its free part. With the force f there,
//!
//! ```text
//! dQ = -fᵀ dC f = zᵀ dK3 z + fᵀ d(∫ A⁻¹ ds) f,      z = K3⁻¹ f                                     (N10)
//! ```
//!
//! A lead moves it by η along the cable, `y(0) = η t`: then Q changes by `2 η r·dt` with the force r on the
//! beginning, and by what the bar of (N7) does.

use crate::cable::{Part, Parts};
use crate::element::{Element, layout};
use crate::free::Free;
use cdpr_statics::Vector3;
use cdpr_statics::vibration::CableAtRest;

/// A vector, or a number, for each input of a cable. Vectors are in the base frame.
#[derive(Clone, Copy, Default)]
pub(crate) struct Change {
    /// Of the tension vectors at the beginning of the free part and at the anchor point [N].
    pub(crate) exit: Vector3<f64>,
    pub(crate) anchor: Vector3<f64>,
    /// Of the unstrained length, lead and arc included [m].
    pub(crate) length: f64,
    /// Of the mass per length [kg/m].
    pub(crate) density: f64,
    /// Of the modulus, relative to it.
    pub(crate) modulus: f64,
    /// Of the lead [m].
    pub(crate) lead: f64,
    /// Of gravity [m/s²].
    pub(crate) gravity: Vector3<f64>,
    /// Of K3 z [N].
    pub(crate) resistance: Vector3<f64>,
}

/// A motion of a cable, and how its Q changes.
pub(crate) struct CableEnergy {
    /// z of (N10) [m], zero without pulley.
    pub(crate) z: Vector3<f64>,
    /// Derivatives of Q by the tension vectors [m].
    exit: Vector3<f64>,
    anchor: Vector3<f64>,
    /// By the free length [N], the density and the relative change of the modulus.
    per_length: f64,
    per_density: f64,
    per_modulus: f64,
    /// The free length [m], the tension vector along it, and gravity; of a cable on a pulley.
    on_pulley: Option<OnPulley>,
    lead: Option<Lead>,
}

/// What gives the change of the free length of a cable on a pulley: `n_L - n_0 = -μ γ L`.
struct OnPulley {
    length: f64,
    density: f64,
    gravity: Vector3<f64>,
}

/// The lead behind an exit point without pulley: unstrained it is d/(1 + ε) long.
struct Lead {
    /// Unit vector of the cable, its tension [N], strain, and dε/dT [1/N].
    along: Vector3<f64>,
    tension: f64,
    strain: f64,
    compliance: f64,
    /// Unstrained length [m].
    unstrained: f64,
    /// η [m], and the force on the beginning of the free part [N].
    motion: f64,
    reaction: Vector3<f64>,
    /// Elastic and kinetic part of the bar's Q.
    elastic: f64,
    kinetic: f64,
    density: f64,
    gravity: Vector3<f64>,
}

/// Sums over the points of a cable, along its own axes.
#[derive(Default)]
struct Sums {
    /// ∫ ∂(y'ᵀ A y')/∂n ds, weighted by 1 - ξ and by ξ.
    exit: Vector3<f64>,
    anchor: Vector3<f64>,
    elastic: f64,
    /// ∫ |y|² ds.
    square: f64,
    modulus: f64,
    /// r: the force on the beginning.
    reaction: Vector3<f64>,
}

/// One point of a cable: its tension vector and what follows of it.
struct At {
    n: Vector3<f64>,
    tension: f64,
    strain: f64,
    /// dε/dT [1/N].
    compliance: f64,
}

impl At {
    fn new(free: &Free, s: f64) -> Self {
        let n = free.tension(s);
        let (tension, cable) = (n.norm(), &free.free.cable);
        let (strain, compliance) = (cable.strain(tension), cable.tangent_stiffness(tension).recip());
        Self { n: Vector3::new(n.x, 0.0, n.y), tension, strain, compliance }
    }

    /// A y' [N].
    fn force(&self, slope: &Vector3<f64>) -> Vector3<f64> {
        let across = self.tension / (1.0 + self.strain);
        let t = self.n / self.tension;
        across * slope + t * (t.dot(slope) * (self.compliance.recip() - across))
    }

    /// (N9).
    fn per_tension(&self, q: &Vector3<f64>) -> Vector3<f64> {
        let psi = (self.compliance * self.tension - 1.0 - self.strain) / self.tension.powi(3);
        let along = self.n.dot(q);
        let square = q.norm_squared() - 3.0 * (along / self.tension).powi(2);
        psi * (square * self.n + 2.0 * along * q)
    }

    /// Derivative of qᵀ A⁻¹ q by a relative change of the modulus.
    fn per_modulus(&self, q: &Vector3<f64>) -> f64 {
        let along = (self.n.dot(q) / self.tension).powi(2);
        -(self.strain / self.tension * (q.norm_squared() - along) + self.compliance * along)
    }

    /// qᵀ A⁻¹ q.
    fn flexible(&self, q: &Vector3<f64>) -> f64 {
        let along = (self.n.dot(q) / self.tension).powi(2);
        (1.0 + self.strain) / self.tension * (q.norm_squared() - along) + self.compliance * along
    }
}

impl CableEnergy {
    /// Of cable `i`, whose end moves by `end` [m] with the amplitudes of its motions with the end held, at
    /// `square` = ω² [1/s²] under `gravity` [m/s²].
    pub(crate) fn new(
        (i, cable, parts): (usize, &CableAtRest, &Parts),
        end: &Vector3<f64>,
        amplitudes: &[f64],
        square: f64,
        gravity: &Vector3<f64>,
    ) -> Self {
        let free = Free { cable: i, free: cable.catenary.free() };
        let end = cable.axes.tr_mul(end);
        let (in_plane, across) = amplitudes.split_at(parts.in_plane.condensed.modes.len());
        let in_plane = parts.in_plane.condensed.unknowns([end.x, end.z], in_plane);
        let across = parts.across.condensed.unknowns([end.y], across);
        let sums = Sums::new(&free, parts, (&in_plane, &across), cable.linear_density * square);
        let (axes, length) = (&cable.axes, free.free.unstrained_length);
        let mut energy = Self {
            z: Vector3::zeros(),
            exit: sums.exit,
            anchor: sums.anchor,
            per_length: -(sums.elastic + cable.linear_density * square * sums.square) / length,
            per_density: -square * sums.square,
            per_modulus: sums.modulus,
            on_pulley: None,
            lead: None,
        };
        let guide = cable.catenary.cable.guide;
        if guide.is_some_and(|guide| guide.radius > 0.0) {
            energy.add_pulley(&free, parts, &sums.reaction);
            energy.on_pulley = Some(OnPulley { length, density: cable.linear_density, gravity: *gravity });
            let force = axes * sums.reaction;
            energy.z =
                cable.end_stiffness.try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * force);
        } else if guide.is_some_and(|guide| guide.lead > 0.0) {
            energy.lead = Some(Lead::new(&free, cable, &parts.in_plane, &in_plane, (square, gravity)));
            energy.lead.iter_mut().for_each(|lead| lead.reaction = axes * sums.reaction);
        }
        energy.exit = axes * energy.exit;
        energy.anchor = axes * energy.anchor;
        energy
    }

    /// The part of the free length in (N10), along the axes of the cable.
    fn add_pulley(&mut self, free: &Free, parts: &Parts, force: &Vector3<f64>) {
        let length = free.free.unstrained_length;
        for point in parts.elements.iter().flat_map(Element::points) {
            let (at, xi) = (At::new(free, point.s), point.s / length);
            let per_tension = point.weight * at.per_tension(force);
            self.exit += per_tension * (1.0 - xi);
            self.anchor += per_tension * xi;
            self.per_modulus += point.weight * at.per_modulus(force);
            self.per_length += point.weight * at.flexible(force) / length;
        }
    }

    /// How Q changes, u constant.
    pub(crate) fn change(&self, by: &Change) -> f64 {
        let mut sum = self.exit.dot(&by.exit) + self.anchor.dot(&by.anchor);
        sum += self.per_density * by.density + self.per_modulus * by.modulus + self.z.dot(&by.resistance);
        let mut length = by.length;
        if let Some(OnPulley { length: free, density, gravity }) = &self.on_pulley {
            let weight = density * gravity.norm_squared() * free;
            let turned = (by.exit - by.anchor).dot(gravity) / weight;
            let heavier = by.density / density + by.gravity.dot(gravity) / gravity.norm_squared();
            length = free * (turned - heavier);
        }
        if let Some(lead) = &self.lead {
            let (more, shorter) = lead.change(by);
            sum += more;
            length -= shorter;
        }
        sum + self.per_length * length
    }
}

impl Sums {
    fn new(free: &Free, parts: &Parts, (in_plane, across): (&[f64], &[f64]), inertia: f64) -> Self {
        let mut sums = Self::default();
        let length = free.free.unstrained_length;
        let unknowns = layout(&parts.elements, &parts.in_plane.beginning).0;
        let of_across = layout(&parts.elements, &parts.across.beginning).0;
        let elements = parts.elements.iter().zip(unknowns.iter().zip(&of_across));
        for (e, (element, (unknowns, of_across))) in elements.enumerate() {
            let coefficient = |k: usize| {
                let mut sum = Vector3::zeros();
                unknowns[k].iter().for_each(|(i, [x, z])| sum += in_plane[*i] * Vector3::new(*x, 0.0, *z));
                of_across[k].iter().for_each(|(i, [y])| sum.y += across[*i] * y);
                sum
            };
            let coefficients: Vec<Vector3<f64>> = (0..unknowns.len()).map(coefficient).collect();
            for point in element.points() {
                let (at, xi) = (At::new(free, point.s), point.s / length);
                let (mut y, mut slope) = (Vector3::zeros(), Vector3::zeros());
                for (coefficient, [value, derivative]) in coefficients.iter().zip(&point.functions) {
                    y += coefficient * *value;
                    slope += coefficient * *derivative;
                }
                let q = at.force(&slope);
                let per_tension = -point.weight * at.per_tension(&q);
                sums.exit += per_tension * (1.0 - xi);
                sums.anchor += per_tension * xi;
                sums.elastic += point.weight * q.dot(&slope);
                sums.square += point.weight * y.norm_squared();
                sums.modulus -= point.weight * at.per_modulus(&q);
                if e == 0 {
                    let [value, derivative] = point.functions[0];
                    sums.reaction += point.weight * (q * derivative - inertia * value * y);
                }
            }
        }
        sums
    }
}

impl Lead {
    fn new(
        free: &Free,
        cable: &CableAtRest,
        part: &Part<2>,
        in_plane: &[f64],
        (square, gravity): (f64, &Vector3<f64>),
    ) -> Self {
        let at = At::new(free, 0.0);
        let matrices = &part.beginning.matrices;
        let unknowns = &in_plane[2..2 + matrices.stiffness.nrows()];
        let product = |matrix: &nalgebra::DMatrix<f64>| -> f64 {
            let row = |i: usize| -> f64 { (0..unknowns.len()).map(|j| matrix[(i, j)] * unknowns[j]).sum() };
            (0..unknowns.len()).map(|i| unknowns[i] * row(i)).sum()
        };
        let along = cable.axes * at.n / at.tension;
        let motion = unknowns[0];
        let slid = -cable.linear_density * gravity.dot(&along) / (1.0 + at.strain) * motion * motion;
        Self {
            along,
            tension: at.tension,
            strain: at.strain,
            compliance: at.compliance,
            unstrained: cable.catenary.unstrained_length - free.free.unstrained_length,
            motion,
            reaction: Vector3::zeros(),
            elastic: product(&matrices.stiffness) - slid,
            kinetic: square * product(&matrices.mass),
            density: cable.linear_density,
            gravity: *gravity,
        }
    }

    /// Of Q without the free part, and of the unstrained length of the lead.
    fn change(&self, by: &Change) -> (f64, f64) {
        let stretch = 1.0 + self.strain;
        let strain = self.compliance * self.along.dot(&by.exit) - self.strain * by.modulus;
        let length = by.lead / stretch - self.unstrained * strain / stretch;
        let turn = (by.exit - self.along * self.along.dot(&by.exit)) / self.tension;
        let mut sum = -(self.elastic + self.kinetic) * length / self.unstrained;
        sum += self.elastic * by.modulus;
        if self.density > 0.0 {
            sum -= self.kinetic * by.density / self.density;
        }
        let pull = self.density * self.gravity.dot(&self.along);
        let of_pull = self.density * (by.gravity.dot(&self.along) + self.gravity.dot(&turn))
            + by.density * self.gravity.dot(&self.along);
        sum -= self.motion * self.motion * (of_pull - pull * strain / stretch) / stretch;
        (sum + 2.0 * self.motion * self.reaction.dot(&turn), length)
    }
}
