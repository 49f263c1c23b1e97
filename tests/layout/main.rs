//! Tests of the layout.
mod atlas;
mod charts;
mod constraints;
#[path = "../support/disks.rs"]
#[allow(dead_code)]
mod disks;
#[path = "../support/few_vertices.rs"]
mod few_vertices;
mod gluing;
#[path = "../support/layouts.rs"]
#[allow(dead_code)]
mod layouts;
mod live;
mod needles;
mod optima;
mod own_axes;
mod pages;
mod panels;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
mod properties;
mod redrawn;
mod search;
mod straighten;
mod unfolding;
#[path = "../support/uv_meshes.rs"]
#[allow(dead_code)]
mod uv_meshes;
#[path = "../support/zoo.rs"]
#[allow(dead_code)]
mod zoo;
