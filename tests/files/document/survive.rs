//! What nobody asked to change is still there.
use crate::build::{Builder, parts};
use crate::documents::{gltf_files, grid_uvs, new_uvs, options, upload};
use crate::places;
use serde_json::{Value, json};
use std::path::Path;
use unwrapd_files::document::{Document, OutputFormat};

/// Members that a new UV set may change, and members that decompression may.
const CHANGES: [&str; 5] = ["accessors", "bufferViews", "buffers", "meshes", "images"];

#[test]
fn a_split_copies_every_attribute_byte_for_byte() {
    let builder = Builder::rich();
    let document = builder.document();
    let grid = vec![vec![
        [[0, 0], [8, 0], [8, 8]],
        [[16, 16], [24, 24], [16, 24]],
    ]];
    let written = document
        .write(&new_uvs(&grid, 5), &options(OutputFormat::Glb))
        .unwrap();
    let (json, bin) = parts(&written.files[0].1);
    let note = &written.notes.primitives[0];
    assert_eq!(
        (note.vertices_before, note.vertices_after, note.texcoord),
        (4, 6, 1)
    );
    let old = &builder.json["meshes"][0]["primitives"][0];
    let new = &json["meshes"][0]["primitives"][0];
    let keys =
        |object: &Value| -> Vec<String> { object.as_object().unwrap().keys().cloned().collect() };
    assert_eq!(keys(&new["attributes"])[..8], keys(&old["attributes"])[..]);
    for name in keys(&old["attributes"]) {
        let before = elements(&builder.json, &builder.bin, &old["attributes"][&name]);
        let after = elements(&json, &bin, &new["attributes"][&name]);
        assert_eq!(after[..4], before[..], "{name}");
        assert_eq!(after[4..], [before[0].clone(), before[2].clone()], "{name}");
        let member = |json: &Value, index: &Value, key: &str| {
            json["accessors"][index.as_u64().unwrap() as usize][key].clone()
        };
        for key in ["componentType", "type", "normalized"] {
            assert_eq!(
                member(&json, &new["attributes"][&name], key),
                member(&builder.json, &old["attributes"][&name], key)
            );
        }
    }
    // The sparse morph target is written dense: displacements of vertices 1 and 3, none at the copies.
    let target = &json["accessors"][new["targets"][0]["POSITION"].as_u64().unwrap() as usize];
    assert_eq!(target["sparse"], Value::Null);
    assert_eq!(
        (&target["count"], &target["max"]),
        (&json!(6), &json!([0, 0, 7]))
    );
    let deltas = elements(&json, &bin, &new["targets"][0]["POSITION"]);
    let z = |v: usize| f32::from_le_bytes(deltas[v][8..].try_into().unwrap());
    assert_eq!([0, 1, 2, 3, 4, 5].map(z), [0., 5., 0., 7., 0., 0.]);
    assert_eq!(new["extras"], old["extras"]);
}

/// The bytes of every element of an accessor with a view.
fn elements(json: &Value, bin: &[u8], index: &Value) -> Vec<Vec<u8>> {
    let accessor = &json["accessors"][index.as_u64().unwrap() as usize];
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let width = match accessor["type"].as_str().unwrap() {
        "SCALAR" => 1,
        kind => kind[3..].parse::<usize>().unwrap(),
    };
    let size = match accessor["componentType"].as_u64().unwrap() {
        5120 | 5121 => 1,
        5122 | 5123 => 2,
        _ => 4,
    } * width;
    let stride = view["byteStride"]
        .as_u64()
        .map_or(size, |stride| stride as usize);
    assert_eq!(stride % 4, 0, "glTF demands aligned vertices");
    let start =
        view["byteOffset"].as_u64().unwrap_or(0) + accessor["byteOffset"].as_u64().unwrap_or(0);
    let count = accessor["count"].as_u64().unwrap() as usize;
    (0..count)
        .map(|i| bin[start as usize + i * stride..][..size].to_vec())
        .collect()
}

