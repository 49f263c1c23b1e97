//! The state of a session, on a body, a picture, UVs or islands: messages in, frames out.

use serde::de::DeserializeOwned;
use serde_json::{Value, json};

use super::editing::{
    Edited, LiveEditing, Message, NamedHandles, Reply, SessionCommand, View, check_model, parsed,
};
use super::frame::{self, Drawn, FrameElements, FrameHeader};
use unwrapd_api::{Failure, Kind, Limits, Upload};
use unwrapd_deform::uv::{Anchor, EditError, LiveUvs, UvSession};
use unwrapd_deform::warp::PictureHandle;
use unwrapd_deform::{Handle, LiveBody, ProblemError, Session};
use unwrapd_method::solver::Stage;
use unwrapd_pipeline::{
    self as pipeline, CommandOptions, DeformOptions, EditOptions, Island, IslandError,
    IslandHandle, IslandSession, LiveIslands, PipelineError, RepackOptions, SessionBody,
    SessionUvs, WarpOptions, open_body, open_islands, open_picture, open_uvs,
};

/// State of a session. It depends only on the input, the messages, and the iterations that these precede.
pub struct LiveSession {
    editing: Box<dyn LiveEditing>,
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
        let (editing, handles): (Box<dyn LiveEditing>, Value) = match kind {
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
            Kind::Repack => {
                let options: RepackOptions = read(options, limits)?;
                let islands = open_islands(upload, &options).map_err(|e| failure(&e))?;
                let islands = NamedHandles::new(IslandView::new(islands));
                (Box::new(islands), json!(options.islands))
            }
            Kind::Unwrap | Kind::Measure | Kind::Verify | Kind::Solve | Kind::Untangle => {
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
            session
                .editing
                .execute(&SessionCommand::Add { name, handle })?;
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
        let header = FrameHeader {
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
            SessionCommand::Undo {}
                | SessionCommand::Redo {}
                | SessionCommand::Reset {}
                | SessionCommand::List {}
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
    /// [start](unwrapd_api::START) if it has one.
    pub fn baked(&mut self) -> (Vec<Value>, Option<Vec<f64>>) {
        (self.editing.job_handles(), self.editing.view().start())
    }
}

/// Opens UVs for live editing, and returns the anchors of the options.
fn uvs(
    upload: &Upload,
    editing: pipeline::Editing,
    options: &Value,
    limits: Limits,
) -> Result<(Box<dyn LiveEditing>, Value), Failure> {
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
    let mut options: O = serde_json::from_value(options.clone())
        .map_err(|error| Failure::new("invalid_options", error.to_string()))?;
    options.caller_mut().limits = limits;
    Ok(options)
}

fn failure(error: &PipelineError) -> Failure {
    Failure::new(error.code(), error.to_string())
}

// Live editing of a body or a picture.

/// Format of handles.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum HandleFormat {
    /// Vertices, places and discs.
    Body,
    /// Places only, because the body is a cage.
    Cage,
    /// Pixels.
    Picture,
}

/// A body or a picture under live editing.
pub(super) struct BodyView {
    held: SessionBody,
    format: HandleFormat,
    /// Determinant of each element at rest.
    rest: Vec<f64>,
    /// Handles that no client added: a fixed border.
    border: Vec<Handle>,
}

impl BodyView {
    /// Wraps a body whose only handles are its fixed border.
    pub fn new(held: SessionBody, format: HandleFormat) -> Self {
        let border = held.session.handles().map(|(_, handle)| handle.clone());
        Self {
            rest: held.body.determinants(),
            border: border.collect(),
            held,
            format,
        }
    }
}

impl BodyView {
    /// Returns a handle with what its selector names.
    fn filled(&self, mut handle: Handle) -> Result<Handle, Failure> {
        self.held
            .fill(&mut handle)
            .map_err(|error| failure(&error))?;
        Ok(handle)
    }
}

impl Edited for BodyView {
    type Map = LiveBody;

    fn editor(&self) -> &Session {
        &self.held.session
    }

    fn editor_mut(&mut self) -> &mut Session {
        &mut self.held.session
    }

    fn read(&self, name: u32, handle: Value) -> Result<Handle, Failure> {
        match self.format {
            HandleFormat::Body => self.filled(parsed(handle)?),
            HandleFormat::Picture => {
                let handle: PictureHandle = parsed(handle)?;
                Ok(handle.into())
            }
            HandleFormat::Cage => {
                let handle: Handle = parsed(handle)?;
                if handle.names_vertices() {
                    let handle = name as usize;
                    return Err(Self::failure(&ProblemError::VertexOfCage { handle }));
                }
                self.filled(handle)
            }
        }
    }

    fn failure(error: &ProblemError) -> Failure {
        Failure::new(error.code(), error.to_string())
    }

    fn reset(&mut self) {
        self.held.session.reset();
        for handle in &self.border {
            // A body at rest held where it is: nothing contradicts that.
            let _ = self.held.session.add(handle.clone());
        }
    }
}

impl View for BodyView {
    fn energy(&self) -> f64 {
        self.held.session.summary().energy_last
    }

    fn positions(&self) -> Vec<f64> {
        self.held.session.positions()
    }

    fn smallest(&self, positions: &[f64]) -> f64 {
        let now = self.held.body.determinants_at(positions);
        let ratios = now.iter().zip(&self.rest).map(|(now, rest)| now / rest);
        ratios.fold(f64::INFINITY, f64::min)
    }

    fn elements(&self) -> FrameElements<'_> {
        FrameElements::of_body(&self.held.body)
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.held.body.rest.clone(),
            triangles: &self.held.triangles,
            skin: self.held.skin.as_ref(),
            picture: self.held.picture,
        }
    }

