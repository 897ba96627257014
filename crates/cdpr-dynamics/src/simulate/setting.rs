//! How a motion is computed, and how it begins.

use super::cable::{CableInMotion, Start};
use super::lead::Lead;
use super::mesh::{Material, Mesh, Points, Rule};
use super::system::{Body, System};
use crate::error::{DynamicsError, positive};
use cdpr_cable::{Cable, FromLeavePoint};
use cdpr_robot::{Matrix3, Vector3, Wrench};
use cdpr_statics::vibration::CableAtRest;
use cdpr_statics::{DirectProblem, Equilibrium, Load};
use std::sync::Arc;

/// Elements of each cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Discretization {
    /// Number of elements.
    pub elements: usize,
    /// Degree of the polynomial on each.
    pub degree: usize,
}

impl Discretization {
    /// Few elements of a high degree, for cables that stay taut.
    pub const TAUT: Self = Self { elements: 3, degree: 5 };
    /// A chain of straight elements: where a cable goes slack, its direction jumps along it.
    pub(super) fn chain(elements: usize) -> Self {
        Self { elements, degree: 1 }
    }

    /// The chain with as many points, for cables that go slack; none for one that is a chain.
    pub(super) fn of_slack(self) -> Option<Self> {
        (self.degree > 1).then(|| Self::chain(self.elements * self.degree))
    }

    /// Whether a mesh is this one.
    pub(super) fn is_of(self, mesh: &Mesh) -> bool {
        (self.elements, self.degree) == (mesh.elements(), mesh.rule.degree)
    }

    /// One that is coarser.
    pub(super) fn coarser(self) -> Self {
        let Self { elements, degree } = self;
        if elements > 1 {
            Self { elements: elements - elements.div_ceil(3), degree }
        } else {
            Self { elements, degree: (degree - degree.div_ceil(4)).max(1) }
        }
    }
}

/// How a motion is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// End [s].
    pub until: f64,
    /// Samples for each second [Hz].
    pub rate: f64,
    /// Ratio τ of the viscous to the elastic modulus of the cables [s].
    pub damping: f64,
    /// Elements of each cable. Without, a cable has [`Discretization::TAUT`], or more of them where its
    /// tension at rest needs more, or where fewer move the platform otherwise by more than 0.1 mm. From the
    /// step on in which one goes slack, all are chains of straight elements: 20; 40 or 80 where half as many
    /// move the platform otherwise by more than 0.2 % of its motion and more than 0.3 mm. Chosen elements
    /// become a chain with as many points then.
    pub discretization: Option<Discretization>,
    /// Error of a step that is accepted, as a position [m]; 20 times as much with chains, whose own error is
    /// far greater. Once a cable is slack, steps follow from the fastest motion of the platform.
    pub tolerance: f64,
}

/// Most elements of a cable.
const MOST_ELEMENTS: usize = 128;

impl Settings {
    /// Motion until a time [s] with 100 samples for each second, without damping.
    pub fn until(until: f64) -> Self {
        Self { until, rate: 100.0, damping: 0.0, discretization: None, tolerance: 5e-9 }
    }

    /// Greatest damping [s]: thousands of times that of a cable.
    const MOST_DAMPING: f64 = 1.0;

    /// Greatest number of samples.
    const MOST_SAMPLES: f64 = 1e7;

    pub(super) fn check(&self) -> Result<(), DynamicsError> {
        positive("until", self.until, "a time [s] above zero")?;
        positive("rate", self.rate, "samples for each second [Hz], above zero")?;
        positive("tolerance", self.tolerance, "a length [m] above zero")?;
        let invalid = |field, value: f64, expected: &str| {
            Err(DynamicsError::Invalid { field, value: format!("{value:?}"), expected: expected.to_owned() })
        };
        if !(0.0..=Self::MOST_DAMPING).contains(&self.damping) {
            return invalid("damping", self.damping, "a time [s], 0 to 1");
        }
        if self.until * self.rate > Self::MOST_SAMPLES {
            return invalid("rate", self.rate, "1e7 samples at most, until the end");
        }
        let Some(Discretization { elements, degree }) = self.discretization else { return Ok(()) };
        if !(1..=1000).contains(&elements) {
            return invalid("elements", elements as f64, "1 to 1000 elements of each cable");
        }
        if !(1..=64).contains(&degree) {
            return invalid("degree", degree as f64, "a degree of 1 to 64");
        }
        Ok(())
    }

