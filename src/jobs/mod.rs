//! What a job is, its queue, its compute child.
