//! Regions of the plane that handles of pictures and of UV maps hold as rigid bodies.
//!
//! A handle at a point is a point load: the map shrinks around it, the finer the mesh the more. A region keeps its
//! shape, as an eye in a picture does that is moved.

use super::handles::{self, Handle};
use serde::{Deserialize, Serialize};

/// Largest turn of a region in degrees: on its way a region turns the shorter way round.
const MOST_DEGREES: f64 = 180.0;

/// A part of the plane and where it goes as a rigid body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(untagged, deny_unknown_fields)]
pub enum Region {
    /// A disc.
    Disc {
        /// The center.
        #[serde(deserialize_with = "handles::planar")]
        center: [f64; 2],
        /// The radius.
        radius: f64,
        /// Where the center goes.
        #[serde(deserialize_with = "handles::planar")]
        to: [f64; 2],
        /// A turn about the center in degrees, counter-clockwise as seen, from −180 to 180.
        #[serde(default)]
        turn: f64,
    },
    /// A box along the axes.
    Box {
        /// The corner of the least coordinates.
        #[serde(deserialize_with = "handles::planar")]
        low: [f64; 2],
        /// The corner of the largest coordinates.
        #[serde(deserialize_with = "handles::planar")]
        high: [f64; 2],
        /// Where the middle goes.
        #[serde(deserialize_with = "handles::planar")]
        to: [f64; 2],
        /// A turn about the middle, as that of a disc.
        #[serde(default)]
        turn: f64,
    },
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
            } => Self::Disc {
                center: center.to_vec(),
                radius,
                to: to.to_vec(),
                turn,
                axis: None,
            },
            Region::Box {
                low,
                high,
                to,
                turn,
            } => Self::Box {
                low: low.to_vec(),
                high: high.to_vec(),
                to: to.to_vec(),
                turn,
                axis: None,
            },
        }
    }
}

impl Region {
    /// Returns whether every number is finite, none exceeds `most`, sizes are not negative and the turn is in range.
    pub(super) fn is_valid(&self, most: f64) -> bool {
        let size_is_valid = match *self {
            Self::Disc { radius, .. } => (0.0..=most).contains(&radius),
            Self::Box { low, high, .. } => {
                let sides = low.iter().zip(high);
                low.iter().chain(&high).all(|x| x.abs() <= most)
                    && sides.into_iter().all(|(low, high)| *low <= high)
            }
        };
        let places = [self.center(), self.to()];
        size_is_valid
            && places.as_flattened().iter().all(|x| x.abs() <= most)
            && self.turn().abs() <= MOST_DEGREES
    }

    /// Returns the center.
    pub fn center(&self) -> [f64; 2] {
        match *self {
            Self::Disc { center, .. } => center,
            Self::Box { low, high, .. } => [0, 1].map(|k| 0.5 * (low[k] + high[k])),
        }
    }

    /// Returns where the center goes.
    pub fn to(&self) -> [f64; 2] {
        let (Self::Disc { to, .. } | Self::Box { to, .. }) = *self;
        to
    }

    /// Changes where the center goes.
    pub(super) fn retarget(&mut self, target: [f64; 2]) {
        let (Self::Disc { to, .. } | Self::Box { to, .. }) = self;
        *to = target;
    }

    fn turn(&self) -> f64 {
        let (Self::Disc { turn, .. } | Self::Box { turn, .. }) = *self;
        turn
    }

    /// Returns whether a place is in the region.
    pub(super) fn contains(&self, place: [f64; 2]) -> bool {
        match *self {
            Self::Disc { center, radius, .. } => {
                (place[0] - center[0]).hypot(place[1] - center[1]) <= radius
            }
            Self::Box { low, high, .. } => (0..2).all(|k| (low[k]..=high[k]).contains(&place[k])),
        }
    }

    /// Returns the region with its turn the other way round, as coordinates have it whose y points down.
    #[must_use]
    pub fn mirrored(mut self) -> Self {
        let (Self::Disc { turn, .. } | Self::Box { turn, .. }) = &mut self;
        *turn = -*turn;
        self
    }

    /// Returns where a place of the region goes. Without a turn, all places move by the same offset.
    pub(super) fn moved(&self, place: [f64; 2]) -> [f64; 2] {
        let (center, to) = (self.center(), self.to());
        if self.turn() == 0.0 {
            return [0, 1].map(|k| place[k] + (to[k] - center[k]));
        }
        let (sin, cos) = self.turn().to_radians().sin_cos();
        let [x, y] = [0, 1].map(|k| place[k] - center[k]);
        [to[0] + cos * x - sin * y, to[1] + sin * x + cos * y]
    }
}
