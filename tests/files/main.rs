//! Tests of the files.
mod bake;
#[path = "../support/build.rs"]
#[allow(dead_code)]
mod build;
mod document;
#[path = "../support/documents.rs"]
#[allow(dead_code)]
mod documents;
mod elements;
mod io;
mod obj_document;
mod obj_materials;
mod picture;
#[path = "../places.rs"]
#[allow(dead_code)]
mod places;
mod polygon;
#[path = "../support/simple_polygons.rs"]
#[allow(dead_code)]
mod simple_polygons;
mod thumbnail;
