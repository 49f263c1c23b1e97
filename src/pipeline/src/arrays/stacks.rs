//! Islands that coincide, packed as one.
//!
//! Islands that lie on each other share their texels, and a layout that separates them takes texels away. So one island
//! of each stack is packed, and the others get the places of its vertices. Two islands coincide if their borders do, up
//! to rounding, edge by edge; triangles inside may differ. On the border the first island's numbers count, so that all
//! islands of a stack have exactly one outline in the result.

use std::collections::{BTreeMap, HashMap};

use super::seams::Seams;
use unwrapd_layout::atlas::{Atlas, Placed};
use unwrapd_layout::charts::MappedChart;
use unwrapd_method::numerics::bounds::bounds_of;

/// Error of f32 coordinates after a motion, in units of the largest coordinate: a few roundings of 2⁻²⁴.
const ROUNDINGS: f64 = 8.0 / 16_777_216.0;

/// Charts that lie on others, and where the others are.
pub struct Stacks {
    /// Each chart before, in order.
    members: Vec<Member>,
}

/// A chart that is packed, or lies on one that is.
enum Member {
    /// It is packed, with this number.
    Top(usize),
    /// It lies on this one.
    On(usize, Box<MappedChart>, VertexPlaces),
}

/// For each vertex of a chart a vertex of the chart that it lies on.
type VertexPlaces = Vec<u32>;

impl Stacks {
    /// Separates the charts that are packed from those of the same material and rules that lie on them. Inner vertices of a chart
    /// that lies on another are appended to the map of that one where it has no vertex; they belong to no triangle.
    pub fn of(charts: Vec<MappedChart>, seams: &Seams) -> (Vec<MappedChart>, Self) {
        let all = charts
            .iter()
            .flat_map(|chart| chart.embedding.uv.as_flattened());
        let tolerance = ROUNDINGS * all.fold(0.0, |most: f64, x| most.max(x.abs()));
        let mut tops: Vec<MappedChart> = Vec::new();
        let mut outlines: Vec<Outline> = Vec::new();
        let mut by_place: BTreeMap<(usize, [u32; 2], i64), Vec<usize>> = BTreeMap::new();
        let mut stacks = Self {
            members: Vec::with_capacity(charts.len()),
        };
        for chart in charts {
            let outline = Outline::new(&chart);
            let step = (outline.low[0] / tolerance).floor() as i64;
            let kind = material_and_rules(&chart, seams);
            let key = |step: i64| (outline.edges.len(), kind, step);
            let near = by_place.range(key(step.saturating_sub(1))..=key(step.saturating_add(1)));
            let found = near
                .flat_map(|(_, tops)| tops)
                .find_map(|&top| Some((top, outline.places_on(&outlines[top], tolerance)?)));
            if let Some((top, on_border)) = found {
                let places = vertex_places(&chart, &on_border, &mut tops[top]);
                stacks
                    .members
                    .push(Member::On(top, Box::new(chart), places));
            } else {
                by_place.entry(key(step)).or_default().push(tops.len());
                stacks.members.push(Member::Top(tops.len()));
                outlines.push(outline);
                tops.push(chart);
            }
        }
        (tops, stacks)
    }

    /// Returns all charts in their first order, each where its stack was placed; those that lie on others are shifted by
    /// this number of grid units along u.
    pub fn restored(
        self,
        tops: Vec<MappedChart>,
        atlas: Atlas,
        shift: i32,
    ) -> (Vec<MappedChart>, Atlas) {
        let of_tops = atlas.placed;
        let mut placed = Vec::with_capacity(self.members.len());
        let mut charts = Vec::with_capacity(self.members.len());
        let mut number = vec![0; tops.len()];
        let mut tops: Vec<Option<MappedChart>> = tops.into_iter().map(Some).collect();
        for member in self.members {
            let (top, places, chart, shift) = match member {
                Member::Top(top) => {
                    number[top] = charts.len();
                    let Some(mut chart) = tops[top].take() else {
                        continue;
                    };
                    let n_vertices = chart.chart.disk.n_vertices;
                    chart.embedding.uv.truncate(n_vertices);
                    (top, (0..n_vertices as u32).collect(), chart, 0)
                }
                Member::On(top, chart, places) => (top, places, *chart, shift),
            };
            let grid = &of_tops[top].grid;
            placed.push(Placed {
                grid: (places.iter().map(|&v| grid[v as usize]))
                    .map(|[u, v]| [u + shift, v])
                    .collect(),
            });
            charts.push(chart);
        }
        let limit = atlas.limit.map(|mut limit| {
            limit.chart = number[limit.chart];
            limit
        });
        let atlas = Atlas {
            placed,
            limit,
            ..atlas
        };
        (charts, atlas)
    }
}

