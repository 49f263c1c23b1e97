//! What a job is, its states, its queue, the compute child and progress events.
//!
//! A job is a recorded request: input files, options, a state. It is queued when its record and its files are safely
//! stored. From then on it ends succeeded, failed with a cause, or cancelled, despite any crash or restart:
//!
//! ```text
//! queued ──claim──► running ──► succeeded | failed | cancelled
//!    ▲                 │
//!    └── server lost ──┘   (a new attempt, at most three lost ones)
//! ```
//!
//! The server itself computes nothing. Every attempt runs in a child process of the same binary (`unwrapd compute`),
//! which gets a folder with the input and writes its results there. A mesh that exhausts memory, overflows a stack or
//! finds a bug ends its own attempt; memory goes back to the system; a cancel always works, because it is a signal.
//! The child ends when its standard input closes, so a killed server leaves no orphans; each attempt has its own
//! folder and its own number, and what an outdated attempt reports changes no record.
//!
//! A job that has ended is kept for a time ([`Settings::retention`]) and then removed with its files.
//!
//! Where records, files and events live is not decided here: [`JobStore`], [`Blobs`] and [`Events`] are traits.

mod attempt;
mod capacity;
mod child;
pub mod compute;
mod contained;
mod control;
mod deadline;
mod events;
mod frames;
mod job;
mod keys;
mod pace;
mod progress;
mod queue;
mod reporter;
mod retention;
mod runner;
mod settings;
mod space;
mod state;
mod storage;
mod store_error;
mod submit;
mod subscription;
mod task;
mod timestamp;
mod work;

pub use capacity::Usage;
pub use contained::Contained;
pub use events::LocalEvents;
pub use job::{Failure, InputFile, Job, JobId, Kind, OutputFile, Verdict};
pub use pace::Pace;
pub use progress::{Event, Progress, next_attempt_seq};
pub use queue::{Ended, Jobs};
pub use settings::Settings;
pub use space::free_bytes;
pub use state::State;
pub use storage::{Blobs, Capacity, Enqueued, Events, IdempotencyKey, JobStore, Listing, Wish};
pub use store_error::{StoreError, StoreResult};
pub use submit::{Submission, SubmitError, Submitted};
pub use subscription::Subscription;
pub use task::{Pictures, output_file};
pub use timestamp::Timestamp;
pub use work::Work;
