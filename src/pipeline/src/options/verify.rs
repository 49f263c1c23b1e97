//! Options of verification.

use super::{Caller, CommandOptions, MeasureOptions};
use crate::PipelineError;
use unwrapd_api::options::options;

options! {
    /// Options of verifying the UVs of a document.
    pub struct VerifyOptions {
        /// Also prove that no two faces overlap.
        pub bijective: bool;
        /// Also prove that no chart is mirrored.
        pub unmirrored: bool;
    }
    groups {
        /// The UVs to judge, and further properties to prove.
        pub judged: MeasureOptions;
    }
}

impl CommandOptions for VerifyOptions {
    fn check(&self) -> Result<(), PipelineError> {
        self.judged.check()
    }

    fn caller_mut(&mut self) -> &mut Caller {
        self.judged.caller_mut()
    }
}
