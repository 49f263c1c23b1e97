//! Settings of a run.

use std::io;

use super::asset::Asset;
use super::digest::Recipe;
use super::place::Place;
use super::scratch::Scratch;
use super::worker::Extra;
use unwrapd_pipeline::Options;

/// Settings of a run.
pub struct Order {
    /// Assets of this shard.
    pub assets: Vec<Asset>,
    /// Output folder.
    pub place: Place,
    /// Folder for temporary files.
    pub scratch: Scratch,
    /// Files to write beside outputs.
    pub extras: Vec<Extra>,
    /// Set to retry assets that failed permanently.
    pub retries: bool,
    /// Maximum number of assets in progress.
    pub concurrency: usize,
    pub(super) recipe: Recipe,
}

/// Origin of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// An earlier run did the work.
    Kept,
    /// This run did the work.
    Done,
}

impl Order {
    /// Creates a run of one asset at a time, by a worker of this version.
    ///
    /// # Errors
    /// Fails if the scratch folder cannot be created, or the options cannot be written as JSON.
    pub fn new(
        assets: Vec<Asset>,
        place: Place,
        version: &str,
        options: &Options,
        extras: Vec<Extra>,
    ) -> io::Result<Self> {
        Ok(Self {
            assets,
            place,
            scratch: Scratch::new()?,
            recipe: Recipe::new(version, options, &extras)?,
            extras,
            retries: false,
            concurrency: 1,
        })
    }
}
