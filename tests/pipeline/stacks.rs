//! Islands that coincide and stay together, and those that do not.

use crate::islands::{island, squares, uvs, written};
use std::collections::BTreeSet;
use unwrapd_files::document::{OutputFormat, Upload};
use unwrapd_layout::charts::Cut;
use unwrapd_maps::certificate::outline;
use unwrapd_pipeline::{
    Cutting, IslandControl, KeptMaps, Layout, Mapping, Options, Outcome, PipelineError, Preset,
    RepackOptions, Stacking, Unobserved, Verified, VerifyOptions, repack_document, unwrap_document,
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
    // Islands keep their shapes, so one that is mirrored stays so, and is said to be.
    assert!(apart.report.certified && !apart.report.proven.unmirrored);
    assert_eq!(n_places(&apart), 2);
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

#[test]
fn stacked_islands_are_a_tile_apart_if_that_is_asked_for() {
    let options = |stack| RepackOptions {
        layout: Layout {
            stack,
            stack_offset: true,
            ..Layout::default()
        },
        format: OutputFormat::Obj,
        ..RepackOptions::default()
    };
    let outcome = repack_document(&stack(), &options(None), &Unobserved).expect("it fits");
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    let faces = uvs(&written(&outcome));
    for square in 1..6 {
        for (first, other) in [(0, 2 * square), (1, 2 * square + 1)] {
            assert_eq!(faces[first].map(|[u, v]| [u + 1.0, v]), faces[other]);
        }
    }
    for face in [0, 1, 12, 13, 14, 15] {
        assert!(faces[face].iter().all(|[u, _]| *u < 1.0), "{face}");
    }
    // The report is that of stacks without an offset.
    let together = repacked(&stack(), None);
    let [offset, together] = [&outcome, &together].map(|outcome| &outcome.report.groups[0]);
    let stacks = offset.stacks.expect("stacks");
    assert_eq!((stacks.stacks, stacks.charts), (1, 6));
    assert_eq!(
        stacks.texels_gained,
        together.stacks.expect("stacks").texels_gained
    );
    assert_eq!(
        offset.measures.packing.covered_texels,
        together.measures.packing.covered_texels
    );
    // The others coincide, but overlap nothing in the first tile.
    assert!(!verified(&outcome, false).certified);
    assert!(verified(&outcome, true).certified);
    // Without a stack there is nothing to move.
    let none = repack_document(&stack(), &options(Some(Stacking::Off)), &Unobserved);
    assert_eq!(none.expect_err("no stack").code(), "invalid_options");
    let mut pages = options(None);
    pages.layout.pages = 2;
    let pages = repack_document(&stack(), &pages, &Unobserved).expect_err("two pages");
    assert_eq!(pages.code(), "invalid_options");
}

// Parts of one shape.

/// A bracket that is no mirror image of itself, `length` times as long.
fn bracket(length: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let outline = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 1.0],
        [1.3, 1.0],
        [1.0, 2.2],
        [0.0, 2.0],
    ];
    let at = |[x, y]: [f64; 2], z: f64| [length * (x + 0.3 * z), y + 0.17 * z, z];
    let [below, above] = [0.0, 0.7].map(|z| outline.map(|p| at(p, z)));
    let caps = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]];
    let mut faces: Vec<[u32; 3]> = Vec::new();
    faces.extend(caps.map(|[a, b, c]| [a, c, b]));
    faces.extend(caps.map(|cap| cap.map(|v| v + 6)));
    for k in 0..6 {
        let next = (k + 1) % 6;
        faces.extend([[k, next, next + 6], [k, next + 6, k + 6]]);
    }
    ([below, above].concat(), faces)
}

