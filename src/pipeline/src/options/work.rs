//! Options for threads and time.

use unwrapd_api::options::options;

options! {
    /// Number of threads.
    #[derive(Copy)]
    pub struct Workers under "Time" {
        /// Number of threads. The default is all that are allowed. The result does not depend on
        /// it.
        pub threads: Option<usize>, in 1..=1024, value "N";
    }
}

options! {
    /// Time limit.
    #[derive(Copy)]
    pub struct Budget under "Time" {
        /// Time limit in seconds. When it is reached, the current map, which is valid, becomes the
        /// result.
        pub time_budget: Option<f64>, in 0..=1e6, value "SECONDS";
    }
}
