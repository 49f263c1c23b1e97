//! Anchors: vertices of UV maps and their targets.

use super::chart::{UvChart, UvRest, UvVertices, body};
use super::map::{EditError, MOST_ANCHORS, UvMap, UvMesh};
use crate::body::{Body, Boundary, locate, sole_vertex};
use crate::handle::{self, Select, middle};
use crate::line::held_points;
use crate::pull::{Grip, Holds};
use crate::region::{Line, MOST_DEGREES, PlanarMotion, Region};
use serde::{Deserialize, Serialize};
use std::collections::hash_map::Entry;
use std::collections::{BTreeSet, HashMap, HashSet};
use unwrapd_maps::mesh::PlanarMesh;
use unwrapd_maps::plane::segment_distance;
use unwrapd_method::numerics::predicates::orient2d_sign;

/// Largest coordinate of a UV; no texture repeats that often.
const FARTHEST: f64 = 1e6;

/// Distance by which an anchor may lie outside a chart: a texel of a texture of 1024, the accuracy of a pointer.
const OUTSIDE: f64 = 1e-3;

/// A part of a UV map and where it goes, in the numbers of the map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum Anchor {
    /// A vertex of the mesh, which must have one UV.
    Vertex {
        /// Its index, from 0.
        vertex: u32,
        /// Its new UV.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// Strength of a soft handle; see `weight` of a place.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// The point of the surface that has a UV, a vertex if it is one. Next to a boundary that stays, and at most a texel of a
    /// texture of 1024 outside a chart, it is the nearest vertex, whose target is shifted by the same offset.
    Place {
        /// A UV.
        #[serde(deserialize_with = "handle::planar")]
        at: [f64; 2],
        /// Where it goes.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// Strength of a soft handle, greater than 0; without it the handle comes to its target
        /// exactly. The energy grows by `weight` times the mean squared distance of what the handle
        /// holds from its targets, for a mean triangle of area 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A disc, a box or an outline that keeps its shape: its vertices in the chart in which its
    /// middle lies.
    Region(Region),
    /// A list of vertices of the mesh, moved as a rigid body in each chart.
    Vertices {
        /// Their indices, from 0.
        vertices: Vec<u32>,
        /// Where the middle of their bounding box goes; without it and `by`, they stay.
        #[serde(
            default,
            deserialize_with = "handle::optional_planar",
            skip_serializing_if = "Option::is_none"
        )]
        to: Option<[f64; 2]>,
        /// The offset by which they move, in place of `to`.
        #[serde(
            default,
            deserialize_with = "handle::optional_planar",
            skip_serializing_if = "Option::is_none"
        )]
        by: Option<[f64; 2]>,
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a place.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// The vertices that a selector names, moved as a rigid body in each chart.
    Selection {
        /// The selector.
        #[cfg_attr(feature = "schema", schema(value_type = String))]
        select: Select,
        /// Where the middle of their bounding box goes; without it and `by`, they stay.
        #[serde(
            default,
            deserialize_with = "handle::optional_planar",
            skip_serializing_if = "Option::is_none"
        )]
        to: Option<[f64; 2]>,
        /// The offset by which they move, in place of `to`.
        #[serde(
            default,
            deserialize_with = "handle::optional_planar",
            skip_serializing_if = "Option::is_none"
        )]
        by: Option<[f64; 2]>,
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a place.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A line of the chart in which it begins.
    Line(Line),
}

impl Anchor {
    /// Changes the target.
    pub(super) fn retarget(&mut self, target: [f64; 2]) {
        match self {
            Self::Vertex { to, .. } | Self::Place { to, .. } => *to = target,
            Self::Region(region) => region.retarget(target),
            Self::Vertices { to, by, .. } | Self::Selection { to, by, .. } => {
                (*to, *by) = (Some(target), None);
            }
            Self::Line(line) => line.retarget(target),
        }
    }

