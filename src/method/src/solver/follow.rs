//! Handles pulled to their targets, every iterate a valid map.

use super::handles::{Handles, HandlesError};
use super::journey::Journey;
use super::objective::Objective;
use super::pace::Pace;
use super::path::Rotation;
use super::settings::{Settings, Summary};
use super::watch::Watch;
use crate::numerics::square::{Matrix, Square};

/// Moves the handles along their path to one station after another, the other vertices following; at each minimizes `objective`
/// with the handles held.
///
/// Each iteration is one factorization and two or more solves: the Newton step with the handles held, and how the vertices
/// follow an advance of the handles to first order. Both are taken together, the advance no longer than inversions and the
/// quadratic model allow. The energy may rise while the handles travel; no iterate leaves the domain, in which `x` must
/// be. Where the handles cannot advance the rest settles first; if that gives them no room either, the map is the nearest
/// valid one on their path and the status [`Status::TargetsUnreachable`](super::Status::TargetsUnreachable).
///
/// Each station is settled before the next, as if the handles moved slowly: a long body that is not lags behind the handle
/// that drives it, and a bar twisted at one end gathers its twist there and loses turns long before it must. That is cheap, as
/// the true Hessian is definite at a minimum: taken for the next advance too, it gives the tangent of the minima, which leads so
/// near to the next one that three or four factorizations settle it. The projected Hessian gives no tangent where elements are
/// much compressed, and took twice as many.
///
/// Points inside elements are the soft constraints of an [`Objective::constrained`] made of [`Handles::points`]. Their strength
/// is relative to the energy's curvature and grows once the targets are reached, one short minimization for each
/// decade.
///
/// # Errors
/// If handles do not fit each other or the map. Then `x` is as it was.
pub fn follow<const D: usize>(
    objective: &mut Objective,
    x: &mut [f64],
    stations: &[Handles],
    settings: &Settings,
    watch: &dyn Watch,
) -> Result<Summary, HandlesError>
where
    Matrix<D>: Square<D> + Rotation<D>,
{
    let mut journey = Journey::<D>::new(objective, x, stations.to_vec(), settings)?;
    journey.go_on(objective, x, (settings, Pace::ANY), watch)?;
    Ok(journey.summary())
}
