//! How the energy of a motion of one cable changes with the cable.
//!
//! With its end moving by u, a cable vibrates as y(s) at the frequency ω. What it resists with is
//!
//! ```text
//! Q = uᵀ K_dyn u = ∫ ( y'ᵀ A y' - ω² μ |y|² ) ds + (what moves where it begins)               (N8)
//! ```
//!
//! With damping ω² is the complex `σ = ω² - i ω c` here, and A has `i ω τ EA t tᵀ` more, (N13); Q
//! has no conjugates. As y makes Q stationary, it may be held constant over `ξ = s/L` while the cable
//! changes. The tension is `n = (1 - ξ) n_0 + ξ n_L`. With `q = A y'`, `N = |n|`, `φ = (1 + ε)/N`,
//! `ψ = φ'/N` and the lengths of the law's pieces constant,
//!
//! ```text
//! y'ᵀ dA y' = -qᵀ dA⁻¹ q,      A⁻¹ = φ 1 + ψ n nᵀ
//! ∂(qᵀ A⁻¹ q)/∂n = ψ ( |q|² - 3 (n·q)²/N² ) n + 2 ψ (n·q) q                             (N9)
//! ∂(t·y')²/∂n = 2 (t·y') ( y' - t (t·y') )/N
//! ```
//!
//! Where the cable begins on a pulley, its point gives way by the compliance `C = K3⁻¹ - ∫ A⁻¹ ds`:
//! the difference of the static compliances of the whole cable and of its free part. With the force f there,
//!
//! ```text
//! dQ = -fᵀ dC f = zᵀ dK3 z + fᵀ d(∫ A⁻¹ ds) f,      z = K3⁻¹ f                           (N10)
//! ```
//!
//! A lead moves it by η along the cable, `y(0) = η t`: then Q changes by `2 η r·dt` with the force r on
//! the beginning, and by what the bar of (N7) does.

use crate::element::{Beginning, Element, layout};
use crate::free::Free;
use cdpr_statics::Vector3;
use cdpr_statics::vibration::CableAtRest;
use nalgebra::Complex;

/// A complex number and a vector of them: `dot` takes no conjugates.
pub(crate) type Number = Complex<f64>;
pub(crate) type Vector = Vector3<Number>;

pub(crate) fn real(value: f64) -> Number {
    Complex::new(value, 0.0)
}

/// A cable that vibrates, with its unknowns in its plane and across it.
pub(crate) struct Vibrating<'a> {
    /// Its number, from 0.
    pub(crate) number: usize,
    pub(crate) at_rest: &'a CableAtRest<'a>,
    pub(crate) elements: &'a [Element],
    pub(crate) in_plane: (&'a Beginning<2>, Vec<Number>),
    pub(crate) across: (&'a Beginning<1>, Vec<Number>),
    /// σ [1/s²].
    pub(crate) square: Number,
    /// i ω τ.
    pub(crate) viscous: Number,
}

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
    pub(crate) resistance: Vector,
}

/// A motion of a cable, and how its Q changes.
pub(crate) struct CableEnergy {
    /// z of (N10) [m], zero without pulley.
    pub(crate) z: Vector,
    /// Derivatives of Q by the tension vectors [m].
    exit: Vector,
    anchor: Vector,
    /// By the free length [N], the density and the relative change of the modulus.
    per_length: Number,
    per_density: Number,
    per_modulus: Number,
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
    motion: Number,
    reaction: Vector,
    /// Elastic and kinetic part of the bar's Q.
    elastic: Number,
    kinetic: Number,
    density: f64,
    gravity: Vector3<f64>,
}

/// Sums over the points of a cable, along its own axes.
#[derive(Default)]
struct Sums {
    /// ∫ ∂(y'ᵀ A y')/∂n ds, weighted by 1 - ξ and by ξ.
    exit: Vector,
    anchor: Vector,
    elastic: Number,
    /// ∫ |y|² ds.
    square: Number,
    modulus: Number,
    /// r: the force on the beginning.
    reaction: Vector,
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

    /// n·v/N.
    fn along(&self, v: &Vector) -> Number {
        self.n.map(real).dot(v) / self.tension
    }

    /// A y' without damping [N].
    fn force(&self, slope: &Vector) -> Vector {
        let across = self.tension / (1.0 + self.strain);
        let more = self.along(slope) * (self.compliance.recip() - across) / self.tension;
        slope * real(across) + self.n.map(|n| more * n)
    }

