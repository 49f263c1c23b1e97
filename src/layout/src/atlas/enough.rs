//! Textures that would be large enough for charts that do not fit at a prescribed scale.
use std::fmt;

use super::coarse::CoarseLayout;
use super::effort::UNHEARD;
use super::layout::{Problem, SLACK};
use super::pack::fullest;
use super::page::Texture;
use super::plan::Plan;
use super::problem::{AtlasError, AtlasOptions, Borders, ChartMap, Scale};
use unwrapd_maps::mesh::Resolution;

/// Factor by which a larger texture exceeds the need of the best layout, since searches in two textures differ.
const MARGIN: f64 = 1.03;
/// Divisor of the shorter side of a texture, in texels.
const WHOLE: u32 = 16;
/// Longest side of a texture, in texels.
const LONGEST: u32 = 65_536;

/// Textures that would be large enough.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Enough {
    /// Resolution with the same number of pages.
    pub resolution: Option<Resolution>,
    /// Number of pages of the same resolution.
    pub pages: Option<u32>,
}

/// Continues a message that says what is too small.
impl fmt::Display for Enough {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.resolution, self.pages) {
            (Some(resolution), Some(pages)) => {
                write!(f, ": use resolution {resolution} or {pages} pages")
            }
            (Some(resolution), None) => write!(f, ": use resolution {resolution}"),
            (None, Some(pages)) => write!(f, ": use {pages} pages"),
            (None, None) => write!(f, ", and so is the largest texture"),
        }
    }
}

/// Estimates textures that are large enough for charts at the prescribed scale, from one layout of each kind.
pub fn enough(charts: &[ChartMap], options: &AtlasOptions) -> Result<Enough, AtlasError> {
    let Scale::TexelsPerUnit(texels) = options.scale else {
        return Ok(Enough::default());
    };
    let largest = AtlasOptions {
        scale: Scale::Largest,
        ..options.clone()
    };
    let plan = Plan::of(charts, options)?;
    let coarse = CoarseLayout::of(&plan, &largest);
    let problem = Problem::free(&plan, &largest, UNHEARD);
    let slack = vec![SLACK; charts.len()];
    let found =
        fullest(&problem, coarse.as_ref()).or_else(|| problem.layout(&slack, options.most_cells));
    let longer = f64::from(options.texture.resolution.longer());
    let reached = |scale: f64| scale / options.texture.grid_side() * longer;
    Ok(Enough {
        resolution: found
            .and_then(|layout| resolution(MARGIN * texels / reached(layout.scale), options)),
        pages: pages(&problem, &slack, options),
    })
}

/// Returns a resolution that is `times` as large; `None` if its longer side would exceed [`LONGEST`].
fn resolution(times: f64, options: &AtlasOptions) -> Option<Resolution> {
    let Resolution { width, height } = options.texture.resolution;
    let shorter = times * f64::from(width.min(height));
    let mut shorter = (shorter.min(f64::from(LONGEST)).ceil() as u32).next_multiple_of(WHOLE);
    if options.borders == Borders::OnTexels {
        shorter = shorter.next_power_of_two();
    }
    let [u, v] = options.texture.resolution.halvings();
    let longer = shorter << u.max(v);
    let [width, height] = [longer >> u, longer >> v];
    (longer <= LONGEST).then_some(Resolution { width, height })
}

/// Returns the pages that a layout uses if it may use [`Texture::MOST_PAGES`]; `None` if these are too few.
fn pages(problem: &Problem, slack: &[f64], options: &AtlasOptions) -> Option<u32> {
    let many = AtlasOptions {
        texture: Texture {
            pages: Texture::MOST_PAGES,
            ..options.texture
        },
        ..options.clone()
    };
    let problem = Problem {
        options: &many,
        ..*problem
    };
    let layout = problem.layout(slack, many.most_cells)?;
    let pages = layout.charts.iter().map(|place| place.page + 1);
    pages.max()
}
