//! Intervals of Morris's μ* that are not called reliable: how many, and how often these and the others hold.

use cdpr_sensitivity::{MorrisDesign, SensitivityError, morris_effects, observe};

use crate::exact::{Exact, holds};
use crate::functions::{Function, twelve};

/// Studies of one input, and those whose interval holds.
type Tally = [f64; 2];

fn share([studies, held]: Tally) -> String {
    if studies == 0.0 { "-".to_owned() } else { format!("{:.1}", 100.0 * held / studies) }
}

/// Prints, for each function and number of trajectories, the input whose intervals hold least often, and all
/// inputs of which some interval is not reliable.
pub(crate) fn table(studies: u64, part: &str) -> Result<(), SensitivityError> {
    println!(
        "share of the intervals of 95 % of mu* that hold [%]: all, those called reliable, others; share"
    );
    println!("of the studies whose interval is not called reliable [%]");
    println!("| function | effects | input | all | reliable | others | not reliable |");
    println!("|---|---|---|---|---|---|---|");
    let functions = twelve().into_iter().filter(|of| of.name.contains(part) && of.name != "constant");
    for function in functions {
        let exact = Exact::of(&function)?;
        for blocks in [16, 24, 32, 64, 256] {
            rows(&function, &exact.morris, blocks, studies)?;
        }
    }
    Ok(())
}

fn rows(function: &Function, exact: &[f64], blocks: usize, studies: u64) -> Result<(), SensitivityError> {
    // One input of a sum behaves as the others do.
    let studies = if exact.len() > 20 { studies.div_ceil(10) } else { studies };
    let mut tallies = vec![[Tally::default(); 2]; exact.len()];
    for seed in 0..studies {
        let design = MorrisDesign::trajectories(function.inputs.clone(), blocks, 4, seed)?;
        let found = morris_effects(&design, &observe(&design, function.model)?, 0.95)?;
        for ((found, exact), tallies) in found.iter().zip(exact).zip(&mut tallies) {
            let tally = &mut tallies[usize::from(!found.reliable)];
            let held = f64::from(u8::from(holds(&found.mean_absolute, *exact)));
            *tally = [tally[0] + 1.0, tally[1] + held];
        }
    }
    let whole = |[one, other]: [Tally; 2]| [0, 1].map(|k| one[k] + other[k]);
    let least = (0..exact.len()).min_by(|&i, &j| whole(tallies[i])[1].total_cmp(&whole(tallies[j])[1]));
    for (i, of) in tallies.iter().enumerate() {
        // All intervals of too few effects are not reliable.
        let differs = of[0][0] > 0.0 && of[1][0] >= 0.01 * studies as f64;
        if Some(i) == least || differs {
            println!(
                "| {} | {blocks} | {} | {} | {} | {} | {:.1} |",
                function.name,
                function.inputs[i].name,
                share(whole(*of)),
                share(of[0]),
                share(of[1]),
                100.0 * of[1][0] / studies as f64
            );
        }
    }
    Ok(())
}
