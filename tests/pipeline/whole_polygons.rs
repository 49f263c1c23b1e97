//! Polygons that no seam runs through unless it is asked for.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use unwrapd_files::document::{OutputFormat, Upload};
use unwrapd_files::io::obj;
use unwrapd_layout::charts::Cut;
use unwrapd_maps::certificate::{Overlap, certify};
use unwrapd_pipeline::{
    Cutting, GivenSeams, Options, Outcome, Seams, Settings, Unobserved, unwrap_along,
    unwrap_document,
};

/// Quads around and along a surface that is closed around, or closed both ways.
struct QuadMesh {
    positions: Vec<[f64; 3]>,
    quads: Vec<[u32; 4]>,
}

impl QuadMesh {
    fn new([n, m]: [u32; 2], is_closed: bool, place: impl Fn(f64, f64) -> [f64; 3]) -> Self {
        let rows = if is_closed { m } else { m + 1 };
        let vertex = |i: u32, j: u32| (i % n) * rows + j % rows;
        let at = |i: u32, j: u32| place(f64::from(i) / f64::from(n), f64::from(j) / f64::from(m));
        let quad = |i: u32, j: u32| {
            [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(|[i, j]| vertex(i, j))
        };
        let of_all = |rows: u32| (0..n).flat_map(move |i| (0..rows).map(move |j| [i, j]));
        Self {
            positions: of_all(rows).map(|[i, j]| at(i, j)).collect(),
            quads: of_all(m).map(|[i, j]| quad(i, j)).collect(),
        }
    }

    fn torus() -> Self {
        Self::new([40, 20], true, |u, v| {
            let r = 3.0 + (1.0 + 0.3 * (3.0 * TAU * u).sin()) * (TAU * v).cos();
            let z = (TAU * v).sin() + 0.5 * (2.0 * TAU * u).sin();
            [r * (TAU * u).cos(), r * (TAU * u).sin(), z]
        })
    }

    fn bent_tube() -> Self {
        Self::new([24, 30], false, |u, v| {
            let bend = 1.2 * (4.0 * v).sin();
            [(TAU * u).cos() + bend, (TAU * u).sin(), 6.0 * v]
        })
    }

    fn file(&self) -> Upload {
        let mut text = String::new();
        for [x, y, z] in &self.positions {
            writeln!(text, "v {x} {y} {z}").expect("a string takes it");
        }
        for [a, b, c, d] in self.quads.iter().map(|quad| quad.map(|v| v + 1)) {
            writeln!(text, "f {a} {b} {c} {d}").expect("a string takes it");
        }
        Upload::single("quads.obj", text.into_bytes())
    }

    /// The triangles, and their corners as corners of quads.
    fn triangles(&self) -> (Vec<[u32; 3]>, Vec<[u32; 3]>) {
        let halves = |(k, [a, b, c, d]): (u32, [u32; 4])| {
            let corner = |n: u32| 4 * k + n;
            let corners = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(corner));
            [[a, b, c], [a, c, d]].into_iter().zip(corners)
        };
        (0..)
            .zip(self.quads.iter().copied())
            .flat_map(halves)
            .unzip()
    }
}

fn unwrapped(mesh: &QuadMesh, cut: Cut, seams: Option<GivenSeams>) -> Outcome {
    let options = Options {
        format: OutputFormat::Obj,
        seams,
        cutting: Cutting {
            cut,
            ..Cutting::default()
        },
        ..Options::default()
    };
    unwrap_document(&mesh.file(), &options, &Unobserved).expect("a result")
}

fn n_written(outcome: &Outcome) -> usize {
    let written = obj::read(&outcome.files[0].1).expect("an OBJ file");
    written.polygons().count()
}

/// Number of quads with two UVs at a corner.
fn n_split(uvs: &[[[f64; 2]; 3]]) -> usize {
    let is_split = |pair: &[[[f64; 2]; 3]; 2]| {
        let [[a, _, c], [first, second, _]] = pair;
        a != first || c != second
    };
    uvs.as_chunks()
        .0
        .iter()
        .filter(|pair| is_split(pair))
        .count()
}

#[test]
fn seams_run_along_the_sides_of_polygons() {
    let mut n_split_without = 0;
    for mesh in [QuadMesh::torus(), QuadMesh::bent_tube()] {
        let (triangles, corners) = mesh.triangles();
        let settings = Settings {
            cutting: Cutting {
                cut: Cut::Fast,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let uvs = |polygons: Option<Vec<[u32; 3]>>| {
            let seams = Seams {
                polygons,
                ..Seams::default()
            };
            unwrap_along(&mesh.positions, &triangles, &seams, &settings, &Unobserved)
                .expect("it unwraps")
                .corner_uvs()
        };
        n_split_without += n_split(&uvs(None));
        let whole = uvs(Some(corners));
        assert_eq!(n_split(&whole), 0);
        let certificate = certify(&mesh.positions, &triangles, &whole, &Overlap::Test.into());
        assert!(certificate.is_bijective(), "{certificate:?}");
    }
    assert!(n_split_without > 0, "the meshes are no test");
}

#[test]
fn a_file_of_quads_keeps_its_quads() {
    for mesh in [QuadMesh::torus(), QuadMesh::bent_tube()] {
        for cut in [Cut::Auto, Cut::Fast, Cut::Disk] {
            let outcome = unwrapped(&mesh, cut, None);
            // One disk per component may overlap itself.
            let is_certified = outcome.report.certified || cut == Cut::Disk;
            assert!(is_certified, "{:?}", outcome.report.warnings);
            assert_eq!(n_written(&outcome), mesh.quads.len(), "{cut:?}");
        }
    }
}

#[test]
fn a_seam_along_a_diagonal_that_is_asked_for_is_cut() {
    let mesh = QuadMesh::torus();
    let written = obj::read(&mesh.file().bytes).expect("an OBJ file");
    // A row of diagonals around the torus, as the reader splits the quads.
    let row = written.mesh.triangles.as_chunks().0.iter().step_by(20);
    let diagonals: Vec<[u32; 2]> = row
        .map(|[first, second]: &[[u32; 3]; 2]| {
            let both: Vec<u32> = first
                .iter()
                .copied()
                .filter(|v| second.contains(v))
                .collect();
            [both[0], both[1]]
        })
        .collect();
    assert_eq!(diagonals.len(), 40);
    let seams = Some(GivenSeams::Edges(diagonals));
    let outcome = unwrapped(&mesh, Cut::Auto, seams);
    assert!(n_written(&outcome) > mesh.quads.len());
    let codes = outcome.report.warnings.iter().map(|warning| &*warning.code);
    assert!(codes.into_iter().any(|code| code == "polygons_split"));
}

mod shared {
    use super::*;

    /// Some of its quads have room beside neither of their halves.
    #[test]
    #[ignore = "needs ../shared"]
    fn polygons_make_no_more_charts_than_are_allowed() {
        let path = crate::places::shared("data/closed/sword-quad-dominant.obj");
        let bytes = std::fs::read(path).expect("a readable file");
        let options = Options {
            format: OutputFormat::Obj,
            cutting: Cutting {
                max_charts: Some(8),
                ..Cutting::default()
            },
            ..Options::default()
        };
        let upload = Upload::single("sword.obj", bytes);
        let outcome = unwrap_document(&upload, &options, &Unobserved).expect("a result");
        assert!(outcome.report.groups[0].measures.seams.charts <= 8);
    }
}
