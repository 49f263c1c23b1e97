//! Materials with more or fewer texels than others.

use serde_json::json;
use unwrapd_files::document::{Document, GroupBy, Upload};
use unwrapd_pipeline::{Layout, Options, Outcome, PipelineError, Unobserved, unwrap_document};

use crate::build::Builder;

/// The unit square as two triangles of one mesh, each of a material of its own.
fn two_materials() -> Builder {
    let mut builder = Builder::new();
    let corners = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
    let position = builder.floats("VEC3", 3, &corners);
    let mut half = |indices: [u16; 3], material: usize| {
        let bytes = indices.map(u16::to_le_bytes).concat();
        let indices = builder.accessor("SCALAR", 5123, 3, &bytes);
        json!({"attributes": {"POSITION": position}, "indices": indices, "material": material})
    };
    let halves = [half([0, 1, 2], 0), half([0, 2, 3], 1)];
    builder.json["meshes"] = json!([{ "primitives": halves }]);
    builder.json["materials"] = json!([{"name": "skin"}, {"name": "cloth=wool"}]);
    builder
}

fn unwrapped(weights: &[&str], density: Option<f64>) -> Result<Outcome, PipelineError> {
    let weights = weights.iter().map(|text| text.parse().expect("a weight"));
    let options = Options {
        group_by: Some(GroupBy::Mesh),
        texel_weight: weights.collect(),
        layout: Layout {
            texels_per_unit: density,
            ..Layout::default()
        },
        ..Options::default()
    };
    unwrap_document(&two_materials().upload(), &options, &Unobserved)
}

/// Texels along a unit of each half.
fn densities(outcome: &Outcome) -> [f64; 2] {
    let (name, bytes) = outcome.files[0].clone();
    let document = Document::read(&Upload::single(&name, bytes)).expect("a document");
    [0, 1].map(|primitive| {
        let uvs = document.corner_uvs(primitive, 0).expect("a set");
        let [a, b, c] = uvs.expect("UVs")[0];
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        1024.0 * doubled.abs().sqrt()
    })
}

#[test]
fn a_weight_is_a_density_and_a_border() {
    for weights in [&["cloth=wool=2"][..], &["1=2"], &["skin=3", "0=0.5"]] {
        let outcome = unwrapped(weights, None).expect("a result");
        let [skin, cloth] = densities(&outcome);
        assert!((cloth / skin - 2.0).abs() < 1e-3, "{skin} {cloth}");
        let group = &outcome.report.groups[0];
        assert_eq!(group.certificate.charts, 2);
        let energy = group.measures.distortion.sym_dirichlet_max.expect("faces");
        assert!((energy - 4.0).abs() < 1e-4, "{energy}");
        let spread = group.measures.density.density_p95_over_p5.expect("charts");
        assert!((spread - 1.0).abs() < 1e-3, "{spread}");
    }
}

#[test]
fn a_density_is_that_of_weight_one() {
    let outcome = unwrapped(&["skin=0.5"], Some(300.0)).expect("a result");
    let [skin, cloth] = densities(&outcome);
    assert!((skin - 150.0).abs() < 0.1 && (cloth - 300.0).abs() < 0.1);
    let measured = outcome.report.groups[0].texels_per_unit.expect("an area");
    assert!((measured - 300.0).abs() < 0.1, "{measured}");
}

#[test]
fn without_weights_materials_share_a_chart() {
    let outcome = unwrapped(&[], None).expect("a result");
    assert_eq!(outcome.report.groups[0].certificate.charts, 1);
}

#[test]
fn materials_and_weights_that_are_not_are_refused() {
    let code = |weights: &[&str]| unwrapped(weights, None).expect_err("refused").code();
    assert_eq!(code(&["hair=2"]), "unknown_material");
    assert_eq!(code(&["2=2"]), "unknown_material");
    assert_eq!(code(&["skin=0"]), "invalid_options");
    assert_eq!(code(&["skin=NaN"]), "invalid_options");
}

#[test]
fn a_weight_needs_others_in_its_atlas_or_a_density() {
    let weighted = |density: Option<f64>| {
        let options = Options {
            texel_weight: vec!["skin=2".parse().expect("a weight")],
            layout: Layout {
                texels_per_unit: density,
                ..Layout::default()
            },
            ..Options::default()
        };
        unwrap_document(&two_materials().upload(), &options, &Unobserved)
    };
    let error = weighted(None).expect_err("each material has its own atlas");
    assert_eq!(error.code(), "invalid_options");
    assert!(error.to_string().contains("`texel_weight` requires"));
    assert!(weighted(Some(100.0)).is_ok());
}
