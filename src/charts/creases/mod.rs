//! Hard surfaces: charts that begin and end at creases.
//!
//! Planes, cylinders, cones and bent sheets can be laid flat without distortion. A component that
//! consists of such parts is divided at its creases ([`Creases`](smooth_regions::Creases)),
//! each region is opened to a disk and mapped by itself, and regions are laid side by side as rigid
//! pieces wherever they have a straight border in common and do not cover each other
//! ([`joined`](joined::joined)): a box becomes a cross, sheet metal its blank. No distortion of one
//! part pays for another.

pub(super) mod hard_components;
mod joined;
mod smooth_regions;
