//! One search for where to cut a surface.
//!
//! A *net* is a set of faces with its slits and its map. The search lowers
//!
//! ```text
//! ln(1/2 + S + n/10) + w (1 − F)   subject to   ∫ (E − 4) ≤ bound
//! ```
//!
//! S is the length of the seams, n the number of nets and E the symmetric Dirichlet energy of their maps, in units in which
//! the surface has area 1. F estimates the fill of a square page, less than usual if one net alone sets the scale; w is its
//! weight. This is the [cost of a layout](unwrapd_maps::measure::cost) as far as it is known before packing. The moves know
//! no classes of surfaces. Distortion has a price λ that falls from strict to loose, so what the bound allows is spent where it
//! saves the most seam.
//!
//! A move opens the faces of one net, or of two neighbors, in another way (`moves`):
//!
//! - Neighbors are *glued*: with the slits that both have; without those that end at their border, which unites tubes; or at a hinge,
//!   one stretch of their border, which makes the nets of polyhedra.
//! - Slits of a net are *given back*, whole or by half.
//! - While the bound is broken, nets without slits are slit.
//!
//! To each of these ways, slits are added while they pay (`opening`), by a prediction of the distortion that needs no map
//! (`prediction`). Only ways that promise to pay are mapped (`net`), from the maps of the parts where these can be laid together
//! (`laid_together`). Parts that collide are not mapped, and neither are those that keep their shapes. A map that flips or overlaps,
//! and cannot be pushed apart, rejects the way. Moves wait in one queue, the one that gains most for its work first, until the effort
//! is spent (`effort`).
//!
//! On panels the excess counts 16 times, in the map, the prediction and the bound (`panels`): they stay straight, and what is round
//! beside them takes the distortion. The bound on this weighted mean is one on the plain mean as well.
//!
//! Lengths and whatever else decides are rounded, so that parts that are alike tie, and the order of the faces decides between them,
//! not the rounding of their vertices ([`tied`](unwrapd_method::numerics::ties::tied)): pose, scale and digits seldom change the cut.
//!
//! The search starts from components that are slit open until their maps keep the bound (`slitting`). Surfaces that consist of panels,
//! and those on which slits do not lead below the bound, also start from facets, joined while they stay nearly developable (`pieces`)
//! and glued at strict prices; the search goes on from whichever costs less.
//!
//! A surface that is its own mirror image is slit and parted alike on both sides (`alike`). Large components are slit as a simplification
//! of them is (`simplified`).
//!
//! Every face is in exactly one net, and every net is a disk, possibly with holes, whose map has neither flips nor overlaps.
//! Not done here: cuts for fill. Moves do not see symmetry.

mod alike;
mod cones;
mod cut_mesh;
mod effort;
mod laid_together;
mod metric;
mod moves;
mod net;
mod nets;
mod opening;
mod panels;
mod pieces;
mod prediction;
mod sets;
mod simplified;
mod slitting;
mod state;

use crate::charts::{
    Bound, Bounded, Cut, Folds, MappedChart, Observer, Symmetry, charts, map_chart, mirror_plane,
    smoothed_where_rough,
};
pub use cones::{charts_at_cones, charts_through};
pub use effort::SearchEffort;
use metric::Metric;
use net::Net;
use nets::Nets;
use rayon::prelude::*;
pub use state::Counts;
use state::Search;
use unwrapd_maps::embed;
use unwrapd_maps::measure::cost::GIVEN_PAGE;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::vec3::{area_vector, norm};
use unwrapd_method::solver::Control;

/// Prices of the excess, one pass each, from pieces: they make nets of what is flat. With two prices, 64 and 8, the sum of the costs of
/// 11 machine parts is higher by .2, and so it is with a fourth price of 4 (`cost` in the reports of `unwrap`).
const STRICT: [f64; 3] = [128.0, 32.0, 8.0];
/// Prices of the excess from charts: they spend the bound. A third price of 0.5 leaves each less of the effort: seams and charts cost
/// 5 % more on ten machine parts and game assets (`cargo bench -p unwrapd-layout --bench search`).
const LOOSE: [f64; 2] = [8.0, 2.0];
/// Share of the area from which on a surface consists of panels, and is divided from facets as well. Of 27 machine parts and game assets
/// 18 have .65 or more, one .34 and eight at most .20.
const PANELED: f64 = 0.3;

/// Newton steps at most on a chart of needles, which go on for hundreds without gaining a shape.
const STEPS_FOR_NEEDLES: usize = 10;

