//! Materials that become one, with their textures drawn on one atlas.

use base64::Engine as _;
use serde_json::{Value, json};
use unwrapd_files::document::{Document, Marked, OutputFormat, Upload, Written};
use unwrapd_files::picture::Image;
use unwrapd_pipeline::{Baking, Options, Outcome, PipelineError, Unobserved, unwrap_document};

use crate::build::{Builder, parts};

const BASE: &str = "/pbrMetallicRoughness/baseColorTexture";
const SURFACE: &str = "/pbrMetallicRoughness/metallicRoughnessTexture";
/// Error of a value that is rounded to 8 bits twice, in the steepest part of the sRGB curve.
const ROUNDING: f64 = 1.5 * 2.3 / 255.0;

/// One mesh with a unit square for each of these materials, side by side along x, and a texture for each color.
fn squares(materials: &[Value], colors: &[[u8; 4]]) -> Builder {
    let mut builder = Builder::new();
    let mut primitives = Vec::new();
    for k in 0..materials.len() {
        let x = k as f32;
        let corners = [x, 0., 0., x + 1., 0., 0., x + 1., 1., 0., x, 1., 0.];
        let position = builder.floats("VEC3", 3, &corners);
        let uvs = builder.floats("VEC2", 2, &[0., 0., 1., 0., 1., 1., 0., 1.]);
        let normals = builder.floats("VEC3", 3, &[0., 0., 1.].repeat(4));
        let bytes = [0u16, 1, 2, 0, 2, 3].map(u16::to_le_bytes).concat();
        let indices = builder.accessor("SCALAR", 5123, 6, &bytes);
        primitives.push(json!({
            "attributes": {"POSITION": position, "TEXCOORD_0": uvs, "NORMAL": normals},
            "indices": indices,
            "material": k,
        }));
    }
    let textures = (0..colors.len()).map(|source| json!({"source": source}));
    let images = colors.iter().map(|&color| {
        let mut image = Image::transparent(4, 4);
        image.pixels.fill(color);
        let file = base64::engine::general_purpose::STANDARD.encode(image.png());
        json!({"uri": format!("data:image/png;base64,{file}")})
    });
    builder.json["images"] = images.collect();
    builder.json["textures"] = textures.collect();
    builder.json["materials"] = json!(materials);
    builder.json["meshes"] = json!([{ "primitives": primitives }]);
    builder.json["nodes"] = json!([{"mesh": 0}, {"mesh": 0}]);
    builder
}

fn options(merges: &[&str]) -> Options {
    Options {
        merge_materials: merges.iter().map(|merge| merge.parse().unwrap()).collect(),
        baking: Baking {
            bake_size: Some(64),
            ..Baking::default()
        },
        ..Options::default()
    }
}

fn merged(builder: &Builder, merges: &[&str]) -> Outcome {
    unwrap_document(&builder.upload(), &options(merges), &Unobserved).unwrap()
}

/// Values that the written file shows at the center of each of its faces, with x of the center.
fn shown(outcome: &Outcome, slot: &str, is_color: bool) -> Vec<(f64, [f64; 4])> {
    let (json, bin) = parts(&outcome.files[0].1);
    let index = |value: &Value| value.as_u64().unwrap() as usize;
    let document = Document::read(&Upload::single("a.glb", outcome.files[0].1.clone())).unwrap();
    let mut all = Vec::new();
    for (number, primitive) in document.primitives().iter().enumerate() {
        let info = json["materials"][primitive.material.unwrap()].pointer(slot);
        let texture = &json["textures"][index(&info.unwrap()["index"])];
        let view = &json["images"][index(&texture["source"])]["bufferView"];
        let view = &json["bufferViews"][index(view)];
        let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        let image = Image::decode(&bin[start..start + index(&view["byteLength"])]).unwrap();
        let uvs = document.corner_uvs(number, 0).unwrap().unwrap();
        for (face, uvs) in primitive.triangles.iter().zip(uvs) {
            let mean = |k: usize| (0..3).map(|c| uvs[c][k]).sum::<f64>() / 3.0;
            let [x, y] = [mean(0) * image.width as f64, mean(1) * image.height as f64];
            let texel = image.pixels[y as usize * image.width + x as usize];
            let value = texel.map(|code| f64::from(code) / 255.0);
            let [r, g, b, a] = value;
            let value = if is_color {
                [linear(r), linear(g), linear(b), a]
            } else {
                value
            };
            let x = face
                .iter()
                .map(|&v| f64::from(primitive.positions[v as usize][0]));
            all.push((x.sum::<f64>() / 3.0, value));
        }
    }
    all
}

