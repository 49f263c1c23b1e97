//! Interactive editing of a map by handles: one protocol for bodies and for UVs.

use super::body::BodyElements;
use super::problem::{Model, Problem};
use super::problem_error::ProblemError;
use super::soft::SoftPull;
use std::collections::BTreeMap;
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::solver::{Handles, InteractiveContinuation, Objective, Stage, Summary};

/// A map that handles pull an iteration at a time. [`Editor`] adds names, history and the editing protocol.
pub trait Editable {
    /// A handle with its target.
    type Handle: Clone;
    /// Places of the map, to which an undo returns bit for bit.
    type Places;
    /// Reason why an edit is refused.
    type Error;

    /// Sets the target of a handle.
    fn retarget(handle: &mut Self::Handle, target: &[f64]);

    /// Returns the error for a handle that does not exist.
    fn no_such_handle(id: HandleId) -> Self::Error;

    /// Replaces all handles. On an error, nothing changes.
    fn hold(&mut self, handles: &BTreeMap<HandleId, Self::Handle>) -> Result<(), Self::Error>;

    /// Replaces energy and barrier at the present map. On an error, nothing changes.
    fn remodel(&mut self, model: &Model) -> Result<(), Self::Error>;

    /// Runs one iteration, unless nothing is left to do; the map is valid before and after.
    fn step(&mut self) -> Stage;

    /// Returns the state of the handles.
    fn stage(&self) -> Stage;

    /// Returns the present places.
    fn places(&self) -> Self::Places;

    /// Returns the places at the start.
    fn first_places(&self) -> Self::Places;

    /// Moves the map to earlier places, with the present handles.
    fn put(&mut self, places: Self::Places) -> Result<(), Self::Error>;
}

/// Identifier of a handle of an editor; never reused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HandleId(pub(super) u32);

/// A map under interactive editing: handles are added, moved and removed, and the map follows an iteration at a time,
/// every iterate valid. [`Session`](super::Session) edits a body, [`UvSession`](super::uv::UvSession) a UV map.
pub struct Editor<M: Editable> {
    pub(super) map: M,
    handles: BTreeMap<HandleId, M::Handle>,
    next: u32,
    history: History<EditorState<M>>,
}

/// State to which [`Editor::undo`] returns.
struct EditorState<M: Editable> {
    handles: BTreeMap<HandleId, M::Handle>,
    places: M::Places,
}

impl<M: Editable> Editor<M> {
    /// Wraps a map without handles.
    pub fn of(map: M) -> Self {
        Self {
            map,
            handles: BTreeMap::new(),
            next: 0,
            history: History::new(),
        }
    }

    /// Returns the map.
    pub fn map(&self) -> &M {
        &self.map
    }

    /// Adds a handle. Its place is that of the map at the start.
    ///
    /// # Errors
    /// If the handle does not fit the map or the other handles; an error names handles by their order in
    /// [`handles`](Self::handles), this one last. Nothing changes then.
    pub fn add(&mut self, handle: M::Handle) -> Result<HandleId, M::Error> {
        let id = HandleId(self.next);
        self.replace(id, handle)?;
        self.next += 1;
        Ok(id)
    }

    /// Changes the target of a handle.
    ///
    /// # Errors
    /// As [`add`](Self::add), if the target is not a position, or if there is no such handle. Nothing changes then.
    pub fn move_handle(&mut self, id: HandleId, target: &[f64]) -> Result<(), M::Error> {
        let mut handle = self.handle(id)?.clone();
        M::retarget(&mut handle, target);
        self.replace(id, handle)
    }

    /// Exchanges a handle for another one, such as a disc for the same disc turned.
    ///
    /// # Errors
    /// As [`add`](Self::add), or if there is no such handle. Nothing changes then.
    pub fn exchange(&mut self, id: HandleId, handle: M::Handle) -> Result<(), M::Error> {
        self.handle(id)?;
        self.replace(id, handle)
    }

