//! The chain of an observation for robots with taut cables, one robot a lane: inverse model, offset set-points, direct model without
//! and with the load.
//!
//! The equations are those of [`crate::inverse`] and [`crate::newton`], with one difference: the shape of a cable is not solved for but
//! takes part in the iteration. With û the direction of its end force, n̂ the normal to it, C the flexibility, `e = d(x, z)/dL` and c its
//! miss at force and length,
//!
//! ```text
//! C (û dt + n̂ t dθ) + e dL = c      gives      dθ = α + β dt,    dL = γ + δ dt                         (a)
//! ```
//!
//! for a change dt of its tension. With w the wrench of a unit tension, n its derivative with respect to θ, and λ the multipliers of the
//! least-norm distribution,
//!
//! ```text
//! t + w·λ = 0,      sum t w + w_ex = 0                                                                 (b)
//! [ sum c wᵀ/D ] dλ = F2 - sum c F1/D,      dt = -(F1 + w·dλ)/D,                                       (c)
//!      D = 1 + β n·λ,   c = w + t β n,   F1 = t + (w + α n)·λ,   F2 = sum t (w + α n) + w_ex
//! ```
//!
//! A lane stops by its own steps alone: the others of a batch change none of its digits.

use crate::direct::MAX_STRAIN;
use crate::lanes::{Lanes, Mask, Simd};
use cdpr_cable::{Field, TAUT, taut_end, taut_response};

/// A point or a vector in the base frame.
type Space<S> = [Lanes<S>; 3];

/// A vector in a cable's vertical plane: along the azimuth, upwards.
type Plane<S> = [Lanes<S>; 2];

/// Force and moment about P, or translation and rotation.
type Wrench<S> = [Lanes<S>; 6];

/// A cable of every robot.
pub(crate) struct Cable<S: Simd> {
    /// Weight per length [N/m].
    pub(crate) weight: Lanes<S>,
    /// 1/EA [1/N].
    pub(crate) stretch: Lanes<S>,
    /// Exit point [m].
    pub(crate) exit: Space<S>,
    /// s = R a [m].
    pub(crate) arm: Space<S>,
    /// Offset of the tension set-point [N].
    pub(crate) offset: Lanes<S>,
    /// Unstrained length [m].
    pub(crate) length: Lanes<S>,
    /// Force at A [N].
    pub(crate) force: Plane<S>,
}

/// Robots at their wanted pose, each in a lane. Lengths, forces and multipliers are starts.
pub(crate) struct Robots<S: Simd> {
    pub(crate) cables: Vec<Cable<S>>,
    /// Position of the platform [m].
    pub(crate) position: Space<S>,
    /// R c, the arm of the centre of mass [m].
    pub(crate) center: Space<S>,
    /// Weight of the platform [N].
    pub(crate) weight: Lanes<S>,
    /// λ.
    pub(crate) multipliers: Wrench<S>,
}

/// What all robots have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Settings {
    /// Limits of the tensions [N].
    pub(crate) least: f64,
    pub(crate) greatest: f64,
    /// Weight of the payload [N].
    pub(crate) payload: f64,
    /// Force of the load at P [N].
    pub(crate) force: [f64; 3],
    /// Length that steps are compared with [m].
    pub(crate) size: f64,
    /// Length that makes rotations comparable with translations [m].
    pub(crate) arm: f64,
    /// Sum of the tensions that changes are compared with [N].
    pub(crate) tension: f64,
    /// Rounding of a closure [m].
    pub(crate) rounding: f64,
}

/// What an equilibrium leaves open.
#[derive(Clone, Copy)]
pub(crate) struct Open<S: Simd> {
    /// Largest distance of a cable's end from its anchor point, squared [m²].
    pub(crate) closure: Lanes<S>,
    /// Force [N] and moment [N m] on the platform.
    pub(crate) wrench: Wrench<S>,
}

/// What became of every robot.
pub(crate) struct Outcome<S: Simd> {
    /// Lanes with an answer: converged to rounding, stable, all cables taut, all tensions within their limits.
    pub(crate) valid: Mask<S>,
    /// dp [m].
    pub(crate) displacement: Space<S>,
    pub(crate) unloaded: Open<S>,
    pub(crate) loaded: Open<S>,
}

