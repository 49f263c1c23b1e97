//! Charts that the caller decides on: islands that are there, edges, hard normals, materials, a number.

use std::collections::BTreeSet;

use unwrapd_layout::atlas::Rotation;
use unwrapd_layout::charts::{Cut, Quality};
use unwrapd_maps::certificate::{Claims, certify, chart_ids};
use unwrapd_pipeline::{
    Cutting, KeptMaps, Layout, Mapping, PipelineError, Seams, Settings, Unobserved, Unwrapped,
    unwrap_along,
};

use crate::zoo::{self, Mesh};

/// Without cuts that only make the atlas fuller: whether one pays turns on the last digits of a map.
fn unwrapped(mesh: &Mesh, cut: Cut, seams: &Seams) -> Unwrapped {
    let settings = Settings {
        cutting: Cutting {
            cut,
            seam_weight: 1e6,
            ..Cutting::default()
        },
        ..Settings::default()
    };
    let made = unwrap_along(
        &mesh.positions,
        &mesh.triangles,
        seams,
        &settings,
        &Unobserved,
    );
    let made = made.expect("it unwraps");
    let certificate = certify(
        &positions(mesh),
        &mesh.triangles,
        &made.corner_uvs(),
        &Claims::default(),
    );
    assert!(certificate.is_bijective(), "{certificate:?}");
    made
}

fn positions(mesh: &Mesh) -> Vec<[f64; 3]> {
    mesh.positions.iter().map(|p| p.map(f64::from)).collect()
}

fn charts(mesh: &Mesh, made: &Unwrapped) -> Vec<u32> {
    chart_ids(&positions(mesh), &mesh.triangles, &made.corner_uvs())
}

/// A label for each face by where its center lies.
fn labels(mesh: &Mesh, label: impl Fn([f32; 3]) -> u32) -> Vec<u32> {
    let center = |t: &[u32; 3]| {
        let corners = t.map(|v| mesh.positions[v as usize]);
        [0, 1, 2].map(|k| corners.iter().map(|p| p[k]).sum::<f32>() / 3.0)
    };
    mesh.triangles.iter().map(|t| label(center(t))).collect()
}

/// UVs that are x and y, those of faces with other labels shifted.
fn islands(mesh: &Mesh, labels: &[u32]) -> Vec<[[f64; 2]; 3]> {
    let faces = mesh.triangles.iter().zip(labels);
    let at = |v: u32, label: u32| {
        let [x, y, _] = mesh.positions[v as usize].map(f64::from);
        [x + 100.0 * f64::from(label), y]
    };
    faces.map(|(t, &label)| t.map(|v| at(v, label))).collect()
}

#[test]
fn islands_are_kept() {
    let mesh = zoo::grid(8, 6);
    let labels = labels(&mesh, |[x, _, _]| u32::from(x > 4.0));
    let seams = Seams {
        uvs: Some(islands(&mesh, &labels)),
        ..Seams::default()
    };
    assert_eq!(charts(&mesh, &unwrapped(&mesh, Cut::Keep, &seams)), labels);
    // Mirrored or folded ones are made valid.
    let mut mirrored = seams.clone();
    for uv in mirrored.uvs.iter_mut().flatten().flatten() {
        uv[0] = -uv[0];
    }
    assert_eq!(
        charts(&mesh, &unwrapped(&mesh, Cut::Keep, &mirrored)),
        labels
    );
    let mut folded = seams.clone();
    for uv in folded.uvs.iter_mut().flatten().flatten() {
        uv[1] = (uv[1] - 2.5).abs();
    }
    assert_eq!(charts(&mesh, &unwrapped(&mesh, Cut::Keep, &folded)), labels);
}

