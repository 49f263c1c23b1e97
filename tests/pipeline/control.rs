//! Rules for islands: one scene for each, judged from the bytes written.

use crate::islands::{uvs, written};
use unwrapd_files::document::{Document, OutputFormat, Upload};
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_pipeline::{
    IslandControl, IslandError, Layout, MeshArrays, Options, Outcome, PipelineError, RepackOptions,
    RuleReport, Stacking, Unobserved, repack_document, repack_meshes, unwrap_document,
};

/// A square: its place and side in UV, its side in space over that in UV, its material, and its color.
struct Square {
    place: [f64; 2],
    side: f64,
    size: f64,
    material: &'static str,
    color: [f64; 3],
}

const RED: [f64; 3] = [1.0, 0.0, 0.0];
const GREY: [f64; 3] = [0.5, 0.5, 0.5];

fn square(
    place: [f64; 2],
    side: f64,
    size: f64,
    material: &'static str,
    color: [f64; 3],
) -> Square {
    Square {
        place,
        side,
        size,
        material,
        color,
    }
}

/// Six squares of three materials and two colors, which take a third of the page.
fn six() -> Vec<Square> {
    vec![
        square([0.05, 0.05], 0.3, 10.0, "wood", GREY),
        square([0.4, 0.05], 0.25, 10.0, "glass", GREY),
        square([0.05, 0.4], 0.2, 20.0, "glass", RED),
        square([0.4, 0.4], 0.2, 10.0, "steel", RED),
        square([0.7, 0.4], 0.15, 5.0, "steel", GREY),
        square([0.7, 0.7], 0.1, 10.0, "wood", GREY),
    ]
}

/// Writes squares as an OBJ file, two triangles each; they lie apart in space.
fn file(squares: &[Square]) -> Upload {
    let mut lines = Vec::new();
    for (
        k,
        Square {
            place: [u, v],
            side,
            size,
            material,
            color: [r, g, b],
        },
    ) in squares.iter().enumerate()
    {
        for [x, y] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            let [px, py] = [size * side * x + 20.0 * k as f64, size * side * y];
            lines.push(format!("v {px} {py} 0 {r} {g} {b}"));
            lines.push(format!("vt {} {}", u + side * x, v + side * y));
        }
        let n = |corner: usize| 4 * k + corner;
        lines.push(format!("usemtl {material}"));
        lines.push(format!("f {0}/{0} {1}/{1} {2}/{2}", n(1), n(2), n(3)));
        lines.push(format!("f {0}/{0} {1}/{1} {2}/{2}", n(1), n(3), n(4)));
    }
    Upload::single("squares.obj", lines.join("\n").into_bytes())
}

fn control(rules: &[&str], rectangles: &[&str]) -> IslandControl {
    IslandControl {
        control: rules
            .iter()
            .map(|text| text.parse().expect("a rule"))
            .collect(),
        rectangle: rectangles
            .iter()
            .map(|text| text.parse().expect("a rectangle"))
            .collect(),
        straighten: None,
    }
}

fn options(rules: &[&str], rectangles: &[&str], pages: u32) -> RepackOptions {
    RepackOptions {
        control: control(rules, rectangles),
        layout: Layout {
            pages,
            ..Layout::default()
        },
        format: OutputFormat::Obj,
        ..RepackOptions::default()
    }
}

fn repacked(squares: &[Square], options: &RepackOptions) -> Outcome {
    let outcome = repack_document(&file(squares), options, &Unobserved).expect("it fits");
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    outcome
}

fn refused(rules: &[&str], rectangles: &[&str]) -> PipelineError {
    repack_document(&file(&six()), &options(rules, rectangles, 1), &Unobserved)
        .expect_err("it is refused")
}

/// The corners of each square, in the order of the file.
fn corners(outcome: &Outcome) -> Vec<[[f64; 2]; 4]> {
    let faces = uvs(&written(outcome));
    let square = |[first, second]: &[CornerUvs; 2]| [first[0], first[1], first[2], second[2]];
    faces.as_chunks().0.iter().map(square).collect()
}

