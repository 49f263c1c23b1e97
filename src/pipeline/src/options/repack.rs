//! Options of repacking.

use super::{Caller, CommandOptions, Cutting, Island, KeptMaps, Layout, Options, Sets, Workers};
use crate::PipelineError;
use unwrapd_api::options::options;
use unwrapd_files::document::{GroupBy, OutputFormat};
use unwrapd_layout::charts::Cut;

options! {
    /// How the UVs of a document are packed. The command line's long names in snake case.
    pub struct RepackOptions {
        /// What shares an atlas.
        pub group_by: GroupBy = GroupBy::Scene;
    }
    files {
        /// Islands that stay where they are put, around which the others are packed: {"islands":
        /// [{"primitive": i, "face": f, "move": [u, v], "turn": degrees, "scale": s, "pivot": [u,
        /// v]}, …]}. Each is named by one of its faces and is moved, turned and scaled from where it
        /// is, all of which may be absent. UVs and faces are those of the result; in glTF, v points
        /// down, and `turn` goes from the direction of u to that of v.
        pub islands: Vec<Island>;
        /// Format of the result.
        pub format: OutputFormat = OutputFormat::Glb;
    }
    groups {
        /// How islands are laid out on a texture.
        pub layout: Layout;
        /// Which UV sets are read and written.
        pub sets: Sets;
        /// What works.
        pub workers: Workers;
    }
    untold {
        /// What the code that packs says.
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
            layout: self.layout,
            sets: self.sets,
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
        self.to_unwrap().check()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}
