//! Checks of the options of unwrapping.

use super::layout::check_mips;
use super::{Caller, CommandOptions, Options, idle};
use crate::PipelineError;
use crate::documents::texel_weight::TexelWeight;
use unwrapd_api::options::OptionSet;
use unwrapd_layout::charts::Cut;

impl Options {
    fn validate(&self) -> Result<(), String> {
        // Before the ranges: that of the padding depends on the resolution.
        self.layout.check()?;
        self.check_ranges()?;
        check_mips(self.layout.padding, self.mips(), self.layout.resolution)?;
        self.settings().validate()?;
        idle::check(self)?;
        self.texel_weight.iter().try_for_each(TexelWeight::check)?;
        if self.cutting.cut == Cut::Seams && self.seams.is_none() {
            return Err("`cut` seams requires `seams`".to_owned());
        }
        let is_one_square = self.layout.pages == 1 && self.layout.resolution.aspect() == 1.0;
        if self.baking.rebake && !is_one_square {
            return Err(
                "`rebake` makes one square texture: it requires `pages` 1 and a square `resolution`"
                    .to_owned(),
            );
        }
        Ok(())
    }
}

impl CommandOptions for Options {
    fn check(&self) -> Result<(), PipelineError> {
        self.validate().map_err(PipelineError::InvalidOptions)
    }

    fn caller_mut(&mut self) -> &mut Caller {
        &mut self.caller
    }
}
