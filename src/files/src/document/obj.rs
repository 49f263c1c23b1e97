//! Wavefront OBJ: polygons, vertex order, groups, materials and comments are kept.
//!
//! The text is the document. It is read once into triangles, and written by traversing its statements again: texture
//! coordinates are replaced, corners of polygons get the new ones, everything else is unchanged. OBJ has one UV set, so
//! an old one is always replaced. A polygon whose triangles lie apart in UV space is split along diagonals between
//! them, as a corner of a polygon has one UV.

use super::error::unused_not_finite;
use super::mark::Mark;
use super::material::{MaterialFiles, UploadedPictures};
use super::obj_text::{decimal, line_end, push_comment, push_face, push_statement, rewrite};
use super::{
    DocumentError, Layout, NewUvs, Primitive, SpaceMap, Terms, Upload, Warning, WriteNotes,
    WriteOptions, Written, error, new_obj, soup,
};
use crate::io;
use crate::io::obj::{Corner, Obj, Statement, statements};
use serde_json::Value;
use std::collections::HashMap;
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use unwrapd_maps::mesh::{CornerUvs, VAxis};

/// Content of a file.
#[derive(Clone)]
pub struct ObjDocument {
    bytes: Vec<u8>,
    obj: Obj,
    primitives: Vec<Primitive>,
    /// Numbers of the triangles that are not left out; `None` if none is.
    kept: Option<Vec<u32>>,
    resources: BTreeMap<String, Vec<u8>>,
    warnings: Vec<Warning>,
}

impl ObjDocument {
    /// Reads the main file.
    pub fn read(upload: &Upload) -> Result<Self, DocumentError> {
        Self::parse(upload.bytes.clone(), upload.resources.clone())
    }

    fn parse(bytes: Vec<u8>, resources: BTreeMap<String, Vec<u8>>) -> Result<Self, DocumentError> {
        let mut obj = io::obj::read(&bytes)?;
        let fanned = soup::warning(&obj.mesh.fanned, "line");
        let mut primitive = Primitive::of_file(std::mem::take(&mut obj.mesh))?;
        let unused = unused_not_finite(primitive.place_unused());
        let warnings = fanned.into_iter().chain(unused).collect();
        Ok(Self {
            bytes,
            obj,
            primitives: vec![primitive],
            kept: None,
            resources,
            warnings,
        })
    }

    /// Leaves out the polygons without texture coordinates, which are written as they are, unless that is all.
    #[must_use]
    pub fn with_mapped_faces(mut self) -> Self {
        let (mut kept, mut first) = (Vec::new(), 0);
        for polygon in self.obj.polygons() {
            let end = first + polygon.len().saturating_sub(2) as u32;
            if polygon.iter().all(|corner| corner.texcoord.is_some()) {
                kept.extend(first..end);
            }
            first = end;
        }
        if kept.is_empty() || kept.len() == self.obj.corner_triangles.len() {
            return self;
        }
        for triangles in [
            &mut self.obj.corner_triangles,
            &mut self.primitives[0].triangles,
        ] {
            *triangles = kept.iter().map(|&face| triangles[face as usize]).collect();
        }
        self.kept = Some(kept);
        self
    }

    /// Returns the numbers of the triangles that are not left out; `None` if none is.
    pub fn kept_faces(&self) -> Option<&[u32]> {
        self.kept.as_deref()
    }

    /// Returns the number of triangles that are left out.
    pub fn n_left_out(&self) -> usize {
        let all: usize = self.polygon_sizes().map(|n| n.saturating_sub(2)).sum();
        all - self.obj.corner_triangles.len()
    }

    /// Moves the triangles of the document by a map.
    pub fn moved(self, map: &dyn SpaceMap) -> Result<Self, DocumentError> {
        let positions = &self.primitives[0].positions;
        let bytes = moved(&self.bytes, &self.obj, positions, map);
        Self::parse(bytes, self.resources)
    }

    /// Returns the value in the place of a mark.
    pub(super) fn mark(&self) -> Option<Value> {
        find(&self.bytes)
    }

    /// Returns the warnings of reading.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }

    /// Returns the triangles: all polygons of the file as one primitive.
    pub fn primitives(&self) -> &[Primitive] {
        &self.primitives
    }

    /// Returns the texture coordinates, which are set 0; `None` if a corner has none.
    pub fn corner_uvs(
        &self,
        primitive: usize,
        set: u32,
    ) -> Result<Option<Vec<CornerUvs>>, DocumentError> {
        if primitive > 0 || set > 0 {
            return Ok(None);
        }
        Ok(self.face_uvs().collect())
    }

