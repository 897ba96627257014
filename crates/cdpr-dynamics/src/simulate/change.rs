//! What events change, and the rest of the discrete cables from which a motion begins.

use super::cable::Start;
use super::event::{Change, CutAt, Event};
use super::radau::{Equations, Linearization};
use super::system::System;
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
        let mut best = greatest(&self.slopes(0.0, state));
        let mut found = (state.clone(), self.rotation);
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = Some(cable.least_tension));
        for step in 0..MOST_STEPS {
            let slopes = self.slopes(0.0, state);
            let residual = greatest(&slopes);
            if residual < best {
                best = residual;
                found = (state.clone(), self.rotation);
            } else if step > LEAST_STEPS {
                break;
            }
            let matrices = self.linearize(0.0, state);
            let Some(factors) = matrices.factor(SHIFT) else { break };
            let mut right = slopes;
            right[..n].fill(0.0);
            let step = matrices.solve(&factors, &right);
            state.iter_mut().zip(&step[..n]).for_each(|(value, step)| *value += step);
            self.turn(state);
        }
        (*state, self.rotation) = found;
        self.free = free;
        self.cables.iter_mut().for_each(|cable| cable.material.relaxing = None);
        greatest(&self.slopes(0.0, state))
    }

    /// After the platform was displaced: the leads are those of the rest, and their ends are where they fit
    /// the tension.
    pub(super) fn keep_leads(&mut self, rest: &Self, state: &mut [f64]) {
        for (cable, before) in self.cables.iter_mut().zip(&rest.cables) {
            if let (Start::Led(lead), Start::Led(now)) = (before.start, cable.start) {
                cable.length = before.length;
                cable.start = Start::Led(lead);
                if cable.mesh.is_some() {
                    state[cable.first] = lead.longer_for(&now);
                }
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
        let is_gone = at == CutAt::Anchor || self.cables[place].mesh.is_none();
        let before = self.cables.clone();
        let n = self.size();
        let begin = self.beginning(time, state, place);
        if is_gone {
            self.cables.remove(place);
        } else {
            let cable = &mut self.cables[place];
            cable.length = cable.length_at(time).0;
            cable.reeling.clear();
            cable.start = Start::Loose;
        }
        let (old, scale) = (state.clone(), self.scale.clone());
        let parts = [&old[..n], &old[n..]];
        let mut halves = parts.map(|half| half[..6].to_vec());
        let mut scales = [scale[..6].to_vec(), scale[n..n + 6].to_vec()];
        for cable in &mut self.cables {
            let Some(was) = before.iter().find(|was| was.index == cable.index) else { continue };
            cable.first = halves[0].len();
            let range = was.first..was.first + was.size(&self.rule);
            for k in 0..2 {
                let own = &parts[k][range.clone()];
                let more = cable.size(&self.rule) + usize::from(matches!(was.start, Start::Led(_)));
                if more > own.len()
                    && matches!(cable.start, Start::Loose)
                    && !matches!(was.start, Start::Loose)
                {
                    halves[k].extend(begin[k].iter());
                    halves[k].extend(&own[usize::from(matches!(was.start, Start::Led(_)))..]);
                } else {
                    halves[k].extend(own);
                }
                let usual = if k == 0 { scale[n - 1] } else { scale[2 * n - 1] };
                let size = halves[k].len();
                scales[k].resize(size, usual);
            }
        }
        *state = halves.concat();
        self.scale = scales.concat();
    }
}
