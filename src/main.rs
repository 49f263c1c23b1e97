//! The `unwrapd` binary.
fn main() {}
