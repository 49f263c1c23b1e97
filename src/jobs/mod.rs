//! What a job is, its queue, its compute child.

pub mod compute;
