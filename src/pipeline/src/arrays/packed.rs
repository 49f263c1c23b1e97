//! Packing of the charts of one mesh, which are cut and opened as needed.

use rayon::prelude::*;

use super::chart_maps::chart_maps;
use super::clearance::open_charts;
use super::compact::{Before, CoarseAtlas, CutTerms, MOST_CHARTS, compacted};
use super::plan::Plan;
use crate::PipelineError;
use unwrapd_layout::atlas::{
    self, Atlas, AtlasError, AtlasOptions, CoarseLayout, OnRead, Placed, Scale,
};
use unwrapd_layout::charts::{Folds, MappedChart, PolygonHome, with_whole_polygons};
use unwrapd_method::solver::Control;

/// Maximum number of packings because rounding made a chart overlap itself. A chart that was cut for this overlaps
/// itself again only if another scale rounds it differently.
pub const PACKINGS: usize = 8;

/// Maximum number of openings for rounding: opened places take room, and at the smaller scale more places are too
/// thin.
const OPENINGS: usize = 4;

/// Texels along the longer side of the largest texture.
const LARGEST: u32 = 65_536;

/// Share of the pages that charts are expected to fill at a given scale.
const HOPE: f64 = 0.85;
/// Divisor of the search budget for layouts on more than one page, compared with a single page: each number of pages
/// has a search of its own.
const PER_PAGE: u64 = 4;

/// Terms on which the charts of a mesh are cut and opened before they are packed.
#[derive(Clone, Copy)]
pub struct ChartTerms<'a> {
    pub plan: &'a Plan,
    /// Price of cuts that make the atlas fuller; `None` if there are none.
    pub cuts: Option<CutTerms>,
    /// Numbers of polygon corners, if polygons stay whole.
    pub polygons: Option<&'a [[u32; 3]]>,
}

/// Packs the charts of one mesh into an atlas; at a given scale, on the smallest number of pages found to be enough.
///
/// Tries each number of pages in turn, beginning with the charts that were cut for the one before. The attempts do
/// not depend on the maximum number of pages, so a larger maximum never gives less.
pub fn packed(
    charts: Vec<MappedChart>,
    terms: ChartTerms,
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), PipelineError> {
    let charts = terms.prepared(charts);
    match options.scale {
        Scale::Largest => Ok(largest(charts, (options, terms), on_read)?),
        Scale::TexelsPerUnit(texels) => fewest(charts, texels, (options, terms), on_read),
    }
}

/// Returns the largest layout on any number of pages.
fn largest(
    charts: Vec<MappedChart>,
    (options, terms): (&AtlasOptions, ChartTerms),
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), AtlasError> {
    let most = options.texture.pages;
    // Of a crowd the fill grows evenly with the pages.
    let least = if charts.len() > MOST_CHARTS { most } else { 1 };
    let on = |pages: u32, charts: (Vec<MappedChart>, Before)| {
        let on = on_pages(pages, options);
        let coarse_atlas = coarse_atlas(charts, &on, terms.cuts, on_read)?;
        let settled = coarse_atlas.map(|coarse_atlas| settled(coarse_atlas, &on, terms, on_read));
        settled.transpose()
    };
    let first = |pages: u32, charts: Vec<MappedChart>| {
        let first = on(pages, (charts, Before::Nothing))?;
        // There is one: any scale exceeds none.
        first.ok_or(AtlasError::TextureTooSmall)
    };
    if least == most {
        return first(most, charts);
    }
    let mut best = first(least, charts.clone());
    for pages in least + 1..=most {
        if on_read(0) == Control::Finish {
            break;
        }
        best = match best {
            Err(_) => first(pages, charts.clone()),
            Ok(best) => match on(pages, (best.0.clone(), Before::FewerPages(best.1.scale))) {
                Ok(Some(next)) if next.1.scale > best.1.scale => Ok(next),
                _ => Ok(best),
            },
        };
    }
    best
}

/// Returns a layout on the smallest number of pages on which one is found at a given scale.
fn fewest(
    charts: Vec<MappedChart>,
    texels: f64,
    (options, terms): (&AtlasOptions, ChartTerms),
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), PipelineError> {
    if atlas::fits(&chart_maps(&charts), options)? {
        let whole = CoarseAtlas {
            charts,
            layout: None,
        };
        return Ok(settled(whole, options, terms, on_read)?);
    }
    let least = least_pages(&charts, texels, options);
    let mut last = (charts, Before::Nothing);
    for pages in least..=options.texture.pages {
        let on = on_pages(pages, options);
        let coarse_atlas =
            coarse_atlas(last, &on, terms.cuts, on_read)?.ok_or(AtlasError::TextureTooSmall)?;
        last = (coarse_atlas.charts.clone(), Before::FewerPages(0.0));
        match settled(coarse_atlas, &on, terms, on_read) {
            Err(AtlasError::TextureTooSmall) => {}
            done => return Ok(done?),
        }
    }
    let mut enough = atlas::enough(&chart_maps(&last.0), options)?;
    // The estimate ends at the largest texture, which may be too small as well.
    let largest = enough.resolution.filter(|it| it.longer() == LARGEST);
    if let Some(largest) = largest {
        let mut on = options.clone();
        on.texture.resolution = largest;
        let whole = CoarseAtlas {
            charts: last.0,
            layout: None,
        };
        match settled(whole, &on, terms, on_read) {
            Err(AtlasError::TextureTooSmall) => enough.resolution = None,
            tried => drop(tried?),
        }
    }
    Err(PipelineError::TextureTooSmall(enough))
}