fn linear(c: f64) -> f64 {
    if c <= 0.04045 {
        c / 12.92
    } else {
        ((c + 0.055) / 1.055).powf(2.4)
    }
}

/// Checks what each square shows: two faces each, in `channels`, times factors of the written material.
#[track_caller]
fn check(shown: &[(f64, [f64; 4])], factor: [f64; 4], wanted: &[[f64; 4]], channels: &[usize]) {
    assert_eq!(shown.len(), 2 * wanted.len());
    for (x, value) in shown {
        let wanted = wanted[x.floor() as usize];
        for &k in channels {
            let value = factor[k] * value[k];
            assert!(
                (value - wanted[k]).abs() < ROUNDING * factor[k].max(1.0),
                "{x} {k}: {value} {wanted:?}"
            );
        }
    }
}

fn factor<const N: usize>(material: &Value, pointer: &str) -> [f64; N] {
    std::array::from_fn(|k| {
        material
            .pointer(pointer)
            .map_or(1.0, |f| f[k].as_f64().unwrap())
    })
}

#[test]
fn factors_and_textures_become_one_texture() {
    let red = json!({"name": "red", "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0}, "baseColorFactor": [0.5, 0.5, 0.5, 1]}});
    let plain =
        json!({"name": "plain", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.8, 0.3]}});
    let white = json!({"extras": {"a": 1}});
    let outcome = merged(
        &squares(&[red, plain, white], &[[255, 0, 0, 255]]),
        &["all"],
    );
    assert!(outcome.report.certified && !outcome.report.partly_done);
    let (json, _) = parts(&outcome.files[0].1);
    let materials = json["materials"].as_array().unwrap();
    assert_eq!(
        (materials.len(), &materials[0]["name"]),
        (1, &json!("merged"))
    );
    assert_eq!(materials[0].get("extras"), None);
    assert_eq!(json["images"].as_array().unwrap().len(), 1);
    assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 1);
    let factor = factor(&materials[0], "/pbrMetallicRoughness/baseColorFactor");
    let wanted = [[0.5, 0., 0., 1.], [0.2, 0.4, 0.8, 1.], [1.; 4]];
    check(&shown(&outcome, BASE, true), factor, &wanted, &[0, 1, 2, 3]);
    // The report says so; the mesh is shown twice.
    let note = outcome.report.written.unwrap().merged.unwrap();
    assert_eq!(note.materials[0].replaces, ["red", "plain", "material 2"]);
    assert_eq!((note.materials[0].material, note.apart.len()), (0, 0));
    assert_eq!((note.draw_calls_before, note.draw_calls_after), (6, 2));
}

