//! The list of jobs.

use axum::extract::State;
use axum::http::StatusCode;
use axum::response::Response;
use serde::{Deserialize, Serialize};

use super::app::{Shared, json};
use super::extract::Parameters;
use super::handling::metadata;
use super::jobs::view;
use super::problem::{Code, Problem};
use super::view::JobPage;
use crate::jobs::access::{Caller, Owner};
use crate::jobs::{JobId, Listing, Metadata, Order, State as JobState, Timestamp};
use unwrapd_api::Kind;

/// Default and maximum number of jobs per page, by convention. The OpenAPI document repeats them. Larger pages mean
/// fewer requests but slower responses.
const DEFAULT_PAGE: u32 = 50;
const MAX_PAGE: u32 = 200;

/// Query for a list of jobs.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct ListQuery {
    /// Only jobs in this state.
    state: Option<JobState>,
    /// Only jobs of this kind.
    kind: Option<Kind>,
    /// Only jobs of this owner; empty for those made without a key.
    owner: Option<String>,
    /// Only jobs whose metadata has these members with these values, as a JSON object.
    metadata: Option<String>,
    /// Only jobs accepted at this time or later.
    #[param(format = "date-time")]
    created_from: Option<String>,
    /// Only jobs accepted before this time.
    #[param(format = "date-time")]
    created_before: Option<String>,
    /// Which jobs come first; the default is `newest_first`.
    order: Option<Order>,
    /// Maximum number of jobs; the default is 50.
    #[param(minimum = 1, maximum = 200)]
    limit: Option<u32>,
    /// `next` of the previous page.
    #[param(format = "uuid")]
    cursor: Option<String>,
}

/// Query for failed jobs to try again.
#[derive(Deserialize, utoipa::IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(super) struct RetryQuery {
    /// Only jobs that failed with this code, such as `worker_lost`.
    code: Option<String>,
    /// Only jobs of this kind.
    kind: Option<Kind>,
    /// Only jobs of this owner; empty for those made without a key.
    owner: Option<String>,
    /// Only jobs whose metadata has these members with these values, as a JSON object.
    metadata: Option<String>,
    /// Only jobs accepted at this time or later.
    #[param(format = "date-time")]
    created_from: Option<String>,
    /// Only jobs accepted before this time.
    #[param(format = "date-time")]
    created_before: Option<String>,
    /// `next` of the previous answer.
    #[param(format = "uuid")]
    cursor: Option<String>,
}

/// Failed jobs that are queued again.
#[derive(Serialize, utoipa::ToSchema)]
pub(super) struct RetriedJobs {
    /// Number of jobs.
    retried: usize,
    /// Their ids, the oldest first.
    #[schema(value_type = Vec<String>)]
    jobs: Vec<JobId>,
    /// The `cursor` that goes on after them, if there may be more.
    #[schema(value_type = Option<String>)]
    next: Option<JobId>,
}

impl ListQuery {
    /// Returns the listing for the query, with one job more than a page has.
    fn listing(self, limit: u32) -> Result<Listing, Problem> {
        if !(1..=MAX_PAGE).contains(&limit) {
            return Err(invalid(format!("`limit` must be between 1 and {MAX_PAGE}")));
        }
        let cursor = self.cursor.map(|cursor| cursor.parse()).transpose();
        let owner = self.owner.map(|owner| match owner.as_str() {
            "" => Ok(Owner::default()),
            name => name.parse(),
        });
        let owner = owner.transpose();
        Ok(Listing {
            state: self.state,
            kind: self.kind,
            owner: owner.map_err(|error| invalid(format!("`owner`: {error}")))?,
            metadata: self
                .metadata
                .map_or_else(|| Ok(Metadata::default()), |text| metadata(&text))?,
            since: time("created_from", self.created_from)?,
            until: time("created_before", self.created_before)?,
            order: self.order.unwrap_or_default(),
            after: cursor.map_err(|_| invalid("`cursor` is not the `next` of a page"))?,
            limit: limit + 1,
        })
    }
}

fn invalid(detail: impl Into<String>) -> Problem {
    Problem::new(Code::InvalidRequest, detail)
}

/// Parses a time in RFC 3339.
fn time(name: &str, text: Option<String>) -> Result<Option<Timestamp>, Problem> {
    let parsed = text
        .map(|text| humantime::parse_rfc3339_weak(&text))
        .transpose();
    let parsed = parsed.map_err(|error| {
        invalid(format!(
            "`{name}` is no time such as 2026-12-31T23:59:59Z: {error}"
        ))
    })?;
    Ok(parsed.map(Timestamp::from))
}

/// List jobs, with filters.
///
/// All filters must be met. A page has the `cursor` of the next one, which needs the same filters
/// and the same order.
#[utoipa::path(
    get, path = "/v1/jobs", operation_id = "listJobs", tag = "jobs", params(ListQuery),
    responses(
        (status = 200, description = "A page of jobs", body = JobPage),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn list_jobs(
    State(app): Shared,
    caller: Caller,
    Parameters(query): Parameters<ListQuery>,
) -> Result<Response, Problem> {
    let limit = query.limit.unwrap_or(DEFAULT_PAGE);
    let listing = query.listing(limit)?;
    let mut jobs = app.jobs.list(&caller.visibility(), &listing).await?;
    let is_last = jobs.len() <= limit as usize;
    jobs.truncate(limit as usize);
    let next = jobs
        .last()
        .filter(|_| !is_last)
        .map(|job| job.id.to_string());
    let jobs = jobs.iter().map(|job| view(&app, job)).collect();
    Ok(json(StatusCode::OK, &JobPage { jobs, next }))
}

/// Try failed jobs again, with filters.
///
/// All filters must be met. Each job is queued with its input and its options, under the same id, as
/// by `POST /v1/jobs/{id}/retry`. One call tries up to 1000 jobs, the oldest first; `next` is the
/// `cursor` for more. Repeating a call is harmless: jobs that have not failed are left alone.
#[utoipa::path(
    post, path = "/v1/jobs/retry", operation_id = "retryJobs", tag = "jobs", params(RetryQuery),
    responses(
        (status = 202, description = "The jobs that are queued again", body = RetriedJobs),
        (status = 400, description = "`invalid_request`", body = Problem, content_type = "application/problem+json"),
    )
)]
pub(super) async fn retry_jobs(
    State(app): Shared,
    caller: Caller,
    Parameters(query): Parameters<RetryQuery>,
) -> Result<Response, Problem> {
    // Translate the query to that of a list of failed jobs.
    let code = query.code.clone();
    let query = ListQuery {
        state: None,
        kind: query.kind,
        owner: query.owner,
        metadata: query.metadata,
        created_from: query.created_from,
        created_before: query.created_before,
        order: None,
        limit: None,
        cursor: query.cursor,
    };
    let listing = query.listing(DEFAULT_PAGE)?;
    // Requeue them.
    let retried = app
        .jobs
        .retry_failed(&caller.visibility(), listing, code.as_deref())
        .await?;
    let jobs: Vec<JobId> = retried.jobs.iter().map(|job| job.id).collect();
    let answer = RetriedJobs {
        retried: jobs.len(),
        jobs,
        next: retried.next,
    };
    Ok(json(StatusCode::ACCEPTED, &answer))
}
