//! Files as bodies for live sessions.

use super::caged::{positions, selection, surfaces};
use super::solve::no_selection;
use super::source::Source;
use crate::PipelineError;
use crate::documents::corner_selection::VertexSelection;
use crate::limits;
use crate::options::{CommandOptions, DeformOptions, WarpOptions};
use unwrapd_deform::cage::{Cage, Embedding};
use unwrapd_deform::warp::{WarpError, picture_grid};
use unwrapd_deform::{Body, BodyElements, Boundary, Handle, Session};
use unwrapd_files::document::{Document, Upload};
use unwrapd_files::picture::Image;
use unwrapd_maps::mesh::boundary_triangles;

/// Body of a file for a live session, with its visible parts.
pub struct SessionBody {
    /// Session at rest, with handles on a fixed border if there is one.
    pub session: Session,
    /// Body that is deformed.
    pub body: Body,
    /// Visible triangles, over the vertices of the body or of the skin.
    pub triangles: Vec<[u32; 3]>,
    /// Surface that follows a cage.
    pub skin: Option<Skin>,
    /// Selection of vertices of the body by materials, objects and colors, if the file has any.
    selection: Option<VertexSelection>,
    /// Columns and rows of the picture that lies on the body at rest.
    pub picture: Option<[usize; 2]>,
}

/// A surface in a body of tetrahedra. Each vertex is a weighted mean of the corners of one tetrahedron.
pub struct Skin {
    /// Four vertices of the body for each vertex of the surface.
    pub corners: Vec<[u32; 4]>,
    /// Weights of these, which sum to 1 up to rounding.
    pub weights: Vec<[f64; 4]>,
}

/// Opens a session on the body that [`deform_file`](crate::deform_file) would deform. The caller adds the handles.
pub fn open_body(upload: &Upload, options: &DeformOptions) -> Result<SessionBody, PipelineError> {
    options.check()?;
    let Some(n_voxels) = options.cage else {
        let source = Source::read(upload, options.triangles, &options.caller.limits)?;
        let body = source.body()?;
        let triangles = match &body.elements {
            BodyElements::Triangles { corners, .. } => corners.clone(),
            BodyElements::Tetrahedra { corners, .. } => boundary_triangles(corners),
        };
        let selection = source.selection(upload)?;
        return Ok(SessionBody {
            selection,
            ..SessionBody::new(body, triangles, options)?
        });
    };
    // Build a cage around the surfaces.
    let document = Document::read(upload)?;
    limits::check(&options.caller.limits, &document)?;
    let positions = positions(&document);
    let surfaces = surfaces(&document, &positions);
    let cage = Cage::around(&surfaces, n_voxels)?;
    // Embed the surfaces as a skin.
    let mut triangles = Vec::new();
    let mut places = Vec::new();
    for surface in &surfaces {
        let first = places.len() as u32;
        triangles.extend(surface.triangles.iter().map(|t| t.map(|v| v + first)));
        places.extend_from_slice(surface.positions);
    }
    let Embedding { tets, weights } = cage.embed(&places)?;
    let corners = tets.iter().map(|&tet| cage.mesh().tets()[tet as usize]);
    let corners = corners.collect();
    let opened = SessionBody::new(Body::from(cage.mesh()), triangles, options)?;
    Ok(SessionBody {
        selection: Some(selection(&document, &cage)?),
        skin: Some(Skin { corners, weights }),
        ..opened
    })
}

impl SessionBody {
    /// Fills in what the selector of a handle names, if it has one.
    ///
    /// # Errors
    /// If the selector cannot be parsed, or names what the file does not have.
    pub fn fill(&self, handle: &mut Handle) -> Result<(), PipelineError> {
        let Some(select) = handle.select_mut() else {
            return Ok(());
        };
        let selection = self.selection.as_ref().ok_or_else(no_selection)?;
        selection.fill([select])
    }

    fn new(
        body: Body,
        triangles: Vec<[u32; 3]>,
        options: &DeformOptions,
    ) -> Result<Self, PipelineError> {
        Ok(Self {
            session: Session::new(body.clone(), &options.model)?,
            body,
            triangles,
            skin: None,
            selection: None,
            picture: None,
        })
    }
}

/// Opens a session on the grid on which [`warp_file`](crate::warp_file) would warp a picture, in pixels with y down.
/// The caller adds the handles.
pub fn open_picture(upload: &Upload, options: &WarpOptions) -> Result<SessionBody, PipelineError> {
    options.check()?;
    let image = Image::decode(&upload.bytes)?;
    let how = options.of_grid();
    let grid = picture_grid(image.width, image.height, how.grid).map_err(WarpError::from)?;
    let body = Body::from(&grid);
    let mut session = Session::new(body.clone(), &options.model)?;
    if how.boundary == Boundary::Fixed {
        for [vertex, _] in grid.boundary() {
            let to = grid.vertices()[vertex as usize].to_vec();
            let weight = None;
            session.add(Handle::Vertex { vertex, to, weight })?;
        }
    }
    Ok(SessionBody {
        session,
        body,
        triangles: grid.triangles().to_vec(),
        skin: None,
        selection: None,
        picture: Some([image.width, image.height]),
    })
}
