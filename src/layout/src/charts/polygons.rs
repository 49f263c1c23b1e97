//! Polygons kept whole: seams moved from their diagonals to their sides.
//!
//! Charts are cut along the edges of triangles, and some of these are diagonals of polygons. A file that has polygons
//! has one UV per corner of a polygon, so it would have to split them there. Here the triangles on one side of such a
//! seam go over to the other side: they are taken out of their chart and glued to the rest of their polygon, laid out
//! as they are in space, where there is room for them. A part of a disk is a disk, and so is a disk with one more
//! triangle at an edge of its boundary, so charts remain disks. All other triangles stay where they lie.
//!
//! Polygons are known by the numbers of their corners alone. Seams between polygons stay where they are.

use super::chart::Chart;
use super::mapped::MappedChart;
use super::opened::connected_faces;
use std::collections::{BTreeSet, HashMap};
use unwrapd_maps::cut::Sheet;
use unwrapd_maps::embed::Embedding;
use unwrapd_maps::mesh::{CUT, Disk, next};
use unwrapd_maps::plane::{BoxIndex, interiors_intersect};
use unwrapd_method::numerics::bounds::bounds_of;
use unwrapd_method::numerics::vec2::doubled_area;
use unwrapd_method::numerics::vec3::{distance, dot, norm, sub};

/// Chart of a polygon that was split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PolygonHome {
    /// The chart of one of its parts if there is room beside that; else it stays split.
    OnlyWithPart,
    /// The chart of one of its parts if there is room beside that, else one of its own.
    WithPart,
    /// One of its own.
    Own,
}

/// Returns the charts with polygons in one piece, or `None` if there is none to unite. `corners[f][c]` is the number of the
/// polygon corner at corner c of face f of the mesh; two faces are of one polygon if they share such numbers.
pub fn with_whole_polygons(
    charts: &[MappedChart],
    corners: &[[u32; 3]],
    home: PolygonHome,
) -> Option<Vec<MappedChart>> {
    let diagonals = Diagonals::new(charts, corners);
    let split = diagonals.split(charts);
    if split.is_empty() {
        return None;
    }
    // Take the charts that have a part of a split polygon, and move triangles between them.
    let mut is_affected = vec![false; charts.len()];
    for place in split.as_flattened() {
        is_affected[place.chart] = true;
    }
    let mut gluing = Gluing::new(charts, &is_affected, &diagonals, corners);
    for face in 0..gluing.corners.len() as u32 {
        gluing.unite_polygon(face, home);
    }
    if !gluing.is_moved.contains(&true) {
        return None;
    }
    // The other charts stay as they are.
    let mut whole: Vec<MappedChart> = (charts.iter().zip(&is_affected))
        .filter(|(_, is_affected)| !**is_affected)
        .map(|(chart, _)| chart.clone())
        .collect();
    whole.extend(gluing.mapped(charts)?);
    Some(whole)
}

/// A halfedge of a chart.
#[derive(Clone, Copy)]
struct ChartEdge {
    chart: usize,
    halfedge: u32,
}

/// Edges inside polygons, each with its halfedges in the charts.
struct Diagonals(Vec<[ChartEdge; 2]>);

impl Diagonals {
    fn new(charts: &[MappedChart], corners: &[[u32; 3]]) -> Self {
        let mut first: HashMap<[u32; 2], ChartEdge> = HashMap::new();
        let mut pairs = Vec::new();
        for (chart, mapped) in charts.iter().enumerate() {
            let all = mapped.chart.corners.as_flattened();
            let id = |h: u32| id_of(all[h as usize], corners);
            for halfedge in 0..all.len() as u32 {
                let [a, b] = [id(halfedge), id(next(halfedge))];
                let edge = ChartEdge { chart, halfedge };
                if let Some(other) = first.insert([a.min(b), a.max(b)], edge) {
                    pairs.push([other, edge]);
                }
            }
        }
        Self(pairs)
    }

