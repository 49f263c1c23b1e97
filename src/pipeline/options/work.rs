//! What the work may take.

use crate::options::options;

options! {
    /// What works.
    #[derive(Copy)]
    pub struct Workers under "Time" {
        /// Threads to use; all that are allowed if absent. The result does not depend on it.
        pub threads: Option<usize>, in 1..=1024, value "N";
    }
}

options! {
    /// How long the work may take.
    #[derive(Copy)]
    pub struct Budget under "Time" {
        /// Seconds after which the current valid map is taken as it is.
        pub time_budget: Option<f64>, in 0..=1e6, value "SECONDS";
    }
}