    /// Platform and cables at a pose with cables in equilibrium, and the unknowns.
    pub(super) fn system<'a>(
        &self,
        problem: &DirectProblem<'a>,
        rest: &Equilibrium,
        Discretization { elements, degree }: Discretization,
    ) -> Result<(System<'a>, Vec<f64>), DynamicsError> {
        let (robot, load) = (problem.robot(), problem.load());
        let small = problem.small_motions(rest)?;
        let rule = Arc::new(Rule::new(degree));
        let pose = &rest.pose;
        let mut free = [false; 6];
        small.free.iter().for_each(|k| free[*k] = true);
        let mut system = System {
            cables: Vec::new(),
            body: body(robot, &load),
            rotation: pose.rotation,
            gravity: robot.gravity.vector(),
            free,
            tolerances: [self.tolerance, self.tolerance / robot.platform_size().max(f64::MIN_POSITIVE)],
            scale: Vec::new(),
        };
        let mut state: Vec<f64> = pose.position.iter().copied().chain([0.0; 3]).collect();
        for (index, at_rest) in small.cables.iter().enumerate() {
            let (cable, own) = self.cable(problem, &rule, (index, at_rest), rest, elements);
            system.cables.push(CableInMotion { first: state.len(), ..cable });
            state.extend(own);
        }
        state.extend(vec![0.0; state.len()]);
        system.rescale();
        Ok((system, state))
    }

    fn cable<'a>(
        &self,
        problem: &DirectProblem<'a>,
        rule: &Arc<Rule>,
        (index, at_rest): (usize, &CableAtRest<'a>),
        rest: &Equilibrium,
        elements: usize,
    ) -> (CableInMotion<'a>, Vec<f64>) {
        let robot = problem.robot();
        let whole = at_rest.catenary;
        let free = whole.free();
        let density = at_rest.linear_density;
        let cable = Cable { guide: None, ..free.cable };
        let mut material = Material { cable, density, damping: self.damping, relaxing: None };
        let end = rest.pose.position + at_rest.lever;
        let lift = |x: f64, z: f64| at_rest.axes * Vector3::new(x, 0.0, z);
        let last = if whole.is_slack_and_weightless() { None } else { Some(free.end_position()) };
        let exit = robot.cables[index].exit_point;
        // A slack cable without weight has no shape: its points are put on the chord.
        let point = |share: f64| match last {
            Some(last) => {
                let behind = free.point(FromLeavePoint(share * free.unstrained_length)) - last;
                end + lift(behind.x, behind.y)
            }
            None => exit + (end - exit) * share,
        };
        let leave = point(0.0);
        let begin = lift(free.force.x, free.exit_vertical_force());
        let tension = begin.norm();
        let direction = if tension > 0.0 { begin / tension } else { (end - leave).normalize() };
        let mut lead = Lead::new(robot, index, &material, (&direction, tension));
        let tension_at = |share: f64| free.tension(FromLeavePoint(share * free.unstrained_length));
        let mesh = (density > 0.0).then(|| {
            let around = lead.as_ref().filter(|_| rule.degree == 1).map_or(0.0, Lead::around);
            let mut mesh = Mesh::beginning(rule, elements, around / free.unstrained_length);
            while rule.degree > 1 && !whole.is_slack_and_weightless() && mesh.ends.len() <= MOST_ELEMENTS {
                let still = Points::still(mesh.shares().iter().map(|share| point(*share)));
                if mesh.is_exact(&material, (free.unstrained_length, &still), tension_at) {
                    break;
                }
                mesh = Mesh::equal(rule, mesh.elements() + elements);
            }
            mesh
        });
        let mut own = Vec::new();
        if let Some(mesh) = &mesh {
            material.damping = material.damping.max(material.damping_of_shocks(mesh, free.unstrained_length));
            let shares = mesh.shares();
            if mesh.rule.degree > 1 {
                lead = lead.map(|lead| lead.bent(&direction, &point(shares[1])));
            }
            own.resize(lead.map_or(0, |lead| 1 + usize::from(lead.swivels())), 0.0);
            own.extend(shares[1..shares.len() - 1].iter().flat_map(|share| <[f64; 3]>::from(point(*share))));
        }
        let cable = CableInMotion {
            index,
            material,
            anchor: robot.cables[index].anchor_point,
            start: lead.map_or(Start::Fixed(exit), |lead| Start::Led(Box::new(lead))),
            length: if mesh.is_some() { free.unstrained_length } else { whole.unstrained_length },
            mesh,
            least_tension: tension_at(free.lowest_arc_length().0 / free.unstrained_length),
            reeling: Vec::new(),
            first: 0,
        };
        (cable, own)
    }
}

impl System<'_> {
    /// Errors of the unknowns and of their velocities that are accepted.
    pub(super) fn rescale(&mut self) {
        /// Angular frequency of the motions whose velocities count as much as their positions [1/s].
        const FREQUENCY: f64 = 300.0;
        /// By how much more all may err with chains of straight elements, whose own error is far greater.
        const SLACK: f64 = 20.0;
        /// By how much more the chains themselves may err: what their waves do to the platform averages out.
        const CHAIN: f64 = 10.0;
        /// By how much more undamped motions may err: those by Gauss' method err far less than its estimate.
        const GAUSS: f64 = 2.0;
        let has_chain = self.cables.iter().any(CableInMotion::is_chain);
        let more = if has_chain {
            SLACK
        } else if self.is_damped() {
            1.0
        } else {
            GAUSS
        };
        let [position, rotation] = self.tolerances.map(|error| more * error);
        let mut scale = [[position; 3], [rotation; 3]].concat();
        for cable in &self.cables {
            let own = if cable.is_chain() { CHAIN * position } else { position };
            scale.resize(scale.len() + cable.size(), own);
        }
        let velocities: Vec<f64> = scale.iter().map(|value| FREQUENCY * value).collect();
        self.scale = [scale, velocities].concat();
    }
}

fn body(robot: &cdpr_robot::Robot, load: &Load) -> Body {
    let platform = &robot.platform;
    Body {
        mass: platform.mass + load.payload,
        center: platform.center_of_mass,
        inertia: platform.inertia.unwrap_or_else(Matrix3::zeros),
        load: load.wrench,
        event: Wrench::none(),
        control: Wrench::none(),
    }
}
