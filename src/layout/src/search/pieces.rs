//! Pieces to start from: facets, joined while they stay nearly developable.

use super::metric::Metric;
use super::net::Net;
use super::opening::Ways;
use super::state::Search;
use crate::charts::Observer;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};
use unwrapd_maps::measure::cost::PER_CHART;
use unwrapd_maps::mesh::{CUT, UnionFind};
use unwrapd_method::solver::Control;

/// Fold of an edge, in radians, below which its faces lie in one facet.
const FLAT: f64 = 1e-3;
/// Largest sum of the angle defects inside a piece, in radians; its excess is then below 3e-4. Half and double of it give
/// the same seams.
const DEVELOPABLE: f64 = 0.25;
/// Number of joints after which the observer is asked whether to go on: some ten milliseconds of work.
const UNWATCHED: usize = 1_000;
/// Share of the smaller perimeter that a piece keeps: one without boundary could not be laid flat.
const OPEN: f64 = 1e-9;

/// Labels each face by its facet: coplanar neighbors, and needles with the neighbor at their longest side.
fn facets(metric: &Metric) -> (Vec<u32>, usize) {
    let mut sets = UnionFind::new(metric.corners.len());
    for (edge, &h) in metric.halfedge.iter().enumerate() {
        let t = metric.twin[h as usize];
        if t == CUT {
            continue;
        }
        let sides = [h, t];
        let needle = sides.map(|h| metric.needle[h as usize / 3]);
        let is_joined = if needle == [None, None] {
            metric.fold[edge] < FLAT
        } else {
            sides
                .iter()
                .zip(needle)
                .any(|(&h, longest)| longest == Some(h))
        };
        if is_joined {
            sets.unite(h / 3, t / 3);
        }
    }
    sets.labels()
}

/// Two pieces that may be joined; the largest share of contact in the smaller perimeter comes first.
struct Joint {
    share: f64,
    pieces: [u32; 2],
}

impl PartialEq for Joint {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Joint {}

impl PartialOrd for Joint {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Joint {
    fn cmp(&self, other: &Self) -> Ordering {
        let by_share = self.share.total_cmp(&other.share);
        by_share.then_with(|| other.pieces.cmp(&self.pieces))
    }
}

/// Pieces with the pieces that they were joined from: a forest whose leaves are facets.
pub struct Pieces<'a> {
    metric: &'a Metric<'a>,
    /// For each face the piece that holds it.
    pub label: Vec<u32>,
    list: Vec<SurfacePiece>,
    /// Faces around each vertex.
    around: Vec<Vec<u32>>,
    /// Absolute angle defect of each vertex, 0 on the boundary.
    defect: Vec<f64>,
}

#[derive(Default)]
struct SurfacePiece {
    faces: Vec<u32>,
    joined_from: Option<[u32; 2]>,
    is_current: bool,
    perimeter: f64,
    /// Sum of the angle defects inside.
    bent: f64,
    /// Edges to each neighbor.
    contacts: BTreeMap<u32, Vec<u32>>,
}

impl<'a> Pieces<'a> {
    /// Makes each facet a piece.
    pub fn of_facets(metric: &'a Metric<'a>) -> Self {
        let (label, n) = facets(metric);
        let mut list: Vec<SurfacePiece> = Vec::new();
        list.resize_with(n, || SurfacePiece {
            is_current: true,
            ..SurfacePiece::default()
        });
        for (face, &label) in (0u32..).zip(&label) {
            list[label as usize].faces.push(face);
        }
        let n_vertices = metric.surface.positions.len();
        let (mut around, mut total) = (vec![Vec::new(); n_vertices], vec![0.0; n_vertices]);
        for (face, corners) in (0u32..).zip(&metric.corners) {
            for (k, &v) in corners.iter().enumerate() {
                around[v as usize].push(face);
                total[v as usize] += metric.angle[3 * face as usize + k];
            }
        }
        let tau = 2.0 * std::f64::consts::PI;
        let mut defect: Vec<f64> = total.iter().map(|angle| (tau - angle).abs()).collect();
        for (edge, &h) in (0u32..).zip(&metric.halfedge) {
            let t = metric.twin[h as usize];
            let length = metric.length[edge as usize];
            let here = label[h as usize / 3];
            if t == CUT {
                list[here as usize].perimeter += length;
                for v in metric.ends(h) {
                    defect[v as usize] = 0.0;
                }
                continue;
            }
            let there = label[t as usize / 3];
            if here != there {
                for (a, b) in [(here, there), (there, here)] {
                    let piece = &mut list[a as usize];
                    piece.perimeter += length;
                    piece.contacts.entry(b).or_default().push(edge);
                }
            }
        }
        Self {
            metric,
            label,
            list,
            around,
            defect,
        }
    }

