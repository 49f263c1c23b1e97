//! UVs pulled by anchors: no flip, untouched charts bit by bit, bijective where boundaries stay.

use crate::uv_meshes;
use unwrapd_deform::Boundary;
use unwrapd_deform::uv::parse_anchors;
use unwrapd_deform::uv::{Anchor, EditedUvs, UvEditOptions, UvMesh, edit_uvs};
use unwrapd_maps::certificate::{Overlap, boundary_crossings, certify, certify_planar, chart_ids};
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::{Control, Iterate, Status};

const SIDE: u32 = 8;

/// Two sheets of 8 × 8 cells, hills in space; the UVs of the second are mirrored, right of those of the first.
struct Sheets {
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    uvs: Vec<CornerUvs>,
}

impl Sheets {
    fn new() -> Self {
        let n = SIDE + 1;
        let mut sheets = Self {
            positions: Vec::new(),
            triangles: Vec::new(),
            uvs: Vec::new(),
        };
        for sheet in 0..2 {
            let first = sheet * n * n;
            for v in 0..n * n {
                let [x, y] = [v % n, v / n].map(|i| f64::from(i) / f64::from(SIDE));
                let height = x * (1.0 - x) * y * (1.0 - y) * 8.0;
                sheets
                    .positions
                    .push([x, y, height + 3.0 * f64::from(sheet)]);
            }
            for j in 0..SIDE {
                for i in 0..SIDE {
                    let a = first + j * n + i;
                    let corners = [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]];
                    sheets.triangles.extend(corners);
                }
            }
        }
        let uv = |v: u32| {
            let [x, y, z] = sheets.positions[v as usize];
            let right = if z >= 3.0 {
                0.95 - 0.4 * x
            } else {
                0.05 + 0.4 * x
            };
            // As a file has them.
            [right, 0.1 + 0.8 * y].map(|x| f64::from(x as f32))
        };
        sheets.uvs = sheets.triangles.iter().map(|t| t.map(uv)).collect();
        sheets
    }

    /// The same with one vertex at another UV.
    fn with(vertex: u32, uv: [f64; 2]) -> Self {
        let mut sheets = Self::new();
        let corners = sheets.triangles.as_flattened().iter();
        let uvs = sheets.uvs.as_flattened_mut().iter_mut();
        for (corner, _) in uvs.zip(corners).filter(|c| *c.1 == vertex) {
            *corner = uv;
        }
        sheets
    }

    fn mesh(&self) -> UvMesh<'_> {
        UvMesh {
            positions: &self.positions,
            triangles: &self.triangles,
            uvs: &self.uvs,
        }
    }

    fn edit(&self, anchors: &[Anchor], options: &UvEditOptions) -> EditedUvs {
        edit_uvs(&self.mesh(), anchors, options, &go_on).expect("anchors that can be pulled")
    }

    #[track_caller]
    fn assert_valid(&self, edited: &EditedUvs) {
        let certificate = certify(
            &self.positions,
            &self.triangles,
            &edited.uvs,
            &Overlap::Test.into(),
        );
        assert!(certificate.is_valid(), "{certificate:?}");
        for chart in &edited.charts {
            assert!(certify_planar(&chart.vertices, &chart.triangles).is_valid());
        }
    }

    /// The UV of a vertex, which has one.
    fn uv(&self, edited: &EditedUvs, vertex: u32) -> [f64; 2] {
        let corners = self.triangles.as_flattened().iter();
        let corner = corners
            .zip(edited.uvs.as_flattened())
            .find(|c| *c.0 == vertex);
        *corner.expect("a used vertex").1
    }
}

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

fn to(vertex: u32, to: [f64; 2]) -> Anchor {
    Anchor::Vertex {
        vertex,
        to,
        weight: None,
    }
}

#[test]
fn anchors_arrive_and_other_charts_stay() {
    let sheets = Sheets::new();
    let second = (SIDE + 1) * (SIDE + 1);
    for (chart, anchors) in [
        (0, [to(0, [0.05, 0.1]), to(second - 1, [0.3, 0.6])]),
        (1, [to(second, [0.95, 0.1]), to(second + 40, [0.6, 0.3])]),
    ] {
        let edited = sheets.edit(&anchors, &UvEditOptions::edit());
        sheets.assert_valid(&edited);
        assert_eq!(edited.charts.len(), 1);
        assert_eq!(edited.charts[0].chart, chart);
        assert_eq!(edited.charts[0].summary.status, Status::Converged);
        for anchor in &anchors {
            if let Anchor::Vertex {
                vertex,
                to,
                weight: None,
            } = anchor
            {
                assert_eq!(sheets.uv(&edited, *vertex), *to);
            }
        }
        let half = sheets.uvs.len() / 2;
        let others = if chart == 0 { half..2 * half } else { 0..half };
        assert_eq!(edited.uvs[others.clone()], sheets.uvs[others]);
    }
}

