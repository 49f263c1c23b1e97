//! Handles in the form in which users name them.

use super::body::{Body, BodyElements, locate, sole_vertex};
use super::problem_error::ProblemError;
use serde::{Deserialize, Deserializer, Serialize};
use std::cmp::Ordering;
use std::collections::HashMap;
use unwrapd_method::energy::Row;
use unwrapd_method::numerics::rotation::Rotation;
use unwrapd_method::numerics::square::{Matrix, Square, apply};
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::Handles;

/// Rounding error of the distance between equal coordinates, as a share of them.
const ROUNDING: f64 = 1e-12;

/// Largest turn of a disc in degrees: a hundred turns, in 2400 stations.
const MOST_DEGREES: f64 = 36_000.0;

/// One handle. Positions have the same number of coordinates as the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum Handle {
    /// A vertex.
    Vertex {
        /// Its index, from 0.
        vertex: u32,
        /// Where it goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
    },
    /// Every vertex in a ball around a point, moved as a rigid body.
    Disc {
        /// The center at rest.
        #[serde(deserialize_with = "place")]
        center: Vec<f64>,
        /// The radius.
        radius: f64,
        /// Where the center goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
        /// A turn about the center in degrees, counter-clockwise, of a hundred turns (36000) at
        /// most. Half a turn and more is made in steps of 15 degrees.
        #[serde(default)]
        turn: f64,
        /// In space: the direction to turn about, as seen by whom it points at.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        axis: Option<[f64; 3]>,
    },
    /// Every vertex in a box along the axes, moved as a rigid body.
    Box {
        /// The corner of the least coordinates at rest.
        #[serde(deserialize_with = "place")]
        low: Vec<f64>,
        /// The corner of the largest coordinates at rest.
        #[serde(deserialize_with = "place")]
        high: Vec<f64>,
        /// Where the middle goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// In space: the direction to turn about, as that of a disc.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        axis: Option<[f64; 3]>,
    },
    /// A point of an element at rest, a vertex if it is one.
    Point {
        /// The point.
        #[serde(deserialize_with = "place")]
        at: Vec<f64>,
        /// Where it goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
    },
}

/// Parses `{"handles": [{"vertex": i, "to": […]}, {"at": […], "to": …}, {"center": …, "radius": r, "to": …, "turn": d,
/// "axis": […]}, {"low": …, "high": …, "to": …}, …]}`.
pub fn parse_body_handles(json: &[u8]) -> Result<Vec<Handle>, ProblemError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct HandlesFile {
        handles: Vec<Handle>,
    }
    let file: HandlesFile = unwrapd_api::from_json(json)
        .map_err(|error| ProblemError::MalformedHandles(error.to_string()))?;
    Ok(file.handles)
}

/// Handles bound to the vertices and points that they pull.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Stations of the handles, the last of them their targets.
    pub stations: Vec<Handles>,
    /// Vertices and points that each handle pulls.
    pub aims: Vec<Aim>,
    /// Turns of discs.
    pub turns: Vec<Turned>,
}

/// Finds the vertices and elements of a body that handles name, and the stations along their paths. A disc that makes
/// half a turn or more gets several stations, because the shortest path to its target would turn less.
///
/// A vertex may be named twice with the same target. Errors name the handle by its index in the list, from 0.
pub fn bind(body: &Body, handles: &[Handle]) -> Result<Bound, ProblemError> {
    match body.elements {
        BodyElements::Triangles { .. } => Binder::<2>::new(body).bind(handles),
        BodyElements::Tetrahedra { .. } => Binder::<3>::new(body).bind(handles),
    }
}

struct Binder<'a, const D: usize> {
    body: &'a Body,
    vertices: Vec<u32>,
    paths: Vec<TurningPath<D>>,
    points: Vec<Row>,
    point_paths: Vec<TurningPath<D>>,
    turns: Vec<Turned>,
    aims: Vec<Aim>,
}

