//! Charts that are laid side by side as rigid pieces.

use super::contact::{Edge, common_edges, common_vertices, turn_over};
use super::joints::Joint;
use super::piece::{Piece, faces_of};
use crate::charts::mapped::MappedChart;
use crate::charts::motion::Motion;
use std::collections::BTreeMap;
use unwrapd_maps::mesh::{CornerUvs, UnionFind};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// The least distance of an outline from itself, as a part of its extent: rounding would close what
/// is narrower.
const APART: f64 = 2e-6;

/// The least length of a border along which pieces are joined where a seam has its usual price, as a
/// part of the square root of the smaller's area: a disc that hangs by one of a hundred edges makes no
/// layout easier to read. And the most that it becomes where seams cost little.
const LEAST_BORDER: f64 = 0.4;
const MOST_BORDER: f64 = 0.9;

/// Charts, and the pieces in which they hang together.
pub struct Layout<'a> {
    /// What glues the surface.
    pub(super) twin: &'a [u32],
    charts: Vec<&'a MappedChart>,
    /// The least length of a border along which pieces are joined, as a part of the square root of
    /// the smaller's area.
    least_border: f64,
    /// The first vertex of each chart in the numbers of all.
    first_vertex: Vec<u32>,
    /// Where each vertex lies, and where it would with the join that is tried.
    pub(super) places: Vec<[f64; 2]>,
    tried: Vec<[f64; 2]>,
    pub(super) vertices: UnionFind,
    /// For each chart whether it is seen from behind.
    pub(super) is_turned: Vec<bool>,
    pub(super) pieces: UnionFind,
    /// By the least of its charts.
    pub(super) piece: Vec<Piece>,
    /// Halfedges of the surface at which charts were joined.
    pub joined: Vec<u32>,
    /// Pairs of faces that were compared, and vertices that were set aside in case a join has to be undone.
    pub work: u64,
}

impl<'a> Layout<'a> {
    /// Each chart a piece; `seam_price` is what a seam costs, over its usual price.
    pub fn new(twin: &'a [u32], charts: Vec<&'a MappedChart>, seam_price: f64) -> Self {
        let mut first_vertex = vec![0];
        let mut places = Vec::new();
        for map in &charts {
            places.extend_from_slice(&map.embedding.uv);
            first_vertex.push(places.len() as u32);
        }
        let piece = |(number, map): (u32, &&MappedChart)| {
            Piece::new(number, map, first_vertex[number as usize])
        };
        Self {
            least_border: (LEAST_BORDER / seam_price).min(MOST_BORDER),
            twin,
            piece: (0..).zip(&charts).map(piece).collect(),
            pieces: UnionFind::new(charts.len()),
            is_turned: vec![false; charts.len()],
            vertices: UnionFind::new(places.len()),
            tried: places.clone(),
            places,
            first_vertex,
            charts,
            joined: Vec::new(),
            work: 0,
        }
    }

    /// How often the pieces of a joint were joined to others: the larger number.
    pub fn n_joins(&mut self, joint: &Joint) -> u32 {
        let pieces = [joint.chart, joint.run.neighbor].map(|chart| self.pieces.find(chart));
        let [a, b] = pieces.map(|piece| self.piece[piece as usize].n_joins);
        a.max(b)
    }

    /// Lays the piece with fewer faces beside the other; false if they are one, or one would cover or
    /// touch the other elsewhere, or the joint is short.
    pub fn join(&mut self, joint: &Joint) -> bool {
        let [a, b] = [joint.chart, joint.run.neighbor];
        let [of_a, of_b] = [a, b].map(|chart| self.pieces.find(chart));
        let side = |piece: u32| self.piece[piece as usize].area.sqrt();
        let least = self.least_border * side(of_a).min(side(of_b));
        let length = joint.run.length(&self.charts[a as usize].embedding.uv);
        if of_a == of_b || length < least {
            return false;
        }
        let is_a_moved = self.piece[of_a as usize].n_faces <= self.piece[of_b as usize].n_faces;
        let [moved, still] = if is_a_moved {
            [of_a, of_b]
        } else {
            [of_b, of_a]
        };
        let pairs: Vec<[u32; 2]> = (joint.run.vertices.iter())
            .map(|&[v, w]| {
                let [v, w] = [(a, v), (b, w)].map(|(c, v)| self.first_vertex[c as usize] + v);
                if is_a_moved { [v, w] } else { [w, v] }
            })
            .collect();
        let is_turned =
            joint.run.is_turned != (self.is_turned[a as usize] != self.is_turned[b as usize]);
        self.try_place(moved, is_turned, &pairs);
        self.snap(moved, &pairs);
        let Some(common) = self.common(moved, still, is_turned) else {
            return false;
        };
        let pairs: Vec<[u32; 2]> = common.iter().flat_map(common_vertices).collect();
        self.snap(moved, &pairs);
        let faces = self.faces(moved, is_turned);
        let is_positive = |&[a, b, c]: &CornerUvs| orient2d_sign(a, b, c) > 0;
        if common.is_empty()
            || !faces.iter().all(is_positive)
            || self.piece[still as usize].meets(&faces, &mut self.work)
        {
            return false;
        }
        self.unite([moved, still], is_turned, &common, faces);
        true
    }

