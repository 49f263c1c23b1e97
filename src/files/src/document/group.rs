//! Primitives that share a UV space, and their grouping by mesh, material or scene.

use super::DocumentError;
use crate::io::IndexedTriangles;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The triangles of one primitive, as in the file.
///
/// Strips and fans are expanded; faces that name a vertex twice are kept.
#[derive(Debug, Clone, PartialEq)]
pub struct Primitive {
    /// Index of the mesh in the file.
    pub mesh: usize,
    /// Index of the primitive in its mesh; points and lines count too.
    pub primitive: usize,
    /// Index of the material.
    pub material: Option<usize>,
    /// Positions of all vertices, used or not, in the units of the mesh (no node transform).
    pub positions: Vec<[f32; 3]>,
    /// Vertex indices of the faces.
    pub triangles: Vec<[u32; 3]>,
}

impl Primitive {
    /// Moves vertices that no triangle uses, and whose coordinates are not finite, to the origin; returns their number.
    pub(super) fn place_unused(&mut self) -> usize {
        let mut n_placed = 0;
        for position in &mut self.positions {
            if !position.iter().all(|x| x.is_finite()) {
                *position = [0.0; 3];
                n_placed += 1;
            }
        }
        n_placed
    }

    /// Creates a primitive from all triangles of a file whose format has no meshes.
    pub(super) fn of_file(mesh: IndexedTriangles) -> Result<Self, DocumentError> {
        if mesh.triangles.is_empty() {
            return Err(DocumentError::NoTriangles);
        }
        Ok(Self {
            mesh: 0,
            primitive: 0,
            material: None,
            positions: mesh.positions,
            triangles: mesh.triangles,
        })
    }
}

/// Primitives that share an atlas.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(utoipa::ToSchema, clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum GroupBy {
    /// One atlas per mesh.
    #[default]
    Mesh,
    /// One atlas for the whole file.
    Scene,
    /// One atlas per material; a mesh without a material has its own.
    Material,
    /// One atlas per primitive.
    Primitive,
}

/// Writes the name used on the command line.
impl fmt::Display for GroupBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Mesh => "mesh",
            Self::Scene => "scene",
            Self::Material => "material",
            Self::Primitive => "primitive",
        })
    }
}

/// Label of an atlas for all, here and in the web page.
const WHOLE_SCENE: &str = "Whole scene";

/// Primitives that share one UV space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// `scene`, `mesh0`, `mesh0/prim0` or `material0`.
    pub name: String,
    /// Label for people: the name of the mesh or the material, else `mesh 0`, `material 0` or `Whole scene`.
    pub label: String,
    /// Indices into the document's primitives, in increasing order.
    pub primitives: Vec<usize>,
}

/// Names of meshes and materials in a file.
pub(super) trait Names {
    /// Returns the name of a mesh, if it has one.
    fn mesh(&self, index: usize) -> Option<String>;
    /// Returns the name of a material, if it has one.
    fn material(&self, index: usize) -> Option<String>;
}

/// A file without names.
pub(super) struct Nameless;

impl Names for Nameless {
    fn mesh(&self, _: usize) -> Option<String> {
        None
    }
    fn material(&self, _: usize) -> Option<String> {
        None
    }
}

/// Returns groups in the order of their first primitives.
pub(super) fn groups(primitives: &[Primitive], by: GroupBy, names: &impl Names) -> Vec<Group> {
    let mut places = std::collections::HashMap::new();
    let mut groups: Vec<Group> = Vec::new();
    for (index, primitive) in primitives.iter().enumerate() {
        let name = group_name(primitive, by);
        let place = *places.entry(name.clone()).or_insert(groups.len());
        if place == groups.len() {
            groups.push(Group {
                name,
                label: group_label(primitive, by, names),
                primitives: Vec::new(),
            });
        }
        groups[place].primitives.push(index);
    }
    groups
}

impl GroupBy {
    /// Returns the grouping of a primitive: one without a material shares nothing with other meshes.
    fn of(self, primitive: &Primitive) -> Self {
        match self {
            Self::Material if primitive.material.is_none() => Self::Mesh,
            by => by,
        }
    }
}

