//! Interactive deformation of a body.

use super::body::Body;
use super::editor::{Editable, Editor, HandleId, Live};
use super::handle::Handle;
use super::handles::bind;
use super::normalized::{Frame, MapQuality};
use super::problem::{Model, Problem};
use super::problem_error::ProblemError;
use super::pull::is_arrived;
use super::soft::SoftPull;
use std::collections::BTreeMap;
use unwrapd_method::solver::{Handles, Stage, Summary};

/// A session in which a body is deformed: its mesh and energy are built once, handles are added, moved and removed, and
/// the map follows an iteration at a time, every iterate valid.
///
/// Positions, handles and radii are in the unit of the body, as for [`Problem`]; internally its mean element has unit
/// size. Without further changes a session settles where [`Problem::solve`] ends. A surface in a [`cage`](super::cage)
/// is carried along by [`Cage::interpolate`](super::cage::Cage::interpolate). Paths are not bent: the user who drags
/// chooses the path.
///
/// The pattern of the linear systems is ordered and analyzed once, whatever happens to the handles: vertices are held
/// by clearing their rows and columns, and the corners of the element in which a point is pulled meet in the pattern
/// already. With `bijective` the pattern grows when parts of the boundary come near each other for the first time, and
/// only then is analyzed again.
pub type Session = Editor<LiveBody>;

/// A body in its own units while it is edited.
pub struct LiveBody {
    /// The body, in the caller's unit.
    body: Body,
    frame: Frame,
    live: Live,
    /// Vertices and points that the handles pull, in the caller's unit.
    bound: Handles,
    soft: SoftPull,
}

impl Session {
    /// Opens a session with a body at rest, without handles.
    ///
    /// # Errors
    /// If a number of the model is out of range, or its energy is not defined for the body.
    pub fn new(body: Body, model: &Model) -> Result<Self, ProblemError> {
        let problem = Problem::at_rest(body, model)?;
        let (normalized, frame) = problem.normalized();
        Ok(Self::of(LiveBody {
            live: Live::new(normalized)?,
            body: problem.body,
            frame,
            bound: Handles::default(),
            soft: SoftPull::default(),
        }))
    }

    /// Returns the totals since the beginning. Energies include barriers and the pull of points; the energy of a map
    /// before its first iteration is NaN.
    pub fn summary(&self) -> &Summary {
        self.map.live.summary()
    }

    /// Returns the number of times the pattern of the linear systems was ordered and analyzed.
    pub fn analyses(&self) -> usize {
        self.map.live.analyses()
    }

    /// Returns the positions of the vertices, coordinates one after another. Those at their targets equal them bit for
    /// bit.
    pub fn positions(&self) -> Vec<f64> {
        let LiveBody {
            body,
            frame,
            live,
            bound,
            ..
        } = &self.map;
        let mut positions = frame.outward(live.x());
        let dim = body.dim();
        let Some(normalized) = live.problem().stations.first() else {
            return positions;
        };
        for (i, &v) in bound.vertices.iter().enumerate() {
            let (place, target) = (dim * v as usize, dim * i);
            let (place, target) = (place..place + dim, target..target + dim);
            if is_arrived(
                &live.x()[place.clone()],
                &normalized.targets[target.clone()],
            ) {
                positions[place].copy_from_slice(&bound.targets[target]);
            }
        }
        positions
    }

    /// Measures the present map.
    pub fn quality(&self) -> MapQuality {
        let LiveBody { frame, live, .. } = &self.map;
        live.problem().quality_as_given(live.x()).restored(frame)
    }
}

impl Editable for LiveBody {
    type Handle = Handle;
    type Places = Vec<f64>;
    type Error = ProblemError;

    fn retarget(handle: &mut Handle, target: &[f64]) {
        handle.retarget(target);
    }

    fn no_such_handle(HandleId(handle): HandleId) -> ProblemError {
        ProblemError::RemovedHandle { handle }
    }

    fn hold(&mut self, handles: &BTreeMap<HandleId, Handle>) -> Result<(), ProblemError> {
        let list: Vec<Handle> = handles.values().cloned().collect();
        let (mut bound, mut soft) = (Handles::default(), SoftPull::default());
        if !list.is_empty() {
            let mut found = bind(&self.body, &list)?;
            (bound, soft) = (found.stations.pop().unwrap_or_default(), found.soft);
        }
        self.live
            .aim(self.frame.handles(&bound), self.frame.soft(&soft))?;
        (self.bound, self.soft) = (bound, soft);
        Ok(())
    }

    fn remodel(&mut self, model: &Model) -> Result<(), ProblemError> {
        let problem = Problem::at_rest(self.body.clone(), model)?;
        let mut live = Live::new(problem.normalized().0)?;
        live.aim(self.frame.handles(&self.bound), self.frame.soft(&self.soft))?;
        live.put(self.live.x().to_vec())?;
        live.check_domain()?;
        self.live = live;
        Ok(())
    }

    fn step(&mut self) -> Stage {
        self.live.step()
    }

    fn stage(&self) -> Stage {
        self.live.stage()
    }

    fn places(&self) -> Vec<f64> {
        self.live.x().to_vec()
    }

    fn first_places(&self) -> Vec<f64> {
        self.live.problem().body.rest.clone()
    }

    fn put(&mut self, places: Vec<f64>) -> Result<(), ProblemError> {
        self.live.put(places)
    }
}
