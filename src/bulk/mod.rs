//! Processing of many files by one command, without a queue of our own.
//!
//! A run is a stateless task over a list of assets, or over one shard of it, so that any launcher of processes can
//! drive it: a shell, HyperQueue, Ray, Slurm, a Kubernetes Indexed Job. Its state lies beside the outputs:
//!
//! - **Complete or absent.** A file is written under another name, synced, and renamed into place, the main output
//!   last.
//! - **Nothing twice.** After its files an asset gets a [`AssetRecord`] in `DIR/.unwrapd`, which contains the digest of
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
//! The work itself is done by a [`Worker`]: a child process ([`LocalWorker`]), or a service ([`RemoteWorker`]).

mod assets;
mod place;
mod record;
mod remote;
mod rows;
mod run;
mod shard;
mod worker;

pub use assets::{Asset, FolderListing, ListError, assets_in, assets_of};
pub use place::{MOST_BYTES, OutputFolder, read_bounded, read_regular};
pub use record::AssetRecord;
pub use remote::{RemoteError, RemoteWorker};
pub use rows::{AssetStatus, Figures, SummaryRow, Totals, csv};
pub use run::{Fate, RunOrder, RunScratch, Seen, recorded, run};
pub use shard::{Shard, ShardChoice, ShardError, array_variable};
pub use worker::{AssetTask, Extra, LocalWorker, Worker};
