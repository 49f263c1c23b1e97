//! Where to cut.

use serde::{Deserialize, Serialize};

use crate::charts::{Bound, Cut, Quality};
use crate::options::options;

/// What becomes of the maps of islands that are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "service", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum KeptMaps {
    /// They are optimized from where they lie.
    #[default]
    Optimized,
    /// They stay as they are but for quarter turns, shifts and one scale; whatever is wrong with
    /// them stays too.
    AsGiven,
}

options! {
    /// Where to cut.
    #[derive(Copy)]
    pub struct Cutting under "Where to cut" {
        /// Where to cut: few charts under a bound on their distortion, more in less time, one per
        /// component, the islands of the present UVs, or along given seams.
        pub cut: Cut = Cut::Auto, arg(help_heading = None::<&'static str>);
        /// How distorted the atlas may be with `cut` auto: the mean symmetric Dirichlet energy is
        /// at most 4.05, 4.1 or 4.5; 4 is an isometry.
        pub quality: Quality = Quality::Balanced, arg(help_heading = None::<&'static str>);
        /// What becomes of the maps of islands with `cut` keep.
        pub kept_maps: KeptMaps = KeptMaps::Optimized;
        /// The most charts that `cut` auto may make for an atlas: where it needs more it allows
        /// more distortion, up to one chart per component.
        pub max_charts: Option<u32>, in 1..=1e9, value "N";
        /// The bound on the mean symmetric Dirichlet energy in the place of what `quality` says; 4
        /// is an isometry.
        ///
        /// It goes with `cut` auto. The report says whether it was kept.
        pub max_distortion: Option<f64>, in 4.0001..=1e6, value "E";
        /// A bound on the stretch max(σ₁, 1/σ₂) that all but a hundredth of the area keeps: more is
        /// cut until it does.
        ///
        /// It goes with `cut` auto. The report says whether it was kept.
        pub max_stretch: Option<f64>, in 1.001..=1e6, value "S";
        /// The price of a seam where charts are cut so that the atlas becomes fuller: 0 cuts
        /// wherever that gains anything, a large number never.
        pub seam_weight: f64 = 1.0, in 0..=1e6, value "W";
    }
}

impl Cutting {
    /// How distorted the atlas may be.
    pub fn bound(&self) -> Bound {
        Bound {
            mean: self.max_distortion.unwrap_or(self.quality.bound()),
            stretch: self.max_stretch,
        }
    }

    /// Whether maps stay as they are given.
    pub(in crate::pipeline) fn are_maps_given(&self) -> bool {
        self.cut == Cut::Keep && self.kept_maps == KeptMaps::AsGiven
    }

    /// Checks what goes with what; the text names the option.
    pub(in crate::pipeline) fn check(&self) -> Result<(), String> {
        for (name, given) in [
            ("max_distortion", self.max_distortion),
            ("max_stretch", self.max_stretch),
        ] {
            if given.is_some() && self.cut != Cut::Auto {
                return Err(format!("`{name}` goes with `cut` auto"));
            }
        }
        Ok(())
    }
}
