//! What events change, and the rest of the discrete cables from which a motion begins.

use super::cable::Start;
use super::collocation::{Equations, Linearization};
use super::event::{Change, CutAt, Event};
use super::setting::Discretization;
use super::system::{Snapshot, System};
use cdpr_robot::Wrench;

impl System<'_> {
    /// Newton's method for the rest of the discrete cables, with the platform free or held; the greatest
    /// acceleration that is left [m/s²].
    pub(super) fn relax(&mut self, state: &mut Vec<f64>, is_free: bool) -> f64 {
        const LEAST_STEPS: usize = 5;
        const MOST_STEPS: usize = 30;
        /// Angular frequency that keeps the matrix regular [1/s].
        const SHIFT: f64 = 1e-3;
        let n = self.size();
        let free = self.free;
        if !is_free {
            self.free = [false; 6];
        }
        let greatest =
            |slopes: &[f64]| slopes[n..].iter().fold(0.0, |most: f64, value| most.max(value.abs()));
        let (mut snapshot, mut slopes) = (Snapshot::default(), vec![0.0; 2 * n]);
        self.slopes(0.0, state, &mut snapshot, &mut slopes);
        let mut best = greatest(&slopes);
        let mut found = (state.clone(), self.rotation);
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = Some(cable.least_tension));
        for step in 0..MOST_STEPS {
            self.slopes(0.0, state, &mut snapshot, &mut slopes);
            let residual = greatest(&slopes);
            if residual < best {
                best = residual;
                found = (state.clone(), self.rotation);
            } else if step > LEAST_STEPS {
                break;
            }
            let matrices = self.linearize(0.0, state);
            let Some(factors) = matrices.factor(SHIFT) else { break };
            let mut right = slopes.clone();
            right[..n].fill(0.0);
            let step = matrices.solve(&factors, &right);
            state.iter_mut().zip(&step[..n]).for_each(|(value, step)| *value += step);
            self.turn(state);
        }
        (*state, self.rotation) = found;
        self.free = free;
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = None);
        self.slopes(0.0, state, &mut snapshot, &mut slopes);
        greatest(&slopes)
    }

    /// After the platform was displaced: the leads are those of the rest, and their ends are where they fit
    /// the tension.
    pub(super) fn keep_leads(&mut self, rest: &Self, state: &mut [f64]) {
        for (cable, before) in self.cables.iter_mut().zip(&rest.cables) {
            if let (Start::Led(lead), Start::Led(now)) = (before.start.clone(), cable.start.clone()) {
                cable.length = before.length;
                if cable.mesh.is_some() {
                    state[cable.first] = lead.longer_for(&now);
                }
                if cable.of_start() > 1 {
                    state[cable.first + 1] = lead.swivelled_for(&now);
                }
                cable.start = Start::Led(lead);
            }
        }
    }

    /// Applies a change; the unknowns follow.
    pub(super) fn change(&mut self, event: &Event, state: &mut Vec<f64>) {
        let from = event.time;
        match &event.change {
            Change::Displace(_) => {}
            Change::Payload(payload) => self.body.mass += payload,
            Change::Wrench { force, moment } => self.body.event = Wrench { force: *force, moment: *moment },
            Change::Shorten { .. } | Change::Lengths(_) => {
                for one in &mut self.cables {
                    one.reeling.extend(event.reeling(one.index));
                }
            }
            Change::Cut { cable, at } => self.cut(*cable, *at, from, state),
        }
    }

    fn cut(&mut self, index: usize, at: CutAt, time: f64, state: &mut Vec<f64>) {
        let Some(place) = self.cables.iter().position(|cable| cable.index == index) else { return };
        let mut parts = self.parts(state);
        if at == CutAt::Anchor || self.cables[place].mesh.is_none() {
            self.cables.remove(place);
            parts.remove(place);
        } else {
            let points = self.instant(time, state, &self.cables[place]).points;
            let cable = &mut self.cables[place];
            cable.length = cable.length_at(time).0;
            cable.reeling.clear();
            // Its first point has three unknowns, where a lead has one or two, and a fixed point none.
            let of_lead = cable.of_start();
            if !matches!(cable.start, Start::Loose) {
                let [own, rates] = &mut parts[place];
                own.splice(..of_lead, points.positions[0].iter().copied());
                rates.splice(..of_lead, points.velocities[0].iter().copied());
            }
            cable.start = Start::Loose;
        }
        self.assemble(parts, state);
    }

    /// Whether all cables are on these elements, and those that went slack are damped.
    pub(super) fn is_refined(&self, elements: Discretization, slack: &[bool]) -> bool {
        self.cables.iter().all(|cable| {
            let Some(mesh) = &cable.mesh else { return true };
            let is_damped = cable.material.damping >= cable.material.damping_of_shocks(mesh, cable.length);
            elements.is_of(mesh) && (is_damped || !slack[cable.index])
        })
    }

    /// Puts all cables on other elements, and damps the shocks of those that went slack.
    pub(super) fn refine(
        &mut self,
        time: f64,
        elements: Discretization,
        slack: &[bool],
        state: &mut Vec<f64>,
    ) {
        let mut parts = self.parts(state);
        for (place, part) in parts.iter_mut().enumerate() {
            let cable = &self.cables[place];
            let Some(mut mesh) = cable.mesh.clone() else { continue };
            if !elements.is_of(&mesh) {
                mesh = cable.chain(elements.elements);
                *part = cable.on(&mesh, &self.instant(time, state, cable), self.own(cable, state));
            }
            let cable = &mut self.cables[place];
            if slack[cable.index] {
                let least = cable.material.damping_of_shocks(&mesh, cable.length);
                cable.material.damping = cable.material.damping.max(least);
            }
            if let Start::Led(lead) = &mut cable.start {
                **lead = lead.straight();
            }
            cable.mesh = Some(mesh);
        }
        self.assemble(parts, state);
    }

    /// Unknowns of each cable and their rates.
    fn parts(&self, state: &[f64]) -> Vec<[Vec<f64>; 2]> {
        self.cables.iter().map(|cable| self.own(cable, state).map(<[f64]>::to_vec)).collect()
    }

    /// The state with other unknowns of the cables.
    fn assemble(&mut self, parts: Vec<[Vec<f64>; 2]>, state: &mut Vec<f64>) {
        let (positions, velocities) = state.split_at(state.len() / 2);
        let mut halves = [positions, velocities].map(|half| half[..6].to_vec());
        for (cable, part) in self.cables.iter_mut().zip(parts) {
            cable.first = halves[0].len();
            halves.iter_mut().zip(part).for_each(|(half, part)| half.extend(part));
        }
        *state = halves.concat();
        self.rescale();
    }
}