    /// Returns whether every number is finite, none exceeds [`FARTHEST`], and a region is one.
    fn is_valid(&self) -> bool {
        let are_near = |place: &[f64; 2]| place.iter().all(|x| x.abs() <= FARTHEST);
        let is_weight = self.weight().is_none_or(|w| w > 0.0 && w.is_finite());
        let is_place = match self {
            Self::Vertex { to, .. } => are_near(to),
            Self::Place { at, to, .. } => are_near(at) && are_near(to),
            Self::Region(region) => region.is_valid(FARTHEST),
            Self::Vertices { to, by, turn, .. } | Self::Selection { to, by, turn, .. } => {
                !(to.is_some() && by.is_some())
                    && to.iter().chain(by).all(are_near)
                    && turn.abs() <= MOST_DEGREES
            }
            Self::Line(line) => line.is_valid(FARTHEST),
        };
        is_place && is_weight
    }

    /// Returns the strength of a soft handle.
    fn weight(&self) -> Option<f64> {
        match self {
            Self::Vertex { weight, .. }
            | Self::Place { weight, .. }
            | Self::Vertices { weight, .. }
            | Self::Selection { weight, .. } => *weight,
            Self::Region(region) => region.weight(),
            Self::Line(line) => line.weight,
        }
    }

    /// Returns the selector of the anchor, if it has one, so that its members can be filled in with corners `3 * face +
    /// c` of the mesh.
    pub fn select_mut(&mut self) -> Option<&mut Select> {
        match self {
            Self::Selection { select, .. } => Some(select),
            _ => None,
        }
    }
}

/// Parses `{"anchors": [{"vertex": i, "to": [u, v]}, {"at": [u, v], "to": [u, v]}, {"center": [u, v], "radius": r,
/// "to": [u, v], "turn": degrees}, {"line": […], "to": […]}, {"select": "material=…", "by": [u, v]}, …]}`; `points` is another name of `anchors`.
pub fn parse_anchors(json: &[u8]) -> Result<Vec<Anchor>, EditError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct AnchorsFile {
        #[serde(alias = "points")]
        anchors: Vec<Anchor>,
    }
    let file: AnchorsFile =
        unwrapd_api::from_json(json).map_err(|error| EditError::Malformed(error.to_string()))?;
    Ok(file.anchors)
}

/// An anchor with the spot of the UV map that it holds.
pub(super) struct Held {
    /// Index of the anchor.
    pub anchor: usize,
    pub spot: Spot,
    pub to: [f64; 2],
    /// Strength of a soft anchor, its share of it if there are several spots.
    pub weight: Option<f64>,
}

/// The spot that an anchor holds.
pub(super) enum Spot {
    /// A vertex of the UV map.
    Vertex(u32),
    /// A UV in a chart.
    Place { chart: u32, at: [f64; 2] },
    /// A line of a chart, which goes to the line of its target.
    Line { chart: u32, line: Line },
}

/// A vertex, or a chart with the bits of a UV: equal for equal spots.
type SpotKey = (u32, Option<[u64; 2]>);

impl Spot {
    /// Returns the key of a spot; `None` for a line, whose points are chosen later.
    fn key(&self) -> Option<SpotKey> {
        match *self {
            Self::Vertex(vertex) => Some((vertex, None)),
            // 0 and −0 are one place.
            Self::Place { chart, at } => Some((chart, Some(at.map(|x| (x + 0.0).to_bits())))),
            Self::Line { .. } => None,
        }
    }

    /// Returns the chart of the spot.
    pub fn chart(&self, map: &UvMap, vertices: &UvVertices) -> u32 {
        match *self {
            Self::Vertex(vertex) => vertices.chart(map, vertex),
            Self::Place { chart, .. } | Self::Line { chart, .. } => chart,
        }
    }
}

