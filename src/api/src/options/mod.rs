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
mod json;
#[cfg(feature = "schema")]
mod typed;

pub use crate::options;
pub use json::{Object, OptionSet, Ranged, deserialized, taken, within};
#[cfg(feature = "schema")]
pub use typed::{WordOrText, as_typed, help_of, typed};
