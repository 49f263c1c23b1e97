//! The start: components, each slit open until the maps keep the bound.
//!
//! A component that is opened to a disk is slit further, each time along the path where one sparse solve predicts the most relief
//! for its length (`prediction`). The slits are planned one by one, and the bound says how many of them are made: the excess of the
//! last map over its prediction tells what to expect of the next. All components share one budget. A surface that is its own mirror
//! image is slit alike on both sides (`alike`), large components as a simplification of them is (`simplified`). Where a map overlaps
//! itself in the end, it is parted; the search glues the parts again where that pays.

use super::alike::with_image;
use super::cut_mesh::CutMesh;
use super::effort::SearchEffort;
use super::metric::Metric;
use super::net::{Net, chart, weighted};
use super::nets::Nets;
use super::opening::{Slit, best, first_slit, paths, slits_along};
use super::prediction::{Grounded, Prediction};
use super::sets::{difference, union};
use super::simplified::Simplified;
use super::state::Search;
use crate::charts::{
    Bound, Chart, Folds, MappedChart, MirrorPlane, Planning, SheetMirror, map_chart_by,
    ways_to_open_alike,
};
use rayon::prelude::*;
use std::sync::Arc;
use unwrapd_maps::cut::{Branches, Neighbors};
use unwrapd_maps::embed;
use unwrapd_maps::mesh::{CUT, UnionFind};
use unwrapd_method::numerics::ties::tied;

/// Pairs of vertices far apart between which a closed component may be opened. With one, ln(1/2 + S + n/10) of a cow is higher by .05, a
/// toy with non-manifold edges has no map, and the sum over 26 machine parts and game assets is lower by .08 (`cargo bench -p
/// unwrapd-layout --bench search`).
const FAR_APART: usize = 4;
/// Least number of faces of a component whose openings are compared on simplifications of it. Not tuned.
const COMPARED: usize = 20_000;
/// Number of vertices of those simplifications. Not tuned.
const COMPARED_VERTICES: usize = 2_500;
/// Excess of a map over its prediction before one is known. Measured on 14 meshes: 0.2 to 0.6.
const USUAL_RATIO: f64 = 0.34;
/// Maps of a component at most. One to seven were needed on 36 meshes.
const MOST_ROUNDS: i32 = 8;
/// Budget that a round aims at, over that of the round before: where maps keep falling short, less is aimed at. Not tuned.
const PROMISE: f64 = 0.95;
/// Share of the excess that the next round aims at where too much of the area is stretched. Not tuned.
const TIGHTER: f64 = 0.7;

/// A part of the surface, with slits that are planned one by one.
pub struct Slitting<'a> {
    mesh: Arc<CutMesh<'a>>,
    mirror: Option<MirrorPlane>,
    /// Slits that open it to a disk.
    opening: Vec<u32>,
    /// Further slits; `None` if none was asked for yet.
    planned: Option<PlannedSlits<'a>>,
    /// Number of planned slits that are made.
    pub n_made: usize,
    /// Excess of the last map over its prediction.
    ratio: f64,
    /// The last map; `None` if the slits have changed since.
    map: Option<Mapped>,
}

/// Slits of a part of the surface, in the order in which they were planned.
struct PlannedSlits<'a> {
    mesh: Arc<CutMesh<'a>>,
    neighbors: Neighbors,
    /// Where the mesh is its own mirror image.
    mirror: Option<SheetMirror>,
    prediction: Prediction<'a>,
    /// Predicted excess without slits.
    unslit: f64,
    slits: Vec<Slit>,
}

/// Map of a part, which may overlap itself.
struct Mapped {
    map: MappedChart,
    excess: f64,
    /// Area that is stretched.
    stretched: f64,
}

impl Mapped {
    fn new(metric: &Metric, map: MappedChart) -> Self {
        let net = Net::of_chart(metric, &map);
        Self {
            map,
            excess: net.excess,
            stretched: net.stretched,
        }
    }
}

