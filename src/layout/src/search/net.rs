//! A set of faces with its slits and its map.

use super::cut_mesh::CutMesh;
use super::metric::Metric;
use super::opening::{Opening, price};
use crate::charts::{Chart, MappedChart, Observer, Watching, all_pushed_apart, overlaps};
use unwrapd_maps::embed::{self, Embedding};
use unwrapd_maps::mesh::{CUT, Disk, next};
use unwrapd_method::numerics::hull::{convex_hull, smallest_page};
use unwrapd_method::numerics::ties::tied;
use unwrapd_method::solver::Summary;

/// Excess at which a face cannot be called more distorted: one squeezed to nothing in floating point would outweigh all others.
const LARGEST: f64 = 1e6;

/// Faces laid into the plane without flips and overlaps.
#[derive(Clone, Debug)]
pub struct Net {
    /// Faces in ascending order.
    pub faces: Vec<u32>,
    /// Edges cut inside, in ascending order.
    pub slits: Vec<u32>,
    /// Length of the slits.
    pub length: f64,
    /// Sum of the excess over 4 times the weight of each face.
    pub excess: f64,
    /// Sum of the excess times the area of each face, on which the user sets the bound.
    pub unweighted: f64,
    /// Area of the faces that are [stretched](Metric::most_stretch).
    pub stretched: f64,
    /// Area of the smallest square around the map.
    pub page: f64,
    /// Corners of each face in the plane.
    pub uv: Vec<[[f64; 2]; 3]>,
    /// Summary of the minimizations that made the map.
    pub summary: Summary,
    /// Seconds of the observer's clock that its map took.
    pub seconds: f64,
}

impl Net {
    /// Returns the price at a price of the excess.
    pub fn price(&self, lambda: f64) -> f64 {
        price(self.length, self.excess, lambda)
    }

    fn new(
        metric: &Metric,
        faces: Vec<u32>,
        slits: Vec<u32>,
        uv: Vec<[[f64; 2]; 3]>,
        summary: Summary,
    ) -> Self {
        let [excess, unweighted, stretched] = distortion(metric, &faces, &uv);
        Self {
            excess,
            unweighted,
            stretched,
            length: metric.length_of(&slits),
            page: tied(page(&uv)),
            summary,
            seconds: 0.0,
            faces,
            slits,
            uv,
        }
    }

    /// Creates the net of one face at rest.
    pub fn of_face(metric: &Metric, face: u32) -> Self {
        let uv = vec![metric.face_at_rest(face)];
        Self::new(metric, vec![face], Vec::new(), uv, Summary::at_start(0.0))
    }