/// Finds the spots that anchors hold, each spot once.
pub(super) fn hold(
    mesh: &UvMesh,
    map: &UvMap,
    vertices: &UvVertices,
    anchors: &[Anchor],
) -> Result<Vec<Held>, EditError> {
    if !(1..=MOST_ANCHORS).contains(&anchors.len()) {
        return Err(EditError::HandleCount(anchors.len()));
    }
    let mut held: Vec<Held> = Vec::with_capacity(anchors.len());
    let mut place_of: HashMap<SpotKey, usize> = HashMap::new();
    for (anchor, which) in anchors.iter().enumerate() {
        if !which.is_valid() {
            return Err(EditError::BadTarget(anchor));
        }
        // Find the spots.
        let spots = match which {
            Anchor::Vertex { vertex, to, .. } => {
                let vertex = only_vertex(mesh, map, vertices, anchor, *vertex)?;
                vec![(Spot::Vertex(vertex), *to)]
            }
            Anchor::Place { at, to, .. } => {
                vec![place(map, vertices, *at, *to).ok_or(EditError::Outside(anchor))?]
            }
            Anchor::Region(region) => {
                let chart = chart_at(map, region.center()).ok_or(EditError::Outside(anchor))?;
                inside(map, vertices, chart, region)
            }
            Anchor::Vertices {
                vertices: named,
                to,
                by,
                turn,
                ..
            } => {
                let is_named: HashSet<u32> = named.iter().copied().collect();
                let corners = mesh.triangles.as_flattened().iter().enumerate();
                let corners = corners.filter(|(_, v)| is_named.contains(v));
                let corners = corners.map(|(corner, _)| corner as u32);
                moved_together(map, vertices, corners, *to, *by, *turn)
            }
            Anchor::Selection {
                select,
                to,
                by,
                turn,
                ..
            } => {
                let corners = select.members().ok_or_else(|| {
                    let text = format!("{:?} needs a file to select from", select.text());
                    EditError::Malformed(text)
                })?;
                let corners = corners.iter().copied();
                moved_together(map, vertices, corners, *to, *by, *turn)
            }
            Anchor::Line(line) => {
                let chart = chart_at(map, line.line[0]).ok_or(EditError::Outside(anchor))?;
                let line = line.clone();
                vec![(Spot::Line { chart, line }, [0.0; 2])]
            }
        };
        if spots.is_empty() {
            return Err(EditError::EmptyRegion(anchor));
        }
        // Hold each spot once; exact anchors at one spot must agree on the target.
        let weight = which.weight().map(|weight| weight / spots.len() as f64);
        for (spot, to) in spots {
            let key = spot.key().filter(|_| weight.is_none());
            let new = Held {
                anchor,
                spot,
                to,
                weight,
            };
            let Some(key) = key else {
                held.push(new);
                continue;
            };
            match place_of.entry(key) {
                Entry::Vacant(entry) => {
                    entry.insert(held.len());
                    held.push(new);
                }
                Entry::Occupied(entry) => {
                    let other = &held[*entry.get()];
                    if other.to != to {
                        return Err(EditError::Contradictory(other.anchor, anchor));
                    }
                }
            }
        }
    }
    Ok(held)
}

/// Returns the vertices of a chart in a region, with their targets.
fn inside(
    map: &UvMap,
    vertices: &UvVertices,
    chart: u32,
    region: &Region,
) -> Vec<(Spot, [f64; 2])> {
    usable_vertices(map, vertices)
        .filter(|&(v, uv)| vertices.chart(map, v) == chart && region.contains(uv))
        .map(|(v, uv)| (Spot::Vertex(v), region.moved(uv)))
        .collect()
}

/// Returns the vertices at these corners, which move as a rigid body: the middle of their box `to` a place or `by` an
/// offset.
fn moved_together(
    map: &UvMap,
    vertices: &UvVertices,
    corners: impl Iterator<Item = u32>,
    to: Option<[f64; 2]>,
    by: Option<[f64; 2]>,
    turn: f64,
) -> Vec<(Spot, [f64; 2])> {
    let usable = corners.filter(|&corner| !map.unusable[corner as usize / 3]);
    let chosen: BTreeSet<u32> = usable
        .map(|corner| vertices.of_corner[corner as usize])
        .collect();
    let places: Vec<[f64; 2]> = chosen.iter().map(|&v| vertices.uv(map, v)).collect();
    let Ok(center) = <[f64; 2]>::try_from(middle(&places)) else {
        return Vec::new();
    };
    let motion = PlanarMotion {
        center,
        to: to.unwrap_or([0, 1].map(|k| center[k] + by.map_or(0.0, |by| by[k]))),
        turn,
    };
    let spots = chosen.into_iter().zip(places);
    spots
        .map(|(v, uv)| (Spot::Vertex(v), motion.moved(uv)))
        .collect()
}

