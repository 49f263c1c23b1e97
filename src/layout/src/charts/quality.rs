//! What the distortion of an atlas is bounded by.

use serde::{Deserialize, Serialize};

/// How evenly the surface is spread over the atlas: a bound on the mean symmetric Dirichlet energy (its minimum, for an
/// isometry, is 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
pub enum Quality {
    /// Mean energy of at most 4.05.
    Smooth,
    /// Mean energy of at most 4.1.
    #[default]
    Balanced,
    /// Mean energy of at most 4.5: few charts, visibly distorted.
    Few,
}

impl Quality {
    /// The bound.
    pub fn bound(self) -> f64 {
        match self {
            Self::Smooth => 4.05,
            Self::Balanced => 4.1,
            Self::Few => 4.5,
        }
    }

    /// What a seam costs that is there only to fill the square, beside what it costs else: who wants few charts wants no more of
    /// them for the sake of texels.
    pub fn seam_price(self) -> f64 {
        match self {
            Self::Smooth | Self::Balanced => 1.0,
            Self::Few => 25.0,
        }
    }

    /// The least bound of those that are larger than this one.
    pub fn looser_than(mean: f64) -> Option<f64> {
        let bounds = [Self::Smooth, Self::Balanced, Self::Few].map(Self::bound);
        bounds.into_iter().find(|&bound| bound > mean)
    }
}

/// The share of the budget that is spent; the rest is for what rounding to the grid of the atlas adds.
const MARGIN: f64 = 0.99;

/// The share of the area that may be stretched more than the bound says.
const STRETCHED_SHARE: f64 = 0.01;

/// How distorted an atlas may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The largest mean symmetric Dirichlet energy; its minimum is 4.
    pub mean: f64,
    /// The largest stretch max(σ₁, 1/σ₂) of all but a hundredth of the area; its minimum is 1.
    pub stretch: Option<f64>,
    /// What is bounded.
    pub of: Bounded,
}

/// The surface whose distortion is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema))]
pub enum Bounded {
    /// The surface as it is.
    Surface,
    /// The surface [smoothed where it is rough](crate::charts::smoothed_where_rough).
    Smoothed,
}

impl Bound {
    /// The mean excess over the minimum of 4 that may be spent.
    pub(crate) fn budget(&self) -> f64 {
        MARGIN * (self.mean - 4.0)
    }

    /// The share of the area that may be stretched more.
    pub(crate) fn stretched_budget() -> f64 {
        MARGIN * STRETCHED_SHARE
    }
}
