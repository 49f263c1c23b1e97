//! Hard surfaces: charts that begin and end at creases.
//!
//! Planes, cylinders, cones and bent sheets can be laid flat without distortion. A component that
//! consists of such parts is divided at its creases ([`Creases`](smooth_regions::Creases)). Each
//! region is opened to a disk and mapped by itself. Regions with a straight border in common are
//! joined as rigid pieces if neither covers the other ([`joined`](joined::joined)): a box becomes a
//! cross, sheet metal its blank. Distortion of one part never pays for another.

pub(super) mod hard_components;
mod joined;
mod smooth_regions;
