//! glTF and other files, read and written with everything else preserved.
//!
//! A [`Document`] is the whole content of a file; [`Primitive`]s are the triangles in it. Nothing is welded, repaired
//! or reordered here: positions are rounded to f32 and otherwise passed on as in the file, and a new UV set is written
//! into the document of record, so nothing that an unwrapping was not asked to change can be lost.
//!
//! This module does no input or output of its own. An [`Upload`] carries the main file and every file to which it may
//! refer; a URI that is neither data nor a member of the upload is an error, never an open file or a connection. Every
//! input is treated as hostile: counts are believed only as far as bytes back them, and every failure is a
//! [`DocumentError`].
#![doc = include_str!("formats.md")]
mod bake;
mod colors;
mod conversion;
mod error;
mod fanned;
pub mod gltf;
mod group;
mod mark;
mod material;
mod new_gltf;
mod new_obj;
mod notes;
pub mod obj;
mod obj_gltf;
mod obj_mark;
mod obj_materials;
mod obj_parts;
mod obj_text;
mod references;
pub mod soup;
mod space_map;
mod subdivision;
mod texcoord_lines;
mod uvs;
mod warning;

use crate::io::Format;
pub use bake::{
    BakePlan, BakePlane, BakedTexture, BakedTextures, CornerTangents, Encoding, KeptTexture,
    TextureSource, Wrap,
};
pub use conversion::{Conversion, OldUvs};
pub use error::DocumentError;
pub use group::{Group, GroupBy, Primitive};
pub use mark::{Mark, Marked, Sets, Terms};
pub use notes::{AffectedTexture, PrimitiveNote, TangentsNote, WriteNotes};
pub use references::{format_of, references, with_references};
pub use space_map::SpaceMap;
pub use subdivision::{AddedVertex, Subdivision};
pub use unwrapd_api::{Upload, Warning};
use unwrapd_maps::mesh::{CornerUvs, VAxis};
pub use uvs::{Corners, Layout, NewUvs, OutputFormat, WriteOptions, Written};

/// Content of a file.
#[derive(Clone)]
pub enum Document {
    /// glTF 2.0, `.glb` or `.gltf`.
    Gltf(gltf::GltfDocument),
    /// Wavefront OBJ.
    Obj(obj::ObjDocument),
    /// OFF, PLY or STL: triangles without a document around them.
    Soup(soup::SoupDocument),
}

