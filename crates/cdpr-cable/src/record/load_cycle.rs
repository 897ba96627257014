//! A cycle of loading and unloading, its elongations and the energy that it dissipates.

use crate::record::sample::{Phase, RecordError, Sample};

/// A record of one loop: loading up to a turning point, then unloading from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    loading: Vec<Sample>,
    /// Starts with the turning point.
    unloading: Vec<Sample>,
}

impl Record {
    /// A record from its samples in the order of the test: loading first, then unloading.
    ///
    /// In both phases force and elongation change in one direction only, and unloading starts at or below the
    /// end of loading.
    ///
    /// # Errors
    /// [`RecordError::Invalid`] names the line; [`RecordError::TooShort`] a phase with fewer than two
    /// samples.
    pub fn new(samples: &[Sample]) -> Result<Self, RecordError> {
        for sample in samples {
            let fields = [("force_n", sample.force), ("elongation_mm", 1e3 * sample.elongation)];
            for (field, value) in fields {
                if !value.is_finite() {
                    return Err(sample.invalid(field, value, "a finite number"));
                }
            }
            if sample.force < 0.0 {
                return Err(sample.invalid("force_n", sample.force, "a force that pulls, zero or more [N]"));
            }
        }
        let loaded = samples.iter().take_while(|sample| sample.phase == Phase::Loading).count();
        let (loading, unloading) = samples.split_at(loaded);
        if let Some(late) = unloading.iter().find(|sample| sample.phase == Phase::Loading) {
            return Err(late.invalid("phase", "loading", "unloading up to the end: one loop a record"));
        }
        let line = samples.last().map_or(0, |sample| sample.line);
        for (phase, found) in [(Phase::Loading, loading.len()), (Phase::Unloading, unloading.len())] {
            if found < 2 {
                return Err(RecordError::TooShort { line, phase, found });
            }
        }
        let (turning, first) = (loading[loading.len() - 1], unloading[0]);
        let mut branch = Vec::with_capacity(unloading.len() + 1);
        // The turning point may be given once or twice.
        if (first.force, first.elongation) != (turning.force, turning.elongation) {
            branch.push(Sample { phase: Phase::Unloading, ..turning });
        }
        branch.extend_from_slice(unloading);
        monotone(loading, 1.0)?;
        monotone(&branch, -1.0)?;
        Ok(Self { loading: loading.to_vec(), unloading: branch })
    }

    /// Samples of a phase in the order of the test; those of unloading start with the last one of loading.
    pub fn samples(&self, phase: Phase) -> &[Sample] {
        match phase {
            Phase::Loading => &self.loading,
            Phase::Unloading => &self.unloading,
        }
    }

    /// Elongation [m] at a force [N], interpolated; `None` outside the record.
    pub fn elongation(&self, phase: Phase, force: f64) -> Option<f64> {
        self.samples(phase).windows(2).find_map(|pair| {
            let [(f0, x0), (f1, x1)] = [0, 1].map(|k| (pair[k].force, pair[k].elongation));
            // Percentages of the breaking force are rounded.
            let slack = 1e-9 * f0.max(f1);
            let within = f0.min(f1) - slack <= force && force <= f0.max(f1) + slack;
            within.then(|| x0 + (x1 - x0) * (force - f0) / (f1 - f0))
        })
    }

    /// Least and greatest force of a phase [N].
    pub fn forces(&self, phase: Phase) -> [f64; 2] {
        let samples = self.samples(phase);
        let (first, last) = (samples[0].force, samples[samples.len() - 1].force);
        [first.min(last), first.max(last)]
    }

    /// Energy dissipated by the loop [J]: the area between loading and unloading, closed by a straight line.
    pub fn dissipated_energy(&self) -> f64 {
        let around = || self.loading.iter().chain(&self.unloading);
        let closed = around().zip(around().skip(1).chain(self.loading.first()));
        closed.map(|(a, b)| 0.5 * (a.force + b.force) * (b.elongation - a.elongation)).sum()
    }
}

/// Checks that force and elongation grow (`sign` = 1) or fall (-1) with every sample.
fn monotone(samples: &[Sample], sign: f64) -> Result<(), RecordError> {
    let way = if sign > 0.0 { "more" } else { "less" };
    for pair in samples.windows(2) {
        let [before, now] = [pair[0], pair[1]];
        let fields = [
            ("force_n", now.force, before.force),
            ("elongation_mm", 1e3 * now.elongation, 1e3 * before.elongation),
        ];
        for (field, value, previous) in fields {
            if sign * (value - previous) <= 0.0 {
                let expected = format!(
                    "{way} than {previous} of line {} while {}; smooth a noisy record, leave rows of a dwell \
                     out",
                    before.line,
                    now.phase.name()
                );
                return Err(now.invalid(field, value, &expected));
            }
        }
    }
    Ok(())
}
