//! Islands that coincide and stay together, and those that do not.

use crate::islands::{island, squares, uvs, written};
use std::collections::BTreeSet;
use unwrapd_files::document::{OutputFormat, Upload};
use unwrapd_layout::charts::Cut;
use unwrapd_pipeline::{
    Cutting, KeptMaps, Layout, Mapping, Options, Outcome, PipelineError, Preset, RepackOptions,
    Stacking, Unobserved, Verified, VerifyOptions, repack_document, unwrap_document,
    verify_document,
};

/// Six squares on each other, and two elsewhere.
fn stack() -> Upload {
    let on_each_other = [([0.1, 0.1], 0.3); 6];
    let others = [([0.6, 0.1], 0.25), ([0.1, 0.6], 0.2)];
    squares(&[&on_each_other[..], &others].concat())
}

fn repacked(upload: &Upload, stack: Option<Stacking>) -> Outcome {
    let options = RepackOptions {
        layout: Layout {
            stack,
            ..Layout::default()
        },
        format: OutputFormat::Obj,
        ..RepackOptions::default()
    };
    repack_document(upload, &options, &Unobserved).expect("it fits")
}

fn verified(outcome: &Outcome, stacks: bool) -> Verified {
    let options = VerifyOptions {
        stacks,
        ..VerifyOptions::default()
    };
    verify_document(&written(outcome), &options).expect("a judgment")
}

/// Number of squares that lie apart.
fn n_places(outcome: &Outcome) -> usize {
    let faces = uvs(&written(outcome));
    let bits = |[first, second]: &[[[f64; 2]; 3]; 2]| {
        let corners = [first, second].map(|face| face.map(|uv| uv.map(f64::to_bits)));
        let mut corners = corners.concat();
        corners.sort_unstable();
        corners.dedup();
        corners
    };
    let places: BTreeSet<_> = faces.as_chunks().0.iter().map(bits).collect();
    places.len()
}

#[test]
fn repacking_keeps_islands_that_coincide_together() {
    let together = repacked(&stack(), None);
    assert!(together.report.certified, "{:?}", together.report.warnings);
    assert_eq!(n_places(&together), 3);
    let group = &together.report.groups[0];
    assert_eq!(group.certificate.stacks, Some(vec![vec![0, 1, 2, 3, 4, 5]]));
    let stacks = group.stacks.expect("stacks");
    assert_eq!((stacks.stacks, stacks.charts), (1, 6));
    // Five squares less.
    let face = uvs(&written(&together))[0];
    let side = 1024.0 * (face[1][0] - face[0][0]).hypot(face[1][1] - face[0][1]);
    assert!((stacks.texels_gained / (5.0 * side * side) - 1.0).abs() < 1e-3);
    // They are larger than islands that are separated, which are one each.
    let apart = repacked(&stack(), Some(Stacking::Off));
    assert!(apart.report.certified && apart.report.proven.bijective);
    assert_eq!(
        (n_places(&apart), &apart.report.groups[0].certificate.stacks),
        (8, &None)
    );
    let density = |outcome: &Outcome| outcome.report.groups[0].texels_per_unit.expect("an area");
    assert!(density(&together) > 1.4 * density(&apart));
}

#[test]
fn stacks_count_as_overlaps_unless_they_are_accepted() {
    let outcome = repacked(&stack(), None);
    let refused = verified(&outcome, false);
    assert_eq!(refused.lacking[0], "triangles overlapping");
    let accepted = verified(&outcome, true);
    assert!(accepted.certified, "{:?}", accepted.lacking);
    assert!(!accepted.proven.bijective);
    let first_line = accepted.judged.to_string();
    assert!(
        first_line.ends_with("accepted: 1 stack of 6 charts that coincide"),
        "{first_line}"
    );
}

#[test]
fn islands_that_coincide_up_to_rounding_get_one_outline() {
    let off = |k: usize| 1e-8 * k as f64;
    let places: Vec<_> = (0..5)
        .map(|k| ([0.1 + off(k), 0.1 - off(k)], 0.3 + off(k)))
        .collect();
    let outcome = repacked(&squares(&places), None);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert_eq!(n_places(&outcome), 1);
}

#[test]
fn islands_that_nearly_coincide_are_separated() {
    let near = [
        ([0.1, 0.1], 0.3),
        ([0.1001, 0.1], 0.3),
        ([0.1, 0.1], 0.303),
        ([0.1, 0.0999], 0.3),
        ([0.1, 0.1], 0.2999),
    ];
    let outcome = repacked(&squares(&near), None);
    assert!(
        outcome.report.proven.bijective,
        "{:?}",
        outcome.report.warnings
    );
    assert_eq!(n_places(&outcome), near.len());
}

#[test]
fn a_stack_stays_where_one_of_its_islands_is_put() {
    let options = RepackOptions {
        islands: vec![island(2)],
        format: OutputFormat::Obj,
        ..RepackOptions::default()
    };
    let outcome = repack_document(&stack(), &options, &Unobserved).expect("it fits");
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    let [before, after] = [uvs(&stack()), uvs(&written(&outcome))];
    let rounded = |face: [[f64; 2]; 3]| face.map(|uv| uv.map(|x| f64::from(x as f32)));
    for face in 0..12 {
        assert_eq!(after[face], rounded(before[face]), "{face}");
    }
    assert_ne!(after[12], rounded(before[12]));
}

#[test]
fn a_mirrored_island_of_a_stack_is_no_shortfall() {
    // The second square is seen from behind.
    let file = squares(&[([0.1, 0.1], 0.3); 2]);
    let text = String::from_utf8(file.bytes).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    // Positions and UVs alternate; those of the second square begin at line 8.
    let mut swapped = lines.clone();
    for (here, there) in [(9, 11), (13, 15)] {
        (swapped[here], swapped[there]) = (lines[there], lines[here]);
    }
    let upload = Upload::single("mirrored.obj", swapped.join("\n").into_bytes());
    let together = repacked(&upload, None);
    assert!(together.report.certified && !together.report.proven.unmirrored);
    assert_eq!(n_places(&together), 1);
    let apart = repacked(&upload, Some(Stacking::Off));
    assert!(
        !apart.report.certified,
        "a mirrored chart on its own is one"
    );
}

#[test]
fn stacks_are_refused_where_they_cannot_be_kept() {
    let keep = Layout {
        stack: Some(Stacking::Keep),
        ..Layout::default()
    };
    let given = Cutting {
        cut: Cut::Keep,
        kept_maps: KeptMaps::AsGiven,
        ..Cutting::default()
    };
    let base = Options {
        layout: keep,
        cutting: given,
        ..Options::default()
    };
    let new_maps = Options {
        cutting: Cutting::default(),
        ..base.clone()
    };
    let lightmap = Options {
        preset: Preset::Lightmap,
        ..base.clone()
    };
    let safe = Options {
        mapping: Mapping {
            quantization_safe: Some(12),
            ..Mapping::default()
        },
        ..base.clone()
    };
    for options in [new_maps, lightmap, safe] {
        let error = unwrap_document(&stack(), &options, &Unobserved).expect_err("refused");
        assert!(matches!(error, PipelineError::InvalidOptions(_)), "{error}");
    }
    let outcome = unwrap_document(&stack(), &base, &Unobserved).expect("it fits");
    assert!(outcome.report.certified && !outcome.report.proven.bijective);
}
