//! Lines, outlines, lists of vertices and soft handles, of bodies, pictures and UV maps.

use unwrapd_deform::uv::{UvEditOptions, UvMesh, edit_uvs, parse_anchors};
use unwrapd_deform::warp::{PictureWarp, WarpOptions, parse_handles, warp_picture};
use unwrapd_deform::{Body, Boundary, Model, Problem, Session, Solution, parse_body_handles};
use unwrapd_files::picture::Image;
use unwrapd_maps::certificate::certify_planar;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::{Control, Iterate, Settings, Stage, Status};

use crate::bodies::sheet;

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

/// A sheet of 16 × 16 cells of side 1 under handles.
fn problem(handles: &str) -> Problem {
    let handles = parse_body_handles(handles.as_bytes()).expect("handles");
    Problem::new(grid(), &handles, &Model::default()).expect("a problem")
}

fn grid() -> Body {
    Body::from(&sheet(16))
}

fn solved(handles: &str) -> (Problem, Solution) {
    let problem = problem(handles);
    let solution = problem.solve(&Settings::follow(), &go_on).expect("a map");
    (problem, solution)
}

/// Returns where a place of a body of the plane is under a map.
fn image_of(body: &Body, x: &[f64], at: [f64; 2]) -> [f64; 2] {
    let place = |all: &[f64], v: u32| -> [f64; 2] { [0, 1].map(|k| all[2 * v as usize + k]) };
    for element in body.corners() {
        let [a, b, c] = [0, 1, 2].map(|k| place(&body.rest, element[k]));
        let cross = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
            (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
        };
        let weights = [cross(at, b, c), cross(a, at, c), cross(a, b, at)];
        if weights.iter().all(|&w| w >= -1e-12) {
            let sum: f64 = weights.iter().sum();
            return [0, 1].map(|k| {
                let corners = element.iter().zip(weights);
                corners.map(|(&v, w)| w / sum * place(x, v)[k]).sum()
            });
        }
    }
    panic!("{at:?} is outside")
}

#[test]
fn a_line_comes_to_the_line_drawn() {
    // A diagonal line becomes an arc of five corners; what is left and right of it is free.
    let bow = r#"{"handles": [{"line": [[2.3, 2.2], [13.1, 13.7]],
                               "to": [[2, 4], [3, 8], [6, 11], [9, 12.5], [13, 13]]}]}"#;
    let (problem, solution) = solved(bow);
    assert_eq!(solution.summary.status, Status::Converged);
    assert_eq!(solution.quality.inverted, 0);
    // Both ends and at least one point for three cells are held exactly.
    let held = &problem.stations[0];
    assert!(held.points.len() + held.vertices.len() >= 6);
    for (from, to) in [([2.3, 2.2], [2.0, 4.0]), ([13.1, 13.7], [13.0, 13.0])] {
        let now = image_of(&problem.body, &solution.x, from);
        assert!((now[0] - to[0]).hypot(now[1] - to[1]) < 1e-6, "{now:?}");
    }
    // What lies between follows: nowhere is the line farther than half a cell from the one drawn.
    let corners = [
        [2.0, 4.0],
        [3.0, 8.0],
        [6.0, 11.0],
        [9.0, 12.5],
        [13.0, 13.0],
    ];
    for step in 0..=40 {
        let t = f64::from(step) / 40.0;
        let at = [2.3 + t * 10.8, 2.2 + t * 11.5];
        let now = image_of(&problem.body, &solution.x, at);
        let away = corners.windows(2).map(|pair| distance(pair, now));
        let away = away.fold(f64::INFINITY, f64::min);
        assert!(away < 0.5, "{at:?} is at {now:?}, {away} from the line");
    }
}

fn distance(segment: &[[f64; 2]], p: [f64; 2]) -> f64 {
    let [a, b] = [segment[0], segment[1]];
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0] * along[0] + along[1] * along[1];
    let t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length;
    let t = t.clamp(0.0, 1.0);
    (p[0] - a[0] - t * along[0]).hypot(p[1] - a[1] - t * along[1])
}

