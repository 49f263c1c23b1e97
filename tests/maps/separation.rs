//! Distances of charts and what rounding leaves apart, against brute force.

use crate::random::Random;
use crate::uv_meshes::UvMesh;
use unwrapd_maps::certificate::{Certificate, Claims, Overlap, Padding, certify};
use unwrapd_maps::mesh::{CornerUvs, Resolution, VAxis};

fn judged(mesh: &UvMesh, claims: &Claims) -> Certificate {
    certify(&mesh.positions, &mesh.triangles, &mesh.uvs, claims)
}

fn padded(mesh: &UvMesh, texels: u32, resolution: u32) -> bool {
    let padding = Some(Padding {
        texels,
        resolution: Resolution::square(resolution),
    });
    let claims = Claims {
        padding,
        ..Claims::default()
    };
    judged(mesh, &claims).padding.expect("asked for").kept
}

fn at_bits(mesh: &UvMesh, bits: u32) -> Certificate {
    let claims = Claims {
        bits: Some(bits),
        ..Claims::default()
    };
    judged(mesh, &claims)
}

/// Triangles without common positions, each a chart of its own.
fn apart(triangles: &[CornerUvs]) -> UvMesh {
    let mut mesh = UvMesh::default();
    for uvs in triangles {
        let mut triangle = UvMesh::grid(1);
        triangle.triangles.truncate(1);
        triangle.uvs = vec![*uvs];
        mesh.add(&triangle);
    }
    mesh
}