impl<'a> PlannedSlits<'a> {
    /// Plans no slit yet; `None` if the mesh is no disk.
    fn new(mesh: &Arc<CutMesh<'a>>, mirror: Option<&MirrorPlane>) -> Option<Self> {
        let prediction = Prediction::new(mesh)?;
        Some(Self {
            mesh: mesh.clone(),
            neighbors: Neighbors::new(&mesh.sheet),
            mirror: mirror.and_then(|plane| SheetMirror::of(&mesh.sheet, plane)),
            unslit: prediction.excess(),
            prediction,
            slits: Vec::new(),
        })
    }

    /// Returns the predicted excess with the first `n` slits.
    fn excess(&self, n: usize) -> f64 {
        n.checked_sub(1)
            .map_or(self.unslit, |last| self.slits[last].excess)
    }

    /// Plans a further slit; returns `None` where nothing is distorted.
    fn plan(&mut self, effort: &mut SearchEffort) -> Option<()> {
        let (slit, grounded) = self.best(effort)?;
        self.prediction.accept(grounded);
        self.slits.push(slit);
        Some(())
    }

    fn best(&mut self, effort: &mut SearchEffort) -> Option<(Slit, Grounded)> {
        let mesh = &*self.mesh;
        let mut paths = paths(mesh, &self.neighbors, &self.prediction);
        if let Some(mirror) = &self.mirror {
            let is_outside = |v: u32| self.prediction.is_outside(v);
            for path in &mut paths {
                let own = std::mem::take(path);
                *path = with_image(mesh, &self.neighbors, mirror, own, is_outside);
            }
        }
        // Saddles at its end count as relieved: what overlaps there is parted later.
        let relieved = |path: &[u32]| {
            let ends = path.iter().flat_map(|&h| mesh.sheet.ends(h));
            ends.collect()
        };
        let prediction = &mut self.prediction;
        best(slits_along(paths, mesh, prediction, relieved, effort))
    }
}

impl<'a> Slitting<'a> {
    /// Creates a part without slits; `None` if it is no disk.
    pub fn new(
        metric: &'a Metric<'a>,
        faces: &[u32],
        opening: Vec<u32>,
        mirror: Option<MirrorPlane>,
    ) -> Option<Self> {
        let mesh = Arc::new(CutMesh::new(metric, faces, &opening));
        Some(Self {
            planned: Some(PlannedSlits::new(&mesh, mirror.as_ref())?),
            mesh,
            mirror,
            opening,
            n_made: 0,
            ratio: USUAL_RATIO,
            map: None,
        })
    }

    /// Creates a part that is mapped.
    fn of_map(metric: &'a Metric<'a>, map: MappedChart) -> Self {
        let Net { faces, slits, .. } = Net::of_chart(metric, &map);
        Self {
            mesh: Arc::new(CutMesh::new(metric, faces, &slits)),
            mirror: map.chart.mirror,
            opening: slits,
            planned: None,
            n_made: 0,
            ratio: USUAL_RATIO,
            map: Some(Mapped::new(metric, map)),
        }
    }

    /// Plans the next slit, the one that relieves most for its length, unless it is planned; returns its rate of relief. Returns `None`
    /// where nothing is distorted.
    ///
    /// A slit may be predicted to relieve nothing: where most of a component shrinks alike, some of it has to be opened first.
    pub fn plan_next(&mut self, effort: &mut SearchEffort) -> Option<f64> {
        if self.planned.is_none() {
            let planned = PlannedSlits::new(&self.mesh, self.mirror.as_ref())?;
            effort.predicted_faces += self.mesh.faces.len();
            if let Some(mapped) = &self.map {
                self.ratio = mapped.excess / planned.unslit.max(f64::MIN_POSITIVE);
            }
            self.planned = Some(planned);
        }
        let planned = self.planned.as_mut()?;
        if self.n_made == planned.slits.len() {
            planned.plan(effort)?;
        }
        Some(self.ratio * planned.slits[self.n_made].rate)
    }

    /// Makes the slit that is planned next.
    pub fn make_next(&mut self) {
        self.n_made += 1;
        self.map = None;
    }

    /// Returns the slits that are made, with those that open the part.
    pub fn slits(&self) -> Vec<u32> {
        let planned = self.planned.iter();
        let made = planned.flat_map(|planned| &planned.slits[..self.n_made]);
        made.fold(self.opening.clone(), |slits, slit| {
            union(&slits, &slit.edges)
        })
    }

