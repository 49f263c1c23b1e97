//! The scale of the atlas and a place for every chart.
//!
//! For a given scale the charts are placed greedily, the largest first, each where the used part of the pages
//! grows least. The scale is then corrected by what came out, a few times; the best attempt counts. A scale that is
//! prescribed has one attempt, which fills page after page.
//! What an attempt costs is counted in words read, not in seconds, so the result is the same on
//! every machine.
use super::attempt::{Attempt, Extent, Packing, SLACK};
use super::plan::{HOPE, Plan};
use super::spot::Spot;
use super::{AtlasOptions, OnRead, Scale};
use unwrapd_method::solver::Control;

/// Where all charts lie.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    /// Grid steps per mesh unit.
    pub scale: f64,
    /// Grid steps per cell.
    pub cell: f64,
    /// Free cells at each border.
    pub border: f64,
    /// How far vertices may be moved beyond their charts' slack, in cells.
    pub spare: f64,
    /// Distance kept between charts, in texels.
    pub padding_texels: f64,
    /// For each chart its place, and the factor by which it exceeds the common scale.
    pub charts: Vec<(Spot, f64)>,
}

/// Scales tried at most, and at most until one fits (each is then smaller by some per cent).
const ATTEMPTS: [usize; 2] = [12, 400];
/// Scales tried at least, however many words that reads: the first leaves up to a fifth of the pages of a crowd empty.
const LEAST_ATTEMPTS: usize = 3;
/// The search ends when the best scale and one that failed are as near as this. With many charts the
/// fill hardly depends on luck, and every attempt costs more.
const NEAR: f64 = 1.003;
const NEAR_IF_MANY: f64 = 1.005;
/// The same for a layout that is known from a coarser raster, and by how much the scale is lowered should it not fit.
const NEAR_IF_KNOWN: f64 = 1.0005;
const LOWERED: f64 = 0.993;

/// Cells along a side of a square, of which each chart has some 16 along its own.
pub(super) fn raster(n_charts: usize, most_cells: u32) -> u32 {
    match n_charts {
        0..=400 => {
            let least = (256 * n_charts as u32).isqrt().next_power_of_two();
            most_cells.clamp(least, 1024)
        }
        401..=2_000 => 2048,
        2_001..=1_000_000 => 4096,
        _ => 16384,
    }
}

/// Cells kept free between charts.
pub(super) fn padding(options: &AtlasOptions, n_charts: usize, cells: f64) -> f64 {
    let texture = options.texture;
    // The smallest charts, with their padding, take at most half of the pages.
    let pages = f64::from(texture.pages) * texture.share();
    let most = (cells / (2.0 * n_charts as f64 / pages).sqrt() - 2.0).max(0.0);
    let longer = f64::from(texture.resolution.longer().max(1));
    (f64::from(options.packed_texels()) * cells / longer).min(most)
}