    /// Joins pieces, the longest contact by perimeter first, while the sum of the angle defects inside is at most `most_bent` and
    /// the edges between them may be inside. Ends early if the observer says so.
    pub fn join(
        &mut self,
        most_bent: f64,
        may_be_inside: impl Fn(u32) -> bool,
        observer: &dyn Observer,
    ) {
        let mut heap = BinaryHeap::new();
        for a in 0..self.list.len() as u32 {
            for &b in self.list[a as usize].contacts.keys().filter(|&&b| a < b) {
                heap.push(self.joint(a, b));
            }
        }
        let mut n_seen = 0;
        while let Some(Joint { pieces: [a, b], .. }) = heap.pop() {
            n_seen += 1;
            if n_seen % UNWATCHED == 0 && observer.control() == Control::Finish {
                return;
            }
            let [first, second] = [a, b].map(|piece| &self.list[piece as usize]);
            if !(first.is_current && second.is_current) {
                continue;
            }
            let edges = &first.contacts[&b];
            let contact = self.metric.length_of(edges);
            let perimeter = first.perimeter + second.perimeter - 2.0 * contact;
            if perimeter < OPEN || !edges.iter().all(|&edge| may_be_inside(edge)) {
                continue;
            }
            let bent = first.bent + second.bent + self.closed(a, b);
            if bent > most_bent {
                continue;
            }
            let joined = self.joined([a, b], perimeter, bent);
            for &other in self.list[joined as usize].contacts.keys() {
                heap.push(self.joint(joined, other));
            }
        }
    }

    fn joint(&self, a: u32, b: u32) -> Joint {
        let [first, second] = [a, b].map(|piece| &self.list[piece as usize]);
        let contact = self.metric.length_of(&first.contacts[&b]);
        Joint {
            share: contact / first.perimeter.min(second.perimeter).max(f64::MIN_POSITIVE),
            pieces: [a.min(b), a.max(b)],
        }
    }

    /// Returns the sum of the defects of the vertices that a union of two pieces would hold inside.
    fn closed(&self, a: u32, b: u32) -> f64 {
        let contact = &self.list[a as usize].contacts[&b];
        let vertices: BTreeSet<u32> = (contact.iter())
            .flat_map(|&edge| self.metric.ends_of_edge(edge))
            .collect();
        let is_inside = |v: &u32| {
            let mut faces = self.around[*v as usize].iter();
            faces.all(|&face| [a, b].contains(&self.label[face as usize]))
        };
        let inside = vertices.into_iter().filter(is_inside);
        inside.map(|v| self.defect[v as usize]).sum()
    }

    /// Returns the length of the border between two pieces, which may be joined.
    fn border(&self, [a, b]: [u32; 2]) -> f64 {
        let [a, b] = [a, b].map(|piece| &self.list[piece as usize].faces);
        let halfedges = a.iter().flat_map(|&face| 3 * face..3 * face + 3);
        let edges = halfedges.filter(|&h| {
            let t = self.metric.twin[h as usize];
            t != CUT && b.binary_search(&(t / 3)).is_ok()
        });
        let lengths = edges.map(|h| self.metric.length[self.metric.edge[h as usize] as usize]);
        lengths.sum()
    }

    /// Replaces two pieces by their union and returns its number.
    fn joined(&mut self, [a, b]: [u32; 2], perimeter: f64, bent: f64) -> u32 {
        let number = self.list.len() as u32;
        let mut contacts: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        let mut faces = Vec::new();
        for part in [a, b] {
            let piece = &mut self.list[part as usize];
            piece.is_current = false;
            faces.extend(&piece.faces);
            for (other, edges) in std::mem::take(&mut piece.contacts) {
                if other != a && other != b {
                    contacts.entry(other).or_default().extend(edges);
                }
            }
        }
        for &face in &faces {
            self.label[face as usize] = number;
        }
        for (&other, edges) in &contacts {
            let of_other = &mut self.list[other as usize].contacts;
            of_other.remove(&a);
            of_other.remove(&b);
            of_other.insert(number, edges.clone());
        }
        faces.sort_unstable();
        self.list.push(SurfacePiece {
            faces,
            joined_from: Some([a, b]),
            is_current: true,
            perimeter,
            bent,
            contacts,
        });
        number
    }
}

impl Search<'_> {
    /// Starts from pieces that are nearly developable. One falls into those that it was joined from if it has no map, or if its slits and
    /// excess cost more than the border between them. The effort is counted but not limited: what is not mapped would fall into its faces.
    pub fn start_from_pieces(&mut self, lambda: f64) {
        let most = std::mem::replace(&mut self.counts.effort.most, f64::INFINITY);
        let mut pieces = Pieces::of_facets(self.nets.metric);
        pieces.join(DEVELOPABLE, |_| true, self.observer);
        let mut pending: Vec<u32> = (0..pieces.list.len() as u32)
            .rev()
            .filter(|&piece| pieces.list[piece as usize].is_current)
            .collect();
        while let Some(number) = pending.pop() {
            let piece = &pieces.list[number as usize];
            let border = piece
                .joined_from
                .map_or(f64::INFINITY, |parts| pieces.border(parts) + PER_CHART);
            let net = self.opened(&piece.faces, lambda);
            match (
                net.filter(|net| net.price(lambda) <= border),
                piece.joined_from,
            ) {
                (Some(net), _) => {
                    self.nets.add(net);
                }
                (None, Some(parts)) => pending.extend(parts),
                (None, None) => {
                    for &face in &piece.faces {
                        self.nets.add(Net::of_face(self.nets.metric, face));
                    }
                }
            }
        }
        self.counts.effort.most = most;
    }

    /// Returns the cheapest net of some faces that have no slits yet.
    fn opened(&mut self, faces: &[u32], lambda: f64) -> Option<Net> {
        let metric = self.nets.metric;
        let mut ways = Ways::new(metric, [Vec::new()]);
        ways.cheapest(
            &mut self.plans,
            &faces.into(),
            lambda,
            f64::INFINITY,
            &mut self.counts.effort,
        );
        let way = ways.take()?;
        self.map(faces, &way)
    }
}
