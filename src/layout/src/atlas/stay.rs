//! What stays where it is, and why charts cannot be packed around it.
use super::{AtlasError, ChartMap};
use thiserror::Error;

/// A chart that stays where it is.
#[derive(Clone, Copy, Debug)]
pub struct Stay<'a> {
    /// Its map, of which the unit is the longer side of a page and the origin the lower left corner of the first.
    pub map: ChartMap<'a>,
    /// What it is a part of: parts of one island keep no distance.
    pub island: usize,
}

/// Why charts cannot be packed around others.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AroundError {
    /// One that stays leaves the page that its middle is on, or all pages.
    #[error("island {island} leaves its page")]
    OffPage {
        /// The island.
        island: usize,
    },
    /// Two that stay are nearer than the padding, or overlap.
    #[error("islands {} and {} are {texels} texels apart", islands[0], islands[1])]
    TooNear {
        /// Both.
        islands: [usize; 2],
        /// Their distance; 0 where they overlap.
        texels: f64,
    },
    /// The others do not fit around those that stay.
    #[error("the other charts do not fit")]
    NoRoom,
    /// The charts cannot be placed at all.
    #[error(transparent)]
    Atlas(#[from] AtlasError),
}
