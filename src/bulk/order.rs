//! What a run does.

use std::io;

use super::asset::Asset;
use super::digest::Recipe;
use super::place::Place;
use super::scratch::Scratch;
use super::worker::Extra;
use unwrapd_pipeline::Options;

/// What a run does.
pub struct Order {
    /// The assets, of this shard only.
    pub assets: Vec<Asset>,
    /// Where outputs go.
    pub place: Place,
    /// Where they are made.
    pub scratch: Scratch,
    /// What is written beside outputs.
    pub extras: Vec<Extra>,
    /// Whether assets that failed for good are done again.
    pub retries: bool,
    /// Assets in work at once.
    pub concurrency: usize,
    pub(super) recipe: Recipe,
}

/// How a run came to a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// An earlier run did the work.
    Kept,
    /// This one did it.
    Done,
}

impl Order {
    /// One asset at a time, by a worker of this version.
    ///
    /// # Errors
    /// If the options cannot be written as JSON.
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