#[test]
fn points_of_a_line_are_independent_of_each_other_and_of_other_handles() {
    let crossing = r#"{"handles": [{"center": [8, 8], "radius": 2, "to": [8, 9]},
                                   {"line": [[1, 8.3], [15, 8.3]], "to": [[1, 8.3], [15, 8.3]]},
                                   {"line": [[8.4, 1], [8.4, 15]], "to": [[8.4, 2], [8.4, 16]]}]}"#;
    let problem = problem(crossing);
    let held = &problem.stations[0];
    let mut taken: Vec<u32> = held.vertices.clone();
    for row in &held.points {
        let free: f64 = (row.iter())
            .filter(|(v, _)| !taken.contains(v))
            .map(|(_, w)| w)
            .sum();
        assert!(free >= 0.5, "{row:?} hangs on vertices that others hold");
        taken.extend(row.iter().map(|(v, _)| v));
    }
    assert!(held.points.len() > 6);
}

#[test]
fn lists_and_outlines_move_as_rigid_bodies() {
    // The vertices 5..=7 × 5..=7 by number, and what an L-shaped outline holds.
    let list: Vec<u32> = (5..8)
        .flat_map(|j| (5..8).map(move |i| 17 * j + i))
        .collect();
    let handles = format!(
        r#"{{"handles": [{{"vertices": {list:?}, "by": [0.5, -0.25], "turn": 30}},
                         {{"outline": [[10.5, 10.5], [14.5, 10.5], [14.5, 12.5], [12.5, 12.5], [12.5, 14.5], [10.5, 14.5]],
                           "to": [12.5, 12]}},
                         {{"vertices": [0, 16]}}]}}"#
    );
    let (problem, solution) = solved(&handles);
    assert_eq!(solution.summary.status, Status::Converged);
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let mut held = 0;
    for (rest, now) in problem.body.rest.chunks(2).zip(solution.x.chunks(2)) {
        let [x, y] = [rest[0], rest[1]];
        let in_list = (5.0..=7.0).contains(&x) && (5.0..=7.0).contains(&y);
        let in_outline =
            (11.0..=14.0).contains(&x) && (11.0..=14.0).contains(&y) && !(x > 12.0 && y > 12.0);
        let there = if in_list {
            let [x, y] = [x - 6.0, y - 6.0];
            [6.5 + cos * x - sin * y, 5.75 + sin * x + cos * y]
        } else if in_outline {
            [x, y - 0.5]
        } else if y == 0.0 && (x == 0.0 || x == 16.0) {
            [x, y]
        } else {
            continue;
        };
        held += 1;
        assert!(
            (now[0] - there[0]).hypot(now[1] - there[1]) < 1e-9,
            "{rest:?} at {now:?}, {there:?}"
        );
    }
    assert_eq!(held, 9 + 12 + 2);
}

#[test]
fn soft_handles_balance_the_energy() {
    // Two corners are held; the opposite one is pulled with several weights.
    let pulled = |weight: f64| {
        let handles = format!(
            r#"{{"handles": [{{"vertex": 0, "to": [0, 0]}}, {{"vertex": 16, "to": [16, 0]}},
                             {{"vertex": 288, "to": [20, 22], "weight": {weight}}}]}}"#
        );
        let (problem, solution) = solved(&handles);
        assert_eq!(solution.summary.status, Status::Converged);
        assert_eq!(solution.quality.inverted, 0);
        // Nothing is missing: a soft handle has no target that it must reach.
        assert!(problem.unreached(&solution).is_empty());
        // The mean triangle has half a unit of area: a weight of 1 counts twice in the numbers of the sheet.
        let mut potential = problem.potential().expect("an energy");
        let slope = potential.gradient(&solution.x).expect("a gradient");
        let gap = [0, 1].map(|k| solution.x[576 + k] - [20.0, 22.0][k]);
        let pull = gap.map(|gap| 2.0 * weight * 2.0 * gap);
        for k in 0..2 {
            let sum = slope[576 + k] + pull[k];
            assert!(
                sum.abs() < 1e-3 * pull[k].abs(),
                "{weight}: {slope:?}, {pull:?}"
            );
        }
        gap[0].hypot(gap[1])
    };
    let gaps: Vec<f64> = [0.01, 0.1, 1.0, 10.0, 1000.0].map(pulled).to_vec();
    assert!(gaps.windows(2).all(|pair| pair[1] < pair[0]), "{gaps:?}");
    assert!(gaps[0] > 5.0 && gaps[4] < 0.02, "{gaps:?}");
}

