//! Charts with their maps.

use super::observer::{Observer, Watching};
use super::opened::connected_faces;
use super::parts::{parted, parts};
use super::symmetry::image::cut_alike;
use super::unfold::overlaps::{lengths, one_side, overlaps};
use super::unfold::push_apart::pushed_apart;
use super::{Chart, halves};
use unwrapd_maps::embed::{self, Embedding, RestShapes, rest_shapes};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::numerics::vec3::{area_vector, norm};
use unwrapd_method::solver::{Control, Iterate, Summary};

/// Triangles of a part of a chart from which on it stays as it lies: what little it gains from being minimized again takes seconds.
const RELAXED: usize = 60_000;

/// Share of the overlapping pairs of faces that seams leave in a part before it is optimized again. If they leave none, the sum of
/// ln(1/2 + S + n/10) of 26 surfaces, most of them organic, is 42.10 instead of 41.91, in 38 instead of 41 seconds; with .5 it is 41.86
/// in 45 seconds, with .125 it is the same (`cargo bench -p unwrapd-layout --bench search`).
const LEFT: f64 = 0.25;

/// Least difference between the areas wound either way, as a share of a chart's area, that gives a chart a front. It is to be larger than
/// what rounding to the grid changes. Not tuned.
const FRONT: f64 = 0.01;

/// A chart, its map and how long the map took.
#[derive(Clone, Debug)]
pub struct MappedChart {
    /// The chart.
    pub chart: Chart,
    /// Its map: without flips if the energy has a barrier, and with [`Folds::Cut`] without overlaps.
    pub embedding: Embedding,
    /// Seconds on the observer's clock for the map of the chart that this one was cut from, its
    /// cutting included. Attempts that gave no valid map are not counted.
    pub seconds: f64,
}

/// What becomes of a chart whose map overlaps itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Folds {
    /// It is cut along the cheapest seams.
    Cut,
    /// It stays whole: the certificate counts what overlaps.
    Keep,
}

/// A chart with its map, cut where it has to be: into halves while floating point finds no valid
/// map, and with [`Folds::Cut`] where the map overlaps itself. Without a barrier a map may have flips.
pub fn map_chart(
    chart: Chart,
    options: &embed::Options,
    folds: Folds,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    map_chart_by(chart, &|_| options.clone(), folds, observer)
}

/// Like [`map_chart`], with the options of each part.
pub(crate) fn map_chart_by(
    chart: Chart,
    options_of: &dyn Fn(&Chart) -> embed::Options,
    folds: Folds,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    let mut mapped = Vec::new();
    let mut pending = vec![chart];
    while let Some(chart) = pending.pop() {
        let begin = observer.elapsed();
        let options = &options_of(&chart);
        let is_promised = options.barrier != BarrierKind::None;
        let faces = chart.disk.triangles.len();
        let watching = Watching {
            chart: &chart,
            observer,
        };
        let embedding = embed::parameterize(&chart.disk, &chart.positions, options, &watching);
        let is_valid = embed::is_positive(&chart.disk.triangles, &embedding.uv);
        if is_promised && !is_valid && faces > 1 {
            pending.extend(halves(&chart));
            continue;
        }
        let whole = MappedChart {
            chart,
            embedding,
            seconds: 0.0,
        };
        let unfolded = match folds {
            Folds::Cut => whole.free_of_overlaps(options_of, observer),
            Folds::Keep => vec![whole],
        };
        let seconds = observer.elapsed().saturating_sub(begin).as_secs_f64();
        mapped.extend(unfolded.into_iter().map(|part| MappedChart {
            seconds,
            ..part.facing_front()
        }));
    }
    mapped
}

