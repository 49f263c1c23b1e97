//! Chords along which a map would part into two compact pieces.

use super::clusters::Clusters;
use std::f64::consts::TAU;
use unwrapd_maps::mesh::UnionFind;
use unwrapd_method::numerics::support::Support;
use unwrapd_method::numerics::vec2::dot;

/// Directions in which lines sweep over a map, and the distances between which they stop.
const SWEEPS: u32 = 32;
const STOPS: usize = 24;

/// A straight chord of a map and the piece it cuts off.
#[derive(Clone, Debug)]
pub struct Chord {
    /// Direction from the rest of the map toward the piece.
    pub direction: [f64; 2],
    /// What lies farther than this in that direction is beyond the line.
    pub offset: f64,
    /// A cluster of the piece, which is all that hangs together with it beyond the line.
    pub cluster: u32,
    /// The area of the piece.
    pub area: f64,
    /// Length of the border between piece and rest on the surface.
    pub length: f64,
    /// By how much the two parts take up less room than the whole.
    pub gain: f64,
}

impl Chord {
    /// Whether both, as good as surely, cut off the same clusters: lines of many directions do.
    pub fn is_like(&self, other: &Self) -> bool {
        self.area == other.area && self.length == other.length
    }
}

/// A connected part of a map.
struct MapPart {
    area: f64,
    border: f64,
    support: Support,
}

/// Chords from 32 directions of which piece and rest have at least the area `crumb` each, for an atlas that a square of area
/// `square` should hold.
///
/// As a line recedes over the map, what lies beyond it grows and unites; of each part that hangs together the hull is known, and
/// of what lies before the line too. O(n) for n clusters.
pub fn chords(clusters: &Clusters, crumb: f64, square: f64) -> Vec<Chord> {
    let mut whole = Support::EMPTY;
    for support in &clusters.support {
        whole.unite(support);
    }
    let whole = whole.room(square);
    (0..SWEEPS)
        .flat_map(|k| {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(SWEEPS)).sin_cos();
            sweep(clusters, crumb, square, whole, [cos, sin])
        })
        .collect()
}

/// The same from one direction, given the room that the whole map takes up.
fn sweep(
    clusters: &Clusters,
    crumb: f64,
    square: f64,
    whole: f64,
    direction: [f64; 2],
) -> Vec<Chord> {
    let reach: Vec<f64> = (clusters.centre.iter())
        .map(|&centre| dot(centre, direction))
        .collect();
    let high = reach.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let low = reach.iter().copied().fold(f64::INFINITY, f64::min);
    if high <= low {
        return Vec::new();
    }
    let stop = |i: usize| high + (low - high) * (i + 1) as f64 / (STOPS + 1) as f64;
    let passed_at = |reach: f64| (high - reach) / (high - low) * (STOPS + 1) as f64;
    let strips = Strips::new(reach.iter().map(|&reach| passed_at(reach) as usize));
    let hull = |strip: usize| {
        let mut hull = Support::EMPTY;
        for &cluster in strips.of(strip) {
            hull.unite(&clusters.support[cluster as usize]);
        }
        hull
    };
    // The hull of what a line at each stop has not passed.
    let mut before = vec![hull(STOPS); STOPS];
    for i in (0..STOPS - 1).rev() {
        before[i] = before[i + 1].clone();
        before[i].unite(&hull(i + 1));
    }
    let mut beyond = Beyond::new(clusters);
    let mut chords = Vec::new();
    for (i, before) in before.iter().enumerate() {
        for &cluster in strips.of(i) {
            beyond.add(cluster);
        }
        for (cluster, part, rest) in beyond.parts(strips.up_to(i), before, crumb) {
            let gain = whole - part.support.room(square) - rest.room(square);
            chords.push(Chord {
                direction,
                offset: stop(i),
                cluster,
                area: part.area,
                length: part.border,
                gain,
            });
        }
    }
    chords
}

