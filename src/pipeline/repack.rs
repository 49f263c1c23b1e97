//! UVs packed anew, as they are.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::documents::{Outcome, unwrap_document};
use super::limits::Limits;
use super::observer::Observer;
use super::options::Options;
use super::settings::KeptMaps;
use crate::charts::Cut;
use crate::document::{GroupBy, OutputFormat, Upload};
use crate::mesh::Resolution;

/// How the UVs of a document are packed. The command line's long names in snake case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct RepackOptions {
    /// The UV set whose islands are packed; 0 if absent.
    #[cfg_attr(feature = "service", schema(maximum = 7))]
    pub source_texcoord: Option<u32>,
    /// The UV set to write; chosen so that no texture breaks if absent.
    #[cfg_attr(feature = "service", schema(maximum = 7))]
    pub texcoord: Option<u32>,
    /// Replace the UV set even if textures sample it.
    pub overwrite: bool,
    /// What shares one atlas.
    pub group_by: GroupBy,
    /// The texture that `padding` is counted in. One side is the other times a power of two.
    pub resolution: Resolution,
    /// Pages that islands may lie on: page k covers u from k to k + 1, the tile 1001 + k of UDIM.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 10))]
    pub pages: u32,
    /// Texels along one unit of length of the meshes, at the mean. If absent as many as fit; a texture that is too small is an error.
    #[cfg_attr(feature = "service", schema(minimum = 1e-9, maximum = 1e9))]
    pub texels_per_unit: Option<f64>,
    /// Least distance of two islands, in texels; at most an eighth of the resolution.
    #[cfg_attr(feature = "service", schema(maximum = 8192))]
    pub padding: u32,
    /// Threads to use; all that are allowed if absent. The result does not depend on it.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 1024))]
    pub threads: Option<usize>,
    /// Format of the result.
    pub format: OutputFormat,
    /// Name of the written files without extension; the input's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for RepackOptions {
    fn default() -> Self {
        let options = Options::default();
        Self {
            source_texcoord: None,
            texcoord: None,
            overwrite: false,
            group_by: GroupBy::Scene,
            resolution: options.resolution,
            pages: options.pages,
            texels_per_unit: options.texels_per_unit,
            padding: options.padding,
            threads: None,
            format: options.format,
            stem: None,
            limits: Limits::default(),
        }
    }
}

impl RepackOptions {
    /// Checks every number against its range; the error names the option.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.to_unwrap().check()
    }

    /// The same as options of unwrapping, which then keeps islands and their maps.
    fn to_unwrap(&self) -> Options {
        Options {
            cut: Cut::Keep,
            kept_maps: KeptMaps::AsGiven,
            source_texcoord: self.source_texcoord,
            texcoord: self.texcoord,
            overwrite: self.overwrite,
            group_by: Some(self.group_by),
            resolution: self.resolution,
            pages: self.pages,
            texels_per_unit: self.texels_per_unit,
            padding: self.padding,
            threads: self.threads,
            format: self.format,
            stem: self.stem.clone(),
            limits: self.limits,
            ..Options::default()
        }
    }
}

/// Packs the islands of all primitives of a group into one atlas. Each stays as it is but for quarter turns, shifts and one scale for
/// all; faces that are flipped or overlap within an island stay so, and the certificate counts them.
pub fn repack_document(
    upload: &Upload,
    options: &RepackOptions,
    observer: &dyn Observer,
) -> Result<Outcome, PipelineError> {
    unwrap_document(upload, &options.to_unwrap(), observer)
}
