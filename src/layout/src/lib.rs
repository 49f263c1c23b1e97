//! Cuts surfaces into charts and packs the charts into an atlas: arrays in, atlas out.
//!
//! | module | contents |
//! |---|---|
//! | [`charts`] | where to cut: surfaces divided and mapped, charts split where their maps overlap or are distorted |
//! | [`atlas`] | orientation, packing, pages, rounding to the integer grid |

pub mod atlas;
pub mod charts;
