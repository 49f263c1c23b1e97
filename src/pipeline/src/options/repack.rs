//! Options of repacking.

use super::{
    Baking, Caller, CommandOptions, Cutting, IslandControl, KeptMaps, Layout, Options, Sets,
    Stacking, Workers,
};
use crate::PipelineError;
use crate::arrays::placement::Placement;
use serde::{Deserialize, Serialize};
use unwrapd_api::options::{options, within};
use unwrapd_files::document::{GroupBy, OutputFormat};
use unwrapd_layout::charts::Cut;
use unwrapd_maps::mesh::VAxis;

options! {
    /// Options of repacking. They have the command line's long names in snake case.
    pub struct RepackOptions {
        /// Parts of the document that share an atlas.
        pub group_by: GroupBy = GroupBy::Scene;
    }
    files {
        /// Islands that stay where they are put, around which the others are packed: {"islands":
        /// [{"primitive": i, "face": f, "move": [u, v], "turn": degrees, "scale": s, "pivot": [u,
        /// v]}, …]}. Each is named by one of its faces and is moved, turned and scaled from where
        /// it is; `move`, `turn`, `scale` and `pivot` may be absent. UVs and faces are those of the
        /// result; in glTF, v points down, and `turn` goes from the direction of u to that of v.
        pub islands: Vec<Island>;
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// Layout of the islands on a texture.
        pub layout: Layout;
        /// Rules for islands.
        pub control: IslandControl;
        /// UV sets to read and write.
        pub sets: Sets;
        /// Resampling of textures.
        pub baking: Baking;
        /// Number of threads.
        pub workers: Workers;
    }
    untold {
        /// Settings of the caller.
        pub caller: Caller;
    }
}

impl RepackOptions {
    /// Returns the equivalent options of unwrapping, which keep islands and their maps.
    pub(crate) fn to_unwrap(&self) -> Options {
        Options {
            cutting: Cutting {
                cut: Cut::Keep,
                kept_maps: KeptMaps::AsGiven,
                ..Cutting::default()
            },
            group_by: Some(self.group_by),
            layout: Layout {
                stack: self.layout.stack.or(Some(Stacking::Keep)),
                ..self.layout
            },
            control: self.control.clone(),
            sets: self.sets,
            baking: self.baking,
            workers: self.workers,
            format: self.format,
            caller: self.caller.clone(),
            ..Options::default()
        }
    }
}

impl CommandOptions for RepackOptions {
    fn check(&self) -> Result<(), PipelineError> {
        for (index, island) in self.islands.iter().enumerate() {
            island.check(index).map_err(PipelineError::InvalidOptions)?;
        }
        let by_shape = [Some(Stacking::Identical), Some(Stacking::Mirrored)];
        if !self.islands.is_empty() && by_shape.contains(&self.layout.stack) {
            let text = "`islands` requires `stack` off or keep";
            return Err(PipelineError::InvalidOptions(text.to_owned()));
        }
        self.to_unwrap().check()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}

// Islands with placements given by the user.

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
    pub(crate) fn check(&self, index: usize) -> Result<(), String> {
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
