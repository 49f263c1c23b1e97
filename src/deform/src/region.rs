//! Regions and lines of the plane that handles of pictures and of UV maps hold, regions as rigid bodies.
//!
//! A handle at a point is a point load: the map shrinks around it, the finer the mesh the more. A region keeps its
//! shape, as an eye in a picture does that is moved.

use super::handle::{self, Handle, middle};
use serde::{Deserialize, Serialize};

/// Largest turn of a region in degrees: on its way a region turns the shorter way round.
pub(super) const MOST_DEGREES: f64 = 180.0;

/// A part of the plane and where it goes as a rigid body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum Region {
    /// A disc.
    Disc {
        /// The center.
        #[serde(deserialize_with = "handle::planar")]
        center: [f64; 2],
        /// The radius.
        radius: f64,
        /// Where the center goes.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// A turn about the center in degrees, counter-clockwise as seen, from −180 to 180.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A box along the axes.
    Box {
        /// The corner of the least coordinates.
        #[serde(deserialize_with = "handle::planar")]
        low: [f64; 2],
        /// The corner of the largest coordinates.
        #[serde(deserialize_with = "handle::planar")]
        high: [f64; 2],
        /// Where the middle goes.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
    /// A polygon.
    Outline {
        /// The corners, at least three, in order.
        #[serde(deserialize_with = "handle::planar_list")]
        outline: Vec<[f64; 2]>,
        /// Where the middle of its bounding box goes.
        #[serde(deserialize_with = "handle::planar")]
        to: [f64; 2],
        /// A turn about that middle, as that of a disc.
        #[serde(default)]
        turn: f64,
        /// Strength of a soft handle; see `weight` of a point.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        weight: Option<f64>,
    },
}

impl Region {
    /// Returns whether every number is finite, none exceeds `most`, sizes are not negative and the turn is in range.
    pub(super) fn is_valid(&self, most: f64) -> bool {
        let are_near = |places: &[[f64; 2]]| places.as_flattened().iter().all(|x| x.abs() <= most);
        let size_is_valid = match self {
            Self::Disc { radius, .. } => (0.0..=most).contains(radius),
            Self::Box { low, high, .. } => {
                let mut sides = low.iter().zip(high);
                are_near(&[*low, *high]) && sides.all(|(low, high)| low <= high)
            }
            Self::Outline { outline, .. } => {
                (3..=MOST_CORNERS).contains(&outline.len()) && are_near(outline)
            }
        };
        let places = [self.center(), self.to()];
        size_is_valid && are_near(&places) && self.turn().abs() <= MOST_DEGREES
    }

    /// Returns the center.
    pub fn center(&self) -> [f64; 2] {
        match self {
            Self::Disc { center, .. } => *center,
            Self::Box { low, high, .. } => [0, 1].map(|k| 0.5 * (low[k] + high[k])),
            // There are corners: otherwise the region is not valid.
            Self::Outline { outline, .. } => {
                let middle = middle(outline);
                [0, 1].map(|k| middle.get(k).copied().unwrap_or(f64::NAN))
            }
        }
    }

    /// Returns where the center goes.
    pub fn to(&self) -> [f64; 2] {
        let (Self::Disc { to, .. } | Self::Box { to, .. } | Self::Outline { to, .. }) = self;
        *to
    }

    /// Changes where the center goes.
    pub(super) fn retarget(&mut self, target: [f64; 2]) {
        let (Self::Disc { to, .. } | Self::Box { to, .. } | Self::Outline { to, .. }) = self;
        *to = target;
    }

    fn turn(&self) -> f64 {
        let (Self::Disc { turn, .. } | Self::Box { turn, .. } | Self::Outline { turn, .. }) = self;
        *turn
    }

    /// Returns the strength of a soft handle.
    pub(super) fn weight(&self) -> Option<f64> {
        let (Self::Disc { weight, .. } | Self::Box { weight, .. } | Self::Outline { weight, .. }) =
            self;
        *weight
    }

    /// Returns whether a place is in the region.
    pub(super) fn contains(&self, place: [f64; 2]) -> bool {
        match self {
            Self::Disc { center, radius, .. } => {
                (place[0] - center[0]).hypot(place[1] - center[1]) <= *radius
            }
            Self::Outline { outline, .. } => surrounds(outline, place),
            Self::Box { low, high, .. } => (0..2).all(|k| (low[k]..=high[k]).contains(&place[k])),
        }
    }

    /// Returns the region with its turn the other way round, as coordinates have it whose y points down.
    #[must_use]
    pub fn mirrored(mut self) -> Self {
        let (Self::Disc { turn, .. } | Self::Box { turn, .. } | Self::Outline { turn, .. }) =
            &mut self;
        *turn = -*turn;
        self
    }

    /// Returns where a place of the region goes.
    pub(super) fn moved(&self, place: [f64; 2]) -> [f64; 2] {
        self.motion().moved(place)
    }

    /// Returns the motion of the region.
    fn motion(&self) -> PlanarMotion {
        PlanarMotion {
            center: self.center(),
            to: self.to(),
            turn: self.turn(),
        }
    }
}

/// Returns the handle of a body of the plane.
impl From<Region> for Handle {
    fn from(region: Region) -> Self {
        match region {
            Region::Disc {
                center,
                radius,
                to,
                turn,
                weight,
            } => Self::Disc {
                center: center.to_vec(),
                radius,
                to: to.to_vec(),
                turn,
                axis: None,
                weight,
            },
            Region::Box {
                low,
                high,
                to,
                turn,
                weight,
            } => Self::Box {
                low: low.to_vec(),
                high: high.to_vec(),
                to: to.to_vec(),
                turn,
                axis: None,
                weight,
            },
            Region::Outline {
                outline,
                to,
                turn,
                weight,
            } => Self::Outline {
                outline: outline.into_iter().map(Vec::from).collect(),
                to: to.to_vec(),
                turn,
                weight,
            },
        }
    }
}

/// A rigid motion of the plane.
pub(super) struct PlanarMotion {
    pub center: [f64; 2],
    /// Where the center goes.
    pub to: [f64; 2],
    /// Degrees, counter-clockwise.
    pub turn: f64,
}

impl PlanarMotion {
    /// Returns where a place goes. Without a turn, all places move by the same offset.
    pub fn moved(&self, place: [f64; 2]) -> [f64; 2] {
        let Self { center, to, turn } = *self;
        if turn == 0.0 {
            return [0, 1].map(|k| place[k] + (to[k] - center[k]));
        }
        let (sin, cos) = turn.to_radians().sin_cos();
        let [x, y] = [0, 1].map(|k| place[k] - center[k]);
        [to[0] + cos * x - sin * y, to[1] + sin * x + cos * y]
    }
}

/// Returns whether a polygon surrounds a place an odd number of times.
pub(super) fn surrounds(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let ends = polygon.iter().cycle().skip(1);
    let crossed = polygon.iter().zip(ends).filter(|&(a, b)| {
        // The ray to the right crosses the side.
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
    });
    crossed.count() % 2 == 1
}

// Lines of the plane that handles pull.

/// Most corners of a line or an outline: each element of a body is clipped against each segment.
pub(super) const MOST_CORNERS: usize = 1000;

/// A line from corner to corner, held at one point in every other triangle that it crosses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// The corners of the line, at least two.
    #[serde(deserialize_with = "handle::planar_list")]
    pub line: Vec<[f64; 2]>,
    /// The corners of the line that it becomes, any number of them: points keep their share of the
    /// length.
    #[serde(deserialize_with = "handle::planar_list")]
    pub to: Vec<[f64; 2]>,
    /// Strength of a soft handle; see `weight` of a point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

impl Line {
    /// Returns whether both lines have corners, none beyond `most`.
    pub(super) fn is_valid(&self, most: f64) -> bool {
        [&self.line, &self.to].into_iter().all(|corners| {
            (2..=MOST_CORNERS).contains(&corners.len())
                && corners.as_flattened().iter().all(|x| x.abs() <= most)
        })
    }

    /// Moves the target so that the middle of its bounding box goes to a place.
    pub(super) fn retarget(&mut self, target: [f64; 2]) {
        let middle = middle(&self.to);
        for corner in &mut self.to {
            for ((x, middle), target) in corner.iter_mut().zip(&middle).zip(target) {
                *x += target - middle;
            }
        }
    }
}

/// Returns the handle of a body of the plane.
impl From<Line> for Handle {
    fn from(Line { line, to, weight }: Line) -> Self {
        let widened = |corners: Vec<[f64; 2]>| corners.into_iter().map(Vec::from).collect();
        Self::Line {
            line: widened(line),
            to: widened(to),
            weight,
        }
    }
}
