//! Tests of the geometry library.
#[cfg(feature = "files")]
mod array_meshes;
mod atlas;
#[cfg(feature = "files")]
mod bake;
mod barrier;
mod bijective;
mod bodies;
mod box_tree;
mod cage;
#[cfg(feature = "files")]
mod caged;
mod cells;
mod certificate;
mod charts;
mod cholesky;
mod circles;
mod clearance;
mod coarse_cage;
mod creases;
mod crossings;
mod cut;
mod deform;
mod disk;
mod disks;
#[cfg(feature = "files")]
mod document;
mod dragged;
#[cfg(feature = "files")]
mod early_end;
mod elements;
mod elsewhere;
mod embed;
mod energy;
mod formula;
mod given_back;
mod given_seams;
mod handles;
#[cfg(feature = "files")]
mod io;
#[cfg(feature = "files")]
mod islands;
mod layers;
mod layouts;
mod left_out;
mod measure;
mod mesh;
mod more_pages;
mod not_given_back;
mod numerics;
#[cfg(feature = "files")]
mod obj_document;
#[cfg(feature = "files")]
mod obj_materials;
#[cfg(feature = "files")]
mod obj_pipeline;
mod once;
#[cfg(feature = "files")]
mod outline;
mod own_axes;
mod own_energy;
mod packing_mode;
mod pages;
#[cfg(feature = "files")]
mod picture;
#[cfg(feature = "files")]
mod picture_warp;
mod pins;
mod pipeline;
#[path = "../places.rs"]
mod places;
mod plane;
#[cfg(feature = "files")]
mod polygon;
mod potential;
#[cfg(feature = "files")]
mod problem_files;
mod progress;
mod pulled;
mod random;
mod redrawn;
mod rough;
mod searched;
mod separation;
mod session;
mod session_model;
#[cfg(feature = "files")]
mod simple_polygons;
mod simplification;
mod solver;
mod symmetry;
mod taylor;
mod terms;
mod texture_mapping;
mod threads;
#[cfg(feature = "files")]
mod thumbnail;
mod turns;
mod unfolding;
mod units;
mod untangle;
#[cfg(feature = "files")]
mod unwrapped_polygons;
mod uv_editing;
mod uv_meshes;
mod uv_session;
#[cfg(feature = "files")]
mod warp;
mod ways;
mod zoo;
