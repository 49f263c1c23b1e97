//! The state of a session: messages in, frames out.

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::body::{BodyView, HandleFormat};
use super::editing::{Editing, NamedHandles, check_model};
use super::frame::{self, Header};
use super::message::{Command, Message, Reply};
use super::uvs::UvView;
use unwrapd_api::{Failure, Kind, Limits, Upload};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::{
    self as pipeline, CommandOptions, DeformOptions, EditOptions, PipelineError, WarpOptions,
    open_body, open_picture, open_uvs,
};

/// State of a session. It depends only on the input, the messages, and the iterations that these precede.
pub struct LiveSession {
    editing: Box<dyn Editing>,
    step: u32,
    message: u32,
}

impl LiveSession {
    /// Opens a session on what such a job would deform, at rest, with the handles of the options, numbered in list
    /// order.
    ///
    /// # Errors
    /// Fails like the job, or if its kind has no handles.
    pub fn new(
        kind: Kind,
        options: &Value,
        upload: &Upload,
        limits: Limits,
    ) -> Result<Self, Failure> {
        let (editing, handles): (Box<dyn Editing>, Value) = match kind {
            Kind::Deform => {
                let options: DeformOptions = read(options, limits)?;
                check_model(&options.model)?;
                let format = match options.cage {
                    None => HandleFormat::Body,
                    Some(_) => HandleFormat::Cage,
                };
                let held = open_body(upload, &options).map_err(|e| failure(&e))?;
                let body = NamedHandles::new(BodyView::new(held, format));
                (Box::new(body), json!(options.handles))
            }
            Kind::Warp => {
                let options: WarpOptions = read(options, limits)?;
                check_model(&options.model)?;
                let held = open_picture(upload, &options).map_err(|e| failure(&e))?;
                let grid = NamedHandles::new(BodyView::new(held, HandleFormat::Picture));
                (Box::new(grid), json!(options.handles))
            }
            Kind::EditUv => uvs(upload, pipeline::Editing::Map, options, limits)?,
            Kind::TextureMap => uvs(upload, pipeline::Editing::Texture, options, limits)?,
            Kind::Unwrap | Kind::Measure | Kind::Verify | Kind::Solve | Kind::Repack => {
                let detail = format!("a job of kind {} has no handles", kind.word());
                return Err(Failure::new("invalid_options", detail));
            }
        };
        let mut session = Self {
            editing,
            step: 0,
            message: 0,
        };
        let handles = handles.as_array().cloned().unwrap_or_default();
        for (name, handle) in handles.into_iter().enumerate() {
            let name = name as u32;
            session.editing.execute(&Command::Add { name, handle })?;
        }
        Ok(session)
    }

    /// Returns the mesh in the format of the protocol.
    pub fn mesh(&self) -> Vec<u8> {
        let view = self.editing.view();
        frame::mesh(&view.drawn(), &view.elements())
    }

    /// Returns the current frame in the format of the protocol.
    pub fn frame(&self) -> Vec<u8> {
        let view = self.editing.view();
        let positions = view.positions();
        let header = Header {
            stage: self.editing.stage(),
            step: self.step,
            message: self.message,
            energy: view.energy(),
            smallest: view.smallest(&positions),
        };
        frame::frame(&header, &view.elements(), &positions)
    }

    /// Returns whether another iteration would change the map.
    pub fn is_moving(&self) -> bool {
        self.editing.stage() == Stage::Moving
    }

    /// Performs one iteration unless the map is settled. Counts it in any case.
    pub fn step(&mut self) {
        self.editing.step();
        self.step = self.step.wrapping_add(1);
    }

    /// Executes the command of a message.
    pub fn execute(&mut self, message: &Message) -> Reply {
        let reply = self.reply(message.n);
        let done = self.editing.execute(&message.command);
        let tells_all = matches!(
            message.command,
            Command::Undo {} | Command::Redo {} | Command::Reset {} | Command::List {}
        );
        Reply {
            handles: tells_all.then(|| self.editing.handles()),
            error: done.err(),
            ..reply
        }
    }

    /// Answers a move that a later one supersedes.
    pub fn supersede(&mut self, n: u32) -> Reply {
        Reply {
            superseded: true,
            ..self.reply(n)
        }
    }

    /// Answers a malformed message.
    pub fn refuse(&mut self, n: u32, error: Failure) -> Reply {
        Reply {
            error: Some(error),
            ..self.reply(n)
        }
    }

    fn reply(&mut self, n: u32) -> Reply {
        self.message = n;
        Reply {
            n,
            step: self.step,
            superseded: false,
            handles: None,
            error: None,
        }
    }

    /// Returns the handles in the format of the job's options, and the coordinates of its
    /// [start](unwrapd_api::START).
    pub fn baked(&self) -> (Vec<Value>, Vec<f64>) {
        let handles = self.editing.handles().into_iter().map(|named| named.handle);
        (handles.collect(), self.editing.view().start())
    }
}

/// Opens UVs for live editing, and returns the anchors of the options.
fn uvs(
    upload: &Upload,
    editing: pipeline::Editing,
    options: &Value,
    limits: Limits,
) -> Result<(Box<dyn Editing>, Value), Failure> {
    let options: EditOptions = read(options, limits)?;
    check_model(&options.model)?;
    let session = open_uvs(upload, editing, &options).map_err(|e| failure(&e))?;
    let uvs = NamedHandles::new(UvView(session));
    Ok((Box::new(uvs), json!(options.anchors)))
}

fn read<O: CommandOptions + DeserializeOwned>(
    options: &Value,
    limits: Limits,
) -> Result<O, Failure> {
    let refused = |error: serde_json::Error| Failure::new("invalid_options", error.to_string());
    let mut options: O = serde_json::from_value(options.clone()).map_err(refused)?;
    options.caller_mut().limits = limits;
    Ok(options)
}

fn failure(error: &PipelineError) -> Failure {
    Failure::new(error.code(), error.to_string())
}