    /// Returns the normals per face corner; `None` if a corner has none.
    pub fn corner_normals(&self) -> Option<Vec<[[f64; 3]; 3]>> {
        self.face_normals().collect()
    }

    /// Writes the document with `uvs`.
    pub fn write(&self, uvs: &NewUvs, options: &WriteOptions) -> Result<Written, DocumentError> {
        new_obj::only_set(options)?;
        let materials = self.materials();
        let mut notes = WriteNotes {
            warnings: materials.warnings(),
            ..WriteNotes::default()
        };
        // Rewrite the text with the new texture coordinates; without any it stays byte for byte.
        let text = match uvs.toward(0, VAxis::Up) {
            Some(corners) => {
                let had_uvs = !self.obj.texcoords.is_empty();
                notes
                    .primitives
                    .push(new_obj::note(&self.primitives[0], had_uvs));
                let rewritten = rewrite(
                    &self.bytes,
                    &self.obj,
                    &self.primitives[0].positions,
                    &corners,
                );
                if had_uvs && uvs.layout == Layout::New {
                    notes.warnings.extend(materials.warnings_of_new_uvs());
                }
                if rewritten.split_polygons > 0 {
                    let n = rewritten.split_polygons;
                    notes.warnings.push(Warning::new(
                        "polygons_split",
                        format!("{n} polygons are split along a seam"),
                    ));
                }
                rewritten.text
            }
            None => self.bytes.clone(),
        };
        // Put the material files and their pictures beside it.
        let mut files = vec![(format!("{}.obj", options.stem), text)];
        files.extend(materials.beside(&self.resources));
        Ok(Written { files, notes })
    }

    /// Iterates over the values at the corners of each triangle, in order; `None` for a triangle with a corner without
    /// a value.
    fn per_face<T>(
        &self,
        value: impl Fn(&Corner) -> Option<T>,
    ) -> impl Iterator<Item = Option<[T; 3]>> {
        let of = move |corner: u32| value(&self.obj.corners[corner as usize]);
        let triangles = self.obj.corner_triangles.iter();
        triangles.map(move |&[a, b, c]| Some([of(a)?, of(b)?, of(c)?]))
    }

    /// Iterates over the texture coordinates of each triangle, if it has them.
    pub(super) fn face_uvs(&self) -> impl Iterator<Item = Option<CornerUvs>> {
        self.per_face(|corner| Some(self.obj.texcoords[corner.texcoord? as usize]))
    }

    /// Iterates over the normals of each triangle, if it has them.
    pub(super) fn face_normals(&self) -> impl Iterator<Item = Option<[[f64; 3]; 3]>> {
        self.per_face(|corner| Some(self.obj.normals[corner.normal? as usize].map(f64::from)))
    }

    /// Returns the corners of each triangle as indices of the polygons' corners, and the number of those.
    pub(super) fn polygon_corners(&self) -> (&[[u32; 3]], u32) {
        (&self.obj.corner_triangles, self.obj.corners.len() as u32)
    }

    /// Iterates over the number of corners of each polygon; one of n corners has n − 2 triangles.
    pub(super) fn polygon_sizes(&self) -> impl Iterator<Item = usize> {
        self.obj.polygons().map(<[_]>::len)
    }

    /// Returns the text.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Returns the files to which it may refer.
    pub(super) fn resources(&self) -> &BTreeMap<String, Vec<u8>> {
        &self.resources
    }

    /// Returns the materials of the text.
    pub(super) fn materials(&self) -> ObjMaterials {
        ObjMaterials::of(&self.bytes, &self.resources)
    }
}

// An OBJ text with moved positions and normals.

/// Rewrites the statements of `bytes`, from which `obj` and `positions` were read.
///
/// The rest of a vertex line after the position is kept. Vertices may share a normal that the map moves apart: every
/// pair of vertex and normal gets one of its own. These lines come before the first face.
fn moved(bytes: &[u8], obj: &Obj, positions: &[[f32; 3]], map: &dyn SpaceMap) -> Vec<u8> {
    let line_end = line_end(bytes);
    let normals = MovedNormals::new(obj);
    let mut normal_lines = normals.lines(obj, positions, map, line_end);
    let mut places = map.positions(positions).into_iter();
    let mut polygons = obj.polygons();
    let mut text = Vec::with_capacity(bytes.len());
    for statement in statements(bytes) {
        match statement.keyword {
            b"v" => {
                let place = places.next().unwrap_or_default();
                let place = place.map(|x| decimal(x).into_bytes());
                let rest = statement.words.iter().skip(3).map(|word| word.to_vec());
                let words: Vec<Vec<u8>> = place.into_iter().chain(rest).collect();
                push_statement(&mut text, &statement, &words, line_end);
            }
            b"vn" => push_comment(&mut text, &statement, line_end),
            b"f" | b"fo" if !obj.normals.is_empty() => {
                text.append(&mut normal_lines);
                push_comment(&mut text, &statement, line_end);
                let corners = normals.renumbered(polygons.next().unwrap_or_default());
                let with_texcoords = corners.iter().map(|c| (c, c.texcoord.map(|t| t + 1)));
                push_face(&mut text, with_texcoords, line_end);
            }
            _ => text.extend_from_slice(statement.raw),
        }
    }
    text
}

