//! The trait of all sets of options.

use serde_json::{Map, Value};

/// A JSON object of options.
pub type Object = Map<String, Value>;

/// A set of options, with the groups that it consists of.
pub trait OptionSet: Sized {
    /// Checks every number against its range. The error names the option.
    fn check_ranges(&self) -> Result<(), String>;

    /// Returns the names of all options, including those of groups.
    fn names() -> Vec<&'static str>;

    /// Returns the text of an option of this set, not of its groups.
    fn about(name: &str) -> Option<&'static str>;

    /// Removes the options from a JSON object; absent options have their defaults.
    fn taken_from(given: &mut Object) -> Result<Self, String>;
}