/// Returns the only vertex of the UV map at a vertex of the mesh.
fn only_vertex(
    mesh: &UvMesh,
    map: &UvMap,
    vertices: &UvVertices,
    anchor: usize,
    vertex: u32,
) -> Result<u32, EditError> {
    let corners = mesh.triangles.as_flattened().iter().enumerate();
    let mut found = corners
        .filter(|&(corner, &v)| v == vertex && !map.unusable[corner / 3])
        .map(|(corner, _)| vertices.of_corner[corner]);
    let first = found.next().ok_or(EditError::UnknownHandle(anchor))?;
    if found.any(|other| other != first) {
        return Err(EditError::AmbiguousVertex(anchor));
    }
    Ok(first)
}

/// Returns the spot that is pulled at a UV, and its target: the point itself, or the nearest vertex if it lies slightly
/// outside a chart; `None` far from all charts.
fn place(
    map: &UvMap,
    vertices: &UvVertices,
    at: [f64; 2],
    to: [f64; 2],
) -> Option<(Spot, [f64; 2])> {
    if let Some(chart) = chart_at(map, at) {
        return Some((Spot::Place { chart, at }, to));
    }
    if distance_from_faces(map, at) > OUTSIDE {
        return None;
    }
    let (vertex, uv) = nearest_vertex(map, vertices, at)?;
    let to = [0, 1].map(|k| to[k] + (uv[k] - at[k]));
    Some((Spot::Vertex(vertex), to))
}

/// Returns the distance of a UV from the sides of the faces; infinite without faces.
fn distance_from_faces(map: &UvMap, at: [f64; 2]) -> f64 {
    let faces = (0..map.faces.len()).filter(|&face| !map.unusable[face]);
    let sides = faces.flat_map(|face| {
        let [a, b, c] = map.uvs[face];
        [[a, b], [b, c], [c, a]]
    });
    let distances = sides.map(|side| segment_distance(side, [at, at]));
    distances.fold(f64::INFINITY, f64::min)
}

/// Returns the vertex nearest to a UV and its own UV; the first of equally near ones.
fn nearest_vertex(map: &UvMap, vertices: &UvVertices, at: [f64; 2]) -> Option<(u32, [f64; 2])> {
    let distance = |uv: [f64; 2]| (uv[0] - at[0]).hypot(uv[1] - at[1]);
    usable_vertices(map, vertices).min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)))
}

/// Iterates over the vertices that have a finite UV, and those UVs.
fn usable_vertices<'a>(
    map: &'a UvMap,
    vertices: &'a UvVertices,
) -> impl Iterator<Item = (u32, [f64; 2])> + 'a {
    (0..vertices.first_corner.len() as u32)
        .filter(|&v| !map.unusable[vertices.first_corner[v as usize] as usize / 3])
        .map(|v| (v, vertices.uv(map, v)))
}

/// Returns the chart of the first face that contains a UV.
fn chart_at(map: &UvMap, at: [f64; 2]) -> Option<u32> {
    let holds = |face: &usize| {
        let [a, b, c] = map.uvs[*face];
        let orientation = map.orientation[*face];
        !map.unusable[*face]
            && orientation != 0
            && [(a, b), (b, c), (c, a)]
                .into_iter()
                .all(|(p, q)| orient2d_sign(p, q, at) * orientation >= 0)
    };
    let face = (0..map.faces.len()).find(holds)?;
    Some(map.chart[face])
}

// Charts as bodies, with the spots that anchors hold.

/// A chart as a body whose mean triangle has area 1.
pub(super) struct FlatChart {
    pub body: Body,
    /// UVs at the start, in the body's unit.
    pub start: Vec<[f64; 2]>,
    pub unit: f64,
}

/// The vertices and points of a chart that anchors hold.
pub(super) struct Grips {
    pub holds: Holds,
    /// Targets of the pulled vertices, in the caller's unit.
    targets: Vec<[f64; 2]>,
}

impl FlatChart {
    /// Creates the body of a chart; fails if it folds over an edge.
    pub fn new(chart: &UvChart, rest: UvRest) -> Result<Self, EditError> {
        PlanarMesh::new(chart.uvs.clone(), chart.triangles.clone())?;
        let (body, start, unit) = body(chart, rest);
        Ok(Self { body, start, unit })
    }

