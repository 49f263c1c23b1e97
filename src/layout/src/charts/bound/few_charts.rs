//! Few charts under a bound on their distortion.

use super::best_way::{Opened, best_opened};
use super::pending_chart::PendingChart;
use super::planned::parted_as_simplified;
use super::quality::{Bound, Bounded};
use super::rounds::{mean_excess, rounds};
use crate::charts::chart::{Chart, Cut};
use crate::charts::give_back::given_back::given_back;
use crate::charts::mapped::{Folds, MappedChart, map_chart};
use crate::charts::observer::Observer;
use crate::charts::opened::{charts, charts_alike, charts_in_ways};
use crate::charts::rough::smoothed_where_rough;
use crate::charts::symmetry::search::mirror_plane;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use unwrapd_maps::embed::{self, is_needle};
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec3::{area_vector, norm};
use unwrapd_method::solver::Control;

/// Triangles of a chart from which on it is first parted as a simplification is.
const LARGE: usize = 50_000;

/// How many ways to open a closed component are tried, on surfaces of at most so many triangles.
const MOST_WAYS: usize = 4;
const TRIED: usize = 200_000;

/// Newton steps at most on a chart of needles, which go on for hundreds without gaining a shape.
const STEPS_FOR_NEEDLES: usize = 10;

/// Whether surfaces that are their own mirror images are cut alike on both sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Symmetry {
    /// Find a mirror plane, exact or near, and cut alike on both sides of it.
    #[default]
    Auto,
    /// Cut without regard to mirror planes.
    Off,
}

/// The charts of a surface, mapped, whose mean symmetric Dirichlet energy keeps the bound where that can be had.
///
/// Each component is opened to a disk, a closed one in the way that promises the shortest seams. Disks are slit where the
/// predictor says that they would be distorted most, until the sum promises to keep the bound. Then they are mapped,
/// parted where a map overlaps itself, and slit further where the maps were worse than promised. The bound is one for all
/// charts: a slit is spent where the excess is largest. Where the stretch is too large the same goes on as for a smaller
/// mean. A surface on which this does not lead below the bound is divided as by [`Cut::Fast`] if that does better. At
/// last small charts are [given back](given_back). A surface of needles, of which no map keeps the shape, is not slit.
///
/// With [`Bounded::Smoothed`] the charts of a rough component are those of the smoothed one, mapped on to the true one.
pub fn charts_under_bound(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    symmetry: Symmetry,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    let smooth = match bound.of {
        Bounded::Smoothed => smoothed_where_rough(surface),
        Bounded::Surface => None,
    };
    let under_bound = |surface| charts_of_surface(surface, bound, options, symmetry, observer);
    let Some(smooth) = smooth else {
        return under_bound(surface);
    };
    (under_bound(&smooth).into_par_iter().with_max_len(1))
        .map(|map| map.on(surface, options, observer))
        .collect()
}

fn charts_of_surface(
    surface: &Surface,
    bound: &Bound,
    options: &embed::Options,
    symmetry: Symmetry,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    if is_mostly_needles(surface) {
        let mut options = options.clone();
        options.solver.max_iterations = STEPS_FOR_NEEDLES;
        return map_all(charts(surface, Cut::Disk), &options, observer);
    }
    let mirror = match symmetry {
        Symmetry::Auto => mirror_plane(surface),
        Symmetry::Off => None,
    };
    let is_tried = surface.triangles.len() <= TRIED;
    let n_ways = if is_tried { MOST_WAYS } else { 1 };
    let ways = charts_in_ways(surface, mirror, n_ways);
    let opened = best_opened(ways, bound, observer);
    if opened.is_empty() {
        return Vec::new();
    }
    let slit = slit_and_mapped(opened, bound, options, observer);
    let given_back = |pieces| {
        given_back(
            surface,
            PendingChart::maps(pieces).collect(),
            bound,
            options,
            observer,
        )
    };
    if mean_excess(&slit) <= bound.budget() || observer.control() == Control::Finish {
        return given_back(slit);
    }
    let divided = map_all(charts_alike(surface, Cut::Fast, mirror), options, observer);
    let divided: Vec<PendingChart> = divided.into_iter().map(PendingChart::of).collect();
    let better = if mean_excess(&divided) < mean_excess(&slit) {
        divided
    } else {
        slit
    };
    given_back(better)
}

fn map_all(
    charts: Vec<Chart>,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<MappedChart> {
    (charts.into_par_iter().with_max_len(1))
        .flat_map_iter(|chart| map_chart(chart, options, Folds::Cut, observer))
        .collect()
}

/// Whether most of the area lies in triangles whose shape no map keeps: slits and divisions cannot lessen that.
fn is_mostly_needles(surface: &Surface) -> bool {
    let (mut area, mut of_needles) = (0.0, 0.0);
    for triangle in &surface.triangles {
        let [a, b, c] = triangle.map(|v| surface.positions[v as usize]);
        let doubled = norm(area_vector(a, b, c));
        area += doubled;
        of_needles += if is_needle([a, b, c]) { doubled } else { 0.0 };
    }
    of_needles > 0.5 * area
}

fn slit_and_mapped(
    opened: Vec<Opened>,
    bound: &Bound,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Vec<PendingChart> {
    let pieces = (opened.into_par_iter().with_max_len(1)).flat_map_iter(|opened| match opened {
        Opened::Whole(chart) if chart.disk.triangles.len() >= LARGE => {
            let parts = parted_as_simplified(chart, bound, options, observer);
            (map_all(parts, options, observer)
                .into_iter()
                .map(PendingChart::of))
            .collect()
        }
        Opened::Whole(chart) => vec![PendingChart::unmapped(chart)],
        Opened::Slit(piece) => vec![*piece],
    });
    rounds(pieces.collect(), bound, options, observer)
}