/// A chart mapped from where it lies: `uv` may have any unit and be seen from behind. The chart is
/// mapped anew if it has a flipped or degenerate face or overlaps itself there, or if the optimized
/// map has such a face. It is cut where the map overlaps itself.
pub fn map_chart_from(
    chart: Chart,
    mut uv: Vec<[f64; 2]>,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    let begin = observer.elapsed();
    if signed_area(&chart, &uv) < 0.0 {
        for p in &mut uv {
            p[0] = -p[0];
        }
    }
    let watching = Watching {
        chart: &chart,
        observer,
    };
    let from = embed::optimize(&chart.disk, &chart.positions, &uv, options, &watching);
    match from {
        Ok(embedding)
            if overlaps(&chart.disk, &uv).is_empty()
                && embed::is_positive(&chart.disk.triangles, &embedding.uv) =>
        {
            let whole = MappedChart {
                chart,
                embedding,
                seconds: 0.0,
            };
            let seconds = observer.elapsed().saturating_sub(begin).as_secs_f64();
            (whole
                .free_of_overlaps(&|_| options.clone(), observer)
                .into_iter())
            .map(|part| MappedChart {
                seconds,
                ..part.facing_front()
            })
            .collect()
        }
        _ => map_chart(chart, options, Folds::Cut, observer),
    }
}

/// Whether to go on with the seams of a chart of so many faces. Between two such questions about as
/// much is done as in an iteration.
fn asked(observer: &dyn Observer, faces: usize) -> Control {
    observer.worked(faces);
    observer.control()
}

impl MappedChart {
    /// A chart whose map stays as it is. Most of its area becomes positive: one that is seen from behind is wound the other way.
    pub fn given(mut chart: Chart, uv: Vec<[f64; 2]>) -> Self {
        if signed_area(&chart, &uv) < 0.0 {
            chart.turn_over();
        }
        let summary = Summary::at_start(0.0);
        Self {
            chart,
            embedding: Embedding { uv, summary },
            seconds: 0.0,
        }
    }

    /// The chart pushed apart where it overlaps itself, or else the parts into which the cheapest seams divide it.
    ///
    /// Once the seams have taken most overlaps away, each part is optimized again from where it lies, which often ends others, and
    /// pushed apart anew. The overlapping pairs become fewer in each round by at least the same factor, so there are few rounds.
    pub(crate) fn free_of_overlaps(
        self,
        options_of: &dyn Fn(&Chart) -> embed::Options,
        observer: &dyn Observer,
    ) -> Vec<Self> {
        let pairs = overlaps(&self.chart.disk, &self.embedding.uv);
        let mut free = Vec::new();
        let mut folded = vec![self.pushed_apart(pairs, options_of, observer)];
        while let Some((whole, pairs)) = folded.pop() {
            if pairs.is_empty() {
                free.push(whole);
                continue;
            }
            let faces = whole.chart.disk.triangles.len();
            let most = (LEFT * pairs.len() as f64) as usize;
            for (part, pairs) in whole.parted_until(pairs, most, &|| asked(observer, faces)) {
                folded.push(if part.chart.disk.triangles.len() < RELAXED {
                    part.relaxed(pairs, options_of, observer)
                } else {
                    (part, pairs)
                });
            }
        }
        free
    }

    /// The chart with its slight folds pushed apart, given the pairs of its faces that overlap; with the pairs that are left.
    fn pushed_apart(
        mut self,
        pairs: Vec<[u32; 2]>,
        options_of: &dyn Fn(&Chart) -> embed::Options,
        observer: &dyn Observer,
    ) -> (Self, Vec<[u32; 2]>) {
        if pairs.is_empty() {
            return (self, pairs);
        }
        let faces = self.chart.disk.triangles.len();
        // What is pushed is a part of the chart: it is counted, but it is no map of it.
        let watch = |iterate: &Iterate| observer.iterate(faces, iterate);
        let options = options_of(&self.chart);
        let (uv, pairs) = pushed_apart(&self.chart, &self.embedding.uv, pairs, &options, &watch);
        self.embedding.uv = uv;
        (self, pairs)
    }