#[test]
fn islands_are_repacked_as_they_are() {
    let mesh = zoo::grid(8, 6);
    let labels = labels(&mesh, |[x, _, _]| u32::from(x > 4.0));
    // Sheared, so that optimizing would change it; the second island is seen from behind.
    let mut uvs = islands(&mesh, &labels);
    for (face, &label) in uvs.iter_mut().zip(&labels) {
        for uv in face {
            uv[0] += 0.7 * uv[1];
            uv[1] *= if label == 1 { -1.0 } else { 1.0 };
        }
    }
    let seams = Seams {
        uvs: Some(uvs.clone()),
        ..Seams::default()
    };
    let settings = Settings {
        cutting: Cutting {
            cut: Cut::Keep,
            kept_maps: KeptMaps::AsGiven,
            ..Cutting::default()
        },
        layout: Layout {
            rotate: Rotation::Quarter,
            ..Layout::default()
        },
        ..Settings::default()
    };
    let made = unwrap_along(
        &mesh.positions,
        &mesh.triangles,
        &seams,
        &settings,
        &Unobserved,
    );
    let made = made.expect("it packs");
    let packed = made.corner_uvs();
    let certificate = certify(
        &positions(&mesh),
        &mesh.triangles,
        &packed,
        &Claims::default(),
    );
    assert!(certificate.is_bijective());
    assert_eq!(certificate.mirrored_charts, 1);
    // One scale, and a quarter turn for each island: edges keep their length and, up to that, their direction.
    for (face, packed) in uvs.iter().zip(&packed) {
        let edge = |f: &[[f64; 2]; 3]| [f[1][0] - f[0][0], f[1][1] - f[0][1]];
        let (before, after) = (edge(face).map(|x| x * made.scale), edge(packed));
        let [x, y] = before;
        let turned = [[x, y], [-y, x], [-x, -y], [y, -x]];
        let distance = |p: &[f64; 2]| (p[0] - after[0]).hypot(p[1] - after[1]);
        assert!(
            turned.iter().any(|p| distance(p) < 1e-6),
            "{before:?} {after:?}"
        );
    }
}

#[test]
fn named_edges_are_cut() {
    let mesh = zoo::grid(8, 6);
    let on_line = |v: u32| mesh.positions[v as usize][0] == 4.0;
    let pairs = mesh
        .triangles
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let line: Vec<[u32; 2]> = pairs.filter(|e| e.iter().all(|&v| on_line(v))).collect();
    assert!(!line.is_empty());
    let seams = Seams {
        edges: Some(line),
        ..Seams::default()
    };
    let expected = labels(&mesh, |[x, _, _]| u32::from(x > 4.0));
    for cut in [Cut::Seams, Cut::Auto, Cut::Fast, Cut::Disk] {
        assert_eq!(
            charts(&mesh, &unwrapped(&mesh, cut, &seams)),
            expected,
            "{cut:?}"
        );
    }
    assert!(
        charts(&mesh, &unwrapped(&mesh, Cut::Seams, &Seams::default()))
            .iter()
            .all(|&c| c == 0)
    );
}

#[test]
fn hard_normals_part_a_cube_into_six() {
    let mesh = zoo::voxels(&[[0, 0, 0]]);
    let normal = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize].map(f64::from));
        let (p, q) = (
            [0, 1, 2].map(|k| b[k] - a[k]),
            [0, 1, 2].map(|k| c[k] - a[k]),
        );
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
        ]
    };
    let seams = Seams {
        normals: Some(mesh.triangles.iter().map(|t| [normal(t); 3]).collect()),
        ..Seams::default()
    };
    let made = unwrapped(&mesh, Cut::Seams, &seams);
    let count = |charts: Vec<u32>| charts.into_iter().collect::<BTreeSet<_>>().len();
    assert_eq!(count(charts(&mesh, &made)), 6);
}

#[test]
fn materials_are_borders_in_every_mode() {
    let mesh = zoo::sphere(16, 12);
    let of_face = labels(&mesh, |[_, _, z]| u32::from(z > 0.0));
    let seams = Seams {
        labels: Some(of_face.clone()),
        ..Seams::default()
    };
    for cut in [Cut::Auto, Cut::Fast, Cut::Disk, Cut::Seams] {
        let charts = charts(&mesh, &unwrapped(&mesh, cut, &seams));
        let across = |(&chart, &label): (&u32, &u32)| (chart, label);
        let pairs: BTreeSet<_> = charts.iter().zip(&of_face).map(across).collect();
        let n_charts = charts.iter().collect::<BTreeSet<_>>().len();
        assert_eq!(
            pairs.len(),
            n_charts,
            "{cut:?}: each chart has one material"
        );
    }
}