    /// Returns those along which charts are cut.
    fn split(&self, charts: &[MappedChart]) -> Vec<[ChartEdge; 2]> {
        let ends = |edge: ChartEdge| {
            let all = charts[edge.chart].chart.disk.triangles.as_flattened();
            let [a, b] = [edge.halfedge, next(edge.halfedge)].map(|h| all[h as usize]);
            (edge.chart, a.min(b), a.max(b))
        };
        let is_split = |pair: &&[ChartEdge; 2]| ends(pair[0]) != ends(pair[1]);
        self.0.iter().filter(is_split).copied().collect()
    }
}

/// Returns the number of the polygon corner at a corner `3 f + c` of the mesh.
fn id_of(corner: u32, corners: &[[u32; 3]]) -> u32 {
    corners[corner as usize / 3][corner as usize % 3]
}

/// The triangles of some charts and their gluing.
struct Gluing {
    /// Vertices of each triangle: one for all corners at a position.
    triangles: Vec<[u32; 3]>,
    positions: Vec<[f64; 3]>,
    /// Corners of the mesh, polygon corners, and images in the chart, of each triangle.
    corners: Vec<[u32; 3]>,
    ids: Vec<[u32; 3]>,
    uv: Vec<[[f64; 2]; 3]>,
    /// Index of the chart that each triangle is in.
    chart: Vec<usize>,
    /// For each halfedge the one that it is glued to, or [`CUT`].
    twin: Vec<u32>,
    /// For each halfedge the one on the other side of a diagonal, or [`CUT`].
    diagonal: Vec<u32>,
    is_moved: Vec<bool>,
    /// For each chart its triangles before any was moved.
    before: Vec<Occupied>,
}

/// Triangles of a chart, to be found by their images.
#[derive(Default)]
struct Occupied {
    /// The first of its triangles; the others follow.
    first: u32,
    index: Option<BoxIndex>,
    /// Triangles that were moved to the chart.
    guests: Vec<u32>,
}

impl Gluing {
    fn new(
        charts: &[MappedChart],
        is_taken: &[bool],
        diagonals: &Diagonals,
        corners: &[[u32; 3]],
    ) -> Self {
        let mut gluing = Self {
            triangles: Vec::new(),
            positions: Vec::new(),
            corners: Vec::new(),
            ids: Vec::new(),
            uv: Vec::new(),
            chart: Vec::new(),
            twin: Vec::new(),
            diagonal: Vec::new(),
            is_moved: Vec::new(),
            before: Vec::new(),
        };
        let mut number: HashMap<[u64; 3], u32> = HashMap::new();
        for (
            index,
            MappedChart {
                chart, embedding, ..
            },
        ) in charts.iter().enumerate()
        {
            if !is_taken[index] {
                gluing.before.push(Occupied::default());
                continue;
            }
            let offset = gluing.twin.len() as u32;
            let images = chart.disk.triangles.iter();
            let images: Vec<[[f64; 2]; 3]> = images
                .map(|triangle| triangle.map(|v| embedding.uv[v as usize]))
                .collect();
            let boxes: Vec<_> = images.iter().map(|image| bounds_of(image)).collect();
            gluing.before.push(Occupied {
                first: offset / 3,
                index: Some(BoxIndex::new(&boxes)),
                guests: Vec::new(),
            });
            gluing.uv.extend(images);
            let mut welded = |v: u32| {
                let position = chart.positions[v as usize];
                *number.entry(position.map(f64::to_bits)).or_insert_with(|| {
                    gluing.positions.push(position);
                    gluing.positions.len() as u32 - 1
                })
            };
            let triangles = chart.disk.triangles.iter();
            (gluing.triangles).extend(triangles.map(|triangle| triangle.map(&mut welded)));
            gluing.corners.extend(&chart.corners);
            gluing.chart.resize(gluing.corners.len(), index);
            let twins = chart.disk.twins().into_iter();
            (gluing.twin).extend(twins.map(|t| if t == CUT { CUT } else { t + offset }));
        }
        gluing.ids = (gluing.corners.iter())
            .map(|all| all.map(|corner| id_of(corner, corners)))
            .collect();
        gluing.diagonal = vec![CUT; gluing.twin.len()];
        gluing.is_moved = vec![false; gluing.corners.len()];
        for pair in &diagonals.0 {
            if pair.iter().all(|edge| is_taken[edge.chart]) {
                let [h, t] = pair.map(|edge| 3 * gluing.before[edge.chart].first + edge.halfedge);
                gluing.diagonal[h as usize] = t;
                gluing.diagonal[t as usize] = h;
            }
        }
        gluing
    }

