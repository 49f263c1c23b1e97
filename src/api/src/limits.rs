//! Limits of a computation, which its options cannot exceed.

use serde::{Deserialize, Serialize};

/// Limits set by the operator, beside the options of the user. Absent limits do not apply.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(default)]
pub struct Limits {
    /// Maximum number of triangles or tetrahedra; larger documents are refused.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<u64>,
    /// Maximum number of threads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<usize>,
    /// Time limit in seconds. When it is reached, the current valid map becomes the result.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}
