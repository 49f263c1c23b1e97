//! Maps under live editing, with handles that clients name, and the messages about them.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::frame::{Drawn, FrameElements};
use unwrapd_api::Failure;
use unwrapd_deform::{Editable, Editor, HandleId, Model};
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::Stage;

/// A map under live editing: commands of clients, and all that a frame tells of the map.
pub(super) trait LiveEditing: Send {
    /// Executes a command of a client.
    fn execute(&mut self, command: &SessionCommand) -> Result<(), Failure>;
    /// Returns the handles with their names, in the order in which they were added.
    fn handles(&self) -> Vec<NamedHandle>;
    /// Performs one iteration unless the map is settled.
    fn step(&mut self) -> Stage;
    /// Returns the stage of the handles.
    fn stage(&self) -> Stage;
    /// Returns the map as frames show it.
    fn view(&self) -> &dyn View;
    /// Returns the handles of a job that goes on from the present map.
    fn job_handles(&mut self) -> Vec<Value>;
}

/// A map as frames show it.
pub(super) trait View {
    /// Returns the energy including barriers; NaN before the first iteration.
    fn energy(&self) -> f64;
    /// Returns the coordinates of the vertices, flattened.
    fn positions(&self) -> Vec<f64>;
    /// Returns the minimum ratio of an element's size to its size at rest, for vertices at these positions.
    fn smallest(&self, positions: &[f64]) -> f64;
    /// Returns the elements that are guaranteed to keep their orientation.
    fn elements(&self) -> FrameElements<'_>;
    /// Returns the data that a client needs once.
    fn drawn(&self) -> Drawn<'_>;
    /// Returns the coordinates of a [start file](unwrapd_api::START); `None` if the handles of a job tell all.
    fn start(&self) -> Option<Vec<f64>>;
}

/// A map with an editor, whose handles have a format of their own.
pub(super) trait Edited: View + Send {
    /// The map of the editor.
    type Map: Editable<Handle: Serialize>;
    /// Returns the editor.
    fn editor(&self) -> &Editor<Self::Map>;
    /// Returns the editor for changes.
    fn editor_mut(&mut self) -> &mut Editor<Self::Map>;
    /// Parses a handle, named `name`, in the format of the job's options.
    fn read(&self, name: u32, handle: Value) -> Result<<Self::Map as Editable>::Handle, Failure>;
    /// Returns the failure that clients see.
    fn failure(error: &<Self::Map as Editable>::Error) -> Failure;
    /// Restores the initial map, with the handles that no client added.
    fn reset(&mut self);
    /// Returns the handles of a job that continues from the present map; `held` are those that clients hold.
    fn job_handles(&mut self, held: Vec<Value>) -> Vec<Value> {
        held
    }
}

/// A map whose handles have the names that clients gave them. An undo may bring a handle back, so no name is forgotten.
pub(super) struct NamedHandles<E> {
    edited: E,
    names: BTreeMap<HandleId, u32>,
}

impl<E: Edited> NamedHandles<E> {
    /// Wraps a map whose handles, if any, no client added.
    pub fn new(edited: E) -> Self {
        let names = BTreeMap::new();
        Self { edited, names }
    }

    /// Returns the present handle with this name.
    fn find(&self, name: u32) -> Option<HandleId> {
        let present = self.edited.editor().handles();
        (present.map(|(id, _)| id)).find(|id| self.names.get(id) == Some(&name))
    }

    fn expect(&self, name: u32) -> Result<HandleId, Failure> {
        self.find(name).ok_or_else(|| {
            let detail = format!("there is no handle named {name}");
            Failure::new("unknown_handle", detail)
        })
    }

    /// Adds a handle, or replaces the handle with this name.
    fn add(&mut self, name: u32, handle: Value) -> Result<(), Failure> {
        let handle = self.edited.read(name, handle)?;
        if let Some(id) = self.find(name) {
            let exchanged = self.edited.editor_mut().exchange(id, handle);
            return exchanged.map_err(|e| E::failure(&e));
        }
        let added = self.edited.editor_mut().add(handle);
        let id = added.map_err(|e| E::failure(&e))?;
        self.names.insert(id, name);
        Ok(())
    }
}

