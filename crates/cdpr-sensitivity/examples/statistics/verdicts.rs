//! How often the verdict of a table calls an input certain that has no effect, and how often it misses a
//! cause.

use cdpr_sensitivity::{Analyser, SensitivityError};

use crate::known_tables::{KINDS, Source};

/// Prints, for each kind of table, the tables with a false certainty, the causes that are found, and those
/// that are certain.
pub(crate) fn table(studies: u64, part: &str) -> Result<(), SensitivityError> {
    println!(
        "{studies} tables of each kind: tables with an input called certain without an effect of its own;"
    );
    println!("causes that are not named; causes that are not called certain");
    println!("{:42}{:>10}{:>14}{:>14}", "kind", "false", "missing", "not certain");
    for (name, kind) in KINDS.iter().filter(|(name, _)| name.contains(part)) {
        let (mut wrong, mut missing, mut uncertain, mut causes) = (0, 0, 0, 0);
        for seed in 0..studies {
            let known = kind(&mut Source::new(seed));
            let verdict = Analyser::new(seed).verdict(&known.data)?;
            let name = |input: &usize| known.data.names()[*input].as_str();
            let certain = |input: &usize| verdict.certain.iter().any(|of| of.input == name(input));
            let related = |input: &usize| verdict.related.iter().any(|of| of.input == name(input));
            wrong += usize::from(known.inert.iter().any(certain));
            causes += known.causes.len();
            missing += known.causes.iter().filter(|input| !certain(input) && !related(input)).count();
            uncertain += known.causes.iter().filter(|input| !certain(input)).count();
        }
        println!(
            "{name:42}{wrong:>10}{:>14}{:>14}",
            format!("{missing}/{causes}"),
            format!("{uncertain}/{causes}")
        );
    }
    Ok(())
}