    /// Moves the triangles of a face's polygon to the part of it that is hardest to move and has room for them; without
    /// one, the polygon becomes a chart.
    fn unite_polygon(&mut self, face: u32, home: PolygonHome) {
        let polygon = connected(face, |h| self.diagonal[h as usize]);
        if polygon.first() != Some(&face) || polygon.len() < 2 {
            return;
        }
        // Find its parts, and the one that stays.
        let glued_diagonal = |h: u32| match self.diagonal[h as usize] {
            t if t == self.twin[h as usize] => t,
            _ => CUT,
        };
        let mut parts: Vec<BTreeSet<u32>> = Vec::new();
        let mut is_in_part: BTreeSet<u32> = BTreeSet::new();
        for &face in &polygon {
            if !is_in_part.contains(&face) {
                let part = connected(face, glued_diagonal);
                is_in_part.extend(&part);
                parts.push(part);
            }
        }
        if parts.len() < 2 {
            return;
        }
        parts.sort_by(|a, b| self.hold(b).total_cmp(&self.hold(a)));
        let has_room = |part: &&BTreeSet<u32>| self.has_room(part, &polygon, home);
        // Where more than two faces meet at a diagonal, another polygon may be glued to it.
        let is_entangled = polygon.iter().flat_map(|&t| 3 * t..3 * t + 3).any(|h| {
            let [twin, other] = [&self.twin, &self.diagonal].map(|of| of[h as usize]);
            other != CUT && twin != CUT && twin != other
        });
        let stays = match home {
            _ if is_entangled => None,
            PolygonHome::OnlyWithPart | PolygonHome::WithPart => parts.iter().find(has_room),
            PolygonHome::Own => None,
        };
        if stays.is_none() && home == PolygonHome::OnlyWithPart {
            return;
        }
        // Without a part that stays, take the polygon out and begin with one of its faces.
        let mut united = stays.cloned().unwrap_or_default();
        if stays.is_none() {
            // A polygon that overlaps itself when it is laid out stays split.
            let first: BTreeSet<u32> = parts[0].first().copied().into_iter().collect();
            if !self.has_room(&first, &polygon, PolygonHome::Own) {
                return;
            }
            for h in polygon.iter().flat_map(|&t| 3 * t..3 * t + 3) {
                self.cut(h);
            }
            united = first;
        }
        // Glue the other triangles to it, one after the other.
        let mut pending: Vec<u32> = united.iter().copied().collect();
        while let Some(face) = pending.pop() {
            for h in 3 * face..3 * face + 3 {
                let t = self.diagonal[h as usize];
                if t != CUT && united.insert(t / 3) {
                    self.take_over(h);
                    pending.push(t / 3);
                }
            }
        }
    }

    /// Returns whether the triangles of a polygon that are not in `part` overlap nothing when they are laid out beside
    /// it: neither each other and the part, nor other triangles of its chart if it stays there.
    fn has_room(&self, part: &BTreeSet<u32>, polygon: &BTreeSet<u32>, home: PolygonHome) -> bool {
        let Some(&first) = part.first() else {
            return false;
        };
        let chart = self.chart[first as usize];
        let guests = &self.before[chart].guests;
        let mut images: HashMap<u32, [[f64; 2]; 3]> = HashMap::new();
        let mut pending: Vec<u32> = part.iter().copied().collect();
        while let Some(face) = pending.pop() {
            for h in 3 * face..3 * face + 3 {
                let t = self.diagonal[h as usize];
                if t == CUT || part.contains(&(t / 3)) || images.contains_key(&(t / 3)) {
                    continue;
                }
                let of = images.get(&face).unwrap_or(&self.uv[face as usize]);
                let image = self.laid_out(h, t, of);
                let own = part.iter().map(|&t| &self.uv[t as usize]);
                let guests = guests.iter().map(|&guest| &self.uv[guest as usize]);
                let is_apart = !images.values().chain(own).any(|it| overlap(&image, it));
                let is_free = is_apart
                    && (home == PolygonHome::Own
                        || (!guests.into_iter().any(|it| overlap(&image, it))
                            && self.is_free(chart, &image, |t| !polygon.contains(&t))));
                if !is_free {
                    return false;
                }
                images.insert(t / 3, image);
                pending.push(t / 3);
            }
        }
        true
    }

