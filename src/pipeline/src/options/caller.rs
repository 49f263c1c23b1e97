//! Settings of the pipeline's caller, beside the options of the user.

use super::{Budget, Workers};
use crate::PipelineError;
use unwrapd_api::Limits;
use unwrapd_files::document::Upload;

/// Settings of the pipeline's caller. They are not options in JSON or on the command line.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Caller {
    /// Name of the written files without extension; the input's if absent.
    pub stem: Option<String>,
    /// Limits, whatever the options request.
    pub limits: Limits,
}

impl Caller {
    /// Returns the name of the written files without extension.
    pub(crate) fn stem(&self, upload: &Upload) -> String {
        self.stem.clone().unwrap_or_else(|| stem(&upload.name))
    }

    /// Returns the requested workers within the limits.
    pub(crate) fn workers(&self, asked: Workers) -> Workers {
        Workers {
            threads: asked.threads.into_iter().chain(self.limits.threads).min(),
        }
    }

    /// Returns the requested time budget within the limits.
    pub(crate) fn budget(&self, asked: Budget) -> Budget {
        let seconds = asked.time_budget.into_iter().chain(self.limits.seconds);
        Budget {
            time_budget: seconds.reduce(f64::min),
        }
    }
}

/// Returns the file name without folders and extension; `mesh` if nothing is left.
fn stem(name: &str) -> String {
    let name = name.rsplit(['/', '\\']).next().unwrap_or(name);
    let stem = name.rsplit_once('.').map_or(name, |(stem, _)| stem);
    if stem.is_empty() {
        "mesh".into()
    } else {
        stem.into()
    }
}

/// Options of a command.
pub trait CommandOptions {
    /// Checks everything that does not need the file. The error names the option.
    fn check(&self) -> Result<(), PipelineError>;

    /// Returns the settings of the caller.
    fn caller_mut(&mut self) -> &mut Caller;
}
