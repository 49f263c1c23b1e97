//! One search for where to cut a surface, which improves what the cutters of [`charts`](crate::charts) make, or starts anew.
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
//! Surfaces that consist of panels are divided from scratch ([`from_surface`]): from facets, joined while they stay nearly developable
//! (`pieces`) and glued at strict prices, or from components slit open (`slitting`), whichever cost less. Others start from the charts of
//! the cutters, or from components slit open ([`from_charts`]).
//!
//! Every face is in exactly one net, and every net is a disk, possibly with holes, whose map has neither flips nor overlaps.
//! Not done here: cuts for fill, symmetry.

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
mod slitting;
mod state;

use crate::charts::{
    Bound, Bounded, MappedChart, Observer, Symmetry, mirror_plane, smoothed_where_rough,
};
pub use effort::SearchEffort;
use metric::Metric;
use net::Net;
use nets::Nets;
use panels::{PANEL_FACTOR, panels};
pub use slitting::charts_at_cones;
pub use state::Counts;
use state::Search;
use unwrapd_maps::embed;
use unwrapd_maps::measure::cost::GIVEN_PAGE;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::solver::Control;

/// Prices of the excess, one pass each, from pieces: they make nets of what is flat. With two prices, 64 and 8, the sum of the costs of
/// 11 machine parts is higher by .2, and so it is with a fourth price of 4 (`cost` in the reports of `unwrap`).
const STRICT: [f64; 3] = [128.0, 32.0, 8.0];
/// Prices of the excess from charts: they spend the bound. A third price of 0.5 leaves each less of the effort: seams and charts cost
/// 5 % more on ten machine parts and game assets (`cargo bench -p unwrapd-layout --bench search`).
const LOOSE: [f64; 2] = [8.0, 2.0];
/// Share of the area from which on a surface consists of panels, and is searched without the cutters. Of 27 machine parts and game assets
/// 18 have .65 or more, one .34 and eight at most .20.
const PANELED: f64 = 0.3;

/// Maps of each face that the start from components slit open may take: 1 to 6 on 27 surfaces (`cargo bench -p unwrapd-layout --bench
/// search`).
const OF_START: f64 = 7.0;

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
    /// Lengths, angles and areas; the excess on panels counts [several times](PANEL_FACTOR).
    metric: Metric<'a>,
    bound: Bound,
    /// Share of the area that lies on panels.
    panels: f64,
    /// `true` if the bound is on the surface itself, not on what a rough one is a sample of, whose distortion the search does not measure.
    is_measured: bool,
}

