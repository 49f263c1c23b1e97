//! Pieces to start from: facets, joined while they stay nearly developable.

use super::metric::Metric;
use super::net::Net;
use super::opening::Ways;
use super::state::Search;
use crate::charts::Observer;
use std::cmp::{Ordering, Reverse};
use std::collections::{BinaryHeap, HashMap};
use unwrapd_maps::measure::cost::PER_CHART;
use unwrapd_maps::mesh::{CUT, UnionFind, VertexFaces};
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

/// Two pieces that may be joined; the largest share of contact in the smaller perimeter comes first, then the older nodes.
struct Joint {
    share: f64,
    nodes: [u32; 2],
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
        by_share.then_with(|| other.nodes.cmp(&self.nodes))
    }
}

/// Pieces of a surface: facets at first, then unions of facets.
///
/// A union keeps the number of the part with more neighbors, so only the neighbors of the other part are told, and refusals are
/// final, since what grows holds no fewer edges and no less curvature. Each contact changes hands O(log n) times.
pub struct Pieces<'a> {
    metric: &'a Metric<'a>,
    /// For each face its facet.
    facet: Vec<u32>,
    /// Facets that are one piece.
    sets: UnionFind,
    /// For the first facet of each piece its number.
    number: Vec<u32>,
    list: Vec<SurfacePiece>,
    /// Contacts by their two pieces, in ascending order.
    contacts: HashMap<[u32; 2], Contact>,
    /// For each edge the next one of its contact; [`LAST`] for the last.
    next_edge: Vec<u32>,
    /// Nodes that each node unites; the first nodes are the facets, which unite none.
    tree: Vec<Option<[u32; 2]>>,
    /// Faces around each vertex.
    around: VertexFaces,
    /// Absolute angle defect of each vertex, 0 on the boundary.
    defect: Vec<f64>,
}

#[derive(Default)]
struct SurfacePiece {
    /// Node of the tree; `None` once the piece is part of another.
    node: Option<u32>,
    /// Facet that it holds.
    facet: u32,
    perimeter: f64,
    /// Sum of the angle defects inside.
    bent: f64,
    /// Neighbors, and pieces that were neighbors before they became part of others.
    neighbors: Vec<u32>,
}

/// Common border of two pieces, a list of edges.
#[derive(Clone, Copy)]
struct Contact {
    first: u32,
    last: u32,
    length: f64,
    is_refused: bool,
}

/// End of a list of edges.
const LAST: u32 = u32::MAX;