#[test]
fn a_number_of_charts_loosens_the_bound() {
    let mesh = zoo::torus(24, 16);
    let made = |max_charts| {
        let settings = Settings {
            cutting: Cutting {
                max_charts,
                quality: Quality::Smooth,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let seams = Seams::default();
        let made = unwrap_along(
            &mesh.positions,
            &mesh.triangles,
            &seams,
            &settings,
            &Unobserved,
        );
        made.expect("it unwraps").charts.len()
    };
    let (free, one) = (made(None), made(Some(1)));
    assert!(one <= free);
    assert_eq!(one, 1, "of {free}");
}

/// A saddle whose angle at the center is 2.4° more than a full turn.
fn saddle(n_rays: u32, n_rings: u32) -> Mesh {
    let at = |ring: u32, ray: u32| {
        let (sin, cos) = (std::f32::consts::TAU * ray as f32 / n_rays as f32).sin_cos();
        let r = ring as f32 / n_rings as f32;
        [r * cos, r * sin, r * 0.19 * sin * cos]
    };
    let vertex = |ring: u32, ray: u32| match ring {
        0 => 0,
        _ => 1 + (ring - 1) * n_rays + ray % n_rays,
    };
    let outer = (1..=n_rings).flat_map(|ring| (0..n_rays).map(move |ray| at(ring, ray)));
    let mut triangles = Vec::new();
    for ray in 0..n_rays {
        triangles.push([0, vertex(1, ray), vertex(1, ray + 1)]);
        for ring in 1..n_rings {
            let [a, b] = [vertex(ring, ray), vertex(ring + 1, ray)];
            let [c, d] = [vertex(ring + 1, ray + 1), vertex(ring, ray + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh {
        name: "saddle".into(),
        positions: [[0.0; 3]].into_iter().chain(outer).collect(),
        triangles,
    }
}

#[test]
fn the_sides_of_a_slit_are_pushed_apart() {
    // Slit to the center, an isometric map would overlap itself by 2.4°: a sliver that is no chart of its own.
    let (n_rays, n_rings) = (48, 16);
    let ray = (0..n_rings).map(|ring| match ring {
        0 => [0, 1],
        _ => [1 + (ring - 1) * n_rays, 1 + ring * n_rays],
    });
    let seams = Seams {
        edges: Some(ray.collect()),
        ..Seams::default()
    };
    let made = unwrapped(&saddle(n_rays, n_rings), Cut::Seams, &seams);
    assert_eq!(made.charts.len(), 1);
}

#[test]
fn seams_that_do_not_fit_are_refused() {
    let mesh = zoo::grid(2, 2);
    let settings = Settings::default();
    let made = |seams: &Seams| {
        unwrap_along(
            &mesh.positions,
            &mesh.triangles,
            seams,
            &settings,
            &Unobserved,
        )
    };
    let short = Seams {
        labels: Some(vec![0]),
        ..Seams::default()
    };
    let beyond = Seams {
        edges: Some(vec![[0, 1000]]),
        ..Seams::default()
    };
    for seams in [short, beyond] {
        let refused = made(&seams)
            .map(|_| ())
            .map_err(|error: PipelineError| error.code());
        assert_eq!(refused, Err("invalid_seams"));
    }
}

/// A strip whose rows get thinner and thinner: at 12 bits the thinnest vanish.
fn graded_strip() -> Mesh {
    let mut mesh = zoo::grid(12, 12);
    for p in &mut mesh.positions {
        p[1] = 12.0 * 0.45_f32.powf(p[1]);
    }
    mesh
}

#[test]
fn what_shall_be_safe_at_twelve_bits_is() {
    let mesh = graded_strip();
    let holds = |quantization_safe| {
        let settings = Settings {
            mapping: Mapping {
                quantization_safe,
                ..Mapping::default()
            },
            ..Settings::default()
        };
        let seams = Seams::default();
        let made = unwrap_along(
            &mesh.positions,
            &mesh.triangles,
            &seams,
            &settings,
            &Unobserved,
        );
        let uvs = made.expect("it unwraps").corner_uvs();
        let claims = Claims {
            bits: Some(12),
            ..Claims::default()
        };
        let certificate = certify(&positions(&mesh), &mesh.triangles, &uvs, &claims);
        certificate.bits.expect("asked for").hold
    };
    assert!(!holds(None), "the mesh is no test");
    assert!(holds(Some(12)));
}

/// An edge alone inside a surface opens nothing: it is as if it had not been named.
#[test]
fn a_lone_edge_opens_nothing() {
    let mesh = zoo::sphere(8, 6);
    let [a, b, _] = mesh.triangles[20];
    let lone = Seams {
        edges: Some(vec![[a, b]]),
        ..Seams::default()
    };
    for cut in [Cut::Seams, Cut::Auto] {
        let made = unwrapped(&mesh, cut, &lone);
        assert_eq!(
            made.grid,
            unwrapped(&mesh, cut, &Seams::default()).grid,
            "{cut:?}"
        );
    }
}