/// Occlusion, roughness and metalness are one texture, since no material takes them from two.
#[test]
fn all_other_factors_are_drawn_too() {
    let emissive = |factor: f64, strength: f64| {
        json!({
            "emissiveFactor": [factor, 0, 0],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": strength}},
        })
    };
    let mut a = emissive(0.5, 8.0);
    a["pbrMetallicRoughness"] =
        json!({"metallicRoughnessTexture": {"index": 0}, "roughnessFactor": 0.5});
    a["occlusionTexture"] = json!({"index": 0, "strength": 0.5});
    a["normalTexture"] = json!({"index": 1, "scale": 0.5});
    let mut b = emissive(0.25, 4.0);
    b["pbrMetallicRoughness"] = json!({"roughnessFactor": 0.25, "metallicFactor": 0});
    let mut c = json!({"occlusionTexture": {"index": 0}});
    c["normalTexture"] = json!({"index": 1});
    // The normal of the map is (0.6, 0, 0.8).
    let mut builder = squares(&[a, b, c], &[[51, 102, 204, 255], [204, 128, 230, 255]]);
    builder.json["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
    let outcome = merged(&builder, &["all"]);
    assert!(outcome.report.certified);
    let (json, _) = parts(&outcome.files[0].1);
    let material = &json["materials"][0];
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);

    let model = &material["pbrMetallicRoughness"];
    assert_eq!(
        material["occlusionTexture"],
        model["metallicRoughnessTexture"]
    );
    let number = |name: &str| model[name].as_f64().unwrap_or(1.0);
    let factor = [
        1.0,
        number("roughnessFactor"),
        number("metallicFactor"),
        1.0,
    ];
    let wanted = [[0.6, 0.2, 0.8, 1.], [1., 0.25, 0., 1.], [0.2, 1., 1., 1.]];
    check(
        &shown(&outcome, SURFACE, false),
        factor,
        &wanted,
        &[0, 1, 2],
    );

    let strength =
        material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].as_f64();
    assert_eq!(
        (strength, &material["emissiveFactor"]),
        (Some(4.0), &json!([1.0, 0.0, 0.0]))
    );
    let wanted = [[4., 0., 0., 1.], [1., 0., 0., 1.], [0., 0., 0., 1.]];
    check(
        &shown(&outcome, "/emissiveTexture", true),
        [4.0, 0., 0., 1.],
        &wanted,
        &[0, 1, 2],
    );

    // Tangents may have turned; the angle to the surface stays: tan is 0.75, half of it at scale 0.5.
    let scale = material["normalTexture"]["scale"].as_f64().unwrap_or(1.0);
    for (x, [r, g, b, _]) in shown(&outcome, "/normalTexture", false) {
        let [r, g, b] = [r, g, b].map(|c| 2.0 * c - 1.0);
        let slope = scale * r.hypot(g) / b;
        let wanted = [0.375, 0.0, 0.75][x.floor() as usize];
        assert!((slope - wanted).abs() < 0.02, "{x}: {slope}");
    }
    assert!(json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"].is_u64());
}

