//! Ways along the edges of a sheet, and their mirror images.

use unwrapd_maps::cut::{Neighbors, Sheet, distances_until, opposite_end};
use unwrapd_method::numerics::vec3::{add_scaled, distance, dot, polyline_length, sub};

/// What an edge costs that lies on the mirrored way, as a share of one that lies an edge's length away.
const ALONG: f64 = 0.1;

/// A way from a vertex, or one of several, to a goal.
#[derive(Clone, Debug)]
pub struct Way {
    /// A halfedge of each edge, and the vertices, both from the goal on.
    pub edges: Vec<u32>,
    pub vertices: Vec<u32>,
    /// What it costs.
    pub cost: f64,
}

impl Way {
    /// The cheapest.
    pub fn cheapest(
        sheet: &Sheet,
        neighbors: &Neighbors,
        from: impl IntoIterator<Item = u32>,
        cost: impl Fn(u32) -> f64,
        is_goal: impl Fn(u32) -> bool,
    ) -> Option<Self> {
        let (distances, end) = distances_until(sheet, neighbors, from, cost, is_goal);
        let end = end?;
        let edges: Vec<u32> = distances.path(sheet, end).collect();
        let mut vertices = vec![end];
        for &h in &edges {
            vertices.push(opposite_end(sheet, h, vertices[vertices.len() - 1]));
        }
        Some(Self {
            cost: distances.distance[end as usize],
            edges,
            vertices,
        })
    }

    /// Its goal.
    pub fn end(&self) -> u32 {
        self.vertices[0]
    }

    /// Its length.
    pub fn length(&self, sheet: &Sheet) -> f64 {
        self.edges.iter().map(|&h| sheet.length(h)).sum()
    }
}

/// Costs of edges that lead along a polyline.
pub fn along<'a>(sheet: &'a Sheet, line: &'a [[f64; 3]]) -> impl Fn(u32) -> f64 + 'a {
    let unit = (polyline_length(line) / (line.len() as f64 - 1.0).max(1.0)).max(f64::MIN_POSITIVE);
    move |h| {
        let away = distance_from(line, sheet.middle(h)) / unit;
        sheet.length(h) * (ALONG + away * away)
    }
}

fn distance_from(line: &[[f64; 3]], p: [f64; 3]) -> f64 {
    let from_piece = |of: &[[f64; 3]]| {
        let (along, to) = (sub(of[1], of[0]), sub(p, of[0]));
        let t = (dot(along, to) / dot(along, along).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        distance(p, add_scaled(of[0], t, along))
    };
    line.windows(2)
        .map(from_piece)
        .fold(f64::INFINITY, f64::min)
}

/// The vertices at the place of that which is nearest to a point, of those that `is_allowed`.
pub fn vertices_at(sheet: &Sheet, point: [f64; 3], is_allowed: impl Fn(u32) -> bool) -> Vec<u32> {
    let allowed = || {
        (0u32..)
            .zip(&sheet.positions)
            .filter(|&(v, _)| is_allowed(v))
    };
    let nearest = allowed().min_by(|a, b| distance(*a.1, point).total_cmp(&distance(*b.1, point)));
    let Some((_, &place)) = nearest else {
        return Vec::new();
    };
    let there = allowed().filter(|&(_, &p)| p == place);
    there.map(|(v, _)| v).collect()
}