    /// Returns the excess that is predicted with the first `n` planned slits.
    pub fn predicted(&self, n: usize) -> f64 {
        let planned = self.planned.as_ref();
        planned.map_or(0.0, |planned| planned.excess(n))
    }

    /// Returns the excess of the map, or the expected one.
    fn excess(&self) -> f64 {
        match &self.map {
            Some(mapped) => mapped.excess,
            None => self.ratio * self.predicted(self.n_made),
        }
    }

    /// Returns the area that is stretched in the map.
    fn stretched(&self) -> f64 {
        self.map.as_ref().map_or(0.0, |mapped| mapped.stretched)
    }
}

impl<'a> Search<'a> {
    /// Starts from the components of the surface; returns `None` if one of them has no map, or the slits alone cost `most`.
    pub fn start_from_components(&mut self, most: f64) -> Option<()> {
        let metric = self.nets.metric;
        let mut slittings = Vec::new();
        let mut components = components(metric);
        components.reverse();
        while let Some(faces) = components.pop() {
            let mut ways = ways_to_open(metric, &faces, self.mirror.as_ref());
            if ways.is_empty() {
                let doubled = faces_at_doubled_edges(metric, &faces);
                let singles = doubled.iter().map(|&face| Net::of_face(metric, face));
                let maps = singles.filter_map(|net| net.mapped_chart(metric));
                slittings.extend(maps.map(|map| Slitting::of_map(metric, map)));
                if doubled.is_empty() {
                    return None;
                }
                components.extend(connected(metric, &difference(&faces, &doubled)));
                continue;
            }
            if faces.len() >= COMPARED && ways.len() > 1 {
                ways = vec![self.shortest_simplified(&faces, ways)?];
            }
            if faces.len() >= Simplified::LARGE {
                slittings.extend(self.planned_on_simplification(&faces, ways.first()?)?);
                continue;
            }
            let ways = (ways.into_iter())
                .filter_map(|slits| Slitting::new(metric, &faces, slits, self.mirror));
            slittings.push(self.shortest(ways.collect())?);
        }
        self.slit_under_bound(&mut slittings, most)?;
        let maps = slittings.into_iter().filter_map(|slitting| slitting.map);
        let nets = maps.flat_map(|mapped| self.parted(mapped.map));
        self.nets = Nets::new(metric, nets.collect());
        Some(())
    }

