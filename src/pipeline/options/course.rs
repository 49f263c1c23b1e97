//! What is done beside minimizing once.

use crate::options::options;

options! {
    /// What the solver does besides one minimization.
    #[derive(Copy)]
    pub struct Course under "Course of the solver" {
        /// Lower the barrier strength as long as the energy without the barrier falls.
        pub barrier_continuation: bool;
        /// Also report the energy that the map tends to as the barrier strength tends to 0. The
        /// difference is the bias of the barrier.
        pub bias: bool;
    }
}
