//! Tests of the pipeline.
mod array_meshes;
#[path = "../support/build.rs"]
#[allow(dead_code)]
mod build;
mod caged;
mod clearance;
mod control;
mod cuts_for_fill;
mod document;
#[path = "../support/documents.rs"]
#[allow(dead_code)]
mod documents;
mod early_end;
mod given_seams;
mod islands;
mod live_islands;
mod more_pages;
mod needles;
mod obj_pipeline;
mod packing_mode;
mod pins;
mod pipeline;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
mod progress;
#[path = "../support/random.rs"]
#[allow(dead_code)]
mod random;
mod rough;
#[path = "../support/simple_polygons.rs"]
#[allow(dead_code)]
mod simple_polygons;
mod stacks;
mod straighten;
mod symmetry;
mod untangle;
mod unwrapped_polygons;
#[path = "../support/uv_meshes.rs"]
#[allow(dead_code)]
mod uv_meshes;
mod whole_polygons;
#[path = "../support/zoo.rs"]
#[allow(dead_code)]
mod zoo;
