//! Platform and cables in motion.
//!
//! The end of each cable moves with the platform; its mass is a point mass there. With their sum M about P,
//! the forces F at the levers s, and the angular velocity ω in the base frame,
//!
//! ```text
//! M (dv/dt, dω/dt) = (Σ F - m ω × (ω × s), Σ s × (F - m ω × (ω × s)) - ω × I ω)                    (X5)
//! ```
//!
//! [`Snapshot`] has all of it at an instant, and its memory serves for the next one.

use super::cable::{CableInMotion, End, Instant};
use super::collocation::Equations;
use super::matrices::Matrices;
use cdpr_robot::{Matrix3, Rotation3, Vector3, Vector6, Wrench, orthonormalized};
use nalgebra::{Matrix6, SMatrix};

/// Platform and cables. The state holds the unknowns and then their velocities; the first six unknowns are
/// the position of P [m] and the rotation vector [rad] since the last step.
#[derive(Clone, Debug)]
pub(super) struct System<'a> {
    pub(super) cables: Vec<CableInMotion<'a>>,
    pub(super) body: Body,
    /// Rotation at the last step.
    pub(super) rotation: Rotation3<f64>,
    pub(super) gravity: Vector3<f64>,
    /// Whether each motion of the platform is free.
    pub(super) free: [bool; 6],
    /// Error of a step that is accepted, of a position [m] and of a rotation [rad].
    pub(super) tolerances: [f64; 2],
    /// The same of each unknown and each velocity.
    pub(super) scale: Vec<f64>,
}

/// The platform with its payload.
#[derive(Clone, Copy, Debug)]
pub(super) struct Body {
    /// Mass of platform and payload [kg].
    pub(super) mass: f64,
    /// Centre of mass in the platform frame [m].
    pub(super) center: Vector3<f64>,
    /// About it, in the platform frame [kg m²].
    pub(super) inertia: Matrix3<f64>,
    /// Wrenches at P in the base frame, of the load, of events and of a control.
    pub(super) load: Wrench,
    pub(super) event: Wrench,
    pub(super) control: Wrench,
}

impl Body {
    fn force(&self) -> Vector3<f64> {
        self.load.force + self.event.force + self.control.force
    }

    fn moment(&self) -> Vector3<f64> {
        self.load.moment + self.event.moment + self.control.moment
    }
}

/// The platform at an instant.
#[derive(Clone, Copy, Debug, Default)]
struct Frame {
    rotation: Matrix3<f64>,
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
}

/// Platform and cables at an instant: forces on the platform and its mass matrix about P.
#[derive(Clone, Debug, Default)]
pub(super) struct Snapshot {
    frame: Frame,
    /// Of each cable.
    pub(super) cables: Vec<(End, Instant)>,
    wrench: Vector6<f64>,
    pub(super) mass: Matrix6<f64>,
}

