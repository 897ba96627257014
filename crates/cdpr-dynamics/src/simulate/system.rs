//! Platform and cables in motion.
//!
//! The end of each cable moves with the platform; its mass is a point mass there. With their sum M about P,
//! the forces F at the levers s, and the angular velocity ω in the base frame,
//!
//! ```text
//! M (dv/dt, dω/dt) = (Σ F - m ω × (ω × s), Σ s × (F - m ω × (ω × s)) - ω × I ω)                    (X5)
//! ```
//!
//! Newton's method needs `σ² M + σ C + K` for a real and a complex σ. Each cable has a narrow band in it,
//! which is eliminated; six unknowns are left.

use super::band::Factored;
use super::cable::{CableInMotion, CableMatrices, End, Instant};
use super::radau::{Equations, Linearization};
use cdpr_robot::{Matrix3, Rotation3, Vector3, Vector6, Wrench, orthonormalized};
use nalgebra::{ComplexField, Const, LU, Matrix6, SMatrix};

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
struct Frame {
    rotation: Matrix3<f64>,
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    spin: Vector3<f64>,
}

/// Forces on the platform and its mass matrix about P.
struct Acting {
    wrench: Vector6<f64>,
    mass: Matrix6<f64>,
    /// Each force with its lever.
    forces: Vec<[Vector3<f64>; 2]>,
}