#[test]
fn a_chart_that_shall_stay_bijective_does() {
    let sheets = Sheets::new();
    // Two corners of one side change places.
    let anchors = [to(0, [0.45, 0.1]), to(SIDE, [0.05, 0.1])];
    let free = sheets.edit(&anchors, &UvEditOptions::edit());
    let judged = |edited: &EditedUvs| {
        let (vertices, triangles) = (&edited.charts[0].vertices, &edited.charts[0].triangles);
        let is_bijective = certify_planar(vertices, triangles).is_bijective();
        (is_bijective, boundary_crossings(vertices, triangles))
    };
    let (is_bijective, n_crossings) = judged(&free);
    assert!(!is_bijective && n_crossings > 0);
    let mut options = UvEditOptions::edit();
    options.model.bijective = true;
    let kept = sheets.edit(&anchors, &options);
    sheets.assert_valid(&kept);
    assert_eq!(judged(&kept), (true, 0));
}

/// Pulls a little at every face of a mesh: its chart is that of the certificate, which finds as many after it and no flip.
fn assert_charts_of_the_certificate(mesh: &uv_meshes::UvMesh, n_charts: usize) {
    let numbers = chart_ids(&mesh.positions, &mesh.triangles, &mesh.uvs);
    assert_eq!(numbers.iter().max(), Some(&(n_charts as u32 - 1)));
    let arrays = UvMesh {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        uvs: &mesh.uvs,
    };
    for (face, number) in mesh.uvs.iter().zip(numbers) {
        let middle = [0, 1].map(|k| (face[0][k] + face[1][k] + face[2][k]) / 3.0);
        let [at, to] = [middle, [middle[0] + 0.01, middle[1]]];
        let edited = edit_uvs(
            &arrays,
            &[Anchor::Place {
                at,
                to,
                weight: None,
            }],
            &UvEditOptions::edit(),
            &go_on,
        )
        .expect("a chart that can be pulled");
        assert_eq!(edited.charts[0].chart, number);
        assert_eq!(edited.charts[0].untangled, 0);
        let judged = certify(
            &mesh.positions,
            &mesh.triangles,
            &edited.uvs,
            &Overlap::Test.into(),
        );
        assert!(judged.is_valid() && judged.charts == n_charts);
    }
}

/// Pieces of which some faces are wound the other way, and one falls apart along a seam.
#[test]
fn charts_are_those_of_the_certificate() {
    let mut mesh = uv_meshes::UvMesh::grid(2);
    for k in 1..4 {
        let mut piece = uv_meshes::UvMesh::grid(2).map_uvs(|[u, v]| [u + 2.0 * f64::from(k), v]);
        piece.reverse(k as usize);
        mesh.add(&piece);
    }
    for uv in mesh.uvs[12..16].as_flattened_mut() {
        uv[1] += 2.0;
    }
    assert_charts_of_the_certificate(&mesh, 5);
}

#[test]
fn pages_of_a_book_are_joined_where_the_certificate_joins_them() {
    // Three pages on the edge from 0 to 1; the UVs of the first and the last agree there.
    let mesh = uv_meshes::UvMesh {
        positions: vec![
            [0.0; 3],
            [0.0, 1.0, 0.0],
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
        ],
        triangles: vec![[0, 1, 2], [0, 4, 1], [0, 3, 1]],
        uvs: vec![
            [[2.0, 0.0], [2.0, 1.0], [1.0, 0.0]],
            [[4.0, 0.0], [5.0, 0.0], [4.0, 1.0]],
            [[2.0, 0.0], [3.0, 0.0], [2.0, 1.0]],
        ],
    };
    assert_charts_of_the_certificate(&mesh, 2);
}

#[test]
fn uvs_that_differ_by_rounding_alone_are_joined_as_the_certificate_joins_them() {
    let mut mesh = uv_meshes::UvMesh::grid(2);
    for (k, uv) in mesh.uvs.as_flattened_mut().iter_mut().enumerate() {
        uv[k % 2] += 1e-9 * (k % 5) as f64;
    }
    assert_charts_of_the_certificate(&mesh, 1);
}

