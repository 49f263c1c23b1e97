//! Jobs: states, queue, compute children and progress events.
//!
//! A job is a recorded request: input files, options, a state. It is queued once its record and its files are safely
//! stored. From then on it ends succeeded, failed with a cause, or cancelled, despite any crash or restart:
//!
//! ```text
//!          ┌── retried ───────────┐
//!          ▼                      │
//! queued ──claimed──► running ──► succeeded | failed | cancelled
//!    ▲                   │
//!    └── worker lost ────┘   (with a pause and a limit: see [`Rules`])
//! ```
//!
//! [`after`] is that picture as a function: it maps a record and an event to the next record. A worker holds a job
//! under a fencing token and a lease by the store's clock, which its heartbeats renew. Any process that finds an
//! expired lease requeues the job and raises the token. From then on, reports of the former worker are rejected, and
//! its files have names of their own. The four operations are the same for one process and for many: claim,
//! heartbeat, sweep, end.
//!
//! The worker itself computes nothing. Every attempt runs in a child process of the same program (`unwrapd compute`,
//! [`Program`]), which gets a folder with the input and writes its results there. A mesh that exhausts memory,
//! overflows a stack or finds a bug ends only its own attempt; memory goes back to the system; and a cancel always
//! works, because it is a signal. The child exits when its standard input closes, so a killed worker leaves no
//! orphans. A worker that cannot renew its lease in time ends its child and hands the job back. After an outage of
//! the store, workers get the time of a lease to do so before jobs are taken from them.
//!
//! A job whose input, options and engine equal those of an earlier one gets a copy of its result instead
//! (`output.rs`), unless the client refuses. Pictures of a result are drawn on first request (`pictures.rs`).
//!
//! A finished job is kept for a time ([`Settings::retention`]) and then removed with its files.
//!
//! Owners take turns, and priorities order the waiting jobs of each owner ([`JobStore::claim`]). A process reserves
//! one slot for small jobs, so that they do not wait for large ones.
//!
//! Every job belongs to an owner, and every lookup states its visibility ([`access`]).
//!
//! The storage of records and files is not decided here: [`JobStore`] and [`Blobs`] are traits.

pub mod access;
mod attempt;
mod child;
mod files;
mod handling;
mod inspection;
mod job;
pub mod meters;
mod output;
mod pictures;
mod queue;
mod retention;
mod runner;
mod running;
mod settings;
mod storage;
mod store_error;
mod submit;
mod timestamp;
mod transition;

pub use child::{Contained, Program, read_stderr, spawn};
pub use files::{Scratch, free_bytes};
pub use handling::{
    Digest, Gate, GateError, Gates, Handling, Metadata, MetadataError, Webhook, WebhookError,
};
pub use inspection::{Inspection, Loss, LostFile, adopt, inspect, purge, repair, shared_identity};
pub use job::{Event, Job, JobId, ProgressReport, Rules, SUSPECT, State, Token, WorkerId};
pub use pictures::Undrawn;
pub use queue::{Ended, Jobs, NextMaps, Subscription};
pub use settings::{Deployment, Settings};
pub use storage::{
    Blobs, Capacity, Census, Changed, Content, Enqueued, Heartbeat, IdempotencyKey, JobStore,
    Listing, Notice, Order, Outbox, OwnerQuota, OwnerQuotas, Quarantined, Queue, Reason, Share,
    StoreId, Sweep,
};
pub use store_error::{StoreError, StoreResult};
pub use submit::{Retried, Submission, SubmitError, Submitted, Usage, retry_failed};
pub use timestamp::{Steadiness, SteadyClock, Timestamp};
pub use transition::{Command, Ending, Refusal, Transition, after};
