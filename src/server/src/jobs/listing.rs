//! Which jobs a list has, and in which order.

use serde::Deserialize;

use super::access::Owner;
use super::job::JobId;
use super::metadata::Metadata;
use super::state::State;
use super::timestamp::Timestamp;
use unwrapd_api::Kind;

/// Which jobs to list. What is absent does not matter.
#[derive(Clone, Debug, Default)]
pub struct Listing {
    /// Only those in this state.
    pub state: Option<State>,
    /// Only those of this kind.
    pub kind: Option<Kind>,
    /// Only those of this owner.
    pub owner: Option<Owner>,
    /// Only those whose metadata has all of these members.
    pub metadata: Metadata,
    /// Only those accepted at this time or later.
    pub since: Option<Timestamp>,
    /// Only those accepted before this time.
    pub until: Option<Timestamp>,
    /// Which comes first.
    pub order: Order,
    /// Only those that come after this one.
    pub after: Option<JobId>,
    /// At most so many.
    pub limit: u32,
}

/// Which of two jobs comes first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, utoipa::ToSchema)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// The later one.
    #[default]
    NewestFirst,
    /// The earlier one.
    OldestFirst,
}