/// Factors that all share, and equal materials without textures, need no new texture.
#[test]
fn equal_factors_stay_factors() {
    let steel = json!({"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 0.5, 1], "roughnessFactor": 0.3}});
    let outcome = merged(&squares(&[steel.clone(), steel.clone()], &[]), &["all"]);
    let (json, _) = parts(&outcome.files[0].1);
    assert_eq!(
        json.get("images")
            .map_or(0, |images| images.as_array().unwrap().len()),
        0
    );
    assert_eq!(
        json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"],
        0.3
    );
    let codes: Vec<_> = outcome
        .report
        .warnings
        .iter()
        .map(|w| w.code.as_ref())
        .collect();
    assert!(!codes.contains(&"nothing_to_resample"), "{codes:?}");
}

#[test]
fn what_disagrees_stays_apart_and_is_named() {
    let color = |name: &str, r: f64| json!({"name": name, "pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let with = |name: &str, key: &str, value: Value| {
        let mut material = color(name, 0.5);
        material[key] = value;
        material
    };
    let materials = [
        color("a", 0.1),
        with("glass", "alphaMode", json!("BLEND")),
        color("b", 0.2),
        with("leaf", "doubleSided", json!(true)),
        with(
            "car",
            "extensions",
            json!({"KHR_materials_clearcoat": {"clearcoatFactor": 1}}),
        ),
        color("lamp", 0.3),
        color("shoe", 0.4),
        with(
            "hair",
            "extensions",
            json!({"KHR_materials_anisotropy": {"anisotropyStrength": 1}}),
        ),
        with("fur", "normalTexture", json!({"index": 0})),
    ];
    let mut builder = squares(&materials, &[]);
    builder.json["images"] = json!([{"uri": "data:image/webp;base64,UklGRgAAAABXRUJQ"}]);
    builder.json["textures"] = json!([{"source": 0}]);
    builder.json["meshes"][0]["primitives"][6]["extensions"] =
        json!({"KHR_materials_variants": {"mappings": [{"material": 6, "variants": [0]}]}});
    builder.json["extensions"] = json!({"KHR_materials_variants": {"variants": [{"name": "v"}]}});
    let output = builder.floats("VEC4", 4, &[1.0; 8]);
    let input = builder.floats("SCALAR", 1, &[0., 1.]);
    let pointer = "/materials/5/pbrMetallicRoughness/baseColorFactor";
    builder.json["animations"] = json!([{"samplers": [{"input": input, "output": output}], "channels": [{"sampler": 0,
        "target": {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}}]}]);
    let outcome = merged(&builder, &["all"]);
    assert!(outcome.report.certified);
    let note = outcome.report.written.unwrap().merged.unwrap();
    assert_eq!(note.materials.len(), 1);
    assert_eq!(note.materials[0].replaces, ["a", "b"]);
    let reason = |name: &str| {
        let apart = note.apart.iter().find(|apart| apart.name == name);
        apart.map_or("", |apart| apart.reason.as_str())
    };
    for (name, word) in [
        ("glass", "alphaMode"),
        ("leaf", "doubleSided"),
        ("car", "KHR_materials_clearcoat"),
        ("lamp", "animated"),
        ("shoe", "variant"),
        ("hair", "anisotropic"),
        ("fur", "normalTexture"),
    ] {
        assert!(reason(name).contains(word), "{name}: {}", reason(name));
        let warned = |w: &unwrapd_files::document::Warning| {
            w.code == "materials_apart" && w.message.contains(name) && w.message.contains(word)
        };
        assert!(outcome.report.warnings.iter().any(warned), "{name}");
    }
    // Two materials are one, so the others have moved, and all that names them with them.
    let (json, _) = parts(&outcome.files[0].1);
    let named = |value: &Value| json["materials"][value.as_u64().unwrap() as usize]["name"].clone();
    assert_eq!(json["materials"].as_array().unwrap().len(), 8);
    let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
    let names: Vec<Value> = primitives.iter().map(|p| named(&p["material"])).collect();
    assert_eq!(
        names,
        [
            "merged", "glass", "leaf", "car", "lamp", "shoe", "hair", "fur"
        ]
    );
    let mapping = primitives[5].pointer("/extensions/KHR_materials_variants/mappings/0/material");
    assert_eq!(named(mapping.unwrap()), "shoe");
    let target = &json["animations"][0]["channels"][0]["target"];
    let pointer = target["extensions"]["KHR_animation_pointer"]["pointer"]
        .as_str()
        .unwrap();
    let lamp: usize = pointer.split('/').nth(2).unwrap().parse().unwrap();
    assert_eq!(json["materials"][lamp]["name"], "lamp");
}

/// Parts that were not neighbors are joined all the same; UVs, record and densities are still those of the faces.
#[test]
fn parts_need_not_be_neighbors() {
    let color = |r: f64| json!({"pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let mut glass = color(1.0);
    (glass["alphaMode"], glass["name"]) = (json!("BLEND"), json!("glass"));
    let builder = squares(&[color(0.25), glass, color(0.75)], &[]);
    let mut options = options(&["all"]);
    options.group_by = Some(unwrapd_files::document::GroupBy::Scene);
    options.texel_weight = vec!["glass=2".parse().unwrap()];
    let outcome = unwrap_document(&builder.upload(), &options, &Unobserved).unwrap();
    assert!(outcome.report.certified);
    let upload = Upload::single("a.glb", outcome.files[0].1.clone());
    let document = Document::read(&upload).unwrap();
    assert!(matches!(document.marked().unwrap(), Marked::Fits(_)));
    let faces: Vec<usize> = document
        .primitives()
        .iter()
        .map(|p| p.triangles.len())
        .collect();
    assert_eq!(faces, [4, 2]);
    // Squares of the weight that was asked for have no distortion against it.
    let measures = &outcome.report.groups[0].measures;
    let worst = measures.distortion.area_dist_max.unwrap();
    assert!(worst < 1.01, "{worst}");
    // What the caller gets as arrays is in the order of the file that was read.
    let bytes = outcome.uvs.to_bytes();
    assert_eq!(u32::from_le_bytes(bytes[4..8].try_into().unwrap()), 3);
}

/// Each named group has an atlas and a material; the others have what they had.
#[test]
fn named_groups_have_materials_of_their_own() {
    let color = |name: &str, r: f64| json!({"name": name, "pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let materials = [
        color("a", 0.1),
        color("b", 0.2),
        color("c", 0.3),
        color("d", 0.4),
        color("e", 0.5),
    ];
    let outcome = merged(&squares(&materials, &[]), &["head=a, b", "body=2,d"]);
    assert!(outcome.report.certified);
    let (json, _) = parts(&outcome.files[0].1);
    let names: Vec<&str> = (json["materials"].as_array().unwrap().iter())
        .map(|material| material["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["head", "body", "e"]);
    let labels: Vec<&str> = outcome
        .report
        .groups
        .iter()
        .map(|group| group.label.as_str())
        .collect();
    assert_eq!(labels, ["head", "body", "e"]);
    assert_eq!(json["materials"][2], color("e", 0.5));
    // With the rest, nothing is left.
    let outcome = merged(&squares(&materials, &[]), &["head=a,b", "all"]);
    let note = outcome.report.written.unwrap().merged.unwrap();
    let replaced: Vec<_> = note.materials.iter().map(|m| m.replaces.len()).collect();
    assert_eq!(replaced, [2, 3]);
}

/// Skins, morph targets and colors of joined primitives stay with their vertices; primitives of other attributes stay.
#[test]
fn joined_primitives_keep_their_attributes() {
    let color = |r: f64| json!({"pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let mut builder = squares(&[color(0.1), color(0.2), color(0.3)], &[]);
    for k in 0..2 {
        let number = 1.0 + f32::from(k);
        let morph = builder.floats("VEC3", 3, &[0., 0., number].repeat(4));
        let joints = builder.accessor("VEC4", 5121, 4, &[k, 0, 0, 0].repeat(4));
        let weights = builder.floats("VEC4", 4, &[1., 0., 0., 0.].repeat(4));
        let colors = builder.accessor(
            "VEC3",
            5121,
            4,
            &[
                50 * k,
                0,
                0,
                0,
                50 * k,
                0,
                0,
                0,
                50 * k,
                0,
                0,
                0,
                50 * k,
                0,
                0,
            ],
        );
        let object = &mut builder.json["accessors"][colors];
        object["normalized"] = json!(true);
        // Elements of vertices start at multiples of four bytes.
        object["count"] = json!(4);
        let view = object["bufferView"].as_u64().unwrap() as usize;
        builder.json["bufferViews"][view]["byteStride"] = json!(4);
        let primitive = &mut builder.json["meshes"][0]["primitives"][k as usize];
        primitive["targets"] = json!([{"POSITION": morph}]);
        for (name, accessor) in [
            ("JOINTS_0", joints),
            ("WEIGHTS_0", weights),
            ("COLOR_0", colors),
        ] {
            primitive["attributes"][name] = json!(accessor);
        }
    }
    let outcome = merged(&builder, &["all"]);
    assert!(outcome.report.certified);
    let (json, bin) = parts(&outcome.files[0].1);
    let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 2);
    assert!(primitives.iter().all(|p| p["material"] == 0));
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let bytes = |accessor: &Value, vertex: usize, size: usize| {
        let accessor = &json["accessors"][number(accessor)];
        let view = &json["bufferViews"][number(&accessor["bufferView"])];
        let stride = view["byteStride"]
            .as_u64()
            .map_or(size, |stride| stride as usize);
        let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]) + vertex * stride;
        bin[start..start + size].to_vec()
    };
    let joined = &primitives[0];
    let n_vertices = number(&json["accessors"][number(&joined["attributes"]["POSITION"])]["count"]);
    assert!(n_vertices >= 8);
    let attribute = |name: &str| &joined["attributes"][name];
    for vertex in 0..n_vertices {
        let x = f32::from_le_bytes(
            bytes(attribute("POSITION"), vertex, 12)[..4]
                .try_into()
                .unwrap(),
        );
        let k = bytes(attribute("JOINTS_0"), vertex, 4)[0];
        assert!(
            (f32::from(k)..=f32::from(k) + 1.0).contains(&x),
            "{vertex} {x} {k}"
        );
        assert_eq!(bytes(attribute("COLOR_0"), vertex, 3), [50 * k, 0, 0]);
        let morph = bytes(&joined["targets"][0]["POSITION"], vertex, 12);
        assert_eq!(
            f32::from_le_bytes(morph[8..].try_into().unwrap()),
            1.0 + f32::from(k)
        );
    }
    let bounds = &json["accessors"][number(attribute("POSITION"))];
    assert_eq!(
        (&bounds["min"], &bounds["max"]),
        (&json!([0.0, 0.0, 0.0]), &json!([2.0, 1.0, 0.0]))
    );
}

/// Renderers sort blended primitives by distance, so they keep being several.
#[test]
fn blended_primitives_are_not_joined() {
    let glass = |r: f64| json!({"alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, r]}});
    let outcome = merged(&squares(&[glass(0.25), glass(0.5)], &[]), &["all"]);
    let (json, _) = parts(&outcome.files[0].1);
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);
    assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 2);
    let factor = factor(
        &json["materials"][0],
        "/pbrMetallicRoughness/baseColorFactor",
    );
    let wanted = [[0.25, 0., 0., 0.25], [0.5, 0., 0., 0.5]];
    check(&shown(&outcome, BASE, true), factor, &wanted, &[0, 1, 2, 3]);
}

/// Mip levels would blur a texture that had none; a material without textures goes with either.
#[test]
fn textures_with_and_without_mip_levels_stay_apart() {
    let textured =
        |index: usize| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}});
    let materials = [textured(0), textured(1), json!({})];
    let mut builder = squares(&materials, &[[255, 0, 0, 255], [0, 0, 255, 255]]);
    builder.json["samplers"] = json!([{"minFilter": 9729}]);
    builder.json["textures"][1]["sampler"] = json!(0);
    let outcome = merged(&builder, &["all"]);
    let note = outcome.report.written.unwrap().merged.unwrap();
    assert_eq!(note.materials[0].replaces, ["material 0", "material 2"]);
    let apart: Vec<_> = note.apart.iter().map(|apart| apart.material).collect();
    assert_eq!(apart, [1]);
    assert!(note.apart[0].reason.starts_with("minFilter"));
}

/// Points and lines are not unwrapped, and keep the material that their surfaces lose.
#[test]
fn points_keep_their_material() {
    let color = |name: &str, r: f64| json!({"name": name, "pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let mut builder = squares(&[color("a", 0.1), color("b", 0.2)], &[]);
    let mut points = builder.json["meshes"][0]["primitives"][1].clone();
    points["mode"] = json!(0);
    builder.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .insert(0, points);
    let outcome = merged(&builder, &["all"]);
    let (json, _) = parts(&outcome.files[0].1);
    let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
    assert_eq!(primitives.len(), 2);
    let name =
        |p: &Value| json["materials"][p["material"].as_u64().unwrap() as usize]["name"].clone();
    assert_eq!(
        [name(&primitives[0]), name(&primitives[1])],
        ["b", "merged"]
    );
    assert!(outcome.report.certified);
}

/// A file that was merged is a file like any other.
#[test]
fn a_merged_file_can_be_unwrapped_again() {
    let color = |r: f64| json!({"pbrMetallicRoughness": {"baseColorFactor": [r, 0, 0, 1]}});
    let first = merged(&squares(&[color(0.25), color(0.75)], &[]), &["all"]);
    let upload = Upload::single("a.glb", first.files[0].1.clone());
    let second = unwrap_document(&upload, &options(&["all"]), &Unobserved).unwrap();
    assert!(second.report.certified);
    let written = Written {
        files: second.files.clone(),
        notes: second.report.written.clone().unwrap(),
    };
    assert_eq!(written.read_again().unwrap().primitives().len(), 1);
    let apart = second
        .report
        .written
        .as_ref()
        .unwrap()
        .merged
        .as_ref()
        .unwrap()
        .apart[0]
        .clone();
    assert_eq!(apart.reason, "there is no other material to merge it with");
    let wanted = [[0.25, 0., 0., 1.], [0.75, 0., 0., 1.]];
    let (json, _) = parts(&second.files[0].1);
    let factor = factor(
        &json["materials"][0],
        "/pbrMetallicRoughness/baseColorFactor",
    );
    check(&shown(&second, BASE, true), factor, &wanted, &[0, 1, 2]);
}

#[test]
fn bad_requests_are_refused() {
    let color = |name: &str| json!({"name": name});
    let builder = squares(&[color("a"), color("b")], &[]);
    let code = |options: &Options| -> String {
        let error: PipelineError =
            unwrap_document(&builder.upload(), options, &Unobserved).unwrap_err();
        error.code().to_owned()
    };
    assert_eq!(code(&options(&["x=a,c"])), "unknown_material");
    assert_eq!(code(&options(&["x=a", "y=0"])), "invalid_options");
    let obj = Options {
        format: OutputFormat::Obj,
        ..options(&["all"])
    };
    assert_eq!(code(&obj), "invalid_options");
    let of_meshes = Options {
        group_by: Some(unwrapd_files::document::GroupBy::Mesh),
        ..options(&["all"])
    };
    assert_eq!(code(&of_meshes), "invalid_options");
    for text in ["", "some", "=a", "x=", "x=a,,b"] {
        assert!(
            text.parse::<unwrapd_files::document::MaterialMerge>()
                .is_err(),
            "{text}"
        );
    }
}
