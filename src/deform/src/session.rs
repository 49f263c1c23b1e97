//! Interactive deformation of a body.

use std::collections::BTreeMap;

use super::body::Body;
use super::handles::{Handle, bind};
use super::history::History;
use super::live::Live;
use super::normalized::Frame;
use super::problem::{Model, Problem};
use super::problem_error::ProblemError;
use super::pull::is_arrived;
use super::worth::Worth;
use unwrapd_method::solver::{Handles, Stage, Summary};

/// A session in which a body is deformed: its mesh and energy are built once, handles are added, moved and removed, and
/// the map follows an iteration at a time, every iterate valid.
///
/// Positions, handles and radii are in the unit of the body, as for [`Problem`]; internally its mean element has
/// size 1. Without further changes a session settles where [`Problem::solve`] ends. A surface in a [`cage`](super::cage) is
/// carried along by [`Cage::interpolate`](super::cage::Cage::interpolate). Paths are not bent: the user who drags
/// chooses the path.
///
/// The pattern of the linear systems is ordered and analyzed once, whatever happens to the handles: vertices are held
/// by clearing their rows and columns, and the corners of the element in which a point is pulled meet in the pattern
/// already. With `bijective` the pattern grows when parts of the boundary come near each other for the first time, and
/// only then is analyzed again.
pub struct Session {
    /// The body, in the caller's unit.
    body: Body,
    frame: Frame,
    live: Live,
    held: SessionHandles,
    next: u32,
    history: History<State>,
}

/// Identifier of a handle of a session; never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HandleId(u32);

/// Handles, and their vertices and points in the caller's unit.
#[derive(Clone, Default)]
struct SessionHandles {
    handles: BTreeMap<HandleId, Handle>,
    bound: Handles,
}

/// State to which [`Session::undo`] returns.
struct State {
    x: Vec<f64>,
    held: SessionHandles,
}

impl Session {
    /// Opens a session with a body at rest, without handles.
    ///
    /// # Errors
    /// If a number of the model is out of range, or its energy is not defined for the body.
    pub fn new(body: Body, model: &Model) -> Result<Self, ProblemError> {
        let problem = Problem::at_rest(body, model)?;
        let (normalized, frame) = problem.normalized();
        Ok(Self {
            live: Live::new(normalized)?,
            body: problem.body,
            frame,
            held: SessionHandles::default(),
            next: 0,
            history: History::new(),
        })
    }

    /// Adds a handle. Places and centers are those of the body at rest.
    ///
    /// # Errors
    /// As [`bind`], which names handles by their order in [`handles`](Self::handles), this one last. The session is
    /// then unchanged.
    pub fn add(&mut self, handle: Handle) -> Result<HandleId, ProblemError> {
        let id = HandleId(self.next);
        self.replace(id, handle)?;
        self.next += 1;
        Ok(id)
    }

    /// Changes the target of a handle.
    ///
    /// # Errors
    /// If there is no such handle, if the target is not a position, or if it contradicts another handle's. The session
    /// is then unchanged.
    pub fn move_handle(&mut self, id: HandleId, target: &[f64]) -> Result<(), ProblemError> {
        let mut handle = self.handle(id)?.clone();
        match &mut handle {
            Handle::Vertex { to, .. } | Handle::Disc { to, .. } | Handle::Point { to, .. } => {
                *to = target.to_vec();
            }
        }
        self.replace(id, handle)
    }

    /// Exchanges a handle for another one, such as a disc for the same disc turned.
    ///
    /// # Errors
    /// As [`add`](Self::add), or if there is no such handle.
    pub fn exchange(&mut self, id: HandleId, handle: Handle) -> Result<(), ProblemError> {
        self.handle(id)?;
        self.replace(id, handle)
    }

    /// Removes a handle.
    ///
    /// # Errors
    /// If there is no such handle.
    pub fn remove(&mut self, id: HandleId) -> Result<(), ProblemError> {
        self.handle(id)?;
        let mut handles = self.held.handles.clone();
        handles.remove(&id);
        self.hold(handles)
    }

    fn handle(&self, id: HandleId) -> Result<&Handle, ProblemError> {
        let HandleId(number) = id;
        let handle = self.held.handles.get(&id);
        handle.ok_or(ProblemError::RemovedHandle { handle: number })
    }

    fn replace(&mut self, id: HandleId, handle: Handle) -> Result<(), ProblemError> {
        let mut handles = self.held.handles.clone();
        handles.insert(id, handle);
        self.hold(handles)
    }

