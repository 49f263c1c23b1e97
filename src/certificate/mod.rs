//! Exact judgement of written UVs.