    /// The parts into which the cheapest seams divide the chart so that none overlaps itself in `image`, a map without flips like
    /// the chart's own; the parts are mapped as the whole is.
    ///
    /// Each seam takes overlaps away and adds none, so there are at most as many as overlapping pairs. Once `control`
    /// says so, any seam will do.
    pub fn unfolded(self, image: &[[f64; 2]], control: &dyn Fn() -> Control) -> Vec<Self> {
        let pairs = overlaps(&self.chart.disk, image);
        if pairs.is_empty() {
            return vec![self];
        }
        (self.parted_until_free(pairs, control).into_iter())
            .map(Self::facing_front)
            .collect()
    }

    pub(crate) fn parted_until_free(
        self,
        pairs: Vec<[u32; 2]>,
        control: &dyn Fn() -> Control,
    ) -> Vec<Self> {
        let parts = self.parted_until(pairs, 0, control).into_iter();
        parts.map(|(part, _)| part).collect()
    }

    /// The parts into which the cheapest seams divide the chart until at most so many pairs of faces overlap in each of them; with the
    /// pairs that are left.
    fn parted_until(
        self,
        pairs: Vec<[u32; 2]>,
        most: usize,
        control: &dyn Fn() -> Control,
    ) -> Vec<(Self, Vec<[u32; 2]>)> {
        let mut done = Vec::new();
        let mut folded = vec![(self, pairs)];
        while let Some((whole, pairs)) = folded.pop() {
            for (part, faces) in whole.parted_at(&pairs, control) {
                let pairs = within(&faces, whole.chart.disk.triangles.len(), &pairs);
                if pairs.len() <= most {
                    done.push((part, pairs));
                } else {
                    folded.push((part, pairs));
                }
            }
        }
        done
    }

    /// Cut once where these pairs of its triangles overlap; with each part the triangles it is made of.
    fn parted_at(
        &self,
        pairs: &[[u32; 2]],
        control: &dyn Fn() -> Control,
    ) -> Vec<(Self, Vec<u32>)> {
        let twin = self.chart.disk.twins();
        let length = lengths(&self.chart.disk, &self.chart.positions);
        let side = one_side(&twin, &length, pairs, control);
        let is_apart = |twin: &Vec<u32>| {
            let (part, _) = connected_faces(twin);
            (pairs.iter()).any(|pair| part[pair[0] as usize] != part[pair[1] as usize])
        };
        let twin = (cut_alike(&self.chart, &side).filter(is_apart))
            .unwrap_or_else(|| parted(&twin, &side));
        parts(&self.chart, &twin)
            .into_iter()
            .map(|(chart, faces)| (self.restricted(chart, &faces), faces))
            .collect()
    }

    /// Makes the chart and its map so many times as large.
    pub fn scale(&mut self, size: f64) {
        for p in &mut self.embedding.uv {
            *p = p.map(|x| size * x);
        }
        for p in &mut self.chart.positions {
            *p = p.map(|x| size * x);
        }
        if let Some(plane) = &mut self.chart.mirror {
            plane.offset *= size;
        }
    }

    /// What the faces are like on the surface.
    pub(crate) fn rest_shapes(&self) -> RestShapes {
        rest_shapes(&self.chart.positions, &self.chart.disk.triangles)
    }

