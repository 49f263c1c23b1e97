//! What is written drops what nothing names any more, and nothing else; written again it does not grow.

use crate::places;
use serde_json::{Value, json};
use unwrapd_files::document::{Document, OutputFormat, Upload};
use unwrapd_files::picture::Image;
use unwrapd_pipeline::{
    Baking, CommandOptions, ImageFormat, Options, Preset, Sets, Unobserved, unwrap_document,
};

use crate::build::{Builder, parts};
use crate::documents::{grid_uvs, new_uvs, options, reread};

const COLLECTIONS: [&str; 5] = ["accessors", "bufferViews", "images", "samplers", "textures"];

fn unwrapped(input: &Upload, options: &Options) -> Vec<u8> {
    let outcome = unwrap_document(input, options, &Unobserved).unwrap();
    outcome.files[0].1.clone()
}

/// How many UV sets and objects a file has, and its bytes.
fn size(glb: &[u8]) -> (usize, [usize; 5], usize) {
    let (json, _) = parts(glb);
    let meshes = json["meshes"].as_array().unwrap().iter();
    let primitives = meshes.flat_map(|mesh| mesh["primitives"].as_array().unwrap());
    let sets = primitives.flat_map(|p| p["attributes"].as_object().unwrap().keys());
    let n_sets = sets.filter(|name| name.starts_with("TEXCOORD_")).count();
    let lengths = COLLECTIONS.map(|key| json[key].as_array().map_or(0, Vec::len));
    (n_sets, lengths, glb.len())
}

#[test]
fn unwrapping_again_adds_nothing() {
    let lightmap = Options {
        preset: Preset::Lightmap,
        ..Options::default()
    };
    let asked = Options {
        sets: Sets {
            texcoord: Some(2),
            ..Sets::default()
        },
        ..Options::default()
    };
    let asset = |name: &str| Upload::single(name, std::fs::read(places::asset(name)).unwrap());
    for input in [
        Builder::rich().upload(),
        Builder::square().upload(),
        asset("Box.glb"),
        asset("MultiUVTest.glb"),
    ] {
        let options = [Options::default(), lightmap.clone(), asked.clone()];
        // Textures of the last one sample set 1, too.
        let n_options = if input.name == "MultiUVTest.glb" {
            1
        } else {
            3
        };
        for options in &options[..n_options] {
            let first = unwrapped(&input, options);
            let second = unwrapped(&Upload::single("a.glb", first.clone()), options);
            // Vertices that were split are joined before they are split anew.
            let (sets, lengths, bytes) = size(&first);
            let (sets_again, lengths_again, bytes_again) = size(&second);
            let name = &input.name;
            assert_eq!((sets, lengths), (sets_again, lengths_again), "{name}");
            // What stays where the input has it may begin anywhere; what is moved begins at a
            // multiple of four bytes.
            assert!(
                bytes_again <= bytes + 3 * lengths.iter().sum::<usize>(),
                "{name}"
            );
        }
    }
}

/// Squares with a vertex on its own at every corner, as if there were two of each: those are not made one.
#[test]
fn twins_of_the_input_stay_two() {
    let mut builder = Builder::new();
    let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]];
    let corners: Vec<f32> = [square, square]
        .iter()
        .flatten()
        .flat_map(|[x, y]| [*x, *y, 0.])
        .collect();
    let position = builder.floats("VEC3", 3, &corners);
    let bytes: Vec<u8> = [0u16, 1, 2, 4, 6, 7]
        .iter()
        .flat_map(|i| i.to_le_bytes())
        .collect();
    let indices = builder.accessor("SCALAR", 5123, 6, &bytes);
    builder.primitive(&json!({"attributes": {"POSITION": position}, "indices": indices}));
    let mut bytes = builder.glb();
    for _ in 0..2 {
        bytes = unwrapped(&Upload::single("a.glb", bytes), &Options::default());
        let document = Document::read(&Upload::single("a.glb", bytes.clone())).unwrap();
        assert_eq!(document.primitives()[0].positions.len(), 8);
    }
}

fn written(builder: &Builder) -> (Value, Vec<u8>) {
    let document = builder.document();
    let grid = grid_uvs(&document, 8, 1);
    let written = document
        .write(&new_uvs(&grid, 8), &options(OutputFormat::Glb))
        .unwrap();
    reread(&written);
    parts(&written.files[0].1)
}