/// A slit: two triangles around one vertex, of which one edge is open by an angle.
fn slit(opening: f64) -> UvMesh {
    let points = [
        [0.5, 0.5],
        [0.9, 0.5],
        [0.5, 0.9],
        [0.1, 0.5],
        [0.5, 0.1],
        [0.9, 0.5 - opening],
    ];
    UvMesh::planar(&points, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
}

#[test]
fn padding_is_kept_at_just_its_distance_and_not_one_step_below() {
    let step = f64::from(1 << 23).recip();
    let left = [[0.0, 0.0], [0.25, 0.0], [0.25, 0.5]];
    for (shift, kept) in [(0.0, true), (step, true), (-step, false)] {
        let x = 0.25 + 3.0 / 256.0 + shift;
        let right = [[x, 0.125], [0.75, 0.0], [0.75, 0.5]];
        assert_eq!(padded(&apart(&[left, right]), 3, 256), kept, "{shift}");
    }
}

#[test]
fn diagonal_gaps_are_compared_exactly() {
    // A vertex over a slope of 3:4, at distance 5/64 and moved by a step.
    let slope = [[0.0, 0.0], [0.5, 0.375], [0.0, 0.375]];
    let step = f64::from(1 << 23).recip();
    for (shift, kept) in [(0.0, true), (step, false)] {
        let tip = [0.25 + 3.0 / 64.0, 0.1875 - 4.0 / 64.0 + shift];
        let below = [tip, [0.25, 0.0], [0.5, 0.0]];
        assert_eq!(padded(&apart(&[slope, below]), 5, 64), kept, "{shift}");
    }
}

#[test]
fn a_chart_inside_another_keeps_no_padding() {
    let large = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let small = [[0.25, 0.25], [0.3, 0.25], [0.25, 0.3]];
    assert!(!padded(&apart(&[large, small]), 2, 1024));
}

#[test]
fn numbers_off_the_grid_are_in_doubt() {
    // The gap is the bound to less than 2⁻⁴⁰: not proven, and a little farther it is.
    let x = 1.0 / 1024.0;
    let left = [[0.0, 0.0], [x, 0.0], [x, 0.5]];
    let right = |x: f64| [[x, 0.125], [0.75, 0.0], [0.75, 0.5]];
    let odd = 2.0 * x + 1e-14;
    assert!(!padded(&apart(&[left, right(odd)]), 1, 1024));
    assert!(padded(&apart(&[left, right(odd + 1e-11)]), 1, 1024));
}

#[test]
fn what_was_reached_is_reported() {
    let left = [[0.0, 0.0], [0.25, 0.0], [0.25, 0.5]];
    let right = [[0.3125, 0.0], [0.75, 0.0], [0.3125, 0.5]];
    let claims = Claims {
        padding: Some(Padding {
            texels: 100,
            resolution: Resolution::square(1024),
        }),
        ..Claims::default()
    };
    let verdict = judged(&apart(&[left, right]), &claims).padding;
    let verdict = verdict.expect("asked for");
    assert_eq!(verdict.reached_texels, Some(64.0));
    assert_eq!((verdict.kept, verdict.pairs_too_close), (false, 1));
    assert_eq!(verdict.offending_faces, [[0, 1]]);
}

#[test]
fn mirrored_charts_are_told_by_where_v_points() {
    let mut mesh = UvMesh::grid(2);
    mesh.add(&UvMesh::grid(3).map_uvs(|[u, v]| [-1.0 - u, v]));
    for (v_axis, mirrored) in [(VAxis::Up, 1), (VAxis::Down, 1)] {
        let claims = Claims {
            v_axis,
            ..Claims::default()
        };
        assert_eq!(judged(&mesh, &claims).mirrored_charts, mirrored);
        assert_eq!(
            judged(&UvMesh::grid(2), &claims).mirrored_charts,
            usize::from(v_axis == VAxis::Down)
        );
    }
}

#[test]
fn a_slit_holds_while_it_stays_open() {
    // The far ends of the slit's edges lie this far apart; each may move by 1.4e-4 at 12 bits.
    for (opening, holds) in [(1e-2, true), (5e-4, true), (2e-4, false), (1e-5, false)] {
        let certificate = at_bits(&slit(opening), 12);
        assert!(certificate.is_bijective());
        assert_eq!(certificate.grid_bits, Some(12), "all faces are large");
        let verdict = certificate.bits.expect("asked for");
        assert_eq!(verdict.hold, holds, "{opening}: {verdict:?}");
        assert_eq!(certificate.safe_bits == Some(12), holds);
        assert_eq!(verdict.offending_pairs.is_empty(), holds);
    }
}

#[test]
fn a_face_too_thin_for_the_bits_is_named() {
    let thin = [[0.0, 0.0], [0.5, 0.0], [0.5, 1e-4]];
    let mut mesh = apart(&[[[0.0, 0.5], [0.5, 0.5], [0.5, 0.75]], thin]);
    let verdict = at_bits(&mesh, 12).bits.expect("asked for");
    assert_eq!((verdict.hold, verdict.faces_in_doubt), (false, 1));
    assert_eq!(verdict.offending_faces, [1]);
    assert!(at_bits(&mesh, 16).bits.expect("asked for").hold);
    mesh.uvs[1] = mesh.uvs[0];
    assert_eq!(at_bits(&mesh, 16).safe_bits, None, "they overlap");
}

/// Two triangles at random: held apart by the certificate if and only if no pair of moves of whole triangles, which is what brings
/// two segments together best, makes them touch.
#[test]
fn separation_is_what_no_move_of_whole_charts_ends() {
    let mut random = Random::new(11);
    let mut seen = [0; 2];
    let size = 0.5_f64.powi(9);
    for _ in 0..400 {
        let mut corner = |x: f64| [x + random.next() * size, 0.25 + random.next() * size * 4.0];
        let triangle = [corner(0.25), corner(0.25), corner(0.25)];
        let other = 0.25 + size * 0.7;
        let other = [corner(other), corner(other), corner(other)];
        let mesh = apart(&[triangle, other]);
        let certificate = at_bits(&mesh, 12);
        if !certificate.is_bijective() {
            continue;
        }
        let delta = 0.5 / 4095.0 + 0.5_f64.powi(16);
        let touches = (0..21).any(|i| {
            (0..21).any(|j| {
                let [x, y] = [i, j].map(|k: i32| 2.0 * delta * f64::from(k - 10) / 10.0);
                let moved = other.map(|p| [p[0] + x, p[1] + y]);
                !apart(&[triangle, moved])
                    .certify(Overlap::default())
                    .is_bijective()
            })
        });
        let verdict = certificate.bits.expect("asked for");
        assert!(
            !(touches && verdict.pairs_in_doubt == 0),
            "{triangle:?} {other:?}"
        );
        // The moves tried are a grid: what touches only between its points is left out.
        seen[usize::from(touches)] += usize::from(touches == (verdict.pairs_in_doubt > 0));
    }
    assert!(
        seen.iter().all(|&n| n > 20),
        "both cases agree often: {seen:?}"
    );
}
