//! How the UVs of a document are packed.

use super::{Caller, CommandOptions, Cutting, KeptMaps, Layout, Options, Sets, Workers};
use crate::charts::Cut;
use crate::document::{GroupBy, OutputFormat};
use crate::options::options;
use crate::pipeline::PipelineError;

options! {
    /// How the UVs of a document are packed. The command line's long names in snake case.
    pub struct RepackOptions {
        /// What shares an atlas.
        pub group_by: GroupBy = GroupBy::Scene;
    }
    files {
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
    /// The same as options of unwrapping, which then keeps islands and their maps.
    pub(in crate::pipeline) fn to_unwrap(&self) -> Options {
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
        self.to_unwrap().check()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}
