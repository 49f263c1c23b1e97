//! Discs and boxes that handles of pictures, of UV maps and of bodies hold as rigid bodies.

use unwrapd_deform::uv::{Anchor, EditError, UvEditOptions, UvMesh, edit_uvs, parse_anchors};
use unwrapd_deform::warp::{PictureHandle, PictureWarp, WarpOptions, parse_handles, warp_picture};
use unwrapd_deform::{Body, Boundary, Handle, Model, Problem, Region, bind};
use unwrapd_files::picture::Image;
use unwrapd_maps::certificate::certify_planar;
use unwrapd_method::solver::{Control, Iterate, Settings, Status};

use crate::bodies::sheet;

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn warped(handles: &str, grid: usize, boundary: Boundary) -> PictureWarp {
    let handles = parse_handles(handles.as_bytes()).expect("handles");
    let options = WarpOptions {
        grid,
        boundary,
        ..WarpOptions::default()
    };
    warp_picture(&Image::transparent(80, 60), &handles, &options, &go_on).expect("a warp")
}

/// Asserts that the vertices within `radius` of `center` are where the rigid motion to `to`, `degrees` counter-clockwise
/// as seen, leads; y points down.
#[track_caller]
fn assert_rigid(warp: &PictureWarp, center: [f64; 2], radius: f64, to: [f64; 2], degrees: f64) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut held = 0;
    for (rest, now) in warp.grid.vertices().iter().zip(&warp.deformed) {
        let [x, y] = [0, 1].map(|k| rest[k] - center[k]);
        if x.hypot(y) <= radius {
            held += 1;
            let there = [to[0] + cos * x + sin * y, to[1] - sin * x + cos * y];
            assert!(
                (0..2).all(|k| (now[k] - there[k]).abs() < 1e-9),
                "{rest:?}: {now:?}, {there:?}"
            );
        }
    }
    assert!(held > 4, "{held} vertices");
}

#[test]
fn discs_of_a_picture_that_change_places_keep_their_shapes() {
    let swap = r#"{"handles": [{"center": [25, 30], "radius": 6, "to": [55, 30]},
                               {"center": [55, 30], "radius": 6, "to": [25, 30]}]}"#;
    for boundary in [Boundary::Fixed, Boundary::Free] {
        let warp = warped(swap, 40, boundary);
        assert_eq!(warp.summary.status, Status::Converged);
        assert!(warp.summary.unreached.is_empty());
        assert_rigid(&warp, [25.0, 30.0], 6.0, [55.0, 30.0], 0.0);
        assert_rigid(&warp, [55.0, 30.0], 6.0, [25.0, 30.0], 0.0);
        assert!(certify_planar(&warp.deformed, warp.grid.triangles()).is_valid());
    }
}

#[test]
fn a_region_of_a_picture_turns_as_it_is_seen() {
    let turned = r#"{"handles": [{"center": [40, 30], "radius": 10, "to": [42, 31], "turn": 90}]}"#;
    let warp = warped(turned, 40, Boundary::Fixed);
    assert_eq!(warp.summary.status, Status::Converged);
    assert_rigid(&warp, [40.0, 30.0], 10.0, [42.0, 31.0], 90.0);
    // What was right of the center is above it now.
    let is_right = |rest: &[f64; 2]| (rest[0] - 46.0).hypot(rest[1] - 30.0) < 1e-9;
    let right = warp.grid.vertices().iter().position(is_right);
    let now = warp.deformed[right.expect("a vertex right of the center")];
    assert!((now[0] - 42.0).hypot(now[1] - 25.0) < 1e-9, "{now:?}");
}