#[test]
fn most_of_the_area_decides_what_is_flipped_in_a_chart() {
    // One large face, and three small ones inside out.
    let places = [
        [0.0, 0.0],
        [4.0, 0.0],
        [0.0, 4.0],
        [3.0, 0.5],
        [0.5, 3.0],
        [0.5, 0.5],
    ];
    let mut mesh =
        uv_meshes::UvMesh::planar(&places, &[[0, 1, 2], [1, 0, 3], [2, 1, 4], [0, 2, 5]]);
    for (vertex, outside) in [(3, [2.0, -2.0]), (4, [4.0, 4.0]), (5, [-2.0, 2.0])] {
        mesh.positions[vertex] = [outside[0], outside[1], 0.0];
    }
    let judged = mesh.certify(Overlap::Test);
    assert_eq!((judged.charts, judged.flipped), (1, 3));
    let arrays = UvMesh {
        positions: &mesh.positions,
        triangles: &mesh.triangles,
        uvs: &mesh.uvs,
    };
    let pulled = [to(1, [4.5, 0.0])];
    let edited = edit_uvs(&arrays, &pulled, &UvEditOptions::edit(), &go_on).expect("untangled");
    assert_eq!(edited.charts[0].untangled, 3);
    mesh.uvs = edited.uvs;
    let judged = mesh.certify(Overlap::Test);
    assert!(
        judged.is_valid() && judged.mirrored_charts == 0,
        "{judged:?}"
    );
}

#[test]
fn anchors_that_pull_nowhere_move_nothing_much() {
    let sheets = Sheets::new();
    let anchors = [to(0, [0.05_f32, 0.1].map(f64::from))];
    let edited = sheets.edit(&anchors, &UvEditOptions::edit());
    for (a, b) in edited
        .uvs
        .as_flattened()
        .iter()
        .zip(sheets.uvs.as_flattened())
    {
        assert!((0..2).all(|k| (a[k] - b[k]).abs() < 1e-3), "{a:?} {b:?}");
    }
}

#[test]
fn fixed_boundaries_stay_and_the_map_is_bijective() {
    let sheets = Sheets::new();
    let middle = SIDE / 2 * (SIDE + 1) + SIDE / 2;
    let mut reached = 0;
    for k in 0..24 {
        let angle = f64::from(k);
        // Up to beyond the boundary.
        let radius = 0.02 * f64::from(k);
        let target = [0.25 + radius * angle.cos(), 0.5 + radius * angle.sin()];
        let edited = sheets.edit(&[to(middle, target)], &UvEditOptions::texture());
        sheets.assert_valid(&edited);
        let chart = &edited.charts[0];
        assert!(certify_planar(&chart.vertices, &chart.triangles).is_bijective());
        let has_arrived = sheets.uv(&edited, middle) == target;
        assert!(has_arrived || chart.summary.status == Status::TargetsUnreachable);
        reached += u32::from(has_arrived);
        for v in 0..=SIDE {
            let uv = |edited: &[CornerUvs]| {
                let corners = sheets.triangles.as_flattened().iter();
                let mut found = corners.zip(edited.as_flattened()).filter(|c| *c.0 == v);
                found.next().map(|c| *c.1)
            };
            assert_eq!(uv(&edited.uvs), uv(&sheets.uvs));
        }
    }
    assert!((8..24).contains(&reached), "{reached}");
}

#[test]
fn an_anchor_by_its_uv_holds_that_very_point() {
    let sheets = Sheets::new();
    let (at, to) = ([0.262, 0.53], [0.29, 0.51]);
    for options in [UvEditOptions::texture(), UvEditOptions::edit()] {
        let edited = sheets.edit(
            &[Anchor::Place {
                at,
                to,
                weight: None,
            }],
            &options,
        );
        sheets.assert_valid(&edited);
        let report = &edited.charts[0].summary;
        assert_eq!(report.status, Status::Converged);
        // Of the face that held the point, the point with the same weights.
        let weights = |[a, b, c]: CornerUvs| {
            let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            [area(at, b, c), area(a, at, c), area(a, b, at)].map(|w| w / area(a, b, c))
        };
        let holds = |face: &usize| weights(sheets.uvs[*face]).iter().all(|&w| w > 0.0);
        let face = (0..sheets.uvs.len()).find(holds).expect("a face");
        let (w, uv) = (weights(sheets.uvs[face]), edited.uvs[face]);
        let there: [f64; 2] = [0, 1].map(|k| (0..3).map(|c| w[c] * uv[c][k]).sum());
        assert!((0..2).all(|k| (there[k] - to[k]).abs() < 1e-8), "{there:?}");
        assert!(report.residual < 1e-16);
    }
}

#[test]
fn an_anchor_hardly_outside_a_chart_moves_the_nearest_vertex() {
    let sheets = Sheets::new();
    let anchor = Anchor::Place {
        at: [0.0495, 0.0996],
        to: [0.03, 0.07],
        weight: None,
    };
    let edited = sheets.edit(&[anchor], &UvEditOptions::edit());
    let uv = sheets.uv(&edited, 0);
    assert!((uv[0] - 0.0305).abs() < 1e-7 && (uv[1] - 0.0704).abs() < 1e-7);
}

