//! Processing of many files by one command, without a queue of our own.
//!
//! A run is a stateless task over a list of assets, or over one shard of it, so that any launcher of processes can
//! drive it: a shell, HyperQueue, Ray, Slurm, a Kubernetes Indexed Job. Its state lies beside the outputs:
//!
//! - **Complete or absent.** A file is written under another name, synced, and renamed into place, the main output
//!   last.
//! - **Nothing twice.** After its files an asset gets a [`Record`] in `DIR/.unwrapd`, which contains the digest of
//!   input, options and version. A run keeps assets that have a record of their digest and all their files. A kill
//!   between the files and the record costs that asset's time again, and changes nothing.
//! - **No coordination.** Each asset has a record of its own, so shards share nothing. Two processes that do the same
//!   asset write the same bytes.
//! - **One bad mesh is one row.** Assets are computed in child processes with limits, like the jobs of the service.
//!   Every failure of one becomes a row of the summary with its code.
//!
//! The summary is made from the rows of a run, including kept ones. So a run without a shard after all shards does
//! what is missing and summarizes everything.
//!
//! The work itself is done by a [`Worker`]: a child process ([`Local`]), or a service ([`Remote`]).

mod asset;
mod folder;
mod list_error;
mod local;
mod manifest;
mod one;
mod order;
mod place;
mod record;
mod regular;
mod remote;
mod row;
mod run;
mod shard;
mod summary;
mod trouble;
mod worker;

pub use asset::Asset;
pub use folder::{Listing, assets_in};
pub use list_error::ListError;
pub use local::Local;
pub use manifest::assets_of;
pub use order::Scratch;
pub use order::{Fate, Order};
pub use place::Place;
pub use record::Record;
pub use regular::{MOST_BYTES, read_bounded, read_regular};
pub use remote::{Remote, RemoteError};
pub use row::{Figures, Row, Status};
pub use run::{Seen, recorded, run};
pub use shard::{Shard, ShardChoice, ShardError, array_variable};
pub use summary::{Totals, csv};
pub use worker::{Extra, Task, Worker};