impl System<'_> {
    /// Number of unknowns.
    pub(super) fn size(&self) -> usize {
        self.cables.iter().map(CableInMotion::size).sum::<usize>() + 6
    }

    fn frame(&self, state: &[f64]) -> Frame {
        let (q, v) = state.split_at(state.len() / 2);
        let turned = Rotation3::new(Vector3::from_column_slice(&q[3..6])) * self.rotation;
        Frame {
            rotation: *turned.matrix(),
            position: Vector3::from_column_slice(&q[..3]),
            velocity: Vector3::from_column_slice(&v[..3]),
            spin: Vector3::from_column_slice(&v[3..6]),
        }
    }

    /// Unknowns of a cable and their rates.
    pub(super) fn own<'s>(&self, cable: &CableInMotion, state: &'s [f64]) -> [&'s [f64]; 2] {
        let (q, v) = state.split_at(state.len() / 2);
        let range = cable.first..cable.first + cable.size();
        [&q[range.clone()], &v[range]]
    }

    fn end(frame: &Frame, cable: &CableInMotion) -> End {
        let lever = frame.rotation * cable.anchor;
        End { lever, position: frame.position + lever, velocity: frame.velocity + frame.spin.cross(&lever) }
    }

    /// Platform and cables at a time and a state, in the memory of another snapshot.
    pub(super) fn look(&self, time: f64, state: &[f64], at: &mut Snapshot) {
        let frame = self.frame(state);
        at.frame = frame;
        at.cables.resize_with(self.cables.len(), Default::default);
        for (cable, (end, instant)) in self.cables.iter().zip(&mut at.cables) {
            *end = Self::end(&frame, cable);
            cable.at(time, end, self.own(cable, state), instant);
        }
        let body = &self.body;
        let inertia = frame.rotation * body.inertia * frame.rotation.transpose();
        let (mut total, mut first, mut second) = (0.0, Vector3::zeros(), inertia);
        let (mut force, mut moment) =
            (body.force(), body.moment() - frame.spin.cross(&(inertia * frame.spin)));
        for (mass, lever, pull) in self.masses(at) {
            let pulling = pull - mass * frame.spin.cross(&frame.spin.cross(&lever));
            force += pulling;
            moment += lever.cross(&pulling);
            total += mass;
            first += mass * lever;
            second += mass * (Matrix3::identity() * lever.norm_squared() - lever * lever.transpose());
        }
        let arm = first.cross_matrix();
        at.wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        at.mass.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * total));
        at.mass.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
        at.mass.fixed_view_mut::<3, 3>(3, 0).copy_from(&arm);
        at.mass.fixed_view_mut::<3, 3>(3, 3).copy_from(&second);
        for k in (0..6).filter(|k| !self.free[*k]) {
            at.wrench[k] = 0.0;
            at.mass.row_mut(k).fill(0.0);
            at.mass.column_mut(k).fill(0.0);
            at.mass[(k, k)] = 1.0;
        }
    }

    /// The masses that move with the platform: mass, lever and force of each, of the body and of cables.
    fn masses(&self, at: &Snapshot) -> impl Iterator<Item = (f64, Vector3<f64>, Vector3<f64>)> {
        let center = (self.body.mass, at.frame.rotation * self.body.center, Vector3::zeros());
        let of_cables = self.cables.iter().zip(&at.cables).map(|(cable, (end, instant))| {
            let part = cable.on_platform(instant);
            (part.mass, end.lever, part.force)
        });
        let weighed = move |(mass, lever, pull)| (mass, lever, pull + mass * self.gravity);
        std::iter::once(center).chain(of_cables).map(weighed)
    }

    /// A new snapshot.
    pub(super) fn snapshot(&self, time: f64, state: &[f64]) -> Snapshot {
        let mut snapshot = Snapshot::default();
        self.look(time, state, &mut snapshot);
        snapshot
    }

    /// Of each cable its index, its tension at exit and anchor point [N], and whether a part of it is slack.
    pub(super) fn tensions(&self, at: &Snapshot) -> impl Iterator<Item = (usize, [f64; 2], bool)> {
        let of = |(cable, (_, at)): (&CableInMotion, &(End, Instant))| {
            (cable.index, cable.tensions(at), at.is_slack())
        };
        self.cables.iter().zip(&at.cables).map(of)
    }

    /// A cable at a state.
    pub(super) fn instant(&self, time: f64, state: &[f64], cable: &CableInMotion) -> Instant {
        let mut instant = Instant::default();
        cable.at(time, &Self::end(&self.frame(state), cable), self.own(cable, state), &mut instant);
        instant
    }

    /// Kinetic energy [J].
    pub(super) fn kinetic(&self, at: &Snapshot, state: &[f64]) -> f64 {
        let v = state.len() / 2;
        let motion = Vector6::from_column_slice(&state[v..v + 6]);
        let mut kinetic = 0.5 * motion.dot(&(at.mass * motion));
        for (cable, (_, at)) in self.cables.iter().zip(&at.cables) {
            kinetic += cable.kinetic(at, self.own(cable, state));
        }
        kinetic
    }

    /// Kinetic energy, and energy stored in cables and by height [J].
    pub(super) fn energy(&self, at: &Snapshot, state: &[f64]) -> f64 {
        let center = at.frame.position + at.frame.rotation * self.body.center;
        let mut energy = self.kinetic(at, state) - self.body.mass * self.gravity.dot(&center);
        for (cable, (_, at)) in self.cables.iter().zip(&at.cables) {
            energy += cable.stored(at, self.own(cable, state), &self.gravity);
        }
        energy
    }

    /// Whether cables are damped.
    pub(super) fn is_damped(&self) -> bool {
        self.cables.iter().any(|cable| cable.material.damping > 0.0)
    }

    /// Whether winches move at a time [s], or cables are damped.
    pub(super) fn has_power(&self, time: f64) -> bool {
        self.is_damped() || self.cables.iter().any(|cable| cable.length_at(time).1 != 0.0)
    }

    /// Power of winches and forces, and power lost in the cables [W].
    pub(super) fn powers(&self, at: &Snapshot, state: &[f64]) -> [f64; 2] {
        let body = &self.body;
        let v = state.len() / 2;
        let [velocity, spin] = [v, v + 3].map(|first| Vector3::from_column_slice(&state[first..first + 3]));
        let own = body.force().dot(&velocity) + body.moment().dot(&spin);
        self.cables.iter().zip(&at.cables).fold([own, 0.0], |[given, lost], (cable, (_, at))| {
            let more = cable.powers(at, self.own(cable, state), &self.gravity);
            [given + more[0], lost + more[1]]
        })
    }

    /// How fast an anchor point moves along a direction, by each motion of the platform that is free.
    pub(super) fn way(&self, along: &Vector3<f64>, lever: &Vector3<f64>) -> Vector6<f64> {
        let turning = lever.cross(along);
        let way = [along.x, along.y, along.z, turning.x, turning.y, turning.z];
        Vector6::from_fn(|k, _| if self.free[k] { way[k] } else { 0.0 })
    }

    /// The derivative of the state by the time.
    pub(super) fn slopes_at(&self, at: &Snapshot, state: &[f64], slopes: &mut [f64]) {
        let (rates, accelerations) = slopes.split_at_mut(state.len() / 2);
        rates[..3].copy_from_slice(at.frame.velocity.as_slice());
        let turn = rotation_rate(&Vector3::from_column_slice(&state[3..6]), &at.frame.spin);
        rates[3..6].copy_from_slice(turn.as_slice());
        let factors = at.mass.cholesky();
        let motion = factors.map_or_else(|| Vector6::repeat(f64::NAN), |factors| factors.solve(&at.wrench));
        accelerations[..6].copy_from_slice(motion.as_slice());
        for (cable, (_, at)) in self.cables.iter().zip(&at.cables) {
            let range = cable.first..cable.first + cable.size();
            let slopes = [&mut rates[range.clone()], &mut accelerations[range]];
            cable.slopes(at, self.own(cable, state), &self.gravity, slopes);
        }
    }

    /// Takes the rotation of a step over, so that the rotation vector begins at zero again.
    pub(super) fn turn(&mut self, state: &mut [f64]) {
        let turned = Rotation3::new(Vector3::from_column_slice(&state[3..6])) * self.rotation;
        self.rotation = orthonormalized(turned.matrix());
        state[3..6].fill(0.0);
    }
}

