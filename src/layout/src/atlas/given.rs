//! The layout that maps form where they lie, squeezed.
//!
//! Charts that are packed again often come from a full page. No search is sure to find its order again, but squeezing keeps it.
use std::sync::Arc;

use super::coarse::{FINE, raster_side};
use super::effort::OnRead;
use super::gap::{Border, Squeezing, smallest_gap};
use super::layout::Layout;
use super::outline::{Outline, outlines};
use super::page::Region;
use super::plan::{MOST_CHARTS, by_size, mark_copies};
use super::problem::{AtlasError, AtlasOptions, ChartMap};
use super::squeeze::{Pose, Squeezed};
use unwrapd_maps::plane::Straightness;
use unwrapd_method::numerics::bounds::bounds_of;

/// Largest component of an axis across the page for a chart that lies along the axes.
const ACROSS: f64 = 1e-3;

/// Squeezed layout of given maps.
pub(super) struct Given {
    pub layout: Layout,
    pub tidiness: Tidiness,
}

/// State of the straight charts of a layout.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tidiness {
    /// All lie along the axes.
    Straight,
    /// Some lean.
    Leaning,
}

/// Squeezes the charts where they lie. Returns `None` for a crowd, for several pages, if outlines meet, or if the charts cannot be
/// separated where they are.
pub(super) fn given(
    charts: &[ChartMap],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Option<Given>, AtlasError> {
    let texture = options.texture;
    let limited = outlines(charts)?.into_iter();
    let mut outlines: Vec<Outline> = limited
        .map(|outline| outline.limited_to(options.rotation))
        .collect();
    mark_copies(&mut outlines);
    let order = by_size(&outlines.iter().collect::<Vec<_>>());
    let is_one_page = (1..=MOST_CHARTS).contains(&order.len()) && texture.pages == 1;
    if !is_one_page || do_meet(&outlines) {
        return Ok(None);
    }
    // The smallest page around all charts.
    let corners = outlines.iter().flat_map(Outline::corners);
    let [low, high] = bounds_of(&corners.collect::<Vec<_>>());
    let frame = texture.frame(Region::page(0));
    let longer = frame.side([high[0] - low[0], high[1] - low[1]], [0.0; 2]);
    let page = FINE * f64::from(texture.raster(raster_side(order.len(), texture)));
    let padding = options.padding_share() * page;
    let scale = (page - padding) / longer;
    if !scale.is_normal() {
        return Ok(None);
    }
    let pose = |&chart: &usize| {
        let middle = outlines[chart].middle();
        Pose::new([0, 1].map(|k| (middle[k] - low[k]) * scale), 0.0)
    };
    let posed = order.iter().map(|chart| (pose(chart), frame));
    let squeezed = Squeezed::new(posed, Arc::default(), page, padding);
    let squeezing = Squeezing {
        level: &outlines,
        charts: &order,
        scale,
        border: Border::Cropped,
        stays: &[],
        options,
        on_read,
    };
    let layout = squeezing.settled_layout(squeezed);
    let lean = |outline: &Outline| match outline.straightness {
        Straightness::Upright(axis) => axis[0].abs().min(axis[1].abs()) > ACROSS,
        Straightness::Leaning(_) | Straightness::Round => false,
    };
    let tidiness = if outlines.iter().any(lean) {
        Tidiness::Leaning
    } else {
        Tidiness::Straight
    };
    Ok(layout.map(|layout| Given { layout, tidiness }))
}

/// Returns whether two outlines meet where they lie. Stacked charts do: separating them one by one would take long and give no layout
/// that was there.
fn do_meet(outlines: &[Outline]) -> bool {
    let mut edges = Vec::new();
    let mut charts = Vec::new();
    for (chart, outline) in (0..).zip(outlines) {
        edges.extend(outline.with_corner([0.0; 2]).edges());
        charts.resize(edges.len(), chart);
    }
    smallest_gap(&edges, &charts) <= 0.0
}
