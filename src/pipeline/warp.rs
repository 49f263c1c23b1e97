//! Pictures pulled by handles.

use serde::{Deserialize, Serialize};

use super::PipelineError;
use super::arrays::in_pool;
use super::documents::stem;
use super::idle;
use super::limits::{Limits, check_time_budget};
use super::observer::{Observer, Stage, Tracker};
use super::pull_report::PullReport;
use crate::barrier::BarrierKind;
use crate::certificate::{boundary_crossings, certify_planar};
use crate::deform::warp::{self, PictureHandle, warp_picture};
use crate::deform::{Boundary, Model};
use crate::document::{Upload, Warning};
use crate::picture::Image;

/// How a picture is warped. The command line's long names in snake case; a file of handles is one with the handles only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
#[serde(deny_unknown_fields, default)]
pub struct WarpOptions {
    /// Places of the picture and where they go, in pixels, y down. Each takes hold of its own point; next to
    /// a fixed border of the nearest inner vertex of the grid, whose target is shifted by the same offset.
    pub handles: Vec<PictureHandle>,
    /// Cells of the grid along the longer side.
    #[cfg_attr(feature = "service", schema(minimum = 1, maximum = 512))]
    pub grid: usize,
    /// Hold the border, so that the map is bijective; handles next to it take hold of inner vertices.
    pub fix_border: bool,
    /// What the deformation costs, for a mean triangle of an area from ½ to 2.
    #[serde(flatten)]
    pub model: Model,
    /// Seconds after which the current valid map is taken as it is.
    #[cfg_attr(feature = "service", schema(minimum = 0, maximum = 1e6))]
    pub time_budget: Option<f64>,
    /// Name of the written file without extension; the input's if absent. Not an option over HTTP.
    #[serde(skip)]
    pub stem: Option<String>,
    /// What may be used of all this. Not an option over HTTP.
    #[serde(skip)]
    pub limits: Limits,
}

impl Default for WarpOptions {
    fn default() -> Self {
        Self {
            handles: Vec::new(),
            grid: warp::WarpOptions::default().grid,
            fix_border: false,
            model: Model::default(),
            time_budget: None,
            stem: None,
            limits: Limits::default(),
        }
    }
}

impl WarpOptions {
    /// Checks what can be checked without the file.
    pub fn check(&self) -> Result<(), PipelineError> {
        self.model.check()?;
        idle::check_model(&self.model).map_err(PipelineError::InvalidOptions)?;
        check_time_budget(self.time_budget)
    }

    fn boundary(&self) -> Boundary {
        if self.fix_border {
            Boundary::Fixed
        } else {
            Boundary::Free
        }
    }
}

/// A warped picture.
#[derive(Clone, Debug)]
pub struct WarpedPicture {
    /// The PNG file by its name.
    pub files: Vec<(String, Vec<u8>)>,
    /// What the map is worth.
    pub report: WarpReport,
}

/// What a warp of a picture is worth.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema))]
pub struct WarpReport {
    /// Whether the map is proven to have no inverted triangle and, with a fixed border or if asked for, to be bijective.
    pub certified: bool,
    /// What users should know of the picture and of the map.
    pub warnings: Vec<Warning>,
    /// Where the upper left corner of the result lies, in pixels of the original.
    pub origin: [i64; 2],
    /// The map.
    #[serde(flatten)]
    pub map: PullReport,
}

/// Warps a picture without folding it, and proves that on the map of its grid.
pub fn warp_file(
    upload: &Upload,
    options: &WarpOptions,
    observer: &dyn Observer,
) -> Result<WarpedPicture, PipelineError> {
    options.check()?;
    let tracker = Tracker::new(observer, options.limits.time_budget(options.time_budget));
    in_pool(options.limits.threads, || {
        tracker.stage(Stage::Read);
        let image = Image::decode(&upload.bytes)?;
        let how = warp::WarpOptions {
            grid: options.grid,
            boundary: options.boundary(),
            model: options.model,
        };
        let warped = warp_picture(&image, &options.handles, &how, &tracker)?;
        let (vertices, triangles) = (&warped.deformed, warped.grid.triangles());
        let map = PullReport::new(
            warped.summary,
            boundary_crossings(vertices, triangles),
            certify_planar(vertices, triangles),
        );
        let certified = if how.boundary == Boundary::Fixed || options.model.bijective {
            map.bijective
        } else {
            map.certificate.is_valid()
        };
        if !certified && options.model.barrier != BarrierKind::None {
            return Err(PipelineError::Inverted);
        }
        tracker.stage(Stage::Write);
        let stem = options.stem.clone().unwrap_or_else(|| stem(&upload.name));
        Ok(WarpedPicture {
            files: vec![(format!("{stem}.png"), warped.picture.image.png())],
            report: WarpReport {
                certified,
                warnings: Vec::new(),
                origin: warped.picture.origin,
                map,
            },
        })
    })?
}
