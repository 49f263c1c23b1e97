use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Something that users should know of a file that was read or written, and that is no error.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct Warning {
    /// Stable snake_case word.
    pub code: Cow<'static, str>,
    /// What happened and what to do, one or two sentences.
    pub message: String,
}

impl Warning {
    /// A warning with its code and its sentences.
    pub fn new(code: &'static str, message: impl Into<String>) -> Self {
        Self {
            code: Cow::Borrowed(code),
            message: message.into(),
        }
    }
}

/// Says that vertices that no face uses have coordinates that are not finite.
pub(super) fn unused_not_finite(n_vertices: usize) -> Option<Warning> {
    (n_vertices > 0).then(|| {
        Warning::new(
            "unused_not_finite",
            format!("{n_vertices} vertices that no face uses have coordinates that are not finite"),
        )
    })
}

/// The first names of many, each cut short, for a message.
pub(super) fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 6;
    let mut names = names.map(shortened);
    let shown: Vec<String> = names.by_ref().take(SHOWN).collect();
    let shown = shown.join(", ");
    match names.count() {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

/// The beginning of a name that a file gives.
fn shortened(name: &str) -> String {
    name.chars().filter(|c| !c.is_control()).take(80).collect()
}
