//! The native part of the npm package `unwrapd`: typed arrays, bytes and JSON in and out of the library.
//!
//! The public interface is written in JavaScript, beside this crate. It passes arrays of the types declared here, and
//! options as JSON objects in the format of the service. Errors are returned as values, which the JavaScript throws.

#![allow(
    clippy::needless_pass_by_value,
    reason = "what JavaScript hands over belongs to the call"
)]

pub mod call;
pub mod files;
pub mod meshes;
pub mod options;