impl Equations for System<'_> {
    type Linearization = Matrices;
    type Memory = Snapshot;

    fn slopes(&self, time: f64, state: &[f64], at: &mut Snapshot, slopes: &mut [f64]) {
        self.look(time, state, at);
        self.slopes_at(at, state, slopes);
    }

    fn linearize(&self, time: f64, state: &[f64]) -> Matrices {
        let snapshot = self.snapshot(time, state);
        let [mut stiffness, mut damping] = [Matrix6::zeros(); 2];
        for (_, lever, force) in self.masses(&snapshot) {
            let both = force * lever.transpose();
            let turning = 0.5 * (both + both.transpose()) - force.dot(&lever) * Matrix3::identity();
            let mut block = stiffness.fixed_view_mut::<3, 3>(3, 3);
            block -= turning;
        }
        let mut cables = Vec::new();
        for (cable, (end, at)) in self.cables.iter().zip(&snapshot.cables) {
            let (matrices, at_end) = cable.matrices(at, &end.lever, self.own(cable, state));
            let mut moves = SMatrix::<f64, 3, 6>::zeros();
            moves.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
            moves.fixed_view_mut::<3, 3>(0, 3).copy_from(&-end.lever.cross_matrix());
            stiffness += moves.transpose() * at_end[0] * moves;
            damping += moves.transpose() * at_end[1] * moves;
            cables.push(matrices);
        }
        for k in (0..6).filter(|k| !self.free[*k]) {
            for matrix in [&mut stiffness, &mut damping] {
                matrix.row_mut(k).fill(0.0);
                matrix.column_mut(k).fill(0.0);
            }
            cables.iter_mut().flat_map(|cable| &mut cable.coupling).flatten().for_each(|row| row[k] = 0.0);
        }
        Matrices { mass: snapshot.mass, stiffness, damping, cables, size: self.size() }
    }

    fn scale(&self) -> &[f64] {
        &self.scale
    }
}

/// Rate of the rotation vector φ [rad] for an angular velocity in the base frame [rad/s], the inverse of the
/// left Jacobian of the rotation group.
fn rotation_rate(turn: &Vector3<f64>, spin: &Vector3<f64>) -> Vector3<f64> {
    let angle = turn.norm();
    let factor = if angle < 1e-3 {
        (1.0 + angle * angle / 60.0) / 12.0
    } else {
        (1.0 - 0.5 * angle / (0.5 * angle).tan()) / (angle * angle)
    };
    let once = turn.cross(spin);
    spin - 0.5 * once + factor * turn.cross(&once)
}