/// Parts each turned and moved, those with a mark as mirror images, as an OBJ file.
fn scene(parts: &[(f64, bool)]) -> Upload {
    let mut lines = Vec::new();
    for (k, &(length, is_mirrored)) in parts.iter().enumerate() {
        let (positions, faces) = bracket(length);
        let (sin, cos) = (0.7 * k as f64).sin_cos();
        // Every other part has its vertices and faces in another order.
        let n = positions.len();
        let number = |v: usize| if k % 2 == 0 { v } else { (7 * v + 3) % n };
        let mut moved = vec![[0.0; 3]; n];
        for (v, [x, y, z]) in positions.into_iter().enumerate() {
            let x = if is_mirrored { -x } else { x };
            let turned = [cos * x - sin * y, sin * x + cos * y, z + 5.0 * k as f64];
            moved[number(v)] = [turned[2], turned[0], turned[1]];
        }
        lines.extend(moved.iter().map(|[x, y, z]| format!("v {x} {y} {z}")));
        let first = k * n + 1;
        let mut faces: Vec<[usize; 3]> = (faces.iter())
            .map(|face| face.map(|v| first + number(v as usize)))
            .collect();
        if is_mirrored {
            for face in &mut faces {
                face.swap(0, 1);
            }
        }
        let rotated = k % faces.len();
        faces.rotate_left(rotated);
        lines.extend(faces.iter().map(|[a, b, c]| format!("f {a} {b} {c}")));
    }
    Upload::single("scene.obj", lines.join("\n").into_bytes())
}

fn unwrapped(upload: &Upload, stack: Stacking) -> Outcome {
    let options = Options {
        layout: Layout {
            stack: Some(stack),
            ..Layout::default()
        },
        format: OutputFormat::Obj,
        ..Options::default()
    };
    unwrap_document(upload, &options, &Unobserved).expect("it fits")
}

/// Number of parts that lie apart: sets of UV triangles.
fn n_part_places(outcome: &Outcome) -> usize {
    let faces = uvs(&written(outcome));
    let parts = faces.chunks(20).map(|part| {
        let triangles = part.iter().map(|face| {
            let mut corners = face.map(|uv| uv.map(f64::to_bits));
            corners.sort_unstable();
            corners
        });
        triangles.collect::<BTreeSet<_>>()
    });
    parts.collect::<BTreeSet<_>>().len()
}

#[test]
fn identical_parts_are_mapped_once_and_stacked() {
    let scene = scene(&[(1.0, false); 12]);
    let outcome = unwrapped(&scene, Stacking::Identical);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert_eq!(n_part_places(&outcome), 1);
    let stacks = outcome.report.groups[0].stacks.expect("stacks");
    assert_eq!(stacks.charts, 12 * stacks.stacks);
    assert!(verified(&outcome, true).certified && !verified(&outcome, false).certified);
    assert_eq!(n_part_places(&unwrapped(&scene, Stacking::Off)), 12);
}

#[test]
fn near_misses_are_not_stacked() {
    // 1 % longer and more, and mirror images where identical parts were asked for.
    let longer = (0..10).map(|k| (1.01 + 0.003 * f64::from(k), false));
    let mirrored = (0..10).map(|k| (1.05 + 0.003 * f64::from(k), true));
    let parts: Vec<(f64, bool)> = [(1.0, false); 4]
        .into_iter()
        .chain(longer)
        .chain(mirrored)
        .collect();
    let outcome = unwrapped(&scene(&parts), Stacking::Identical);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert_eq!(n_part_places(&outcome), 21);
    let both = [(1.0, false), (1.0, true), (1.0, false), (1.0, true)];
    assert_eq!(
        n_part_places(&unwrapped(&scene(&both), Stacking::Identical)),
        2
    );
}

#[test]
fn mirrored_parts_are_stacked_if_that_is_asked_for() {
    let parts = [
        (1.0, false),
        (1.0, true),
        (1.0, false),
        (1.0, true),
        (1.2, true),
    ];
    let outcome = unwrapped(&scene(&parts), Stacking::Mirrored);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert!(!outcome.report.proven.unmirrored);
    assert_eq!(n_part_places(&outcome), 2);
}

