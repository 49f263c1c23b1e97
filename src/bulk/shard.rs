//! Shards of an asset list.

use std::str::FromStr;

/// One of several parts of a list, whose sizes differ by at most one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Index, from 0.
    index: u64,
    count: u64,
}

/// Requested shard: `I/N`, `auto` or `auto/N`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShardChoice {
    /// This shard.
    Fixed(Shard),
    /// The shard given by the scheduler's environment. The number of shards is needed if the environment lacks it.
    Auto(Option<u64>),
}

/// Reason why the shard cannot be determined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ShardError {
    /// The text does not have the form of a shard.
    #[error("{0:?} is not a shard: expected I/N, auto or auto/N")]
    Form(String),
    /// A number is malformed or 0.
    #[error("{0:?} is not a number from 1 on")]
    Number(String),
    /// The index exceeds the number of shards.
    #[error("there is no shard {index} of {count}")]
    Beyond {
        /// Requested shard, from 1.
        index: u64,
        /// Number of shards.
        count: u64,
    },
    /// No scheduler provides an index.
    #[error("auto requires one of the variables {}", names().join(", "))]
    NoIndex,
    /// A variable is not a number.
    #[error("{name} is {value:?}, not a number")]
    Variable {
        /// Name of the variable.
        name: &'static str,
        /// Value of the variable.
        value: String,
    },
    /// The scheduler does not provide the number of shards, or the array has gaps.
    #[error("{0} does not tell the number of shards: give it as auto/N")]
    NoCount(&'static str),
    /// The index exceeds the number of shards; indices are counted from 0.
    #[error("{name} is {index}, but with {count} shards it must be less than {count}")]
    Index {
        /// Variable of the index.
        name: &'static str,
        /// Value of the variable.
        index: u64,
        /// Number of shards.
        count: u64,
    },
}

/// Environment variables of a scheduler.
struct Scheduler {
    /// Variable of the index, from 0.
    index: &'static str,
    /// Variable of the number of tasks.
    count: Option<&'static str>,
    /// Variables of the least and the greatest index, which reveal gaps in an array.
    range: Option<[&'static str; 2]>,
}

const SCHEDULERS: [Scheduler; 3] = [
    // Kubernetes Indexed Job.
    Scheduler {
        index: "JOB_COMPLETION_INDEX",
        count: None,
        range: None,
    },
    Scheduler {
        index: "SLURM_ARRAY_TASK_ID",
        count: Some("SLURM_ARRAY_TASK_COUNT"),
        range: Some(["SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX"]),
    },
    Scheduler {
        index: "AWS_BATCH_JOB_ARRAY_INDEX",
        count: Some("AWS_BATCH_JOB_ARRAY_SIZE"),
        range: None,
    },
];

fn names() -> Vec<&'static str> {
    SCHEDULERS.iter().map(|it| it.index).collect()
}

/// Returns the index variable of the scheduler if this process is a task of an array.
pub fn array_variable(variable: impl Fn(&str) -> Option<String>) -> Option<&'static str> {
    names().into_iter().find(|name| variable(name).is_some())
}

impl Shard {
    /// Returns whether the asset at this position of the list belongs to this shard.
    pub fn contains(self, place: usize) -> bool {
        place as u64 % self.count == self.index
    }

    /// Returns its number, from 1.
    pub fn number(self) -> u64 {
        self.index + 1
    }

    /// Returns the number of shards.
    pub fn count(self) -> u64 {
        self.count
    }
}

impl FromStr for ShardChoice {
    type Err = ShardError;

    fn from_str(text: &str) -> Result<Self, ShardError> {
        match text.split_once('/') {
            None if text == "auto" => Ok(Self::Auto(None)),
            None => Err(ShardError::Form(text.to_owned())),
            Some(("auto", count)) => Ok(Self::Auto(Some(number(count)?))),
            Some((index, count)) => {
                let (index, count) = (number(index)?, number(count)?);
                if count < index {
                    return Err(ShardError::Beyond { index, count });
                }
                let index = index - 1;
                Ok(Self::Fixed(Shard { index, count }))
            }
        }
    }
}

fn number(text: &str) -> Result<u64, ShardError> {
    match text.parse() {
        Ok(number @ 1..) => Ok(number),
        _ => Err(ShardError::Number(text.to_owned())),
    }
}

impl ShardChoice {
    /// Determines the shard; `variable` reads the environment.
    pub fn resolved(self, variable: impl Fn(&str) -> Option<String>) -> Result<Shard, ShardError> {
        // A fixed shard needs no scheduler.
        let given = match self {
            Self::Fixed(shard) => return Ok(shard),
            Self::Auto(given) => given,
        };
        for Scheduler {
            index: name,
            count,
            range,
        } in SCHEDULERS
        {
            // Use the first scheduler that provides an index.
            let Some(index) = number_in(&variable, name)? else {
                continue;
            };
            let told = match count {
                Some(name) => number_in(&variable, name)?,
                None => None,
            };
            // If an array has gaps or does not begin at 0, its number of tasks is not the number of shards.
            let is_whole = match range {
                Some([least, greatest]) => {
                    number_in(&variable, least)? == Some(0)
                        && number_in(&variable, greatest)?.map(|greatest| greatest + 1) == told
                }
                None => true,
            };
            let count = given.or(told.filter(|_| is_whole));
            let count = count.ok_or(ShardError::NoCount(name))?;
            if count <= index {
                return Err(ShardError::Index { name, index, count });
            }
            return Ok(Shard { index, count });
        }
        Err(ShardError::NoIndex)
    }
}

/// Returns the number in an environment variable; `None` if it is not set.
fn number_in(
    variable: impl Fn(&str) -> Option<String>,
    name: &'static str,
) -> Result<Option<u64>, ShardError> {
    let Some(value) = variable(name) else {
        return Ok(None);
    };
    match value.parse() {
        Ok(number) => Ok(Some(number)),
        Err(_) => Err(ShardError::Variable { name, value }),
    }
}
