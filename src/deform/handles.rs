//! Handles as a user names them.

use serde::{Deserialize, Serialize};

use super::aims::Aim;
use super::body::{Body, BodyElements};
use super::locate::{locate, sole_vertex};
use super::numbers;
use super::paired::{handles as paired, with_points};
use super::problem_error::ProblemError;
use crate::energy::Row;
use crate::numerics::square::{Matrix, Square};
use crate::solver::Handles;

/// What rounding leaves of the distance between equal coordinates, as a share of them.
const ROUNDING: f64 = 1e-12;

/// One handle; positions have as many coordinates as the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum Handle {
    /// A vertex.
    Vertex {
        /// Its index, from 0.
        vertex: u32,
        /// Where it goes.
        #[serde(deserialize_with = "numbers::position")]
        to: Vec<f64>,
    },
    /// Every vertex in a ball around a point, moved as a rigid body.
    Disc {
        /// The center at rest.
        #[serde(deserialize_with = "numbers::position")]
        center: Vec<f64>,
        /// The radius.
        radius: f64,
        /// Where the center goes.
        #[serde(deserialize_with = "numbers::position")]
        to: Vec<f64>,
        /// A turn about the center in degrees, counter-clockwise; in the plane only.
        #[serde(default)]
        turn: f64,
    },
    /// A point of an element at rest, a vertex if it is one.
    Point {
        /// The point.
        #[serde(deserialize_with = "numbers::position")]
        at: Vec<f64>,
        /// Where it goes.
        #[serde(deserialize_with = "numbers::position")]
        to: Vec<f64>,
    },
}

/// Reads `{"handles": [{"vertex": i, "to": […]}, {"at": […], "to": …}, {"center": …, "radius": r, "to": …, "turn": d}, …]}`.
#[cfg(feature = "files")]
pub fn parse_body_handles(json: &[u8]) -> Result<Vec<Handle>, ProblemError> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct File {
        handles: Vec<Handle>,
    }
    let file: File = numbers::from_json(json)
        .map_err(|error| ProblemError::MalformedHandles(error.to_string()))?;
    Ok(file.handles)
}

/// Handles that have found what they pull.
#[derive(Clone, Debug)]
pub struct Bound {
    /// Their stations, the last of them their targets.
    pub stations: Vec<Handles>,
    /// What each takes hold of.
    pub aims: Vec<Aim>,
}

/// Finds the vertices and elements of a body that handles name.
///
/// A vertex may be named twice if both say the same. Errors name the handle by its place in the list, from 0.
pub fn bind(body: &Body, handles: &[Handle]) -> Result<Bound, ProblemError> {
    match body.elements {
        BodyElements::Triangles { .. } => Binder::<2>::new(body).bind(handles),
        BodyElements::Tetrahedra { .. } => Binder::<3>::new(body).bind(handles),
    }
}

struct Binder<'a, const D: usize> {
    body: &'a Body,
    vertices: Vec<u32>,
    targets: Vec<Vec<f64>>,
    points: Vec<Row>,
    point_targets: Vec<f64>,
    aims: Vec<Aim>,
}

impl<'a, const D: usize> Binder<'a, D>
where
    Matrix<D>: Square<D>,
{
    fn new(body: &'a Body) -> Self {
        Self {
            body,
            vertices: Vec::new(),
            targets: Vec::new(),
            points: Vec::new(),
            point_targets: Vec::new(),
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
        let bound = paired(D, &self.vertices, &self.targets, &groups)?;
        let targets = with_points(bound, self.points, self.point_targets)?;
        Ok(Bound {
            stations: vec![targets],
            aims: self.aims,
        })
    }

    /// Vertices that are connected travel together, but for handles that stay: they are a group of their own, so that no
    /// neighbor's travel moves them on the way.
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

    /// Is a target elsewhere than its vertex, but for rounding?
    fn moves(&self, i: usize) -> bool {
        let rest = &self.body.rest[D * self.vertices[i] as usize..];
        let mut pairs = rest.iter().zip(&self.targets[i]);
        pairs.any(|(x, to)| (x - to).abs() > ROUNDING * x.abs().max(to.abs()))
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
                self.vertices.push(*vertex);
                self.targets.push(position::<D>(index, to)?.to_vec());
            }
            Handle::Disc {
                center,
                radius,
                to,
                turn,
            } => {
                let (center, to) = (position(index, center)?, position(index, to)?);
                self.add_disc(index, center, *radius, to, *turn)?;
            }
            Handle::Point { at, to } => {
                let (at, to) = (position(index, at)?, position::<D>(index, to)?);
                let outside = ProblemError::HandleOutside { handle: index };
                let row = locate(self.body, at).ok_or(outside)?;
                if let Some(vertex) = sole_vertex(&row) {
                    self.vertices.push(vertex);
                    self.targets.push(to.to_vec());
                } else {
                    self.points.push(row);
                    self.point_targets.extend(to);
                }
            }
        }
        Ok(())
    }

    fn add_disc(
        &mut self,
        index: usize,
        center: [f64; D],
        radius: f64,
        to: [f64; D],
        turn: f64,
    ) -> Result<(), ProblemError> {
        if !(radius >= 0.0 && radius.is_finite() && turn.is_finite()) || D == 3 && turn != 0.0 {
            return Err(ProblemError::BadParameter {
                name: "radius and turn",
                range: "finite, the radius not negative, a turn in the plane only",
            });
        }
        let (sin, cos) = turn.to_radians().sin_cos();
        let before = self.vertices.len();
        for v in 0..self.body.n_vertices() {
            let arm: [f64; D] = std::array::from_fn(|k| self.body.rest[D * v + k] - center[k]);
            if arm.iter().map(|x| x * x).sum::<f64>() > radius * radius {
                continue;
            }
            let mut place: [f64; D] = std::array::from_fn(|k| to[k] + arm[k]);
            if turn != 0.0 {
                place[0] = to[0] + cos * arm[0] - sin * arm[1];
                place[1] = to[1] + sin * arm[0] + cos * arm[1];
            }
            self.vertices.push(v as u32);
            self.targets.push(place.to_vec());
        }
        if self.vertices.len() == before {
            return Err(ProblemError::HandleOutside { handle: index });
        }
        Ok(())
    }
}

fn position<const D: usize>(handle: usize, numbers: &[f64]) -> Result<[f64; D], ProblemError> {
    let position: Option<[f64; D]> = numbers.try_into().ok();
    position
        .filter(|p| p.iter().all(|x| x.is_finite()))
        .ok_or(ProblemError::BadTarget { handle, dim: D })
}