impl<'a, const D: usize> Binder<'a, D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    fn new(body: &'a Body) -> Self {
        Self {
            body,
            vertices: Vec::new(),
            paths: Vec::new(),
            points: Vec::new(),
            point_paths: Vec::new(),
            turns: Vec::new(),
            aims: Vec::new(),
        }
    }

    fn bind(mut self, handles: &[Handle]) -> Result<Bound, ProblemError> {
        for (index, handle) in handles.iter().enumerate() {
            let (vertices, points) = (self.vertices.len(), self.points.len());
            self.add(index, handle)?;
            self.aims.push(Aim {
                vertices: self.vertices[vertices..].to_vec(),
                points: (points..self.points.len()).collect(),
            });
        }
        if self.vertices.is_empty() && self.points.is_empty() {
            return Err(ProblemError::NoHandle);
        }
        let groups = self.groups();
        let targets: Vec<Vec<f64>> = self
            .paths
            .iter()
            .map(|path| path.at(1.0).to_vec())
            .collect();
        let bound = paired_handles(D, &self.vertices, &targets, &groups)?;
        let point_targets = self.point_paths.iter().flat_map(|path| path.at(1.0));
        let last = with_points(bound, self.points, point_targets.collect())?;
        let way_of: HashMap<u32, usize> = self.vertices.iter().copied().zip(0..).collect();
        let way_of = |vertex| way_of[&vertex];
        Ok(Bound {
            stations: stations(last, &way_of, &self.paths, &self.point_paths, &self.turns),
            turns: self.turns,
            aims: self.aims,
        })
    }

    /// Groups vertices that are connected, so that they move together. Handles that stay form a group of their own, so
    /// that no neighbor's motion moves them.
    fn groups(&self) -> Vec<u32> {
        let mut is_moving = vec![false; self.vertices.len()];
        let mut first = 0;
        for aim in &self.aims {
            let of_aim = first..first + aim.vertices.len();
            first = of_aim.end;
            let moves = of_aim.clone().any(|i| self.moves(i));
            is_moving[of_aim].fill(moves);
        }
        let chosen = self.vertices.iter().zip(&is_moving);
        let moving: Vec<u32> = chosen
            .filter(|(_, moves)| **moves)
            .map(|(v, _)| *v)
            .collect();
        let staying = moving.len() as u32;
        let mut groups = self.body.groups(&moving).into_iter();
        let group = |moves: bool| if moves { groups.next() } else { None };
        let groups = is_moving.into_iter().map(group);
        groups.map(|group| group.unwrap_or(staying)).collect()
    }

    /// Returns whether a vertex turns, or its target differs from its rest position by more than rounding.
    fn moves(&self, i: usize) -> bool {
        let rest = &self.body.rest[D * self.vertices[i] as usize..];
        let path = &self.paths[i];
        path.spin != [[0.0; D]; D]
            || rest
                .iter()
                .zip(path.at(1.0))
                .any(|(x, to): (&f64, f64)| (x - to).abs() > ROUNDING * x.abs().max(to.abs()))
    }

    fn add(&mut self, index: usize, handle: &Handle) -> Result<(), ProblemError> {
        match handle {
            Handle::Vertex { vertex, to } => {
                if *vertex as usize >= self.body.n_vertices() {
                    return Err(ProblemError::UnknownHandle {
                        handle: index,
                        vertex: *vertex,
                        n_vertices: self.body.n_vertices(),
                    });
                }
                self.add_vertex(*vertex, position(index, to)?);
            }
            Handle::Disc {
                center,
                radius,
                to,
                turn,
                axis,
            } => {
                if !(*radius >= 0.0 && radius.is_finite()) {
                    let (name, range) = ("radius", "finite and not negative");
                    return Err(ProblemError::BadParameter { name, range });
                }
                let center: [f64; D] = position(index, center)?;
                let is_inside = |place: &[f64; D]| {
                    let squares = place.iter().zip(center).map(|(x, c)| (x - c) * (x - c));
                    squares.sum::<f64>() <= radius * radius
                };
                let motion = RigidMotion {
                    center,
                    to: position(index, to)?,
                    degrees: *turn,
                    axis: turning_axis::<D>(*turn, *axis)?,
                };
                self.add_region(index, is_inside, &motion)?;
            }
            Handle::Box {
                low,
                high,
                to,
                turn,
                axis,
            } => {
                let (low, high): ([f64; D], [f64; D]) =
                    (position(index, low)?, position(index, high)?);
                let is_inside =
                    |place: &[f64; D]| (0..D).all(|k| (low[k]..=high[k]).contains(&place[k]));
                let motion = RigidMotion {
                    center: std::array::from_fn(|k| 0.5 * (low[k] + high[k])),
                    to: position(index, to)?,
                    degrees: *turn,
                    axis: turning_axis::<D>(*turn, *axis)?,
                };
                self.add_region(index, is_inside, &motion)?;
            }
            Handle::Point { at, to } => {
                let (at, to) = (position(index, at)?, position::<D>(index, to)?);
                let outside = ProblemError::HandleOutside { handle: index };
                let row = locate(self.body, at).ok_or(outside)?;
                // A point at a vertex pulls that vertex, which needs no soft constraint.
                if let Some(vertex) = sole_vertex(&row) {
                    self.add_vertex(vertex, to);
                } else {
                    self.points.push(row);
                    self.point_paths.push(TurningPath::straight(at, to));
                }
            }
        }
        Ok(())
    }

    fn place(&self, vertex: u32) -> [f64; D] {
        std::array::from_fn(|k| self.body.rest[D * vertex as usize + k])
    }

    fn add_vertex(&mut self, vertex: u32, to: [f64; D]) {
        self.vertices.push(vertex);
        self.paths
            .push(TurningPath::straight(self.place(vertex), to));
    }

    /// Holds every vertex inside a region.
    fn add_region(
        &mut self,
        index: usize,
        is_inside: impl Fn(&[f64; D]) -> bool,
        motion: &RigidMotion<D>,
    ) -> Result<(), ProblemError> {
        let before = self.vertices.len();
        for v in 0..self.body.n_vertices() as u32 {
            let place = self.place(v);
            if is_inside(&place) {
                self.vertices.push(v);
                self.paths.push(TurningPath {
                    from: motion.center,
                    to: motion.to,
                    arm: std::array::from_fn(|k| place[k] - motion.center[k]),
                    spin: Matrix::<D>::about(motion.axis, motion.degrees.to_radians()),
                });
            }
        }
        if self.vertices.len() == before {
            return Err(ProblemError::HandleOutside { handle: index });
        }
        // Keep the turn, for the stations and for the count of turns left.
        if motion.degrees != 0.0 {
            self.turns.push(Turned {
                handle: index,
                vertices: self.vertices[before..].to_vec(),
                axis: motion.axis,
                degrees: motion.degrees,
            });
        }
        Ok(())
    }
}

