//! Observations with the derivatives of |dp| by all parameters.

use super::{Batch, InRows, Observation, Observed, Observer, Wanted, read};
use crate::derivatives::{Derivatives, derivatives, derivatives_from};
use crate::error::StaticsError;
use crate::lanes::adjoint::{Adjoint, GuideSlopes, Record, adjoint};
use crate::lanes::chain::observe;
use crate::lanes::level::LevelFrame;
use crate::lanes::observer::rows::{Axes, Rows};
use crate::lanes::reason::ScalarReason;
use crate::local::platform::Robots;
use crate::state::WantedPose;
use cdpr_number::Number;
use cdpr_number::lanes::{Lanes, MAX_LANES, Mask, Simd, WithSimd, dispatch};
use cdpr_number::three;
use cdpr_number::vector::dot;
use cdpr_robot::{Axis, Parameter, Perturbed, Robot, RobotCable, TiltAxis};

/// The deflection of one perturbed robot, with the derivatives of its length.
#[derive(Clone, Debug, PartialEq)]
pub struct ObservationSlopes {
    /// The deflection. [`Observation::scalar`] says why its derivatives were left to the scalar models.
    pub observation: Observation,
    /// d|dp| by every parameter in the order of [`Parameter::of`] [m per unit], as
    /// [`Derivatives::magnitude`]; left derivatives where the scalar models found them.
    pub magnitude: Vec<f64>,
}

impl Observed for ObservationSlopes {
    fn in_lanes(batch: Batch) -> Vec<Result<Self, ScalarReason>> {
        dispatch(SlopesBatch(batch))
    }

    fn by_scalar_models(
        observer: &Observer,
        deviations: &[f64],
        why: ScalarReason,
    ) -> Result<Self, StaticsError> {
        let Observer { robot, pose, load, layout, wanted, .. } = observer;
        let Perturbed { robot, tension_offsets } = &robot.perturbed(deviations)?;
        let wanted_pose = WantedPose::at(pose).tension_offsets(tension_offsets);
        let found = match wanted {
            Wanted::Pose(Some(branch)) => {
                derivatives_from(robot, wanted_pose, load, branch.nearby(robot, pose)?)?
            }
            Wanted::Pose(None) => derivatives(robot, wanted_pose, load)?,
            Wanted::Rest(branch) => derivatives(robot, wanted_pose.free(branch.coordinates()), load)?,
        };
        let magnitude = found.magnitude()?.into_iter().take(layout.count()).collect();
        let Derivatives { deflection, .. } = found;
        Ok(Self { observation: Observation::of(&deflection, why), magnitude })
    }
}

/// Rows of deviations for the lanes, whose derivatives are asked for.
struct SlopesBatch<'a>(Batch<'a>);

impl WithSimd for SlopesBatch<'_> {
    type Output = Vec<Result<ObservationSlopes, ScalarReason>>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let Batch { observer: Observer { robot, pose, load, layout, nominal, .. }, deviations } = self.0;
        let parameters = layout.count();
        let nominal = match nominal {
            Ok(nominal) => nominal,
            Err(why) => return vec![Err(*why); deviations.len() / parameters],
        };
        if nominal.is_tilted || !nominal.free.is_empty() {
            return vec![Err(ScalarReason::Derivatives); deviations.len() / parameters];
        }
        let mut found = Vec::with_capacity(deviations.len() / parameters);
        let mut slopes = vec![[0.0; MAX_LANES]; parameters];
        for rows in deviations.chunks(Lanes::<S>::COUNT * parameters) {
            let count = rows.len() / parameters;
            let rows = Rows::new(simd, rows, layout);
            let (mut start, level, valid) = rows.robots(robot, pose, load, nominal, Axes::Vertical);
            start.robots.frame.extend(rows.frame(pose, level.as_ref()));
            let payload = start.payload.clone();
            let rolling = rows.rolling(robot, &start.robots);
            let offsets = start.offsets.clone();
            let (outcome, trace) = observe(&mut start, &nominal.shared, true);
            let record = Record { offsets, multipliers: start.multipliers, trace };
            let adjoint = adjoint(&record, &outcome.displacement, &payload, &nominal.shared);
            let mut decided = [false; MAX_LANES];
            if let Some(adjoint) = &adjoint {
                decided = (adjoint.decided & rolling).to_array();
                rows.write_slopes(robot, adjoint, level.as_ref(), &mut slopes);
            }
            let observed = read(&outcome, &InRows { level: level.as_ref(), valid, nominal });
            for (lane, observed) in observed.into_iter().enumerate().take(count) {
                found.push(match observed {
                    Ok(_) if !decided[lane] => Err(ScalarReason::Derivatives),
                    Ok(observation) => {
                        let magnitude = slopes.iter().map(|slope| slope[lane]).collect();
                        Ok(ObservationSlopes { observation, magnitude })
                    }
                    Err(why) => Err(why),
                });
            }
        }
        found
    }
}

