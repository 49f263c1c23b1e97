//! Tests of the service: a real server on a free port, with its data in a folder that goes with it.

mod applications;
mod bad_inputs;
mod benches;
mod certified;
mod cli;
mod deforming;
mod failures;
mod jobs;
mod meshes;
mod openapi;
mod page;
mod pages;
#[path = "../places.rs"]
mod places;
mod progress;
mod rendering;
mod requests;
mod restarts;
mod results;
mod retention;
mod server;
mod split;
mod synchronous;
mod timestamp;
mod verdicts;