    /// Removes a handle.
    ///
    /// # Errors
    /// If there is no such handle.
    pub fn remove(&mut self, id: HandleId) -> Result<(), M::Error> {
        self.handle(id)?;
        let mut handles = self.handles.clone();
        handles.remove(&id);
        self.hold(handles)
    }

    fn handle(&self, id: HandleId) -> Result<&M::Handle, M::Error> {
        self.handles.get(&id).ok_or_else(|| M::no_such_handle(id))
    }

    fn replace(&mut self, id: HandleId, handle: M::Handle) -> Result<(), M::Error> {
        let mut handles = self.handles.clone();
        handles.insert(id, handle);
        self.hold(handles)
    }

    fn hold(&mut self, handles: BTreeMap<HandleId, M::Handle>) -> Result<(), M::Error> {
        self.map.hold(&handles)?;
        self.handles = handles;
        Ok(())
    }

    /// Iterates over the handles and their identifiers, in the order in which they were added.
    pub fn handles(&self) -> impl Iterator<Item = (HandleId, &M::Handle)> {
        self.handles.iter().map(|(id, handle)| (*id, handle))
    }

    /// Exchanges energy and barrier. The map, the handles and the history are kept.
    ///
    /// # Errors
    /// If a number of the model is out of range, its energy is not defined for the map, or the present map is outside
    /// the domain of the new energy, such as one with a larger distortion than the new bound. Nothing changes then.
    pub fn remodel(&mut self, model: &Model) -> Result<(), M::Error> {
        self.map.remodel(model)
    }

    /// Runs one iteration, unless nothing is left to do; the map is valid before and after.
    pub fn step(&mut self) -> Stage {
        self.map.step()
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
        self.map.stage()
    }

    /// Records the map and the handles, as before a drag; [`undo`](Self::undo) returns here. The last hundred are kept.
    pub fn remember(&mut self) {
        let state = self.state();
        self.history.remember(state);
    }

    /// Returns to the last recorded map and handles, bit for bit; returns `false` if there are none.
    pub fn undo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.back(present);
        state.is_some_and(|state| self.restore(state))
    }

    /// Reverts an undo; returns `false` if there is none, or something was recorded since.
    pub fn redo(&mut self) -> bool {
        let present = self.state();
        let state = self.history.forth(present);
        state.is_some_and(|state| self.restore(state))
    }

    /// Resets the map to its start, without handles. The history is kept.
    pub fn reset(&mut self) {
        let places = self.map.first_places();
        let handles = BTreeMap::new();
        self.restore(EditorState { handles, places });
    }

    fn state(&self) -> EditorState<M> {
        EditorState {
            handles: self.handles.clone(),
            places: self.map.places(),
        }
    }

    /// Restores a state and returns whether that succeeded. Handles come first: places alone would set a map that is at
    /// rest in motion.
    fn restore(&mut self, EditorState { handles, places }: EditorState<M>) -> bool {
        self.hold(handles)
            .and_then(|()| self.map.put(places))
            .is_ok()
    }
}

/// Most states that are kept; the oldest are dropped. A state of a body of 100,000 vertices takes 2.4 MB.
const MOST: usize = 100;

/// The states before the present one and, after undoing, those after it.
struct History<T> {
    before: Vec<T>,
    after: Vec<T>,
}

impl<T> History<T> {
    fn new() -> Self {
        Self {
            before: Vec::new(),
            after: Vec::new(),
        }
    }

    /// Records the present state and drops those after it.
    fn remember(&mut self, present: T) {
        self.after.clear();
        if self.before.len() == MOST {
            self.before.remove(0);
        }
        self.before.push(present);
    }

    /// Returns the state before, if any, and stores `present` after it.
    fn back(&mut self, present: T) -> Option<T> {
        let state = self.before.pop()?;
        self.after.push(present);
        Some(state)
    }

    /// Returns the state after, if any, and stores `present` before it.
    fn forth(&mut self, present: T) -> Option<T> {
        let state = self.after.pop()?;
        self.before.push(present);
        Some(state)
    }
}

// A problem that is solved while its handles change.

