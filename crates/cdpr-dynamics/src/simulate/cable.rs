//! One cable in motion: its unknowns, what moves them, and what it does to the platform.

mod energy;
mod tangent;

pub(super) use tangent::CableMatrices;

use super::lead::{Lead, Way};
use super::mesh::{Forces, Material, Mesh, Points, Pull, Rule};
use super::winch::Reeling;
use cdpr_robot::{Matrix3, Vector3};
use std::sync::Arc;

/// Where a cable begins.
#[derive(Clone, Debug)]
pub(super) enum Start {
    /// At its exit point.
    Fixed(Vector3<f64>),
    /// Behind its lead and pulley: one unknown, by which they are longer than at rest, and one of a wheel that
    /// swivels by itself.
    Led(Box<Lead>),
    /// Nowhere: it has parted at its exit.
    Loose,
}

/// A cable in motion.
#[derive(Clone, Debug)]
pub(super) struct CableInMotion<'a> {
    pub(super) index: usize,
    pub(super) material: Material<'a>,
    /// In the platform frame [m].
    pub(super) anchor: Vector3<f64>,
    pub(super) start: Start,
    /// Elements; none of a cable without mass, which is straight.
    pub(super) mesh: Option<Mesh>,
    /// Unstrained length at rest, of the free part or, without elements, of the whole cable [m].
    pub(super) length: f64,
    /// Least tension at rest [N].
    pub(super) least_tension: f64,
    pub(super) reeling: Vec<Reeling>,
    /// Index of its first unknown.
    pub(super) first: usize,
}

/// Place and velocity of an anchor point.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct End {
    pub(super) lever: Vector3<f64>,
    pub(super) position: Vector3<f64>,
    pub(super) velocity: Vector3<f64>,
}

/// A cable at an instant.
#[derive(Clone, Debug, Default)]
pub(super) struct Instant {
    pub(super) points: Points,
    pub(super) forces: Forces,
    /// Unstrained length [m] and its rate [m/s].
    pub(super) length: (f64, f64),
    pub(super) way: Option<Way>,
    /// How the first point moves with the next one, and with the wheel where that swivels by itself.
    turning: Matrix3<f64>,
    swivelling: Option<Vector3<f64>>,
}

impl Instant {
    /// Whether it carries no elastic tension at a point.
    pub(super) fn is_slack(&self) -> bool {
        self.forces.pulls.iter().any(|pull| pull.elastic <= 0.0)
    }
}

/// What a cable adds to the platform.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct OnPlatform {
    /// Force at the anchor point [N].
    pub(super) force: Vector3<f64>,
    /// Mass there [kg].
    pub(super) mass: f64,
}

