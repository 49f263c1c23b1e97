//! Which ways handles go.

use unwrapd_api::options::options;

options! {
    /// Which ways handles go.
    #[derive(Copy)]
    pub struct Pulling under "Ways to the targets" {
        /// Try all bent ways to the targets, even if the straight ones lead there, and keep the map
        /// with the lowest energy. Costs up to nine minimizations.
        pub search: bool;
    }
}