/// Terms of a search.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// The most work that may be done.
    pub effort: SearchEffort,
    /// Weight of the fill of a square page beside the cost of the seams: 1 over the weight of a seam.
    pub fill_weight: f64,
}

impl Default for Terms {
    fn default() -> Self {
        Self {
            effort: SearchEffort::UNBOUNDED,
            fill_weight: GIVEN_PAGE,
        }
    }
}

/// A surface to divide under a bound on the distortion, measured.
pub struct CutProblem<'a> {
    /// Lengths, angles and areas; the excess on panels counts [several times](panels::PANEL_FACTOR).
    metric: Metric<'a>,
    bound: Bound,
    /// Share of the area that lies on panels.
    panels: f64,
}

impl<'a> CutProblem<'a> {
    /// Measures a surface. If the observer ends that early, some of its panels are not known.
    pub fn new(surface: &'a Surface, bound: &Bound, observer: &dyn Observer) -> Self {
        let mut metric = Metric::new(surface);
        metric.most_stretch = bound.stretch.unwrap_or(f64::INFINITY);
        Self {
            panels: metric.weigh_panels(observer),
            metric,
            bound: *bound,
        }
    }

    /// Returns the surface.
    pub fn surface(&self) -> &'a Surface {
        self.metric.surface
    }

    /// Returns the bound on the distortion.
    pub fn bound(&self) -> &Bound {
        &self.bound
    }

    /// Sets another bound on the same kind of distortion.
    pub fn set_bound(&mut self, bound: &Bound) {
        self.metric.most_stretch = bound.stretch.unwrap_or(f64::INFINITY);
        self.bound = *bound;
    }

    /// Returns for each face how often its excess counts: more on panels.
    pub fn weights(&self) -> Vec<f64> {
        let faces = self.metric.weight.iter().zip(&self.metric.area);
        let factor = |(weight, area): (&f64, &f64)| if *area > 0.0 { weight / area } else { 1.0 };
        faces.map(factor).collect()
    }

    /// Returns whether the surface consists of panels.
    pub fn is_paneled(&self) -> bool {
        self.panels >= PANELED
    }

    fn search<'b>(
        &'b self,
        terms: &Terms,
        options: &'b embed::Options,
        observer: &'b dyn Observer,
    ) -> Search<'b> {
        Search::new(&self.metric, self.bound.budget(), terms, options, observer)
    }
}

/// Divides a surface into charts that keep a bound on the mean energy, from components slit open or from pieces that are nearly
/// developable.
///
/// Returns the charts and the work that it took. The bound is exceeded only if both starts exceed it: then nothing is glued that adds to
/// the excess. Components are slit and parted alike on both sides of a mirror plane, unless the surface consists of panels; the moves
/// ignore the plane. The charts carry it for later cuts. No map keeps the shape of needles, so a surface of needles is only opened to
/// disks. Rough surfaces are cut as their smoothed versions, and then mapped.
pub fn from_surface(
    problem: &CutProblem,
    terms: &Terms,
    options: &embed::Options,
    symmetry: Symmetry,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let CutProblem { metric, bound, .. } = problem;
    let surface = metric.surface;
    if bound.of == Bounded::Smoothed
        && let Some(smooth) = smoothed_where_rough(surface)
    {
        let bound = Bound {
            of: Bounded::Surface,
            ..*bound
        };
        let problem = CutProblem::new(&smooth, &bound, observer);
        let (charts, counts) = from_surface(&problem, terms, options, symmetry, observer);
        let charts =
            (charts.into_par_iter().with_max_len(1)).map(|map| map.on(surface, options, observer));
        return (charts.collect(), counts);
    }
    let mut search = problem.search(terms, options, observer);
    if is_mostly_needles(surface) {
        let mut options = options.clone();
        options.solver.max_iterations = STEPS_FOR_NEEDLES;
        let charts = charts(surface, Cut::Disk).into_par_iter().with_max_len(1);
        let maps = charts.flat_map_iter(|chart| map_chart(chart, &options, Folds::Cut, observer));
        return (maps.collect(), search.counts);
    }
    let mirror = match symmetry {
        Symmetry::Auto => mirror_plane(surface),
        Symmetry::Off => None,
    };
    if problem.is_paneled() && observer.control() == Control::Continue {
        divide_panels(&mut search);
    } else {
        search.mirror = mirror;
        divide_components(&mut search);
    }
    let mut charts = search.charts();
    for map in &mut charts {
        map.chart.mirror = mirror;
    }
    (charts, search.counts)
}

