//! What is in the hand, whatever it is.

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::frame::{Drawn, Elements};
use super::message::Named;
use unwrapd_api::Failure;
use unwrapd_deform::Model;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::Stage;

/// A body or UVs in the hand of a client, who names handles.
pub(super) trait Hand: Send {
    /// Takes hold of something, or exchanges the handle of this name.
    fn add(&mut self, name: u32, handle: Value) -> Result<(), Failure>;
    /// Gives a handle another target.
    fn move_to(&mut self, name: u32, to: &[f64]) -> Result<(), Failure>;
    /// Lets go of a handle.
    fn remove(&mut self, name: u32) -> Result<(), Failure>;
    /// Exchanges energy and barrier.
    fn remodel(&mut self, model: &Model) -> Result<(), Failure>;
    /// Remembers map and handles.
    fn remember(&mut self);
    /// Returns to what was remembered last; false if there is nothing.
    fn undo(&mut self) -> bool;
    /// Takes an undo back; false if there is none.
    fn redo(&mut self) -> bool;
    /// Returns to the start, without handles.
    fn reset(&mut self);
    /// The handles with their names, in the order in which they were added.
    fn handles(&self) -> Vec<Named>;
    /// One iteration, unless there is nothing left to do.
    fn step(&mut self) -> Stage;
    /// Where the handles stand.
    fn stage(&self) -> Stage;
    /// Energy with barriers; not a number where no iteration has looked at the map yet.
    fn energy(&self) -> f64;
    /// Where the vertices are, coordinates one after another.
    fn positions(&self) -> Vec<f64>;
    /// The smallest size of an element over its size at rest, the vertices being at these positions.
    fn smallest(&self, positions: &[f64]) -> f64;
    /// The elements that are promised to keep their orientation.
    fn elements(&self) -> Elements<'_>;
    /// What a client needs to know once.
    fn drawn(&self) -> Drawn<'_>;
    /// The coordinates of a [start file](unwrapd_api::START).
    fn start(&self) -> Vec<f64>;
}

/// A handle as the options of the job have it.
pub(super) fn parsed<T: DeserializeOwned>(handle: Value) -> Result<T, Failure> {
    let malformed = |error: serde_json::Error| Failure::new("malformed_handles", error.to_string());
    serde_json::from_value(handle).map_err(malformed)
}

/// Every frame is promised to be valid.
pub(super) fn check_model(model: &Model) -> Result<(), Failure> {
    if model.barrier == BarrierKind::None {
        let detail = "`barrier` must keep elements from inverting in a session";
        return Err(Failure::new("bad_parameter", detail));
    }
    Ok(())
}
