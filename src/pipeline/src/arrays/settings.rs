//! Settings for unwrapping a mesh given as arrays.

use crate::options::{
    Budget, Cutting, KeptMaps, Layout, Mapping, Stacking, Straightening, Workers,
};
use unwrapd_api::options::OptionSet;
use unwrapd_layout::atlas::Borders;
use unwrapd_layout::charts::Cut;

/// Settings for unwrapping a mesh given as arrays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Where to cut.
    pub cutting: Cutting,
    /// Mapping of the charts.
    pub mapping: Mapping,
    /// Layout of the charts on a texture.
    pub layout: Layout,
    /// Where charts may end; on borders of texels only where the sides of the texture are powers of
    /// two.
    pub borders: Borders,
    /// Charts whose nearly straight borders become straight; by default no chart's do.
    pub straighten: Option<Straightening>,
    /// Number of threads.
    pub workers: Workers,
    /// Time limit.
    pub budget: Budget,
}

impl Settings {
    /// Checks the range of every number and the dependencies between options; the error names the option.
    pub fn validate(&self) -> Result<(), String> {
        self.layout.check()?;
        self.cutting.check_ranges()?;
        self.mapping.check_ranges()?;
        self.layout.check_ranges()?;
        self.workers.check_ranges()?;
        self.budget.check_ranges()?;
        if self.layout.pages > 1 && self.mapping.quantization_safe.is_some() {
            return Err(
                "`quantization_safe` requires a single page: on several, rounding leaves fewer bits per page".to_owned(),
            );
        }
        if self.borders == Borders::OnTexels && !self.layout.resolution.shorter().is_power_of_two()
        {
            let given = self.layout.resolution;
            return Err(format!(
                "the `resolution` of a lightmap must be a power of two, not {given}: its charts end on texel borders"
            ));
        }
        let is_given = self.cutting.cut == Cut::Keep && self.cutting.kept_maps == KeptMaps::AsGiven;
        if self.layout.stack == Some(Stacking::Keep) && !is_given {
            return Err("`stack` keep requires `cut` keep and `kept_maps` as-given".to_owned());
        }
        if self
            .layout
            .stack
            .is_some_and(|stack| stack != Stacking::Off)
        {
            if self.borders == Borders::OnTexels {
                return Err(
                    "a lightmap has no stacks: `stack` requires `preset` material".to_owned(),
                );
            }
            if self.mapping.quantization_safe.is_some() {
                return Err("`quantization_safe` requires `stack` off".to_owned());
            }
        }
        self.cutting.check()?;
        self.mapping.check(self.cutting.cut)
    }
}
