//! What is done beside minimizing once.

use crate::options::options;

options! {
    /// What is done beside minimizing once.
    #[derive(Copy)]
    pub struct Course under "Course of the solver" {
        /// Lower the barrier's strength while the energy without it falls.
        pub barrier_continuation: bool;
        /// Also minimize without a barrier and report that energy beside the solution's: the
        /// barrier's bias.
        pub bias: bool;
    }
}