/// Energies [J] and powers [W] of a state.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Power {
    pub(super) kinetic: f64,
    pub(super) stored: f64,
    /// Of winches and forces.
    pub(super) given: f64,
    /// Lost in the cables.
    pub(super) lost: f64,
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

    fn instants(&self, time: f64, state: &[f64], frame: &Frame) -> Vec<(End, Instant)> {
        let of = |cable: &CableInMotion| {
            let end = Self::end(frame, cable);
            (end, cable.at(time, &end, self.own(cable, state)))
        };
        self.cables.iter().map(of).collect()
    }

    fn acting(&self, frame: &Frame, instants: &[(End, Instant)]) -> Acting {
        let body = &self.body;
        let center = frame.rotation * body.center;
        let inertia = frame.rotation * body.inertia * frame.rotation.transpose();
        let mut acting = Acting { wrench: Vector6::zeros(), mass: Matrix6::zeros(), forces: Vec::new() };
        let mut bodies = vec![(body.mass, center, body.mass * self.gravity)];
        for (cable, (end, at)) in self.cables.iter().zip(instants) {
            let part = cable.on_platform(at);
            bodies.push((part.mass, end.lever, part.force + part.mass * self.gravity));
        }
        let (mut total, mut first, mut second) = (0.0, Vector3::zeros(), inertia);
        let (mut force, mut moment) =
            (body.force(), body.moment() - frame.spin.cross(&(inertia * frame.spin)));
        for (mass, lever, pull) in bodies {
            let pulling = pull - mass * frame.spin.cross(&frame.spin.cross(&lever));
            force += pulling;
            moment += lever.cross(&pulling);
            total += mass;
            first += mass * lever;
            let arm = lever.cross_matrix();
            second -= mass * arm * arm;
            acting.forces.push([pull, lever]);
        }
        let arm = first.cross_matrix();
        acting.wrench = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        acting.mass.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * total));
        acting.mass.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
        acting.mass.fixed_view_mut::<3, 3>(3, 0).copy_from(&arm);
        acting.mass.fixed_view_mut::<3, 3>(3, 3).copy_from(&second);
        for k in (0..6).filter(|k| !self.free[*k]) {
            acting.wrench[k] = 0.0;
            acting.mass.row_mut(k).fill(0.0);
            acting.mass.column_mut(k).fill(0.0);
            acting.mass[(k, k)] = 1.0;
        }
        acting
    }

    /// Of each cable its index, its tension at exit and anchor point [N], and whether a part of it is slack.
    pub(super) fn tensions(&self, time: f64, state: &[f64]) -> Vec<(usize, [f64; 2], bool)> {
        let instants = self.instants(time, state, &self.frame(state));
        let of = |(cable, (_, at)): (&CableInMotion, &(End, Instant))| {
            (cable.index, cable.tensions(at), at.is_slack())
        };
        self.cables.iter().zip(&instants).map(of).collect()
    }

    /// A cable at a state.
    pub(super) fn instant(&self, time: f64, state: &[f64], cable: &CableInMotion) -> Instant {
        cable.at(time, &Self::end(&self.frame(state), cable), self.own(cable, state))
    }

    /// Energies and powers.
    pub(super) fn power(&self, time: f64, state: &[f64]) -> Power {
        let frame = self.frame(state);
        let instants = self.instants(time, state, &frame);
        let v = state.len() / 2;
        let motion = Vector6::from_column_slice(&state[v..v + 6]);
        let mass = self.acting(&frame, &instants).mass;
        let center = frame.position + frame.rotation * self.body.center;
        let mut power = Power {
            kinetic: 0.5 * motion.dot(&(mass * motion)),
            stored: -self.body.mass * self.gravity.dot(&center),
            given: self.body.force().dot(&frame.velocity) + self.body.moment().dot(&frame.spin),
            lost: 0.0,
        };
        for (cable, (_, at)) in self.cables.iter().zip(&instants) {
            let [kinetic, stored, given, lost] = cable.energy(at, self.own(cable, state), &self.gravity);
            power.kinetic += kinetic;
            power.stored += stored;
            power.given += given;
            power.lost += lost;
        }
        power
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

    fn slopes(&self, time: f64, state: &[f64]) -> Vec<f64> {
        let frame = self.frame(state);
        let instants = self.instants(time, state, &frame);
        let acting = self.acting(&frame, &instants);
        let mut slopes = vec![0.0; state.len()];
        let (rates, accelerations) = slopes.split_at_mut(state.len() / 2);
        rates[..3].copy_from_slice(frame.velocity.as_slice());
        let turn = rotation_rate(&Vector3::from_column_slice(&state[3..6]), &frame.spin);
        rates[3..6].copy_from_slice(turn.as_slice());
        let motion = acting
            .mass
            .cholesky()
            .map_or_else(|| Vector6::repeat(f64::NAN), |factors| factors.solve(&acting.wrench));
        accelerations[..6].copy_from_slice(motion.as_slice());
        for (cable, (_, at)) in self.cables.iter().zip(&instants) {
            let range = cable.first..cable.first + cable.size();
            let slopes = [&mut rates[range.clone()], &mut accelerations[range]];
            cable.slopes(at, self.own(cable, state), &self.gravity, slopes);
        }
        slopes
    }

    fn linearize(&self, time: f64, state: &[f64]) -> Matrices {
        let frame = self.frame(state);
        let instants = self.instants(time, state, &frame);
        let acting = self.acting(&frame, &instants);
        let [mut stiffness, mut damping] = [Matrix6::zeros(); 2];
        for [force, lever] in &acting.forces {
            let both = force * lever.transpose();
            let turning = 0.5 * (both + both.transpose()) - force.dot(lever) * Matrix3::identity();
            let mut block = stiffness.fixed_view_mut::<3, 3>(3, 3);
            block -= turning;
        }
        let mut cables = Vec::new();
        for (cable, (end, at)) in self.cables.iter().zip(&instants) {
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
        Matrices { mass: acting.mass, stiffness, damping, cables, size: self.size() }
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

/// Mass, stiffness and damping of platform and cables.
#[derive(Clone, Debug)]
pub(super) struct Matrices {
    mass: Matrix6<f64>,
    stiffness: Matrix6<f64>,
    damping: Matrix6<f64>,
    cables: Vec<CableMatrices>,
    size: usize,
}

/// Factors of `σ² M + σ C + K`: L and D of each cable with `L⁻¹` times its coupling to the platform, of the
/// rows from the first that is coupled; and the platform's.
pub(super) struct Factors<T: ComplexField + Copy> {
    shift: T,
    cables: Vec<(Factored<T>, Vec<[T; 6]>)>,
    platform: LU<T, Const<6>, Const<6>>,
}

impl Linearization for Matrices {
    type Factors<T: ComplexField<RealField = f64> + Copy> = Factors<T>;

    fn factor<T: ComplexField<RealField = f64> + Copy>(&self, shift: T) -> Option<Factors<T>> {
        let real = T::from_real;
        let mut platform =
            self.mass.map(real) * (shift * shift) + self.damping.map(real) * shift + self.stiffness.map(real);
        let mut cables = Vec::with_capacity(self.cables.len());
        for cable in &self.cables {
            let mut band = cable.stiffness.map(&cable.damping, |k, c| real(k) + shift * real(c));
            for (i, mass) in cable.mass.iter().enumerate() {
                band.add(i, i, shift * shift * real(*mass));
            }
            let factored = band.factor()?;
            let mut coupling = cable.coupling(shift);
            let mut rows = vec![T::zero(); cable.mass.len()];
            for column in 0..6 {
                coupling.iter().zip(&mut rows[cable.coupled..]).for_each(|(row, value)| *value = row[column]);
                factored.forward(&mut rows, cable.coupled);
                coupling.iter_mut().zip(&rows[cable.coupled..]).for_each(|(row, value)| row[column] = *value);
            }
            for (row, inverse) in coupling.iter().zip(&factored.inverse_pivots()[cable.coupled..]) {
                for i in 0..6 {
                    for j in 0..6 {
                        platform[(i, j)] -= row[i] * *inverse * row[j];
                    }
                }
            }
            cables.push((factored, coupling));
        }
        let platform = platform.lu();
        platform.is_invertible().then_some(Factors { shift, cables, platform })
    }

    fn solve<T: ComplexField<RealField = f64> + Copy>(&self, by: &Factors<T>, right: &[T]) -> Vec<T> {
        let (real, shift, n) = (T::from_real, by.shift, self.size);
        let (rates, accelerations) = right.split_at(n);
        // (σ² M + σ C + K) x = M a + (σ M + C) r for the unknowns, σ x - r for the velocities.
        let six = |values: &[T]| Vector6::from_fn(|i, _| values[i]).map(|value: T| value);
        let mixed = six(accelerations) + six(rates) * shift;
        let mut on_platform = self.mass.map(real) * mixed + self.damping.map(real) * six(rates);
        let mut found = vec![T::zero(); 2 * n];
        for (cable, (factored, coupling)) in self.cables.iter().zip(&by.cables) {
            let size = cable.mass.len();
            let own = &rates[cable.first..cable.first + size];
            let mut load = cable.damping.times(own, |c, x| real(c) * x);
            for i in 0..size {
                load[i] += real(cable.mass[i]) * (accelerations[cable.first + i] + shift * own[i]);
            }
            for i in cable.coupled..size {
                for k in 0..6 {
                    let damping = real(cable.coupling[i][1][k]);
                    load[i] += damping * rates[k];
                    on_platform[k] += damping * own[i];
                }
            }
            factored.forward(&mut load, 0);
            let ends = load.iter().zip(factored.inverse_pivots()).skip(cable.coupled);
            for ((value, inverse), row) in ends.zip(coupling) {
                (0..6).for_each(|k| on_platform[k] -= row[k] * *inverse * *value);
            }
            found[cable.first..cable.first + size].copy_from_slice(&load);
        }
        let motion = by.platform.solve(&on_platform).unwrap_or_else(|| on_platform * T::from_real(f64::NAN));
        found[..6].copy_from_slice(motion.as_slice());
        for (cable, (factored, coupling)) in self.cables.iter().zip(&by.cables) {
            let own = &mut found[cable.first..cable.first + cable.mass.len()];
            for (value, row) in own[cable.coupled..].iter_mut().zip(coupling) {
                (0..6).for_each(|k| *value -= row[k] * motion[k]);
            }
            factored.backward(own);
        }
        for i in 0..n {
            found[n + i] = shift * found[i] - rates[i];
        }
        found
    }
}

impl CableMatrices {
    /// The rows of the unknowns that are coupled.
    fn coupling<T: ComplexField<RealField = f64> + Copy>(&self, shift: T) -> Vec<[T; 6]> {
        let real = T::from_real;
        let at = |[k, c]: &[Vector6<f64>; 2]| std::array::from_fn(|i| real(k[i]) + shift * real(c[i]));
        self.coupling[self.coupled..].iter().map(at).collect()
    }
}