    fn hold(&mut self, handles: BTreeMap<HandleId, Handle>) -> Result<(), ProblemError> {
        let list: Vec<Handle> = handles.values().cloned().collect();
        let bound = match list.len() {
            0 => Handles::default(),
            _ => bind(&self.body, &list)?.stations.pop().unwrap_or_default(),
        };
        self.live.aim(self.frame.handles(&bound))?;
        self.held = SessionHandles { handles, bound };
        Ok(())
    }

    /// Exchanges energy and barrier. The map, the handles and the history are kept.
    ///
    /// # Errors
    /// As [`new`](Self::new), or if the present map is outside the domain of the new energy, such as one with a larger
    /// distortion than the new bound. The session is then unchanged.
    pub fn remodel(&mut self, model: &Model) -> Result<(), ProblemError> {
        let problem = Problem::at_rest(self.body.clone(), model)?;
        let mut live = Live::new(problem.normalized().0)?;
        live.aim(self.frame.handles(&self.held.bound))?;
        live.put(self.live.x().to_vec())?;
        live.check_domain()?;
        self.live = live;
        Ok(())
    }

    /// Iterates over the handles and their identifiers, in the order in which they were added.
    pub fn handles(&self) -> impl Iterator<Item = (HandleId, &Handle)> {
        self.held.handles.iter().map(|(id, handle)| (*id, handle))
    }

    /// Runs one iteration, unless nothing is left to do; the map is valid before and after.
    pub fn step(&mut self) -> Stage {
        self.live.step()
    }

    /// Runs iterations while there is something to do and `go_on`, called before each, returns `true`: a time slice, if
    /// it checks a clock.
    pub fn step_while(&mut self, mut go_on: impl FnMut(&Self) -> bool) -> Stage {
        while self.stage() == Stage::Moving && go_on(self) {
            self.step();
        }
        self.stage()
    }

    /// Returns the state of the handles.
    pub fn stage(&self) -> Stage {
        self.live.stage()
    }

    /// Returns the totals since the beginning. Energies include barriers and the pull of points; the energy of a map
    /// before its first iteration is NaN.
    pub fn summary(&self) -> &Summary {
        self.live.summary()
    }

    /// Returns the number of times the pattern of the linear systems was ordered and analyzed.
    pub fn analyses(&self) -> usize {
        self.live.analyses()
    }

    /// Returns the positions of the vertices, coordinates one after another. Those at their targets equal them bit for
    /// bit.
    pub fn positions(&self) -> Vec<f64> {
        let mut positions = self.frame.outward(self.live.x());
        let dim = self.body.dim();
        let Some(normalized) = self.live.problem().stations.first() else {
            return positions;
        };
        for (i, &v) in self.held.bound.vertices.iter().enumerate() {
            let (place, target) = (dim * v as usize, dim * i);
            let (place, target) = (place..place + dim, target..target + dim);
            if is_arrived(
                &self.live.x()[place.clone()],
                &normalized.targets[target.clone()],
            ) {
                positions[place].copy_from_slice(&self.held.bound.targets[target]);
            }
        }
        positions
    }

    /// Measures the present map.
    pub fn worth(&self) -> Worth {
        let worth = self.live.problem().worth_as_given(self.live.x());
        worth.restored(&self.frame)
    }

    /// Records positions and handles, as before a drag; [`undo`](Self::undo) returns here. The last hundred are kept.
    pub fn remember(&mut self) {
        let state = self.state();
        self.history.remember(state);
    }

    /// Returns to the last recorded positions and handles, bit for bit; returns `false` if there are none.
    pub fn undo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.back(present);
        self.restore(state)
    }

    /// Reverts an undo; returns `false` if there is none, or something was recorded since.
    pub fn redo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.forth(present);
        self.restore(state)
    }

    /// Resets the body to rest, without handles. The history is kept.
    pub fn reset(&mut self) {
        let rest = State {
            x: self.live.problem().body.rest.clone(),
            held: SessionHandles::default(),
        };
        self.restore(Some(rest));
    }

    fn state(&self) -> State {
        State {
            x: self.live.x().to_vec(),
            held: self.held.clone(),
        }
    }

    fn restore(&mut self, state: Option<State>) -> bool {
        let Some(State { x, held }) = state else {
            return false;
        };
        let handles = self.frame.handles(&held.bound);
        self.held = held;
        self.live
            .aim(handles)
            .and_then(|()| self.live.put(x))
            .is_ok()
    }
}
