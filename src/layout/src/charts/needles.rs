//! Needles put back into charts.
//!
//! Surfaces are cut [without their needles](Surface::without_needles), so that these decide nothing. Then each step is undone in the
//! chart that holds its faces. Maps stay as they are, but for the vertex of the needle, which is placed so that the needle has an area and
//! is not sheared.
//! Where a seam runs along a flipped edge, the smaller of its faces is laid beside the larger one.

use super::opened::connected_faces;
use super::parts::part;
use super::unfold::overlaps::overlaps;
use super::{Chart, Folds, MappedChart, Observer, map_chart};
use std::collections::BTreeMap;
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::embed::{self, Embedding};
use unwrapd_maps::mesh::{
    CUT, Edges, NEEDLE, NeedleStep, Surface, VertexFaces, longest_side, looks_like_edge,
    same_direction,
};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::{doubled_area, sub};
use unwrapd_method::numerics::{vec2, vec3};

/// Undoes steps in the charts of a surface without needles, the last one first; `surface` is the one with needles, and corners are its
/// corners before and after.
///
/// Charts that no step concerns stay as they are. A chart whose map is not valid with its needles is mapped anew.
pub fn with_needles(
    surface: &Surface,
    steps: &[NeedleStep],
    charts: Vec<MappedChart>,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    // Open the charts that hold a face of a step.
    let mut faces: Vec<u32> = (steps.iter())
        .flat_map(|step| match *step {
            NeedleStep::Flip { needle, other } => [needle / 3, other / 3],
            NeedleStep::Removal { needle, .. } => [needle / 3; 2],
        })
        .collect();
    faces.sort_unstable();
    let is_open = |map: &MappedChart| {
        let mut of_chart = map.chart.corners.iter().map(|corners| corners[0] / 3);
        of_chart.any(|face| faces.binary_search(&face).is_ok())
    };
    let is_open: Vec<bool> = charts.iter().map(is_open).collect();
    let mut pool = Pool::default();
    for (chart, map) in charts
        .iter()
        .enumerate()
        .filter(|(chart, _)| is_open[*chart])
    {
        pool.add(chart, map);
    }
    // Undo the steps, and close the charts.
    for step in steps.iter().rev() {
        match *step {
            NeedleStep::Flip { needle, other } => pool.flip_back(needle, other),
            NeedleStep::Removal {
                needle,
                others,
                vertex,
            } => pool.put_back(needle, others, surface.positions[vertex as usize]),
        }
    }
    let mut mapped = Vec::new();
    for (chart, map) in charts.into_iter().enumerate() {
        if is_open[chart] {
            let parts = pool.charts(chart, &map).into_iter();
            mapped.extend(parts.flat_map(|part| valid(part, options, observer)));
        } else {
            mapped.push(map);
        }
    }
    mapped
}

/// Returns the chart as it is if its map is valid, and mapped anew if not.
fn valid(
    mut map: MappedChart,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    unshear(&mut map);
    let (disk, uv) = (&map.chart.disk, &map.embedding.uv);
    if embed::is_positive(&disk.triangles, uv) && overlaps(disk, uv).is_empty() {
        vec![map]
    } else {
        map_chart(map.chart, options, Folds::Cut, observer)
    }
}

/// Moves the vertex of each needle along its longest side to where it lies at rest, unless that flips a face: a little off, it shears the
/// needle a thousandfold. Vertices on the boundary stay, so nothing overlaps anew.
fn unshear(map: &mut MappedChart) {
    let (chart, uv) = (&map.chart, &mut map.embedding.uv);
    let triangles = &chart.disk.triangles;
    let around = VertexFaces::new(chart.disk.n_vertices, triangles);
    let mut on_boundary = vec![false; chart.disk.n_vertices];
    for &v in chart.disk.loops.iter().flatten() {
        on_boundary[v as usize] = true;
    }
    for triangle in triangles {
        let rest = triangle.map(|v| chart.positions[v as usize]);
        let (first, _) = longest_side(rest);
        let [a, b, c] = [0, 1, 2].map(|k| triangle[(first + k) % 3] as usize);
        if on_boundary[c] || !looks_like_edge(rest) {
            continue;
        }
        let [p, q, r] = [a, b, c].map(|v| chart.positions[v]);
        let side = vec3::sub(q, p);
        let at_rest = vec3::dot(vec3::sub(r, p), side) / vec3::dot(side, side);
        let side = sub(uv[b], uv[a]);
        let squared = vec2::dot(side, side);
        let missing = at_rest - vec2::dot(sub(uv[c], uv[a]), side) / squared;
        let before = uv[c];
        uv[c] = [0, 1].map(|k| before[k] + missing * side[k]);
        let is_valid = |&f: &u32| {
            let [a, b, c] = triangles[f as usize].map(|v| uv[v as usize]);
            orient2d_sign(a, b, c) > 0
        };
        if !around.of(c as u32).iter().all(is_valid) {
            uv[c] = before;
        }
    }
}

