//! What a server must know of computations without doing any.

use std::collections::BTreeSet;
use std::fmt::Debug;

use serde_json::Value;
#[cfg(feature = "schema")]
use utoipa::openapi::{RefOr, Schema};

use crate::{Content, Failure, Format, Kind, Upload};

/// Options that are refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RefusedOptions {
    /// The code and the sentence.
    pub failure: Failure,
    /// The column of a formula that is wrong, from 1.
    pub column: Option<usize>,
}

/// The kinds of computations: their options, their reports, the files that they read. A server asks this instead of the code that
/// computes, and so does not contain it.
pub trait Catalog: Debug + Send + Sync {
    /// Checks the options of a kind, as far as that is possible without the file, and completes them with defaults.
    ///
    /// # Errors
    /// If an option is unknown, of a wrong type or out of its range.
    fn complete(&self, kind: Kind, options: Value) -> Result<Value, RefusedOptions>;

    /// Returns the format of a file of `size` bytes that is read for `content`, by its first bytes, of which
    /// [`SEARCHED_BYTES`](crate::SEARCHED_BYTES) suffice.
    fn format(&self, head: &[u8], size: u64, content: Content) -> Option<Format>;

    /// Returns the paths that the main file, and the material files beside it, refer to.
    fn references(&self, upload: &Upload) -> BTreeSet<String>;

    /// Returns the format of the main file as a surface.
    fn format_of(&self, upload: &Upload) -> Option<Format>;

    /// Returns the schemas of all options and reports, with those that they refer to.
    #[cfg(feature = "schema")]
    fn schemas(&self) -> Vec<(String, RefOr<Schema>)>;
}