const MAX_ITERATIONS: usize = 8;

/// A step below this, relative to what it changes, is followed by one below rounding.
const LAST_STEP: f64 = 1e-7;

/// Rounding of a sum of forces, relative to that of their magnitudes.
const FORCE_ROUNDING: f64 = 1e-12;

/// Observes every robot: its displacement under the load, with the lengths that give the offset tensions at the wanted pose.
#[inline(always)]
pub(crate) fn observe<S: Simd>(simd: S, robots: &mut Robots<S>, settings: &Settings) -> Outcome<S> {
    let zero = Lanes::splat(simd, 0.0);
    let spans: Vec<Span<S>> = robots.cables.iter().map(|cable| Span::new(&robots.position, cable)).collect();
    let within = distribute(robots, &spans, settings);
    let held = hold(robots, &spans, settings);

    let mut linear = Vec::with_capacity(spans.len());
    let own = Load { weight: robots.weight, force: [zero; 3] };
    let start = robots.linearise(&own, &mut linear, settings);
    // The lengths close at the wanted pose.
    let closed = start.open.closure.less_or_equal(zero.all(settings.rounding * settings.rounding));
    let (standing, unloaded) = robots.settle(&own, start, &mut linear, settings, within & held & closed);
    let stood = robots.position;

    let payload = Load { weight: zero.all(settings.payload), force: three(|k| zero.all(settings.force[k])) };
    let load = Load { weight: own.weight + payload.weight, force: payload.force };
    // The first step follows the linearisation at hand.
    let mut start = unloaded;
    let added = payload.wrench(&robots.center);
    start.gradient = six(|k| start.gradient[k] - added[k]);
    let (valid, loaded) = robots.settle(&load, start, &mut linear, settings, standing);
    Outcome {
        valid,
        displacement: three(|k| robots.position[k] - stood[k]),
        unloaded: unloaded.open,
        loaded: loaded.open,
    }
}

/// From exit to anchor point: azimuth and (h, z).
struct Span<S: Simd> {
    azimuth: Plane<S>,
    end: Plane<S>,
}

/// A cable at its held ends, equation (a).
#[derive(Clone, Copy)]
struct Held<S: Simd> {
    tension: Lanes<S>,
    /// û.
    along: Plane<S>,
    alpha: Lanes<S>,
    beta: Lanes<S>,
    gamma: Lanes<S>,
    delta: Lanes<S>,
}

impl<S: Simd> Span<S> {
    #[inline(always)]
    fn new(position: &Space<S>, cable: &Cable<S>) -> Self {
        let r = three(|k| position[k] + cable.arm[k] - cable.exit[k]);
        let h = (r[0] * r[0] + r[1] * r[1]).sqrt();
        let inverse = h.recip();
        Self { azimuth: [r[0] * inverse, r[1] * inverse], end: [h, r[2]] }
    }

    /// Wrench on the platform of a force on the cable's end.
    #[inline(always)]
    fn wrench(&self, arm: &Space<S>, [x, z]: Plane<S>) -> Wrench<S> {
        let force = [-x * self.azimuth[0], -x * self.azimuth[1], -z];
        let moment = cross(arm, &force);
        [force[0], force[1], force[2], moment[0], moment[1], moment[2]]
    }
}

impl<S: Simd> Held<S> {
    #[inline(always)]
    fn new(cable: &Cable<S>, end: &Plane<S>) -> Self {
        let [fx, fz] = cable.force;
        let response = taut_response(cable.weight, cable.stretch, cable.length, cable.force);
        let [xx, xz, zz] = response.flexibility;
        let tension_inv = response.tension.recip();
        let along = [fx * tension_inv, fz * tension_inv];
        let miss = [end[0] - response.end[0], end[1] - response.end[1]];
        let turn = [xz * fx - xx * fz, zz * fx - xz * fz];
        let give = [xx * along[0] + xz * along[1], xz * along[0] + zz * along[1]];
        let longer = response.end_per_length;
        let area = |a: &Plane<S>, b: &Plane<S>| a[0] * b[1] - a[1] * b[0];
        let inverse = area(&turn, &longer).recip();
        Self {
            tension: response.tension,
            along,
            alpha: area(&miss, &longer) * inverse,
            beta: -area(&give, &longer) * inverse,
            gamma: area(&turn, &miss) * inverse,
            delta: -area(&turn, &give) * inverse,
        }
    }