    /// Returns `true` if an image overlaps no triangle that a chart had before. Triangles for which `counts` is `false` are left out.
    fn is_free(&self, chart: usize, image: &[[f64; 2]; 3], counts: impl Fn(u32) -> bool) -> bool {
        let Occupied { first, index, .. } = &self.before[chart];
        let mut is_free = true;
        if let Some(index) = index {
            index.meeting(&bounds_of(image), |k| {
                let t = first + k;
                is_free &= self.is_moved[t as usize]
                    || !counts(t)
                    || !overlap(image, &self.uv[t as usize]);
            });
        }
        is_free
    }

    /// Returns the length of the seams that would have to be cut to move a part of a polygon; infinite if its chart
    /// would fall apart.
    fn hold(&self, part: &BTreeSet<u32>) -> f64 {
        let halfedges = || part.iter().flat_map(|&t| 3 * t..3 * t + 3);
        let is_glued = |h: u32| self.twin[h as usize] != CUT;
        let is_side = |h: u32| self.diagonal[h as usize] == CUT;
        // A vertex between two glued sides that is on the boundary joins what would be left of the chart at a point.
        let pinches = |h: u32| {
            let to = next(h);
            is_side(h) && is_side(to) && is_glued(h) && is_glued(to) && self.is_on_boundary(to)
        };
        if halfedges().any(pinches) {
            return f64::INFINITY;
        }
        let cut = halfedges().filter(|&h| is_side(h) && is_glued(h));
        cut.map(|h| self.length(h)).sum()
    }

    /// Returns whether the vertex at a corner is on the boundary of its chart.
    fn is_on_boundary(&self, corner: u32) -> bool {
        let mut h = corner;
        loop {
            h = match self.twin[next(next(h)) as usize] {
                CUT => return true,
                t => t,
            };
            if h == corner {
                return false;
            }
        }
    }

    /// Glues the triangle across a diagonal to it, if it is not.
    fn take_over(&mut self, h: u32) {
        let mut t = self.diagonal[h as usize];
        let face = t / 3;
        if self.twin[h as usize] == t {
            return;
        }
        (3 * face..3 * face + 3).for_each(|side| self.cut(side));
        // Charts may show a surface from either side.
        if self.id(h) == self.id(t) {
            t = self.turn_over(t);
        }
        self.twin[h as usize] = t;
        self.twin[t as usize] = h;
        self.uv[face as usize] = self.laid_out(h, t, &self.uv[h as usize / 3]);
        let chart = self.chart[h as usize / 3];
        self.chart[face as usize] = chart;
        self.before[chart].guests.push(face);
        self.is_moved[face as usize] = true;
    }

    fn cut(&mut self, h: u32) {
        let across = std::mem::replace(&mut self.twin[h as usize], CUT);
        if across != CUT {
            self.twin[across as usize] = CUT;
        }
    }

    /// Reverses the winding of a triangle that is glued to none; returns the new number of a halfedge of it.
    fn turn_over(&mut self, h: u32) -> u32 {
        let first = h - h % 3;
        let face = first as usize / 3;
        self.triangles[face].swap(1, 2);
        self.corners[face].swap(1, 2);
        self.ids[face].swap(1, 2);
        self.uv[face].swap(1, 2);
        self.diagonal.swap(first as usize, first as usize + 2);
        for side in first..first + 3 {
            let across = self.diagonal[side as usize];
            if across != CUT {
                self.diagonal[across as usize] = side;
            }
        }
        first + (2 - h % 3)
    }

