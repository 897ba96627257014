//! What a cable that the user gives replaces of the files, and what it leaves.

use crate::draft::{Draft, DraftCable};
use cdpr_robot::CableProperties;

impl Draft {
    /// Diameters [m] and breaking forces [N] of the cables in the files.
    fn stated(&self) -> [Vec<f64>; 2] {
        let of = |own: fn(&DraftCable) -> Option<f64>, known: fn(&CableProperties) -> Option<f64>| {
            let value = |cable: &DraftCable| own(cable).or_else(|| cable.properties.as_ref().and_then(known));
            self.cables.iter().filter_map(value).collect()
        };
        [
            of(|cable| cable.diameter, |known| known.diameter),
            of(|cable| cable.breaking_force, |known| known.breaking_force),
        ]
    }

    /// What the cable that the user gives replaces of the files.
    pub(super) fn replaced(&self, given: &CableProperties) -> String {
        let [diameters, forces] = self.stated();
        let known = || self.cables.iter().filter_map(|cable| cable.properties.as_ref());
        // A stiffness of its own is kept, with the section of the cable.
        let moduli = known().filter(|_| self.cables.iter().all(|cable| cable.stiffness.is_none()));
        let all = [
            ("diameters", "m", diameters, given.diameter),
            ("sections", "m²", known().map(|of| of.section).collect(), Some(given.section)),
            (
                "linear densities",
                "kg/m",
                known().map(|of| of.linear_density).collect(),
                Some(given.linear_density),
            ),
            ("moduli", "Pa", moduli.map(|of| of.youngs_modulus).collect(), Some(given.youngs_modulus)),
            ("breaking forces", "N", forces, given.breaking_force),
        ];
        let other = |(name, unit, values, own): (&str, &str, Vec<f64>, Option<f64>)| {
            let own = own.filter(|own| values.iter().any(|value| value != own));
            own.and_then(|_| Some(format!("{name} of {} {unit}", range(&values)?)))
        };
        let others: Vec<_> = all.into_iter().filter_map(other).collect();
        if others.is_empty() {
            String::new()
        } else {
            format!(", instead of {} in the files", others.join(", "))
        }
    }

    /// What the files have and the cable that the user gives has not.
    pub(super) fn assume_kept(&mut self, given: &CableProperties) {
        let [diameters, forces] = self.stated();
        for (name, unit, values, own) in [
            ("diameters", "m", diameters, given.diameter),
            ("breaking forces", "N", forces, given.breaking_force),
        ] {
            if let (None, Some(range)) = (own, range(&values)) {
                self.assume(format!("the {name} of the cables are those of the files, {range} {unit}"));
            }
        }
    }
}

/// Least and greatest of some values in words.
fn range(values: &[f64]) -> Option<String> {
    let least = values.iter().copied().reduce(f64::min)?;
    let greatest = values.iter().copied().fold(least, f64::max);
    Some(if least == greatest { format!("{least}") } else { format!("{least} to {greatest}") })
}