/// Searches from pieces glued at strict prices, or from components slit open if these cost less.
fn divide_panels(search: &mut Search) {
    let most = search.counts.effort.most;
    search.start_from_pieces(STRICT[0]);
    search.run(&STRICT, most / 2.0);
    let cost = search.cost();
    let pieces = search.take_nets();
    search.counts.effort.most = f64::midpoint(search.counts.effort.spent(), most);
    if is_slit_open_below(search, cost) {
        search.run(&LOOSE, most);
    } else {
        search.nets = pieces;
        search.run(&LOOSE[1..], most);
    }
}

/// Searches from components slit open, or from pieces if those break the bound and these cost less. The effort does not limit the
/// starts. Moves from components have what these leave of it, moves from pieces all of it.
fn divide_components(search: &mut Search) {
    let most = std::mem::replace(&mut search.counts.effort.most, f64::INFINITY);
    let is_open = search.start_from_components(f64::INFINITY).is_some();
    search.counts.effort.most = most;
    let is_going_on = search.observer.control() == Control::Continue;
    if !is_open || search.is_broken() && is_going_on {
        let open = search.take_nets();
        search.start_from_pieces(STRICT[0]);
        let most = search.counts.effort.spent() + most;
        search.counts.effort.most = most;
        search.run(&STRICT, most);
        let cost = search.cost_unweighted();
        let pieces = std::mem::replace(&mut search.nets, open);
        if !is_open || cost < search.cost_unweighted() {
            search.nets = pieces;
        }
    }
    search.spend_rest();
}

/// Returns whether most of the area lies in triangles whose shape no map keeps, or there is none: slits do not lessen that.
fn is_mostly_needles(surface: &Surface) -> bool {
    let (mut area, mut of_needles) = (0.0, 0.0);
    for face in 0..surface.triangles.len() {
        let [a, b, c] = surface.corners(face);
        let doubled = norm(area_vector(a, b, c));
        area += doubled;
        of_needles += if embed::is_needle([a, b, c]) {
            doubled
        } else {
            0.0
        };
    }
    of_needles >= 0.5 * area
}

/// Opens each component to a disk, possibly with holes, by slits to as many cone singularities as the bound on the mean energy needs, and
/// parts the maps that overlap themselves. Returns `None` if a component cannot be opened.
///
/// The bound is that of all components together: cones are where they relieve most for the length of their slits. It is exceeded where no
/// further slit helps. Test: `search::cones_are_chosen_to_a_bound`.
pub fn maps_at_cones_under_bound(
    problem: &CutProblem,
    options: &embed::Options,
    observer: &dyn Observer,
) -> Option<Vec<MappedChart>> {
    let mut search = problem.search(&Terms::default(), options, observer);
    search.start_from_components(f64::INFINITY)?;
    Some(search.charts())
}

/// Glues charts and gives slits back as long as that adds to the excess no more than the bound leaves.
///
/// Returns the charts, and the work that the search took. Charts that no move changed stay as they are; so do all if the stretch is
/// bounded. Edges along which the surface is cut stay cut.
pub fn from_charts(
    problem: &CutProblem,
    charts: Vec<MappedChart>,
    terms: &Terms,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let CutProblem { metric, bound, .. } = problem;
    let mut search = problem.search(terms, options, observer);
    if bound.stretch.is_some() || observer.control() == Control::Finish {
        return (charts, search.counts);
    }
    let nets = charts.iter().map(|chart| Net::of_chart(metric, chart));
    search.nets = Nets::new(metric, nets.collect());
    search.budget = search.budget.max(search.nets.excess());
    search.run(&LOOSE, terms.effort.most);
    // Nets are numbered in the order of the charts; changed ones have later numbers.
    let found = search.nets.list.iter();
    let found = found.filter_map(|(&number, net)| match charts.get(number as usize) {
        Some(chart) => Some(chart.clone()),
        None => net.mapped_chart(metric),
    });
    (found.collect(), search.counts)
}

/// Slits the components of the surface open; returns whether these nets cost less than some others, compared as by [`Search::cost`].
/// If not, it leaves nets that the caller must replace.
fn is_slit_open_below(search: &mut Search, others: [f64; 2]) -> bool {
    let [beyond, cost] = others;
    let most = if beyond > 0.0 { f64::INFINITY } else { cost };
    search.start_from_components(most).is_some() && search.cost_unweighted() < others
}
