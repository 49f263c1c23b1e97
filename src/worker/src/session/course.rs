//! The state of a session: messages in, frames out.

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::body_hand::{BodyHand, Form};
use super::frame::{self, Header};
use super::hand::{Hand, check_model};
use super::message::{Message, Reply, Wish};
use super::uv_hand::UvHand;
use unwrapd_api::{Failure, Kind, Limits, Upload};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::{
    CommandOptions, DeformOptions, EditOptions, Editing, PipelineError, WarpOptions, hold_body,
    hold_picture, hold_uvs,
};

/// State of a session. It depends only on the input, the messages, and the iterations that these precede.
pub struct Course {
    hand: Box<dyn Hand>,
    step: u32,
    message: u32,
}

impl Course {
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
        // Open the body, the picture or the UVs of the input.
        let (hand, handles): (Box<dyn Hand>, Value) = match kind {
            Kind::Deform => {
                let options: DeformOptions = read(options, limits)?;
                check_model(&options.model)?;
                let form = options.cage.map_or(Form::Body, |_| Form::Cage);
                let held = hold_body(upload, &options).map_err(|e| failure(&e))?;
                (Box::new(BodyHand::new(held, form)), json!(options.handles))
            }
            Kind::Warp => {
                let options: WarpOptions = read(options, limits)?;
                check_model(&options.model)?;
                let held = hold_picture(upload, &options).map_err(|e| failure(&e))?;
                let hand = BodyHand::new(held, Form::Picture);
                (Box::new(hand), json!(options.handles))
            }
            Kind::EditUv => uvs(upload, Editing::Map, options, limits)?,
            Kind::TextureMap => uvs(upload, Editing::Texture, options, limits)?,
            Kind::Unwrap | Kind::Measure | Kind::Verify | Kind::Solve | Kind::Repack => {
                let detail = format!("a job of kind {} has no handles", kind.word());
                return Err(Failure::new("invalid_options", detail));
            }
        };
        // Add the handles of the options, named by their positions in the list.
        let mut course = Self {
            hand,
            step: 0,
            message: 0,
        };
        let handles = handles.as_array().cloned().unwrap_or_default();
        for (name, handle) in handles.into_iter().enumerate() {
            course.hand.add(name as u32, handle)?;
        }
        Ok(course)
    }

    /// Returns the mesh in the format of the protocol.
    pub fn mesh(&self) -> Vec<u8> {
        frame::mesh(&self.hand.drawn(), &self.hand.elements())
    }

    /// Returns the current frame in the format of the protocol.
    pub fn frame(&self) -> Vec<u8> {
        let positions = self.hand.positions();
        let header = Header {
            stage: self.hand.stage(),
            step: self.step,
            message: self.message,
            energy: self.hand.energy(),
            smallest: self.hand.smallest(&positions),
        };
        frame::frame(&header, &self.hand.elements(), &positions)
    }

    /// Returns whether another iteration would change the map.
    pub fn is_moving(&self) -> bool {
        self.hand.stage() == Stage::Moving
    }

    /// Performs one iteration unless the map is settled. Counts it in any case.
    pub fn step(&mut self) {
        self.hand.step();
        self.step = self.step.wrapping_add(1);
    }

    /// Executes the command of a message.
    pub fn take(&mut self, message: &Message) -> Reply {
        let reply = self.reply(message.n);
        let done = self.wished(&message.wish);
        let tells_all = matches!(
            message.wish,
            Wish::Undo {} | Wish::Redo {} | Wish::Reset {} | Wish::List {}
        );
        Reply {
            handles: tells_all.then(|| self.hand.handles()),
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

    fn wished(&mut self, wish: &Wish) -> Result<(), Failure> {
        match wish {
            Wish::Add { name, handle } => self.hand.add(*name, handle.clone()),
            Wish::Move { name, to } => self.hand.move_to(*name, to),
            Wish::Remove { name } => self.hand.remove(*name),
            Wish::Settings(model) => self.hand.remodel(model),
            Wish::Remember {} => {
                self.hand.remember();
                Ok(())
            }
            Wish::Undo {} => there_is(self.hand.undo(), || {
                Failure::new("nothing_to_undo", "nothing was remembered")
            }),
            Wish::Redo {} => there_is(self.hand.redo(), || {
                Failure::new("nothing_to_redo", "nothing was undone")
            }),
            Wish::Reset {} => {
                self.hand.reset();
                Ok(())
            }
            Wish::List {} => Ok(()),
        }
    }

    /// Returns the handles in the format of the job's options, and the coordinates of its
    /// [start](unwrapd_api::START).
    pub fn baked(&self) -> (Vec<Value>, Vec<f64>) {
        let handles = self.hand.handles().into_iter().map(|named| named.handle);
        (handles.collect(), self.hand.start())
    }
}

fn there_is(something: bool, otherwise: impl FnOnce() -> Failure) -> Result<(), Failure> {
    if something { Ok(()) } else { Err(otherwise()) }
}

/// Opens UVs for live editing, and returns the anchors of the options.
fn uvs(
    upload: &Upload,
    editing: Editing,
    options: &Value,
    limits: Limits,
) -> Result<(Box<dyn Hand>, Value), Failure> {
    let options: EditOptions = read(options, limits)?;
    check_model(&options.model)?;
    let session = hold_uvs(upload, editing, &options).map_err(|e| failure(&e))?;
    Ok((Box::new(UvHand::new(session)), json!(options.anchors)))
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
