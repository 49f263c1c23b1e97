//! The objective by which cuts for fill are judged.

use unwrapd_layout::atlas::{AtlasOptions, Scale, Texture};
use unwrapd_layout::charts::{MappedChart, seam_length};
use unwrapd_maps::measure::cost::{ANY_PAGE, GIVEN_PAGE, seam_cost};
use unwrapd_maps::mesh::Resolution;

/// Longest page on which a square layout may be judged: 8:1, in halvings of its shorter side.
const MOST_HALVINGS: u32 = 3;

/// Pages on which the fill of a layout is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pages {
    /// The page that is asked for.
    Given,
    /// The square and the best of the pages 1:1, 2:1, 4:1 and 8:1, alike: the page is square because nothing else was asked for.
    Any,
}

impl Pages {
    /// Returns the pages on which charts for these options are judged.
    pub fn of(options: &AtlasOptions) -> Self {
        let Texture { resolution, pages } = options.texture;
        let is_square = resolution.width == resolution.height;
        if pages == 1 && is_square && options.scale == Scale::Largest {
            Self::Any
        } else {
            Self::Given
        }
    }

    /// Returns the options for the longer ones of the pages, with the padding that is the same share of the page's area.
    pub fn longer(self, options: &AtlasOptions) -> Vec<AtlasOptions> {
        let halvings = match self {
            Self::Given => 0,
            Self::Any => MOST_HALVINGS,
        };
        let longer = |n: u32| {
            let side = options.texture.resolution.height;
            let padding = f64::from(options.padding_texels) * f64::from(1_u32 << n).sqrt();
            let mut longer = options.clone();
            longer.texture.resolution = Resolution {
                width: side << n,
                height: side,
            };
            longer.padding_texels = padding.round() as u32;
            longer
        };
        (1..=halvings).map(longer).collect()
    }
}

/// The [cost of a layout](unwrapd_maps::measure::cost) as cuts change it, from the charts before any cut for fill.
#[derive(Clone, Copy, Debug)]
pub struct Objective {
    /// Length of the seams before any cut.
    pub seams: f64,
    pub pages: Pages,
    /// Square root of the surface's area.
    side: f64,
    n_components: usize,
    /// Cost of the seams before any cut.
    before: f64,
    /// Share of the page that one unit of the seams' cost is worth.
    weight: f64,
}

impl Objective {
    /// Creates the objective for charts of a surface with `n_components` components; `seam_weight` multiplies the cost of seams.
    pub fn new(
        charts: &[MappedChart],
        n_components: usize,
        seam_weight: f64,
        pages: Pages,
    ) -> Self {
        let area: f64 = charts.iter().map(MappedChart::surface_area).sum();
        let fill_weight = match pages {
            Pages::Given => GIVEN_PAGE,
            Pages::Any => ANY_PAGE,
        };
        let mut objective = Self {
            seams: seam_length(charts),
            pages,
            side: area.sqrt().max(f64::MIN_POSITIVE),
            n_components,
            before: 0.0,
            weight: seam_weight / fill_weight,
        };
        objective.before = objective.seam_cost(objective.seams, charts.len());
        objective
    }

    fn seam_cost(&self, seams: f64, n_charts: usize) -> f64 {
        let n_extra = n_charts.saturating_sub(self.n_components);
        seam_cost(seams / self.side, n_extra)
    }

    /// Returns the cost of the cuts that led to these seams and charts, as a share of the page.
    pub fn cost_of_cuts(&self, seams: f64, n_charts: usize) -> f64 {
        self.weight * (self.seam_cost(seams, n_charts) - self.before)
    }
}
