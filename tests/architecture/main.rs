//! Tests of the structure of the sources.
mod circles;
mod layers;
mod left_out;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
