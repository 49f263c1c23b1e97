//! Options for the paths of handles to their targets.

use unwrapd_api::options::options;

options! {
    /// Paths of handles to their targets.
    #[derive(Copy)]
    pub struct Pulling under "Ways to the targets" {
        /// Try all bent ways to the targets, even if the straight ones lead there, and keep the map
        /// with the lowest energy. Costs up to nine minimizations.
        pub search: bool;
    }
}