/// Where the center of a region goes, and the turn about it.
struct RigidMotion<const D: usize> {
    center: [f64; D],
    to: [f64; D],
    /// Counter-clockwise, seen against the axis.
    degrees: f64,
    /// Unit vector; zero in the plane.
    axis: [f64; 3],
}

/// Returns the unit vector to turn about; zero in the plane, where no axis may be given.
fn turning_axis<const D: usize>(
    turn: f64,
    axis: Option<[f64; 3]>,
) -> Result<[f64; 3], ProblemError> {
    let unit = axis.map_or([0.0; 3], vec3::unit);
    let has_axis = unit.iter().all(|x| x.is_finite()) && unit != [0.0; 3];
    let is_turn = turn.abs() <= MOST_DEGREES;
    match (D, axis.is_some()) {
        (2, false) if is_turn => Ok(unit),
        (3, true) if is_turn && has_axis => Ok(unit),
        (3, false) if turn == 0.0 => Ok(unit),
        _ => Err(ProblemError::BadParameter {
            name: "turn and axis",
            range: "at most 36000 degrees, and in space, but not in the plane, the axis a direction",
        }),
    }
}

fn position<const D: usize>(handle: usize, numbers: &[f64]) -> Result<[f64; D], ProblemError> {
    let position: Option<[f64; D]> = numbers.try_into().ok();
    position
        .filter(|p| p.iter().all(|x| x.is_finite()))
        .ok_or(ProblemError::BadTarget { handle, dim: D })
}

// Handles paired with their targets.

/// Pairs vertices with their targets, each vertex once.
pub(super) fn paired_handles(
    dim: usize,
    vertices: &[u32],
    targets: &[Vec<f64>],
    groups: &[u32],
) -> Result<Handles, ProblemError> {
    if vertices.len() != targets.len() {
        return Err(ProblemError::Unpaired {
            handles: vertices.len(),
            targets: targets.len(),
        });
    }
    if let Some(handle) = targets
        .iter()
        .position(|t: &Vec<f64>| t.len() != dim || !t.iter().all(|x| x.is_finite()))
    {
        return Err(ProblemError::BadTarget { handle, dim });
    }
    // Sort by vertex, and keep each vertex once. Its targets must be equal.
    let mut order: Vec<usize> = (0..vertices.len()).collect();
    order.sort_by_key(|&i| vertices[i]);
    if let Some(pair) = order
        .windows(2)
        .find(|w: &&[usize]| vertices[w[0]] == vertices[w[1]] && targets[w[0]] != targets[w[1]])
    {
        let vertex = vertices[pair[0]];
        return Err(ProblemError::ContradictoryHandles { vertex });
    }
    order.dedup_by_key(|i| vertices[*i]);
    Ok(Handles {
        vertices: order.iter().map(|&i| vertices[i]).collect(),
        targets: order.iter().flat_map(|&i| targets[i].clone()).collect(),
        groups: order.iter().map(|&i| groups[i]).collect(),
        ..Handles::default()
    })
}