fn group_name(primitive: &Primitive, by: GroupBy) -> String {
    match (by.of(primitive), primitive.material) {
        (GroupBy::Scene, _) => "scene".to_owned(),
        (GroupBy::Material, Some(material)) => format!("material{material}"),
        (GroupBy::Primitive, _) => format!("mesh{}/prim{}", primitive.mesh, primitive.primitive),
        (GroupBy::Mesh | GroupBy::Material, _) => format!("mesh{}", primitive.mesh),
    }
}

fn group_label(primitive: &Primitive, by: GroupBy, names: &impl Names) -> String {
    let mesh = || {
        let name = names.mesh(primitive.mesh);
        name.unwrap_or_else(|| format!("mesh {}", primitive.mesh))
    };
    match (by.of(primitive), primitive.material) {
        (GroupBy::Scene, _) => WHOLE_SCENE.to_owned(),
        (GroupBy::Material, Some(material)) => {
            (names.material(material)).unwrap_or_else(|| format!("material {material}"))
        }
        (GroupBy::Primitive, _) => format!("{}, primitive {}", mesh(), primitive.primitive),
        (GroupBy::Mesh | GroupBy::Material, _) => mesh(),
    }
}

/// Triangles of a primitive cut into pieces.
#[derive(Debug, Clone, Default)]
pub struct Subdivision {
    /// Vertices added after the primitive's own.
    pub added: Vec<AddedVertex>,
    /// All resulting triangles, over own and added vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// A vertex inside a triangle or on an edge of it.
#[derive(Debug, Clone, Copy)]
pub struct AddedVertex {
    /// Its position.
    pub position: [f32; 3],
    /// Vertices of the triangle.
    pub corners: [u32; 3],
    /// Barycentric weights in the triangle, by which everything except the position is interpolated.
    pub weights: [f64; 3],
}

impl Subdivision {
    /// Cuts a primitive that has only positions and triangles.
    pub(super) fn apply(&self, primitive: &mut Primitive) {
        let added = self.added.iter().map(|vertex| vertex.position);
        primitive.positions.extend(added);
        primitive.triangles.clone_from(&self.triangles);
    }

    /// Appends the values of the added vertices to those of a primitive's own.
    pub(super) fn interpolate<const N: usize>(&self, values: &mut Vec<[f32; N]>) {
        for AddedVertex {
            corners, weights, ..
        } in &self.added
        {
            let corners = corners.map(|vertex| values[vertex as usize]);
            values.push(std::array::from_fn(|k| {
                let terms = corners.iter().zip(weights);
                terms.map(|(value, w)| f64::from(value[k]) * w).sum::<f64>() as f32
            }));
        }
    }

    /// Refuses subdivisions that do not fit the primitives.
    pub(super) fn check(all: &[Self], primitives: &[Primitive]) -> Result<(), DocumentError> {
        if all.len() == primitives.len()
            && (all.iter().zip(primitives)).all(|(cut, primitive)| cut.fits(primitive))
        {
            Ok(())
        } else {
            let text = "pieces that are not those of the primitives".to_owned();
            Err(DocumentError::IndexOutOfRange(text))
        }
    }

    /// Returns whether all corners are vertices of the subdivided primitive, those of added vertices its own.
    fn fits(&self, primitive: &Primitive) -> bool {
        let own = primitive.positions.len();
        let n_vertices = own + self.added.len();
        let mut corners = self.added.iter().flat_map(|vertex| &vertex.corners);
        corners.all(|v| (*v as usize) < own)
            && (self.triangles.iter().flatten()).all(|v| (*v as usize) < n_vertices)
    }
}

/// A map of space that carries the surfaces of a document along.
///
/// Places are vertex positions as in the file. Each method returns an answer for every place, independent of the other
/// places, as surfaces may be passed in several portions.
pub trait SpaceMap {
    /// Returns the images of the places.
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Returns the unit normals after the map of surfaces with `normals` at the places.
    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Returns the unit tangents after the map of curves with `tangents` at the places.
    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]>;
}
