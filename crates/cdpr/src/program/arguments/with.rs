//! Further results and settings of a command by their names: `--with tilt=8,distances`.

use crate::program::arguments::number;
use crate::program::error::ProgramError;
use cdpr_dynamics::Damping;

/// What is said of amplitudes without drag.
pub(crate) const NO_DRAG: &str =
    "nothing damps cables across their stretch: such peaks are far above real ones; --with drag=RATE";

/// Names, with values or without.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct With(Vec<(String, Option<String>)>);

/// `name` or `name=value`, with commas between them.
pub(crate) fn with(text: &str) -> Result<With, String> {
    let one = |text: &str| match text.split_once('=') {
        Some((name, value)) => (name.trim().to_owned(), Some(value.trim().to_owned())),
        None => (text.trim().to_owned(), None),
    };
    let found: Vec<_> = text.split(',').map(one).collect();
    for (k, (name, _)) in found.iter().enumerate() {
        if name.is_empty() || found[..k].iter().any(|(before, _)| before == name) {
            return Err("expected names with commas between them, each of them once".to_owned());
        }
    }
    Ok(With(found))
}

impl With {
    /// What is given, none of it with a name that a command does not have.
    pub(crate) fn known(given: Option<&Self>, names: &[&str]) -> Result<Self, ProgramError> {
        let given = given.cloned().unwrap_or_default();
        given.check(names).map(|()| given)
    }

    /// Refuses names that a command does not have.
    pub(crate) fn check(&self, known: &[&str]) -> Result<(), ProgramError> {
        match self.0.iter().find(|(name, _)| !known.contains(&name.as_str())) {
            None => Ok(()),
            Some((name, _)) => {
                Err(ProgramError::Usage(format!("--with {name}: expected {}", known.join(", "))))
            }
        }
    }

    /// Whether a name without a value is there.
    pub(crate) fn has(&self, name: &str) -> Result<bool, ProgramError> {
        match self.find(name) {
            Some(Some(value)) => {
                Err(ProgramError::Usage(format!("--with {name}={value}: expected {name} without a value")))
            }
            found => Ok(found.is_some()),
        }
    }

    /// What `read` makes of the value of a name, if the name is there; without a value of `usual`, if a value
    /// may be left out.
    pub(crate) fn value<T>(
        &self,
        name: &str,
        usual: Option<T>,
        read: impl FnOnce(&str) -> Result<T, String>,
    ) -> Result<Option<T>, ProgramError> {
        let refused = |value: &str, why: String| ProgramError::Usage(format!("--with {name}{value}: {why}"));
        match (self.find(name), usual) {
            (None, _) => Ok(None),
            (Some(None), Some(usual)) => Ok(Some(usual)),
            (Some(None), None) => Err(refused("", format!("expected {name}=VALUE"))),
            (Some(Some(text)), _) => read(text).map(Some).map_err(|why| refused(&format!("={text}"), why)),
        }
    }

    /// `damping=TAU` and `drag=RATE`, if one of them is there.
    pub(crate) fn damping(&self) -> Result<Option<Damping>, ProgramError> {
        let [stretch, drag] = ["damping", "drag"].map(|name| self.value(name, None, number));
        let (stretch, drag, usual) = (stretch?, drag?, Damping::USUAL);
        let given = Damping { stretch: stretch.unwrap_or(usual.stretch), drag: drag.unwrap_or(usual.drag) };
        Ok((stretch.is_some() || drag.is_some()).then_some(given))
    }

    fn find(&self, name: &str) -> Option<Option<&str>> {
        self.0.iter().find(|(own, _)| own == name).map(|(_, value)| value.as_deref())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::arguments::count;

    #[test]
    fn names_have_values_or_not() {
        let given = with("tilt=8, distances,boundary").unwrap();
        assert!(given.check(&["tilt", "distances", "boundary"]).is_ok());
        let refused = given.check(&["tilt", "boundary"]).unwrap_err().to_string();
        assert!(refused.starts_with("--with distances: expected tilt, boundary"), "{refused}");
        assert!(given.has("distances").unwrap() && !given.has("capacity").unwrap());
        assert_eq!(given.value("tilt", Some(4), count::<1, 360>).unwrap(), Some(8));
        assert_eq!(given.value("distances", Some(4), count::<1, 360>).unwrap(), Some(4));
        for wrong in [given.has("tilt"), given.value("tilt", None, count::<1, 7>).map(|_| true)] {
            assert!(wrong.unwrap_err().to_string().starts_with("--with tilt=8: expected"));
        }
        assert!(with("a,a").is_err() && with("").is_err());
    }
}