/// Adds points inside elements to handles; all targets of one point must be equal.
pub(super) fn with_points(
    handles: Handles,
    points: Vec<Row>,
    point_targets: Vec<f64>,
) -> Result<Handles, ProblemError> {
    let dim = point_targets.len() / points.len().max(1);
    let target = |i: usize| &point_targets[dim * i..dim * (i + 1)];
    let mut order: Vec<usize> = (0..points.len()).collect();
    // Weights are finite.
    order.sort_by(|&i, &j| points[i].partial_cmp(&points[j]).unwrap_or(Ordering::Equal));
    if order
        .windows(2)
        .any(|w: &[usize]| points[w[0]] == points[w[1]] && target(w[0]) != target(w[1]))
    {
        return Err(ProblemError::ContradictoryPoints);
    }
    Ok(Handles {
        points,
        point_targets,
        ..handles
    })
}

// The vertices and points that each handle pulls.

/// The vertices and points that one handle pulls.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Aim {
    /// Indices of the vertices.
    pub vertices: Vec<u32>,
    /// Points, as indices into [`Handles::points`](unwrapd_method::solver::Handles::points).
    pub points: Vec<usize>,
}

impl Aim {
    /// Pulls one vertex.
    pub(super) fn at_vertex(vertex: u32) -> Self {
        Self {
            vertices: vec![vertex],
            points: Vec::new(),
        }
    }

    /// Pulls one point.
    pub(super) fn at_point(point: usize) -> Self {
        Self {
            vertices: Vec::new(),
            points: vec![point],
        }
    }
}

// Paths of handles from rest to their targets.

/// Turn, in degrees, from which the path is no longer the shortest one and must be prescribed.
const HALF_TURN: f64 = 180.0;

/// Largest turn between two stations, in degrees. Each station is settled before the next; twisted bars keep their
/// turns at 15 degrees, by measurement, with three or four factorizations per station.
const BETWEEN_STATIONS: f64 = 15.0;

/// Turn of a disc of vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct Turned {
    /// Index of its handle in the user's list.
    pub handle: usize,
    /// Vertices of the disc.
    pub vertices: Vec<u32>,
    /// Unit vector of the axis; ignored in the plane.
    pub axis: [f64; 3],
    /// Degrees, counter-clockwise seen against the axis.
    pub degrees: f64,
}

/// Path of a vertex or a point: an arm that turns at constant speed about a center that moves straight.
pub(super) struct TurningPath<const D: usize> {
    pub from: [f64; D],
    pub to: [f64; D],
    pub arm: [f64; D],
    /// Logarithm of the turn.
    pub spin: Matrix<D>,
}

impl<const D: usize> TurningPath<D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    pub fn straight(from: [f64; D], to: [f64; D]) -> Self {
        Self {
            from,
            to,
            arm: [0.0; D],
            spin: [[0.0; D]; D],
        }
    }

    /// Returns the position after this share of the path.
    pub fn at(&self, share: f64) -> [f64; D] {
        let arm = apply(&Matrix::<D>::exp(&self.spin, share), &self.arm);
        std::array::from_fn(|k| (1.0 - share) * self.from[k] + share * self.to[k] + arm[k])
    }
}

/// Returns the stations of handles along their paths; the last has the targets at the ends. Only turns of half a turn
/// or more need more than the last one.
pub(super) fn stations<const D: usize>(
    last: Handles,
    of_vertex: &dyn Fn(u32) -> usize,
    paths: &[TurningPath<D>],
    point_paths: &[TurningPath<D>],
    turns: &[Turned],
) -> Vec<Handles>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    // The shortest paths make turns of less than half a turn by themselves.
    let largest = turns.iter().map(|turned| turned.degrees.abs());
    let largest = largest.fold(0.0, f64::max);
    if largest < HALF_TURN {
        return vec![last];
    }
    // Add stations in equal steps of the turn.
    let n_stations = (largest / BETWEEN_STATIONS).ceil();
    let between = (1..n_stations as usize).map(|k| {
        let share = k as f64 / n_stations;
        let places = last.vertices.iter().map(|&v| paths[of_vertex(v)].at(share));
        let points = point_paths.iter().map(|path| path.at(share));
        Handles {
            targets: places.flatten().collect(),
            point_targets: points.flatten().collect(),
            ..last.clone()
        }
    });
    let mut stations: Vec<Handles> = between.collect();
    stations.push(last);
    stations
}

// Coordinates in JSON.

/// Deserializes a position with any number of coordinates.
pub(super) fn place<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(or_nan).collect())
}

/// Deserializes a position in the plane.
pub(super) fn planar<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Option<f64>; 2]>::deserialize(from).map(|numbers| numbers.map(or_nan))
}

/// Deserializes a list of positions.
pub(super) fn positions<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let positions = Vec::<Vec<Option<f64>>>::deserialize(from)?;
    Ok(positions
        .into_iter()
        .map(|numbers: Vec<Option<f64>>| numbers.into_iter().map(or_nan).collect())
        .collect())
}

fn or_nan(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}