fn side([a, b, ..]: [[f64; 2]; 4]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// Texels per unit of length of a square.
fn density(corners: [[f64; 2]; 4], square: &Square) -> f64 {
    1024.0 * side(corners) / (square.size * square.side)
}

fn assert_near(found: f64, expected: f64, share: f64) {
    assert!(
        (found / expected - 1.0).abs() < share,
        "{found} is not {expected}"
    );
}

fn rules(outcome: &Outcome) -> &[RuleReport] {
    &outcome.report.groups[0].rules
}

#[test]
fn locked_islands_keep_their_bits() {
    let before = uvs(&file(&six()));
    for (rule, locked) in [
        ("material=glass: lock", vec![1, 2]),
        ("material=1: lock", vec![1, 2]),
        ("color=ff0000: lock", vec![2, 3]),
        ("color=#FF0000: lock", vec![2, 3]),
        ("faces=0/1,0/10: lock", vec![0, 5]),
        ("all: lock", vec![0, 1, 2, 3, 4, 5]),
    ] {
        let outcome = repacked(&six(), &options(&[rule], &[], 1));
        let after = uvs(&written(&outcome));
        for face in 0..after.len() {
            let single = before[face].map(|uv| uv.map(|x| f64::from(x as f32)));
            let is_same = after[face] == single;
            assert_eq!(is_same, locked.contains(&(face / 2)), "{rule}: face {face}");
        }
        assert_eq!(rules(&outcome)[0].islands, locked.len(), "{rule}");
    }
}

#[test]
fn locked_islands_that_overlap_or_lie_beyond_the_page_stay_and_are_not_certified() {
    let mut squares = six();
    squares[1].place = [0.1, 0.1];
    squares[2].place = [-2.25, 0.5];
    let rules = options(&["material=wood: lock", "material=glass: lock"], &[], 1);
    let outcome = repack_document(&file(&squares), &rules, &Unobserved).expect("a file");
    assert!(!outcome.report.certified);
    let (before, after) = (uvs(&file(&squares)), uvs(&written(&outcome)));
    for square in [0, 1, 2, 5] {
        let single = before[2 * square].map(|uv| uv.map(|x| f64::from(x as f32)));
        assert_eq!(after[2 * square], single);
    }
    squares[2].place = [0.9, 0.5];
    let across = repack_document(&file(&squares), &rules, &Unobserved).expect_err("it crosses");
    assert!(
        matches!(
            across,
            PipelineError::Islands(IslandError::LockedOffPage { face: 4 })
        ),
        "{across}"
    );
}

#[test]
fn groups_move_as_one() {
    let outcome = repacked(
        &six(),
        &options(&["color=ff0000: group", "material=wood: group"], &[], 1),
    );
    let after = corners(&outcome);
    for group in [[2, 3], [0, 5]] {
        // Distances between all corners of both squares have one ratio to those before.
        let given = |k: usize| {
            let Square {
                place: [u, v],
                side,
                ..
            } = six()[group[k / 4]];
            let [x, y] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][k % 4];
            [u + side * x, v + side * y]
        };
        let now = |k: usize| after[group[k / 4]][k % 4];
        let length = |at: &dyn Fn(usize) -> [f64; 2], k: usize| {
            let (a, b) = (at(0), at(k));
            (a[0] - b[0]).hypot(a[1] - b[1])
        };
        let ratios: Vec<f64> = (1..8)
            .map(|k| length(&now, k) / length(&given, k))
            .collect();
        for ratio in &ratios {
            assert_near(*ratio, ratios[0], 1e-5);
        }
    }
    // Others do not keep their distance.
    let apart = after[1][0][0] - after[4][0][0];
    assert!((apart - (0.4 - 0.7)).abs() > 1e-3);
}

