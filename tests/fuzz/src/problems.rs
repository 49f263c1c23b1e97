//! Problem files, with a mesh of two triangles.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unwrapd::deform::ProblemFile;
use unwrapd::io::ElementFormat;

const MESH: &[u8] = b"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

fuzz_target!(|json: &[u8]| {
    let Ok(file) = ProblemFile::parse(json) else {
        return;
    };
    let _ = file.references().count();
    let mesh = ElementFormat::of_name("a.off")
        .expect("a format")
        .read(MESH)
        .expect("a mesh");
    let _ = file.with(mesh, None);
});
