//! A share of a study's blocks, for several machines with one folder.

use crate::error::StudyError;

/// One of every `count` blocks of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

const EXPECTED: &str = "i/n with i from 1 to n, or auto/n in task i of an array of n";

/// Variables in which schedulers number their tasks. HyperQueue's tasks run within jobs of Slurm.
const TASK: [&str; 2] = ["HQ_TASK_ID", "SLURM_ARRAY_TASK_ID"];

impl Shard {
    /// Parses `i/n`, the `i`-th of `n` shards, counted from 1; or `auto/n`, for which a variable of the
    /// environment gives `i`: `HQ_TASK_ID` of HyperQueue's task arrays or `SLURM_ARRAY_TASK_ID` of Slurm's
    /// job arrays, with tasks from 1 to `n`.
    ///
    /// The number `n` is always explicit, because an array of repeated tasks counts only these. A variable
    /// alone makes no shard: a run within a job is a whole run unless a shard is requested.
    ///
    /// # Errors
    /// [`StudyError::Setting`] for any other text; it names the variable if the task is not one of `n`.
    pub fn parse(text: &str, variable: impl Fn(&str) -> Option<String>) -> Result<Self, StudyError> {
        let refused = || StudyError::setting("shard", text, EXPECTED);
        let (index, count) = text.split_once('/').ok_or_else(refused)?;
        let count: usize = count.parse().ok().filter(|count| *count > 0).ok_or_else(refused)?;
        let shard = |index: &str| {
            let index = index.parse().ok().filter(|index| (1..=count).contains(index))?;
            Some(Self { index, count })
        };
        if index != "auto" {
            return shard(index).ok_or_else(refused);
        }
        let Some((name, task)) = TASK.iter().find_map(|name| Some((*name, variable(name)?))) else {
            let expected = format!("i/{count} where neither {} is set", TASK.join(" nor "));
            return Err(StudyError::setting("shard", text, expected));
        };
        let expected = || format!("a task from 1 to {count}, as shard is {text}");
        shard(&task).ok_or_else(|| StudyError::setting(name, format!("`{task}`"), expected()))
    }

    /// Whether a block belongs to the shard, by its index in the whole study.
    pub(crate) fn has(self, block: usize) -> bool {
        let (round, within) = (block / self.count, block % self.count);
        (within + mixed(round as u64) as usize % self.count) % self.count == self.index - 1
    }
}

/// A number without pattern (splitmix64). Each round of blocks begins with another shard. Otherwise one shard
/// of ten would get the top layer of a box with ten layers, perhaps entirely without feasible tensions.
fn mixed(number: u64) -> u64 {
    let z = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
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
        assert_eq!(parse("2/4", &[("SLURM_ARRAY_TASK_ID", "1")]), Ok((2, 4)));
        assert_eq!(parse("auto/8", &[("SLURM_ARRAY_TASK_ID", "3")]), Ok((3, 8)));
        assert_eq!(parse("auto/8", &[("HQ_TASK_ID", "5"), ("SLURM_ARRAY_TASK_ID", "3")]), Ok((5, 8)));
    }

    #[test]
    fn invalid_shards_are_refused_with_the_value() {
        for text in
            ["0/4", "5/4", "x", "1", "1/0", "1/4/2", "-1/4", "", "auto", "auto/x", "auto/0", "auto/-1"]
        {
            let error = parse(text, &[("SLURM_ARRAY_TASK_ID", "1")]).unwrap_err();
            assert_eq!(error, format!("shard is {text}: expected {EXPECTED}"));
        }
        let error = parse("auto/4", &[]).unwrap_err();
        assert!(error.contains("neither HQ_TASK_ID nor SLURM_ARRAY_TASK_ID is set"), "{error}");
    }

    #[test]
    fn tasks_that_are_not_numbered_from_one_are_refused_with_the_variable() {
        for name in TASK {
            for task in ["0", "5", "five", ""] {
                let error = parse("auto/4", &[(name, task)]).unwrap_err();
                assert!(
                    error.starts_with(&format!("{name} is `{task}`: expected a task from 1 to 4")),
                    "{error}"
                );
            }
        }
    }
}
