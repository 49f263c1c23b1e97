//! A valid start for every disk, and its optimization.
//!
//! A map of a disk is locally injective if no triangle is flipped or empty. [`parameterize()`] finds such a start
//! ([`start()`]), scales it to its best size and minimizes an energy with a barrier from there; the solver never leaves
//! the maps without flips, so the result is one too. Sizes mean the same everywhere because every chart is first scaled
//! to a mean triangle area of 1 ([`rest_shapes`]), and faces without area get a rest shape that can be mapped.
//!
//! The start is Tutte's: holes closed by virtual faces, the boundary on a circle. The theorem holds in exact
//! arithmetic, so every triangle is checked with an exact predicate. If floating point breaks it, or the surface has
//! long arms or is large, the start is found coarse to fine: vertices are collapsed and put back level by level, each
//! level optimized. A disk that lies in a plane starts as it lies.
//!
//! Invariant: every map that leaves this module is positive in every triangle by
//! [`orient2d_sign`](unwrapd_method::numerics::predicates::orient2d_sign), unless the caller asked for no barrier. Maps
//! may still overlap themselves globally; that is not checked here.
mod aligned;
mod decimate;
mod hierarchy;
mod parameterize;
mod problem;
mod rest;
mod star;
mod triangulation;
mod tutte;

pub use aligned::aligned;
pub use decimate::Simplification;
pub use parameterize::{
    InvalidStart, hierarchical_start, optimize, parameterize, start, tutte_start,
};
pub use problem::{Embedding, Options, Pins, default_beta, map_term};
pub use rest::{RestShapes, is_needle, rest_shapes};
pub use star::{Corners, Star};
pub use tutte::is_positive;