#[test]
fn a_part_that_is_there_twice_is_not_stacked_on_itself() {
    let text = String::from_utf8(scene(&[(1.0, false); 2]).bytes).expect("text");
    let again = |line: &str| {
        let numbers = line.strip_prefix("f ")?.split(' ');
        let moved = numbers.map(|v| (v.parse::<u32>().expect("a number") + 24).to_string());
        Some(format!("f {}", moved.collect::<Vec<_>>().join(" ")))
    };
    let twice: Vec<String> = text
        .lines()
        .map(|line| again(line).unwrap_or(line.to_owned()))
        .collect();
    let both = [text, twice.join("\n")].join("\n");
    let outcome = unwrapped(
        &Upload::single("twice.obj", both.into_bytes()),
        Stacking::Identical,
    );
    let certificate = &outcome.report.groups[0].certificate;
    assert!(certificate.is_valid());
    assert_eq!(certificate.overlapping_pairs_same_chart, Some(0));
}

/// Boxes in an OBJ file, each turned about an axis, this far from the one before. Their sides begin at various corners and are
/// quads, or triangles with various diagonals.
fn boxes(n: usize, apart: f64, as_triangles: bool) -> Upload {
    const SIDES: [[usize; 4]; 6] = [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ];
    let mut lines = Vec::new();
    for k in 0..n {
        let (sin, cos) = (0.37 * k as f64).sin_cos();
        for v in 0..8 {
            let at = |axis: usize, side: f64| if v >> axis & 1 == 1 { side } else { 0.0 };
            let [x, y, z] = [at(0, 1.0), at(1, 1.5), at(2, 2.25)];
            let [x, y] = [cos * x - sin * y, sin * x + cos * y];
            lines.push(format!("v {} {y} {z}", x + apart * k as f64));
        }
        for (side, corners) in SIDES.iter().enumerate() {
            let [a, b, c, d] = [0, 1, 2, 3].map(|c| 8 * k + corners[(c + k + side) % 4] + 1);
            if as_triangles {
                lines.extend([format!("f {a} {b} {c}"), format!("f {a} {c} {d}")]);
            } else {
                lines.push(format!("f {a} {b} {c} {d}"));
            }
        }
    }
    Upload::single("boxes.obj", lines.join("\n").into_bytes())
}

/// Number of boxes that lie apart: outlines of their twelve triangles.
fn n_box_places(outcome: &Outcome) -> usize {
    let faces = uvs(&written(outcome));
    faces.chunks(12).map(outline).collect::<BTreeSet<_>>().len()
}

#[test]
fn copies_may_have_other_triangles_in_flat_areas() {
    for as_triangles in [false, true] {
        let outcome = stacked(&boxes(40, 5.0, as_triangles), Stacking::Identical, false);
        assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
        assert_eq!(n_box_places(&outcome), 1, "{as_triangles}");
        assert!(verified(&outcome, true).certified);
    }
}

#[test]
fn copies_far_from_the_origin_are_found_in_spite_of_rounding() {
    // At 10,000 units, numbers are multiples of 1/1024, and boxes differ by more than a ten-thousandth.
    let outcome = stacked(&boxes(6, 2000.0, true), Stacking::Identical, false);
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    assert_eq!(n_box_places(&outcome), 1);
}

#[test]
fn charts_of_one_shape_are_stacked() {
    // Both caps of a prism over a polygon that is its own mirror image, cut off by hard edges.
    let n = 12;
    let mut lines = Vec::new();
    for z in [0.0, 0.5] {
        for k in 0..n {
            let radius = if k % 2 == 0 { 1.0 } else { 1.4 };
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
            lines.push(format!("v {} {} {z}", radius * cos, radius * sin));
        }
    }
    let polygon = |vertices: Vec<i32>| {
        let numbers: Vec<String> = vertices.iter().map(ToString::to_string).collect();
        format!("f {}", numbers.join(" "))
    };
    lines.push(polygon((1..=n).rev().collect()));
    lines.push(polygon((n + 1..=2 * n).collect()));
    for k in 0..n {
        let next = (k + 1) % n;
        lines.push(polygon(vec![k + 1, next + 1, n + next + 1, n + k + 1]));
    }
    let upload = Upload::single("prism.obj", lines.join("\n").into_bytes());
    let together = stacked(&upload, Stacking::Identical, false);
    assert!(together.report.certified, "{:?}", together.report.warnings);
    assert!(together.report.groups[0].stacks.is_some());
    assert!(verified(&together, true).certified && !verified(&together, false).certified);
    let apart = stacked(&upload, Stacking::Off, false);
    let density = |outcome: &Outcome| outcome.report.groups[0].texels_per_unit.expect("an area");
    assert!(density(&together) > 1.05 * density(&apart));
}