    /// (N9).
    fn per_tension(&self, q: &Vector) -> Vector {
        let psi = (self.compliance * self.tension - 1.0 - self.strain) / self.tension.powi(3);
        let along = self.along(q);
        let square = q.dot(q) - along * along * 3.0;
        self.n.map(|n| square * (psi * n)) + q * (along * (2.0 * psi * self.tension))
    }

    /// Derivative of qᵀ A⁻¹ q by a relative change of the modulus.
    fn per_modulus(&self, q: &Vector) -> Number {
        let along = self.along(q);
        let along = along * along;
        -((q.dot(q) - along) * (self.strain / self.tension) + along * self.compliance)
    }

    /// qᵀ A⁻¹ q.
    fn flexible(&self, q: &Vector) -> Number {
        let along = self.along(q);
        let along = along * along;
        (q.dot(q) - along) * ((1.0 + self.strain) / self.tension) + along * self.compliance
    }

    /// Of EA (t·y')²: its half by y', it and its derivative by n.
    fn stretched(&self, slope: &Vector) -> (Vector, Number, Vector) {
        let (along, modulus) = (self.along(slope), self.compliance.recip());
        let parallel = self.n.map(|n| along * (n / self.tension));
        let per_tension = (slope - parallel) * (along * (2.0 * modulus / self.tension));
        (parallel * real(modulus), along * along * modulus, per_tension)
    }
}

impl CableEnergy {
    /// Of a cable under `gravity` [m/s²].
    pub(crate) fn new(vibrating: &Vibrating, gravity: &Vector3<f64>) -> Self {
        let Vibrating { number, at_rest: cable, square, .. } = vibrating;
        let free = Free { cable: *number, free: cable.catenary.free() };
        let inertia = square * cable.linear_density;
        let sums = Sums::new(&free, vibrating, inertia);
        let (axes, length) = (cable.axes.map(real), free.free.unstrained_length);
        let mut energy = Self {
            z: Vector::zeros(),
            exit: sums.exit,
            anchor: sums.anchor,
            per_length: -(sums.elastic + inertia * sums.square) / length,
            per_density: -square * sums.square,
            per_modulus: sums.modulus,
            on_pulley: None,
            lead: None,
        };
        let guide = cable.catenary.cable.guide;
        if guide.is_some_and(|guide| guide.radius > 0.0) {
            energy.add_pulley(&free, vibrating.elements, &sums.reaction);
            energy.on_pulley = Some(OnPulley { length, density: cable.linear_density, gravity: *gravity });
            let force = axes * sums.reaction;
            let inverse = cable.end_stiffness.try_inverse();
            energy.z = inverse.map_or_else(Vector::zeros, |inverse| inverse.map(real) * force);
        } else if guide.is_some_and(|guide| guide.lead > 0.0) {
            energy.lead = Some(Lead::new(&free, vibrating, gravity));
            energy.lead.iter_mut().for_each(|lead| lead.reaction = axes * sums.reaction);
        }
        energy.exit = axes * energy.exit;
        energy.anchor = axes * energy.anchor;
        energy
    }

    /// The part of the free length in (N10), along the axes of the cable.
    fn add_pulley(&mut self, free: &Free, elements: &[Element], force: &Vector) {
        let length = free.free.unstrained_length;
        for point in elements.iter().flat_map(Element::points) {
            let (at, xi) = (At::new(free, point.s), point.s / length);
            let per_tension = at.per_tension(force) * real(point.weight);
            self.exit += per_tension * real(1.0 - xi);
            self.anchor += per_tension * real(xi);
            self.per_modulus += at.per_modulus(force) * point.weight;
            self.per_length += at.flexible(force) * (point.weight / length);
        }
    }