    /// Changes the tension by `dt` where `going`. Returns the largest relative change made.
    #[inline(always)]
    fn change(&self, cable: &mut Cable<S>, dt: Lanes<S>, going: Mask<S>, settings: &Settings) -> Lanes<S> {
        let across = (self.alpha + self.beta * dt) * self.tension;
        let longer = self.gamma + self.delta * dt;
        let [ux, uz] = self.along;
        let [fx, fz] = cable.force;
        cable.force =
            [going.select(fx + ux * dt - uz * across, fx), going.select(fz + uz * dt + ux * across, fz)];
        cable.length = going.select(cable.length + longer, cable.length);
        let force = (dt.abs() + across.abs()) * (1.0 / settings.tension);
        force.max(longer.abs() * (1.0 / settings.size))
    }
}

/// Least-norm tensions at the wanted pose, equations (b) and (c). Returns the lanes with taut cables and all tensions within the limits.
#[inline(always)]
fn distribute<S: Simd>(robots: &mut Robots<S>, spans: &[Span<S>], settings: &Settings) -> Mask<S> {
    let zero = robots.weight.all(0.0);
    let last_step = zero.all(LAST_STEP);
    let weight = Load { weight: robots.weight, force: [zero; 3] }.wrench(&robots.center);
    let mut going = zero.less_or_equal(zero);
    let mut linear = Vec::with_capacity(spans.len());
    for _ in 0..MAX_ITERATIONS {
        linear.clear();
        let mut matrix = [[zero; 6]; 6];
        let mut right = weight;
        for (span, cable) in spans.iter().zip(&robots.cables) {
            let held = Held::new(cable, &span.end);
            let [ux, uz] = held.along;
            let pull = span.wrench(&cable.arm, held.along);
            let turn = span.wrench(&cable.arm, [-uz, ux]);
            let turned = dot(&turn, &robots.multipliers);
            let d_inv = (held.beta * turned + 1.0).recip();
            let left = held.tension + dot(&pull, &robots.multipliers) + held.alpha * turned;
            for k in 0..6 {
                let c = (pull[k] + turn[k] * (held.tension * held.beta)) * d_inv;
                right[k] += (pull[k] + turn[k] * held.alpha) * held.tension - c * left;
                for l in 0..6 {
                    matrix[k][l] += c * pull[l];
                }
            }
            linear.push((held, pull, left, d_inv));
        }
        let step = Factored::new(matrix).solve(&right);
        let mut moved = zero;
        for ((held, pull, left, d_inv), cable) in linear.iter().zip(&mut robots.cables) {
            let dt = -(*left + dot(pull, &step)) * *d_inv;
            moved = moved.max(held.change(cable, dt, going, settings));
        }
        robots.multipliers = six(|k| going.select(robots.multipliers[k] + step[k], robots.multipliers[k]));
        going = going & !moved.less_or_equal(last_step);
        if !going.any() {
            break;
        }
    }
    let mut within = !going;
    for cable in &robots.cables {
        let tension = dot(&cable.force, &cable.force).sqrt();
        let (_, slackness) = taut_end(cable.weight, cable.stretch, cable.length, cable.force);
        within = within
            & zero.less_or_equal(cable.force[0])
            & slackness.less_or_equal(zero.all(TAUT))
            & zero.all(settings.least).less_or_equal(tension)
            & tension.less_or_equal(zero.all(settings.greatest));
    }
    within
}

/// Lengths that give the offset tensions at the wanted pose. Returns the lanes where all were found.
#[inline(always)]
fn hold<S: Simd>(robots: &mut Robots<S>, spans: &[Span<S>], settings: &Settings) -> Mask<S> {
    let zero = robots.weight.all(0.0);
    let mut all = zero.less_or_equal(zero);
    for (span, cable) in spans.iter().zip(&mut robots.cables) {
        let tension = dot(&cable.force, &cable.force).sqrt();
        let set_point = (tension + cable.offset).max(zero.all(settings.least));
        let mut going = all;
        for _ in 0..MAX_ITERATIONS {
            let held = Held::new(cable, &span.end);
            let moved = held.change(cable, set_point - held.tension, going, settings);
            going = going & !moved.less_or_equal(zero.all(LAST_STEP));
            if !going.any() {
                break;
            }
        }
        // A root with a cable of negative length is none.
        all = all & !going & zero.less_or_equal(cable.length) & zero.less_or_equal(cable.force[0]);
    }
    all
}

