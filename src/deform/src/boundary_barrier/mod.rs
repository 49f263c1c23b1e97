//! Barrier that keeps the boundary of a map of the plane from crossing itself.
//!
//! A map without inverted triangles is bijective as long as its boundary does not meet itself, and a boundary that
//! moves continuously first meets itself where one of its vertices touches one of its edges. So besides the barrier of
//! elements there is one for such pairs: zero while they are apart, infinite as their distance goes to zero. With steps
//! that end before the first contact no iterate has crossed: that is decided along the whole step (`term`), not at
//! its ends.
//!
//! The set of near pairs changes as the map moves, and with it the pattern of the Hessian. The pattern is neither
//! approximated nor kept: pairs have full blocks, a search finds them anew at every point, and when a pair comes near
//! that the pattern lacks, the pattern is analyzed again with all pairs within twice the support, so that this is rare
//! ([`Term::renew`]).
//!
//! From: Smith and Schaefer 2015, Bijective Parameterization with Free Boundaries, with Newton's method in the place of
//! theirs and the support of each pair no wider than its distance at the start, so that nothing moves where nothing
//! pulls. The time of contact is that of Li, Kaufman, Jiang 2021, Codimensional Incremental Potential Contact:
//! conservative under rounding.
//!
//! [`Term::renew`]: unwrapd_method::energy::Term::renew

mod gap;
mod pairs;
mod term;

pub use term::BoundaryBarrier;