/// Faces of charts with their places in the plane.
#[derive(Default)]
struct Pool {
    positions: Vec<[f64; 3]>,
    uv: Vec<[f64; 2]>,
    /// By face of the surface.
    faces: BTreeMap<u32, Face>,
}

#[derive(Clone, Copy)]
struct Face {
    chart: usize,
    /// Vertex of each corner of the surface's face.
    vertices: [u32; 3],
    /// `true` if its chart winds it as the surface does.
    is_wound_as_surface: bool,
}

impl Pool {
    fn add(&mut self, chart: usize, map: &MappedChart) {
        let first = self.positions.len() as u32;
        self.positions.extend(&map.chart.positions);
        self.uv.extend(&map.embedding.uv);
        let triangles = map.chart.disk.triangles.iter().zip(&map.chart.corners);
        for (t, (triangle, corners)) in triangles.enumerate() {
            let mut vertices = [0; 3];
            for (&corner, &v) in corners.iter().zip(triangle) {
                vertices[corner as usize % 3] = first + v;
            }
            let face = Face {
                chart,
                vertices,
                is_wound_as_surface: map.chart.is_wound_as_surface(t),
            };
            self.faces.insert(corners[0] / 3, face);
        }
    }

    /// Turns the faces c, a, d and d, b, c into a, b, c and b, a, d, from their halfedges on.
    fn flip_back(&mut self, needle: u32, other: u32) {
        let (with_a, with_b) = (self.faces[&(needle / 3)], self.faces[&(other / 3)]);
        let ([c, a, d], [d_of_b, b, c_of_b]) = (with_a.vertices, with_b.vertices);
        let (stays, [a, b, c, d]) = if [c, d] == [c_of_b, d_of_b] {
            (with_a, [a, b, c, d])
        } else if self.distance(b, c_of_b) >= self.distance(a, c) {
            let a = self.continued([b, c_of_b], [c, a]);
            (with_b, [a, b, c_of_b, d_of_b])
        } else {
            let b = self.continued([a, c], [c_of_b, b]);
            (with_a, [a, b, c, d])
        };
        self.set(needle, [a, b, c], stays);
        self.set(other, [b, a, d], stays);
        self.raise([a, b, c], stays.is_wound_as_surface);
    }

    /// Divides the face a, b, d into three around a vertex c near the side a b. It lies as far from the other sides as the needle is high
    /// at least.
    fn put_back(&mut self, needle: u32, [of_b, of_a]: [u32; 2], position: [f64; 3]) {
        let whole = self.faces[&(needle / 3)];
        let [a, b, d] = whole.vertices;
        let [p, q] = [a, b].map(|v| self.positions[v as usize]);
        let side = vec3::sub(q, p);
        let squared = vec3::dot(side, side).max(f64::MIN_POSITIVE);
        let along = vec3::dot(vec3::sub(position, p), side) / squared;
        let along = along.clamp(NEEDLE, 1.0 - NEEDLE);
        let [p, q, r] = [a, b, d].map(|v| self.uv[v as usize]);
        let side = sub(q, p);
        let height = doubled_area(p, q, r).abs() / vec2::dot(side, side).max(f64::MIN_POSITIVE);
        let up = NEEDLE.min(height / 3.0) / height.max(f64::MIN_POSITIVE);
        self.uv.push([0, 1].map(|k| {
            let foot = p[k] + along * side[k];
            foot + up * (r[k] - foot)
        }));
        self.positions.push(position);
        let c = self.uv.len() as u32 - 1;
        self.set(needle, [a, b, c], whole);
        self.set(of_b, [c, b, d], whole);
        self.set(of_a, [a, c, d], whole);
    }

