//! Messages of clients to a session, and its replies.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use unwrapd_api::Failure;
use unwrapd_deform::Model;

/// A message of a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Message {
    /// The client's number of the message. A frame has that of the last message that it contains.
    pub n: u32,
    /// Command of the message.
    #[serde(flatten)]
    pub command: Command,
}

/// Command of a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Command {
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
    pub handles: Option<Vec<Named>>,
    /// Reason why the command had no effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Failure>,
}

/// A named handle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Named {
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
            Command::Move { name, .. } => Some(name),
            _ => None,
        }
    }
}
