//! What would do where charts do not fit at the scale that is asked for.

use super::draft::Draft;
use super::layout::layout;
use super::pack::best;
use super::plan::Plan;
use super::texture::Texture;
use super::{AtlasOptions, Borders, Enough, Scale};
use crate::certificate::Resolution;

/// By how much a larger texture exceeds what the best layout needs: searches in two textures differ.
const MARGIN: f64 = 1.03;
/// The shorter side of a texture is a multiple of so many texels.
const WHOLE: u32 = 16;
/// The longest side of a texture.
const LONGEST: u32 = 65_536;

/// A resolution, and a number of pages, that would do for so many texels per mesh unit.
pub(super) fn enough(
    first: &Plan,
    draft: Option<&Draft>,
    slack: &[f64],
    texels: f64,
    options: &AtlasOptions,
) -> Enough {
    Enough {
        resolution: resolution(first, draft, slack, texels, options),
        pages: pages(first, slack, options),
    }
}

/// That at which the fullest layout has so many texels per unit.
fn resolution(
    first: &Plan,
    draft: Option<&Draft>,
    slack: &[f64],
    texels: f64,
    options: &AtlasOptions,
) -> Option<Resolution> {
    let texture = options.texture;
    let largest = AtlasOptions {
        scale: Scale::Largest,
        ..options.clone()
    };
    let (_, layout) = best(first, draft, slack, &largest)?;
    let reached = layout.scale / texture.grid_side() * f64::from(texture.resolution.longer());
    let shorter = MARGIN * texels / reached * f64::from(texture.resolution.shorter());
    let mut shorter = (shorter.min(f64::from(LONGEST)).ceil() as u32).next_multiple_of(WHOLE);
    if options.borders == Borders::OnTexels {
        shorter = shorter.next_power_of_two();
    }
    let ratio = texture.resolution.longer() / texture.resolution.shorter().max(1);
    let longer = shorter * ratio;
    let is_upright = texture.resolution.width < texture.resolution.height;
    let [width, height] = if is_upright {
        [shorter, longer]
    } else {
        [longer, shorter]
    };
    (longer <= LONGEST).then_some(Resolution { width, height })
}

/// As many as a layout uses that may use all there can be.
fn pages(first: &Plan, slack: &[f64], options: &AtlasOptions) -> Option<u32> {
    let texture = Texture {
        pages: Texture::MOST_PAGES,
        ..options.texture
    };
    let many = AtlasOptions {
        texture,
        ..options.clone()
    };
    let layout = layout(first, slack, &many)?;
    let pages = layout.charts.iter().map(|(spot, _)| spot.corner.page + 1);
    pages.max()
}
