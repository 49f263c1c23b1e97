//! What is done beside minimizing once.

use crate::options::options;

options! {
    /// What the solver does besides one minimization.
    #[derive(Copy)]
    pub struct Course under "Course of the solver" {
        /// Lower the barrier strength as long as the energy without the barrier falls.
        pub barrier_continuation: bool;
        /// Also minimize without the barrier and report that energy. The difference is the bias of
        /// the barrier.
        pub bias: bool;
    }
}