#[test]
fn islands_stay_in_their_rectangles_and_tiles() {
    let rules = ["material=glass: in top", "material=steel: in 1002"];
    let outcome = repacked(&six(), &options(&rules, &["top=0.25,0.75,1,1"], 2));
    let after = corners(&outcome);
    let half = 1.0 / 1024.0 - 1e-6;
    let assert_inside = |squares: [usize; 2], low: [f64; 2], high: [f64; 2]| {
        for [u, v] in squares.into_iter().flat_map(|k| after[k]) {
            let inside =
                u > low[0] + half && u < high[0] - half && v > low[1] + half && v < high[1] - half;
            assert!(inside, "{u}, {v}");
        }
    };
    assert_inside([1, 2], [0.25, 0.75], [1.0, 1.0]);
    assert_inside([3, 4], [1.0, 0.0], [2.0, 1.0]);
    // A rectangle of a glTF has v down, as its UVs.
    let mut down = options(&rules, &["top=0.25,0.75,1,1"], 2);
    down.format = OutputFormat::Glb;
    let outcome = repacked(&six(), &down);
    let document = Document::read(&written(&outcome)).expect("a file");
    let glass = document.corner_uvs(1, 0).expect("a set").expect("UVs");
    assert!(
        glass
            .as_flattened()
            .iter()
            .all(|uv| uv[1] > 0.75 && uv[0] > 0.25)
    );
}

#[test]
fn densities_are_set_kept_and_equalized() {
    let squares = six();
    // Set for all, and for one material beside others that take the room that is left.
    let all = repacked(
        &squares,
        &options(&["all: density 60", "material=steel: density 90"], &[], 1),
    );
    for (k, corners) in corners(&all).into_iter().enumerate() {
        let expected = if squares[k].material == "steel" {
            90.0
        } else {
            60.0
        };
        assert_near(density(corners, &squares[k]), expected, 1e-3);
    }
    let one = repacked(&squares, &options(&["material=steel: density 90"], &[], 1));
    let after = corners(&one);
    assert_near(density(after[3], &squares[3]), 90.0, 1e-3);
    assert_near(density(after[4], &squares[4]), 90.0, 1e-3);
    assert_near(side(after[0]) / side(after[1]), 0.3 / 0.25, 1e-3);
    // The others have grown.
    assert!(side(after[0]) > 0.31, "{}", side(after[0]));
    // Kept: as large as before.
    let kept = corners(&repacked(
        &squares,
        &options(&["color=ff0000: density keep"], &[], 1),
    ));
    assert_near(side(kept[2]), 0.2, 1e-4);
    assert_near(side(kept[3]), 0.2, 1e-4);
    assert!(side(kept[0]) > 0.31);
    // Equal: squares of 20, 10 and 5 times their size in UV, from 51 to 205 texels per unit.
    let equal = repacked(&squares, &options(&["all: density equal"], &[], 1));
    let densities: Vec<f64> = corners(&equal)
        .into_iter()
        .zip(&squares)
        .map(|(c, s)| density(c, s))
        .collect();
    for found in &densities {
        assert_near(*found, densities[0], 1e-3);
    }
}

#[test]
fn scales_are_beside_the_others() {
    let after = corners(&repacked(
        &six(),
        &options(&["material=glass: scale 1.5"], &[], 1),
    ));
    assert_near(side(after[1]) / side(after[0]), 1.5 * 0.25 / 0.3, 1e-3);
    assert_near(side(after[2]) / side(after[0]), 1.5 * 0.2 / 0.3, 1e-3);
    assert_near(side(after[3]) / side(after[0]), 0.2 / 0.3, 1e-3);
}