    /// Where a joint would bring the vertices of a piece, turned over or not.
    fn try_place(&mut self, moved: u32, is_turned: bool, pairs: &[[u32; 2]]) {
        let seen = |[x, y]: [f64; 2]| if is_turned { [-x, y] } else { [x, y] };
        let at = |v: u32| self.places[v as usize];
        let pairs: Vec<_> = pairs.iter().map(|&[v, w]| [seen(at(v)), at(w)]).collect();
        let motion = Motion::fitting(&pairs);
        for &chart in &self.piece[moved as usize].charts {
            let chart = chart as usize;
            for v in self.first_vertex[chart]..self.first_vertex[chart + 1] {
                self.tried[v as usize] = motion.moved(seen(self.places[v as usize]));
            }
        }
    }

    fn common(&self, moved: u32, still: u32, is_turned: bool) -> Option<Vec<[Edge; 2]>> {
        let mut outline = self.piece[moved as usize].outline.clone();
        if is_turned {
            turn_over(&mut outline);
        }
        let rest = &self.piece[still as usize].outline;
        let tried = |v: u32| self.tried[v as usize];
        let place = |v: u32| self.places[v as usize];
        let all = outline.iter().map(|edge| tried(edge.ends[0]));
        let all = all.chain(rest.iter().map(|edge| place(edge.ends[0])));
        let [low, high] = bounds_of(&all.collect::<Vec<_>>());
        let least = APART * (high[0] - low[0]).max(high[1] - low[1]);
        common_edges((&outline, &tried), (rest, &place), self.twin, least)
    }

    /// Puts the vertices of a piece that is moved exactly to those, the second of each pair, at which
    /// it is joined.
    fn snap(&mut self, moved: u32, pairs: &[[u32; 2]]) {
        let place: BTreeMap<u32, [f64; 2]> = (pairs.iter())
            .map(|&[v, w]| (self.vertices.find(v), self.places[w as usize]))
            .collect();
        for &chart in &self.piece[moved as usize].charts {
            let chart = chart as usize;
            for v in self.first_vertex[chart]..self.first_vertex[chart + 1] {
                if let Some(&place) = place.get(&self.vertices.find(v)) {
                    self.tried[v as usize] = place;
                }
            }
        }
    }

    /// The faces of a piece where they would lie, counter-clockwise.
    fn faces(&self, moved: u32, is_turned: bool) -> Vec<CornerUvs> {
        let charts = &self.piece[moved as usize].charts;
        let of_chart = |&chart: &u32| {
            let chart = chart as usize;
            let range = self.first_vertex[chart] as usize..self.first_vertex[chart + 1] as usize;
            let is_turned = is_turned != self.is_turned[chart];
            faces_of(self.charts[chart], &self.tried[range], is_turned)
        };
        charts.iter().flat_map(of_chart).collect()
    }

    fn unite(
        &mut self,
        [moved, still]: [u32; 2],
        is_turned: bool,
        common: &[[Edge; 2]],
        faces: Vec<CornerUvs>,
    ) {
        let mut from = std::mem::take(&mut self.piece[moved as usize]);
        let mut into = std::mem::take(&mut self.piece[still as usize]);
        for &chart in &from.charts {
            let chart = chart as usize;
            self.is_turned[chart] ^= is_turned;
            let range = self.first_vertex[chart] as usize..self.first_vertex[chart + 1] as usize;
            self.places[range.clone()].copy_from_slice(&self.tried[range]);
        }
        if is_turned {
            turn_over(&mut from.outline);
        }
        for pair @ [edge, _] in common {
            self.joined.push(edge.halfedge);
            for [v, w] in common_vertices(pair) {
                self.vertices.unite(v, w);
            }
        }
        into.take(from, faces, common);
        self.pieces.unite(moved, still);
        self.piece[moved.min(still) as usize] = into;
    }

    /// Where each corner of the charts' faces lies, by the corners of the surface.
    pub fn corners(&self) -> Vec<(u32, [f64; 2])> {
        let of_chart = |(chart, &first): (&&MappedChart, &u32)| {
            let corners = chart.chart.corners.as_flattened().iter();
            let vertices = chart.chart.disk.triangles.as_flattened().iter();
            (corners.zip(vertices))
                .map(|(&corner, &v)| (corner, self.places[(first + v) as usize]))
                .collect::<Vec<_>>()
        };
        let charts = self.charts.iter().zip(&self.first_vertex);
        charts.flat_map(of_chart).collect()
    }
}
