//! The maps of two nets, laid together at a hinge.

use super::cut_mesh::CutMesh;
use super::metric::Metric;
use super::net::{Net, chart, weighted};
use super::opening::Opening;
use super::sets::{difference, union};
use crate::charts::{Chart, Observer, Watching, overlaps};
use std::collections::BTreeSet;
use unwrapd_maps::embed;
use unwrapd_method::numerics::vec2::sub;

/// Largest excess that laying two nets together may add to theirs if that is their best map. With none at all the sum of the costs of 11
/// machine parts is higher by .4, and with ten times as much by .2 (`cost` in the reports of `unwrap`).
const EXACT: f64 = 1e-5;

/// Union of two nets, before it is mapped.
pub enum Laid {
    /// The parts overlap away from the hinge, and the optimization seldom moves them apart.
    Collides,
    /// The best map: no map of the union has less excess than the best maps of its parts together, and laying these together adds none.
    Best(Box<Net>),
    /// A start for the map.
    Start(UnionStart),
}

/// Start of the map of a union of two nets.
pub enum UnionStart {
    /// The maps of both, laid together: the chart of the union, and the places of its vertices.
    LaidTogether(Chart, Vec<[f64; 2]>),
    /// A map of its own: the opening joins what is cut inside of one of them.
    Own,
}

impl Laid {
    /// Lays the maps of two nets together where an opening of their union allows it.
    pub fn new(metric: &Metric, [a, b]: [&Net; 2], contact: &[u32], opening: &Opening) -> Self {
        let faces = union(&a.faces, &b.faces);
        let mesh = CutMesh::new(metric, faces, &opening.slits);
        let laid = laid_together(&mesh, [a, b], contact, opening);
        let Some((places, chart)) = laid.zip(chart(&mesh)) else {
            return Self::Start(UnionStart::Own);
        };
        let uv: Vec<[f64; 2]> = (places.into_iter())
            .map(|p| p.map(|x| x * metric.unit))
            .collect();
        let pairs = overlaps(&chart.disk, &uv);
        if pairs.is_empty() {
            let summary = a.summary.beside(&b.summary);
            let net = Net::of_places(metric, &chart, &uv, opening.slits.clone(), summary);
            if net.excess <= a.excess + b.excess + EXACT {
                return Self::Best(Box::new(net));
            }
        }
        let hinge = difference(contact, &opening.slits);
        if are_off_hinge(metric, &chart, &pairs, &hinge) {
            return Self::Collides;
        }
        Self::Start(UnionStart::LaidTogether(chart, uv))
    }
}

impl Net {
    /// Maps an opening of the union of two nets; returns `None` if no map without flips and overlaps is found.
    pub fn of_union(
        metric: &Metric,
        faces: &[u32],
        start: UnionStart,
        opening: &Opening,
        options: &embed::Options,
        observer: &dyn Observer,
    ) -> Option<Self> {
        let UnionStart::LaidTogether(chart, uv) = start else {
            return Self::map(metric, faces, opening, options, observer);
        };
        let weighted = &weighted(options, metric, faces);
        let watching = Watching {
            chart: &chart,
            observer,
        };
        let embedding = embed::optimize(&chart.disk, &chart.positions, &uv, weighted, &watching);
        match embedding {
            Ok(embedding) => Self::checked(metric, opening, &chart, &embedding, weighted, observer),
            Err(_) => Self::map(metric, faces, opening, options, observer),
        }
    }
}

/// Returns whether the faces of any of some pairs have no vertex on a hinge.
fn are_off_hinge(metric: &Metric, chart: &Chart, pairs: &[[u32; 2]], hinge: &[u32]) -> bool {
    let ends = hinge.iter().flat_map(|&edge| metric.ends_of_edge(edge));
    let on_hinge: BTreeSet<u32> = ends.collect();
    let is_off_hinge = |&face: &u32| {
        let face = chart.corners[face as usize][0] / 3;
        let corners = metric.corners[face as usize];
        corners.iter().all(|v| !on_hinge.contains(v))
    };
    pairs.iter().any(|pair| pair.iter().all(is_off_hinge))
}

/// Returns the map of the union of two nets in which both lie as they do, moved together at the edges where the opening
/// keeps them joined; one position per vertex of `mesh`, the union cut along the opening. Returns `None` if the opening
/// joins what is cut inside of one of them.
///
/// The second net is moved by the rigid motion that brings its ends of the hinge as near as possible to those of the
/// first (Kabsch 1976); the vertices of the hinge lie half way between.
fn laid_together(
    mesh: &CutMesh,
    [a, b]: [&Net; 2],
    contact: &[u32],
    way: &Opening,
) -> Option<Vec<[f64; 2]>> {
    let metric = mesh.metric;
    let carried = union(&a.slits, &b.slits);
    let hinge = difference(contact, &way.slits);
    if hinge.is_empty() || !difference(&carried, &way.slits).is_empty() {
        return None;
    }
    let [p, q] = [a, b].map(|net| ends(metric, net, &hinge));
    let [from, to] = [mean(&q), mean(&p)];
    // The rotation as a complex number: the sum of p conj(q), relative to the means.
    let mut turn = [0.0; 2];
    for (&p, &q) in p.iter().zip(&q) {
        let ([px, py], [qx, qy]) = (sub(p, to), sub(q, from));
        turn[0] += px * qx + py * qy;
        turn[1] += py * qx - px * qy;
    }
    let size = turn[0].hypot(turn[1]);
    if !size.is_normal() {
        return None;
    }
    let [cos, sin] = turn.map(|x| x / size);
    let moved = |p: [f64; 2]| {
        let [x, y] = sub(p, from);
        [to[0] + cos * x - sin * y, to[1] + sin * x + cos * y]
    };
    // Vertices of the hinge belong to both.
    let n = mesh.welded.len();
    let mut place: [Vec<Option<[f64; 2]>>; 2] = [vec![None; n], vec![None; n]];
    for (corner, &vertex) in mesh.sheet.vertex.iter().enumerate() {
        let face = mesh.faces[corner / 3];
        if let Ok(at) = a.faces.binary_search(&face) {
            place[0][vertex as usize] = Some(a.uv[at][corner % 3]);
        } else {
            let at = b.faces.binary_search(&face).ok()?;
            place[1][vertex as usize] = Some(moved(b.uv[at][corner % 3]));
        }
    }
    let [first, second] = place;
    let both = first.into_iter().zip(second);
    both.map(|(p, q)| match (p, q) {
        (Some(p), Some(q)) => Some([0, 1].map(|k| f64::midpoint(p[k], q[k]))),
        (p, q) => p.or(q),
    })
    .collect()
}

/// Returns where a net maps the ends of edges of its border: of each edge, given in ascending order, first the lower vertex.
fn ends(metric: &Metric, net: &Net, edges: &[u32]) -> Vec<[f64; 2]> {
    let mut found = vec![[[0.0; 2]; 2]; edges.len()];
    for (&face, corners) in net.faces.iter().zip(&net.uv) {
        for k in 0..3 {
            if let Ok(at) = edges.binary_search(&metric.edge[3 * face as usize + k]) {
                let [a, b] = metric.ends(3 * face + k as u32);
                let ends = [corners[k], corners[(k + 1) % 3]];
                found[at] = if a < b { ends } else { [ends[1], ends[0]] };
            }
        }
    }
    found.into_flattened()
}

fn mean(points: &[[f64; 2]]) -> [f64; 2] {
    let n = points.len().max(1) as f64;
    [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n)
}
