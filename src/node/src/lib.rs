//! The native part of the npm package `unwrapd`: typed arrays, bytes and JSON in and out of the library.
//!
//! What JavaScript users see is written in JavaScript, beside this crate; it hands over arrays of the types that are named
//! here and options as JSON objects, as the service takes them. Errors are values, which it throws.

#![allow(
    clippy::needless_pass_by_value,
    reason = "what JavaScript hands over belongs to the call"
)]

pub mod call;
pub mod files;
pub mod meshes;
pub mod options;
