//! The plan of a run: what is cut, mapped, glued, compacted and packed.

use super::compact::CutTerms;
use super::settings::Settings;
use crate::PipelineError;
use crate::options::{KeptMaps, Mapping, Stacking, Straightening};
use unwrapd_layout::atlas::{GRID_BITS, Rotation};
use unwrapd_layout::charts::{Bound, Cut, Folds, Symmetry};
use unwrapd_maps::embed::{self, Pins};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver;

/// Treatment of charts from the first cut to the layout. Computed once from the options; no later stage asks where to
/// cut or whether there is a barrier.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Where a surface is cut first.
    pub cut: Cut,
    /// Start of a chart's map.
    pub start: Start,
    /// Options of chart mapping.
    pub embedding: embed::Options,
    /// `true` if the result must be valid.
    pub is_promised: bool,
    /// Bound on the distortion of charts.
    pub bound: Bound,
    /// Bound that the report judges, if it judges one.
    pub reported_bound: Option<Bound>,
    /// Symmetric cuts on both sides of a mirror plane.
    pub symmetry: Symmetry,
    /// Treatment of charts after their first cut.
    pub refinement: Refinement,
    /// Charts whose nearly straight borders become straight.
    pub straighten: StraightCharts,
    /// Maximum number of charts in one atlas.
    pub most_charts: Option<u32>,
    /// `true` if seams are moved off the diagonals of polygons: not where a caller says where to cut.
    pub keeps_polygons: bool,
    /// Cone singularities to slit each component to; `None` where a component is only opened.
    pub cones: Option<Cones>,
    /// Treatment of charts that overlap themselves.
    pub folds: Folds,
    /// Price of seams that only make the atlas fuller; `None` if no chart is cut for that.
    pub compaction: Option<f64>,
    /// Effort of the search for layouts.
    pub search: Search,
    /// Charts that share their texels.
    pub stacking: Stacking,
    /// Distance along u between the first chart of a stack and the others, in units of the grid.
    pub stack_shift: i32,
    /// Permitted rotations of charts.
    pub rotation: Rotation,
    /// `true` if charts are first turned so that the top of the mesh points up.
    pub is_turned_up: bool,
    /// Bits per coordinate at which the map must stay bijective.
    pub safe_bits: Option<u32>,
}

/// Choice of the cone singularities.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cones {
    /// This number in each component.
    Number(u32),
    /// As many as the bound on the distortion needs.
    UnderBound,
    /// Those that a caller [gives](super::seams::Seams::cones).
    Given,
}

/// Start of a chart's map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// A map of its own.
    New,
    /// The present UVs, which are optimized.
    Present,
    /// The present UVs, which stay.
    Final,
}

/// Treatment of charts after their first cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refinement {
    /// They are cut until they keep the bound, and glued where that pays.
    UnderBound,
    /// The parts of those that overlapped are glued again where that pays.
    Glued,
    /// Nothing.
    None,
}

/// Charts whose nearly straight borders become straight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StraightCharts {
    /// Those that take no more room on the page then.
    All,
    /// Those whose faces are [selected](super::control::FaceRules::straightens), on any page.
    Selected,
    None,
}

/// Effort of the search for layouts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// As long as pays.
    Full,
    /// Just long enough for one layout.
    Brief,
}

