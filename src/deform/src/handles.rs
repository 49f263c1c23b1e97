//! Handles bound to the vertices and points of a body.

use super::body::{Body, BodyElements, locate, sole_vertex};
use super::handle::{Handle, middle};
use super::line::held_points;
use super::problem_error::ProblemError;
use super::region::surrounds;
use super::soft::{SoftPull, check_weight};
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

/// Handles bound to the vertices and points that they pull.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Stations of the handles, the last of them their targets.
    pub stations: Vec<Handles>,
    /// Vertices and points that each handle pulls.
    pub aims: Vec<Aim>,
    /// Turns of discs.
    pub turns: Vec<Turned>,
    /// Pull of the handles with weights.
    pub soft: SoftPull,
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
    /// Handle of each of these vertices.
    order: Vec<usize>,
    paths: Vec<TurningPath<D>>,
    points: Vec<Row>,
    point_paths: Vec<TurningPath<D>>,
    turns: Vec<Turned>,
    aims: Vec<Aim>,
    soft: SoftPull,
}

impl<'a, const D: usize> Binder<'a, D>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    fn new(body: &'a Body) -> Self {
        Self {
            body,
            vertices: Vec::new(),
            order: Vec::new(),
            paths: Vec::new(),
            points: Vec::new(),
            point_paths: Vec::new(),
            turns: Vec::new(),
            aims: Vec::new(),
            soft: SoftPull::default(),
        }
    }

    fn bind(mut self, handles: &[Handle]) -> Result<Bound, ProblemError> {
        self.aims = vec![Aim::default(); handles.len()];
        // Lines come last: they leave out what other handles hold.
        let is_line = |handle: &Handle| matches!(handle, Handle::Line { .. });
        let (lines, others): (Vec<_>, Vec<_>) = handles
            .iter()
            .enumerate()
            .partition(|(_, handle)| is_line(handle));
        for (index, handle) in others.into_iter().chain(lines) {
            let grips = self.grips(index, handle)?;
            match handle.weight() {
                Some(weight) => {
                    check_weight(weight)?;
                    let ends = grips.into_iter().map(|(row, path)| (row, path.at(1.0)));
                    self.soft.pull(&ends.collect::<Vec<_>>(), weight);
                }
                None => self.hold(index, grips),
            }
        }
        if self.vertices.is_empty() && self.points.is_empty() && self.soft.is_empty() {
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
            // Without exact handles there is no path: the map settles where soft ones pull it.
            stations: if last.vertices.is_empty() && last.points.is_empty() {
                Vec::new()
            } else {
                stations(last, &way_of, &self.paths, &self.point_paths, &self.turns)
            },
            turns: self.turns,
            aims: self.aims,
            soft: self.soft,
        })
    }

    /// Holds points exactly, those at vertices by these.
    fn hold(&mut self, index: usize, grips: Vec<Grip<D>>) {
        for (row, path) in grips {
            if let Some(vertex) = sole_vertex(&row) {
                self.aims[index].vertices.push(vertex);
                self.order.push(index);
                self.vertices.push(vertex);
                self.paths.push(path);
            } else {
                self.aims[index].points.push(self.points.len());
                self.points.push(row);
                self.point_paths.push(path);
            }
        }
    }

    /// Groups vertices that are connected, so that they move together. Handles that stay form a group of their own, so
    /// that no neighbor's motion moves them.
    fn groups(&self) -> Vec<u32> {
        let mut handle_moves = vec![false; self.aims.len()];
        for (i, &handle) in self.order.iter().enumerate() {
            handle_moves[handle] |= self.moves(i);
        }
        let is_moving: Vec<bool> = self.order.iter().map(|&h| handle_moves[h]).collect();
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

    /// Returns what a handle holds.
    fn grips(&mut self, index: usize, handle: &Handle) -> Result<Vec<Grip<D>>, ProblemError> {
        match handle {
            Handle::Vertex { vertex, to, .. } => {
                self.check_vertex(index, *vertex)?;
                let to = position(index, to)?;
                let path = TurningPath::straight(self.place(*vertex), to);
                Ok(vec![(vec![(*vertex, 1.0)], path)])
            }
            Handle::Disc { .. } | Handle::Box { .. } | Handle::Outline { .. } => {
                self.shape(index, handle)
            }
            Handle::Vertices {
                vertices,
                to,
                by,
                turn,
                axis,
                ..
            } => {
                let shift = Shift {
                    to: to.as_deref(),
                    by: by.as_deref(),
                    turn: *turn,
                    axis: *axis,
                };
                self.chosen(index, handle, vertices, &shift)
            }
            Handle::Selection {
                select,
                to,
                by,
                turn,
                axis,
                ..
            } => {
                let shift = Shift {
                    to: to.as_deref(),
                    by: by.as_deref(),
                    turn: *turn,
                    axis: *axis,
                };
                let members = select.members().ok_or_else(|| {
                    let text = format!("{:?} needs a file to select from", select.text());
                    ProblemError::MalformedHandles(text)
                })?;
                self.chosen(index, handle, members, &shift)
            }
            Handle::Line { line, to, .. } => self.line(index, line, to),
            Handle::Point { at, to, .. } => {
                let (at, to) = (position(index, at)?, position::<D>(index, to)?);
                let outside = ProblemError::HandleOutside { handle: index };
                let row = locate(self.body, at).ok_or(outside)?;
                // A point at a vertex pulls that vertex, which needs no soft constraint.
                let (row, from) = match sole_vertex(&row) {
                    Some(vertex) => (vec![(vertex, 1.0)], self.place(vertex)),
                    None => (row, at),
                };
                Ok(vec![(row, TurningPath::straight(from, to))])
            }
        }
    }

    /// Returns what a disc, a box or an outline holds; nothing for other handles.
    fn shape(&mut self, index: usize, handle: &Handle) -> Result<Vec<Grip<D>>, ProblemError> {
        match handle {
            Handle::Disc {
                center,
                radius,
                to,
                turn,
                axis,
                ..
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
                let motion = RigidMotion::new(center, position(index, to)?, *turn, *axis)?;
                self.region(index, handle, self.inside(is_inside), &motion)
            }
            Handle::Box {
                low,
                high,
                to,
                turn,
                axis,
                ..
            } => {
                let (low, high): ([f64; D], [f64; D]) =
                    (position(index, low)?, position(index, high)?);
                let is_inside =
                    |place: &[f64; D]| (0..D).all(|k| (low[k]..=high[k]).contains(&place[k]));
                let center = std::array::from_fn(|k| 0.5 * (low[k] + high[k]));
                let motion = RigidMotion::new(center, position(index, to)?, *turn, *axis)?;
                self.region(index, handle, self.inside(is_inside), &motion)
            }
            Handle::Outline {
                outline, to, turn, ..
            } => {
                let corners = outline.iter().map(|corner| position::<2>(index, corner));
                let corners: Vec<[f64; 2]> = corners.collect::<Result<_, _>>()?;
                if D != 2 || corners.len() < 3 {
                    let (name, range) = ("outline", "three points of the plane or more");
                    return Err(ProblemError::BadParameter { name, range });
                }
                let is_inside = |place: &[f64; D]| surrounds(&corners, [place[0], place[1]]);
                let center = position(index, &middle(&corners))?;
                let motion = RigidMotion::new(center, position(index, to)?, *turn, None)?;
                self.region(index, handle, self.inside(is_inside), &motion)
            }
            _ => Ok(Vec::new()),
        }
    }

    /// Returns what a line holds.
    fn line(
        &self,
        index: usize,
        line: &[Vec<f64>],
        to: &[Vec<f64>],
    ) -> Result<Vec<Grip<D>>, ProblemError> {
        let read = |places: &[Vec<f64>]| -> Result<Vec<[f64; D]>, ProblemError> {
            places.iter().map(|place| position(index, place)).collect()
        };
        let mut is_held = vec![false; self.body.n_vertices()];
        let of_points = self.points.iter().flatten().map(|(v, _)| v);
        for &v in self.vertices.iter().chain(of_points) {
            is_held[v as usize] = true;
        }
        let points = held_points(self.body, &read(line)?, &read(to)?, |v| is_held[v as usize]);
        let points = points.ok_or(ProblemError::HandleOutside { handle: index })?;
        let grips = points.into_iter().map(|(row, to)| {
            let path = TurningPath::straight(self.place_of(&row), to);
            (row, path)
        });
        Ok(grips.collect())
    }

    fn check_vertex(&self, handle: usize, vertex: u32) -> Result<(), ProblemError> {
        let n_vertices = self.body.n_vertices();
        if (vertex as usize) < n_vertices {
            return Ok(());
        }
        Err(ProblemError::UnknownHandle {
            handle,
            vertex,
            n_vertices,
        })
    }

    fn place(&self, vertex: u32) -> [f64; D] {
        std::array::from_fn(|k| self.body.rest[D * vertex as usize + k])
    }

    /// Returns the place of a point at rest.
    fn place_of(&self, row: &Row) -> [f64; D] {
        std::array::from_fn(|k| {
            let along = row.iter().map(|&(v, weight)| weight * self.place(v)[k]);
            along.sum()
        })
    }

    /// Returns the vertices inside a region.
    fn inside(&self, is_inside: impl Fn(&[f64; D]) -> bool) -> Vec<u32> {
        let all = 0..self.body.n_vertices() as u32;
        all.filter(|&v| is_inside(&self.place(v))).collect()
    }

    /// Returns the vertices of a list, which move as a rigid body.
    fn chosen(
        &mut self,
        index: usize,
        handle: &Handle,
        vertices: &[u32],
        shift: &Shift,
    ) -> Result<Vec<Grip<D>>, ProblemError> {
        for &vertex in vertices {
            self.check_vertex(index, vertex)?;
        }
        let mut vertices = vertices.to_vec();
        vertices.sort_unstable();
        vertices.dedup();
        if vertices.is_empty() {
            return Err(ProblemError::HandleOutside { handle: index });
        }
        let places: Vec<[f64; D]> = vertices.iter().map(|&v| self.place(v)).collect();
        let center: [f64; D] = position(index, &middle(&places))?;
        let to = match (shift.to, shift.by) {
            (Some(to), None) => position(index, to)?,
            (None, Some(by)) => {
                let by: [f64; D] = position(index, by)?;
                std::array::from_fn(|k| center[k] + by[k])
            }
            (None, None) => center,
            (Some(_), Some(_)) => {
                let (name, range) = ("to", "absent if `by` is given");
                return Err(ProblemError::BadParameter { name, range });
            }
        };
        let motion = RigidMotion::new(center, to, shift.turn, shift.axis)?;
        self.region(index, handle, vertices, &motion)
    }

    /// Returns the vertices of a region with their paths.
    fn region(
        &mut self,
        index: usize,
        handle: &Handle,
        vertices: Vec<u32>,
        motion: &RigidMotion<D>,
    ) -> Result<Vec<Grip<D>>, ProblemError> {
        if vertices.is_empty() {
            return Err(ProblemError::HandleOutside { handle: index });
        }
        let spin = Matrix::<D>::about(motion.axis, motion.degrees.to_radians());
        let grips = vertices.iter().map(|&v| {
            let place = self.place(v);
            let path = TurningPath {
                from: motion.center,
                to: motion.to,
                arm: std::array::from_fn(|k| place[k] - motion.center[k]),
                spin,
            };
            (vec![(v, 1.0)], path)
        });
        let grips = grips.collect();
        // Keep the turn, for the stations and for the count of turns left.
        match handle.weight() {
            Some(_) if motion.degrees.abs() > HALF_TURN => {
                let (name, range) = ("turn", "at most 180 degrees for a handle with a weight");
                return Err(ProblemError::BadParameter { name, range });
            }
            None if motion.degrees != 0.0 => self.turns.push(Turned {
                handle: index,
                vertices,
                axis: motion.axis,
                degrees: motion.degrees,
            }),
            _ => {}
        }
        Ok(grips)
    }
}

/// A point that a handle holds, one vertex or the corners of an element with their weights, and its path.
type Grip<const D: usize> = (Row, TurningPath<D>);

/// Where listed vertices go.
struct Shift<'a> {
    /// Place for the middle of their bounding box.
    to: Option<&'a [f64]>,
    /// Offset, in place of `to`.
    by: Option<&'a [f64]>,
    /// Degrees.
    turn: f64,
    axis: Option<[f64; 3]>,
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

impl<const D: usize> RigidMotion<D> {
    fn new(
        center: [f64; D],
        to: [f64; D],
        turn: f64,
        axis: Option<[f64; 3]>,
    ) -> Result<Self, ProblemError> {
        Ok(Self {
            center,
            to,
            degrees: turn,
            axis: turning_axis::<D>(turn, axis)?,
        })
    }
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