/// What acts on a platform: a weight at its centre of mass and a force at P.
struct Load<S: Simd> {
    weight: Lanes<S>,
    force: Space<S>,
}

impl<S: Simd> Load<S> {
    #[inline(always)]
    fn wrench(&self, center: &Space<S>) -> Wrench<S> {
        let [x, y, z] = self.force;
        [x, y, z - self.weight, -center[1] * self.weight, center[0] * self.weight, self.weight.all(0.0)]
    }
}

/// A cable linearised about a force that need not fit its ends: `df = K (c + d(h, z))`, as in [`crate::newton`].
struct Linear<S: Simd> {
    azimuth: Plane<S>,
    /// f + K c.
    predicted: Plane<S>,
    /// K: xx, xz, zz.
    stiffness: [Lanes<S>; 3],
}

/// The platform between linearised cables.
#[derive(Clone, Copy)]
struct Balance<S: Simd> {
    /// Gradient of the potential with the predicted forces.
    gradient: Wrench<S>,
    /// Its derivative, factored.
    factored: Factored<S>,
    /// What the state itself leaves open.
    open: Open<S>,
    /// Lanes that could be an equilibrium: open by rounding, stable, with cables that are pulled, taut and not overstrained.
    holds: Mask<S>,
}

impl<S: Simd> Robots<S> {
    #[inline(always)]
    fn linearise(&self, load: &Load<S>, linear: &mut Vec<Linear<S>>, settings: &Settings) -> Balance<S> {
        let zero = self.weight.all(0.0);
        let wrench = load.wrench(&self.center);
        let mut gradient = six(|k| -wrench[k]);
        let mut open = Open { closure: zero, wrench: gradient };
        let (mut tensions, mut slackness, mut strain) = (load.weight, zero, zero);
        let [cx, cy, cz] = self.center;
        // -[F_w][R c]: weight is vertical.
        let mut hessian = [[zero; 6]; 6];
        hessian[3][3] = -load.weight * cz;
        hessian[4][4] = hessian[3][3];
        hessian[3][5] = load.weight * cx;
        hessian[4][5] = load.weight * cy;
        linear.clear();
        let mut pulled = zero.less_or_equal(zero);
        for cable in &self.cables {
            let Span { azimuth, end } = Span::new(&self.position, cable);
            let [c, s] = azimuth;
            let [fx, fz] = cable.force;
            let response = taut_response(cable.weight, cable.stretch, cable.length, cable.force);
            pulled = pulled & zero.less_or_equal(fx);
            tensions += response.tension;
            slackness = slackness.max(response.slackness);
            strain = strain.max((response.tension + cable.weight * cable.length) * cable.stretch);
            let [xx, xz, zz] = response.flexibility;
            let inverse = response.determinant.recip();
            let k = [zz * inverse, -xz * inverse, xx * inverse];
            let miss = [end[0] - response.end[0], end[1] - response.end[1]];
            open.closure = open.closure.max(dot(&miss, &miss));
            add(&mut open.wrench, &cable.arm, &[fx * c, fx * s, fz]);
            let predicted = [fx + k[0] * miss[0] + k[1] * miss[1], fz + k[1] * miss[0] + k[2] * miss[1]];
            let force = [predicted[0] * c, predicted[0] * s, predicted[1]];
            add(&mut gradient, &cable.arm, &force);
            let lateral = response.lateral.recip();
            let (kc, ks, swing) = (k[0] * c, k[0] * s, lateral * s);
            let (xy, xz, yz) = (kc * s - swing * c, k[1] * c, k[1] * s);
            let space = [[kc * c + swing * s, xy, xz], [xy, ks * s + lateral * c * c, yz], [xz, yz, k[2]]];
            add_stiffness(&mut hessian, &cable.arm, &force, &space);
            linear.push(Linear { azimuth, predicted, stiffness: k });
        }
        for row in 3..6 {
            for column in 0..3 {
                hessian[row][column] = hessian[column][row];
            }
        }
        let factored = Factored::new(hessian);
        let (force, moment) = halves(&open.wrench);
        let unbalanced = dot(&force, &force).sqrt() + dot(&moment, &moment).sqrt() * (1.0 / settings.arm);
        let holds = factored.positive
            & pulled
            & open.closure.less_or_equal(zero.all(settings.rounding * settings.rounding))
            & unbalanced.less_or_equal(tensions * FORCE_ROUNDING)
            & slackness.less_or_equal(zero.all(TAUT))
            & strain.less_or_equal(zero.all(MAX_STRAIN));
        Balance { gradient, factored, open, holds }
    }

