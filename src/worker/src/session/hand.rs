//! Interface of everything that a session can edit.

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::frame::{Drawn, Elements};
use super::message::Named;
use unwrapd_api::Failure;
use unwrapd_deform::Model;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::Stage;

/// A body or UVs under live editing. Clients name the handles.
pub(super) trait Hand: Send {
    /// Adds a handle, or replaces the handle with this name.
    fn add(&mut self, name: u32, handle: Value) -> Result<(), Failure>;
    /// Moves the target of a handle.
    fn move_to(&mut self, name: u32, to: &[f64]) -> Result<(), Failure>;
    /// Removes a handle.
    fn remove(&mut self, name: u32) -> Result<(), Failure>;
    /// Replaces energy and barrier.
    fn remodel(&mut self, model: &Model) -> Result<(), Failure>;
    /// Saves map and handles for undo.
    fn remember(&mut self);
    /// Restores what was saved last. Returns `false` if nothing was saved.
    fn undo(&mut self) -> bool;
    /// Reverts an undo. Returns `false` if there is none.
    fn redo(&mut self) -> bool;
    /// Restores the initial map, without handles.
    fn reset(&mut self);
    /// Returns the handles with their names, in the order in which they were added.
    fn handles(&self) -> Vec<Named>;
    /// Performs one iteration unless the map is settled.
    fn step(&mut self) -> Stage;
    /// Returns the stage of the handles.
    fn stage(&self) -> Stage;
    /// Returns the energy including barriers; NaN before the first iteration.
    fn energy(&self) -> f64;
    /// Returns the coordinates of the vertices, flattened.
    fn positions(&self) -> Vec<f64>;
    /// Returns the minimum ratio of an element's size to its size at rest, for vertices at these positions.
    fn smallest(&self, positions: &[f64]) -> f64;
    /// Returns the elements that are guaranteed to keep their orientation.
    fn elements(&self) -> Elements<'_>;
    /// Returns the data that a client needs once.
    fn drawn(&self) -> Drawn<'_>;
    /// Returns the coordinates of a [start file](unwrapd_api::START).
    fn start(&self) -> Vec<f64>;
}

/// Parses a handle in the format of the job's options.
pub(super) fn parsed<T: DeserializeOwned>(handle: Value) -> Result<T, Failure> {
    let malformed = |error: serde_json::Error| Failure::new("malformed_handles", error.to_string());
    serde_json::from_value(handle).map_err(malformed)
}

/// Rejects models without a barrier, because every frame must be valid.
pub(super) fn check_model(model: &Model) -> Result<(), Failure> {
    if model.barrier == BarrierKind::None {
        let detail = "`barrier` must keep elements from inverting in a session";
        return Err(Failure::new("bad_parameter", detail));
    }
    Ok(())
}
