//! Options, each declared once.
//!
//! An option has a name, a type, a default, a range and a text. It is declared in one line of an `options!` block, with
//! the text above it. Everything else is derived from that declaration:
//!
//! - the field of a struct, with its default and the check of its range;
//! - the member of a JSON object and of a query;
//! - the schema in the OpenAPI document, and with it the form of the page;
//! - the option of the command line, and its help.
//!
//! Options that several commands share form a group, a struct of its own. The options of a command are its groups and
//! its own options.
//!
//! A text refers to other options in backticks and in snake case, as in `seam_weight`; the command line shows them as
//! they are typed there. Its first paragraph is the help of `-h`. The words of an option are the variants of an enum
//! in kebab case, for the command line and for JSON.
//!
//! Dependencies between options are not declared here: their owners check them.

mod declare;
mod range;

pub use crate::options;
pub use range::Ranged;
pub use range::within;

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

mod json;

pub use json::Object;
pub use json::{deserialized, taken};

#[cfg(feature = "schema")]
mod typed;
#[cfg(feature = "schema")]
mod word_or_text;

#[cfg(feature = "schema")]
pub use typed::{as_typed, help_of, typed};
#[cfg(feature = "schema")]
pub use word_or_text::WordOrText;
