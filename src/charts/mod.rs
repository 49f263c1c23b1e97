//! Where to cut.
