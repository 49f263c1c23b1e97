//! Warnings about handles that missed their targets.

use serde::Serialize;

use unwrapd_deform::Unreached;
use unwrapd_files::document::Warning;
use unwrapd_method::solver::Status;

/// Maximum number of handles named in a warning.
const NAMED: usize = 8;

/// Degree to which a request was completed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Completion {
    /// Every handle is at its target, and the energy is minimal.
    #[default]
    Complete,
    /// The work ended before that: at the limit of time or of iterations, or on request.
    EndedEarly,
    /// Handles cannot be brought to their targets.
    TargetsMissed,
}

impl Completion {
    /// Returns the completion for the final status of the solver.
    pub(crate) fn of(status: Status) -> Self {
        match status {
            Status::Converged | Status::Stalled => Self::Complete,
            Status::IterationLimit | Status::Stopped => Self::EndedEarly,
            Status::TargetsUnreachable => Self::TargetsMissed,
        }
    }

    /// Returns a warning about what is missing; `unreached` are the handles that are not at their targets.
    pub(crate) fn warning(self, status: Status, unreached: &[Unreached]) -> Option<Warning> {
        let (code, what) = match self {
            Self::Complete => return None,
            Self::TargetsMissed => (
                "targets_unreachable",
                "no way was found to the targets of these handles, counted from 0",
            ),
            Self::EndedEarly if status == Status::IterationLimit => (
                "iteration_limit",
                "the energy is not minimal: the limit of iterations was reached",
            ),
            // The tracker says why it was stopped.
            Self::EndedEarly if unreached.is_empty() => return None,
            Self::EndedEarly => (
                "targets_missed",
                "the work ended before these handles, counted from 0, came to their targets",
            ),
        };
        let message = if unreached.is_empty() {
            what.to_owned()
        } else if code == "iteration_limit" {
            format!(
                "{what}; handles, counted from 0, that are not at their targets: {}",
                named(unreached)
            )
        } else {
            format!("{what}: {}", named(unreached))
        };
        Some(Warning::new(code, message))
    }
}

/// Lists the first handles with their distances from their targets.
fn named(unreached: &[Unreached]) -> String {
    let first = unreached.iter().take(NAMED);
    let names = first.map(|one| format!("{} (by {:.3e})", one.handle, one.distance));
    let names = names.collect::<Vec<_>>().join(", ");
    match unreached.len().saturating_sub(NAMED) {
        0 => names,
        more => format!("{names} and {more} more"),
    }
}