    /// The area of the map.
    pub fn area(&self) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| self.embedding.uv[v as usize]);
        let doubled = |[a, b, c]: [[f64; 2]; 3]| doubled_area(a, b, c);
        let triangles = self.chart.disk.triangles.iter();
        triangles.map(corners).map(doubled).sum::<f64>() / 2.0
    }

    /// The area of the surface that is mapped.
    pub fn surface_area(&self) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| self.chart.positions[v as usize]);
        let doubled = |[a, b, c]: [[f64; 3]; 3]| norm(area_vector(a, b, c));
        let triangles = self.chart.disk.triangles.iter();
        triangles.map(corners).map(doubled).sum::<f64>() / 2.0
    }

    /// The same map of a part.
    pub(super) fn restricted(&self, chart: Chart, faces: &[u32]) -> Self {
        let mut uv = vec![[0.0; 2]; chart.disk.n_vertices];
        for (triangle, &face) in chart.disk.triangles.iter().zip(faces) {
            let of_whole = self.chart.disk.triangles[face as usize];
            for (&v, w) in triangle.iter().zip(of_whole) {
                uv[v as usize] = self.embedding.uv[w as usize];
            }
        }
        Self {
            embedding: Embedding {
                uv,
                summary: self.embedding.summary,
            },
            chart,
            seconds: self.seconds,
        }
    }

    /// The chart optimized from its present map and pushed apart, unless more pairs of its faces overlap then; with those that do.
    pub(super) fn relaxed(
        self,
        pairs: Vec<[u32; 2]>,
        options_of: &dyn Fn(&Chart) -> embed::Options,
        observer: &dyn Observer,
    ) -> (Self, Vec<[u32; 2]>) {
        let chart = &self.chart;
        let Chart {
            disk, positions, ..
        } = chart;
        let options = options_of(chart);
        let watching = Watching { chart, observer };
        let from = &self.embedding.uv;
        if let Ok(embedding) = embed::optimize(disk, positions, from, &options, &watching)
            && embed::is_positive(&disk.triangles, &embedding.uv)
        {
            let again = overlaps(disk, &embedding.uv);
            let relaxed = Self {
                embedding: Embedding {
                    uv: embedding.uv,
                    summary: self.embedding.summary.followed_by(&embedding.summary),
                },
                ..self.clone()
            };
            let (relaxed, again) = relaxed.pushed_apart(again, options_of, observer);
            if again.len() <= pairs.len() {
                return (relaxed, again);
            }
        }
        (self, pairs)
    }

    /// Turned over if more of its area in the plane belongs to triangles that the surface winds the other way.
    ///
    /// Charts are wound as most of their area is in space. Where that is a tie, as in a wall modeled from both sides, the
    /// map decides.
    pub(crate) fn facing_front(mut self) -> Self {
        if self.area_by_winding().iter().sum::<f64>() < 0.0 {
            self.chart.turn_over();
            for p in &mut self.embedding.uv {
                p[0] = -p[0];
            }
        }
        self
    }

    /// Cuts the chart where its winding changes if as much of its area is wound one way as the other: rounding would decide
    /// from which side it is seen.
    pub fn parted_without_front(self) -> Vec<Self> {
        let area = self.area_by_winding();
        let total: f64 = area.iter().map(|area| area.abs()).sum();
        if area.iter().sum::<f64>().abs() >= FRONT * total {
            return vec![self];
        }
        let is_front: Vec<bool> = area.iter().map(|&area| area > 0.0).collect();
        let twin = parted(&self.chart.disk.twins(), &is_front);
        parts(&self.chart, &twin)
            .into_iter()
            .map(|(chart, faces)| self.restricted(chart, &faces).facing_front())
            .collect()
    }

    /// Returns twice the area of each triangle in the plane, negative where the surface winds it the other way.
    fn area_by_winding(&self) -> Vec<f64> {
        let triangles = self.chart.disk.triangles.iter().enumerate();
        let doubled = triangles.map(|(t, triangle)| {
            let [a, b, c] = triangle.map(|v| self.embedding.uv[v as usize]);
            let doubled = doubled_area(a, b, c);
            if self.chart.is_wound_as_surface(t) {
                doubled
            } else {
                -doubled
            }
        });
        doubled.collect()
    }
}

/// Sum of the areas of a chart's triangles in a map, as the chart winds them.
fn signed_area(chart: &Chart, uv: &[[f64; 2]]) -> f64 {
    let doubled = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| uv[v as usize]);
        doubled_area(a, b, c)
    };
    chart.disk.triangles.iter().map(doubled).sum::<f64>() / 2.0
}

/// The pairs of triangles that are both among these, in their numbering.
fn within(faces: &[u32], n_faces: usize, pairs: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let mut local = vec![None; n_faces];
    for (i, &face) in (0..).zip(faces) {
        local[face as usize] = Some(i);
    }
    pairs
        .iter()
        .filter_map(|&[a, b]| Some([local[a as usize]?, local[b as usize]?]))
        .collect()
}