    /// Returns the way to open a component to a disk that promises to keep the bound with the shortest slits; `None` if there is none.
    ///
    /// It has the least length of slits times the excess that they leave: longer slits are not worse if they leave less.
    fn shortest(&mut self, mut ways: Vec<Slitting<'a>>) -> Option<Slitting<'a>> {
        if ways.len() < 2 {
            return ways.pop();
        }
        let mut best: Option<(f64, Slitting)> = None;
        for mut slitting in ways {
            let [length, excess] = self.slit_under_share(&mut slitting);
            let price = tied(length * excess);
            if best.as_ref().is_none_or(|(least, _)| price < *least) {
                best = Some((price, slitting));
            }
        }
        best.map(|(_, slitting)| slitting)
    }

    /// Like [`Self::shortest`], on simplifications of the component.
    fn shortest_simplified(&mut self, faces: &[u32], ways: Vec<Vec<u32>>) -> Option<Vec<u32>> {
        let metric = self.nets.metric;
        let area: f64 = faces.iter().map(|&face| metric.area[face as usize]).sum();
        let mut best: Option<(f64, Vec<u32>)> = None;
        for slits in ways {
            let chart = chart(&CutMesh::new(metric, faces, &slits))?;
            let simple = Simplified::new(&chart, COMPARED_VERTICES);
            let Some(surface) = simple.and_then(|simple| simple.surface()) else {
                return Some(slits);
            };
            let of_simple = Metric::new(&surface);
            let mut search = self.of_part(&of_simple, self.observer);
            let all: Vec<u32> = (0..surface.triangles.len() as u32).collect();
            let Some(mut slitting) = Slitting::new(&of_simple, &all, Vec::new(), self.mirror)
            else {
                continue;
            };
            let [length, excess] = search.slit_under_share(&mut slitting);
            let opened = metric.length_of(&slits) / area.sqrt();
            let price = tied((opened + length) * excess);
            self.counts.effort.predicted_faces += search.counts.effort.predicted_faces;
            if best.as_ref().is_none_or(|(least, _)| price < *least) {
                best = Some((price, slits));
            }
        }
        best.map(|(_, slits)| slits)
    }

    /// Returns the parts into which a large component, opened along some slits, is cut as a simplification of it is.
    fn planned_on_simplification(
        &mut self,
        faces: &[u32],
        slits: &[u32],
    ) -> Option<Vec<Slitting<'a>>> {
        let (metric, observer) = (self.nets.metric, self.observer);
        let mut chart = chart(&CutMesh::new(metric, faces, slits))?;
        chart.mirror = self.mirror;
        let simple = Simplified::new(&chart, Simplified::VERTICES);
        let surface = simple.as_ref().and_then(Simplified::surface);
        let parts = match simple.zip(surface) {
            Some((simple, surface)) => {
                let mut of_simple = Metric::new(&surface);
                let planning = Planning {
                    observer,
                    faces: simple.faces(&chart),
                };
                of_simple.weigh_panels(&planning);
                let mut search = self.of_part(&of_simple, &planning);
                search.start_from_components(f64::INFINITY)?;
                search.spend_rest();
                self.counts.effort.mapped_faces += search.counts.effort.mapped_faces;
                self.counts.effort.predicted_faces += search.counts.effort.predicted_faces;
                simple.parts_as(&chart, &search.charts())
            }
            None => vec![chart],
        };
        self.counts.maps += parts.len();
        self.counts.effort.mapped_faces += faces.len();
        let maps = (parts.into_par_iter().with_max_len(1))
            .flat_map_iter(|part| map_chart_by(part, &self.options_of(), Folds::Keep, observer));
        let maps: Vec<MappedChart> = maps.collect();
        Some(
            (maps.into_iter())
                .map(|map| Slitting::of_map(metric, map))
                .collect(),
        )
    }

    /// Slits a component until it is expected to keep its share of the bound. Returns the length of its slits and the excess that they
    /// leave.
    fn slit_under_share(&mut self, slitting: &mut Slitting<'a>) -> [f64; 2] {
        let metric = self.nets.metric;
        let faces = slitting.mesh.faces.iter();
        let weight: f64 = faces.map(|&face| metric.weight[face as usize]).sum();
        let budget = self.budget * weight / metric.weight.iter().sum::<f64>();
        self.slit_until(std::slice::from_mut(slitting), budget);
        [metric.length_of(&slitting.slits()), slitting.excess()]
    }

    /// Slits parts until their maps keep the bound, as far as slits help; returns `None` if that costs `most`.
    fn slit_under_bound(&mut self, slittings: &mut Vec<Slitting<'a>>, most: f64) -> Option<()> {
        let mut wanted = self.budget;
        for round in 0..MOST_ROUNDS {
            self.slit_until(slittings, wanted);
            let slits = (slittings.iter()).map(|it| self.nets.metric.length_of(&it.slits()));
            if Nets::least_cost(slits.sum(), slittings.len(), self.fill_weight) >= most {
                return None;
            }
            self.map_all(slittings)?;
            let excess = excess_of(slittings);
            if self.must_end() {
                break;
            }
            wanted = if excess > self.budget {
                // Half of the way: slits relieve more than is expected of them.
                let promised = self.budget * PROMISE.powi(round);
                (excess * promised).sqrt().min(2.0 * promised)
            } else if stretched_of(slittings) > Bound::stretched_budget() {
                TIGHTER * excess
            } else {
                break;
            };
        }
        if self.must_end() {
            return Some(());
        }
        self.take_back(slittings)
    }

