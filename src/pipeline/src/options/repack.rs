//! Options of repacking.

use super::{Caller, CommandOptions, Cutting, Island, KeptMaps, Layout, Options, Sets, Workers};
use crate::PipelineError;
use unwrapd_api::options::options;
use unwrapd_files::document::{GroupBy, OutputFormat};
use unwrapd_layout::charts::Cut;

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
        /// UV sets to read and write.
        pub sets: Sets;
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
