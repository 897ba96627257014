//! The data of the methods of sensitivity analysis, and what they find.

use crate::analysis::measures::{GroupMeasures, InputMeasures, SubspaceSummary};
use crate::analysis::verdict::recommendation::Candidate;
use crate::error::StudyError;
use crate::file::sensitivity_spec::SensitivitySpec;
use crate::file::study_file::StudyFile;
use crate::model::designs::{Design, Points};
use crate::model::observed::Measured;
use crate::model::study::Sampling;
use crate::observe::observation::{Session, Tally, Task, observe_quantities};
use cdpr_sensitivity::{Bootstrap, Input, SampleDesign, SensitivityError, Slopes, SobolDesign};
use cdpr_statics::StaticsError;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::sync::OnceLock;

/// The observations on which a method rests, and how well it explains the output.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MethodSummary {
    /// Observations made, failed ones included; each with its derivatives for `derivatives` and `dgsm`.
    pub observations: usize,
    /// Those that failed.
    pub failed: usize,
    /// Saltelli's blocks with a failed observation. It is missed by the indices of one input only, unless it
    /// is one of the two points on which all inputs of a block rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub failed_blocks: Option<usize>,
    /// Whether all intervals have their confidence: those of Sobol' indices have from 64 blocks on, those of
    /// Morris's means where these rest on enough effects.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reliable: Option<bool>,
    /// Share of the variance that a linear model explains.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub r_squared: Option<f64>,
    /// Share of the variance that the expansion does not predict: its corrected leave-one-out error.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leave_one_out: Option<f64>,
    /// Whether derivatives took part in an expansion that may be fitted to them: they are left out where the
    /// values alone predict the output better.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub derivatives: Option<bool>,
    /// Wall time [s]; not in files, which are the same from run to run.
    #[serde(skip)]
    pub seconds: f64,
}

impl MethodSummary {
    pub(super) fn of<T>(outputs: &[Option<T>]) -> Self {
        let failed = outputs.iter().filter(|output| output.is_none()).count();
        Self { observations: outputs.len(), failed, ..Self::default() }
    }
}

/// What the methods have found.
pub(crate) struct Found {
    pub(crate) inputs: Vec<InputMeasures>,
    pub(crate) groups: Vec<GroupMeasures>,
    pub(crate) subspace: Option<SubspaceSummary>,
    /// What may be recommended.
    pub(crate) candidates: Vec<Candidate>,
}

/// The data of a method.
pub(crate) struct Run<'a> {
    pub(crate) sampling: &'a Sampling<'a>,
    pub(crate) spec: &'a SensitivitySpec,
    pub(super) settings: &'a StudyFile,
    tally: &'a Tally,
    session: &'a Session<'a>,
    /// Outputs and derivatives at the points of [`Run::sloped`], computed once.
    slopes: OnceLock<Vec<Option<Slopes>>>,
}

impl Found {
    pub(crate) fn new(sampling: &Sampling) -> Self {
        let names: Vec<_> = sampling.design.inputs().iter().map(|input| input.name.clone()).collect();
        let group = |group: &cdpr_sensitivity::Group| GroupMeasures {
            group: group.name.clone(),
            inputs: group.inputs.iter().map(|&i| names[i].clone()).collect(),
            ..GroupMeasures::default()
        };
        let groups = sampling.groups.iter().map(group).collect();
        let named = |name: &String| InputMeasures { input: name.clone(), ..InputMeasures::default() };
        Self { inputs: names.iter().map(named).collect(), groups, subspace: None, candidates: Vec::new() }
    }
}

/// Robots whose derivatives are taken in one call.
const SLOPES_TOGETHER: usize = 64;

impl<'a> Run<'a> {
    pub(crate) fn new(
        sampling: &'a Sampling<'a>,
        spec: &'a SensitivitySpec,
        tally: &'a Tally,
        session: &'a Session<'a>,
    ) -> Self {
        let settings = &sampling.study.file;
        Self { sampling, spec, settings, tally, session, slopes: OnceLock::new() }
    }

    pub(super) fn inputs(&self) -> &[Input] {
        self.sampling.design.inputs()
    }

    pub(super) fn observe(&self, of: Design, design: &dyn Points) -> Result<Vec<Option<f64>>, StudyError> {
        let measured = self.observe_quantities(of, design)?;
        Ok(measured.iter().map(|of| of.as_ref().map(Measured::value)).collect())
    }

    pub(super) fn observe_quantities(
        &self,
        of: Design,
        design: &dyn Points,
    ) -> Result<Vec<Option<Measured>>, StudyError> {
        let task = Task { name: &of.name(), points: design, recorded: of.recorded() };
        observe_quantities(self.sampling, task, self.session)
    }

    pub(super) fn bootstrap(&self) -> Bootstrap {
        Bootstrap { resamples: self.spec.bootstrap_resamples, seed: self.settings.seed }
    }

    /// The sampling's first observations.
    pub(super) fn first(&self) -> Result<(SobolDesign, Vec<Option<f64>>), SensitivityError> {
        let whole = &self.sampling.design;
        let points = whole.points().min(self.spec.observations);
        let design = SobolDesign::new(whole.inputs().to_vec(), whole.first_index(), points)?;
        Ok((design, self.tally.first_values.iter().copied().take(points).collect()))
    }

    /// Points at which derivatives are taken, and what was found there.
    pub(super) fn sloped(&self) -> Result<(SobolDesign, &[Option<Slopes>]), SensitivityError> {
        let points = self.spec.derivative_points;
        let design = SobolDesign::scrambled(self.inputs().to_vec(), points, self.settings.seed)?;
        if let Some(slopes) = self.slopes.get() {
            return Ok((design, slopes));
        }
        let inputs = self.inputs().len();
        let together = |first: usize| {
            let mut rows = vec![0.0; inputs * SLOPES_TOGETHER.min(points - first)];
            for (index, row) in rows.chunks_mut(inputs).enumerate() {
                design.row(first + index, row)?;
            }
            (self.session.tick)(rows.len() / inputs);
            Ok(self.slopes(&rows).into_iter().map(Result::ok).collect())
        };
        let found = (0..points).into_par_iter().step_by(SLOPES_TOGETHER).map(together);
        let found: Vec<_> = found.collect::<Result<Vec<Vec<_>>, SensitivityError>>()?.concat();
        Ok((design, self.slopes.get_or_init(|| found)))
    }

    /// Outputs of the robots with these deviations of the inputs, and their derivatives per unit of the
    /// input.
    pub(super) fn slopes(&self, rows: &[f64]) -> Vec<Result<Slopes, StaticsError>> {
        let Sampling { errors, observer, .. } = self.sampling;
        let found = observer.slopes(errors, rows).into_iter();
        found.map(|found| found.map(|(output, gradient)| Slopes { output, gradient })).collect()
    }
}
