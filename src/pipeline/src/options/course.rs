//! Options for additional steps of the solver.

use crate::deform::plan::Plan;
use unwrapd_api::options::options;
use unwrapd_deform::Method;
use unwrapd_method::solver::Settings;

options! {
    /// Additional steps and tolerance of the solver.
    #[derive(Copy)]
    pub struct Course under "Course of the solver" {
        /// Lower the barrier strength as long as the energy without the barrier falls.
        pub barrier_continuation: bool;
        /// Also report the energy that the map tends to as the barrier strength tends to 0. The
        /// difference is the bias of the barrier.
        pub bias: bool;
        /// The minimization ends when a step promises to lower the energy by less than this share.
        /// The default is 1e-6.
        pub tolerance: Option<f64>, in 1e-15..=1e-1, value "SHARE";
    }
}

impl Course {
    pub(super) fn plan(self, method: Method) -> Plan {
        let default = Settings::follow();
        Plan {
            method,
            barrier_continuation: self.barrier_continuation,
            bias: self.bias,
            settings: Settings {
                tolerance: self.tolerance.unwrap_or(default.tolerance),
                ..default
            },
        }
    }
}
