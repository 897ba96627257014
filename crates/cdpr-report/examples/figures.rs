//! Figures of CAROCA's study, with few observations:
//! `cargo run --release -p cdpr-report --example figures -- FOLDER`.
//!
//! A second argument is the number of observations of each sampling.

#![allow(clippy::print_stdout)]

use cdpr_report::{NamedSampling, Points, Sheet, histogram, point_effects, signed_effects, surface};
use cdpr_study::{
    IfExists, ResultsFolder, ResultsOf, Session, Study, SurfaceSummary, analyse, compute_surface, observe,
    write_figure,
};
use std::path::Path;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = arguments.next().ok_or("which folder are the figures to be written to?")?;
    let observations = arguments.next().map_or(Ok(200), |number| number.parse())?;
    let folder = ResultsFolder::begin(folder.as_ref(), ResultsOf::Figures, IfExists::Overwrite, |name| {
        name.ends_with(".svg")
    })?;
    let write = |name: &str, svg: &str| -> Result<(), Box<dyn std::error::Error>> {
        println!("{}", write_figure(&folder, name, svg)?.display());
        Ok(())
    };

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/studies/caroca.json");
    let mut study = Study::open(&path)?;
    study.set_observations(observations)?;

    let mut summaries = Vec::new();
    for name in study.file.samplings.keys() {
        let sampling = study.sampling(name)?;
        let session = Session::in_memory();
        let summary = analyse(&sampling, &observe(&sampling, &session)?, &session)?;
        write(name, &histogram(&summary, Sheet::SCREEN)?)?;
        write(&format!("{name}_effects"), &signed_effects(&summary, 20, Sheet::SCREEN)?)?;
        summaries.push((name.as_str(), summary));
    }
    // Fig. 5b and 5c: the symmetric pose above the other one.
    let geometrical: Vec<_> = summaries
        .iter()
        .filter(|(name, _)| name.starts_with("geometrical"))
        .map(|(name, summary)| NamedSampling { name, summary })
        .collect();
    write("anchor_points", &point_effects(&study.robot, &geometrical, Points::Anchor, Sheet::SCREEN)?)?;
    write("exit_points", &point_effects(&study.robot, &geometrical, Points::Exit, Sheet::SCREEN)?)?;

    for name in study.file.surfaces.keys() {
        let prepared = study.surface(name)?;
        let result = compute_surface(&prepared, &|_| ());
        write(name, &surface(&SurfaceSummary::new(&prepared, &result), &result, Sheet::SCREEN)?)?;
    }
    Ok(())
}