/// The clusters in strips between stops: those of the first a line passes by the first stop, those of the last it does not pass.
struct Strips {
    clusters: Vec<u32>,
    starts: [usize; STOPS + 2],
}

impl Strips {
    /// Given the strip of each cluster, at most the last.
    fn new(strips: impl Iterator<Item = usize> + Clone) -> Self {
        let strips = strips.map(|strip| strip.min(STOPS));
        let mut starts = [0; STOPS + 2];
        for strip in strips.clone() {
            starts[strip + 1] += 1;
        }
        for strip in 0..=STOPS {
            starts[strip + 1] += starts[strip];
        }
        let mut clusters = vec![0; starts[STOPS + 1]];
        let mut next = starts;
        for (cluster, strip) in (0..).zip(strips) {
            clusters[next[strip]] = cluster;
            next[strip] += 1;
        }
        Self { clusters, starts }
    }

    fn of(&self, strip: usize) -> &[u32] {
        &self.clusters[self.starts[strip]..self.starts[strip + 1]]
    }

    fn up_to(&self, strip: usize) -> &[u32] {
        &self.clusters[..self.starts[strip + 1]]
    }
}

/// What lies beyond a line that recedes over the map, in connected parts.
struct Beyond<'a> {
    clusters: &'a Clusters,
    whole: f64,
    sets: UnionFind,
    has_passed: Vec<bool>,
    /// For each cluster the part that it was the last to join.
    parts: Vec<MapPart>,
    /// For each cluster that represents a part where that is.
    place: Vec<Option<u32>>,
}

impl<'a> Beyond<'a> {
    fn new(clusters: &'a Clusters) -> Self {
        let n = clusters.area.len();
        let alone = (clusters.area.iter().zip(&clusters.support)).map(|(&area, support)| MapPart {
            area,
            border: 0.0,
            support: support.clone(),
        });
        Self {
            clusters,
            whole: clusters.area.iter().sum(),
            sets: UnionFind::new(n),
            has_passed: vec![false; n],
            parts: alone.collect(),
            place: vec![None; n],
        }
    }

    fn add(&mut self, cluster: u32) {
        let c = cluster as usize;
        self.has_passed[c] = true;
        for &(neighbor, length) in &self.clusters.neighbors[c] {
            if !self.has_passed[neighbor as usize] {
                self.parts[c].border += length;
                continue;
            }
            self.parts[c].border -= length;
            let other = self.sets.find(neighbor) as usize;
            if let Some(place) = self.place[other].take()
                && let Ok([part, other]) = self.parts.get_disjoint_mut([c, place as usize])
            {
                part.area += other.area;
                part.border += other.border;
                part.support.unite(&other.support);
            }
            self.sets.unite(cluster, neighbor);
        }
        let root = self.sets.find(cluster);
        self.place[root as usize] = Some(cluster);
    }

    /// Each part that may be a piece, a cluster of it, and the hull of the rest of the map, given the clusters that were added and
    /// the hull of the others.
    fn parts(&self, passed: &[u32], before: &Support, crumb: f64) -> Vec<(u32, &MapPart, Support)> {
        let part = |&c: &u32| Some((c, &self.parts[self.place[c as usize]? as usize]));
        let all = passed.iter().filter_map(part);
        let is_piece =
            |&(_, part): &(u32, &MapPart)| part.area >= crumb && part.area <= self.whole - crumb;
        let (pieces, others): (Vec<_>, Vec<_>) = all.partition(is_piece);
        let mut beside = before.clone();
        for (_, other) in others {
            beside.unite(&other.support);
        }
        let rest_of = |cluster: u32| {
            let mut rest = beside.clone();
            for (_, other) in pieces.iter().filter(|(c, _)| *c != cluster) {
                rest.unite(&other.support);
            }
            rest
        };
        pieces
            .iter()
            .map(|&(cluster, part)| (cluster, part, rest_of(cluster)))
            .collect()
    }
}