    /// Maps an opening of some faces; returns `None` if no map without flips and overlaps is found.
    pub fn map(
        metric: &Metric,
        faces: &[u32],
        opening: &Opening,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Option<Self> {
        let mesh = CutMesh::new(metric, faces, &opening.slits);
        let chart = chart(&mesh)?;
        let options = &weighted(options, metric, faces);
        let watching = Watching {
            chart: &chart,
            observer,
        };
        let embedding = embed::parameterize(&chart.disk, &chart.positions, options, &watching);
        Self::checked(metric, opening, &chart, &embedding, options, observer)
    }

    /// Creates the net of a map if it has no flips, and no overlaps but such that can be pushed apart.
    pub fn checked(
        metric: &Metric,
        opening: &Opening,
        chart: &Chart,
        embedding: &Embedding,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Option<Self> {
        if !embed::is_positive(&chart.disk.triangles, &embedding.uv) {
            return None;
        }
        let watching = Watching { chart, observer };
        let pairs = overlaps(&chart.disk, &embedding.uv);
        let uv = all_pushed_apart(chart, &embedding.uv, &pairs, options, &watching)?;
        let slits = opening.slits.clone();
        Some(Self::of_places(
            metric,
            chart,
            &uv,
            slits,
            embedding.summary,
        ))
    }

    /// Creates the net of a chart, whose faces are in ascending order, from the places of its vertices.
    pub fn of_places(
        metric: &Metric,
        chart: &Chart,
        uv: &[[f64; 2]],
        slits: Vec<u32>,
        summary: Summary,
    ) -> Self {
        let faces = chart.corners.iter().map(|corners| corners[0] / 3).collect();
        let place = |v: u32| uv[v as usize].map(|x| x / metric.unit);
        let uv = (chart.disk.triangles.iter()).map(|triangle| triangle.map(place));
        Self::new(metric, faces, slits, uv.collect(), summary)
    }

    /// Creates the net of a chart as it is mapped.
    pub fn of_chart(metric: &Metric, map: &MappedChart) -> Self {
        let place = |v: u32| map.embedding.uv[v as usize].map(|x| x / metric.unit);
        let (faces, mut uv) = own_corners(metric, &map.chart, place);
        if uv.iter().map(doubled_area).sum::<f64>() < 0.0 {
            for p in uv.as_flattened_mut() {
                p[0] = -p[0];
            }
        }
        let slits = slits(metric, &faces, &uv);
        Self {
            seconds: map.seconds,
            ..Self::new(metric, faces, slits, uv, map.embedding.summary)
        }
    }

    /// Returns the net as a chart with its map.
    pub fn mapped_chart(&self, metric: &Metric) -> Option<MappedChart> {
        let mesh = CutMesh::new(metric, &*self.faces, &self.slits);
        let chart = chart(&mesh)?;
        let mut uv = vec![[0.0; 2]; chart.disk.n_vertices];
        for (triangle, corners) in chart.disk.triangles.iter().zip(&self.uv) {
            for (&v, p) in triangle.iter().zip(corners) {
                uv[v as usize] = p.map(|x| x * metric.unit);
            }
        }
        let map = MappedChart {
            chart,
            embedding: Embedding {
                uv,
                summary: self.summary,
            },
            seconds: self.seconds,
        };
        Some(map.facing_front())
    }
}

/// Returns the options with what the energy of each face counts beside its area.
pub fn weighted(options: &embed::Options, metric: &Metric, faces: &[u32]) -> embed::Options {
    let weight = |&face: &u32| {
        let face = face as usize;
        metric.weight[face] / metric.area[face].max(f64::MIN_POSITIVE)
    };
    embed::Options {
        weights: faces.iter().map(weight).collect(),
        ..options.clone()
    }
}

/// Returns the chart of a cut mesh; `None` if it is no disk.
pub fn chart(mesh: &CutMesh) -> Option<Chart> {
    let triangles = mesh.sheet.vertex.as_chunks().0.to_vec();
    let disk = Disk::new(mesh.sheet.positions.len(), triangles).ok()?;
    let corners = mesh.faces.iter().map(|&face| {
        let order = if mesh.metric.is_turned[face as usize] {
            [0, 2, 1]
        } else {
            [0, 1, 2]
        };
        order.map(|k| 3 * face + k)
    });
    Some(Chart {
        corners: corners.collect(),
        positions: mesh.sheet.positions.clone(),
        disk,
        mirror: None,
    })
}

/// Returns the faces of a chart in ascending order, and what its vertices have at the corners of each, in the winding of the metric.
fn own_corners<T: Copy + Default>(
    metric: &Metric,
    chart: &Chart,
    of_vertex: impl Fn(u32) -> T,
) -> (Vec<u32>, Vec<[T; 3]>) {
    let corners = chart.corners.iter().zip(&chart.disk.triangles);
    let mut faces: Vec<(u32, [T; 3])> = corners
        .map(|(corners, triangle)| {
            let mut own = [T::default(); 3];
            for (&corner, &v) in corners.iter().zip(triangle) {
                own[own_corner(metric, corner)] = of_vertex(v);
            }
            (corners[0] / 3, own)
        })
        .collect();
    faces.sort_by_key(|(face, _)| *face);
    faces.into_iter().unzip()
}

/// Returns the corner, in the winding of the metric, of a corner `3 f + c` of the surface.
fn own_corner(metric: &Metric, corner: u32) -> usize {
    let k = corner as usize % 3;
    if metric.is_turned[corner as usize / 3] {
        [0, 2, 1][k]
    } else {
        k
    }
}

/// Returns the excess of mapped faces by weight and by area, and the area of those that are stretched.
fn distortion(metric: &Metric, faces: &[u32], uv: &[[[f64; 2]; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (&face, corners) in faces.iter().zip(uv) {
        let distortion = metric.distortion_of_face(face, *corners);
        let is_flipped = distortion.det <= 0.0;
        let excess = if is_flipped {
            LARGEST
        } else {
            distortion.excess.clamp(0.0, LARGEST)
        };
        sum[0] += metric.weight[face as usize] * excess;
        sum[1] += metric.area[face as usize] * excess;
        if is_flipped || distortion.stretch > metric.most_stretch {
            sum[2] += metric.area[face as usize];
        }
    }
    sum
}

/// Returns the edges between faces whose corners differ there: places of a map, or vertices of a chart.
fn slits<T: Copy + PartialEq>(metric: &Metric, faces: &[u32], corners: &[[T; 3]]) -> Vec<u32> {
    let ends = |face: usize, h: u32| [h % 3, next(h) % 3].map(|k| corners[face][k as usize]);
    let mut slits = Vec::new();
    for (place, &face) in faces.iter().enumerate() {
        for h in 3 * face..3 * face + 3 {
            let t = metric.twin[h as usize];
            if t == CUT || t < h {
                continue;
            }
            if let Ok(other) = faces.binary_search(&(t / 3)) {
                let [a, b] = ends(place, h);
                if ends(other, t) != [b, a] {
                    slits.push(metric.edge[h as usize]);
                }
            }
        }
    }
    slits.sort_unstable();
    slits
}

/// Returns the area of the smallest square around a map.
fn page(uv: &[[[f64; 2]; 3]]) -> f64 {
    smallest_page(&convex_hull(uv.as_flattened().iter().copied()), 1.0).area
}

fn doubled_area(&[a, b, c]: &[[f64; 2]; 3]) -> f64 {
    unwrapd_method::numerics::vec2::doubled_area(a, b, c)
}
