//! Limits that keep tensions from a balance.

use cdpr_robot::short;
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

/// Share of a limit within which a tension counts as at it where nothing balances the wrench: the best attempt
/// may end next to a limit, or beyond it.
const NEAR: f64 = 1e-3;

impl Blocked {
    /// The limit that a tension of an attempt is at or beyond.
    pub(crate) fn near(tension: f64, min: f64, max: f64) -> Option<Bound> {
        if tension >= (1.0 - NEAR) * max {
            Some(Bound::Max)
        } else {
            (tension <= (1.0 + NEAR) * min).then_some(Bound::Min)
        }
    }

    /// The cables at either limit, as the end of a sentence.
    pub(crate) fn list(blocked: &[Self]) -> String {
        let of = |bound: Bound, name: &str| {
            let cables: Vec<_> = blocked.iter().filter(|b| b.bound == bound).collect();
            let names: Vec<_> = cables.iter().map(|b| (b.index + 1).to_string()).collect();
            let limit = cables.first().map(|b| b.tension);
            let limit = limit.filter(|limit| cables.iter().all(|b| b.tension == *limit));
            let limit = limit.map_or_else(String::new, |limit| format!(" ({} N)", short(limit)));
            match &names[..] {
                [] => String::new(),
                [cable] => format!(", with cable {cable} at its {name}{limit}"),
                cables => format!(", with cables {} at their {name}{limit}", cables.join(", ")),
            }
        };
        of(Bound::Min, "least") + &of(Bound::Max, "greatest")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tension_at_or_next_to_or_beyond_a_limit_is_at_it() {
        let of = |tension| Blocked::near(tension, 5.0, 900.0);
        assert_eq!([900.336, 899.5, 898.0].map(of), [Some(Bound::Max), Some(Bound::Max), None]);
        assert_eq!([4.2, 5.004, 5.1].map(of), [Some(Bound::Min), Some(Bound::Min), None]);
        let blocked = [0, 3].map(|index| Blocked { index, bound: Bound::Max, tension: 900.0 });
        assert_eq!(Blocked::list(&blocked), ", with cables 1, 4 at their greatest (900 N)");
        let differ = [blocked[0], Blocked { tension: 800.0, ..blocked[1] }];
        assert_eq!(Blocked::list(&differ), ", with cables 1, 4 at their greatest");
        assert_eq!(Blocked::list(&blocked[1..]), ", with cable 4 at its greatest (900 N)");
    }
}