/// Distance from their targets, for mean elements of size 1, within which handles have arrived: a body at rest stays at
/// rest.
const NEAR: f64 = 1e-9;

/// A problem in its own units, with its energy, its map and the drag of its handles.
pub(super) struct Live {
    /// The problem; its only station holds the present handles.
    problem: Problem,
    objective: Objective,
    x: Vec<f64>,
    continuation: LiveContinuation,
}

/// A drag in the plane or in space.
enum LiveContinuation {
    Planar(InteractiveContinuation<2>),
    Spatial(InteractiveContinuation<3>),
}

impl Live {
    pub fn new(problem: Problem) -> Result<Self, ProblemError> {
        let handles = problem.stations.last().cloned().unwrap_or_default();
        handles.check(problem.body.dim(), problem.start.len())?;
        let mut objective = problem.objective()?;
        let x = problem.start.clone();
        let continuation = match problem.body.dim() {
            2 => LiveContinuation::Planar(InteractiveContinuation::new(&mut objective, &x)?),
            _ => LiveContinuation::Spatial(InteractiveContinuation::new(&mut objective, &x)?),
        };
        let mut live = Self {
            problem,
            objective,
            x,
            continuation,
        };
        let soft = live.problem.soft.clone();
        live.aim(handles, soft)?;
        Ok(live)
    }

    /// Replaces the handles, those with weights too.
    pub fn aim(&mut self, handles: Handles, soft: SoftPull) -> Result<(), ProblemError> {
        let (objective, x) = (&mut self.objective, &mut self.x);
        handles.check(objective.dim(), x.len())?;
        self.problem.stations = vec![handles];
        if self.problem.soft != soft {
            self.problem.soft = soft;
            objective.exchange(self.problem.pulled_terms()?);
        }
        let handles = &self.problem.stations[0];
        let is_pulled = !self.problem.soft.is_empty()
            || self.problem.quality_as_given(x).residual > NEAR * NEAR;
        if *x == self.problem.body.rest && is_pulled {
            self.problem.shake(objective, x);
        }
        match &mut self.continuation {
            LiveContinuation::Planar(continuation) => continuation.aim(objective, x, handles)?,
            LiveContinuation::Spatial(continuation) => continuation.aim(objective, x, handles)?,
        }
        Ok(())
    }

    /// Runs one iteration, unless nothing is left to do.
    pub fn step(&mut self) -> Stage {
        let (objective, x) = (&mut self.objective, &mut self.x);
        match &mut self.continuation {
            LiveContinuation::Planar(continuation) => continuation.step(objective, x),
            LiveContinuation::Spatial(continuation) => continuation.step(objective, x),
        }
    }

    pub fn stage(&self) -> Stage {
        match &self.continuation {
            LiveContinuation::Planar(continuation) => continuation.stage(),
            LiveContinuation::Spatial(continuation) => continuation.stage(),
        }
    }

    pub fn summary(&self) -> &Summary {
        match &self.continuation {
            LiveContinuation::Planar(continuation) => continuation.summary(),
            LiveContinuation::Spatial(continuation) => continuation.summary(),
        }
    }

    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Moves the map back to `x`, with the present handles.
    pub fn put(&mut self, x: Vec<f64>) -> Result<(), ProblemError> {
        self.x = x;
        let Problem { stations, soft, .. } = &self.problem;
        self.aim(stations[0].clone(), soft.clone())
    }

    /// Refuses a map outside the domain of the energy.
    pub fn check_domain(&self) -> Result<(), ProblemError> {
        let is_apart = match (&self.problem.boundary_barrier, &self.problem.body.elements) {
            (Some(_), BodyElements::Triangles { corners, .. }) => {
                are_disjoint(self.x.as_chunks().0, corners)
            }
            _ => true,
        };
        if is_apart && self.objective.value(&self.x).is_finite() {
            return Ok(());
        }
        Err(ProblemError::OutsideDomain)
    }

    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    pub fn analyses(&self) -> usize {
        self.objective.analyses()
    }
}
