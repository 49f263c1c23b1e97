//! Documents whose surfaces are moved.
use crate::build::{Builder, parts};
use crate::documents::{gltf_files, options, reread, upload};
use crate::places;
use serde_json::{Value, json};
use std::path::Path;
use unwrapd_files::document::{Document, Layout, NewUvs, OutputFormat, SpaceMap, Upload, Written};

/// A quarter turn about z, exact in f32, and then a step along x.
struct QuarterTurn;

fn turned([x, y, z]: [f32; 3]) -> [f32; 3] {
    [0.0 - y, x, z]
}

fn moved([x, y, z]: [f32; 3]) -> [f32; 3] {
    [8.0 - y, x, z]
}

impl SpaceMap for QuarterTurn {
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]> {
        places.iter().map(|p| moved(*p)).collect()
    }

    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        assert_eq!(places.len(), normals.len());
        normals.iter().map(|n| turned(*n)).collect()
    }

    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]> {
        self.normals(places, tangents)
    }
}

fn write(document: &Document, format: OutputFormat) -> Written {
    let no_uvs = NewUvs {
        layout: Layout::Edited,
        v_axis: document.v_axis(),
        corners: vec![None; document.primitives().len()],
    };
    document.write(&no_uvs, &options(format)).unwrap()
}

fn floats(json: &Value, bin: &[u8], accessor: &Value) -> Vec<f32> {
    let accessor = &json["accessors"][accessor.as_u64().unwrap() as usize];
    assert_eq!(accessor["componentType"], 5126);
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    let length = view["byteLength"].as_u64().unwrap() as usize;
    let numbers = bin[start..start + length].as_chunks().0;
    numbers.iter().map(|&b| f32::from_le_bytes(b)).collect()
}

#[test]
fn only_positions_normals_and_tangents_change() {
    let builder = Builder::rich();
    let document = builder.document().moved(&QuarterTurn).unwrap();
    let written = write(&document, OutputFormat::Glb);
    let (json, bin) = parts(&written.files[0].1);
    let mut restored = json.clone();
    let attributes = &mut restored["meshes"][0]["primitives"][0]["attributes"];
    let old = &builder.json["meshes"][0]["primitives"][0]["attributes"];
    for name in ["POSITION", "NORMAL", "TANGENT"] {
        assert_ne!(attributes[name], old[name], "{name}");
        attributes[name] = old[name].clone();
    }
    for key in ["accessors", "bufferViews"] {
        let n_old = builder.json[key].as_array().unwrap().len();
        let entries = restored[key].as_array_mut().unwrap();
        assert_eq!(entries.len(), n_old + 3, "{key}");
        entries.truncate(n_old);
    }
    restored["buffers"] = builder.json["buffers"].clone();
    assert_eq!(restored, builder.json);
    assert_eq!(bin[..builder.bin.len()], builder.bin[..]);

    let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
    assert_eq!(
        floats(&json, &bin, &attributes["NORMAL"]),
        [0., 0., 1.].repeat(4)
    );
    assert_eq!(
        floats(&json, &bin, &attributes["TANGENT"]),
        [0., 1., 0., 1.].repeat(4)
    );
    let position = attributes["POSITION"].as_u64().unwrap() as usize;
    assert_eq!(json["accessors"][position]["min"], json!([7.0, 0.0, 0.0]));
    assert_eq!(json["accessors"][position]["max"], json!([8.0, 1.0, 0.0]));
}

#[test]
fn every_file_comes_back_moved() {
    assert_moved(&places::asset(""));
}

fn assert_moved(folder: &Path) {
    let mut n_files = 0;
    for path in gltf_files(folder) {
        let Ok(before) = Document::read(&upload(&path)) else {
            continue;
        };
        let expected: Vec<Vec<[f32; 3]>> = before
            .primitives()
            .iter()
            .map(|p| p.positions.iter().map(|p| moved(*p)).collect())
            .collect();
        let triangles: Vec<_> = before
            .primitives()
            .iter()
            .map(|p| p.triangles.clone())
            .collect();
        let after = reread(&write(
            &before.moved(&QuarterTurn).unwrap(),
            OutputFormat::Gltf,
        ));
        let found = after.primitives().iter();
        assert_eq!(
            found.clone().map(|p| &p.positions).collect::<Vec<_>>(),
            expected.iter().collect::<Vec<_>>(),
            "{}",
            path.display()
        );
        let found: Vec<_> = found.map(|p| p.triangles.clone()).collect();
        assert_eq!(found, triangles, "{}", path.display());
        n_files += 1;
    }
    assert!(n_files > 20, "{n_files}");
}

#[test]
fn a_moved_obj_text_keeps_all_but_its_positions_and_normals() {
    let text = "# head\nmtllib a.mtl\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 # second\nv 0 0 1\nv 1 1 1\n\
        vt 0 0\nvt 1 0\nvt 0 1\nvn 1 0 0\ng part\nusemtl red\n\
        f 1/1/1 2/2/1 3/3/1\nf -4/1 -2/3 -1/2\n";
    let document = Document::read(&Upload::single("a.obj", text.as_bytes().to_vec())).unwrap();
    let written = write(&document.moved(&QuarterTurn).unwrap(), OutputFormat::Obj);
    let expected = "# head\nmtllib a.mtl\nv 8 1 0 0.5 0.5 0.5\nv 7 0 0 # second\nv 8 0 1\nv 7 1 1\n\
        vt 0 0\nvt 1 0\nvt 0 1\ng part\nusemtl red\n\
        vn 0 1 0\nvn 0 1 0\nvn 0 1 0\nf 1/1/1 2/2/2 3/3/3\nf 1/1 3/3 4/2\n";
    assert_eq!(
        String::from_utf8(written.files[0].1.clone()).unwrap(),
        expected
    );
}

mod shared {
    use super::{assert_moved, places};

    #[test]
    #[ignore = "needs ../shared"]
    fn every_file_comes_back_moved() {
        assert_moved(&places::shared("data/gltf"));
    }
}
