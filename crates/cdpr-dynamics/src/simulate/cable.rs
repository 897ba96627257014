//! One cable in motion: its unknowns, what moves them, and what it does to the platform.

use super::band::Band;
use super::lead::{Lead, Way};
use super::mesh::{Forces, Material, Mesh, Part, Points, Pull};
use super::winch::Reeling;
use cdpr_robot::{Matrix3, Vector3, Vector6};

/// Where a cable begins.
#[derive(Clone, Copy, Debug)]
pub(super) enum Start {
    /// At its exit point.
    Fixed(Vector3<f64>),
    /// Behind its lead and pulley: one unknown, by which they are longer than at rest.
    Led(Lead),
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

/// Matrices of one cable: of its own unknowns, and with the motions of the platform.
#[derive(Clone, Debug)]
pub(super) struct CableMatrices {
    pub(super) first: usize,
    pub(super) mass: Vec<f64>,
    pub(super) stiffness: Band<f64>,
    pub(super) damping: Band<f64>,
    pub(super) is_damped: bool,
    pub(super) coupling: Vec<[Vector6<f64>; 2]>,
    /// The first unknown that is coupled.
    pub(super) coupled: usize,
}

impl CableInMotion<'_> {
    /// Unknowns where the cable begins.
    fn of_start(&self) -> usize {
        match (&self.start, &self.mesh) {
            (Start::Led(_), Some(_)) => 1,
            (Start::Loose, Some(_)) => 3,
            _ => 0,
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
            own[k][..self.of_start()].iter().copied().chain(inner).collect()
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
        let way = match &self.start {
            Start::Led(lead) => Some(lead.way(&end.position)),
            _ => None,
        };
        (at.length, at.way) = (length, way);
        let Points { positions, velocities } = &mut at.points;
        positions.clear();
        velocities.clear();
        let Some(mesh) = &self.mesh else { return self.straight(end, length, at) };
        let begin = match &self.start {
            Start::Fixed(exit) => [*exit, Vector3::zeros()],
            Start::Led(lead) => way
                .map_or([Vector3::zeros(); 2], |way| [lead.end(&way, own[0][0]), way.direction * own[1][0]]),
            Start::Loose => own.map(|own| Vector3::from_column_slice(&own[..3])),
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
        let mut next = 0;
        if let (Start::Led(lead), Some(way)) = (&self.start, &at.way) {
            let [mass, force] = self.of_lead(lead, at, own);
            rates[0] = own[1][0];
            accelerations[0] = (force + at.forces.masses[0] * gravity.dot(&way.direction)) / mass;
            next = 1;
        }
        let first = usize::from(!matches!(self.start, Start::Loose));
        for point in first..at.points.positions.len() - 1 {
            let mut acceleration = at.forces.forces[point] * (1.0 / at.forces.masses[point]) + gravity;
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

    /// Kinetic energy without that of the anchor point's mass [J].
    pub(super) fn kinetic(&self, at: &Instant, own: [&[f64]; 2]) -> f64 {
        let before_last = at.points.positions.len().saturating_sub(1);
        let points = at.forces.masses.iter().zip(&at.points.velocities).take(before_last);
        let mut twice: f64 = points.map(|(mass, velocity)| mass * velocity.norm_squared()).sum();
        if let (Start::Led(lead), Some(_)) = (&self.start, &self.mesh) {
            twice += lead.mass(&self.material) * own[1][0] * own[1][0];
        }
        0.5 * twice
    }

    /// Energy stored by stretch and height [J].
    pub(super) fn stored(&self, at: &Instant, own: [&[f64]; 2], gravity: &Vector3<f64>) -> f64 {
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
    pub(super) fn powers(&self, at: &Instant, own: [&[f64]; 2], gravity: &Vector3<f64>) -> [f64; 2] {
        let Some(exit) = at.forces.pulls.first() else { return [0.0; 2] };
        let mut lost = 0.0;
        for (length, pull) in self.lengths_of_pulls(at) {
            lost += length * pull.viscosity * pull.rate * pull.rate;
        }
        let mut leaves = self.material.energy(exit) - exit.tension * exit.stretch;
        if self.mesh.is_some() {
            if let Start::Led(lead) = &self.start {
                lost += lead.energy(&self.material, own[0][0], own[1][0])[1];
            }
            let [position, velocity] = [&at.points.positions[0], &at.points.velocities[0]];
            leaves += self.material.density * (0.5 * velocity.norm_squared() - gravity.dot(position));
        }
        [at.length.1 * leaves, lost]
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

    /// Matrices about an instant, and stiffness and damping at the anchor point.
    pub(super) fn matrices(
        &self,
        at: &Instant,
        lever: &Vector3<f64>,
        own: [&[f64]; 2],
    ) -> (CableMatrices, [Matrix3<f64>; 2]) {
        let size = self.size();
        let degree = self.mesh.as_ref().map_or(0, |mesh| mesh.rule.degree);
        let width = (3 * degree + 2).min(size.max(1) - 1);
        let mut matrices = CableMatrices {
            first: self.first,
            mass: vec![0.0; size],
            stiffness: Band::zeros(size, width),
            damping: Band::zeros(size, width),
            is_damped: self.material.damping > 0.0,
            coupling: vec![[Vector6::zeros(); 2]; size],
            coupled: size,
        };
        let mut at_end = [Matrix3::zeros(); 2];
        let Some(mesh) = &self.mesh else {
            if let Some(pull) = at.forces.pulls.first() {
                let across = at.way.map_or(at.length.0 * pull.stretch, |way| way.free);
                at_end = [pull.stiffness(at.length.0, across), pull.damping(at.length.0)];
            }
            return (matrices, at_end);
        };
        let points = at.points.positions.len();
        let columns: Vec<Columns> = (0..points).map(|point| self.columns(at, point, points)).collect();
        for (point, columns) in columns.iter().enumerate().take(points - 1) {
            if let Columns::Own(unknowns) = columns {
                unknowns.iter().for_each(|(unknown, _)| matrices.mass[*unknown] = at.forces.masses[point]);
            }
        }
        if let Start::Led(lead) = &self.start {
            matrices.mass[0] = self.of_lead(lead, at, own)[0];
            let (_, [stiffness, damping]) = lead.pull(&self.material, own[0][0], own[1][0]);
            matrices.stiffness.add(0, 0, stiffness);
            matrices.damping.add(0, 0, damping);
        }
        let arm = lever.cross_matrix();
        let pulls = at.forces.pulls.chunks_exact(mesh.rule.pulls.len());
        for (part, pulls) in mesh.parts(at.length.0).zip(pulls) {
            for a in 0..=degree {
                for b in 0..=degree {
                    let blocks = || part.blocks(&mesh.rule, pulls, [a, b]);
                    match (&columns[part.first + a], &columns[part.first + b]) {
                        (Columns::Own(rows), Columns::Own(columns)) if b <= a => {
                            let [stiffness, damping] = blocks();
                            for (i, along) in rows {
                                for (j, other) in columns {
                                    matrices.stiffness.add(*i, *j, along.dot(&(stiffness * other)));
                                    matrices.damping.add(*i, *j, along.dot(&(damping * other)));
                                }
                            }
                        }
                        (Columns::Own(rows), Columns::Platform) => {
                            let blocks = blocks();
                            for (i, along) in rows {
                                matrices.coupled = matrices.coupled.min(*i);
                                for (coupling, block) in matrices.coupling[*i].iter_mut().zip(&blocks) {
                                    let pull = block.tr_mul(along);
                                    let moment = -arm.tr_mul(&pull);
                                    let both = [pull.x, pull.y, pull.z, moment.x, moment.y, moment.z];
                                    *coupling += Vector6::from(both);
                                }
                            }
                        }
                        (Columns::Platform, Columns::Platform) => {
                            let blocks = blocks();
                            (0..2).for_each(|k| at_end[k] += blocks[k]);
                        }
                        _ => {}
                    }
                }
            }
        }
        (matrices, at_end)
    }

    /// The unknowns that move a point.
    fn columns(&self, at: &Instant, point: usize, points: usize) -> Columns {
        if point + 1 == points {
            return Columns::Platform;
        }
        let (at_start, axes) = (self.of_start(), [Vector3::x(), Vector3::y(), Vector3::z()]);
        match (&self.start, &at.way) {
            (Start::Fixed(_), _) if point == 0 => Columns::Fixed,
            (Start::Led(_), Some(way)) if point == 0 => Columns::Own(vec![(0, way.direction)]),
            (Start::Loose, _) if point == 0 => Columns::Own((0..3).map(|k| (k, axes[k])).collect()),
            _ => Columns::Own((0..3).map(|k| (at_start + 3 * (point - 1) + k, axes[k])).collect()),
        }
    }
}

/// The unknowns that move a point, each with its direction.
enum Columns {
    Fixed,
    Platform,
    Own(Vec<(usize, Vector3<f64>)>),
}
