//! Input bodies, from files and back.

use crate::documents::corner_selection::{CornerSelection, VertexSelection};
use crate::documents::input::Merged;
use crate::options::{BodyFormat, TRIANGLES};
use crate::{PipelineError, limits};
use std::collections::HashMap;
use unwrapd_api::Limits;
use unwrapd_deform::outline::{self, ImageSettings, MeshSettings, OutlineResolution, SvgSettings};
use unwrapd_deform::{Body, Problem};
use unwrapd_files::document::{
    Document, DocumentError, GroupBy, Layout, NewUvs, OutputFormat, SpaceMap, Upload, WriteOptions,
    Written,
};
use unwrapd_files::io::{Content, ElementFormat, Elements, Format, format_of_content};
use unwrapd_files::picture::Image;
use unwrapd_maps::mesh::Surface;
use unwrapd_method::numerics::square::{Matrix, Square, apply, apply_transposed, times};
use unwrapd_method::numerics::vec3;

/// Returns the selection of the vertices of a mesh by materials, objects and colors of its file; `None` for formats other
/// than OBJ.
pub fn selection(
    upload: &Upload,
    elements: &Elements,
) -> Result<Option<VertexSelection>, PipelineError> {
    if Format::of_name(&upload.name) != Some(Format::Obj) {
        return Ok(None);
    }
    let faces = (0..elements.triangles.len() as u32).collect();
    selection_of(Document::read(upload)?, faces, elements).map(Some)
}

/// Returns the selection of the vertices of a mesh whose triangles are these faces of a document.
fn selection_of(
    document: Document,
    faces: Vec<u32>,
    elements: &Elements,
) -> Result<VertexSelection, PipelineError> {
    let groups = document.groups(GroupBy::Scene);
    let group = groups.first().ok_or(PipelineError::NoTriangles)?;
    let primitives = group.primitives.clone();
    Ok(VertexSelection {
        corners: CornerSelection::new(document, primitives),
        faces,
        triangles: elements.triangles.clone(),
        carriers: None,
    })
}

/// The mesh of a file.
pub struct Source {
    elements: Elements,
    /// Document of the triangles, if they have one, and the face of each in it.
    document: Option<(Document, Vec<u32>)>,
}

impl Source {
    /// Reads the mesh of a file, or fills the outline in a picture or drawing with about `triangles` triangles. The
    /// extension determines the format; without one, the first bytes do.
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
            let (elements, faces) = surface(&document)?;
            (elements, Some((document, faces)))
        };
        limits::check_count(limits, elements.triangles.len() + elements.tets.len())?;
        Ok(Self { elements, document })
    }

    /// Returns its tetrahedra, or else its triangles, which must lie in a plane.
    pub fn body(&self) -> Result<Body, PipelineError> {
        let elements = self.elements.clone();
        Ok(if elements.tets.is_empty() {
            Body::from(&elements.into_planar_mesh()?)
        } else {
            Body::from(&elements.into_tet_mesh()?)
        })
    }

    /// Returns the selection of its vertices by materials, objects and colors; `None` for formats that have none.
    pub fn selection(&self, upload: &Upload) -> Result<Option<VertexSelection>, PipelineError> {
        match &self.document {
            Some((document, faces)) => {
                selection_of(document.clone(), faces.clone(), &self.elements).map(Some)
            }
            None => selection(upload, &self.elements),
        }
    }

    /// Returns the default format of the result: the input's if possible, else OBJ.
    pub fn format(&self, upload: &Upload) -> BodyFormat {
        BodyFormat::of_name(&upload.name)
            .filter(|&format| self.check(format, false).is_ok())
            .unwrap_or(BodyFormat::Obj)
    }

    /// Checks that the result can be written in a format.
    pub fn check(&self, format: BodyFormat, with_frames: bool) -> Result<(), PipelineError> {
        match self.whole(format) {
            Some((_, format)) if with_frames => check_frames(format),
            Some((document, format)) => Ok(check_format(document, format)?),
            None => format.check_for_mesh(),
        }
    }

    /// Returns the document and its format if the result is a document.
    fn whole(&self, format: BodyFormat) -> Option<(&Document, OutputFormat)> {
        let is_mesh = format.check_for_mesh().is_ok();
        let format = format.of_document().filter(|_| !is_mesh)?;
        let document = self.document.as_ref();
        document.map(|(document, _)| (document, format))
    }

    /// Returns the files of a problem's result at the positions `x` under the name `stem`, the main file first.
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

    /// Returns only the main file of the result at the positions `x`.
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

/// Detects the format of files by their content, except of documents, which detect their own.
fn other_than_documents(bytes: &[u8]) -> Option<Format> {
    let format = format_of_content(bytes, bytes.len() as u64, Content::Body);
    format.filter(|format| !format.holds(Content::Surface))
}

/// Returns the mesh of the outline in a picture or drawing; `None` for other formats.
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
        resolution: OutlineResolution::Triangles(triangles),
        ..MeshSettings::default()
    };
    Ok(Elements::from(&outline::triangulate(outline, &settings)?))
}

/// Returns all triangles of a document, welded by position, and the face of each in it.
fn surface(document: &Document) -> Result<(Elements, Vec<u32>), PipelineError> {
    let groups = document.groups(GroupBy::Scene);
    let merged = groups.first().ok_or(PipelineError::NoTriangles)?;
    let merged = Merged::new(document.primitives(), merged);
    let surface = Surface::new(&merged.positions, &merged.triangles)?;
    let elements = Elements {
        vertices: surface.positions,
        triangles: surface.triangles,
        tets: Vec::new(),
    };
    Ok((elements, surface.faces))
}

// The map defined by a deformed planar mesh, applied to the document that it was read from.

