//! The server: jobs, their store, live sessions, webhooks, the HTTP interface and its page.
//!
//! | module | contents |
//! |---|---|
//! | [`jobs`] | jobs, their states and queue; compute children, from outside |
//! | [`store`] | records in SQLite or PostgreSQL, files in a folder or S3 |
//! | [`sessions`] | bodies, pictures and UVs pulled live: messages in, frames out, each in a child process |
//! | [`webhooks`] | notification of others when jobs end |
//! | [`http`] | routes, problems, OpenAPI, the page |
//!
//! The server accepts, records and relays; it computes nothing and does not contain the code that does. Facts about
//! computations, such as their options and schemas, come from a [`Catalog`](unwrapd_api::Catalog).

pub mod http;
pub mod jobs;
pub mod sessions;
pub mod store;
pub mod webhooks;
