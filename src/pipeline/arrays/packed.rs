//! The charts of one mesh in an atlas, cut and opened as it takes.

use rayon::prelude::*;

use super::chart_maps::chart_maps;
use super::clearance::open_charts;
use super::compact::{Drafted, compacted};
use super::plan::Plan;
use crate::atlas::{self, Atlas, AtlasError, AtlasOptions, Draft, OnRead, Placed, Scale, Turns};
use crate::charts::{Folds, MappedChart};
use crate::pipeline::PipelineError;

/// Atlases packed at most because rounding made a chart overlap itself. One that was cut there does so again only where
/// another scale rounds it differently.
const PACKINGS: usize = 8;

/// Times that charts are opened for rounding at most: what is opened takes room, at a smaller scale more is too thin.
const OPENINGS: usize = 4;

/// The share of pages that charts are hoped to fill at a scale that is given.
const HOPE: f64 = 0.85;
/// The search on fewer pages than there may be costs such a part of the search on all.
const FEWER_PAGES: u64 = 4;

/// The charts of one mesh in an atlas, at a scale that is given on as few pages as were found to do.
pub fn packed(
    mut charts: Vec<MappedChart>,
    options: &AtlasOptions,
    plan: &Plan,
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), PipelineError> {
    if options.turns == Turns::Any {
        charts.par_iter_mut().for_each(MappedChart::turn_up);
    }
    let Scale::TexelsPerUnit(texels) = options.scale else {
        return Ok(settled(
            drafted(charts, options, plan, on_read)?,
            options,
            plan,
            on_read,
        )?);
    };
    if atlas::fits(&chart_maps(&charts), options)? {
        let whole = Drafted {
            charts,
            draft: None,
        };
        return Ok(settled(whole, options, plan, on_read)?);
    }
    let mut last = Vec::new();
    for pages in page_numbers(&charts, texels, options) {
        let mut tried = options.clone();
        tried.texture.pages = pages;
        if pages < options.texture.pages {
            tried.search_words /= FEWER_PAGES;
        }
        let drafted = drafted(charts.clone(), &tried, plan, on_read)?;
        last.clone_from(&drafted.charts);
        match settled(drafted, &tried, plan, on_read) {
            Err(AtlasError::TextureTooSmall) => {}
            done => return Ok(done?),
        }
    }
    let enough = atlas::enough(&chart_maps(&last), options)?;
    Err(PipelineError::TextureTooSmall(enough))
}

/// The numbers of pages to be tried: the least that could do, one more, and all.
fn page_numbers(charts: &[MappedChart], texels: f64, options: &AtlasOptions) -> Vec<u32> {
    let area: f64 = charts.iter().map(MappedChart::area).sum();
    let resolution = options.texture.resolution;
    let page = HOPE * f64::from(resolution.width) * f64::from(resolution.height);
    let most = options.texture.pages;
    let least = (texels * texels * area / page).min(f64::from(most)) as u32;
    let mut numbers = [least + 1, least + 2, most]
        .map(|pages| pages.min(most))
        .to_vec();
    numbers.dedup();
    numbers
}

/// Cut where that makes the atlas fuller.
fn drafted(
    charts: Vec<MappedChart>,
    options: &AtlasOptions,
    plan: &Plan,
    on_read: &OnRead,
) -> Result<Drafted, AtlasError> {
    match plan.compaction {
        Some(seam_price) => compacted(charts, options, (seam_price, plan.most_charts), on_read),
        None => Drafted::new(charts, options),
    }
}

/// Where rounding to the grid made a chart overlap itself it is cut once more, where one is too thin for the bits it shall be safe at
/// it is opened, and all are packed again.
fn settled(
    drafted: Drafted,
    options: &AtlasOptions,
    plan: &Plan,
    on_read: &OnRead,
) -> Result<(Vec<MappedChart>, Atlas), AtlasError> {
    let Drafted {
        mut charts,
        mut draft,
    } = drafted;
    let (mut rounds, mut openings) = (0, 0);
    loop {
        let atlas = atlas::pack_draft(&chart_maps(&charts), draft.as_ref(), options, on_read)?;
        if openings < OPENINGS
            && plan
                .safe_bits
                .is_some_and(|bits| open_charts(&mut charts, atlas.scale, bits))
        {
            openings += 1;
            draft = Draft::new(&chart_maps(&charts), options)?;
            continue;
        }
        rounds += 1;
        if plan.folds == Folds::Keep || rounds == PACKINGS {
            return Ok((charts, atlas));
        }
        let n_before = charts.len();
        let unfolded = |(chart, placed): (MappedChart, &Placed)| {
            let rounded: Vec<[f64; 2]> = placed.grid.iter().map(|p| p.map(f64::from)).collect();
            chart.unfolded(&rounded, &|| on_read(0))
        };
        charts = (charts.into_par_iter().zip(&atlas.placed))
            .flat_map_iter(unfolded)
            .collect();
        if charts.len() == n_before {
            return Ok((charts, atlas));
        }
        draft = Draft::new(&chart_maps(&charts), options)?;
    }
}
