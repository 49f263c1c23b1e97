//! The trait of all sets of options.

use super::json::Object;

/// Options that are set together, with the groups that they consist of.
pub trait OptionSet: Sized {
    /// Checks every number against its range; the text names the option.
    fn check_ranges(&self) -> Result<(), String>;

    /// The names of all options, those of groups included.
    fn names() -> Vec<&'static str>;

    /// What is said of an option of this set, apart from those of its groups.
    fn about(name: &str) -> Option<&'static str>;

    /// Takes the options out of a JSON object; what is absent has its default.
    fn taken_from(given: &mut Object) -> Result<Self, String>;
}
