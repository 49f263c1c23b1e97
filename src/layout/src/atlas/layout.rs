//! The scale of the atlas and a place for every chart.
//!
//! For a given scale the charts are placed greedily, the largest first, each where the used part of the pages
//! grows least. The scale is then corrected by what came out, a few times; the best attempt counts. A scale that is
//! prescribed has one attempt, which fills page after page.
//! What an attempt costs is counted in words read, not in seconds, so the result is the same on
//! every machine.
use super::attempt::{Attempt, Extent, Packing, SLACK};
use super::outline::Outline;
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
/// The search ends when the best scale and one that failed are as near as this. With many charts the fill hardly depends on luck, and
/// every attempt costs more.
const NEAR: f64 = 1.003;
const NEAR_IF_MANY: f64 = 1.005;
/// Maximum number of words of a search for many charts, once the best scale is within `FAIR` of one that failed or of the next: the
/// first leaves up to a fifth of the pages empty.
const WORDS_IF_MANY: u64 = 150_000_000;
const FAIR: f64 = 1.01;
/// Share of the pages that many charts are expected to fill with their padding, and share of the room after an attempt that the next
/// scale aims at, as one that does not fit is in vain.
const HOPE_IF_MANY: f64 = 0.87;
const HASTE: f64 = 0.995;
/// Scales at which a layout with copies alike is tried, relative to the fullest. It may be fuller, as copies lie in rows; the last
/// scale costs 6 % of the fill. With many charts, only scales up to 1 are tried.
const ALIKE: [f64; 5] = [1.06, 1.03, 1.0, 0.985, 0.97];
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
        401..=20_000 => 2048,
        20_001..=1_000_000 => 4096,
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
        is_alike: false,
        extent: match options.scale {
            Scale::Largest => Extent::Growing,
            Scale::TexelsPerUnit(_) => Extent::Full,
        },
    };
    let longer = f64::from(texture.resolution.longer());
    let (scale, attempt) = match options.scale {
        Scale::Largest => {
            let fullest = best(&packing, options.search_words)?;
            let is_tried = |share: &f64| *share <= 1.0 || !packing.is_crowded();
            let scale = density(&fullest) * packing.target();
            let mut shares = ALIKE.into_iter().filter(is_tried);
            let alike = shares.find_map(|share| alike(&packing, share * scale));
            alike.unwrap_or(fullest)
        }
        Scale::TexelsPerUnit(texels) => {
            let scale = texels * f64::from(cells) / longer;
            let any = || Some((scale, packing.attempt(scale, &mut 0).ok()?));
            alike(&packing, scale).or_else(any)?
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

/// Returns a layout with copies alike at a scale; `None` if there are no copies or they do not fit.
fn alike(packing: &Packing, scale: f64) -> Option<(f64, Attempt)> {
    let plan = packing.plan;
    if !plan.outlines.iter().any(|outline| outline.has_copies) {
        return None;
    }
    // The whole page is used from the start, so that copies lie in rows.
    let alike = Packing {
        is_alike: true,
        extent: Extent::Full,
        ..*packing
    };
    let attempt = alike.attempt(scale, &mut 0).ok()?;
    (f64::from(attempt.side) <= packing.target()).then_some((scale, attempt))
}

/// Returns the scale per cell of the used side.
fn density((scale, attempt): &(f64, Attempt)) -> f64 {
    scale / f64::from(attempt.side.max(1))
}

/// The scale (cells per mesh unit) with the best fill, and its layout.
fn best(packing: &Packing, search_words: u64) -> Option<(f64, Attempt)> {
    let known = packing.plan.near.as_ref();
    let (near, most_words) = match known {
        Some(_) => (NEAR_IF_KNOWN, search_words),
        None if packing.is_crowded() => (NEAR_IF_MANY, search_words.min(WORDS_IF_MANY)),
        None => (NEAR, search_words),
    };
    let demand = Demand::of(packing);
    let mut scale = known.map_or_else(
        || {
            demand.scale(if packing.is_crowded() {
                HOPE_IF_MANY
            } else {
                HOPE
            })
        },
        |near| f64::from(packing.cells) / near.extent,
    );
    let mut best: Option<(f64, Attempt)> = None;
    let mut failed = f64::INFINITY;
    let mut work = 0;
    for tried in 1..=ATTEMPTS[1] {
        let next = match packing.attempt(scale, &mut work) {
            Ok(attempt) if f64::from(attempt.side) <= packing.target() => {
                let next = grown(packing, &demand, scale, &attempt);
                let new = (scale, attempt);
                if best
                    .as_ref()
                    .is_none_or(|best| density(&new) > density(best))
                {
                    best = Some(new);
                }
                next.max(near * scale)
            }
            not_yet => {
                failed = failed.min(scale);
                if known.is_some() {
                    LOWERED * scale
                } else {
                    let next = not_yet.map_or_else(
                        |placed| placed.sqrt() * scale,
                        |attempt| grown(packing, &demand, scale, &attempt),
                    );
                    next.clamp(0.5 * scale, scale / near)
                }
            }
        };
        let before = std::mem::replace(&mut scale, next);
        if let Some((good, _)) = best {
            let is_ended = (packing.on_read)(0) == Control::Finish;
            let is_read = work > most_words && failed.min(scale) < good * FAIR;
            let enough = tried >= ATTEMPTS[0] || is_read || failed < good * near;
            if enough || is_ended || packing.plan.order.len() <= 1 || scale == before {
                break;
            }
            if scale >= failed || scale <= good {
                scale = f64::midpoint(good, failed.min(1.1 * good));
            }
        }
    }
    best
}

/// Returns the scale at which a layout would fill the page if it grew evenly. A crowd has the full width from the start: the share of
/// its rows that its charts fill changes little with the scale.
fn grown(packing: &Packing, demand: &Demand, scale: f64, attempt: &Attempt) -> f64 {
    if packing.is_crowded() {
        let [_, rows] = packing.form().reach(packing.whole());
        let used = f64::from(attempt.rows.max(1)) / f64::from(rows * packing.texture.pages);
        demand.scale(HASTE * demand.share(scale) / used)
    } else {
        scale * packing.target() / f64::from(attempt.side.max(1))
    }
}

/// Cells that charts take with their padding and the raster's rounding, as a polynomial of the scale in cells per mesh unit.
struct Demand {
    /// Coefficients of the square, the linear and the constant term: area, margin along outlines, margin at corners.
    terms: [f64; 3],
    /// Cells of all pages.
    pages: f64,
    /// The scale at which the longest chart fits.
    most: f64,
    cells: f64,
}

impl Demand {
    fn of(packing: &Packing) -> Self {
        let outlines = || {
            packing
                .plan
                .order
                .iter()
                .map(|&i| &packing.plan.outlines[i])
        };
        let perimeter: f64 = outlines().map(Outline::perimeter).sum();
        let n = packing.plan.order.len() as f64;
        let around = packing.padding + 1.0;
        let form = packing.form();
        let longest = outlines().map(|outline| form.around(outline.extent));
        let longest = longest.fold(f64::MIN_POSITIVE, f64::max);
        let cells = f64::from(packing.cells);
        Self {
            terms: [
                packing.plan.area(),
                perimeter * around / 2.0,
                n * around * around / 2.0,
            ],
            pages: cells * cells * f64::from(packing.texture.pages) * packing.texture.share(),
            most: (packing.target() - form.most_inset() - SLACK).max(1.0) / longest,
            cells,
        }
    }

    /// Returns the share of the pages that charts take at a scale.
    fn share(&self, scale: f64) -> f64 {
        let [a, b, c] = self.terms;
        (a * scale * scale + b * scale + c) / self.pages
    }

    /// Returns the scale at which charts take a share of the pages, at most that at which the longest chart fits.
    fn scale(&self, share: f64) -> f64 {
        let [a, b, c] = self.terms;
        let missing = (share * self.pages - c).max(1.0);
        let quadratic = 4.0 * a * missing;
        let root = if quadratic > SLIVERS * b * b {
            (-b + (b * b + quadratic).sqrt()) / (2.0 * a)
        } else {
            // Charts that have hardly any area take room along their length; those that are points take none at any scale.
            (missing / b).min(self.cells)
        };
        root.min(self.most)
    }
}
