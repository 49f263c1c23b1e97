//! Visibility of a request in SQL.

use crate::jobs::access::Visibility;

/// Returns the condition that a row is visible, and the value to bind to its placeholder.
pub(super) fn within(visibility: &Visibility, place: u8) -> (String, &str) {
    match visibility {
        Visibility::Own(owner) => (format!("owner = ${place}"), owner.as_str()),
        // Names of owners cannot contain this character. The placeholder must be used, since every caller binds it.
        Visibility::All => (format!("${place} = '*'"), "*"),
    }
}
