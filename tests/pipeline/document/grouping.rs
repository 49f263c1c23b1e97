//! What shares an atlas unless something else is asked for.

use serde_json::{Value, json};
use unwrapd_files::document::{Document, GroupBy, Upload};
use unwrapd_pipeline::{Options, Outcome, PipelineError, Unobserved, unwrap_document};

use crate::build::Builder;

/// Squares of six sizes, each a mesh, with these materials.
fn squares(materials: [Option<usize>; 6]) -> Builder {
    let mut builder = Builder::new();
    let meshes = (1_u8..).zip(materials).map(|(size, material)| {
        let size = f32::from(size);
        let corners = [0., 0., 0., size, 0., 0., size, size, 0., 0., size, 0.];
        let position = builder.floats("VEC3", 3, &corners);
        let indices: Vec<u8> = [0_u16, 1, 2, 0, 2, 3].map(u16::to_le_bytes).concat();
        let indices = builder.accessor("SCALAR", 5123, 6, &indices);
        let mut primitive = json!({"attributes": {"POSITION": position}, "indices": indices});
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        json!({ "primitives": [primitive] })
    });
    let meshes: Vec<Value> = meshes.collect();
    builder.json["meshes"] = json!(meshes);
    builder.json["materials"] = json!([{"name": "headset"}, {"name": "strap"}]);
    builder
}

fn unwrapped(builder: &Builder, options: &Options) -> Result<Outcome, PipelineError> {
    unwrap_document(&builder.upload(), options, &Unobserved)
}

fn names(outcome: &Outcome) -> Vec<&str> {
    let groups = outcome.report.groups.iter();
    groups.map(|group| group.name.as_str()).collect()
}

/// The texels along a unit of each mesh.
fn densities(outcome: &Outcome) -> Vec<f64> {
    let (name, bytes) = outcome.files[0].clone();
    let document = Document::read(&Upload::single(&name, bytes)).expect("a document");
    let density = |mesh: usize| {
        let uvs = document.corner_uvs(mesh, 0).expect("a set");
        let doubled: f64 = (uvs.expect("UVs").iter())
            .map(|[a, b, c]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
            .sum();
        1024.0 * (doubled.abs() / 2.0).sqrt() / (mesh + 1) as f64
    };
    (0..6).map(density).collect()
}

#[test]
fn meshes_of_one_material_share_an_atlas_and_a_density() {
    let outcome = unwrapped(&squares([Some(0); 6]), &Options::default()).expect("a result");
    assert_eq!(names(&outcome), ["material0"]);
    assert!(outcome.report.certified, "{}", outcome.report.proven);
    let densities = densities(&outcome);
    assert!(
        densities
            .iter()
            .all(|d| (d / densities[0] - 1.0).abs() < 1e-2),
        "{densities:?}"
    );
}

#[test]
fn a_mesh_without_a_material_has_an_atlas_of_its_own() {
    let every = ["mesh0", "mesh1", "mesh2", "mesh3", "mesh4", "mesh5"];
    let outcome = unwrapped(&squares([None; 6]), &Options::default()).expect("a result");
    assert_eq!(names(&outcome), every);
    let by_mesh = Options {
        group_by: Some(GroupBy::Mesh),
        ..Options::default()
    };
    let same = unwrapped(&squares([None; 6]), &by_mesh).expect("a result");
    assert_eq!(densities(&same), densities(&outcome));

    let some = squares([Some(0), None, Some(1), None, Some(0), Some(1)]);
    let outcome = unwrapped(&some, &Options::default()).expect("a result");
    assert_eq!(
        names(&outcome),
        ["material0", "mesh1", "material1", "mesh3"]
    );
    let outcome = unwrapped(&some, &by_mesh).expect("a result");
    assert_eq!(names(&outcome), every);
}

#[test]
fn borders_of_materials_need_several_in_an_atlas() {
    let bordered = Options {
        material_borders: true,
        ..Options::default()
    };
    let error = unwrapped(&squares([Some(0); 6]), &bordered).expect_err("nothing would be cut");
    assert_eq!(error.code(), "invalid_options");
    let of_scene = Options {
        group_by: Some(GroupBy::Scene),
        ..bordered
    };
    let outcome = unwrapped(&squares([Some(0); 6]), &of_scene).expect("a result");
    assert_eq!(names(&outcome), ["scene"]);
}
