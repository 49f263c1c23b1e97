//! Options of cutting.

use serde::{Deserialize, Serialize};

use unwrapd_api::options::options;
use unwrapd_layout::charts::{Bound, Bounded, Cut, Quality, Symmetry};

/// Treatment of the maps of kept islands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum KeptMaps {
    /// Optimize each map from its present position.
    #[default]
    Optimized,
    /// Keep each map, except for quarter turns, shifts and one common scale. Its defects stay, too.
    AsGiven,
}

options! {
    /// Where to cut.
    #[derive(Copy)]
    pub struct Cutting under "Where to cut" {
        /// Where to cut. auto: few charts under a distortion bound. fast: more charts in less time.
        /// disk: one chart per component. keep: the present UV islands. seams: along `seams`.
        pub cut: Cut = Cut::Auto, arg(help_heading = None::<&'static str>);
        /// Distortion bound of `cut` auto: a mean symmetric Dirichlet energy of at most 4.05, 4.1
        /// or 4.5. An isometry has 4.
        ///
        /// Where a surface is rough, as a noisy scan is, the bound is one on the smoothed surface,
        /// unless `max_distortion` or `max_stretch` is given. The report says so.
        pub quality: Quality = Quality::Balanced, arg(help_heading = None::<&'static str>);
        /// Treatment of the map of each island with `cut` keep.
        pub kept_maps: KeptMaps = KeptMaps::Optimized;
        /// Maximum number of charts that `cut` auto makes per atlas. If more are needed, it allows
        /// more distortion, up to one chart per component.
        pub max_charts: Option<u32>, in 1..=1e9, value "N";
        /// Bound on the mean symmetric Dirichlet energy, in place of the one that `quality` sets.
        /// An isometry has 4.
        ///
        /// Requires `cut` auto. The report says whether the bound was kept.
        pub max_distortion: Option<f64>, in 4.0001..=1e6, value "E";
        /// Bound on the 99th percentile of the stretch max(σ₁, 1/σ₂), weighted by area. Charts are
        /// cut until they keep it.
        ///
        /// Requires `cut` auto. The report says whether the bound was kept.
        pub max_stretch: Option<f64>, in 1.001..=1e6, value "S";
        /// Price of seams that are cut only to fill the atlas better. With 0 every gain is taken; a
        /// large number prevents such cuts.
        pub seam_weight: f64 = 1.0, in 0..=1e6, value "W";
        /// Let `cut` auto cut both sides of a mirror plane alike. auto: where a surface is its own
        /// mirror image, exactly or nearly. off: nowhere.
        pub symmetry: Symmetry = Symmetry::Auto;
    }
}

impl Cutting {
    /// Returns the bound on the distortion of the atlas.
    pub fn bound(&self) -> Bound {
        Bound {
            mean: self.max_distortion.unwrap_or(self.quality.bound()),
            stretch: self.max_stretch,
            of: match (self.max_distortion, self.max_stretch) {
                (None, None) => Bounded::Smoothed,
                _ => Bounded::Surface,
            },
        }
    }

    /// Checks dependencies between options. The error names the option.
    pub(crate) fn check(&self) -> Result<(), String> {
        for (name, given) in [
            ("max_distortion", self.max_distortion),
            ("max_stretch", self.max_stretch),
        ] {
            if given.is_some() && self.cut != Cut::Auto {
                return Err(format!("`{name}` requires `cut` auto"));
            }
        }
        Ok(())
    }
}
