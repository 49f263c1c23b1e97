//! Filter and order of job lists.

use serde::Deserialize;

use super::access::Owner;
use super::job::JobId;
use super::metadata::Metadata;
use super::state::State;
use super::timestamp::Timestamp;
use unwrapd_api::Kind;

/// Filter, order and page of a job list. Absent filters match everything.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// State to match.
    pub state: Option<State>,
    /// Kind to match.
    pub kind: Option<Kind>,
    /// Owner to match.
    pub owner: Option<Owner>,
    /// Metadata members that must all match.
    pub metadata: Metadata,
    /// Earliest time of acceptance.
    pub since: Option<Timestamp>,
    /// Time before which jobs were accepted.
    pub until: Option<Timestamp>,
    /// Order of the list.
    pub order: Order,
    /// Job after which the page starts.
    pub after: Option<JobId>,
    /// Maximum number of jobs.
    pub limit: u32,
}

/// Order of jobs: the one of two jobs that comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// The later one.
    #[default]
    NewestFirst,
    /// The earlier one.
    OldestFirst,
}
