//! Materials of OBJ files on the command line: files beside files, warnings, refusals.

use std::path::Path;

use crate::cli::{assert_status, unwrapd};
use crate::textured_obj;

/// Unwraps with exit 0 and returns the lines of standard error.
fn unwrap(input: &Path, output: &Path, options: &[&str]) -> String {
    let [input, output] = [input, output].map(|path| path.to_string_lossy().into_owned());
    let ran = unwrapd(&[&["unwrap", &*input, "-o", &*output], options].concat());
    assert_status(&ran, 0);
    String::from_utf8_lossy(&ran.stderr).into_owned()
}

#[test]
fn materials_and_pictures_go_to_gltf_and_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let [first, second, third] = ["a", "b", "c"].map(|name| folder.path().join(name));
    for made in [&second, &third] {
        std::fs::create_dir(made).expect("a folder");
    }
    let obj = textured_obj::write(&first);
    let glb = second.join("house.glb");
    let said = unwrap(&obj, &glb, &[]);
    assert!(said.contains("left out: map_ks (1)"), "{said}");
    assert!(!said.contains("not supplied"), "{said}");

    let back = third.join("house.obj");
    unwrap(&glb, &back, &["--rebake"]);
    let described = std::fs::read_to_string(third.join("house.mtl")).expect("a material file");
    let pictures: Vec<&str> = described
        .lines()
        .filter_map(|line| line.strip_prefix("map_Kd "))
        .collect();
    assert_eq!(pictures.len(), 2);
    assert!(
        pictures.iter().all(|name| third.join(name).is_file()),
        "{pictures:?}"
    );
    let text = std::fs::read_to_string(&back).expect("an OBJ file");
    for line in [
        "mtllib house.mtl",
        "o globe",
        "o red ball",
        "usemtl red paint",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}");
    }
    let back = back.to_string_lossy().into_owned();
    assert_status(&unwrapd(&["verify", &back, "--bijective"]), 0);

    // From OBJ to OBJ the textures sit wrongly: that is said, and new ones are refused.
    let other = third.join("other.obj");
    let said = unwrap(&obj, &other, &[]);
    assert!(said.contains("materials lid, wood"), "{said}");
    assert!(third.join("pictures/wood grain.png").is_file());
    let [obj, other] = [obj, other].map(|path| path.to_string_lossy().into_owned());
    assert_status(&unwrapd(&["unwrap", &obj, "-o", &other, "--rebake"]), 3);
}
