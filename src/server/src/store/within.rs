//! Visibility of a request in SQL.

use crate::jobs::access::Reach;

/// Returns the condition that a row is visible, and the value to bind to its placeholder.
pub(super) fn within(reach: &Reach, place: u8) -> (String, &str) {
    match reach {
        Reach::Own(owner) => (format!("owner = ${place}"), owner.as_str()),
        // Names of owners cannot contain this character. The placeholder must be used, since every caller binds it.
        Reach::All => (format!("${place} = '*'"), "*"),
    }
}