impl<S: Simd> Rows<'_, S> {
    /// The lanes whose pulleys have radii: that of a pulley without one has a derivative on one side alone.
    #[inline(always)]
    pub(crate) fn rolling(&self, robot: &Robot, robots: &Robots<'_, S>) -> Mask<S> {
        let zero = self.all(0.0);
        let mut rolling = zero.less_or_equal(zero);
        for (cable, in_lanes) in robot.cables.iter().zip(&robots.cables) {
            if let (Some(_), Some(guided)) = (&cable.pulley, &in_lanes.guided) {
                rolling = rolling & !guided.fixed();
            }
        }
        rolling
    }

    /// Writes the slopes by all parameters from those by what the robots are in their level frames.
    #[inline(always)]
    pub(crate) fn write_slopes(
        &self,
        robot: &Robot,
        adjoint: &Adjoint<S>,
        level: Option<&LevelFrame<S>>,
        slopes: &mut [[f64; MAX_LANES]],
    ) {
        let layout = self.layout;
        let directed = layout.index(Parameter::Gravity(Axis::X));
        let gravity = match directed {
            None => self.all(robot.gravity.magnitude()),
            Some(first) => {
                let vector = self.point(first, &robot.gravity.vector());
                dot(&vector, &vector).sqrt()
            }
        };
        let zero = self.all(0.0);
        let (mut by_density, mut by_modulus, mut hanging) = (zero, zero, zero);
        let mut point = |first: usize, of: &[Lanes<S>; 3]| {
            for (slope, of) in slopes[first..].iter_mut().zip(of) {
                *slope = of.to_array();
            }
        };
        for (i, (cable, of)) in robot.cables.iter().zip(&adjoint.cables).enumerate() {
            let density = self.parameter(layout.linear_density(), cable.properties.linear_density);
            let modulus = self.parameter(layout.youngs_modulus(), cable.properties.youngs_modulus);
            by_density += of.weight * gravity;
            hanging += of.weight * density;
            by_modulus -= of.flexibility / (modulus * modulus * cable.properties.section);
            point(layout.anchor_point(i), &of.anchor);
            let exit = match level {
                None => of.exit,
                Some(level) => level.to_base(&of.exit),
            };
            point(layout.exit_point(i), &exit);
        }
        point(layout.center_of_mass(), &adjoint.center);
        if let (Some(first), Some(level)) = (directed, level) {
            // -(τ x u)/g by the direction u, and -u by the magnitude.
            let [x, y, _] = adjoint.turn;
            let turned = [-y, x, -(hanging * gravity)];
            let whole = three!(|k| (turned[k] + adjoint.heavier[k]) / gravity);
            point(first, &level.to_base(&whole));
        }
        for (i, of) in adjoint.cables.iter().enumerate() {
            slopes[layout.tension_offset(i)] = of.offset.to_array();
        }
        for (i, (cable, of)) in robot.cables.iter().zip(&adjoint.cables).enumerate() {
            if cable.pulley.is_some() || cable.lead != 0.0 {
                self.write_guide(i, cable, &of.guide, level, slopes);
            }
        }
        slopes[layout.mass()] = (adjoint.weight * gravity).to_array();
        slopes[layout.linear_density()] = by_density.to_array();
        slopes[layout.youngs_modulus()] = by_modulus.to_array();
    }
    /// Writes the slopes by the guide of cable `i`.
    fn write_guide(
        &self,
        i: usize,
        cable: &RobotCable,
        of: &GuideSlopes<S>,
        level: Option<&LevelFrame<S>>,
        slopes: &mut [[f64; MAX_LANES]],
    ) {
        let mut write = |parameter: Parameter, slope: Lanes<S>| {
            if let Some(index) = self.layout.index(parameter) {
                slopes[index] = slope.to_array();
            }
        };
        write(Parameter::Lead(i), of.lead);
        write(Parameter::PulleyRadius(i), of.radius);
        let Some(pulley) = &cable.pulley else { return };
        let axis = match level {
            None => of.axis,
            Some(level) => level.to_base(&of.axis),
        };
        for about in TiltAxis::ALL {
            let turned = about.of(pulley).cross(&pulley.axis.normalize());
            write(Parameter::Tilt(i, about), dot(&axis, &three!(|k| self.all(turned[k]))));
        }
    }
}
