//! How a mesh given as arrays is unwrapped.

use crate::options::{Budget, Cutting, Layout, Mapping, Workers};
use unwrapd_api::options::OptionSet;
use unwrapd_layout::atlas::Borders;

/// How a mesh given as arrays is unwrapped.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings {
    /// Where to cut.
    pub cutting: Cutting,
    /// How charts are mapped.
    pub mapping: Mapping,
    /// How charts are laid out on a texture.
    pub layout: Layout,
    /// Where charts may end; on borders of texels only where the sides of the texture are powers of
    /// two.
    pub borders: Borders,
    /// What works.
    pub workers: Workers,
    /// How long it may take.
    pub budget: Budget,
}

impl Settings {
    /// Checks every number against its range, and what goes with what; the text names the option.
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
        self.cutting.check()?;
        self.mapping.check(self.cutting.cut)
    }
}
