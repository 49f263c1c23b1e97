//! The meshes of a file and their UV sets.
//!
//! `cargo run --release --example inspect FILE`

use unwrapd_api::Upload;
use unwrapd_files::document::Document;

fn main() {
    let Some(input) = std::env::args().nth(1) else {
        eprintln!("usage: inspect FILE");
        return;
    };
    let bytes = std::fs::read(&input).expect("a file");
    let document = Document::read(&Upload::single(input, bytes)).expect("a mesh");
    for warning in document.warnings() {
        println!("{}: {}", warning.code, warning.message);
    }
    for (number, primitive) in document.primitives().iter().enumerate() {
        let mapped = document.corner_uvs(number, 0).expect("readable UVs");
        println!(
            "primitive {number}: {} triangles, {}",
            primitive.triangles.len(),
            if mapped.is_some() {
                "with UVs"
            } else {
                "without UVs"
            }
        );
    }
}
