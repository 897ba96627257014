//! The integration along a cable in wind: steps that are short only where the drag bends.

use super::{CableInWind, Given, State, WindOverHeight};
use crate::error::CableError;
use crate::kernel::Material;
use cdpr_number::vector::dot;
use cdpr_number::{Lanewise, Real};
use nalgebra::Vector3;

/// Most steps of an integration.
const MOST_STEPS: usize = 1024;

/// Shortest step, as a share of the cable.
const SHORTEST_STEP: f64 = 1e-9;

/// Substeps of a step, of each of the midpoint rules that are extrapolated.
const SUBSTEPS: [usize; 6] = [2, 4, 6, 8, 10, 12];

impl CableInWind<'_> {
    /// Steps of the integration from a force at the leave point on, as shares of the cable: each is halved
    /// until half of it changes the end by less than the accuracy, as if the error were of its fourth power.
    pub(super) fn steps(
        &self,
        force: Vector3<f64>,
        least: usize,
        accuracy: f64,
    ) -> Result<Vec<f64>, CableError> {
        let given = Given { force: force.into(), ..self.given::<f64>() };
        let (tension, longest) = (force.norm(), 1.0 / least as f64);
        let free = self.free_length(tension);
        let (mut steps, mut state) = (Vec::new(), [[0.0; 3], given.force]);
        let (mut at, mut step) = (0.0, longest);
        while at < 1.0 {
            let whole = self.stepped(&given, &state, free * step);
            let half = self.stepped(&given, &state, free * step * 0.5);
            let halves = self.stepped(&given, &half, free * step * 0.5);
            let apart = |of: usize| (Vector3::from(halves[of]) - Vector3::from(whole[of])).norm() / 15.0;
            // A force that is off turns the rest of the cable.
            let error = apart(0) + apart(1) * free * (1.0 - at) / tension;
            if error <= 0.25 * accuracy * self.unstrained_length {
                (at, state) = (at + step, halves);
                steps.push(step);
                while step < longest && at % (2.0 * step) == 0.0 {
                    step *= 2.0;
                }
            } else {
                step *= 0.5;
            }
            if steps.len() > MOST_STEPS || step < SHORTEST_STEP {
                return Err(CableError::NotConverged { iterations: steps.len(), residual: error });
            }
        }
        Ok(steps)
    }

    /// The end of the cable, (C40), with steps of a part of these.
    pub(super) fn integrated<T: Real>(&self, given: &Given<T>, steps: &[f64], parts: usize) -> State<T> {
        let tension = dot(&given.force, &given.force).sqrt();
        let free = given.length - given.guided / self.material(given).stretch(tension)[0];
        let mut state = [[T::of(0.0); 3], given.force];
        for step in steps {
            for _ in 0..parts {
                state = self.stepped(given, &state, free * (step / parts as f64));
            }
        }
        state
    }

    /// A step: midpoint rules with more and more substeps, extrapolated by the scheme of Aitken and Neville.
    fn stepped<T: Real>(&self, given: &Given<T>, state: &State<T>, step: T) -> State<T> {
        let first = self.slope(given, state);
        let mut row = [*state; SUBSTEPS.len()];
        for (j, count) in SUBSTEPS.into_iter().enumerate() {
            let mut above =
                std::mem::replace(&mut row[0], self.midpoint(given, (state, &first), step, count));
            for k in 1..=j {
                let ratio = count as f64 / SUBSTEPS[j - k] as f64;
                let (left, weight) = (row[k - 1], 1.0 / (ratio * ratio - 1.0));
                let next =
                    [0, 1].map(|of| [0, 1, 2].map(|i| left[of][i] + (left[of][i] - above[of][i]) * weight));
                above = std::mem::replace(&mut row[k], next);
            }
        }
        row[SUBSTEPS.len() - 1]
    }

    /// Gragg's modified midpoint rule with an even number of substeps, from a state with its slope.
    fn midpoint<T: Real>(
        &self,
        given: &Given<T>,
        (state, slope): (&State<T>, &State<T>),
        step: T,
        count: usize,
    ) -> State<T> {
        let short = step * (1.0 / count as f64);
        let (mut before, mut here) = (*state, moved(state, slope, short));
        for _ in 1..count {
            let next = moved(&before, &self.slope(given, &here), short * 2.0);
            before = std::mem::replace(&mut here, next);
        }
        let last = self.slope(given, &here);
        [0, 1].map(|of| [0, 1, 2].map(|k| (here[of][k] + before[of][k] + last[of][k] * short) * 0.5))
    }

    /// dr/ds and dn/ds, (C39) and (C40).
    fn slope<T: Real>(&self, given: &Given<T>, [r, force]: &State<T>) -> State<T> {
        let tension = dot(force, force).sqrt();
        let per_tension = tension.recip();
        let stretch = self.material(given).stretch(tension)[0];
        let t = force.map(|component| component * per_tension);
        let share = self.profile.map_or(T::of(1.0), |profile| profile.share(given.height + r[2]));
        let velocity = [0, 1, 2].map(|k| share * self.velocity[k]);
        let along = dot(&velocity, &t);
        let across = [0, 1, 2].map(|k| velocity[k] - along * t[k]);
        // The root has no derivative at zero.
        let speed = (dot(&across, &across) + f64::MIN_POSITIVE).sqrt();
        let drag = stretch * speed * given.drag;
        [t.map(|component| stretch * component), [0, 1, 2].map(|k| -(across[k] * drag) - given.weight[k])]
    }

    pub(super) fn material<T: Lanewise + Real>(&self, given: &Given<T>) -> Material<'_, T> {
        let weight_per_length = T::of(self.cable.weight_per_length);
        let axial_flexibility = given.axial_flexibility;
        Material { law: self.cable.law.terms(), weight_per_length, axial_flexibility }
    }
}

impl WindOverHeight {
    /// The velocity at a height [m] over that at the reference height, (C41).
    fn share<T: Real>(&self, height: T) -> T {
        if height.value() <= 0.0 {
            return T::of(0.0);
        }
        let per_reference = (self.reference / self.roughness).ln_1p().recip();
        let above = height * (1.0 / self.roughness) + 1.0;
        // ln x = ln a + x/a - 1 to first order, exact in value and derivative at a = x.
        let near = above.value();
        (above * (1.0 / near) + (near.ln() - 1.0)) * per_reference
    }
}

fn moved<T: Real>(state: &State<T>, slope: &State<T>, by: T) -> State<T> {
    [0, 1].map(|of| [0, 1, 2].map(|k| state[of][k] + slope[of][k] * by))
}
