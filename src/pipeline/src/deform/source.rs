//! What is deformed, from files and back.

use super::formats::BodyFormat;
use super::moved::{check_format, check_frames, moved, moved_frame};
use super::planar_map::PlanarMap;
use crate::PipelineError;
use crate::documents::merged::Merged;
use crate::limits;
use unwrapd_api::Limits;
use unwrapd_deform::outline::{self, ImageSettings, MeshSettings, Resolution, SvgSettings};
use unwrapd_deform::{Body, Problem};
use unwrapd_files::document::{Document, GroupBy, OutputFormat, Upload};
use unwrapd_files::io::{Content, ElementFormat, Elements, Format, format_of_content};
use unwrapd_files::picture::Image;
use unwrapd_maps::mesh::Surface;

/// About how many triangles an outline is filled with, unless an option says otherwise.
pub const TRIANGLES: usize = 5000;

/// The mesh of a file.
pub struct Source {
    elements: Elements,
    /// What the triangles belong to, where that is more than triangles.
    document: Option<Document>,
}

impl Source {
    /// The mesh of a file, or of the outline in a picture or drawing, that is filled with about so many triangles. Its kind is known
    /// by the extension of its name, of a file without one by its first bytes.
    pub fn read(upload: &Upload, triangles: usize, limits: &Limits) -> Result<Self, PipelineError> {
        let format = if upload.extension().is_empty() {
            other_than_documents(&upload.bytes)
        } else {
            Format::of_name(&upload.name)
        };
        let drawn = drawn(&upload.bytes, format, triangles, limits)?;
        if drawn.is_none() && triangles != TRIANGLES {
            let text = "`triangles` fill an outline, and this input is a mesh";
            return Err(PipelineError::InvalidOptions(text.to_owned()));
        }
        let (elements, document) = if let Some(elements) = drawn {
            (elements, None)
        } else if let Some(format) = format.and_then(ElementFormat::of) {
            (format.read(&upload.bytes)?, None)
        } else {
            let document = Document::read(upload)?;
            (surface(&document)?, Some(document))
        };
        limits::check_count(limits, elements.triangles.len() + elements.tets.len())?;
        Ok(Self { elements, document })
    }

    /// Its tetrahedra, or else its triangles, which must lie in a plane.
    pub fn body(&self) -> Result<Body, PipelineError> {
        let elements = self.elements.clone();
        Ok(if elements.tets.is_empty() {
            Body::from(&elements.into_planar_mesh()?)
        } else {
            Body::from(&elements.into_tet_mesh()?)
        })
    }

    /// The format of the result where none was asked for: the input's if possible.
    pub fn format(&self, upload: &Upload) -> BodyFormat {
        BodyFormat::of_name(&upload.name)
            .filter(|&format| self.check(format, false).is_ok())
            .unwrap_or(BodyFormat::Obj)
    }

    /// Can the result be written like this?
    pub fn check(&self, format: BodyFormat, with_frames: bool) -> Result<(), PipelineError> {
        match self.whole(format) {
            Some((_, format)) if with_frames => check_frames(format),
            Some((document, format)) => Ok(check_format(document, format)?),
            None => format.check_for_mesh(),
        }
    }

    /// The document and its format, if the result is one.
    fn whole(&self, format: BodyFormat) -> Option<(&Document, OutputFormat)> {
        let is_mesh = format.check_for_mesh().is_ok();
        let format = format.of_document().filter(|_| !is_mesh)?;
        self.document.as_ref().map(|document| (document, format))
    }

    /// The files of the result of a problem under the name `stem`, the main file first, at the positions `x`.
    pub fn files(
        &self,
        format: BodyFormat,
        stem: &str,
        problem: &Problem,
        x: &[f64],
    ) -> Result<Vec<(String, Vec<u8>)>, PipelineError> {
        if let Some((document, format)) = self.whole(format) {
            let map = PlanarMap::new(&self.elements, x.as_chunks().0);
            return Ok(moved(document, &map, format, stem)?.1.files);
        }
        let name = format!("{stem}.{}", format.extension());
        Ok(vec![(name, format.write(&self.elements, problem, x))])
    }

    /// The main file alone.
    pub fn frame(&self, format: BodyFormat, problem: &Problem, x: &[f64]) -> Vec<u8> {
        match self.whole(format) {
            Some((document, format)) => {
                let map = PlanarMap::new(&self.elements, x.as_chunks().0);
                moved_frame(document, &map, format)
            }
            None => format.write(&self.elements, problem, x),
        }
    }
}

/// What the content says of files that are no documents, which know their own formats.
fn other_than_documents(bytes: &[u8]) -> Option<Format> {
    let format = format_of_content(bytes, bytes.len() as u64, Content::Body);
    format.filter(|format| !format.holds(Content::Surface))
}

/// The mesh of the outline in a picture or drawing, if it is one.
fn drawn(
    bytes: &[u8],
    format: Option<Format>,
    triangles: usize,
    limits: &Limits,
) -> Result<Option<Elements>, PipelineError> {
    let Some(format @ (Format::Svg | Format::Png)) = format else {
        return Ok(None);
    };
    limits::check_count(limits, triangles)?;
    let outline = if format == Format::Svg {
        let text = String::from_utf8_lossy(bytes);
        outline::of_svg(&text, &SvgSettings::default())?
    } else {
        let image = Image::decode(bytes)?;
        outline::of_image(&image, &ImageSettings::default())?
    };
    Ok(Some(filled(&outline, triangles)?))
}

fn filled(outline: &outline::Outline, triangles: usize) -> Result<Elements, PipelineError> {
    let settings = MeshSettings {
        resolution: Resolution::Triangles(triangles),
        ..MeshSettings::default()
    };
    Ok(Elements::from(&outline::triangulate(outline, &settings)?))
}

/// All triangles of a document, welded by position.
fn surface(document: &Document) -> Result<Elements, PipelineError> {
    let groups = document.groups(GroupBy::Scene);
    let merged = groups.first().ok_or(PipelineError::NoTriangles)?;
    let merged = Merged::new(document.primitives(), merged);
    let surface = Surface::new(&merged.positions, &merged.triangles)?;
    Ok(Elements {
        vertices: surface.positions,
        triangles: surface.triangles,
        tets: Vec::new(),
    })
}
