//! Handles pulled to their targets, every iterate a valid map.

use super::continuation::Continuation;
use super::handles::{Handles, HandlesError};
use super::least_progress::LeastProgress;
use super::objective::Objective;
use super::path::Rotation;
use super::settings::{Settings, Summary};
use super::watch::Watch;
use crate::numerics::square::{Matrix, Square};

/// Moves the handles along their path from station to station while the other vertices follow; minimizes `objective`
/// with the handles held at each station.
///
/// Each iteration is one factorization and two or more solves: the Newton step with the handles held, and the
/// first-order response of the vertices to an advance of the handles. Both are taken together; the advance is no longer
/// than inversions and the quadratic model allow. The energy may rise while the handles move; no iterate leaves the
/// domain, which must contain `x`. Where the handles cannot advance, the free vertices settle first; if that makes no
/// room either, the map is the last valid one on the path and the status is
/// [`Status::TargetsUnreachable`](super::Status::TargetsUnreachable).
///
/// Every station is settled before the next, as if the handles moved slowly. Otherwise a long body lags behind the
/// handle that drives it, and a bar twisted at one end gathers its twist there and loses turns early. Settling is
/// cheap, as the true Hessian is definite at a minimum: used for the next advance too, it gives the tangent of the
/// curve of minima, which leads so near to the next minimum that three or four factorizations settle it. The
/// projected Hessian gives no tangent where elements are strongly compressed, and took twice the factorizations.
///
/// Points inside elements are the soft constraints of an [`Objective::constrained`] made of [`Handles::points`]. Their
/// strength is relative to the energy's curvature and grows once the targets are reached, with one short minimization
/// per decade.
///
/// # Errors
/// If handles do not fit each other or the map. Then `x` is unchanged.
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
    let mut continuation = Continuation::<D>::new(objective, x, stations.to_vec(), settings)?;
    continuation.go_on(objective, x, settings, LeastProgress::ANY, watch)?;
    Ok(continuation.summary())
}
