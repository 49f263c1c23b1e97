//! What a deformation costs, as options of a command.

use super::words::{BARRIERS, DEFORMATIONS, word};
use crate::barrier::BarrierKind;
use crate::deform::{DeformationEnergy, Model};

/// What is minimized while handles are pulled.
#[derive(clap::Args)]
#[command(next_help_heading = "Energy and barrier")]
pub(super) struct ModelArgs {
    /// Deformation energy
    #[arg(long, default_value = "arap", value_parser = word::<DeformationEnergy>(DEFORMATIONS))]
    energy: DeformationEnergy,
    /// Barrier against inversion; `none` is for comparison
    #[arg(long, default_value = "inverse-spline", value_parser = word::<BarrierKind>(BARRIERS))]
    barrier: BarrierKind,
    /// Strength of the barrier; by default the paper's, 100 for green and 0.01 for the others
    #[arg(long, value_name = "X")]
    beta: Option<f64>,
    /// Share of its rest size below which an element feels the inverse spline
    #[arg(long, default_value_t = 1.0, value_name = "X")]
    s: f64,
    /// Keep the conformal distortion of every triangle, its longest over its shortest stretch, below this; plane only
    #[arg(long, value_name = "K")]
    max_conformal: Option<f64>,
    /// Keep the boundary from crossing itself, so that the map stays bijective; plane only
    #[arg(long)]
    bijective: bool,
}

impl ModelArgs {
    pub(super) fn model(&self) -> Model {
        Model {
            energy: self.energy,
            barrier: self.barrier,
            beta: self.beta,
            s: self.s,
            bound: self.max_conformal,
            bijective: self.bijective,
        }
    }
}