#[test]
fn the_report_says_which_islands_change() {
    // At 10 units of length over UV, islands have 102.4 texels per unit.
    let outcome = repacked(
        &six(),
        &options(&["all: density 102.4", "material=wood: lock"], &[], 1),
    );
    let [all, lock] = rules(&outcome) else {
        panic!("two rules");
    };
    assert_eq!((all.rule.as_str(), all.islands), ("all: density 102.4", 6));
    let changed = all.changed.as_ref().expect("about density");
    assert_eq!(
        changed.iter().map(|island| island.face).collect::<Vec<_>>(),
        [4, 8]
    );
    assert_near(changed[0].before.expect("an area"), 51.2, 1e-4);
    assert_near(changed[0].now.expect("an area"), 102.4, 1e-3);
    assert_eq!((lock.islands, lock.changed.is_none()), (2, true));
}

#[test]
fn rules_hold_for_whole_stacks() {
    let mut squares = six();
    squares.push(square([0.4, 0.4], 0.2, 10.0, "steel", GREY));
    let mut options = options(&["faces=0/6: in top"], &["top=0,0.5,1,1"], 1);
    for stack in [None, Some(Stacking::Keep)] {
        options.layout.stack = stack;
        let after = corners(&repacked(&squares, &options));
        assert_eq!(after[3], after[6]);
        assert!(after[3].iter().all(|uv| uv[1] > 0.5));
    }
}