    /// Newton's method on the direct model from a linearisation, in the lanes `alive`. Returns the lanes that found an equilibrium, and
    /// the linearisation there.
    #[inline(always)]
    fn settle(
        &mut self,
        load: &Load<S>,
        start: Balance<S>,
        linear: &mut Vec<Linear<S>>,
        settings: &Settings,
        alive: Mask<S>,
    ) -> (Mask<S>, Balance<S>) {
        let zero = self.weight.all(0.0);
        let square = |length: f64| zero.all(length * length);
        let mut balance = start;
        let (mut going, mut found) = (alive, alive & !alive);
        for _ in 0..MAX_ITERATIONS {
            let step = balance.factored.solve(&six(|k| -balance.gradient[k]));
            let (translation, rotation) = halves(&step);
            let turned = dot(&rotation, &rotation);
            let moved = dot(&translation, &translation) + turned * (settings.arm * settings.arm);
            // Farther than this the linearisation means nothing, and no number is farther.
            going =
                going & moved.less_or_equal(square(0.3 * settings.size)) & turned.less_or_equal(square(0.1));
            self.apply(&translation, &rotation, turned, linear, going);
            balance = self.linearise(load, linear, settings);
            let last = going & moved.less_or_equal(square(LAST_STEP * settings.size)) & balance.holds;
            (found, going) = (found | last, going & !last);
            if !going.any() {
                break;
            }
        }
        (found, balance)
    }

    /// Moves the platforms and the forces of their cables where `going`.
    #[inline(always)]
    fn apply(
        &mut self,
        translation: &Space<S>,
        rotation: &Space<S>,
        square: Lanes<S>,
        linear: &[Linear<S>],
        going: Mask<S>,
    ) {
        // sin φ/φ and (1 - cos φ)/φ² to rounding for φ up to 0.1.
        let x = -square;
        let a =
            (((x * (1.0 / 72.0) + 1.0) * x * (1.0 / 42.0) + 1.0) * x * (1.0 / 20.0) + 1.0) * x * (1.0 / 6.0)
                + 1.0;
        let b =
            (((x * (1.0 / 90.0) + 1.0) * x * (1.0 / 56.0) + 1.0) * x * (1.0 / 30.0) + 1.0) * x * (1.0 / 24.0)
                + 0.5;
        for (cable, linear) in self.cables.iter_mut().zip(linear) {
            let (swung, arm) = turn(&cable.arm, rotation, a, b);
            let r = three(|k| translation[k] + swung[k]);
            let out = linear.azimuth[0] * r[0] + linear.azimuth[1] * r[1];
            let [xx, xz, zz] = linear.stiffness;
            let force =
                [linear.predicted[0] + xx * out + xz * r[2], linear.predicted[1] + xz * out + zz * r[2]];
            cable.force = [going.select(force[0], cable.force[0]), going.select(force[1], cable.force[1])];
            cable.arm = three(|k| going.select(arm[k], cable.arm[k]));
        }
        let (_, center) = turn(&self.center, rotation, a, b);
        self.center = three(|k| going.select(center[k], self.center[k]));
        self.position = three(|k| going.select(self.position[k] + translation[k], self.position[k]));
    }
}

/// φ x v, and v + a φ x v + b φ x (φ x v).
#[inline(always)]
fn turn<S: Simd>(v: &Space<S>, rotation: &Space<S>, a: Lanes<S>, b: Lanes<S>) -> (Space<S>, Space<S>) {
    let once = cross(rotation, v);
    let twice = cross(rotation, &once);
    (once, three(|k| v[k] + a * once[k] + b * twice[k]))
}