#[test]
fn what_was_unused_before_stays() {
    let mut builder = Builder::square();
    let spare = builder.floats("SCALAR", 1, &[7., 8., 9.]);
    builder.json["images"] = json!([{"uri": "data:image/png;base64,iVBORw0KGgo="}]);
    builder.json["samplers"] = json!([{}]);
    let (json, bin) = written(&builder);
    assert_eq!(json["images"], builder.json["images"]);
    assert_eq!(json["samplers"], json!([{}]));
    let spare = &json["accessors"][spare];
    let view = &json["bufferViews"][spare["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(bin[start..start + 4], 7f32.to_le_bytes());
    // Positions and indices took the places of the old ones, the new UVs that of none.
    assert_eq!(json["accessors"].as_array().unwrap().len(), 4);
    assert_eq!(json["bufferViews"].as_array().unwrap().len(), 4);
}

/// An extension that nobody knows may name anything by its index: that stays, where it was.
#[test]
fn what_an_unknown_extension_may_name_stays_in_its_place() {
    let mut builder = Builder::square();
    let named = builder.floats("SCALAR", 1, &[1., 2.]);
    builder.json["extensions"] = json!({"ACME_table": {"columns": [{"values": named}]}});
    builder.json["extensionsUsed"] = json!(["ACME_table"]);
    let primitive = &mut builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["_OLD"] = json!(0);
    let (json, bin) = written(&builder);
    let accessor = &json["accessors"][named];
    assert_eq!(
        (&accessor["type"], &accessor["count"]),
        (&json!("SCALAR"), &json!(2))
    );
    let view = &json["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(bin[start..start + 4], 1f32.to_le_bytes());
    // Known ones are followed.
    builder.json["extensions"] = json!({});
    builder.json["nodes"] = json!([{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"_ID": named}}}}]);
    let (json, _) = written(&builder);
    let instancing = &json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"];
    let named = instancing["attributes"]["_ID"].as_u64().unwrap() as usize;
    assert_eq!(json["accessors"][named]["type"], "SCALAR");
}

/// Two accessors over views that share bytes.
#[test]
fn views_that_overlap_still_do() {
    let mut builder = Builder::square();
    let view = builder.view(&[0; 16]);
    builder.json["bufferViews"][view]["byteLength"] = json!(12);
    let offset = builder.json["bufferViews"][view]["byteOffset"]
        .as_u64()
        .unwrap();
    let views = builder.json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({"buffer": 0, "byteOffset": offset + 4, "byteLength": 12}));
    let (json, _) = written(&builder);
    let offset = |view: usize| json["bufferViews"][view]["byteOffset"].as_u64().unwrap();
    assert_eq!(offset(view) + 4, offset(view + 1));
}

fn textured(file: &[u8], mime: &str) -> Upload {
    let mut builder = Builder::square();
    let uvs = builder.floats("VEC2", 2, &[0., 0., 1., 0., 1., 1., 0., 1.]);
    let image = builder.view(file);
    let primitive = &mut builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = json!(uvs);
    primitive["material"] = json!(0);
    builder.json["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    builder.json["textures"] = json!([{"source": 0}]);
    builder.json["images"] = json!([{"bufferView": image, "mimeType": mime}]);
    builder.upload()
}

#[test]
fn resampled_textures_replace_the_old_ones_in_their_format() {
    let mut image = Image::transparent(16, 16);
    image.pixels.fill([200, 100, 50, 255]);
    let jpeg = image.jpeg().unwrap();
    let mut glass = image.clone();
    glass.pixels[0][3] = 0;
    assert!(glass.jpeg().is_none());
    for (file, mime, wanted, expected) in [
        (&jpeg, "image/jpeg", ImageFormat::Source, "image/jpeg"),
        (&jpeg, "image/jpeg", ImageFormat::Png, "image/png"),
        (&image.png(), "image/png", ImageFormat::Source, "image/png"),
        (&image.png(), "image/png", ImageFormat::Jpeg, "image/jpeg"),
        (&glass.png(), "image/png", ImageFormat::Jpeg, "image/png"),
    ] {
        let options = Options {
            baking: Baking {
                rebake: true,
                bake_size: Some(32),
                image_format: wanted,
                ..Baking::default()
            },
            ..Options::default()
        };
        let first = unwrapped(&textured(file, mime), &options);
        let (json, _) = parts(&first);
        assert_eq!(json["images"].as_array().unwrap().len(), 1);
        assert_eq!(json["textures"].as_array().unwrap().len(), 1);
        assert_eq!(json["images"][0]["mimeType"], expected);
        let second = unwrapped(&Upload::single("a.glb", first.clone()), &options);
        assert_eq!(size(&first).1, size(&second).1);
    }
    let error = Options {
        baking: Baking {
            image_format: ImageFormat::Png,
            ..Baking::default()
        },
        ..Options::default()
    };
    assert_eq!(error.check().unwrap_err().code(), "invalid_options");
}