/// Returns the options for packing on this number of pages.
fn on_pages(pages: u32, options: &AtlasOptions) -> AtlasOptions {
    let mut on = options.clone();
    on.texture.pages = pages;
    if pages > 1 {
        on.budget_words /= PER_PAGE;
    }
    on
}

/// Returns the least number of pages that could be enough.
fn least_pages(charts: &[MappedChart], texels: f64, options: &AtlasOptions) -> u32 {
    let area: f64 = charts.iter().map(MappedChart::area).sum();
    let resolution = options.texture.resolution;
    let page = HOPE * f64::from(resolution.width) * f64::from(resolution.height);
    let most = options.texture.pages;
    ((texels * texels * area / page).min(f64::from(most)) as u32 + 1).min(most)
}

/// Cuts charts where that makes the atlas fuller; returns `None` if no cut can exceed the scale that was reached
/// before.
fn coarse_atlas(
    charts: (Vec<MappedChart>, Before),
    options: &AtlasOptions,
    terms: Option<CutTerms>,
    on_read: &OnRead,
) -> Result<Option<CoarseAtlas>, AtlasError> {
    match terms {
        Some(terms) => compacted(charts, options, terms, on_read),
        None => CoarseAtlas::new(charts.0, options).map(Some),
    }
}

/// Packs the charts, with polygons in one piece. If rounding to the grid makes a chart overlap itself, it is cut once more; if a chart is too
/// thin for the requested bits, it is opened; then all are packed again.
fn settled(
    coarse_atlas: CoarseAtlas,
    options: &AtlasOptions,
    terms: ChartTerms,
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), AtlasError> {
    let plan = terms.plan;
    let CoarseAtlas {
        mut charts,
        mut layout,
    } = coarse_atlas;
    let (mut rounds, mut openings) = (0, 0);
    loop {
        // A polygon that was cut again because rounding made its chart overlap itself gets a chart of its own.
        let home = match rounds {
            0 => PolygonHome::WithPart,
            _ => PolygonHome::Own,
        };
        if let Some(whole) = terms.with_whole_polygons(&charts, home) {
            charts = whole;
            layout = CoarseLayout::new(&chart_maps(&charts), options)?;
        }
        let atlas = atlas::pack_coarse(&chart_maps(&charts), layout.as_ref(), options, on_read)?;
        if openings < OPENINGS
            && plan
                .safe_bits
                .is_some_and(|bits| open_charts(&mut charts, atlas.scale, bits))
        {
            openings += 1;
            layout = CoarseLayout::new(&chart_maps(&charts), options)?;
            continue;
        }
        rounds += 1;
        if plan.folds == Folds::Keep || rounds == PACKINGS {
            return Ok((charts, atlas));
        }
        let n_before = charts.len();
        charts = unfolded(charts, &atlas.placed, on_read);
        if charts.len() == n_before {
            return Ok((charts, atlas));
        }
        layout = CoarseLayout::new(&chart_maps(&charts), options)?;
    }
}

/// Cuts charts that rounding to the grid makes overlap themselves.
pub fn unfolded(charts: Vec<MappedChart>, placed: &[Placed], on_read: &OnRead) -> Vec<MappedChart> {
    let parts = |(chart, placed): (MappedChart, &Placed)| {
        let rounded: Vec<[f64; 2]> = placed.grid.iter().map(|p| p.map(f64::from)).collect();
        chart.unfolded(&rounded, &|| on_read(0))
    };
    (charts.into_par_iter().zip(placed))
        .flat_map_iter(parts)
        .collect()
}

impl ChartTerms<'_> {
    /// Returns charts with polygons in one piece, and with the top of the mesh up where the plan says so.
    pub fn prepared(&self, charts: Vec<MappedChart>) -> Vec<MappedChart> {
        let whole = self.with_whole_polygons(&charts, PolygonHome::WithPart);
        let mut charts = whole.unwrap_or(charts);
        if self.plan.is_turned_up {
            charts.par_iter_mut().for_each(MappedChart::turn_up);
        }
        charts
    }

    /// Moves seams off the diagonals of polygons; returns `None` if there are none. Where the charts would be too many, polygons that
    /// need one of their own stay split.
    fn with_whole_polygons(
        &self,
        charts: &[MappedChart],
        home: PolygonHome,
    ) -> Option<Vec<MappedChart>> {
        let polygons = self.polygons?;
        let most = self.plan.most_charts.map_or(usize::MAX, |n| n as usize);
        let whole = with_whole_polygons(charts, polygons, home)?;
        if whole.len() <= most.max(charts.len()) {
            return Some(whole);
        }
        let whole = with_whole_polygons(charts, polygons, PolygonHome::OnlyWithPart)?;
        (whole.len() <= most.max(charts.len())).then_some(whole)
    }
}
