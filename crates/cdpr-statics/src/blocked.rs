//! Limits that keep tensions from a balance.

use cdpr_tension::Bound;

/// A limit that a tension rests on while the wrench is not balanced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocked {
    /// Index of the cable, from 0.
    pub index: usize,
    /// Which of its limits.
    pub bound: Bound,
    /// The limit [N].
    pub tension: f64,
}

impl Blocked {
    /// The cables at either limit, as the end of a sentence.
    pub(crate) fn list(blocked: &[Self]) -> String {
        let of = |bound: Bound, name: &str| {
            let cables: Vec<_> =
                blocked.iter().filter(|b| b.bound == bound).map(|b| (b.index + 1).to_string()).collect();
            match &cables[..] {
                [] => String::new(),
                [cable] => format!(", with cable {cable} at its {name}"),
                cables => format!(", with cables {} at their {name}", cables.join(", ")),
            }
        };
        of(Bound::Min, "least") + &of(Bound::Max, "greatest")
    }
}
