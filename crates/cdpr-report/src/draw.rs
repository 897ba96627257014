//! All figures of the results of a study, with the names of their files.

use crate::drawing::sheet::Sheet;
use crate::error::ReportError;
use crate::figure::points::{NamedSampling, Points, point_effects};
use crate::{histogram, pose_maps, robot_view, shares, signed_effects, surface};
use cdpr_study::{Drawable, Figure, IndexMap, Results, Study, StudySummary};

/// Number of bars of signed effects.
const EFFECTS: usize = 20;
/// Number of leading inputs whose shares of the variance are drawn.
pub(crate) const LEADING: usize = 12;

/// Draws the figures of one part of a study, or those of the whole study. [`cdpr_study::run`] calls it.
pub fn draw(study: &Study, of: Drawable) -> Vec<Figure> {
    drawn(study, of, Sheet::SCREEN)
}

fn drawn(study: &Study, of: Drawable, sheet: Sheet) -> Vec<Figure> {
    match of {
        Drawable::Sampling { name, summary } => {
            let mut drawn = vec![figure(name.to_owned(), histogram(summary, sheet))];
            if !summary.signed_effects.is_empty() {
                drawn.push(figure(format!("{name}_effects"), signed_effects(summary, EFFECTS, sheet)));
            }
            if summary.sensitivity.is_some() {
                drawn.push(figure(format!("{name}_sensitivity"), shares(summary, LEADING, sheet)));
            }
            drawn
        }
        Drawable::Poses { name, summary, rows } => {
            let maps = pose_maps(&study.robot, summary, rows, sheet).into_iter();
            maps.map(|map| figure(format!("{name}_{}", map.name), map.svg)).collect()
        }
        Drawable::Surface { name, summary, result } => {
            vec![figure(name.to_owned(), surface(summary, result, sheet))]
        }
        Drawable::Whole { studies } => {
            let mut drawn = effects_of_points(study, studies, sheet);
            drawn.push(figure("robot".to_owned(), robot_view(study, sheet)));
            drawn
        }
    }
}

/// Draws all figures of results that are read back, for a sheet.
pub fn figures(results: &Results, sheet: Sheet) -> Vec<Figure> {
    let Results { study, summary, surfaces, poses, .. } = results;
    let of_part = |(name, part): (&String, &StudySummary)| match part {
        StudySummary::Sampling(summary) => drawn(study, Drawable::Sampling { name, summary }, sheet),
        StudySummary::Poses(summary) => {
            let rows = poses.get(name).map(Vec::as_slice).unwrap_or_default();
            drawn(study, Drawable::Poses { name, summary, rows }, sheet)
        }
        StudySummary::Surface(summary) => {
            let result = surfaces.get(name);
            result.map_or_else(Vec::new, |result| {
                drawn(study, Drawable::Surface { name, summary, result }, sheet)
            })
        }
    };
    let whole = Drawable::Whole { studies: &summary.studies };
    summary.studies.iter().flat_map(of_part).chain(drawn(study, whole, sheet)).collect()
}

/// Effects of the anchor points and of the exit points, with one panel per sampling that has them.
fn effects_of_points(study: &Study, studies: &IndexMap<String, StudySummary>, sheet: Sheet) -> Vec<Figure> {
    let kinds = [("anchor_points", "a1.x", Points::Anchor), ("exit_points", "b1.x", Points::Exit)];
    let drawn = kinds.into_iter().filter_map(|(name, parameter, points)| {
        let samplings: Vec<_> = studies
            .iter()
            .filter_map(|(name, study)| match study {
                StudySummary::Sampling(sampling) if sampling.t_student.contains_key(parameter) => {
                    Some(NamedSampling { name, summary: sampling })
                }
                _ => None,
            })
            .collect();
        (!samplings.is_empty())
            .then(|| figure(name.to_owned(), point_effects(&study.robot, &samplings, points, sheet)))
    });
    drawn.collect()
}

fn figure(name: String, svg: Result<String, ReportError>) -> Figure {
    Figure { name, svg: svg.map_err(|error| error.to_string()) }
}
