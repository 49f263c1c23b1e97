//! The server: jobs, their store, live sessions, webhooks, the HTTP interface and its page.
//!
//! | module | contents |
//! |---|---|
//! | [`jobs`] | what a job is, its states, its queue; children that compute, from outside |
//! | [`store`] | records in SQLite or PostgreSQL, files in a folder or S3 |
//! | [`sessions`] | bodies, pictures and UVs pulled live: messages in, frames out, each in a child process |
//! | [`webhooks`] | ends of jobs, told to others |
//! | [`http`] | routes, problems, OpenAPI, the page |
//!
//! It accepts, records and relays; it computes nothing and does not contain the code that does. What it must know of computations, such
//! as their options and schemas, it asks of a [`Catalog`](unwrapd_api::Catalog).

pub mod http;
pub mod jobs;
pub mod sessions;
pub mod store;
pub mod webhooks;