    /// Plans slits where they relieve most for their length, until no more than some excess is expected.
    fn slit_until(&mut self, slittings: &mut [Slitting<'a>], wanted: f64) {
        while excess_of(slittings) > wanted && !self.must_end() {
            let mut best: Option<([f64; 2], usize)> = None;
            for (place, slitting) in slittings.iter_mut().enumerate() {
                let excess = slitting.excess();
                if let Some(relief) = slitting.plan_next(&mut self.counts.effort) {
                    let rate = [relief, excess];
                    if best.is_none_or(|(most, _)| rate > most) {
                        best = Some((rate, place));
                    }
                }
            }
            let Some((_, place)) = best else { return };
            slittings[place].make_next();
            self.observer.worked(slittings[place].mesh.faces.len());
        }
    }

    /// Maps the parts whose slits have changed. A part that has no map in floating point becomes several.
    fn map_all(&mut self, slittings: &mut Vec<Slitting<'a>>) -> Option<()> {
        let metric = self.nets.metric;
        for mut slitting in std::mem::take(slittings) {
            if slitting.map.is_none() {
                match <[MappedChart; 1]>::try_from(self.maps_of(&slitting)?) {
                    Ok([map]) => {
                        let mapped = Mapped::new(metric, map);
                        let predicted = slitting.predicted(slitting.n_made);
                        slitting.ratio = mapped.excess / predicted.max(f64::MIN_POSITIVE);
                        slitting.map = Some(mapped);
                    }
                    Err(maps) => {
                        slittings
                            .extend((maps.into_iter()).map(|map| Slitting::of_map(metric, map)));
                        continue;
                    }
                }
            }
            slittings.push(slitting);
        }
        Some(())
    }

    /// Maps a part with its slits; returns `None` if it is no disk.
    fn maps_of(&mut self, slitting: &Slitting) -> Option<Vec<MappedChart>> {
        let mesh = &slitting.mesh;
        let mesh = CutMesh::new(self.nets.metric, mesh.faces.clone(), &slitting.slits());
        let mut chart = chart(&mesh)?;
        chart.mirror = slitting.mirror;
        self.counts.maps += 1;
        self.counts.effort.mapped_faces += mesh.faces.len();
        Some(map_chart_by(
            chart,
            &self.options_of(),
            Folds::Keep,
            self.observer,
        ))
    }

    /// Takes back the slits that the bound can do without, if the maps are as good as expected then.
    fn take_back(&mut self, slittings: &mut [Slitting<'a>]) -> Option<()> {
        let made: Vec<usize> = slittings.iter().map(|it| it.n_made).collect();
        unslit_until(slittings, self.budget);
        let mut maps = Vec::new();
        let (mut excess, mut stretched) = (0.0, 0.0);
        for (place, slitting) in slittings.iter().enumerate() {
            if slitting.n_made == made[place] {
                excess += slitting.excess();
                stretched += slitting.stretched();
                continue;
            }
            let of_part = self.maps_of(slitting)?.into_iter();
            for mapped in of_part.map(|map| Mapped::new(self.nets.metric, map)) {
                excess += mapped.excess;
                stretched += mapped.stretched;
                maps.push((place, mapped));
            }
        }
        let n_changed = (slittings.iter().zip(&made)).filter(|(it, made)| it.n_made < **made);
        let is_kept = excess <= self.budget
            && stretched <= Bound::stretched_budget()
            && maps.len() == n_changed.count();
        if is_kept {
            for (place, mapped) in maps {
                slittings[place].map = Some(mapped);
            }
        } else {
            for (slitting, n_made) in slittings.iter_mut().zip(made) {
                slitting.n_made = n_made;
            }
        }
        Some(())
    }

    /// Pushes a map apart where it overlaps itself, or parts it there.
    fn parted(&self, map: MappedChart) -> Vec<Net> {
        let parts = map.free_of_overlaps(&self.options_of(), self.observer);
        let metric = self.nets.metric;
        (parts.iter())
            .map(|part| Net::of_chart(metric, part))
            .collect()
    }

    /// Returns the options of a chart's map, with what the energy of each face counts beside its area.
    fn options_of(&self) -> impl Fn(&Chart) -> embed::Options {
        let (options, metric) = (self.options, self.nets.metric);
        |chart| {
            let faces = chart.corners.iter().map(|corners| corners[0] / 3);
            weighted(options, metric, &faces.collect::<Vec<u32>>())
        }
    }
}

/// Returns the faces of each component, in ascending order.
pub fn components(metric: &Metric) -> Vec<Vec<u32>> {
    let all: Vec<u32> = (0..metric.corners.len() as u32).collect();
    connected(metric, &all)
}

/// Returns the faces of each part of some faces that is connected, both in ascending order.
fn connected(metric: &Metric, faces: &[u32]) -> Vec<Vec<u32>> {
    let mut sets = UnionFind::new(faces.len());
    for (place, &face) in (0u32..).zip(faces) {
        for h in 3 * face..3 * face + 3 {
            let t = metric.twin[h as usize];
            if t != CUT
                && let Ok(other) = faces.binary_search(&(t / 3))
            {
                sets.unite(place, other as u32);
            }
        }
    }
    let (labels, n) = sets.labels();
    let mut parts = vec![Vec::new(); n];
    for (&face, &label) in faces.iter().zip(&labels) {
        parts[label as usize].push(face);
    }
    parts
}

/// Returns the faces at all copies but one of edges between the same two vertices, in ascending order: copies of an edge with more than
/// two faces. Without them, the others have disks.
fn faces_at_doubled_edges(metric: &Metric, faces: &[u32]) -> Vec<u32> {
    let sheet = CutMesh::new(metric, faces, &[]).sheet;
    let mut edges: Vec<([u32; 2], u32)> = (sheet.edges())
        .map(|h| {
            let [a, b] = sheet.ends(h);
            ([a.min(b), a.max(b)], h)
        })
        .collect();
    edges.sort_unstable();
    let copies = edges.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let mut found: Vec<u32> = (copies.map(|pair| pair[1].1))
        .flat_map(|h| [h, sheet.twin[h as usize]])
        .filter(|&h| h != CUT)
        .map(|h| faces[h as usize / 3])
        .collect();
    found.sort_unstable();
    found.dedup();
    found
}

/// Returns ways to open a component to a disk, possibly with holes: several for a closed one of genus 0, along a mirror plane, or
/// between vertices far apart and from its sharpest vertex. Where edges have more than two faces, there may be none.
pub fn ways_to_open(metric: &Metric, faces: &[u32], mirror: Option<&MirrorPlane>) -> Vec<Vec<u32>> {
    let mesh = CutMesh::new(metric, faces, &[]);
    let mut ways = ways_to_open_alike(&mesh.sheet, Branches::None, mirror, FAR_APART);
    if mesh.is_sphere() && mirror.is_none() {
        ways.extend(first_slit(&mesh));
    }
    let is_disk = |slits: &Vec<u32>| chart(&CutMesh::new(metric, faces, slits)).is_some();
    let ways = ways.iter().map(|slits| mesh.edges(slits)).filter(is_disk);
    let ways: Vec<Vec<u32>> = ways.collect();
    if ways.is_empty() && mirror.is_some() {
        return ways_to_open(metric, faces, None);
    }
    ways
}

fn excess_of(slittings: &[Slitting]) -> f64 {
    slittings.iter().map(Slitting::excess).sum()
}

fn stretched_of(slittings: &[Slitting]) -> f64 {
    slittings.iter().map(Slitting::stretched).sum()
}

/// Takes slits back, the one that relieves least for its length first, as long as no more than some excess is expected.
fn unslit_until(slittings: &mut [Slitting], wanted: f64) {
    let expected = |it: &Slitting, n: usize| it.ratio * it.predicted(n);
    let mut all = excess_of(slittings);
    let mut of_each: Vec<f64> = slittings.iter().map(Slitting::excess).collect();
    loop {
        let mut least: Option<(f64, usize)> = None;
        for (place, it) in slittings.iter().enumerate() {
            let Some((planned, last)) = it.planned.as_ref().zip(it.n_made.checked_sub(1)) else {
                continue;
            };
            let after = all - of_each[place] + expected(it, last);
            let rate = it.ratio * planned.slits[last].rate;
            if after <= wanted && least.is_none_or(|(least, _)| rate < least) {
                least = Some((rate, place));
            }
        }
        let Some((_, place)) = least else { return };
        let it = &mut slittings[place];
        it.n_made -= 1;
        all += expected(it, it.n_made) - of_each[place];
        of_each[place] = expected(it, it.n_made);
    }
}
