//! Settings of the code that calls the pipeline, beside the options of the user.

use super::{Budget, Workers};
use crate::PipelineError;
use unwrapd_api::Limits;
use unwrapd_files::document::Upload;

/// Settings of the code that calls the pipeline. They are options neither in JSON nor on the command
/// line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caller {
    /// Name of the written files without extension; the input's if absent.
    pub stem: Option<String>,
    /// Limits, whatever the options request.
    pub limits: Limits,
}

impl Caller {
    /// The name of the files that are written, without extension.
    pub(crate) fn stem(&self, upload: &Upload) -> String {
        self.stem.clone().unwrap_or_else(|| stem(&upload.name))
    }

    /// The workers asked for, as far as they are allowed.
    pub(crate) fn workers(&self, asked: Workers) -> Workers {
        Workers {
            threads: asked.threads.into_iter().chain(self.limits.threads).min(),
        }
    }

    /// The time asked for, as far as it is allowed.
    pub(crate) fn budget(&self, asked: Budget) -> Budget {
        let seconds = asked.time_budget.into_iter().chain(self.limits.seconds);
        Budget {
            time_budget: seconds.reduce(f64::min),
        }
    }
}

/// The file name without folders and extension.
fn stem(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    if stem.is_empty() {
        "mesh".into()
    } else {
        stem.into()
    }
}

/// The options of a command.
pub trait CommandOptions {
    /// Checks what can be checked without the file; the error names the option.
    fn check(&self) -> Result<(), PipelineError>;

    /// What its caller says.
    fn caller_mut(&mut self) -> &mut Caller;
}
