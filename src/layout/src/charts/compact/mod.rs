//! Charts cut into pieces that fill their convex hulls better, so that an atlas becomes fuller.

pub(super) mod best_split;
mod chord;
mod clusters;
mod own_axes;
mod planes;
pub(super) mod split;
mod splitter;