#[test]
fn a_session_settles_where_soft_handles_lead_a_job() {
    let handles = r#"{"handles": [{"center": [2, 2], "radius": 1.5, "to": [2, 2]},
                                  {"line": [[10, 3.3], [10, 12.2]], "to": [[12, 3], [14, 12]], "weight": 2},
                                  {"at": [5.3, 13.4], "to": [4, 15], "weight": 0.5}]}"#;
    let (_, solution) = solved(handles);
    let mut session = Session::new(grid(), &Model::default()).expect("a session");
    for handle in parse_body_handles(handles.as_bytes()).expect("handles") {
        session.add(handle).expect("a handle");
    }
    while session.step() == Stage::Moving {}
    assert_eq!(session.stage(), Stage::Settled);
    assert_eq!(
        session.analyses(),
        1,
        "points and soft rows lie within elements"
    );
    let positions = session.positions();
    let away = positions
        .iter()
        .zip(&solution.x)
        .map(|(a, b)| (a - b).abs());
    assert!(away.fold(0.0, f64::max) < 1e-4);
}

#[test]
fn only_soft_handles_are_enough() {
    let shifted =
        r#"{"handles": [{"low": [-1, -1], "high": [17, 17], "to": [11, 5], "weight": 1}]}"#;
    let (problem, solution) = solved(shifted);
    assert_eq!(solution.summary.status, Status::Converged);
    for (rest, now) in problem.body.rest.chunks(2).zip(solution.x.chunks(2)) {
        assert!(
            (now[0] - rest[0] - 3.0).hypot(now[1] - rest[1] + 3.0) < 1e-5,
            "{rest:?}, {now:?}"
        );
    }
}

