//! The layout that maps form where they lie, squeezed.
//!
//! Charts that are packed again often come from a full page. No search is sure to find its order again, but squeezing keeps it.
use super::effort::OnRead;
use super::gap::{smallest_gap, squeezed_layout};
use super::layout::{Layout, Place, Problem};
use super::outline::{Outline, outlines};
use super::page::Region;
use super::plan::{MOST_CHARTS, Plan};
use super::problem::{AtlasError, AtlasOptions, ChartMap, Rotation};
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

/// Squeezes the charts where they lie. Returns `None` for a crowd, for several pages, without an area, if outlines meet, or if the
/// charts cannot be separated where they are.
pub(super) fn given(
    charts: &[ChartMap],
    options: &AtlasOptions,
    on_read: &OnRead,
) -> Result<Option<Given>, AtlasError> {
    let texture = options.texture;
    let limited = outlines(charts)?.into_iter();
    let limited = limited.map(|outline| outline.limited_to(options.rotation));
    let plan = Plan::largest_first(limited.collect(), Rotation::None);
    let outlines = &plan.outlines;
    let is_one_page = (1..=MOST_CHARTS).contains(&plan.order.len()) && texture.pages == 1;
    if !is_one_page || !plan.has_area() || do_meet(outlines) {
        return Ok(None);
    }
    // The smallest page around all charts.
    let corners = outlines.iter().flat_map(Outline::corners);
    let [low, high] = bounds_of(&corners.collect::<Vec<_>>());
    let around = texture.frame(Region::page(0));
    let longer = around.side([high[0] - low[0], high[1] - low[1]], [0.0; 2]);
    let grid = texture.grid_side();
    let padding = options.padding_share() * grid;
    let scale = (grid - padding) / longer;
    if !scale.is_normal() {
        return Ok(None);
    }
    let place = |outline: &Outline| {
        let middle = outline.middle();
        let corner = |k: usize| (middle[k] - outline.extent[k] / 2.0 - low[k]) * scale;
        Place {
            outline: outline.clone(),
            page: 0,
            corner: [0, 1].map(|k| corner(k) + padding / 2.0),
            stretch: 1.0,
            room: 0.0,
        }
    };
    let found = Layout {
        scale,
        cell: 1.0,
        padding_texels: f64::from(options.padding_texels),
        charts: outlines.iter().map(place).collect(),
    };
    let layout = squeezed_layout(&Problem::free(&plan, options, on_read), &found);
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
