//! OFF, PLY and STL: triangles without a document around them. They are written as new glTF or OBJ files.

use super::error::{listed, unused_not_finite};
use super::new_obj::{Color, from_srgb};
use super::{DocumentError, Primitive, SpaceMap, Subdivision, Upload, Warning, format_of};
use crate::io::{self, Fanned, Format};
use unwrapd_maps::mesh::CornerUvs;

/// Content of a file.
#[derive(Clone)]
pub struct SoupDocument {
    pub(super) primitives: Vec<Primitive>,
    /// Colors of the vertices, if the file has any.
    pub(super) colors: Option<Vec<Color>>,
    pub(super) warnings: Vec<Warning>,
}

impl SoupDocument {
    /// Reads the main file.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        let format = format_of(upload);
        let (mesh, place) = match format {
            Some(Format::Off) => (io::off::read(&upload.bytes)?, "line"),
            Some(Format::Ply) => (io::ply::read(&upload.bytes)?, "face"),
            Some(Format::Stl) => (io::stl::read(&upload.bytes)?, "line"),
            _ => return Err(DocumentError::UnknownFormat),
        };
        let fanned = warning(&mesh.fanned, place);
        let mut primitive = Primitive::of_file(mesh)?;
        let unused = unused_not_finite(primitive.place_unused());
        let mut document = Self {
            warnings: fanned.into_iter().chain(unused).collect(),
            primitives: vec![primitive],
            colors: None,
        };
        if format == Some(Format::Ply) {
            document.add(io::ply::extras(&upload.bytes)?);
        }
        Ok(document)
    }

    /// Returns the warnings of reading.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Returns the colors of the vertices.
    pub(super) fn colors(&self) -> Option<&[Color]> {
        self.colors.as_deref()
    }

    fn add(&mut self, extras: io::ply::Extras) {
        if !extras.left_out.is_empty() {
            let names = listed(extras.left_out.iter().map(String::as_str));
            let message = format!("unsupported PLY properties are left out: {names}");
            self.warnings
                .push(Warning::new("properties_dropped", message));
        }
        let colors = extras.colors.into_iter().flatten().map(from_srgb);
        let colors: Vec<Color> = colors.collect();
        self.colors = (colors.len() == self.primitives[0].positions.len()).then_some(colors);
    }

    /// Returns the triangles: all polygons of the file as one primitive.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// Cuts the triangles into pieces.
    #[must_use]
    pub fn subdivided(mut self, cuts: &[Subdivision]) -> Self {
        for (primitive, cut) in self.primitives.iter_mut().zip(cuts) {
            if let Some(colors) = &mut self.colors {
                cut.interpolate(colors);
            }
            cut.apply(primitive);
        }
        self
    }

    /// Moves the triangles by a map.
    pub fn moved(mut self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        let positions = &mut self.primitives[0].positions;
        *positions = map.positions(positions);
        match positions
            .iter()
            .position(|p: &[f32; 3]| !p.iter().all(|x| x.is_finite()))
        {
            Some(vertex) => Err(DocumentError::NonFinitePosition(format!("vertex {vertex}"))),
            None => Ok(self),
        }
    }

    /// Returns `None`: UVs of these formats are not read.
    pub fn corner_uvs(
        &self,
        _primitive: usize,
        _set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        Ok(None)
    }
}

/// Returns a warning about polygons without an inside, if there are any; `place` names the unit of their places.
pub(super) fn warning(fanned: &Fanned, place: &str) -> Option<Warning> {
    let n = fanned.n_polygons;
    let mut places: Vec<String> = fanned.first.iter().map(usize::to_string).collect();
    if n > places.len() {
        places.push("…".to_owned());
    }
    let places = places.join(", ");
    let message = match n {
        0 => return None,
        1 => format!(
            "1 polygon crosses itself or has no area ({place} {places}). It became a triangle fan, which may \
             overlap. Repair it and unwrap again."
        ),
        _ => format!(
            "{n} polygons cross themselves or have no area ({place}s {places}). They became triangle fans, \
             which may overlap. Repair them and unwrap again."
        ),
    };
    Some(Warning::new("polygon_fanned", message))
}