#[test]
fn charts_with_flips_are_untangled_first() {
    let sheets = Sheets::with(30, [0.4, 0.4]);
    let target = [0.26, 0.52];
    for options in [UvEditOptions::texture(), UvEditOptions::edit()] {
        let edited = sheets.edit(&[to(40, target)], &options);
        sheets.assert_valid(&edited);
        assert!(edited.charts[0].untangled > 0);
        assert_eq!(sheets.uv(&edited, 40), target);
        // The other chart has none of it.
        let n = sheets.uvs.len() / 2;
        assert_eq!(edited.uvs[n..], sheets.uvs[n..]);
    }
    let valid = Sheets::new().edit(&[to(40, target)], &UvEditOptions::texture());
    assert_eq!(valid.charts[0].untangled, 0);
}

#[test]
fn what_cannot_be_edited_has_a_code() {
    let sheets = Sheets::new();
    let texture = UvEditOptions::texture();
    let code = |sheets: &Sheets, anchors: &[Anchor], options: &UvEditOptions| {
        edit_uvs(&sheets.mesh(), anchors, options, &go_on)
            .expect_err("an error")
            .code()
    };
    let middle = to(40, [0.25, 0.5]);
    assert_eq!(code(&sheets, &[], &texture), "handle_count");
    let far = to(40, [f64::NAN, 0.0]);
    assert_eq!(code(&sheets, &[far], &texture), "bad_target");
    let unknown = to(100_000, [0.0; 2]);
    assert_eq!(code(&sheets, &[unknown], &texture), "unknown_handle");
    let border = to(0, [0.3, 0.3]);
    assert_eq!(code(&sheets, &[border], &texture), "anchor_on_boundary");
    let two = [middle.clone(), to(40, [0.26, 0.5])];
    assert_eq!(code(&sheets, &two, &texture), "contradictory_handles");

    // A corner of the sheet, whose two boundary edges stay, is inside out.
    let flipped = Sheets::with(8, [0.3, 0.2]);
    assert_eq!(code(&flipped, &[middle], &texture), "flipped_uvs");
    // The other chart has no flip.
    let other = to(121, [0.75, 0.5]);
    assert!(edit_uvs(&flipped.mesh(), &[other], &texture, &go_on).is_ok());

    let mut cut = Sheets::new();
    for face in cut.uvs.iter_mut().take(SIDE as usize * 8) {
        *face = face.map(|uv| [uv[0], uv[1] + 2.0]);
    }
    let seam = to(4 * (SIDE + 1) + 4, [0.25, 0.5]);
    assert_eq!(code(&cut, &[seam], &texture), "ambiguous_vertex");
    let free = UvEditOptions {
        boundary: Boundary::Free,
        ..texture
    };
    let by_place = Anchor::Place {
        at: [0.25, 0.5],
        to: [0.27, 0.5],
        weight: None,
    };
    assert_eq!(cut.edit(&[by_place], &free).charts.len(), 1);
}

#[test]
fn anchors_are_read_by_either_name() {
    for name in ["anchors", "points"] {
        let text = format!(
            "{{\"{name}\": [{{\"vertex\": 3, \"to\": [0, 1]}}, {{\"at\": [0.5, 1], \"to\": [1, 0]}}]}}"
        );
        let place = Anchor::Place {
            at: [0.5, 1.0],
            to: [1.0, 0.0],
            weight: None,
        };
        let expected = vec![to(3, [0.0, 1.0]), place];
        assert_eq!(parse_anchors(text.as_bytes()), Ok(expected));
    }
    for text in [
        "",
        "{\"anchors\": [{\"to\": [0, 1]}]}",
        "{\"anchors\": [{\"vertex\": -1, \"to\": [0, 1]}]}",
    ] {
        let error = parse_anchors(text.as_bytes()).expect_err("no anchors");
        assert_eq!(error.code(), "malformed_handles");
    }
}

#[test]
fn an_anchor_outside_every_chart_is_refused() {
    let sheets = Sheets::new();
    let place = |at: [f64; 2]| Anchor::Place {
        at,
        to: [0.2, 0.2],
        weight: None,
    };
    let edited = |at| edit_uvs(&sheets.mesh(), &[place(at)], &UvEditOptions::edit(), &go_on);
    let refused = edited([-5.0, -5.0]).expect_err("no chart");
    assert_eq!(refused.code(), "handle_outside");
    // Beside a corner, as a pointer hits it.
    edited([0.05 - 5e-4, 0.1]).expect("a corner");
}
