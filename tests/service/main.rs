//! Tests of the binary: as a command and, in `server`, as a service.

mod access;
mod benches;
mod browser;
mod bulk;
mod certified;
mod cli;
mod cli_options;
mod cli_outputs;
mod cli_streams;
mod cluster;
mod contract;
mod deforming;
mod deployment;
mod estimates;
mod examples;
mod figures;
#[path = "../harness/mod.rs"]
#[expect(dead_code, reason = "some is for the benchmark")]
mod harness;
mod losses;
mod materials;
mod meshes;
mod openapi;
mod pages;
#[path = "../places.rs"]
mod places;
mod server;
mod split;
mod textured_obj;
mod timestamp;
