//! Tests of deformation.
mod bijective;
#[path = "../support/bodies.rs"]
#[allow(dead_code)]
mod bodies;
mod cage;
mod cells;
mod coarse_cage;
mod deform;
mod dragged;
mod elsewhere;
mod feasibility;
mod handles;
mod harmonic_start;
mod lines;
mod outline;
mod own_energy;
mod picture_warp;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
mod potential;
mod problem_files;
#[path = "../support/pulled.rs"]
#[allow(dead_code)]
mod pulled;
#[path = "../support/random.rs"]
#[allow(dead_code)]
mod random;
mod regions;
mod searched;
mod session;
mod session_model;
#[path = "../support/taylor.rs"]
#[allow(dead_code)]
mod taylor;
#[path = "../support/terms.rs"]
#[allow(dead_code)]
mod terms;
mod texture_mapping;
mod thin;
mod threads;
mod turns;
mod units;
mod untangle;
mod uv_editing;
#[path = "../support/uv_meshes.rs"]
#[allow(dead_code)]
mod uv_meshes;
mod uv_session;
mod warp;
mod ways;
#[path = "../support/zoo.rs"]
#[allow(dead_code)]
mod zoo;