/// Pairs of vertex and normal, numbered from 0 in the order of their first use.
#[derive(Default)]
struct MovedNormals {
    pairs: Vec<(u32, u32)>,
    numbers: HashMap<(u32, u32), u32>,
}

impl MovedNormals {
    fn new(obj: &Obj) -> Self {
        let mut normals = Self::default();
        for corner in &obj.corners {
            let Some(normal) = corner.normal else {
                continue;
            };
            let pair = (corner.vertex, normal);
            let next = normals.pairs.len() as u32;
            if *normals.numbers.entry(pair).or_insert(next) == next {
                normals.pairs.push(pair);
            }
        }
        normals
    }

    /// Returns the `vn` lines.
    fn lines(
        &self,
        obj: &Obj,
        positions: &[[f32; 3]],
        map: &dyn SpaceMap,
        line_end: &str,
    ) -> Vec<u8> {
        let (places, normals): (Vec<_>, Vec<_>) = self
            .pairs
            .iter()
            .map(|&(vertex, normal): &(u32, u32)| {
                (positions[vertex as usize], obj.normals[normal as usize])
            })
            .unzip();
        let mut text = Vec::new();
        for normal in map.normals(&places, &normals) {
            let [x, y, z] = normal.map(decimal);
            // Writing to memory does not fail.
            let _ = write!(text, "vn {x} {y} {z}{line_end}");
        }
        text
    }

    fn renumbered(&self, polygon: &[Corner]) -> Vec<Corner> {
        polygon
            .iter()
            .map(|corner: &Corner| Corner {
                normal: corner.normal.map(|n| self.numbers[&(corner.vertex, n)]),
                ..*corner
            })
            .collect()
    }
}

// The mark of an OBJ file: a comment in its first line.

/// Beginning of the line.
const BEGIN: &[u8] = b"# unwrapd {";

/// Returns the value in the place of a mark.
pub(super) fn find(text: &[u8]) -> Option<Value> {
    let line = &text[..length(text)];
    serde_json::from_slice(line.get(BEGIN.len() - 1..)?).ok()
}

/// Replaces the mark of the main file by one with the purpose of its UVs, if that is known. The marked UVs are those
/// that are read from the file, because its polygons determine the triangles.
pub(super) fn renew(written: &mut Written, terms: Option<&Terms>) -> Result<(), DocumentError> {
    let again = written.read_again()?;
    let Some((_, text)) = written.files.first_mut() else {
        return Ok(());
    };
    text.drain(..length(text));
    if let (Some(terms), Some(uvs)) = (terms, again.corner_uvs(0, 0)?) {
        let mark = Mark::new(terms, std::iter::once(Some((0, uvs))));
        let line = format!("# unwrapd {}\n", mark.value());
        text.splice(..0, line.into_bytes());
    }
    Ok(())
}

/// Returns the length in bytes of the line with the mark; 0 if there is none.
fn length(text: &[u8]) -> usize {
    if !text.starts_with(BEGIN) {
        return 0;
    }
    let end = text.iter().position(|&byte| byte == b'\n');
    end.map_or(text.len(), |end| end + 1)
}

// Material files of an OBJ text, and their pictures.

/// References of an OBJ text.
#[derive(Default)]
pub(super) struct ObjMaterials {
    /// Materials that are described.
    pub files: MaterialFiles,
    /// Names of the material files that were supplied.
    supplied: BTreeSet<String>,
    /// Names of the material files that were not supplied.
    missing: BTreeSet<String>,
    /// Names of the materials in use.
    used: BTreeSet<String>,
}

impl ObjMaterials {
    /// Collects the materials of a text, with the supplied files.
    pub fn of(text: &[u8], resources: &BTreeMap<String, Vec<u8>>) -> Self {
        let mut materials = Self::default();
        for statement in named(text) {
            match statement.keyword {
                b"usemtl" => drop(materials.used.insert(name_of(&statement))),
                b"mtllib" => {
                    let words = statement.words.iter();
                    let words = words.map(|word| String::from_utf8_lossy(word).into_owned());
                    materials.add(&name_of(&statement), words.collect(), resources);
                }
                _ => {}
            }
        }
        materials
    }