impl<'a> CutProblem<'a> {
    /// Measures a surface. If the observer ends that early, some of its panels are not known.
    pub fn new(surface: &'a Surface, bound: &Bound, observer: &dyn Observer) -> Self {
        let mut metric = Metric::new(surface);
        metric.most_stretch = bound.stretch.unwrap_or(f64::INFINITY);
        let mut panels = 0.0;
        let is_panel = self::panels(&metric, observer);
        let faces = metric.weight.iter_mut().zip(&metric.area).zip(is_panel);
        for ((weight, area), _) in faces.filter(|(_, is_panel)| *is_panel) {
            *weight *= PANEL_FACTOR;
            panels += area;
        }
        let is_of_smoothed =
            bound.of == Bounded::Smoothed && smoothed_where_rough(surface).is_some();
        Self {
            metric,
            bound: *bound,
            panels,
            is_measured: !is_of_smoothed,
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

    /// Returns whether the surface consists of panels, which [`from_surface`] keeps straight and no cutter does.
    pub fn is_paneled(&self) -> bool {
        self.is_measured && self.panels >= PANELED
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

/// Divides a surface into charts that keep a bound on the mean energy, from pieces that are nearly developable or from components slit
/// open.
///
/// Returns the charts and the work that it took. The bound is exceeded only if both starts exceed it: then nothing is glued that adds to
/// the excess. Symmetry does not decide where the search cuts; the charts carry the mirror plane, so that later cuts are made alike.
pub fn from_surface(
    problem: &CutProblem,
    terms: &Terms,
    options: &embed::Options,
    symmetry: Symmetry,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    let metric = &problem.metric;
    let mut search = problem.search(terms, options, observer);
    let most = terms.effort.most;
    search.start_from_pieces(STRICT[0]);
    search.run(&STRICT, most / 2.0);
    let cost = search.cost();
    let pieces = std::mem::replace(&mut search.nets, Nets::new(metric, Vec::new()));
    search.counts.effort.most = f64::midpoint(search.counts.effort.spent(), most);
    if is_slit_open_below(&mut search, cost) {
        search.run(&LOOSE, most);
    } else {
        search.nets = pieces;
        search.run(&LOOSE[1..], most);
    }
    let mirror = match symmetry {
        Symmetry::Auto => mirror_plane(metric.surface),
        Symmetry::Off => None,
    };
    let mut charts = search.charts();
    for map in &mut charts {
        map.chart.mirror = mirror;
    }
    (charts, search.counts)
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

/// Glues charts and gives slits back as long as the charts keep a bound on the mean energy; slits charts that break it.
///
/// The search starts from given charts, which hold every face of the surface once, or from its components slit open if these cost less.
/// Charts that are cut alike on both sides of a plane do not give way, and neither do those of a surface so large that the other start may
/// take all of the effort. The search takes the share of the effort that panels have of the area, or the square of the share that the
/// charts leave of the bound: 17 of 18 organic surfaces, which left less than half of it, gained nothing (`cargo bench -p unwrapd-layout
/// --bench search`). It takes all of the effort if the charts break the bound.
///
/// Returns the charts, and the work that the search took. If the given charts kept the bound, so do those returned. Charts that no move
/// changed stay as they are; so do all if the stretch is bounded.
pub fn from_charts(
    problem: &CutProblem,
    mut charts: Vec<MappedChart>,
    terms: &Terms,
    options: &embed::Options,
    observer: &dyn Observer,
) -> (Vec<MappedChart>, Counts) {
    if problem.bound.stretch.is_some() || observer.control() == Control::Finish {
        return (charts, Counts::new(terms.effort.share(0.0)));
    }
    let CutProblem {
        metric,
        bound,
        panels,
        is_measured,
    } = problem;
    let mut search = problem.search(terms, options, observer);
    search.nets = nets_of(metric, &charts);
    let is_tried = *is_measured
        && !is_symmetric(&charts)
        && terms.effort.most >= OF_START * metric.corners.len() as f64;
    if is_tried {
        let others = search.cost_unweighted();
        if is_slit_open_below(&mut search, others) {
            charts = search.charts();
        }
        search.nets = nets_of(metric, &charts);
    }
    let unspent = 1.0 - search.nets.excess() / bound.budget().max(f64::MIN_POSITIVE);
    let is_broken = *is_measured && search.cost_unweighted()[0] > 0.0;
    let share = if is_broken {
        1.0
    } else {
        panels.max(unspent.max(0.0).powi(2))
    };
    let effort = search.counts.effort.left().share(share);
    let smallest = charts.iter().map(|map| map.chart.corners.len()).min();
    if smallest.is_none_or(|faces| effort.most < faces as f64) {
        return (charts, search.counts);
    }
    let spent = search.counts.effort.spent();
    search.run(&LOOSE, spent + effort.most);
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

/// Returns charts as nets.
fn nets_of<'a>(metric: &'a Metric<'a>, charts: &[MappedChart]) -> Nets<'a> {
    let nets = charts.iter().map(|chart| Net::of_chart(metric, chart));
    Nets::new(metric, nets.collect())
}

/// Returns whether most of the area of some charts is cut alike on both sides of a plane.
fn is_symmetric(charts: &[MappedChart]) -> bool {
    let (mut symmetric, mut area) = (0.0, 0.0);
    for map in charts {
        let own = map.surface_area();
        area += own;
        if map.chart.mirror.is_some() {
            symmetric += own;
        }
    }
    symmetric > 0.5 * area
}