#[test]
fn new_charts_are_cut_along_selections() {
    let mut lines = Vec::new();
    for k in 0..8 {
        lines.push(format!("v {} {} {}", k & 1, k >> 1 & 1, k >> 2));
    }
    for (material, faces) in [
        ("a", ["1 3 4 2", "5 6 8 7", "1 2 6 5"]),
        ("b", ["3 7 8 4", "1 5 7 3", "2 4 8 6"]),
    ] {
        lines.push(format!("usemtl {material}"));
        for face in faces {
            lines.push(format!("f {face}"));
        }
    }
    let upload = Upload::single("cube.obj", lines.join("\n").into_bytes());
    for (rules, ratio) in [
        (&["material=a: in left", "material=b: in right"][..], 1.0),
        (&["material=a: in left", "material=b: scale 2"], 2.0),
        (&["material=a: density 100", "material=b: density 250"], 2.5),
        (&["material=a: density 100"], f64::NAN),
    ] {
        let options = Options {
            control: control(rules, &["left=0,0,0.5,1", "right=0.5,0,1,1"]),
            format: OutputFormat::Obj,
            ..Options::default()
        };
        let outcome = unwrap_document(&upload, &options, &Unobserved).expect("it fits");
        assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
        assert!(
            outcome.report.warnings.is_empty(),
            "{:?}",
            outcome.report.warnings
        );
        let faces = uvs(&written(&outcome));
        let area = |faces: &[CornerUvs]| -> f64 {
            let doubled = |[a, b, c]: &CornerUvs| {
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            faces.iter().map(doubled).sum::<f64>().abs() / 2.0
        };
        let [a, b] = [area(&faces[..6]), area(&faces[6..])];
        if ratio.is_finite() {
            assert_near((b / a).sqrt(), ratio, 1e-3);
        }
        if rules[0].contains("density") {
            assert_near((a / 3.0).sqrt() * 1024.0, 100.0, 1e-3);
        }
        if rules[0].contains("in left") {
            assert!(faces[..6].as_flattened().iter().all(|uv| uv[0] < 0.5));
        }
        if rules[1..].iter().any(|rule| rule.contains("in right")) {
            assert!(faces[6..].as_flattened().iter().all(|uv| uv[0] > 0.5));
        }
    }
}

#[test]
fn meshes_given_as_arrays_have_rules() {
    let mesh = |x: f64, place: f64| MeshArrays {
        positions: vec![[x, 0.0, 0.0], [x + 1.0, 0.0, 0.0], [x, 1.0, 0.0]],
        triangles: vec![[0, 1, 2]],
        uvs: Some(vec![[[place, 0.1], [place + 0.2, 0.1], [place, 0.3]]]),
        normals: None,
    };
    let meshes = [mesh(0.0, 0.1), mesh(5.0, 0.6)];
    let outcome = repack_meshes(&meshes, &options(&["faces=1/0: lock"], &[], 1), &Unobserved)
        .expect("it fits");
    let single = |uvs: &Vec<CornerUvs>| uvs[0].map(|uv| uv.map(|x| f64::from(x as f32)));
    assert_eq!(
        outcome.uvs[1][0],
        single(meshes[1].uvs.as_ref().expect("UVs"))
    );
    assert_ne!(
        outcome.uvs[0][0],
        single(meshes[0].uvs.as_ref().expect("UVs"))
    );
    let none = repack_meshes(
        &meshes,
        &options(&["material=a: lock"], &[], 1),
        &Unobserved,
    );
    assert_eq!(none.expect_err("no materials").code(), "unknown_material");
}

#[test]
fn contradictions_are_refused() {
    for (rules, code) in [
        (&["color=00ff00: lock"][..], "selects_nothing"),
        (&["material=copper: lock"], "unknown_material"),
        (&["faces=0/12: lock"], "unknown_face"),
        (&["faces=1/0: lock"], "unknown_face"),
        (
            &["material=glass: group", "color=ff0000: group"],
            "island_in_two_groups",
        ),
        (
            &["material=glass: group", "color=ff0000: lock"],
            "island_in_two_groups",
        ),
        (
            &["material=glass: lock", "color=ff0000: group"],
            "island_in_two_groups",
        ),
        (
            &["material=glass: group", "color=ff0000: scale 2"],
            "divided_group",
        ),
        (&["material=glass: in narrow"], "rectangle_too_small"),
        (
            &["material=wood: in strip", "material=wood: density 100"],
            "rectangle_too_small",
        ),
        (&["all: density 500"], "texture_too_small"),
        (&["material=glass: in nowhere"], "invalid_options"),
        (&["material=glass: in beyond"], "invalid_options"),
        (&["material=glass: in 1002"], "invalid_options"),
        (&["material=glass: in 1011"], "invalid_options"),
        (&["all: density 0"], "invalid_options"),
        (&["all: scale -1"], "invalid_options"),
    ] {
        let rectangles = [
            "narrow=0,0,1,0.001",
            "strip=0,0,1,0.1",
            "beyond=0.5,0.5,1.5,1",
        ];
        let error = refused(rules, &rectangles);
        assert_eq!(error.code(), code, "{rules:?}: {error}");
    }
    let twice = refused(&["all: lock"], &["a=0,0,1,1", "a=0,0,1,0.5"]);
    assert_eq!(twice.code(), "invalid_options");
    let new = Options {
        control: control(&["all: lock"], &[]),
        ..Options::default()
    };
    let new = unwrap_document(&file(&six()), &new, &Unobserved).expect_err("no islands");
    assert!(new.to_string().contains("requires `repack`"), "{new}");
}

#[test]
fn rules_are_written_as_they_are_read() {
    for text in [
        "all: lock",
        "material=a: b=c: group",
        "color=0a1b2c: in top",
        "faces=0/1,2/3: density keep",
        "material=x: density equal",
        "material=x: density 12.5",
        "material=x: scale 2",
    ] {
        let control = control(&[text], &[]);
        assert_eq!(control.control[0].to_string(), text);
    }
    for text in [
        "all",
        "all: hide",
        "lock",
        "color=red: lock",
        "faces=3: lock",
        "all: in",
        "all: density x",
    ] {
        assert!(
            text.parse::<unwrapd_pipeline::IslandRule>().is_err(),
            "{text}"
        );
    }
    for text in [
        "a",
        "a=0,0,1",
        "a=0,0,0,1",
        "1=0,0,1,1",
        "a b=0,0,1,1",
        "a=0,0,nan,1",
        "=0,0,1,1",
    ] {
        assert!(
            text.parse::<unwrapd_pipeline::NamedRectangle>().is_err(),
            "{text}"
        );
    }
}