/// Returns the key of the contact of two pieces.
fn pair(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

impl<'a> Pieces<'a> {
    /// Makes each facet a piece.
    pub fn of_facets(metric: &'a Metric<'a>) -> Self {
        let (facet, n) = facets(metric);
        let list = (0..n as u32)
            .map(|facet| SurfacePiece {
                node: Some(facet),
                facet,
                ..SurfacePiece::default()
            })
            .collect();
        let n_vertices = metric.surface.positions.len();
        let mut total = vec![0.0; n_vertices];
        for (corner, &v) in metric.corners.as_flattened().iter().enumerate() {
            total[v as usize] += metric.angle[corner];
        }
        let tau = 2.0 * std::f64::consts::PI;
        let mut pieces = Self {
            metric,
            facet,
            sets: UnionFind::new(n),
            number: (0..n as u32).collect(),
            list,
            contacts: HashMap::with_capacity(metric.halfedge.len()),
            next_edge: vec![LAST; metric.halfedge.len()],
            tree: vec![None; n],
            around: VertexFaces::new(n_vertices, &metric.corners),
            defect: total.iter().map(|angle| (tau - angle).abs()).collect(),
        };
        for (edge, &h) in (0u32..).zip(&metric.halfedge) {
            let t = metric.twin[h as usize];
            let length = metric.length[edge as usize];
            let here = pieces.facet[h as usize / 3];
            if t == CUT {
                pieces.list[here as usize].perimeter += length;
                for v in metric.ends(h) {
                    pieces.defect[v as usize] = 0.0;
                }
                continue;
            }
            let there = pieces.facet[t as usize / 3];
            if here != there {
                pieces.list[here as usize].perimeter += length;
                pieces.list[there as usize].perimeter += length;
                let contact = Contact {
                    first: edge,
                    last: edge,
                    length,
                    is_refused: false,
                };
                pieces.add_contact(here, there, contact);
            }
        }
        pieces
    }

    /// Labels each face by its piece.
    pub fn labels(&mut self) -> Vec<u32> {
        let (label, _) = self.sets.labels();
        let of_face = self.facet.iter().map(|&facet| label[facet as usize]);
        of_face.collect()
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
            let later = self.list[a as usize].neighbors.iter().filter(|&&b| a < b);
            heap.extend(later.filter_map(|&b| self.joint(a, b)));
        }
        let mut n_seen = 0;
        while let Some(seen) = heap.pop() {
            n_seen += 1;
            if n_seen % UNWATCHED == 0 && observer.control() == Control::Finish {
                return;
            }
            let [a, b] = seen.pieces;
            let Some(joint) = self.joint(a, b) else {
                continue;
            };
            if joint < seen {
                // A part has grown since.
                heap.push(joint);
                continue;
            }
            let [first, second] = [a, b].map(|piece| &self.list[piece as usize]);
            let contact = self.contacts[&pair(a, b)];
            let perimeter = first.perimeter + second.perimeter - 2.0 * contact.length;
            let bent = first.bent + second.bent;
            let may_be_inside = perimeter >= OPEN && self.edges(contact).all(&may_be_inside);
            let bent = if may_be_inside {
                bent + self.closed(a, b)
            } else {
                f64::INFINITY
            };
            if bent > most_bent {
                let contact = self.contacts.entry(pair(a, b));
                contact.and_modify(|contact| contact.is_refused = true);
                continue;
            }
            let changed = self.unite(a, b, perimeter, bent);
            heap.extend(changed);
        }
    }

    /// Returns two pieces as they may be joined; `None` if they are no neighbors, or were refused.
    fn joint(&self, a: u32, b: u32) -> Option<Joint> {
        let [first, second] = [a, b].map(|piece| &self.list[piece as usize]);
        let contact = self.contacts.get(&pair(a, b));
        let contact = contact.filter(|contact| !contact.is_refused)?;
        let [m, n] = [first.node?, second.node?];
        Some(Joint {
            share: contact.length / first.perimeter.min(second.perimeter).max(f64::MIN_POSITIVE),
            nodes: [m.min(n), m.max(n)],
            pieces: [a, b],
        })
    }

    /// Returns the sum of the defects of the vertices that a union of two pieces would hold inside.
    fn closed(&mut self, a: u32, b: u32) -> f64 {
        let mut vertices: Vec<u32> = (self.edges(self.contacts[&pair(a, b)]))
            .flat_map(|edge| self.metric.ends_of_edge(edge))
            .collect();
        vertices.sort_unstable();
        vertices.dedup();
        let mut sum = 0.0;
        for v in vertices {
            let mut faces = self.around.of(v).iter();
            let is_inside = faces.all(|&face| {
                let first = self.sets.find(self.facet[face as usize]);
                [a, b].contains(&self.number[first as usize])
            });
            sum += if is_inside {
                self.defect[v as usize]
            } else {
                0.0
            };
        }
        sum
    }

    /// Returns the edges of a contact.
    fn edges(&self, contact: Contact) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(contact.first), |&edge| {
            Some(self.next_edge[edge as usize]).filter(|&next| next != LAST)
        })
    }

    /// Adds to the contact of two pieces.
    fn add_contact(&mut self, a: u32, b: u32, added: Contact) {
        if let Some(contact) = self.contacts.get_mut(&pair(a, b)) {
            self.next_edge[contact.last as usize] = added.first;
            contact.last = added.last;
            contact.length += added.length;
            contact.is_refused |= added.is_refused;
            return;
        }
        self.contacts.insert(pair(a, b), added);
        self.list[a as usize].neighbors.push(b);
        self.list[b as usize].neighbors.push(a);
    }

    /// Unites two pieces; returns the joints whose share may have risen.
    fn unite(&mut self, a: u32, b: u32, perimeter: f64, bent: f64) -> Vec<Joint> {
        let n_neighbors = |piece: u32| self.list[piece as usize].neighbors.len();
        let (kept, gone) = if n_neighbors(a) < n_neighbors(b) {
            (b, a)
        } else {
            (a, b)
        };
        let part = std::mem::take(&mut self.list[gone as usize]);
        let piece = &mut self.list[kept as usize];
        let is_shorter = perimeter < piece.perimeter;
        let parts = [piece.node, part.node].map(|node| node.expect("pieces that are there"));
        piece.node = Some(self.tree.len() as u32);
        (piece.perimeter, piece.bent) = (perimeter, bent);
        let [first, second] = [piece.facet, part.facet];
        self.tree.push(Some(parts));
        self.sets.unite(first, second);
        let first = self.sets.find(first);
        self.number[first as usize] = kept;
        self.contacts.remove(&pair(a, b));
        for &other in &part.neighbors {
            if let Some(contact) = self.contacts.remove(&pair(gone, other)) {
                self.add_contact(kept, other, contact);
            }
        }
        let changed = if is_shorter {
            &self.list[kept as usize].neighbors
        } else {
            &part.neighbors
        };
        let joints = changed.iter().filter_map(|&other| self.joint(kept, other));
        joints.collect()
    }

    /// Returns the facets of a node, in any order.
    fn facets(&self, node: u32) -> Vec<u32> {
        let (mut facets, mut pending) = (Vec::new(), vec![node]);
        while let Some(node) = pending.pop() {
            match self.tree[node as usize] {
                Some(parts) => pending.extend(parts),
                None => facets.push(node),
            }
        }
        facets
    }
}