    /// How Q changes, u constant.
    pub(crate) fn change(&self, by: &Change) -> Number {
        let mut sum = self.exit.dot(&by.exit.map(real)) + self.anchor.dot(&by.anchor.map(real));
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
    fn new(free: &Free, vibrating: &Vibrating, inertia: Number) -> Self {
        let Vibrating { elements, in_plane, across, viscous, .. } = vibrating;
        let mut sums = Self::default();
        let length = free.free.unstrained_length;
        let unknowns = layout(elements, in_plane.0).0;
        let of_across = layout(elements, across.0).0;
        for (e, (element, (unknowns, of_across))) in
            elements.iter().zip(unknowns.iter().zip(&of_across)).enumerate()
        {
            let coefficient = |k: usize| {
                let mut sum = Vector::zeros();
                for (i, [x, z]) in &unknowns[k] {
                    sum.x += in_plane.1[*i] * *x;
                    sum.z += in_plane.1[*i] * *z;
                }
                of_across[k].iter().for_each(|(i, [y])| sum.y += across.1[*i] * *y);
                sum
            };
            let coefficients: Vec<Vector> = (0..unknowns.len()).map(coefficient).collect();
            for point in element.points() {
                let (at, xi, weight) = (At::new(free, point.s), point.s / length, point.weight);
                let (mut y, mut slope) = (Vector::zeros(), Vector::zeros());
                for (coefficient, [value, derivative]) in coefficients.iter().zip(&point.functions) {
                    y += coefficient * real(*value);
                    slope += coefficient * real(*derivative);
                }
                let q = at.force(&slope);
                let (damped, stretched, of_stretch) = at.stretched(&slope);
                let per_tension = (of_stretch * *viscous - at.per_tension(&q)) * real(weight);
                sums.exit += per_tension * real(1.0 - xi);
                sums.anchor += per_tension * real(xi);
                sums.elastic += (q.dot(&slope) + viscous * stretched) * weight;
                sums.square += y.dot(&y) * weight;
                sums.modulus += (viscous * stretched - at.per_modulus(&q)) * weight;
                if e == 0 {
                    let [value, derivative] = point.functions[0];
                    let force = (q + damped * *viscous) * real(derivative) - y * (inertia * value);
                    sums.reaction += force * real(weight);
                }
            }
        }
        sums
    }
}

impl Lead {
    fn new(free: &Free, vibrating: &Vibrating, gravity: &Vector3<f64>) -> Self {
        let Vibrating { at_rest: cable, in_plane: (beginning, unknowns), square, viscous, .. } = vibrating;
        let at = At::new(free, 0.0);
        let matrices = &beginning.matrices;
        let unknowns = &unknowns[2..2 + matrices.stiffness.nrows()];
        let product = |matrix: &nalgebra::DMatrix<f64>| -> Number {
            let row =
                |i: usize| -> Number { (0..unknowns.len()).map(|j| unknowns[j] * matrix[(i, j)]).sum() };
            (0..unknowns.len()).map(|i| unknowns[i] * row(i)).sum()
        };
        let along = cable.axes * at.n / at.tension;
        let motion = unknowns[0];
        let slid = motion * motion * (-cable.linear_density * gravity.dot(&along) / (1.0 + at.strain));
        Self {
            along,
            tension: at.tension,
            strain: at.strain,
            compliance: at.compliance,
            unstrained: cable.catenary.unstrained_length - free.free.unstrained_length,
            motion,
            reaction: Vector::zeros(),
            elastic: (product(&matrices.stiffness) - slid) * (real(1.0) + viscous),
            kinetic: square * product(&matrices.mass),
            density: cable.linear_density,
            gravity: *gravity,
        }
    }

    /// Of Q without the free part, and of the unstrained length of the lead.
    fn change(&self, by: &Change) -> (Number, f64) {
        let stretch = 1.0 + self.strain;
        let strain = self.compliance * self.along.dot(&by.exit) - self.strain * by.modulus;
        let length = by.lead / stretch - self.unstrained * strain / stretch;
        let turn = (by.exit - self.along * self.along.dot(&by.exit)) / self.tension;
        let mut sum = -(self.elastic + self.kinetic) * (length / self.unstrained);
        sum += self.elastic * by.modulus;
        if self.density > 0.0 {
            sum -= self.kinetic * (by.density / self.density);
        }
        let pull = self.density * self.gravity.dot(&self.along);
        let of_pull = self.density * (by.gravity.dot(&self.along) + self.gravity.dot(&turn))
            + by.density * self.gravity.dot(&self.along);
        sum -= self.motion * self.motion * ((of_pull - pull * strain / stretch) / stretch);
        (sum + self.motion * self.reaction.dot(&turn.map(real)) * 2.0, length)
    }
}