#[test]
fn islands_that_keep_something_of_their_own_get_no_uvs_of_others() {
    let apart = stacked(&boxes(4, 5.0, true), Stacking::Off, false);
    let upload = written(&apart);
    let before = uvs(&upload);
    let repacked = |rule: &str| {
        let options = RepackOptions {
            layout: Layout {
                stack: Some(Stacking::Identical),
                ..Layout::default()
            },
            control: IslandControl {
                control: vec![rule.parse().expect("a rule")],
                ..IslandControl::default()
            },
            format: OutputFormat::Obj,
            ..RepackOptions::default()
        };
        repack_document(&upload, &options, &Unobserved).expect("it fits")
    };
    let locked = repacked("all: lock");
    assert_eq!(uvs(&written(&locked)), before);
    for rule in ["all: group", "all: density keep"] {
        let outcome = repacked(rule);
        assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
        assert_eq!(n_box_places(&outcome), 4, "{rule}");
    }
    assert_eq!(n_box_places(&repacked("all: density 20")), 1);
}

/// Maps the parts of a scene, stacked by shape.
fn stacked(upload: &Upload, stack: Stacking, stack_offset: bool) -> Outcome {
    let options = Options {
        layout: Layout {
            stack: Some(stack),
            stack_offset,
            ..Layout::default()
        },
        format: OutputFormat::Obj,
        ..Options::default()
    };
    unwrap_document(upload, &options, &Unobserved).expect("it fits")
}

#[test]
fn copies_of_parts_are_a_tile_apart_if_that_is_asked_for() {
    for (mirrored, stack) in [(false, Stacking::Identical), (true, Stacking::Mirrored)] {
        let upload = scene(&[(1.0, false), (1.0, mirrored), (2.0, false)]);
        let outcome = stacked(&upload, stack, true);
        assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
        assert!(outcome.report.groups[0].stacks.is_some());
        let faces = uvs(&written(&outcome));
        let n = faces.len() / 3;
        let is_beyond = |face: &[[f64; 2]; 3]| face.iter().all(|[u, _]| *u > 1.0);
        let beyond: Vec<bool> = faces.iter().map(is_beyond).collect();
        let expected = [vec![false; n], vec![true; n], vec![false; n]].concat();
        assert_eq!(beyond, expected, "{stack:?}");
    }
}

#[test]
fn parts_of_two_materials_are_not_stacked_and_the_report_says_so() {
    let text = String::from_utf8(scene(&[(1.0, false), (1.0, false)]).bytes).expect("text");
    let lines: Vec<&str> = text.lines().collect();
    let first_face = lines
        .iter()
        .position(|line| line.starts_with("f "))
        .expect("a face");
    let n_faces = lines.iter().filter(|line| line.starts_with("f ")).count();
    let is_told = |outcome: &Outcome| {
        let mut warnings = outcome.report.warnings.iter();
        warnings.any(|warning| warning.code == "nothing_stacked")
    };
    for (second, is_stacked) in [("usemtl a", true), ("usemtl b", false)] {
        let mut lines = lines.clone();
        let faces: Vec<usize> = (0..lines.len())
            .filter(|&k| lines[k].starts_with("f "))
            .collect();
        lines.insert(faces[n_faces / 2], second);
        lines.insert(first_face, "usemtl a");
        let upload = Upload::single("scene.obj", lines.join("\n").into_bytes());
        let outcome = stacked(&upload, Stacking::Identical, false);
        assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
        assert_eq!(
            outcome.report.groups[0].stacks.is_some(),
            is_stacked,
            "{second}"
        );
        assert_eq!(is_told(&outcome), !is_stacked, "{second}");
    }
    assert!(!is_told(&repacked(&stack(), None)));
}
