//! A share of a study's blocks, for several machines with one folder.

use crate::error::StudyError;

/// One of every `count` blocks of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

const EXPECTED: &str = "i/n with i from 1 to n, auto, or auto/n";

impl Shard {
    /// `i/n`, the `i`-th of `n` shards, from 1 on; or `auto` or `auto/n`, as the scheduler says in variables of the environment:
    ///
    /// - Slurm's job arrays: `SLURM_ARRAY_TASK_ID`, `_MIN`, `_MAX` and `_COUNT`, consecutive;
    /// - HyperQueue's task arrays: `HQ_TASK_ID`. It tells no number of tasks: `auto/n` does, with tasks from 1 to n.
    ///
    /// A variable alone makes no shard: a run within a job is a whole run unless it is told otherwise.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for anything else.
    pub fn parse(text: &str, variable: impl Fn(&str) -> Option<String>) -> Result<Self, StudyError> {
        let invalid = || StudyError::setting("--shard", text, EXPECTED);
        let (index, count) = match text.split_once('/') {
            Some((index, count)) => (index, Some(count.parse().map_err(|_| invalid())?)),
            None => (text, None),
        };
        let (index, count) = match (index, count) {
            ("auto", count) => from_scheduler(count, variable)?,
            (index, Some(count)) => (index.parse().map_err(|_| invalid())?, count),
            _ => return Err(invalid()),
        };
        if index == 0 || index > count {
            return Err(StudyError::setting("--shard", format!("{index}/{count}"), EXPECTED));
        }
        Ok(Self { index, count })
    }

    /// Whether a block is in it, by its number in the whole study from 0 on.
    pub(crate) fn has(self, block: usize) -> bool {
        let (round, place) = (block / self.count, block % self.count);
        (place + mixed(round as u64) as usize % self.count) % self.count == self.index - 1
    }
}

/// A number without any pattern (splitmix64). Each round of blocks begins with another shard: else one of ten would have the top layer of all
/// poses of a box with ten layers, of which perhaps none is held.
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

fn from_scheduler(
    count: Option<usize>,
    variable: impl Fn(&str) -> Option<String>,
) -> Result<(usize, usize), StudyError> {
    let number = |name: &str| -> Result<usize, StudyError> {
        let value = variable(name).unwrap_or_default();
        value.parse().map_err(|_| StudyError::setting(name, format!("`{value}`"), "a whole number"))
    };
    // HyperQueue's tasks run within jobs of Slurm.
    match (variable("HQ_TASK_ID").is_some(), variable("SLURM_ARRAY_TASK_ID").is_some()) {
        (true, _) => {
            let expected = "auto/n under HyperQueue, which does not tell the number n of its tasks";
            let count = count.ok_or_else(|| StudyError::setting("--shard", "auto", expected))?;
            Ok((number("HQ_TASK_ID")?, count))
        }
        (false, true) => {
            let id = number("SLURM_ARRAY_TASK_ID")?;
            if let Some(count) = count {
                return Ok((id, count));
            }
            let [min, max, tasks] =
                ["MIN", "MAX", "COUNT"].map(|end| number(&format!("SLURM_ARRAY_TASK_{end}")));
            let (min, max, tasks) = (min?, max?, tasks?);
            if max.checked_sub(min) != tasks.checked_sub(1) || !(min..=max).contains(&id) {
                let value = format!("auto, for task {id} of {tasks} from {min} to {max}");
                return Err(StudyError::setting(
                    "--shard",
                    value,
                    "consecutive tasks (--array=1-n), or auto/n",
                ));
            }
            Ok((id - min + 1, tasks))
        }
        (false, false) => {
            let expected = "i/n where neither SLURM_ARRAY_TASK_ID nor HQ_TASK_ID is set";
            Err(StudyError::setting("--shard", "auto", expected))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str, variables: &[(&str, &str)]) -> Result<(usize, usize), String> {
        let variable = |name: &str| {
            variables.iter().find(|(known, _)| *known == name).map(|(_, value)| (*value).to_owned())
        };
        Shard::parse(text, variable)
            .map(|shard| (shard.index, shard.count))
            .map_err(|error| error.to_string())
    }

    fn slurm<'a>(id: &'a str, min: &'a str, max: &'a str, count: &'a str) -> [(&'a str, &'a str); 4] {
        [
            ("SLURM_ARRAY_TASK_ID", id),
            ("SLURM_ARRAY_TASK_MIN", min),
            ("SLURM_ARRAY_TASK_MAX", max),
            ("SLURM_ARRAY_TASK_COUNT", count),
        ]
    }

    #[test]
    fn each_block_is_in_exactly_one_shard() {
        let shards: Vec<Shard> = (1..=3).map(|index| Shard { index, count: 3 }).collect();
        for block in 0..10 {
            assert_eq!(shards.iter().filter(|shard| shard.has(block)).count(), 1);
        }
    }

    #[test]
    fn a_layer_of_a_box_is_shared_by_all_shards_even_if_there_are_as_many_shards_as_layers() {
        for layers in [10, 20, 100] {
            let of_shard = |index| {
                let shard = Shard { index, count: 10 };
                (0..1000).filter(|column| shard.has(layers * column + layers - 1)).count()
            };
            let blocks: Vec<usize> = (1..=10).map(of_shard).collect();
            assert!(blocks.iter().all(|count| (60..140).contains(count)), "{layers} layers: {blocks:?}");
        }
    }

    #[test]
    fn a_shard_is_given_by_numbers_or_by_the_scheduler() {
        assert_eq!(parse("2/4", &slurm("1", "1", "9", "9")), Ok((2, 4)));
        assert_eq!(parse("auto", &slurm("1", "1", "4", "4")), Ok((1, 4)));
        assert_eq!(parse("auto", &slurm("3", "0", "3", "4")), Ok((4, 4)));
        assert_eq!(parse("auto/8", &slurm("3", "3", "3", "1")), Ok((3, 8)));
        assert_eq!(parse("auto/8", &[("HQ_TASK_ID", "5")]), Ok((5, 8)));
    }

    #[test]
    fn shards_that_are_none_are_refused_with_the_value() {
        for text in ["0/4", "5/4", "x", "1", "1/0", "1/4/2", "-1/4", "", "auto/x"] {
            let error = parse(text, &[]).unwrap_err();
            assert!(error.starts_with(&format!("--shard is {text}: expected ")), "{error}");
        }
        let error = parse("auto", &[]).unwrap_err();
        assert!(error.contains("neither SLURM_ARRAY_TASK_ID nor HQ_TASK_ID is set"), "{error}");
        let error = parse("auto", &[("HQ_TASK_ID", "5")]).unwrap_err();
        assert!(error.contains("auto/n under HyperQueue"), "{error}");
        let error = parse("auto", &slurm("5", "1", "7", "3")).unwrap_err();
        assert!(error.contains("consecutive tasks"), "{error}");
        let error = parse("auto/4", &[("HQ_TASK_ID", "0")]).unwrap_err();
        assert!(error.contains("--shard is 0/4"), "{error}");
        let error = parse("auto", &slurm("five", "1", "7", "3")).unwrap_err();
        assert!(error.contains("SLURM_ARRAY_TASK_ID is `five`: expected a whole number"), "{error}");
    }
}
