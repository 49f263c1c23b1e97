//! Document readers: the first byte says which format, the rest is the file.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unwrapd::document::{Document, GroupBy, Upload, references};
use unwrapd::io::ElementFormat;

const NAMES: [&str; 9] = [
    "a.glb", "a.gltf", "a.obj", "a.off", "a.ply", "a.stl", "a.msh", "a.mesh", "a.tet",
];

fuzz_target!(|bytes: &[u8]| {
    let Some((&format, content)) = bytes.split_first() else {
        return;
    };
    let name = NAMES[usize::from(format) % NAMES.len()];
    // What is deformed is read in another way.
    if let Some(format) = ElementFormat::of_name(name) {
        let _ = format.read(content);
    }
    let upload = Upload::single(name, content.to_vec());
    let _ = references(&upload);
    if let Ok(document) = Document::read(&upload) {
        let _ = document.primitives_in_scene();
        for by in [GroupBy::Material, GroupBy::Mesh] {
            let _ = document.groups(by);
        }
        let _ = document.with_separate_meshes();
    }
});