#[test]
fn vertices_of_a_fixed_border_stay_out_of_regions() {
    let corner = r#"{"handles": [{"low": [0, 0], "high": [20, 20], "to": [13, 12]}]}"#;
    let warp = warped(corner, 20, Boundary::Fixed);
    assert_eq!(warp.summary.status, Status::Converged);
    for (rest, now) in warp.grid.vertices().iter().zip(&warp.deformed) {
        let on_border = rest[0] == 0.0 || rest[1] == 0.0;
        if rest[0] <= 20.0 && rest[1] <= 20.0 {
            let by = if on_border { [0.0, 0.0] } else { [3.0, 2.0] };
            assert!((0..2).all(|k| (now[k] - rest[k] - by[k]).abs() < 1e-9));
        }
    }
}

#[test]
fn a_region_that_does_not_arrive_is_named_once() {
    let outside = r#"{"handles": [{"at": [20, 20], "to": [21, 20]},
                                  {"center": [55, 30], "radius": 6, "to": [155, 30]}]}"#;
    let warp = warped(outside, 20, Boundary::Fixed);
    assert_eq!(warp.summary.status, Status::TargetsUnreachable);
    let named: Vec<usize> = warp.summary.unreached.iter().map(|u| u.handle).collect();
    assert_eq!(named, [1]);
}

