//! How far a call sees, in SQL.

use crate::jobs::access::Reach;

/// The condition that a row is within reach, with what is bound at this place.
pub(super) fn within(reach: &Reach, place: u8) -> (String, &str) {
    match reach {
        Reach::Own(owner) => (format!("owner = ${place}"), owner.as_str()),
        // No name of an owner has this character.
        Reach::All => (format!("${place} = '*'"), "*"),
    }
}
