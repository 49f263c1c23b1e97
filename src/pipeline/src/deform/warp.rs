//! Warping of pictures by handles.

use super::solution::{Completion, PullReport};
use crate::PipelineError;
use crate::arrays::unwrap::in_pool;
use crate::observer::Observer;
use crate::options::{CommandOptions, WarpOptions};
use crate::start::start;
use crate::tracker::Tracker;
use serde::Serialize;
use unwrapd_api::Stage;
use unwrapd_deform::Boundary;
use unwrapd_deform::warp::{WarpError, picture_grid, warp_picture_from};
use unwrapd_files::document::{Upload, Warning};
use unwrapd_files::picture::Image;
use unwrapd_maps::certificate::{boundary_crossings, certify_planar};
use unwrapd_method::barrier::BarrierKind;

/// A warped picture.
#[derive(Clone, Debug)]
pub struct WarpedPicture {
    /// PNG file with its name.
    pub files: Vec<(String, Vec<u8>)>,
    /// Report on the map.
    pub report: WarpReport,
}

/// Report on a warped picture.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub struct WarpReport {
    /// `true` if the map is proven to have no inverted triangle and, with a fixed border or on request, to be
    /// bijective.
    pub certified: bool,
    /// Degree to which the request was completed.
    pub completion: Completion,
    /// Warnings about the picture and the map.
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
    let tracker = Tracker::new(observer, options.caller.budget(options.budget));
    in_pool(options.caller.workers(options.workers), || {
        // Read the picture and build its grid.
        tracker.stage(Stage::Read);
        let image = Image::decode(&upload.bytes)?;
        let how = options.of_grid();
        let grid = picture_grid(image.width, image.height, how.grid).map_err(WarpError::from)?;
        let start = start(upload, 2 * grid.vertices().len())?;
        let start = start.as_deref().map(|start| start.as_chunks().0);
        // Warp, then certify the map of the grid.
        let warped = warp_picture_from(&image, start, &options.handles, &how, &tracker)?;
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
        let status = map.summary.status;
        let completion = Completion::of(status);
        let unfinished = completion.warning(status, &map.summary.unreached);
        let warnings = tracker.warning().into_iter().chain(unfinished);
        // Write the picture.
        tracker.stage(Stage::Write);
        let stem = options.caller.stem(upload);
        Ok(WarpedPicture {
            files: vec![(format!("{stem}.png"), warped.picture.image.png())],
            report: WarpReport {
                certified,
                completion,
                warnings: warnings.collect(),
                origin: warped.picture.origin,
                map,
            },
        })
    })?
}