/// Map of vertices in a plane z = const, which keeps z. Other places, those of vertices without triangles, stay.
pub struct PlanarMap<'a> {
    vertices: HashMap<[u32; 3], usize>,
    to: &'a [[f64; 2]],
    /// Jacobian of the map at each vertex: the mean over its triangles weighted by area. Not invertible if they
    /// cancel.
    jacobians: Vec<Matrix<2>>,
}

impl<'a> PlanarMap<'a> {
    /// Creates the map from the mesh at rest, with the vertices of the document, and its deformed vertices.
    pub fn new(rest: &Elements, to: &'a [[f64; 2]]) -> Self {
        // Sum the Jacobians of the triangles at each vertex, weighted by area.
        let mut jacobians = vec![[[0.0; 2]; 2]; to.len()];
        let mut areas = vec![0.0; to.len()];
        for &[a, b, c] in &rest.triangles {
            let [a, b, c] = [a, b, c].map(|v| v as usize);
            let edges = |p: &dyn Fn(usize, usize) -> f64| {
                [0, 1].map(|k| [p(b, k) - p(a, k), p(c, k) - p(a, k)])
            };
            let (before, after) = (edges(&|v, k| rest.vertices[v][k]), edges(&|v, k| to[v][k]));
            let det = before.det();
            let jacobian = times(&after, &before.inverse(det));
            for v in [a, b, c] {
                areas[v] += det.abs();
                for (sum, row) in jacobians[v].iter_mut().zip(&jacobian) {
                    for (sum, entry) in sum.iter_mut().zip(row) {
                        *sum += det.abs() * entry;
                    }
                }
            }
        }
        // Divide the sums by the areas.
        for (sum, area) in jacobians.iter_mut().zip(&areas) {
            *sum = sum.map(|row| row.map(|entry| entry / area));
        }
        let places = rest.vertices.iter().enumerate();
        Self {
            vertices: places.map(|(v, p)| (key(p.map(|x| x as f32)), v)).collect(),
            to,
            jacobians,
        }
    }

    fn vertex(&self, place: &[f32; 3]) -> Option<usize> {
        self.vertices.get(&key(*place)).copied()
    }

    /// Applies a linear map, derived from the Jacobian at each place, to the first two coordinates of vectors, and
    /// normalizes them.
    fn turned(
        &self,
        places: &[[f32; 3]],
        vectors: &[[f32; 3]],
        linear: impl Fn(&Matrix<2>, &[f64; 2]) -> [f64; 2],
    ) -> Vec<[f32; 3]> {
        let turned = places.iter().zip(vectors).map(|(place, vector)| {
            let jacobian = self.vertex(place).map(|v| self.jacobians[v]);
            match jacobian.filter(|jacobian| jacobian.det() > 0.0) {
                Some(jacobian) => {
                    let [x, y, z] = vector.map(f64::from);
                    let [x, y] = linear(&jacobian, &[x, y]);
                    vec3::unit([x, y, z]).map(|x| x as f32)
                }
                None => *vector,
            }
        });
        turned.collect()
    }
}

impl SpaceMap for PlanarMap<'_> {
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let moved = places.iter().map(|place| match self.vertex(place) {
            Some(v) => [self.to[v][0] as f32, self.to[v][1] as f32, place[2]],
            None => *place,
        });
        moved.collect()
    }

    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        self.turned(places, normals, |jacobian, normal| {
            apply_transposed(&jacobian.inverse(jacobian.det()), normal)
        })
    }

    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]> {
        self.turned(places, tangents, apply)
    }
}

/// Returns a key that is equal for equal places.
fn key(place: [f32; 3]) -> [u32; 3] {
    // −0 is 0.
    place.map(|x| (x + 0.0).to_bits())
}

// Documents with moved surfaces and everything else unchanged.

/// Applies a map to a document. Returns the document, and its files under the name `stem`.
pub fn moved(
    document: &Document,
    map: &dyn SpaceMap,
    format: OutputFormat,
    stem: &str,
) -> Result<(Document, Written), DocumentError> {
    let moved = document.clone().moved(map)?;
    let options = WriteOptions {
        format,
        stem: stem.to_owned(),
        texcoord: None,
        overwrite: false,
        terms: None,
    };
    let no_uvs = NewUvs {
        layout: Layout::Edited,
        v_axis: moved.v_axis(),
        corners: vec![None; moved.primitives().len()],
    };
    let written = moved.write(&no_uvs, &options)?;
    Ok((moved, written))
}

/// Returns the main file of the moved document; empty if it cannot be written, since its result will be rejected,
/// too.
pub fn moved_frame(document: &Document, map: &dyn SpaceMap, format: OutputFormat) -> Vec<u8> {
    let files = moved(document, map, format, "frame").map(|(_, written)| written.files);
    let main = files.ok().and_then(|files| files.into_iter().next());
    main.map_or(Vec::new(), |(_, bytes)| bytes)
}

/// Rejects frames in a format whose files refer to others.
pub fn check_frames(format: OutputFormat) -> Result<(), PipelineError> {
    if format == OutputFormat::Gltf {
        let text = "`frames` are one file each: glb or obj, not gltf".to_owned();
        return Err(PipelineError::InvalidOptions(text));
    }
    Ok(())
}

/// Rejects formats that would lose UVs and materials.
pub fn check_format(document: &Document, format: OutputFormat) -> Result<(), DocumentError> {
    let lost = match (document, format) {
        (Document::Gltf(_), OutputFormat::Obj) => "a deformed glTF document as OBJ",
        (Document::Obj(_), OutputFormat::Glb | OutputFormat::Gltf) => "a deformed OBJ file as glTF",
        _ => return Ok(()),
    };
    Err(DocumentError::UnsupportedOutput(lost.to_owned()))
}
