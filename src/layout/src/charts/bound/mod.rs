//! Few charts under a bound on their distortion: disks are slit where one sparse solve predicts most of
//! it, until a map keeps the bound.

mod best_way;
pub(super) mod distortion;
pub(super) mod few_charts;
pub(super) mod pending_chart;
mod planned;
mod predicted_slits;
mod predictor;
pub(super) mod quality;
pub(super) mod redrawn;
pub(super) mod rounds;
mod simplified;
mod slits;
mod slits_alike;