/// Adds (F, s x F).
#[inline(always)]
fn add<S: Simd>(wrench: &mut Wrench<S>, arm: &Space<S>, force: &Space<S>) {
    let moment = cross(arm, force);
    for k in 0..3 {
        wrench[k] += force[k];
        wrench[3 + k] += moment[k];
    }
}

/// Adds a cable of stiffness K with force F at the arm s; the lower left block is left for the end.
#[inline(always)]
fn add_stiffness<S: Simd>(hessian: &mut [[Lanes<S>; 6]; 6], s: &Space<S>, f: &Space<S>, k: &[Space<S>; 3]) {
    let [sx, sy, sz] = *s;
    // K [s], row by row: k x s.
    let ks = [cross(&k[0], s), cross(&k[1], s), cross(&k[2], s)];
    let along = dot(s, f);
    for row in 0..3 {
        for column in 0..3 {
            hessian[row][column] += k[row][column];
            hessian[row][3 + column] -= ks[row][column];
            hessian[3 + row][3 + column] += s[row] * f[column];
        }
        hessian[3 + row][3 + row] -= along;
    }
    for column in 0..3 {
        // [s] K [s], column by column: s x K [s].
        hessian[3][3 + column] -= sy * ks[2][column] - sz * ks[1][column];
        hessian[4][3 + column] -= sz * ks[0][column] - sx * ks[2][column];
        hessian[5][3 + column] -= sx * ks[1][column] - sy * ks[0][column];
    }
}

/// L U of a matrix that needs no pivoting: that of a stable platform, or of tensions that are distributed.
#[derive(Clone, Copy)]
struct Factored<S: Simd> {
    lu: [[Lanes<S>; 6]; 6],
    pivots_inv: [Lanes<S>; 6],
    /// Whether all pivots are positive: of a symmetric matrix, whether it is positive definite.
    positive: Mask<S>,
}

impl<S: Simd> Factored<S> {
    #[inline(always)]
    fn new(matrix: [[Lanes<S>; 6]; 6]) -> Self {
        let mut lu = matrix;
        let mut pivots_inv = [lu[0][0]; 6];
        let tiny = lu[0][0].all(f64::MIN_POSITIVE);
        let mut positive = tiny.less_or_equal(lu[0][0]);
        for k in 0..6 {
            positive = positive & tiny.less_or_equal(lu[k][k]);
            pivots_inv[k] = lu[k][k].recip();
            for row in k + 1..6 {
                lu[row][k] = lu[row][k] * pivots_inv[k];
                for column in k + 1..6 {
                    lu[row][column] = lu[row][column] - lu[row][k] * lu[k][column];
                }
            }
        }
        Self { lu, pivots_inv, positive }
    }

    #[inline(always)]
    fn solve(&self, right: &Wrench<S>) -> Wrench<S> {
        let mut x = *right;
        for row in 1..6 {
            for column in 0..row {
                x[row] = x[row] - self.lu[row][column] * x[column];
            }
        }
        for row in (0..6).rev() {
            for column in row + 1..6 {
                x[row] = x[row] - self.lu[row][column] * x[column];
            }
            x[row] = x[row] * self.pivots_inv[row];
        }
        x
    }
}

// `std::array::from_fn` is no part of what is compiled for the vector unit.
#[inline(always)]
pub(crate) fn three<S: Simd>(component: impl Fn(usize) -> Lanes<S>) -> Space<S> {
    [component(0), component(1), component(2)]
}

#[inline(always)]
pub(crate) fn six<S: Simd>(component: impl Fn(usize) -> Lanes<S>) -> Wrench<S> {
    [component(0), component(1), component(2), component(3), component(4), component(5)]
}

#[inline(always)]
fn halves<S: Simd>(wrench: &Wrench<S>) -> (Space<S>, Space<S>) {
    (three(|k| wrench[k]), three(|k| wrench[3 + k]))
}

#[inline(always)]
fn cross<S: Simd>(a: &Space<S>, b: &Space<S>) -> Space<S> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

#[inline(always)]
fn dot<S: Simd, const N: usize>(a: &[Lanes<S>; N], b: &[Lanes<S>; N]) -> Lanes<S> {
    let mut sum = a[0] * b[0];
    for k in 1..N {
        sum += a[k] * b[k];
    }
    sum
}