#[test]
fn everything_else_is_equal() {
    let builder = Builder::rich();
    let document = builder.document();
    let grid = grid_uvs(&document, 8, 1);
    let written = document
        .write(&new_uvs(&grid, 8), &options(OutputFormat::Glb))
        .unwrap();
    let (json, bin) = parts(&written.files[0].1);
    assert_kept((&builder.json, &builder.bin), (&json, &bin));
    assert_eq!(json["meshes"][1], builder.json["meshes"][1]);
    for key in ["weights", "extensions"] {
        assert_eq!(json["meshes"][0][key], builder.json["meshes"][0][key]);
    }
}

/// Accessors of the rich document that only its triangles name: their indices and morph target, which are written anew.
const REPLACED: [usize; 2] = [1, 9];

/// Old members unchanged in their old order, accessors that are still named unchanged in their places, with their bytes.
fn assert_kept(before: (&Value, &[u8]), after: (&Value, &[u8])) {
    let members = |json: &Value| json.as_object().unwrap().clone();
    let (old, new) = (members(before.0), members(after.0));
    let kept: Vec<&String> = new.keys().filter(|key| old.contains_key(*key)).collect();
    assert_eq!(kept, old.keys().collect::<Vec<_>>());
    for (key, value) in &old {
        if key != "accessors" && key != "bufferViews" && !CHANGES.contains(&key.as_str()) {
            assert_eq!(&new[key], value, "{key}");
        }
    }
    for (index, accessor) in old["accessors"].as_array().unwrap().iter().enumerate() {
        if REPLACED.contains(&index) {
            continue;
        }
        assert_eq!(&new["accessors"][index], accessor);
        let view = accessor["bufferView"].as_u64().unwrap() as usize;
        let bytes = |(json, bin): (&Value, &[u8])| {
            let number = |key: &str| json["bufferViews"][view][key].as_u64().unwrap() as usize;
            let start = number("byteOffset");
            bin[start..start + number("byteLength")].to_vec()
        };
        assert_eq!(bytes(after), bytes(before));
    }
}

/// The extensions in a list that do not belong to what is rewritten.
fn lasting(names: &Value) -> Vec<&Value> {
    const REWRITTEN: [&str; 4] = [
        "KHR_draco_mesh_compression",
        "EXT_meshopt_compression",
        "KHR_meshopt_compression",
        "EXT_mesh_manifold",
    ];
    let names = names.as_array().unwrap().iter();
    names
        .filter(|name| !REWRITTEN.contains(&name.as_str().unwrap()))
        .collect()
}

#[test]
fn real_files_keep_all_but_their_uvs() {
    assert_all_but_uvs_kept(&places::asset(""));
}

fn assert_all_but_uvs_kept(folder: &Path) {
    for path in gltf_files(folder) {
        let upload = upload(&path);
        let Ok(document) = Document::read(&upload) else {
            continue;
        };
        let json: Value = match path.extension().unwrap().to_str() {
            Some("glb") => parts(&upload.bytes).0,
            _ => serde_json::from_slice(&upload.bytes).unwrap(),
        };
        let grid = grid_uvs(&document, 10, 3);
        let written = document
            .write(&new_uvs(&grid, 10), &options(OutputFormat::Glb))
            .unwrap();
        let (after, _) = parts(&written.files[0].1);
        for (key, value) in json.as_object().unwrap() {
            let after = after.get(key).cloned().unwrap_or(json!([]));
            if key.starts_with("extensions") && value.is_array() {
                assert_eq!(lasting(&after), lasting(value), "{}: {key}", path.display());
            } else if !CHANGES.contains(&key.as_str()) {
                assert_eq!(&after, value, "{}: {key}", path.display());
            }
        }
    }
}

#[test]
fn unsplit_primitives_keep_their_accessors() {
    let builder = Builder::rich();
    let document = builder.document();
    let grid = grid_uvs(&document, 8, usize::MAX);
    // Face 0 is a multiple of every period, so its corners are made those of its vertices.
    let face = document.primitives()[0].triangles[1];
    let mut grid = grid;
    grid[0][0] = [grid[0][1][0], [3, 3], grid[0][1][1]];
    assert_eq!(face, [0, 2, 3]);
    let written = document
        .write(&new_uvs(&grid, 8), &options(OutputFormat::Glb))
        .unwrap();
    let (json, _) = parts(&written.files[0].1);
    let old = &builder.json["meshes"][0]["primitives"][0];
    let mut new = json["meshes"][0]["primitives"][0].clone();
    new["attributes"]
        .as_object_mut()
        .unwrap()
        .shift_remove("TEXCOORD_1");
    assert_eq!(&new, old);
}