    /// Returns the image of the triangle of `t` beside that of `h`, whose corners are at `of`, at the scale of their
    /// common edge.
    fn laid_out(&self, h: u32, t: u32, of: &[[f64; 2]; 3]) -> [[f64; 2]; 3] {
        let corners = [t, next(t), next(next(t))];
        let [a, b, c] = corners.map(|corner| self.position(corner));
        let ends = [next(h), h].map(|corner| of[corner as usize % 3]);
        // It lies to the right of `h`, whichever way it is wound.
        let is_turned = self.id(h) == self.id(t);
        let [u, v] = if is_turned { [ends[1], ends[0]] } else { ends };
        let length = distance(a, b);
        let along = sub(b, a).map(|x| x / length);
        let x = dot(sub(c, a), along);
        let y = norm([0, 1, 2].map(|k| c[k] - a[k] - x * along[k]));
        let y = if is_turned { -y } else { y };
        let side = [v[0] - u[0], v[1] - u[1]].map(|d| d / length);
        let third = [
            u[0] + x * side[0] - y * side[1],
            u[1] + x * side[1] + y * side[0],
        ];
        let mut image = [[0.0; 2]; 3];
        for (corner, place) in corners.into_iter().zip([u, v, third]) {
            image[corner as usize % 3] = place;
        }
        image
    }

    fn id(&self, corner: u32) -> u32 {
        self.ids[corner as usize / 3][corner as usize % 3]
    }

    fn position(&self, corner: u32) -> [f64; 3] {
        self.positions[self.triangles[corner as usize / 3][corner as usize % 3] as usize]
    }

    fn length(&self, h: u32) -> f64 {
        distance(self.position(h), self.position(next(h)))
    }

    /// Returns the charts with their maps; `None` if one is not a disk, which does not happen.
    fn mapped(&self, charts: &[MappedChart]) -> Option<Vec<MappedChart>> {
        let (label, n_charts) = connected_faces(&self.twin);
        let mesh = (&*self.triangles, &*self.positions);
        let sheets = Sheet::divide(mesh, &self.twin, &label, n_charts).into_iter();
        let mapped = sheets.map(|sheet| {
            let faces = || sheet.triangles.iter().map(|&t| t as usize);
            let before = &charts[self.chart[faces().next()?]];
            let mut uv = vec![[0.0; 2]; sheet.positions.len()];
            for (&v, place) in sheet.vertex.iter().zip(faces().flat_map(|t| self.uv[t])) {
                uv[v as usize] = place;
            }
            let disk = Disk::new(sheet.positions.len(), sheet.vertex.as_chunks().0.to_vec());
            debug_assert!(disk.is_ok(), "a polygon was united to no disk: {disk:?}");
            let map = MappedChart {
                embedding: Embedding {
                    uv,
                    summary: before.embedding.summary,
                },
                seconds: before.seconds,
                chart: Chart {
                    corners: faces().map(|t| self.corners[t]).collect(),
                    disk: disk.ok()?,
                    mirror: before.chart.mirror,
                    positions: sheet.positions,
                },
            };
            Some(map.facing_front())
        });
        mapped.collect()
    }
}

/// Returns whether the interiors of two images intersect, whichever way they are wound.
fn overlap(a: &[[f64; 2]; 3], b: &[[f64; 2]; 3]) -> bool {
    let counter_clockwise = |image: &[[f64; 2]; 3]| {
        let [p, q, r] = *image;
        if doubled_area(p, q, r) < 0.0 {
            [p, r, q]
        } else {
            *image
        }
    };
    interiors_intersect(&counter_clockwise(a), &counter_clockwise(b))
}

/// Returns the faces that can be reached from one across `link`, which returns a halfedge or [`CUT`].
fn connected(face: u32, link: impl Fn(u32) -> u32) -> BTreeSet<u32> {
    let mut faces = BTreeSet::from([face]);
    let mut pending = vec![face];
    while let Some(face) = pending.pop() {
        for h in 3 * face..3 * face + 3 {
            let t = link(h);
            if t != CUT && faces.insert(t / 3) {
                pending.push(t / 3);
            }
        }
    }
    faces
}