impl Search<'_> {
    /// Starts from pieces that are nearly developable. One falls into those that it was joined from if it has no map, or if its slits and
    /// excess cost more than the border between them. The effort is counted but not limited: what is not mapped would fall into its faces.
    pub fn start_from_pieces(&mut self, lambda: f64) {
        let most = std::mem::replace(&mut self.counts.effort.most, f64::INFINITY);
        let metric = self.nets.metric;
        let mut pieces = Pieces::of_facets(metric);
        pieces.join(DEVELOPABLE, |_| true, self.observer);
        let mut faces_of_facet = vec![Vec::new(); pieces.list.len()];
        for (face, &facet) in (0u32..).zip(&pieces.facet) {
            faces_of_facet[facet as usize].push(face);
        }
        let faces_of = |node: u32| {
            let facets = pieces.facets(node).into_iter();
            let mut faces: Vec<u32> = facets
                .flat_map(|facet| &faces_of_facet[facet as usize])
                .copied()
                .collect();
            faces.sort_unstable();
            faces
        };
        let mut pending: Vec<u32> = pieces.list.iter().filter_map(|piece| piece.node).collect();
        pending.sort_unstable_by_key(|&node| Reverse(node));
        while let Some(node) = pending.pop() {
            let faces = faces_of(node);
            let parts = pieces.tree[node as usize];
            let border = parts.map_or(f64::INFINITY, |parts| {
                border(metric, parts.map(faces_of)) + PER_CHART
            });
            let net = self.opened(&faces, lambda);
            match (net.filter(|net| net.price(lambda) <= border), parts) {
                (Some(net), _) => {
                    self.nets.add(net);
                }
                (None, Some(parts)) => pending.extend(parts),
                (None, None) => {
                    for face in faces {
                        self.nets.add(Net::of_face(metric, face));
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

/// Returns the length of the border between two sets of faces.
fn border(metric: &Metric, [a, b]: [Vec<u32>; 2]) -> f64 {
    let halfedges = a.iter().flat_map(|&face| 3 * face..3 * face + 3);
    let edges = halfedges.filter(|&h| {
        let t = metric.twin[h as usize];
        t != CUT && b.binary_search(&(t / 3)).is_ok()
    });
    let lengths = edges.map(|h| metric.length[metric.edge[h as usize] as usize]);
    lengths.sum()
}