#[test]
fn images_follow_the_document() {
    let mut builder = Builder::rich();
    builder.json["images"] = json!([{"uri": "tex/a%20b.png"}, {"uri": "gone.png"}]);
    let mut upload = builder.upload();
    let png = b"\x89PNG\r\n\x1a\n....".to_vec();
    upload
        .resources
        .insert("tex/a b.png".to_owned(), png.clone());
    let document = Document::read(&upload).unwrap();
    let grid = grid_uvs(&document, 8, 1);
    let written = document
        .write(&new_uvs(&grid, 8), &options(OutputFormat::Glb))
        .unwrap();
    let (json, bin) = parts(&written.files[0].1);
    let image = &json["images"][0];
    assert_eq!(
        (&image["uri"], &image["mimeType"]),
        (&Value::Null, &json!("image/png"))
    );
    let view = &json["bufferViews"][image["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(bin[start..start + png.len()], png);
    assert_eq!(json["images"][1]["uri"], "gone.png");
    assert!(
        written
            .notes
            .warnings
            .iter()
            .any(|warning| warning.message.contains("gone.png"))
    );
    let written = document
        .write(&new_uvs(&grid, 8), &options(OutputFormat::Gltf))
        .unwrap();
    let names: Vec<&str> = written.files.iter().map(|file| file.0.as_str()).collect();
    assert_eq!(names, ["out put.gltf", "out put.bin", "tex/a b.png"]);
    let json: Value = serde_json::from_slice(&written.files[0].1).unwrap();
    assert_eq!(json["buffers"][0]["uri"], "out%20put.bin");
    assert_eq!(json["images"][0]["uri"], "tex/a%20b.png");
}

/// Two triangles over one array of positions: each gets the three vertices that it uses.
#[test]
fn shared_accessors_are_shared_out() {
    let mut builder = Builder::square();
    let first = builder.accessor("SCALAR", 5123, 3, &[0, 0, 1, 0, 2, 0]);
    let second = builder.accessor("SCALAR", 5123, 3, &[3, 0, 0, 0, 2, 0]);
    builder.json["accessors"][0]["min"] = json!([0, 0, 0]);
    builder.json["accessors"][0]["max"] = json!([1, 1, 0]);
    let primitive = |indices| json!({"attributes": {"POSITION": 0}, "indices": indices, "mode": 5});
    builder.json["meshes"] = json!([{"primitives": [primitive(first), primitive(second)]}]);
    let document = builder.document();
    let primitives = document.primitives();
    assert_eq!(primitives[1].triangles, [[2, 0, 1]]);
    assert_eq!(
        primitives[1].positions,
        [[0., 0., 0.], [1., 1., 0.], [0., 1., 0.]]
    );
    let grid = vec![
        vec![[[0, 0], [9, 0], [0, 9]]],
        vec![[[8, 8], [4, 8], [8, 4]]],
    ];
    let written = document
        .write(&new_uvs(&grid, 5), &options(OutputFormat::Glb))
        .unwrap();
    let back = crate::documents::reread(&written);
    assert_eq!(back.primitives(), primitives);
    assert_eq!(
        back.corner_uvs(1, 0).unwrap().unwrap(),
        [[[0.25, 0.75], [0.125, 0.75], [0.25, 0.875]]]
    );
    let (json, _) = parts(&written.files[0].1);
    let second = &json["meshes"][0]["primitives"][1];
    assert_eq!(second["mode"], 5);
    let position = &json["accessors"][second["attributes"]["POSITION"].as_u64().unwrap() as usize];
    assert_eq!(
        (&position["count"], &position["min"], &position["max"]),
        (&json!(3), &json!([0.0, 0.0, 0.0]), &json!([1.0, 1.0, 0.0]))
    );
    // Three of each; nothing names the shared ones any more, and the indices of the square nothing named before.
    assert_eq!(json["accessors"].as_array().unwrap().len(), 7);
}

mod shared {
    use super::{assert_all_but_uvs_kept, places};

    #[test]
    #[ignore = "needs ../shared"]
    fn real_files_keep_all_but_their_uvs() {
        assert_all_but_uvs_kept(&places::shared("data/gltf"));
    }
}
