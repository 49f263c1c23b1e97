//! Visibility of a request in SQL.

use crate::jobs::access::Reach;

/// Returns the condition that a row is visible, and the value to bind to its placeholder.
pub(super) fn within(reach: &Reach, place: u8) -> (String, &str) {
    match reach {
        Reach::Own(owner) => (format!("owner = ${place}"), owner.as_str()),
        // No name of an owner has this character.
        Reach::All => (format!("${place} = '*'"), "*"),
    }
}
