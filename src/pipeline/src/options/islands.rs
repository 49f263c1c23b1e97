//! Islands with placements given by the user.

use serde::{Deserialize, Serialize};

use crate::arrays::placement::Placement;
use unwrapd_api::options::within;
use unwrapd_maps::mesh::VAxis;

/// Maximum shift of an island, and maximum distance of its pivot from the origin, in UV.
const FARTHEST: f64 = 1e6;
/// Maximum turn of an island in degrees: a hundred turns.
const MOST_DEGREES: f64 = 36_000.0;
/// Range of the scale of an island.
const SCALES: [f64; 2] = [1e-6, 1e6];

/// An island, named by one of its faces, that is put somewhere and stays there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields)]
pub struct Island {
    /// The triangle primitive, counted over the result from 0.
    #[serde(default)]
    pub primitive: u32,
    /// One of its faces, from 0.
    pub face: u32,
    /// The way that the island moves.
    #[serde(default, rename = "move")]
    pub shift: [f64; 2],
    /// Degrees that it turns by about the pivot, from the direction of u to that of v.
    #[serde(default)]
    pub turn: f64,
    /// The factor by which it is scaled about the pivot.
    #[serde(default = "one")]
    pub scale: f64,
    /// The pivot. The default is the middle of the island's bounding rectangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pivot: Option<[f64; 2]>,
}

fn one() -> f64 {
    1.0
}

impl Island {
    /// Checks the numbers. The error names the island by its position in the list.
    pub(super) fn check(&self, index: usize) -> Result<(), String> {
        let named = |what: &str| format!("islands[{index}].{what}");
        let far = |what: &str, value: f64| within(&named(what), value, -FARTHEST, FARTHEST);
        within(&named("turn"), self.turn, -MOST_DEGREES, MOST_DEGREES)?;
        within(&named("scale"), self.scale, SCALES[0], SCALES[1])?;
        self.shift.into_iter().try_for_each(|x| far("move", x))?;
        let pivot = self.pivot.into_iter().flatten();
        pivot.into_iter().try_for_each(|x| far("pivot", x))
    }

    /// Returns the placement of a mesh face's island with v up.
    pub(crate) fn placement(&self, number: usize, face: u32, v_axis: VAxis) -> Placement {
        let up = v_axis == VAxis::Up;
        let sign = if up { 1.0 } else { -1.0 };
        Placement {
            number,
            face,
            shift: [self.shift[0], sign * self.shift[1]],
            turn: sign * self.turn.to_radians(),
            scale: self.scale,
            pivot: (self.pivot).map(|[u, v]| [u, if up { v } else { 1.0 - v }]),
        }
    }
}