impl<E: Edited> LiveEditing for NamedHandles<E> {
    fn execute(&mut self, command: &SessionCommand) -> Result<(), Failure> {
        match command {
            SessionCommand::Add { name, handle } => return self.add(*name, handle.clone()),
            SessionCommand::Move { name, to } => {
                let id = self.expect(*name)?;
                let moved = self.edited.editor_mut().move_handle(id, to);
                moved.map_err(|e| E::failure(&e))?;
            }
            SessionCommand::Remove { name } => {
                let id = self.expect(*name)?;
                let removed = self.edited.editor_mut().remove(id);
                removed.map_err(|e| E::failure(&e))?;
            }
            SessionCommand::Settings(model) => {
                check_model(model)?;
                let remodeled = self.edited.editor_mut().remodel(model);
                remodeled.map_err(|e| E::failure(&e))?;
            }
            SessionCommand::Remember {} => self.edited.editor_mut().remember(),
            SessionCommand::Undo {} if !self.edited.editor_mut().undo() => {
                return Err(Failure::new("nothing_to_undo", "nothing was remembered"));
            }
            SessionCommand::Redo {} if !self.edited.editor_mut().redo() => {
                return Err(Failure::new("nothing_to_redo", "nothing was undone"));
            }
            SessionCommand::Reset {} => self.edited.reset(),
            SessionCommand::Undo {} | SessionCommand::Redo {} | SessionCommand::List {} => {}
        }
        Ok(())
    }

    fn handles(&self) -> Vec<NamedHandle> {
        let handles = self.edited.editor().handles();
        let named = handles.filter_map(|(id, handle)| {
            let name = *self.names.get(&id)?;
            let handle = serde_json::to_value(handle).unwrap_or_default();
            Some(NamedHandle { name, handle })
        });
        named.collect()
    }

    fn step(&mut self) -> Stage {
        self.edited.editor_mut().step()
    }

    fn stage(&self) -> Stage {
        self.edited.editor().stage()
    }

    fn view(&self) -> &dyn View {
        &self.edited
    }

    fn job_handles(&mut self) -> Vec<Value> {
        let held = self.handles().into_iter().map(|named| named.handle);
        self.edited.job_handles(held.collect())
    }
}

/// Parses a handle in the format of the job's options.
pub(super) fn parsed<T: DeserializeOwned>(handle: Value) -> Result<T, Failure> {
    serde_json::from_value(handle)
        .map_err(|error| Failure::new("malformed_handles", error.to_string()))
}

/// Rejects models without a barrier, because every frame must be valid.
pub(super) fn check_model(model: &Model) -> Result<(), Failure> {
    if model.barrier == BarrierKind::None {
        let detail = "`barrier` must keep elements from inverting in a session";
        return Err(Failure::new("bad_parameter", detail));
    }
    Ok(())
}

// Messages of clients to a session, and its replies.

/// A message of a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Message {
    /// The client's number of the message. A frame has that of the last message that it contains.
    pub n: u32,
    /// Command of the message.
    #[serde(flatten)]
    pub command: SessionCommand,
}

/// Command of a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SessionCommand {
    /// Add a handle, or replace the handle with this name.
    Add {
        /// The client's name for the handle.
        name: u32,
        /// Handle in the format of the job's options.
        handle: Value,
    },
    /// Move the target of a handle.
    Move {
        /// Name of the handle.
        name: u32,
        /// Coordinates of the target.
        to: Vec<f64>,
    },
    /// Remove a handle.
    Remove {
        /// Name of the handle.
        name: u32,
    },
    /// Replace energy and barrier; absent settings have their defaults.
    Settings(Model),
    /// Save map and handles, as before a drag.
    Remember {},
    /// Restore what was saved last.
    Undo {},
    /// Revert an undo.
    Redo {},
    /// Restore the initial map, without handles.
    Reset {},
    /// List the handles.
    List {},
}

/// Reply to a message.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reply {
    /// Number of the message.
    pub n: u32,
    /// Iterations of the session before the message took effect.
    pub step: u32,
    /// Set if a later move of the same handle superseded this one, which had no effect.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub superseded: bool,
    /// Current handles, after a command that changes all of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handles: Option<Vec<NamedHandle>>,
    /// Reason why the command had no effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Failure>,
}

/// A named handle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedHandle {
    /// The client's name for the handle.
    pub name: u32,
    /// Handle in the format of the job's options.
    pub handle: Value,
}

impl Message {
    /// Parses a message. On failure returns its number, or 0 if even that cannot be read.
    pub(super) fn read(json: &[u8]) -> Result<Self, (u32, Failure)> {
        serde_json::from_slice(json).map_err(|error| {
            let n = serde_json::from_slice::<Value>(json).ok();
            let n = n.and_then(|value| value["n"].as_u64()).unwrap_or_default();
            (n as u32, Failure::new("invalid_message", error.to_string()))
        })
    }

    /// Returns the name of the handle if the message is a move.
    pub(super) fn moved(&self) -> Option<u32> {
        match self.command {
            SessionCommand::Move { name, .. } => Some(name),
            _ => None,
        }
    }
}
