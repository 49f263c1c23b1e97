//! The server's knowledge of computations that it does not contain.

use std::collections::BTreeSet;
use std::fmt::Debug;

use serde_json::Value;
#[cfg(feature = "schema")]
use utoipa::openapi::{RefOr, Schema};

use crate::{Content, Failure, Format, Kind, Upload};

/// Rejection of options.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedOptions {
    /// Code and message.
    pub failure: Failure,
    /// Column of the error in a formula, from 1.
    pub column: Option<usize>,
}

/// Catalog of computations: their options, their reports, the files that they read. A server asks it instead of
/// linking the code that computes.
pub trait Catalog: Debug + Send + Sync {
    /// Checks the options of a kind, as far as possible without the file, and completes them with defaults.
    ///
    /// # Errors
    /// Fails if an option is unknown, has a wrong type or is out of range.
    fn complete(&self, kind: Kind, options: Value) -> Result<Value, RefusedOptions>;

    /// Returns the format of a file of `size` bytes that is read for `content`, from its first bytes `head`;
    /// [`SEARCHED_BYTES`](crate::SEARCHED_BYTES) of them suffice.
    fn format(&self, head: &[u8], size: u64, content: Content) -> Option<Format>;

    /// Returns the paths that the main file, and the material files beside it, refer to.
    fn references(&self, upload: &Upload) -> BTreeSet<String>;

    /// Returns the format of the main file as a surface.
    fn format_of(&self, upload: &Upload) -> Option<Format>;

    /// Returns the schemas of all options and reports, with those that they refer to.
    #[cfg(feature = "schema")]
    fn schemas(&self) -> Vec<(String, RefOr<Schema>)>;
}