    /// Sets the vertices of a face from a halfedge on, in the chart of another face.
    fn set(&mut self, h: u32, vertices: [u32; 3], like: Face) {
        let mut from_first = vertices;
        from_first.rotate_right(h as usize % 3);
        let face = Face {
            vertices: from_first,
            ..like
        };
        self.faces.insert(h / 3, face);
    }

    fn distance(&self, v: u32, w: u32) -> f64 {
        vec3::distance(self.positions[v as usize], self.positions[w as usize])
    }

    /// Adds a vertex beyond the end of a side in the plane, to continue it by a side that lies beyond a seam.
    fn continued(&mut self, [from, to]: [u32; 2], [start, end]: [u32; 2]) -> u32 {
        let ratio = self.distance(start, end) / self.distance(from, to).max(f64::MIN_POSITIVE);
        let [p, q] = [from, to].map(|v| self.uv[v as usize]);
        let way = sub(q, p);
        self.uv.push([q[0] + ratio * way[0], q[1] + ratio * way[1]]);
        self.positions.push(self.positions[end as usize]);
        self.uv.len() as u32 - 1
    }

    /// Moves the vertex c of a needle off its longest side a b until the needle is as high as any needle may be.
    fn raise(&mut self, [a, b, c]: [u32; 3], is_wound_as_surface: bool) {
        let [p, q, r] = [a, b, c].map(|v| self.uv[v as usize]);
        let side = sub(q, p);
        let squared = vec2::dot(side, side).max(f64::MIN_POSITIVE);
        let turn = if is_wound_as_surface { 1.0 } else { -1.0 };
        let missing = NEEDLE - turn * doubled_area(p, q, r) / squared;
        if missing > 0.0 {
            let up = turn * missing;
            self.uv[c as usize] = [r[0] - up * side[1], r[1] + up * side[0]];
        }
    }

    /// Returns the parts of a chart that are left, with their maps. Faces may have come and gone.
    fn charts(&self, chart: usize, before: &MappedChart) -> Vec<MappedChart> {
        let mut triangles = Vec::new();
        let mut corners = Vec::new();
        for (&f, face) in self.faces.iter().filter(|(_, face)| face.chart == chart) {
            let order = if face.is_wound_as_surface {
                [0, 1, 2]
            } else {
                [0, 2, 1]
            };
            triangles.push(order.map(|k| face.vertices[k]));
            corners.push(order.map(|k| 3 * f + k as u32));
        }
        let twin = glued(self.positions.len(), &triangles);
        let (label, n_parts) = connected_faces(&twin);
        let mut parts = Vec::new();
        for sheet in Sheet::divide((&triangles, &self.positions), &twin, &label, n_parts) {
            for (chart, faces) in part(sheet, &corners, before.chart.mirror) {
                parts.push(self.mapped(
                    chart,
                    faces.iter().map(|&f| triangles[f as usize]),
                    before,
                ));
            }
        }
        parts
    }

    /// Returns a chart with the map of its triangles' vertices.
    fn mapped(
        &self,
        chart: Chart,
        triangles: impl Iterator<Item = [u32; 3]>,
        before: &MappedChart,
    ) -> MappedChart {
        let mut uv = vec![[0.0; 2]; chart.disk.n_vertices];
        for (triangle, of_pool) in chart.disk.triangles.iter().zip(triangles) {
            for (&v, w) in triangle.iter().zip(of_pool) {
                uv[v as usize] = self.uv[w as usize];
            }
        }
        MappedChart {
            chart,
            embedding: Embedding {
                uv,
                summary: before.embedding.summary,
            },
            seconds: before.seconds,
        }
    }
}

/// Glues triangles at edges that two of them have, in opposite directions.
fn glued(n_vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut twin = vec![CUT; 3 * triangles.len()];
    for edge in Edges::new(n_vertices, triangles).iter() {
        if let [a, b] = *edge
            && !same_direction(triangles, a, b)
        {
            twin[a as usize] = b;
            twin[b as usize] = a;
        }
    }
    twin
}