    fn start(&self) -> Option<Vec<f64>> {
        Some(self.positions())
    }
}

// Live editing of UVs.

/// UVs under live editing.
pub(super) struct UvView(pub SessionUvs);

impl Edited for UvView {
    type Map = LiveUvs;

    fn editor(&self) -> &UvSession {
        &self.0.session
    }

    fn editor_mut(&mut self) -> &mut UvSession {
        &mut self.0.session
    }

    fn read(&self, _: u32, handle: Value) -> Result<Anchor, Failure> {
        let mut anchor = parsed(handle)?;
        self.0.fill(&mut anchor).map_err(|error| failure(&error))?;
        Ok(anchor)
    }

    fn failure(error: &EditError) -> Failure {
        Failure::new(error.code(), error.to_string())
    }

    fn reset(&mut self) {
        self.0.session.reset();
    }
}

impl View for UvView {
    fn energy(&self) -> f64 {
        self.0.session.energy()
    }

    fn positions(&self) -> Vec<f64> {
        self.0.session.vertex_uvs().into_flattened()
    }

    fn smallest(&self, _: &[f64]) -> f64 {
        self.0.session.smallest()
    }

    fn elements(&self) -> FrameElements<'_> {
        let signs = self.0.session.kept_signs();
        FrameElements::Triangles(self.0.session.faces(), Some(signs))
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.positions(),
            triangles: self.0.session.faces(),
            skin: None,
            picture: None,
        }
    }

    fn start(&self) -> Option<Vec<f64>> {
        let corners = self.0.session.uvs().into_flattened();
        Some(corners.into_flattened())
    }
}

// Live arrangement of islands.

/// Islands, some of them held.
pub(super) struct IslandView {
    session: IslandSession,
    /// Sign of the area of each face.
    signs: Vec<i8>,
}

impl IslandView {
    pub fn new(session: IslandSession) -> Self {
        Self {
            signs: session.map().signs(),
            session,
        }
    }
}

impl Edited for IslandView {
    type Map = LiveIslands;

    fn editor(&self) -> &IslandSession {
        &self.session
    }

    fn editor_mut(&mut self) -> &mut IslandSession {
        &mut self.session
    }

    fn read(&self, name: u32, handle: Value) -> Result<Island, Failure> {
        let handle: IslandHandle = parsed(handle)?;
        let named = self.session.map().named(name as usize, &handle);
        named.map_err(|error| Self::failure(&error))
    }

    fn failure(error: &IslandError) -> Failure {
        Failure::new(error.code(), error.to_string())
    }

    fn reset(&mut self) {
        self.session.reset();
    }

    /// Returns the places of all islands: the job has no more to do than to write them.
    fn job_handles(&mut self, _: Vec<Value>) -> Vec<Value> {
        // Make room for what was held last.
        if self.session.stage() == Stage::Moving {
            self.session.step();
        }
        let islands = self.session.map().placements().into_iter();
        islands.map(|island| json!(island)).collect()
    }
}

impl View for IslandView {
    fn energy(&self) -> f64 {
        f64::NAN
    }

    fn positions(&self) -> Vec<f64> {
        self.session.map().vertex_uvs().into_flattened()
    }

    fn smallest(&self, _: &[f64]) -> f64 {
        self.session.map().smallest()
    }

    fn elements(&self) -> FrameElements<'_> {
        let signs = self.signs.clone();
        FrameElements::Triangles(self.session.map().faces(), Some(signs))
    }

    fn drawn(&self) -> Drawn<'_> {
        Drawn {
            rest: self.positions(),
            triangles: self.session.map().faces(),
            skin: None,
            picture: None,
        }
    }

    fn start(&self) -> Option<Vec<f64>> {
        None
    }
}