    /// Adds one file whose name has blanks, or several files.
    fn add(&mut self, line: &str, words: Vec<String>, resources: &BTreeMap<String, Vec<u8>>) {
        let find = |path: &str| {
            let found =
                UploadedPictures::candidates("", path).find(|name| resources.contains_key(name));
            found.map(|name| (resources[&name].as_slice(), name))
        };
        let paths = match find(line) {
            Some(_) => vec![line.to_owned()],
            None => words,
        };
        for path in paths {
            match find(&path) {
                Some((bytes, name)) => {
                    if self.supplied.insert(name.clone()) {
                        self.files.add(&name, bytes);
                    }
                }
                None => drop(self.missing.insert(path)),
            }
        }
    }

    /// Returns the supplied files with their pictures.
    pub fn beside(&self, resources: &BTreeMap<String, Vec<u8>>) -> Vec<(String, Vec<u8>)> {
        let mut names: Vec<&str> = self.supplied.iter().map(String::as_str).collect();
        let mut pictures = UploadedPictures::among(resources);
        for (folder, path) in self.files.pictures() {
            names.extend(pictures.find(folder, &path).map(|(name, _)| name));
        }
        let mut known = BTreeSet::new();
        names.retain(|name| known.insert(*name));
        names
            .into_iter()
            .map(|name: &str| (name.to_owned(), resources[name].clone()))
            .collect()
    }

    /// Returns a warning if a material file is missing.
    pub fn warnings(&self) -> Vec<Warning> {
        if self.missing.is_empty() {
            return Vec::new();
        }
        let names = error::listed(self.missing.iter().map(String::as_str));
        let message =
            format!("material files were not supplied, so only material names are known: {names}");
        vec![Warning::new("material_files_missing", message)]
    }

    /// Returns a warning that textures no longer fit because their UVs are replaced.
    pub fn warnings_of_new_uvs(&self) -> Option<Warning> {
        let textured: Vec<&str> = (self.used.iter().map(String::as_str))
            .filter(|name: &&str| self.files.maps_of(name).next().is_some())
            .collect();
        if !textured.is_empty() {
            let names = error::listed(textured.into_iter());
            let message = format!(
                "textures no longer fit because the UVs were replaced: materials {names}; to resample them, write \
                 glTF with --rebake"
            );
            return Some(Warning::new("textures_misplaced", message));
        }
        let is_unknown = self.supplied.is_empty() && !self.missing.is_empty();
        let message = "the UVs of the file were replaced, so textures made for them no longer fit";
        is_unknown.then(|| Warning::new("uvs_replaced", message))
    }
}

/// Iterates over the statements about materials and their files; others are not parsed.
fn named(text: &[u8]) -> impl Iterator<Item = Statement<'_>> {
    let lines = text.split(|byte| matches!(byte, b'\n' | b'\r'));
    lines
        .filter(|line: &&[u8]| {
            let line = line.trim_ascii_start();
            line.starts_with(b"usemtl") || line.starts_with(b"mtllib")
        })
        .flat_map(statements)
}

/// Returns the possible paths of the material files of a text, relative to it.
pub(super) fn material_paths(text: &[u8]) -> BTreeSet<String> {
    let libraries = named(text).filter(|statement| statement.keyword == b"mtllib");
    let names = libraries.flat_map(|statement| {
        let words = statement.words.iter();
        let words = words.map(|word| String::from_utf8_lossy(word).into_owned());
        words.chain([name_of(&statement)]).collect::<Vec<_>>()
    });
    names
        .flat_map(|name| UploadedPictures::candidates("", &name).collect::<Vec<_>>())
        .collect()
}

/// Returns the possible paths of the pictures of the material file at `path`, relative to the main file.
pub(super) fn picture_paths(path: &str, bytes: &[u8]) -> BTreeSet<String> {
    let mut files = MaterialFiles::default();
    files.add(path, bytes);
    let pictures = files.pictures();
    pictures
        .flat_map(|(folder, path)| UploadedPictures::candidates(folder, &path).collect::<Vec<_>>())
        .collect()
}

/// Returns the names after a statement, joined by single blanks.
pub(super) fn name_of(statement: &Statement) -> String {
    let words: Vec<_> = statement
        .words
        .iter()
        .map(|word| String::from_utf8_lossy(word))
        .collect();
    words.join(" ")
}