#[test]
fn regions_of_pictures_that_cannot_be_have_codes() {
    let code = |handle: &str, grid: usize| {
        let handles = parse_handles(format!(r#"{{"handles": [{handle}]}}"#).as_bytes());
        let options = WarpOptions {
            grid,
            ..WarpOptions::default()
        };
        let warp = |handles: Vec<PictureHandle>| {
            warp_picture(&Image::transparent(80, 60), &handles, &options, &go_on)
        };
        handles.and_then(warp).expect_err("an error").code()
    };
    let disc = |rest: &str| format!(r#"{{"center": [33, 33], "to": [40, 30], {rest}}}"#);
    assert_eq!(code(&disc(r#""radius": 1"#), 5), "empty_region");
    assert_eq!(code(&disc(r#""radius": -1"#), 5), "bad_target");
    assert_eq!(code(&disc(r#""radius": 30, "turn": 181"#), 5), "bad_target");
    assert_eq!(
        code(&disc(r#""radius": 30, "turns": 1"#), 5),
        "malformed_handles"
    );
    let upside_down = r#"{"low": [30, 30], "high": [20, 40], "to": [30, 30]}"#;
    assert_eq!(code(upside_down, 5), "bad_target");
    let elsewhere = r#"{"center": [90, 30], "radius": 50, "to": [30, 30]}"#;
    assert_eq!(code(elsewhere, 5), "handle_outside");
}

/// A flat sheet of 20 × 20 cells as a UV map over the unit square.
struct FlatSheet {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<[[f64; 2]; 3]>,
}

impl FlatSheet {
    fn new() -> Self {
        let mesh = sheet(20);
        let places = mesh.vertices().iter().map(|p| p.map(|x| x / 20.0));
        let places: Vec<[f64; 2]> = places.collect();
        Self {
            positions: places.iter().map(|&[x, y]| [x, y, 0.0]).collect(),
            triangles: mesh.triangles().to_vec(),
            uvs: (mesh.triangles().iter())
                .map(|t| t.map(|v| places[v as usize]))
                .collect(),
        }
    }

    fn edit(&self, anchors: &str) -> Result<Vec<[f64; 2]>, EditError> {
        let mesh = UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        };
        let anchors = parse_anchors(anchors.as_bytes())?;
        let edited = edit_uvs(&mesh, &anchors, &UvEditOptions::texture(), &go_on)?;
        let mut of_vertex = vec![[0.0; 2]; self.positions.len()];
        for (corner, uv) in (self.triangles.as_flattened().iter()).zip(edited.uvs.as_flattened()) {
            of_vertex[*corner as usize] = *uv;
        }
        assert!(certify_planar(&of_vertex, &self.triangles).is_valid());
        Ok(of_vertex)
    }
}

#[test]
fn a_region_of_a_uv_map_moves_as_a_rigid_body() {
    let flat = FlatSheet::new();
    let uvs = flat
        .edit(r#"{"anchors": [{"center": [0.4, 0.5], "radius": 0.16, "to": [0.5, 0.45], "turn": 60}]}"#)
        .expect("an edit");
    let (sin, cos) = 60.0_f64.to_radians().sin_cos();
    let mut held = 0;
    for ([x, y, _], uv) in flat.positions.iter().zip(&uvs) {
        let [x, y] = [x - 0.4, y - 0.5];
        if x.hypot(y) <= 0.16 {
            held += 1;
            let there = [0.5 + cos * x - sin * y, 0.45 + sin * x + cos * y];
            assert!(
                (0..2).all(|k| (uv[k] - there[k]).abs() < 1e-9),
                "{uv:?} {there:?}"
            );
        }
    }
    assert!(held > 20);
}

#[test]
fn regions_of_uv_maps_that_cannot_be_have_codes() {
    let flat = FlatSheet::new();
    for (anchors, code) in [
        (
            r#"{"center": [0.525, 0.526], "radius": 0.001, "to": [0.5, 0.5]}"#,
            "empty_region",
        ),
        (
            r#"{"center": [1.5, 0.5], "radius": 2, "to": [0.5, 0.5]}"#,
            "handle_outside",
        ),
        (
            r#"{"center": [0.5, 0.5], "radius": null, "to": [0.5, 0.5]}"#,
            "malformed_handles",
        ),
        (
            r#"{"center": [0.5, 0.5], "radius": 0.1, "to": [0.5, null]}"#,
            "bad_target",
        ),
        (
            r#"{"center": [0.05, 0.5], "radius": 0.1, "to": [0.1, 0.5]}"#,
            "anchor_on_boundary",
        ),
        (
            r#"{"center": [0.5, 0.5], "radius": 0.1, "to": [0.5, 0.5]},
               {"at": [0.5, 0.5], "to": [0.6, 0.5]}"#,
            "contradictory_handles",
        ),
    ] {
        let error = flat
            .edit(&format!(r#"{{"anchors": [{anchors}]}}"#))
            .expect_err(code);
        assert_eq!(error.code(), code, "{anchors}");
    }
}

#[test]
fn a_box_of_a_body_is_the_disc_with_its_vertices() {
    let body = || Body::from(&sheet(10));
    let solved = |handle: Handle| {
        let stay = Handle::Box {
            low: vec![0.0, 0.0],
            high: vec![10.0, 1.0],
            to: vec![5.0, 0.5],
            turn: 0.0,
            axis: None,
            weight: None,
        };
        let problem = Problem::new(body(), &[stay, handle], &Model::default()).expect("a problem");
        problem.solve(&Settings::follow(), &go_on).expect("a map").x
    };
    // The four corners of a cell: 0.71 from its middle.
    let disc = solved(Handle::Disc {
        center: vec![5.5, 6.5],
        radius: 0.75,
        to: vec![6.0, 8.0],
        turn: 30.0,
        axis: None,
        weight: None,
    });
    let boxed = Region::Box {
        low: [5.0, 6.0],
        high: [6.0, 7.0],
        to: [6.0, 8.0],
        turn: 30.0,
        weight: None,
    };
    assert_eq!(disc, solved(boxed.into()));
}

#[test]
fn handles_of_regions_are_read_as_they_are_written() {
    let region = Region::Box {
        low: [1.0, 2.0],
        high: [3.0, 4.0],
        to: [5.0, 6.0],
        turn: 7.0,
        weight: None,
    };
    let written = serde_json::to_string(&Anchor::Region(region.clone())).expect("JSON");
    let read = parse_anchors(format!(r#"{{"anchors": [{written}]}}"#).as_bytes());
    assert_eq!(read, Ok(vec![Anchor::Region(region.clone())]));
    let bound = bind(&Body::from(&sheet(10)), &[region.into()]).expect("a box with vertices");
    assert_eq!(bound.aims[0].vertices.len(), 9);
}