impl CableInMotion<'_> {
    /// Unknowns where the cable begins.
    pub(super) fn of_start(&self) -> usize {
        self.mesh.as_ref().map_or(0, |mesh| self.of_start_on(mesh))
    }

    /// The same on other elements.
    fn of_start_on(&self, mesh: &Mesh) -> usize {
        match &self.start {
            Start::Fixed(_) => 0,
            Start::Led(lead) => 1 + usize::from(lead.swivels() && mesh.rule.degree > 1),
            Start::Loose => 3,
        }
    }

    /// Number of unknowns.
    pub(super) fn size(&self) -> usize {
        self.of_start() + self.mesh.as_ref().map_or(0, |mesh| 3 * (mesh.size() - 2))
    }

    /// Whether it begins behind a lead that has an unknown.
    pub(super) fn is_led(&self) -> bool {
        matches!(self.start, Start::Led(_)) && self.mesh.is_some()
    }

    /// A chain of straight elements for it, whose first one is slack wherever a slack cable comes to a
    /// pulley.
    pub(super) fn chain(&self, elements: usize) -> Mesh {
        let share = if let Start::Led(lead) = &self.start { lead.around() / self.length } else { 0.0 };
        Mesh::beginning(&Arc::new(Rule::new(1)), elements, share)
    }

    /// Whether it is a chain of straight elements.
    pub(super) fn is_chain(&self) -> bool {
        self.mesh.as_ref().is_some_and(|mesh| mesh.rule.degree == 1)
    }

    /// The unknowns and their rates on other elements.
    pub(super) fn on(&self, mesh: &Mesh, at: &Instant, own: [&[f64]; 2]) -> [Vec<f64>; 2] {
        let shares = mesh.shares();
        let vectors = [&at.points.positions, &at.points.velocities];
        std::array::from_fn(|k| {
            let inner = shares[1..shares.len() - 1].iter().flat_map(|share| {
                let vector = self.mesh.as_ref().map(|mesh| mesh.at(*share, vectors[k]));
                <[f64; 3]>::from(vector.unwrap_or_default())
            });
            own[k][..self.of_start_on(mesh)].iter().copied().chain(inner).collect()
        })
    }

    /// Unstrained length [m] and its rate [m/s] at a time [s].
    pub(super) fn length_at(&self, time: f64) -> (f64, f64) {
        self.reeling.iter().fold((self.length, 0.0), |(length, rate), winch| {
            let [by, speed] = winch.at(time);
            (length - by, rate - speed)
        })
    }

    /// The cable at a time, in the memory of another instant; `own` are its unknowns and their rates.
    pub(super) fn at(&self, time: f64, end: &End, own: [&[f64]; 2], at: &mut Instant) {
        let length = self.length_at(time);
        let next = self.next(end, own);
        let way = match &self.start {
            Start::Led(lead) => Some(lead.way(&next[0], if self.of_start() > 1 { own[0][1] } else { 0.0 })),
            _ => None,
        };
        (at.length, at.way) = (length, way);
        (at.turning, at.swivelling) = (Matrix3::zeros(), None);
        let Points { positions, velocities } = &mut at.points;
        positions.clear();
        velocities.clear();
        let Some(mesh) = &self.mesh else { return self.straight(end, length, at) };
        let begin = match (&self.start, &way) {
            (Start::Fixed(exit), _) => [*exit, Vector3::zeros()],
            (Start::Led(lead), Some(way)) => {
                if self.has_next() {
                    (at.turning, at.swivelling) = lead.turning(way, own[0][0]);
                }
                let mut velocity = way.direction * own[1][0] + at.turning * next[1];
                if let Some(swivelling) = at.swivelling {
                    velocity += swivelling * own[1][1];
                }
                [lead.end(way, own[0][0]), velocity]
            }
            _ => own.map(|own| Vector3::from_column_slice(&own[..3])),
        };
        for ((vectors, own), [begin, end]) in [positions, velocities]
            .into_iter()
            .zip(own)
            .zip([[begin[0], end.position], [begin[1], end.velocity]])
        {
            vectors.push(begin);
            vectors.extend(own[self.of_start()..].chunks_exact(3).map(Vector3::from_column_slice));
            vectors.push(end);
        }
        // Material comes out of the exit along the cable.
        if let (true, Some(part)) = (length.1 != 0.0, mesh.parts(length.0).next()) {
            let slope = part.slopes(&mesh.rule.pulls[0].1, &at.points).0;
            at.points.velocities[0] += slope * length.1;
        }
        mesh.forces(&self.material, length, &at.points, &mut at.forces);
    }

    /// Whether it begins behind a lead that turns towards a point of its own.
    fn has_next(&self) -> bool {
        self.is_led() && self.size() > self.of_start()
    }

    /// The point to which its lead turns, and its velocity.
    fn next(&self, end: &End, own: [&[f64]; 2]) -> [Vector3<f64>; 2] {
        if self.has_next() {
            own.map(|own| Vector3::from_column_slice(&own[self.of_start()..][..3]))
        } else {
            [end.position, end.velocity]
        }
    }

    /// A straight cable without mass.
    fn straight(&self, end: &End, (length, growth): (f64, f64), at: &mut Instant) {
        let exit = match &self.start {
            Start::Fixed(exit) => Some(*exit),
            Start::Led(_) => at.way.map(|way| way.point),
            Start::Loose => None,
        };
        at.forces = Forces::default();
        let Some(exit) = exit else { return };
        let span = end.position - exit;
        let (free, guided) = at.way.map_or((span.norm(), 0.0), |way| (way.free, way.guided));
        let along = at.way.map_or_else(|| span / free.max(f64::MIN_POSITIVE), |way| way.direction);
        let stretch = (free + guided) / length;
        let rate = (along.dot(&end.velocity) - stretch * growth) / length;
        let pull = self.material.stretched(along, stretch, rate);
        at.forces.pulls.push(pull);
        at.forces.forces.push(-along * pull.tension);
        at.forces.masses.push(0.0);
        at.points.positions.extend([exit, end.position]);
        at.points.velocities.extend([Vector3::zeros(), end.velocity]);
    }

    /// What it adds to the platform.
    pub(super) fn on_platform(&self, at: &Instant) -> OnPlatform {
        match (at.forces.forces.last(), at.forces.masses.last()) {
            (Some(force), Some(mass)) => OnPlatform { force: *force, mass: *mass },
            _ => OnPlatform::default(),
        }
    }

    /// Tension at exit and anchor point [N].
    pub(super) fn tensions(&self, at: &Instant) -> [f64; 2] {
        let tension = |pull: Option<&Pull>| pull.map_or(0.0, |pull| pull.tension);
        let exit = if matches!(self.start, Start::Loose) { 0.0 } else { tension(at.forces.pulls.first()) };
        [exit, tension(at.forces.pulls.last())]
    }

    /// Mass, and force without that of gravity, of the unknown where a cable with a lead begins.
    fn of_lead(&self, lead: &Lead, at: &Instant, own: [&[f64]; 2]) -> [f64; 2] {
        let Some(way) = &at.way else { return [1.0, 0.0] };
        let (pull, _) = lead.pull(&self.material, own[0][0], own[1][0]);
        let force = at.forces.forces[0].dot(&way.direction) - pull.tension;
        [at.forces.masses[0] + lead.mass(&self.material), force]
    }

    /// Rates and accelerations of its unknowns.
    pub(super) fn slopes(
        &self,
        at: &Instant,
        own: [&[f64]; 2],
        gravity: &Vector3<f64>,
        [rates, accelerations]: [&mut [f64]; 2],
    ) {
        if self.mesh.is_none() {
            return;
        }
        let (mut next, mut more) = (0, Vector3::zeros());
        if let (Start::Led(lead), Some(way)) = (&self.start, &at.way) {
            let on_first = at.forces.forces[0] + gravity * at.forces.masses[0];
            more = at.turning.tr_mul(&on_first);
            let [mass, force] = self.of_lead(lead, at, own);
            rates[0] = own[1][0];
            accelerations[0] = (force + at.forces.masses[0] * gravity.dot(&way.direction)) / mass;
            if let Some(swivelling) = &at.swivelling {
                rates[1] = own[1][1];
                accelerations[1] = on_first.dot(swivelling) / at.forces.masses[0];
            }
            next = self.of_start();
        }
        let first = usize::from(!matches!(self.start, Start::Loose));
        for point in first..at.points.positions.len() - 1 {
            let force = at.forces.forces[point] + if point == 1 { more } else { Vector3::zeros() };
            let mut acceleration = force * (1.0 / at.forces.masses[point]) + gravity;
            let mut rate = Vector3::from_column_slice(&own[1][next..next + 3]);
            if let Some((velocities, more)) = &at.forces.flow {
                rate += velocities[point];
                acceleration += more[point];
            }
            rates[next..next + 3].copy_from_slice(rate.as_slice());
            accelerations[next..next + 3].copy_from_slice(acceleration.as_slice());
            next += 3;
        }
    }
}
