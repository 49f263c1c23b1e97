//! Handles as users write them.

use super::problem_error::ProblemError;
use serde::{Deserialize, Deserializer, Serialize};

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
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
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
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
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
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// Every vertex inside a polygon of the plane, moved as a rigid body.
    Outline {
        /// The corners of the polygon at rest, at least three, in order.
        #[serde(deserialize_with = "places")]
        outline: Vec<Vec<f64>>,
        /// Where the middle of the polygon's bounding box goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
        /// A turn about that middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A list of vertices, moved as a rigid body.
    Vertices {
        /// Their indices, from 0.
        vertices: Vec<u32>,
        /// Where the middle of their bounding box goes; without it and `by`, they stay.
        #[serde(
            default,
            deserialize_with = "optional_place",
            skip_serializing_if = "Option::is_none"
        )]
        to: Option<Vec<f64>>,
        /// The offset by which they move, in place of `to`.
        #[serde(
            default,
            deserialize_with = "optional_place",
            skip_serializing_if = "Option::is_none"
        )]
        by: Option<Vec<f64>>,
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// In space: the direction to turn about, as that of a disc.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        axis: Option<[f64; 3]>,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// The vertices that a selector names, moved as a rigid body.
    Selection {
        /// The selector.
        #[cfg_attr(feature = "schema", schema(value_type = String))]
        select: Select,
        /// Where the middle of their bounding box goes; without it and `by`, they stay.
        #[serde(
            default,
            deserialize_with = "optional_place",
            skip_serializing_if = "Option::is_none"
        )]
        to: Option<Vec<f64>>,
        /// The offset by which they move, in place of `to`.
        #[serde(
            default,
            deserialize_with = "optional_place",
            skip_serializing_if = "Option::is_none"
        )]
        by: Option<Vec<f64>>,
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// In space: the direction to turn about, as that of a disc.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        axis: Option<[f64; 3]>,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A line from corner to corner, held at one point in every other element that it crosses.
    Line {
        /// The corners of the line at rest, at least two.
        #[serde(deserialize_with = "places")]
        line: Vec<Vec<f64>>,
        /// The corners of the line that it becomes, any number of them: points keep their share of
        /// the length.
        #[serde(deserialize_with = "places")]
        to: Vec<Vec<f64>>,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A point of an element at rest, a vertex if it is one.
    Point {
        /// The point.
        #[serde(deserialize_with = "place")]
        at: Vec<f64>,
        /// Where it goes.
        #[serde(deserialize_with = "place")]
        to: Vec<f64>,
        /// Strength of a soft handle, greater than 0; without it the handle comes to its target
        /// exactly. The energy grows by `weight` times the mean squared distance of what the handle
        /// holds from its targets, so it comes as near as the shapes around it are worth.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
}

impl Handle {
    /// Returns the strength of a soft handle.
    pub(super) fn weight(&self) -> Option<f64> {
        match self {
            Self::Vertex { weight, .. }
            | Self::Disc { weight, .. }
            | Self::Box { weight, .. }
            | Self::Outline { weight, .. }
            | Self::Vertices { weight, .. }
            | Self::Selection { weight, .. }
            | Self::Line { weight, .. }
            | Self::Point { weight, .. } => *weight,
        }
    }

    /// Changes where the middle goes. A line keeps its shape.
    pub(super) fn retarget(&mut self, target: &[f64]) {
        match self {
            Self::Vertex { to, .. }
            | Self::Disc { to, .. }
            | Self::Box { to, .. }
            | Self::Outline { to, .. }
            | Self::Point { to, .. } => *to = target.to_vec(),
            Self::Vertices { to, by, .. } | Self::Selection { to, by, .. } => {
                (*to, *by) = (Some(target.to_vec()), None);
            }
            Self::Line { to, .. } => {
                let middle = middle(to);
                for place in to {
                    for ((x, middle), target) in place.iter_mut().zip(&middle).zip(target) {
                        *x += target - middle;
                    }
                }
            }
        }
    }

    /// Returns the selector of the handle, if it has one, so that its members can be filled in.
    pub fn select_mut(&mut self) -> Option<&mut Select> {
        match self {
            Self::Selection { select, .. } => Some(select),
            _ => None,
        }
    }

    /// Returns whether the handle names vertices by their numbers.
    pub fn names_vertices(&self) -> bool {
        matches!(self, Self::Vertex { .. } | Self::Vertices { .. })
    }
}

/// Returns the middle of the bounding box of places with an equal number of coordinates; empty without places.
pub(super) fn middle<P: AsRef<[f64]>>(places: &[P]) -> Vec<f64> {
    let dim = places.first().map_or(0, |place| place.as_ref().len());
    let along = |k: usize| {
        let all = places.iter().filter_map(move |p| p.as_ref().get(k));
        let (low, high) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
            (low.min(x), high.max(x))
        });
        0.5 * (low + high)
    };
    (0..dim).map(along).collect()
}

/// Parses `{"handles": [{"vertex": i, "to": […]}, {"at": […], "to": …}, {"center": …, "radius": r, "to": …, "turn": d,
/// "axis": […]}, {"low": …, "high": …, "to": …}, {"line": […], "to": […]}, {"select": "material=…", "by": …}, …]}`.
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

// Vertices that a selector names.

/// A selector, as `material=Glass`, and what it selects in a file once that is known.
///
/// This crate knows no materials and colors: the reader of the file [fills in](Self::fill) the members.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "String", into = "String")]
pub struct Select {
    text: String,
    members: Option<Vec<u32>>,
}

impl Select {
    /// Returns the selector as the user wrote it.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Sets what it selects: vertices of a body, or corners `3 * face + c` of a UV map.
    pub fn fill(&mut self, members: Vec<u32>) {
        self.members = Some(members);
    }

    /// Returns what it selects, if that is known.
    pub(super) fn members(&self) -> Option<&[u32]> {
        self.members.as_deref()
    }
}

impl From<String> for Select {
    fn from(text: String) -> Self {
        Self {
            text,
            members: None,
        }
    }
}

impl From<Select> for String {
    fn from(select: Select) -> Self {
        select.text
    }
}

// Coordinates in JSON. What is not a number there is NaN, so that errors can name the handle.

/// Deserializes a position with any number of coordinates.
pub(super) fn place<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let numbers = Vec::<Option<f64>>::deserialize(from)?;
    Ok(numbers.into_iter().map(or_nan).collect())
}

/// Deserializes a position that may be absent.
fn optional_place<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Vec<f64>>, D::Error> {
    place(from).map(Some)
}

/// Deserializes a list of positions.
pub(super) fn places<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let positions = Vec::<Vec<Option<f64>>>::deserialize(from)?;
    Ok(positions
        .into_iter()
        .map(|numbers: Vec<Option<f64>>| numbers.into_iter().map(or_nan).collect())
        .collect())
}

/// Deserializes a position in the plane.
pub(super) fn planar<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    <[Option<f64>; 2]>::deserialize(from).map(|numbers| numbers.map(or_nan))
}

/// Deserializes a position in the plane that may be absent.
pub(super) fn optional_planar<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<[f64; 2]>, D::Error> {
    planar(from).map(Some)
}

/// Deserializes a list of positions in the plane.
pub(super) fn planar_list<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<[f64; 2]>, D::Error> {
    let positions = Vec::<[Option<f64>; 2]>::deserialize(from)?;
    Ok(positions
        .into_iter()
        .map(|numbers| numbers.map(or_nan))
        .collect())
}

fn or_nan(number: Option<f64>) -> f64 {
    number.unwrap_or(f64::NAN)
}