impl Document {
    /// Reads the main file of `upload`; its format is determined by its content, else by the extension of its name.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        match format_of(upload) {
            Some(Format::Glb | Format::Gltf) => gltf::GltfDocument::read(upload).map(Self::Gltf),
            Some(Format::Obj) => obj::ObjDocument::read(upload).map(Self::Obj),
            _ => soup::SoupDocument::read(upload).map(Self::Soup),
        }
    }

    /// Returns the warnings of reading for users.
    pub fn warnings(&self) -> &[Warning] {
        match self {
            Self::Gltf(document) => document.warnings(),
            Self::Obj(document) => document.warnings(),
            Self::Soup(document) => document.warnings(),
        }
    }

    /// Returns the triangle primitives in file order.
    pub fn primitives(&self) -> &[Primitive] {
        match self {
            Self::Gltf(document) => document.primitives(),
            Self::Obj(document) => document.primitives(),
            Self::Soup(document) => document.primitives(),
        }
    }

    /// Returns the default grouping of UV spaces: by material for glTF, else all of a file, as that has one UV space.
    pub fn grouping(&self) -> GroupBy {
        match self {
            Self::Gltf(_) => GroupBy::Material,
            Self::Obj(_) | Self::Soup(_) => GroupBy::Scene,
        }
    }

    /// Groups the primitives that share one UV space, in the order of their first primitives. Files without meshes and
    /// materials are one group.
    pub fn groups(&self, by: GroupBy) -> Vec<Group> {
        match self {
            Self::Gltf(document) => group::groups(self.primitives(), by, document),
            Self::Obj(_) | Self::Soup(_) => {
                group::groups(self.primitives(), GroupBy::Scene, &group::Nameless)
            }
        }
    }

    /// Returns the index of a material with this name, or else with this number; files other than glTF are read without
    /// materials.
    pub fn material(&self, name: &str) -> Option<usize> {
        match self {
            Self::Gltf(document) => document.material(name),
            Self::Obj(_) | Self::Soup(_) => None,
        }
    }

    /// Returns the direction of v in the numbers of the file.
    pub fn v_axis(&self) -> VAxis {
        match self {
            Self::Gltf(_) => VAxis::Down,
            Self::Obj(_) | Self::Soup(_) => VAxis::Up,
        }
    }

    /// Returns the UVs of set `set` per face corner in the numbers of the file; `None` if the primitive has no such
    /// set.
    pub fn corner_uvs(
        &self,
        primitive: usize,
        set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        match self {
            Self::Gltf(document) => document.corner_uvs(primitive, set),
            Self::Obj(document) => document.corner_uvs(primitive, set),
            Self::Soup(document) => document.corner_uvs(primitive, set),
        }
    }

    /// Returns the normals of a primitive per face corner; `None` if it has none.
    pub fn corner_normals(
        &self,
        primitive: usize,
    ) -> Result<Option<Vec<[[f64; 3]; 3]>>, DocumentError> {
        match self {
            Self::Gltf(document) => document.corner_normals(primitive),
            Self::Obj(document) => Ok(document.corner_normals()),
            Self::Soup(_) => Ok(None),
        }
    }

    /// Gives every node that shows a mesh a mesh of its own; other files than glTF have no nodes.
    pub fn with_separate_meshes(self) -> Result<Self, DocumentError> {
        match self {
            Self::Gltf(document) => document.with_separate_meshes().map(Self::Gltf),
            other => Ok(other),
        }
    }

    /// Returns the primitives in the placement of the first node that shows them; mirrored ones are mirrored back.
    pub fn primitives_in_scene(&self) -> Result<Vec<Primitive>, DocumentError> {
        match self {
            Self::Gltf(document) => document.primitives_in_scene(),
            other => Ok(other.primitives().to_vec()),
        }
    }

    /// Cuts the triangles of each primitive into pieces; attributes other than positions are interpolated.
    pub fn subdivided(self, cuts: &[Subdivision]) -> Result<Self, DocumentError> {
        Subdivision::check(cuts, self.primitives())?;
        match self {
            Self::Gltf(document) => document.subdivided(cuts).map(Self::Gltf),
            Self::Obj(_) => Err(DocumentError::Indivisible(
                "the text of an OBJ file".to_owned(),
            )),
            Self::Soup(document) => Ok(Self::Soup(document.subdivided(cuts))),
        }
    }

    /// Moves the triangles of the document by a map: positions, normals and tangents. All else is unchanged; positions
    /// are those of the meshes, before any transform of a node, skin or morph target.
    pub fn moved(self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        Ok(match self {
            Self::Gltf(document) => Self::Gltf(document.moved(map)?),
            Self::Obj(document) => Self::Obj(document.moved(map)?),
            Self::Soup(document) => Self::Soup(document.moved(map)?),
        })
    }

    /// Writes the document with `uvs` as a UV set.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        self.write_baked(uvs, options, None)
    }

    /// Writes the document with `uvs` as a UV set and with textures made for it; only those of glTF are known.
    pub fn write_baked(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
        baked: Option<&BakedTextures>,
    ) -> Result<Written, DocumentError> {
        uvs.check(self.primitives())?;
        // Without new UVs, the mark of the present ones stays.
        let is_new = uvs.corners.iter().any(Option::is_some);
        let mut written = match (self, options.format) {
            (Self::Gltf(document), _) => match if is_new { self.marked()? } else { Marked::Not } {
                Marked::Fits(mark) => document.write(uvs, options, baked, Some(&mark))?,
                Marked::Not | Marked::Stale => document.write(uvs, options, baked, None)?,
            },
            (Self::Obj(document), OutputFormat::Obj) => document.write(uvs, options)?,
            (Self::Soup(document), OutputFormat::Obj) => {
                new_obj::write(&document.primitives()[0], document.colors(), uvs, options)?
            }
            (Self::Obj(_) | Self::Soup(_), _) => self.write_converted(uvs, options)?,
        };
        if is_new && options.format == OutputFormat::Obj {
            obj_mark::renew(&mut written, options.terms.as_ref())?;
        }
        Ok(written)
    }

    /// Writes triangles of another format as glTF.
    fn write_converted(
        &self,
        uvs: &NewUvs,
        options: &WriteOptions,
    ) -> Result<Written, DocumentError> {
        let conversion = self.clone().for_output(options.format, OldUvs::Sampled)?;
        let uvs = conversion.uvs(uvs);
        let mut written = conversion.document.write_baked(&uvs, options, None)?;
        let known = self.warnings();
        let noticed = conversion.document.warnings().iter();
        let new = noticed.filter(|warning| !known.contains(warning));
        written.notes.warnings.splice(0..0, new.cloned());
        written.notes.faces = conversion.faces;
        Ok(written)
    }
}
