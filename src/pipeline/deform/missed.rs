//! Handles that did not come to their targets, as users are told.

use crate::deform::Unreached;
use crate::document::Warning;
use crate::solver::Status;

/// The code of the warning.
const TARGETS_UNREACHABLE: &str = "targets_unreachable";

/// So many are named at most.
const NAMED: usize = 8;

/// The handles that did not come to their targets although there was time.
pub(in crate::pipeline) fn missed(status: Status, unreached: &[Unreached]) -> &[Unreached] {
    if status == Status::Stopped {
        &[]
    } else {
        unreached
    }
}

/// Names them, if there are any.
pub(in crate::pipeline) fn missed_warning(missed: &[Unreached]) -> Option<Warning> {
    if missed.is_empty() {
        return None;
    }
    let named = missed.iter().take(NAMED);
    let named = named.map(|one| format!("{} (by {:.3e})", one.handle, one.distance));
    let mut names = named.collect::<Vec<_>>().join(", ");
    if missed.len() > NAMED {
        names = format!("{names} and {} more", missed.len() - NAMED);
    }
    let message =
        format!("no way was found to the targets of these handles, counted from 0: {names}");
    Some(Warning::new(TARGETS_UNREACHABLE, message))
}

/// Is every handle at its target, or was there no time to bring it there?
pub(in crate::pipeline) fn is_complete(warnings: &[Warning]) -> bool {
    let mut codes = warnings.iter().map(|warning| &*warning.code);
    !codes.any(|code| code == TARGETS_UNREACHABLE)
}
