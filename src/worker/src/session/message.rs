//! What clients say to a session, and what it answers.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use unwrapd_api::Failure;
use unwrapd_deform::Model;

/// One message of a client.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct Message {
    /// The client's number of it. A frame has that of the last message that it contains.
    pub n: u32,
    /// What it wishes.
    #[serde(flatten)]
    pub wish: Wish,
}

/// What a client wishes.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Wish {
    /// Take hold of something, or exchange the handle that has this name.
    Add {
        /// The client's name for it.
        name: u32,
        /// As in the options of the job.
        handle: Value,
    },
    /// Give a handle another target.
    Move {
        /// Which.
        name: u32,
        /// Its target.
        to: Vec<f64>,
    },
    /// Let go of a handle.
    Remove {
        /// Which.
        name: u32,
    },
    /// Exchange energy and barrier; what is absent has its default.
    Settings(Model),
    /// Remember map and handles, as before a drag.
    Remember {},
    /// Return to what was remembered last.
    Undo {},
    /// Take an undo back.
    Redo {},
    /// Return to the start, without handles.
    Reset {},
    /// Tell which handles there are.
    List {},
}

/// What a message is answered.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reply {
    /// The number of the message.
    pub n: u32,
    /// Iterations of the session before it took effect.
    pub step: u32,
    /// Whether a later move of the same handle took its place: it had no effect of its own.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub superseded: bool,
    /// The handles that there are, after what changes all of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub handles: Option<Vec<Named>>,
    /// Why it had no effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<Failure>,
}

/// A handle and its name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Named {
    /// The client's name for it.
    pub name: u32,
    /// As in the options of the job.
    pub handle: Value,
}

impl Message {
    /// Reads one. The number is 0 where even that cannot be read.
    pub(super) fn read(json: &[u8]) -> Result<Self, (u32, Failure)> {
        serde_json::from_slice(json).map_err(|error| {
            let n = serde_json::from_slice::<Value>(json).ok();
            let n = n.and_then(|value| value["n"].as_u64()).unwrap_or_default();
            (n as u32, Failure::new("invalid_message", error.to_string()))
        })
    }

    /// The handle that it moves, if that is all it does.
    pub(super) fn moved(&self) -> Option<u32> {
        match self.wish {
            Wish::Move { name, .. } => Some(name),
            _ => None,
        }
    }
}