/// The best layout found of a plan; none when there are more charts than cells.
pub(super) fn layout(
    plan: &Plan,
    slack: &[f64],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Option<Layout> {
    let texture = options.texture;
    let on_page = plan.order.len() / texture.pages.max(1) as usize;
    let cells = texture.raster(raster(on_page, options.most_cells));
    let padding = padding(options, plan.order.len(), f64::from(cells));
    let border = (padding / 2.0).max(SLACK);
    let packing = Packing {
        plan,
        slack,
        texture,
        cells,
        padding,
        border,
        on_read,
        taken: None,
        extent: match options.scale {
            Scale::Largest => Extent::Growing,
            Scale::TexelsPerUnit(_) => Extent::Full,
        },
    };
    let longer = f64::from(texture.resolution.longer());
    let (scale, attempt) = match options.scale {
        Scale::Largest => best(&packing, options.search_words)?,
        Scale::TexelsPerUnit(texels) => {
            let scale = texels * f64::from(cells) / longer;
            (scale, packing.attempt(scale, &mut 0).ok()?)
        }
    };
    let used = match options.scale {
        Scale::Largest => f64::from(attempt.side.max(1)) + 2.0 * border,
        Scale::TexelsPerUnit(_) => f64::from(cells),
    };
    let cell = texture.grid_side() / used;
    Some(Layout {
        scale: scale * cell,
        cell,
        border,
        spare: 0.0,
        padding_texels: (padding * longer / f64::from(cells))
            .min(f64::from(options.padding_texels)),
        charts: attempt.spots,
    })
}

/// Charts whose area takes a smaller share of their room than this are lines: the difference of roots would be rounding.
pub(super) const SLIVERS: f64 = 1e-9;

/// The scale (cells per mesh unit) with the best fill, and its layout.
fn best(packing: &Packing, search_words: u64) -> Option<(f64, Attempt)> {
    let known = packing.plan.near.as_ref();
    let near = match known {
        Some(_) => NEAR_IF_KNOWN,
        None if packing.is_crowded() => NEAR_IF_MANY,
        None => NEAR,
    };
    let mut scale = known.map_or_else(
        || first_scale(packing),
        |near| f64::from(packing.cells) / near.extent,
    );
    let mut best: Option<(f64, Attempt)> = None;
    let mut failed = f64::INFINITY;
    let mut work = 0;
    for tried in 1..=ATTEMPTS[1] {
        scale *= match packing.attempt(scale, &mut work) {
            Ok(attempt) if f64::from(attempt.side) <= packing.target() => {
                let room = room(packing, &attempt);
                let density = |scale: f64, attempt: &Attempt| scale / f64::from(attempt.side);
                let new = density(scale, &attempt);
                if best
                    .as_ref()
                    .is_none_or(|(scale, best)| new > density(*scale, best))
                {
                    best = Some((scale, attempt));
                }
                room.max(near)
            }
            not_yet => {
                failed = failed.min(scale);
                if known.is_some() {
                    LOWERED
                } else {
                    let room = not_yet.map_or_else(f64::sqrt, |attempt| room(packing, &attempt));
                    room.clamp(0.5, 1.0 / near)
                }
            }
        };
        if let Some((good, _)) = best {
            let is_ended = (packing.on_read)(0) == Control::Finish;
            let is_read = tried >= LEAST_ATTEMPTS && work > search_words;
            let enough = tried >= ATTEMPTS[0] || is_read || failed < good * near;
            if enough || is_ended || packing.plan.order.len() <= 1 {
                break;
            }
            if scale >= failed || scale <= good {
                scale = f64::midpoint(good, failed.min(1.1 * good));
            }
        }
    }
    best
}

/// The factor by which a layout could grow if it grew evenly. The pages of many charts have their
/// full width from the start, so that their area grows with the rows alone.
fn room(packing: &Packing, attempt: &Attempt) -> f64 {
    if packing.is_crowded() {
        let [_, rows] = packing.form().reach(packing.target() as u32);
        let rows = f64::from(rows * packing.texture.pages);
        (rows / f64::from(attempt.rows.max(1))).sqrt()
    } else {
        packing.target() / f64::from(attempt.side.max(1))
    }
}

/// The scale at which the areas, with their padding and the raster's rounding, fill the hoped-for
/// share: the root of a quadratic; and at most the scale at which the longest chart fits.
fn first_scale(packing: &Packing) -> f64 {
    let perimeter: f64 = packing
        .plan
        .order
        .iter()
        .map(|&i| packing.plan.outlines[i].perimeter())
        .sum();
    let n = packing.plan.order.len() as f64;
    let around = packing.padding + 1.0;
    let (a, b) = (packing.plan.area(), perimeter * around / 2.0);
    let cells = f64::from(packing.cells);
    let pages = f64::from(packing.texture.pages) * packing.texture.share();
    let c = n * around * around / 2.0 - HOPE * cells * cells * pages;
    let quadratic = -4.0 * a * c.min(-1.0);
    let root = if quadratic > SLIVERS * b * b {
        (-b + (b * b + quadratic).sqrt()) / (2.0 * a)
    } else {
        // Charts that have hardly any area take room along their length; those that are points take none at any scale.
        (-c.min(-1.0) / b).min(cells)
    };
    let form = packing.form();
    let extents = packing
        .plan
        .order
        .iter()
        .map(|&i| packing.plan.outlines[i].extent);
    let longest = extents.map(|extent| form.around(extent));
    let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
    root.min((packing.target() - form.most_inset() - SLACK).max(1.0) / longest)
}
