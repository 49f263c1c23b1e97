//! Options of chart mapping.

use unwrapd_api::options::options;
use unwrapd_layout::charts::Cut;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::EnergyKind;

options! {
    /// Mapping of the charts.
    #[derive(Copy)]
    pub struct Mapping under "Energy and barrier" {
        /// Distortion energy to minimize.
        pub energy: EnergyKind = EnergyKind::SymmetricDirichlet;
        /// Barrier that keeps every triangle from inverting. With none, for comparison, flipped
        /// triangles are written and the result is not certified.
        pub barrier: BarrierKind = BarrierKind::InverseSpline;
        /// Barrier strength β.
        pub barrier_strength: f64 = 0.01, in 1e-9..=1e9, value "BETA";
        /// Support s of the inverse-spline barrier, relative to the rest area of an element.
        pub barrier_support: f64 = 1.0, in 1e-6..=1e6, value "S";
        /// Vertices of each chart to hold fixed, on the boundary and far apart: 0 or 2.
        /// Least-squares conformal maps (`energy` lscm) need 2, which requires `cut` disk.
        pub pin: u32 = 0, value "N", schema(maximum = 2);
        /// Keep the map bijective when tools round texture coordinates to this many bits: 12, 14 or
        /// 16. Thin triangles and narrow gaps are opened as far as possible.
        ///
        /// The report says whether that is proven, and which faces are in doubt. Requires a single
        /// page.
        pub quantization_safe: Option<u32>, value "BITS", arg(help_heading = "Atlas"),
            schema(minimum = 12, maximum = 16, multiple_of = 2);
    }
}

impl Mapping {
    /// Checks dependencies between options. The error names the option.
    pub(crate) fn check(&self, cut: Cut) -> Result<(), String> {
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
            (2, _) => Err("`pin` 2 requires `cut` disk".to_owned()),
            (pin, _) => Err(format!("`pin` must be 0 or 2, not {pin}")),
        }
    }
}
