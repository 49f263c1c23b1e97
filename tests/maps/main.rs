//! Tests of the maps.
mod box_tree;
mod certificate;
mod crossings;
mod cut;
mod disk;
#[path = "../support/disks.rs"]
#[allow(dead_code)]
mod disks;
mod embed;
#[path = "../support/few_vertices.rs"]
mod few_vertices;
mod islands;
mod measure;
mod mesh;
mod once;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
mod plane;
#[path = "../support/random.rs"]
#[allow(dead_code)]
mod random;
mod separation;
mod simplification;
mod stacks;
#[path = "../support/taylor.rs"]
#[allow(dead_code)]
mod taylor;
#[path = "../support/uv_meshes.rs"]
#[allow(dead_code)]
mod uv_meshes;
#[path = "../support/zoo.rs"]
#[allow(dead_code)]
mod zoo;