/// Returns the material of a chart's first face, and the number of its rules.
fn material_and_rules(chart: &MappedChart, seams: &Seams) -> [u32; 2] {
    let Some([corner, ..]) = chart.chart.corners.first() else {
        return [0; 2];
    };
    let face = *corner as usize / 3;
    let material = seams.materials.as_ref().map_or(0, |all| all[face]);
    let rules = (seams.control.as_ref()).map_or(0, |control| control.of_face[face]);
    [material, rules]
}

/// Returns a vertex of `top` for each of a chart's vertices: that on its border, a vertex at exactly the same place, or a
/// new one.
fn vertex_places(
    chart: &MappedChart,
    on_border: &HashMap<u32, u32>,
    top: &mut MappedChart,
) -> VertexPlaces {
    let bits = |uv: [f64; 2]| uv.map(|x| (x + 0.0).to_bits());
    let known = top.embedding.uv.iter().map(|&uv| bits(uv)).zip(0..);
    let mut known: HashMap<[u64; 2], u32> = known.collect();
    let place = |(v, &uv): (u32, &[f64; 2])| {
        let at = || {
            *known.entry(bits(uv)).or_insert_with(|| {
                top.embedding.uv.push(uv);
                top.embedding.uv.len() as u32 - 1
            })
        };
        on_border.get(&v).copied().unwrap_or_else(at)
    };
    (0..).zip(&chart.embedding.uv).map(place).collect()
}

/// Border of a chart.
struct Outline {
    low: [f64; 2],
    high: [f64; 2],
    /// Vertices of each edge, the chart on its left.
    edges: Vec<[u32; 2]>,
    uv: Vec<[f64; 2]>,
}

impl Outline {
    fn new(chart: &MappedChart) -> Self {
        let MappedChart {
            chart, embedding, ..
        } = chart;
        let after = |boundary: &[u32], k: usize| boundary[(k + 1) % boundary.len()];
        let edges = chart.disk.loops.iter().flat_map(|boundary| {
            (0..boundary.len()).map(move |k| [boundary[k], after(boundary, k)])
        });
        let [low, high] = bounds_of(&embedding.uv);
        Self {
            low,
            high,
            edges: edges.collect(),
            uv: embedding.uv.clone(),
        }
    }

    /// Returns for each vertex on this border the vertex of `other` that it coincides with; `None` if the borders do not
    /// coincide edge by edge.
    fn places_on(&self, other: &Self, tolerance: f64) -> Option<HashMap<u32, u32>> {
        let is_near = |p: [f64; 2], q: [f64; 2]| (0..2).all(|k| (p[k] - q[k]).abs() <= tolerance);
        if !is_near(self.low, other.low) || !is_near(self.high, other.high) {
            return None;
        }
        // Edges of the other border by the place where they begin.
        let cell = |p: [f64; 2]| p.map(|x| (x / tolerance).floor() as i64);
        let mut beginning: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
        for (index, edge) in other.edges.iter().enumerate() {
            let start = other.uv[edge[0] as usize];
            beginning.entry(cell(start)).or_default().push(index);
        }
        let mut is_used = vec![false; other.edges.len()];
        let mut places = HashMap::new();
        for edge in &self.edges {
            let ends = edge.map(|v| self.uv[v as usize]);
            let [i, j] = cell(ends[0]);
            let around = (-1..=1).flat_map(|di| (-1..=1).map(move |dj| [i + di, j + dj]));
            let found = around
                .filter_map(|cell| beginning.get(&cell))
                .flatten()
                .find(|&&k| {
                    let others = other.edges[k].map(|v| other.uv[v as usize]);
                    !is_used[k] && is_near(ends[0], others[0]) && is_near(ends[1], others[1])
                });
            let &k = found?;
            is_used[k] = true;
            // Vertices where a border passes twice may not be told apart.
            for (v, place) in edge.iter().zip(other.edges[k]) {
                if *places.entry(*v).or_insert(place) != place {
                    return None;
                }
            }
        }
        Some(places)
    }
}
