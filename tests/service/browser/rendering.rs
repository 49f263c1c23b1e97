//! What a textured asset looks like before and after it got another UV set, as three.js renders it.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::{places, textured_obj};

/// How far the pictures of each pair are apart.
fn compared(pairs: &[[PathBuf; 2]]) -> Vec<Value> {
    let renderer = places::repository("tests/render");
    let mut node = Command::new("node")
        .arg(renderer.join("compare.mjs"))
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("node runs");
    let mut list = node.stdin.take().expect("piped");
    for [before, after] in pairs {
        writeln!(list, "{}\t{}", before.display(), after.display()).expect("node reads");
    }
    drop(list);
    let output = node.wait_with_output().expect("node ends");
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    let answers = text.lines().map(serde_json::from_str);
    answers.collect::<Result<_, _>>().expect("JSON lines")
}

/// Unwraps an asset of the tests with these options and returns it and its result.
fn unwrapped(asset: &str, folder: &Path, options: &[&str]) -> [PathBuf; 2] {
    let input = places::asset(asset);
    let stem = input.file_stem().expect("a name").to_string_lossy();
    let output = folder.join(format!("{stem}{}.glb", options.concat()));
    unwrap(&input, &output, options);
    [input, output]
}

fn unwrap(input: &Path, output: &Path, options: &[&str]) {
    let status = Command::new(env!("CARGO_BIN_EXE_unwrapd"))
        .arg("unwrap")
        .args([input, Path::new("-o"), output])
        .args(options)
        .stdout(Stdio::null())
        .status()
        .expect("the binary runs");
    assert!(status.success(), "{}: {status}", input.display());
}

/// How far the pictures of an asset are apart where it is seen.
fn difference(answer: &Value) -> f64 {
    let number = |key: &str| answer[key].as_f64().unwrap_or_else(|| panic!("{answer}"));
    number("mean") / number("covered")
}

/// Resampled textures on new UVs look like the old ones on theirs: text, transforms, two UV sets, tangents.
#[test]
fn a_textured_asset_looks_the_same_with_resampled_textures() {
    let folder = tempfile::tempdir().expect("a folder");
    let textured = [
        "MultiUVTest.glb",
        "TextureTransformTest/TextureTransformTest.gltf",
    ];
    let pairs = textured.map(|asset| unwrapped(asset, folder.path(), &["--rebake"]));
    let compared = compared(&pairs);
    for answer in compared {
        assert!(difference(&answer) < 1.0, "{answer}");
    }
}

/// Not a pixel changes, unless the textures' own UVs are replaced: then the difference is seen.
#[test]
fn a_textured_asset_looks_the_same_with_another_uv_set() {
    let folder = tempfile::tempdir().expect("a folder");
    let textured = [
        "MultiUVTest.glb",
        "TextureTransformTest/TextureTransformTest.gltf",
    ];
    let mut pairs: Vec<[PathBuf; 2]> = textured
        .iter()
        .map(|asset| unwrapped(asset, folder.path(), &[]))
        .collect();
    pairs.push(unwrapped(textured[0], folder.path(), &["--overwrite"]));
    let compared = compared(&pairs);
    let number = |answer: &Value, key: &str| -> f64 {
        answer[key].as_f64().unwrap_or_else(|| panic!("{answer}"))
    };
    let (replaced, kept) = compared.split_last().expect("three answers");
    assert_eq!(kept.len(), textured.len());
    for answer in kept {
        // Both are full of text in colors: the textures are there.
        assert!(number(answer, "covered") > 0.1 && number(answer, "colors") > 1000.0);
        assert_eq!(number(answer, "max"), 0.0, "{answer}");
    }
    assert!(number(replaced, "mean") > 1.0, "{replaced}");
}

/// Materials and pictures of an OBJ file look the same in glTF, and on the new UVs of the OBJ file that comes of that.
#[test]
fn a_textured_obj_looks_the_same_through_gltf_and_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let [first, glb, baked, stale] = ["a", "b", "c", "d"].map(|name| folder.path().join(name));
    for made in [&glb, &baked, &stale] {
        std::fs::create_dir(made).expect("a folder");
    }
    let first = textured_obj::write(&first);
    let (glb, baked, stale) = (
        glb.join("house.glb"),
        baked.join("house.obj"),
        stale.join("house.obj"),
    );
    unwrap(&first, &glb, &[]);
    unwrap(&glb, &baked, &["--rebake", "--resolution", "2048"]);
    unwrap(&glb, &stale, &[]);
    let pairs = [&glb, &baked, &stale].map(|other| [first.clone(), other.clone()]);
    let compared = compared(&pairs);
    let db = |k: usize| compared[k]["db"].as_f64().unwrap_or(f64::INFINITY);
    assert!(
        compared
            .iter()
            .all(|answer| answer["colors"].as_u64() > Some(1000)),
        "{compared:?}"
    );
    // Edges of a checkerboard are resampled, and one picture is JPEG once more.
    assert!(db(0) > 40.0 && db(1) > 27.0, "{compared:?}");
    // Without new textures they sit wrongly, and that is seen.
    assert!(db(2) < 20.0, "{compared:?}");
}
