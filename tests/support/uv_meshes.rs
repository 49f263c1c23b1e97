//! Small meshes with corner UVs for the tests of `certificate` and `measure`.

use std::path::Path;
use unwrapd_maps::certificate::{Certificate, Overlap, certify};
use unwrapd_maps::measure::{MeasureOptions, Measures, measure};
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Plain arrays: UVs per face and corner.
#[derive(Clone, Default)]
pub struct UvMesh {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub uvs: Vec<CornerUvs>,
}

impl UvMesh {
    /// Faces in the plane whose UVs are their positions.
    pub fn planar(points: &[[f64; 2]], triangles: &[[u32; 3]]) -> UvMesh {
        UvMesh {
            positions: points.iter().map(|p| [p[0], p[1], 0.0]).collect(),
            triangles: triangles.to_vec(),
            uvs: triangles
                .iter()
                .map(|t| t.map(|v| points[v as usize]))
                .collect(),
        }
    }

    /// The unit square cut into `n` × `n` squares of two faces each, mapped to itself.
    pub fn grid(n: u32) -> UvMesh {
        let at = |i: u32| f64::from(i) / f64::from(n);
        let points: Vec<[f64; 2]> = (0..=n)
            .flat_map(|y| (0..=n).map(move |x| [at(x), at(y)]))
            .collect();
        let square = |x: u32, y: u32| {
            let a = y * (n + 1) + x;
            [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]
        };
        let triangles: Vec<[u32; 3]> = (0..n)
            .flat_map(|y| (0..n).flat_map(move |x| square(x, y)))
            .collect();
        UvMesh::planar(&points, &triangles)
    }

    /// Adds a mesh beside this one, sharing no vertex and no position.
    pub fn add(&mut self, other: &UvMesh) {
        let offset = self.positions.len() as u32;
        let z = 10.0 * f64::from(offset);
        self.positions
            .extend(other.positions.iter().map(|p| [p[0], p[1], p[2] + z]));
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|v| v + offset)));
        self.uvs.extend(&other.uvs);
    }

    /// Changes every UV.
    pub fn map_uvs(mut self, map: impl Fn([f64; 2]) -> [f64; 2]) -> UvMesh {
        for uv in self.uvs.as_flattened_mut() {
            *uv = map(*uv);
        }
        self
    }

    /// Winds a face the other way.
    pub fn reverse(&mut self, face: usize) {
        self.triangles[face].swap(1, 2);
        self.uvs[face].swap(1, 2);
    }

    pub fn certify(&self, overlap: Overlap) -> Certificate {
        certify(&self.positions, &self.triangles, &self.uvs, &overlap.into())
    }

    /// Measured with v up, on a small raster.
    pub fn measure(&self) -> Measures {
        let options = MeasureOptions {
            raster_texels: 256,
            ..MeasureOptions::default()
        };
        self.measure_with(VAxis::Up, options)
    }

    pub fn measure_with(&self, v_axis: VAxis, options: MeasureOptions) -> Measures {
        measure(
            &self.positions,
            &self.triangles,
            &self.uvs,
            v_axis,
            &options,
        )
    }
}

/// A strip of `n` squares closed to a Möbius strip, its UVs unrolled except for the last square, whose UVs lead back to the first.
pub fn moebius_in_one_piece(n: u32) -> UvMesh {
    let mut mesh = UvMesh::default();
    for i in 0..n {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        for side in [-0.3, 0.3] {
            let r = 1.0 + side * (angle / 2.0).cos();
            let z = side * (angle / 2.0).sin();
            mesh.positions.push([r * angle.cos(), r * angle.sin(), z]);
        }
    }
    let uv = |v: u32| [f64::from(v / 2) / f64::from(n), f64::from(v % 2) * 0.1];
    for i in 0..n {
        let (a, b) = (2 * i, 2 * i + 1);
        let (c, d) = if i + 1 < n { (a + 2, b + 2) } else { (1, 0) };
        for triangle in [[a, c, b], [b, c, d]] {
            mesh.triangles.push(triangle);
            mesh.uvs.push(triangle.map(uv));
        }
    }
    mesh
}

/// Reads `v`, `vt` and polygons `f v/vt …`, cut into fans.
pub fn read_obj(path: &Path) -> UvMesh {
    let text = std::fs::read_to_string(path).expect("a text file");
    let mut mesh = UvMesh::default();
    let mut vt: Vec<[f64; 2]> = Vec::new();
    for line in text.lines() {
        let mut words = line.split_whitespace();
        let number = |word: &str| word.parse::<f64>().expect("a number");
        match words.next() {
            Some("v") => {
                let p: Vec<f64> = words.map(number).collect();
                mesh.positions.push([p[0], p[1], p[2]]);
            }
            Some("vt") => {
                let p: Vec<f64> = words.map(number).collect();
                vt.push([p[0], p[1]]);
            }
            Some("f") => {
                let corners: Vec<(u32, [f64; 2])> = words
                    .map(|word| {
                        let ids: Vec<usize> = word
                            .split('/')
                            .take(2)
                            .map(|i| i.parse().expect("an index"))
                            .collect();
                        (ids[0] as u32 - 1, vt[ids[1] - 1])
                    })
                    .collect();
                for k in 1..corners.len() - 1 {
                    let fan = [corners[0], corners[k], corners[k + 1]];
                    mesh.triangles.push(fan.map(|c| c.0));
                    mesh.uvs.push(fan.map(|c| c.1));
                }
            }
            _ => {}
        }
    }
    mesh
}
