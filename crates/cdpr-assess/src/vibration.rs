//! How much robots swing after a move, where each differs from the one that the move was planned for.
//!
//! Robots are drawn from an error model. As in studies each has the lengths with which it holds a pose
//! itself, with the offsets of its tensions; shaper and feed-forward are those of the nominal robot. The load
//! is the nominal one.

use crate::error::AssessError;
use cdpr_dynamics::DynamicsError;
use cdpr_dynamics::moves::{Residual, SetPoint, residual};
use cdpr_dynamics::simulate::Settings;
use cdpr_robot::Robot;
use cdpr_sensitivity::{RandomDesign, SampleDesign};
use cdpr_statics::Load;
use cdpr_study::{ErrorModel, StudyError};
use rayon::prelude::*;

/// Robots drawn from an error model.
#[derive(Clone, Copy, Debug)]
pub struct DrawnRobots<'a> {
    /// The robot that moves are planned for.
    pub nominal: &'a Robot,
    /// What is uncertain.
    pub model: &'a ErrorModel,
    /// How many are drawn.
    pub count: usize,
    /// Seed of the draw.
    pub seed: u64,
}

/// What one robot leaves after two moves.
pub type Compared = Result<[Residual; 2], DynamicsError>;

impl DrawnRobots<'_> {
    /// What each robot leaves after two moves, such as one without a shaper and one with it. `tick` is called
    /// after each robot. A robot that cannot be followed is a result.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for an error model of another robot and for no robots.
    pub fn compare(
        &self,
        load: &Load,
        moves: [&[SetPoint]; 2],
        settings: &Settings,
        tick: &(dyn Fn() + Sync),
    ) -> Result<Vec<Compared>, AssessError> {
        self.model.check(self.nominal)?;
        let inputs = self.model.inputs.clone();
        let design = RandomDesign::new(inputs, self.count, self.seed)
            .map_err(|error| StudyError::setting("robots", self.count.to_string(), error.to_string()))?;
        let one = |index: usize| {
            let mut row = vec![0.0; self.model.inputs.len()];
            // The index is below the number of points and the row as long as the inputs.
            let drawn = design.row(index, &mut row);
            debug_assert_eq!(drawn, Ok(()));
            let deviations = self.model.deviations(&row);
            let found = self.nominal.perturbed(deviations.values())?;
            let after =
                |points: &[SetPoint]| residual(&found.robot, load, points, &found.tension_offsets, settings);
            let compared = Ok([after(moves[0])?, after(moves[1])?]);
            tick();
            compared
        };
        Ok((0..self.count).into_par_iter().map(one).collect())
    }
}

/// The greatest of the ratios of the second to the first amplitude that the best `count` robots leave;
/// infinite where fewer than that could be followed. `None` for no robots.
pub fn ratio_of_best(compared: &[Compared], count: usize) -> Option<f64> {
    let ratio = |one: &Compared| match one {
        Ok([first, second]) if first.amplitude > 0.0 => second.amplitude / first.amplitude,
        _ => f64::INFINITY,
    };
    let mut ratios: Vec<f64> = compared.iter().map(ratio).collect();
    ratios.sort_by(f64::total_cmp);
    ratios.get(count.checked_sub(1)?).copied()
}
