//! Options of chart mapping.

use std::sync::Arc;
use unwrapd_api::options::options;
use unwrapd_layout::charts::Cut;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::{Density, DensityKind};

options! {
    /// Mapping of the charts.
    pub struct Mapping under "Energy and barrier" {
        /// Distortion energy to minimize: a name, or a formula of the singular values of a triangle,
        /// s1 and s2, as `(s1 - 1)^2 + (s2 - 1)^2`. A formula must be symmetric, and smooth and
        /// minimal at 1. Bounds on distortion are bounds on the symmetric Dirichlet energy, whichever
        /// energy is minimized.
        pub energy: DensityKind = DensityKind::SymmetricDirichlet, arg(value_parser = unwrapd_api::options::WordOrText::<DensityKind>::new());
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
    /// Returns the energy of a triangle. The error names the option.
    pub(crate) fn density(&self) -> Result<Arc<dyn Density<2>>, String> {
        self.energy.planar().map_err(|error| {
            format!("`energy` is neither the name of an energy nor the formula of one: {error}")
        })
    }

    /// Checks the energy and dependencies between options. The error names the option.
    pub(crate) fn check(&self, cut: Cut) -> Result<(), String> {
        self.density()?;
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
