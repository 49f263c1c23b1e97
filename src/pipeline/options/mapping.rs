//! How charts are mapped.

use crate::barrier::BarrierKind;
use crate::charts::Cut;
use crate::energy::EnergyKind;
use crate::options::options;

options! {
    /// How charts are mapped.
    #[derive(Copy)]
    pub struct Mapping under "Energy and barrier" {
        /// Distortion energy to minimize.
        pub energy: EnergyKind = EnergyKind::SymmetricDirichlet;
        /// Barrier that keeps every triangle from inverting; none is for comparison: what flips
        /// without it is written, and is not certified.
        pub barrier: BarrierKind = BarrierKind::InverseSpline;
        /// Weight β of the barrier.
        pub barrier_strength: f64 = 0.01, in 1e-9..=1e9, value "BETA";
        /// Support s of the inverse spline, relative to an element's rest area.
        pub barrier_support: f64 = 1.0, in 1e-6..=1e6, value "S";
        /// Vertices of each chart's boundary that are held, far from each other: 0, or with `cut`
        /// disk 2, as least-squares conformal maps (`energy` lscm) need them.
        pub pin: u32 = 0, value "N", schema(maximum = 2);
        /// Bits that tools will round the texture coordinates to, 12, 14 or 16: thin triangles and
        /// narrow gaps are opened so that the map stays bijective, as far as that is possible.
        ///
        /// The report says whether that is proven, and which faces are in doubt. It goes with one
        /// page.
        pub quantization_safe: Option<u32>, value "BITS", arg(help_heading = "Atlas"),
            schema(minimum = 12, maximum = 16, multiple_of = 2);
    }
}

impl Mapping {
    /// Checks what goes with what; the text names the option.
    pub(in crate::pipeline) fn check(&self, cut: Cut) -> Result<(), String> {
        match self.quantization_safe {
            None | Some(12 | 14 | 16) => {}
            Some(bits) => {
                return Err(format!(
                    "`quantization_safe` must be 12, 14 or 16, not {bits}"
                ));
            }
        }
        match (self.pin, cut) {
            (0, _) | (2, Cut::Disk) => Ok(()),
            (2, _) => Err("`pin` 2 goes with `cut` disk".to_owned()),
            (pin, _) => Err(format!("`pin` must be 0 or 2, not {pin}")),
        }
    }
}