#[test]
fn handles_that_cannot_be_have_codes() {
    let code = |handle: &str| {
        let list = format!(r#"{{"handles": [{handle}]}}"#);
        let handles = parse_body_handles(list.as_bytes());
        let problem = |handles: Vec<_>| Problem::new(grid(), &handles, &Model::default());
        handles.and_then(problem).expect_err(handle).code()
    };
    assert_eq!(
        code(r#"{"vertex": 0, "to": [0, 0], "weight": 0}"#),
        "bad_parameter"
    );
    assert_eq!(
        code(r#"{"vertex": 0, "to": [0, 0], "weight": -1}"#),
        "bad_parameter"
    );
    assert_eq!(code(r#"{"vertices": [], "by": [0, 0]}"#), "handle_outside");
    assert_eq!(
        code(r#"{"vertices": [289], "by": [0, 0]}"#),
        "unknown_handle"
    );
    assert_eq!(
        code(r#"{"vertices": [1], "by": [0, 0], "to": [0, 0]}"#),
        "bad_parameter"
    );
    assert_eq!(
        code(r#"{"outline": [[0, 0], [1, 1]], "to": [0, 0]}"#),
        "bad_parameter"
    );
    assert_eq!(
        code(r#"{"line": [[1, 1]], "to": [[1, 1], [2, 2]]}"#),
        "handle_outside"
    );
    assert_eq!(
        code(r#"{"line": [[1, 1], [1, 1]], "to": [[1, 1], [2, 2]]}"#),
        "handle_outside"
    );
    assert_eq!(
        code(r#"{"line": [[-2, -2], [-1, -1]], "to": [[1, 1], [2, 2]]}"#),
        "handle_outside"
    );
    assert_eq!(
        code(r#"{"line": [[1, 1], [2, null]], "to": [[1, 1], [2, 2]]}"#),
        "bad_target"
    );
    assert_eq!(
        code(r#"{"select": "material=Glass", "by": [1, 0]}"#),
        "malformed_handles"
    );
    assert_eq!(
        code(r#"{"center": [8, 8], "radius": 2, "to": [8, 8], "turn": 200, "weight": 1}"#),
        "bad_parameter"
    );
}

// Pictures.

fn warped(handles: &str, boundary: Boundary) -> PictureWarp {
    let handles = parse_handles(handles.as_bytes()).expect("handles");
    let options = WarpOptions {
        grid: 32,
        boundary,
        ..WarpOptions::default()
    };
    warp_picture(&Image::transparent(96, 72), &handles, &options, &go_on).expect("a warp")
}

#[test]
fn lines_of_a_picture_bend_it_without_folds() {
    // The horizon becomes a wave, from border to border: next to a fixed border the line ends.
    let wave = r#"{"handles": [{"line": [[0, 36], [96, 36]],
                                "to": [[0, 36], [24, 28], [48, 36], [72, 44], [96, 36]]}]}"#;
    for boundary in [Boundary::Free, Boundary::Fixed] {
        let warp = warped(wave, boundary);
        assert_eq!(warp.summary.status, Status::Converged, "{boundary:?}");
        assert!(warp.summary.unreached.is_empty());
        assert!(warp.summary.residual < 1e-9);
        assert!(certify_planar(&warp.deformed, warp.grid.triangles()).is_valid());
    }
    let lasso = r#"{"handles": [{"outline": [[30, 20], [60, 20], [45, 50]], "to": [50, 38], "turn": 20},
                                {"at": [80, 60], "to": [70, 50], "weight": 0.1}]}"#;
    let warp = warped(lasso, Boundary::Fixed);
    assert_eq!(warp.summary.status, Status::Converged);
}

// UV maps.

/// A flat square of 16 × 16 cells, its UVs its places.
fn map() -> (Vec<[f64; 3]>, Vec<[u32; 3]>, Vec<CornerUvs>) {
    let mesh = sheet(16);
    let uv = |v: u32| mesh.vertices()[v as usize].map(|x| x / 16.0);
    let uvs = mesh.triangles().iter().map(|t| t.map(uv)).collect();
    let positions = mesh.vertices().iter().map(|p| [p[0], p[1], 0.0]).collect();
    (positions, mesh.triangles().to_vec(), uvs)
}

#[test]
fn lines_lists_and_soft_anchors_pull_uvs() {
    let (positions, triangles, uvs) = map();
    let mesh = UvMesh {
        positions: &positions,
        triangles: &triangles,
        uvs: &uvs,
    };
    let anchors = r#"{"anchors": [{"line": [[0, 0.52], [1, 0.52]], "to": [[0, 0.5], [0.5, 0.6], [1, 0.5]]},
                                  {"vertices": [20, 21, 37, 38], "by": [0.01, 0.02]},
                                  {"at": [0.71, 0.83], "to": [0.8, 0.9], "weight": 1}]}"#;
    let anchors = parse_anchors(anchors.as_bytes()).expect("anchors");
    for options in [UvEditOptions::edit(), UvEditOptions::texture()] {
        let edited = edit_uvs(&mesh, &anchors, &options, &go_on).expect("a map");
        let [chart] = &edited.charts[..] else {
            panic!("one chart")
        };
        assert_eq!(chart.summary.status, Status::Converged, "{options:?}");
        assert!(chart.summary.smallest > 0.0);
        assert!(chart.summary.residual < 1e-12, "{}", chart.summary.residual);
        for (face, triangle) in triangles.iter().enumerate() {
            for (c, vertex) in triangle.iter().enumerate() {
                if [20, 21, 37, 38].contains(vertex) {
                    let [before, after] = [uvs[face][c], edited.uvs[face][c]];
                    let by = [after[0] - before[0], after[1] - before[1]];
                    assert!((by[0] - 0.01).hypot(by[1] - 0.02) < 1e-9, "{by:?}");
                }
            }
        }
    }
}
