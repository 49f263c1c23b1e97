//! UVs for the light of a scene: a part of one atlas for whatever a node shows.

use serde_json::json;
use unwrapd_files::document::{Document, Upload};
use unwrapd_maps::mesh::Resolution;
use unwrapd_pipeline::{
    Cutting, Layout, MeasureOptions, Options, Outcome, PipelineError, Preset, Unobserved, Verified,
    VerifyOptions, unwrap_document, verify_document,
};

use crate::build::{Builder, parts};

fn lightmap(builder: &Builder, options: Options) -> Result<Outcome, PipelineError> {
    let options = Options {
        preset: Preset::Lightmap,
        ..options
    };
    unwrap_document(&builder.upload(), &options, &Unobserved)
}

/// A square with UVs, shown by a node and, half as large and mirrored, by a child of another.
fn scene() -> Builder {
    let mut builder = Builder::square();
    let uvs = builder.floats("VEC2", 2, &[0., 0., 1., 0., 1., 1., 0., 1.]);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
    builder.json["nodes"] = json!([
        {"mesh": 0},
        {"children": [2], "scale": [0.5, 0.5, 0.5], "rotation": [0, 0.6, 0, 0.8]},
        {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1]},
    ]);
    builder.json["scenes"] = json!([{"nodes": [0, 1]}]);
    builder
}

/// What is claimed of a lightmap's UVs, asked of a file.
fn verified(outcome: &Outcome, texcoord: u32) -> Verified {
    let judged = MeasureOptions {
        texcoord: Some(texcoord),
        group_by: Some(unwrapd_files::document::GroupBy::Scene),
        separate_nodes: true,
        padding: Some(2),
        mips: Some(2),
        aligned: true,
        ..MeasureOptions::default()
    };
    let options = VerifyOptions {
        stacks: false,
        bijective: true,
        unmirrored: false,
        judged,
    };
    let (name, bytes) = outcome.files[0].clone();
    verify_document(&Upload::single(&name, bytes), &options).unwrap()
}

#[test]
fn every_node_has_its_part() {
    let builder = scene();
    // A seam through the square would split its vertices, and the old set with them.
    let whole = Options {
        cutting: Cutting {
            seam_weight: 1e6,
            ..Cutting::default()
        },
        ..Options::default()
    };
    let outcome = lightmap(&builder, whole).unwrap();
    let proven = verified(&outcome, 1).proven;
    assert!(proven.bijective && proven.unmirrored, "{proven}");
    assert_eq!(proven.aligned, Some(true));
    let padding = proven.padding.unwrap();
    assert!(padding.kept && padding.asked_texels == 8, "{padding:?}");

    let (json, _) = parts(&outcome.files[0].1);
    let (before, _) = parts(&builder.glb());
    assert_eq!(
        (&json["nodes"][0]["mesh"], &json["nodes"][2]["mesh"]),
        (&json!(0), &json!(1))
    );
    for mesh in 0..2 {
        let attributes = &json["meshes"][mesh]["primitives"][0]["attributes"];
        let old = &before["meshes"][0]["primitives"][0]["attributes"];
        assert_eq!(attributes["TEXCOORD_0"], old["TEXCOORD_0"]);
        assert!(attributes["TEXCOORD_1"].is_u64());
    }
}

/// As large as in the scene: a quarter of the area for half of the size, but for what ends at texels.
#[test]
fn a_part_is_as_large_as_what_its_node_shows() {
    let outcome = lightmap(&scene(), Options::default()).unwrap();
    let (name, bytes) = outcome.files[0].clone();
    let document = Document::read(&Upload::single(&name, bytes)).unwrap();
    let area = |primitive: usize| -> f64 {
        let uvs = document.corner_uvs(primitive, 1).unwrap().unwrap();
        let double = |[a, b, c]: [[f64; 2]; 3]| {
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs()
        };
        uvs.into_iter().map(double).sum()
    };
    let ratio = area(0) / area(1);
    assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
}

#[test]
fn nodes_that_show_one_mesh_overlap_unless_they_have_their_parts() {
    let outcome = unwrap_document(&scene().upload(), &Options::default(), &Unobserved).unwrap();
    let proven = verified(&outcome, 0).proven;
    assert!(proven.locally_injective && !proven.bijective);
    assert_eq!(proven.aligned, Some(false));
}

#[test]
fn what_cannot_be_a_lightmap_is_refused() {
    let code = |builder: &Builder, options: Options| {
        lightmap(builder, options).unwrap_err().code().to_owned()
    };
    let uneven = Options {
        layout: Layout {
            resolution: Resolution::square(1000),
            ..Layout::default()
        },
        ..Options::default()
    };
    assert_eq!(code(&scene(), uneven), "invalid_options");
    let crowded = Options {
        layout: Layout {
            padding: 40,
            ..Layout::default()
        },
        ..Options::default()
    };
    assert_eq!(code(&scene(), crowded), "invalid_options");
    let mut circular = scene();
    circular.json["nodes"][2]["children"] = json!([1]);
    assert_eq!(code(&circular, Options::default()), "invalid_gltf");
    circular.json["nodes"][2]["children"] = json!([7]);
    assert_eq!(code(&circular, Options::default()), "invalid_gltf");
}

#[test]
fn instances_have_no_part_of_their_own() {
    let mut builder = scene();
    builder.json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {}}});
    builder.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    let refused = lightmap(&builder, Options::default()).unwrap_err();
    assert_eq!(refused.code(), "unsupported_extension");
}