impl Plan {
    /// Derives the plan from the settings.
    ///
    /// # Errors
    /// If the energy is a formula that is not an energy of triangles.
    pub fn new(settings: &Settings) -> Result<Self, PipelineError> {
        let Settings {
            cutting,
            mapping,
            layout,
            ..
        } = settings;
        let cut = cutting.cut;
        let start = match (cut, cutting.kept_maps) {
            (Cut::Keep, KeptMaps::AsGiven) => Start::Final,
            (Cut::Keep, KeptMaps::Optimized) => Start::Present,
            _ => Start::New,
        };
        let has_barrier = mapping.barrier != BarrierKind::None;
        let is_promised = has_barrier && start != Start::Final;
        // A request for one chart per component excludes further seams, unless cones make it overlap itself.
        let cones = match (cutting.cones, cutting.max_distortion) {
            (Some(n), _) => Some(Cones::Number(n)),
            (None, Some(_)) if cut == Cut::Disk => Some(Cones::UnderBound),
            (None, _) => None,
        };
        let may_cut_again = is_promised && (cut != Cut::Disk || cones.is_some());
        let seam_price = cutting.seam_weight * cutting.quality.seam_price();
        Ok(Self {
            cut,
            start,
            embedding: embedding(mapping)?,
            is_promised,
            bound: cutting.bound(),
            reported_bound: (cut == Cut::Auto || cones == Some(Cones::UnderBound))
                .then(|| cutting.bound()),
            symmetry: cutting.symmetry,
            refinement: match cut {
                Cut::Auto if has_barrier => Refinement::UnderBound,
                Cut::Disk if has_barrier && cones == Some(Cones::UnderBound) => {
                    Refinement::UnderBound
                }
                Cut::Keep | Cut::Seams if may_cut_again => Refinement::Glued,
                _ => Refinement::None,
            },
            straighten: match &settings.straighten {
                // Given maps, and those that may flip, stay as they are unless the caller asks for more.
                None if start == Start::New && has_barrier => StraightCharts::All,
                None | Some(Straightening::Off) => StraightCharts::None,
                Some(Straightening::Auto) => StraightCharts::All,
                Some(Straightening::Selected(_)) => StraightCharts::Selected,
            },
            most_charts: cutting.max_charts,
            cones,
            keeps_polygons: is_promised && !matches!(cut, Cut::Keep | Cut::Seams),
            folds: if may_cut_again {
                Folds::Cut
            } else {
                Folds::Keep
            },
            compaction: (may_cut_again && cut == Cut::Auto).then_some(seam_price),
            search: match cut {
                Cut::Fast => Search::Brief,
                _ => Search::Full,
            },
            stacking: layout.stack.unwrap_or_default(),
            stack_shift: i32::from(layout.stack_offset) << GRID_BITS,
            rotation: layout.rotate,
            is_turned_up: match start {
                Start::New => true,
                Start::Present => layout.rotate == Rotation::Any,
                Start::Final => false,
            },
            safe_bits: mapping.quantization_safe,
        })
    }

    /// Returns the plan with cones at given vertices.
    ///
    /// # Errors
    /// If the plan keeps no component whole, or chooses the cones.
    pub fn with_given_cones(self) -> Result<Self, PipelineError> {
        if self.cut != Cut::Disk || self.cones.is_some() {
            return Err(PipelineError::InvalidOptions(
                "cones at given vertices require `cut` disk without `cones` and `max_distortion`"
                    .to_owned(),
            ));
        }
        Ok(Self {
            cones: Some(Cones::Given),
            folds: if self.is_promised {
                Folds::Cut
            } else {
                Folds::Keep
            },
            ..self
        })
    }

    /// Returns the terms of cuts that only make the atlas fuller, for a mesh with `n_components` components; `None` if no chart is
    /// cut for that.
    pub fn cut_terms(&self, n_components: usize) -> Option<CutTerms> {
        self.compaction.map(|seam_weight| CutTerms {
            seam_weight,
            n_components,
            most_charts: self.most_charts,
        })
    }

    /// Returns whether parts and charts of one shape are stacked.
    pub fn stacks_by_shape(&self) -> bool {
        matches!(self.stacking, Stacking::Identical | Stacking::Mirrored)
    }

    /// Returns whether the present UVs are read.
    pub fn reads_uvs(&self) -> bool {
        self.start != Start::New
    }
}

fn embedding(mapping: &Mapping) -> Result<embed::Options, PipelineError> {
    let density = mapping.density().map_err(PipelineError::InvalidOptions)?;
    Ok(embed::Options {
        barrier: mapping.barrier,
        beta: mapping.beta(&*density),
        s: mapping.barrier_support,
        barrier_continuation: mapping.barrier_continuation,
        density,
        pins: match mapping.pin {
            0 => Pins::None,
            _ => Pins::Two,
        },
        solver: solver::Settings::default(),
        weights: Vec::new(),
    })
}