    /// Returns the vertices and points of the chart that these anchors hold.
    pub fn grips(
        &self,
        chart: &UvChart,
        held: &[Held],
        boundary: Boundary,
    ) -> Result<Grips, EditError> {
        let fixed = boundary.held(chart.uvs.len(), &chart.triangles);
        let mut grips = Grips {
            holds: Holds::new(fixed),
            targets: Vec::with_capacity(held.len()),
        };
        // Lines come last: they leave out what other anchors hold.
        for anchor in held {
            self.take_hold(&mut grips, chart, anchor)?;
        }
        for anchor in held {
            if let Spot::Line { line, .. } = &anchor.spot {
                self.take_hold_of_line(&mut grips, anchor, line)?;
            }
        }
        Ok(grips)
    }

    fn take_hold_of_line(
        &self,
        Grips { holds, targets }: &mut Grips,
        held: &Held,
        line: &Line,
    ) -> Result<(), EditError> {
        let is_taken = holds.taken(self.start.len());
        let scaled = |corners: &[[f64; 2]]| -> Vec<[f64; 2]> {
            corners.iter().map(|p| p.map(|x| x / self.unit)).collect()
        };
        let points = held_points(&self.body, &scaled(&line.line), &scaled(&line.to), |v| {
            is_taken[v as usize]
        });
        let points = points.ok_or(EditError::Outside(held.anchor))?;
        if points.is_empty() {
            return Err(EditError::EmptyRegion(held.anchor));
        }
        if held.weight.is_none() {
            let at_vertices = points.iter().filter(|(row, _)| sole_vertex(row).is_some());
            targets.extend(at_vertices.map(|(_, to)| to.map(|x| x * self.unit)));
        }
        holds.pull(held.anchor, points, held.weight);
        Ok(())
    }

    fn take_hold(
        &self,
        Grips { holds, targets }: &mut Grips,
        chart: &UvChart,
        &Held {
            anchor,
            ref spot,
            to,
            weight,
        }: &Held,
    ) -> Result<(), EditError> {
        let unknown = EditError::UnknownHandle(anchor);
        // Find what the spot holds in this chart.
        let (at, grip) = match *spot {
            Spot::Line { .. } => return Ok(()),
            Spot::Vertex(vertex) => {
                // The vertex of a face left out of its chart is not there.
                let local = chart.vertices.binary_search(&vertex);
                let local = local.map_err(|_| unknown)?;
                (chart.uvs[local], holds.grip(vec![(local as u32, 1.0)]))
            }
            Spot::Place { at, .. } => {
                let row = locate(&self.body, at.map(|x| x / self.unit)).ok_or(unknown)?;
                (at, holds.grip(row))
            }
        };
        // Pull it: a vertex beside the spot keeps its offset from it, a point needs none.
        match grip {
            Grip::Fixed if at == to => {}
            Grip::Fixed => return Err(EditError::OnBoundary(anchor)),
            Grip::Vertex(vertex) => {
                let place = chart.uvs[vertex as usize];
                let to = [0, 1].map(|k| to[k] + (place[k] - at[k]));
                let held = vec![(vec![(vertex, 1.0)], to.map(|x| x / self.unit))];
                holds.pull(anchor, held, weight);
                if weight.is_none() {
                    targets.push(to);
                }
            }
            Grip::Point(row) => {
                holds.pull(anchor, vec![(row, to.map(|x| x / self.unit))], weight);
            }
        }
        Ok(())
    }

    /// Returns the UVs of the chart's vertices with the body's at `vertices`. Vertices that did not move or that
    /// arrived are not rounded.
    pub fn uvs(&self, chart: &UvChart, grips: &Grips, vertices: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let uv = |v: usize| {
            if vertices[v] == self.start[v] {
                chart.uvs[v]
            } else {
                vertices[v].map(|x| x * self.unit)
            }
        };
        let mut uvs: Vec<[f64; 2]> = (0..vertices.len()).map(uv).collect();
        for (to, &(v, target)) in grips.targets.iter().zip(&grips.holds.pulled) {
            if vertices[v as usize] == target {
                uvs[v as usize] = *to;
            }
        }
        uvs
    }
}
