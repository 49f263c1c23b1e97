//! The triangles of a document.

use super::accessor::{Accessor, Component};
use super::body::GltfBody;
use super::json::{invalid, items, unsigned};
use crate::document::{DocumentError, Primitive};
use serde_json::Value;
use std::collections::HashMap;
use std::rc::Rc;
use unwrapd_maps::mesh::UsedVertices;

/// Most vertices, and most faces, over all primitives. Primitives may share accessors, so the size of a file does not
/// bound their sum.
const MAX_ELEMENTS: usize = 1 << 26;

/// The triangles of a document.
pub(super) struct Collected {
    pub primitives: Vec<Primitive>,
    /// For each primitive the vertices of its accessors that it uses; `None` for all.
    pub used: Vec<Option<Vec<u32>>>,
    /// Number of vertices that no triangle uses and that were not finite.
    pub n_unused_not_finite: usize,
}

/// Collects every primitive that has triangles and positions, in file order, with the part of its accessors that it
/// uses.
///
/// If several primitives share their accessors, each gets only the vertices that it uses: exporters like to put a whole
/// scene into one array.
pub(super) fn collect(body: &GltfBody) -> Result<Collected, DocumentError> {
    let mut primitives = Vec::new();
    let mut used = Vec::new();
    let mut positions = Positions::new(body)?;
    let (mut n_vertices, mut n_faces, mut n_unused_not_finite) = (0, 0, 0);
    for (mesh, object) in items(&body.json, "meshes")?.iter().enumerate() {
        for (index, object) in items(object, "primitives")?.iter().enumerate() {
            let read = read(body, object, &mut positions).map_err(|e| located(e, mesh, index))?;
            let Some(read) = read else {
                continue;
            };
            // Bound the sum over all primitives, which may share accessors.
            n_vertices += read.positions.len();
            n_faces += read.triangles.len();
            if n_vertices.max(n_faces) > MAX_ELEMENTS {
                return Err(DocumentError::LimitExceeded(
                    "the file has too many vertices or faces".to_owned(),
                ));
            }
            let mut primitive = Primitive {
                mesh,
                primitive: index,
                material: unsigned(object, "material")?,
                positions: read.positions,
                triangles: read.triangles,
            };
            n_unused_not_finite += primitive.place_unused();
            primitives.push(primitive);
            used.push(read.used);
        }
    }
    Ok(Collected {
        primitives,
        used,
        n_unused_not_finite,
    })
}

/// Adds the place of the primitive to an error.
pub(super) fn located(error: DocumentError, mesh: usize, primitive: usize) -> DocumentError {
    let at = |message: String| format!("mesh {mesh}, primitive {primitive}: {message}");
    match error {
        DocumentError::InvalidGltf(message) => DocumentError::InvalidGltf(at(message)),
        DocumentError::IndexOutOfRange(message) => DocumentError::IndexOutOfRange(at(message)),
        DocumentError::NonFinitePosition(message) => DocumentError::NonFinitePosition(at(message)),
        error => error,
    }
}

struct Read {
    positions: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
    used: Option<Vec<u32>>,
}

fn read(
    body: &GltfBody,
    primitive: &Value,
    positions: &mut Positions,
) -> Result<Option<Read>, DocumentError> {
    let (Some(mode), Some(accessor)) = (mode(primitive)?, position_accessor(primitive)?) else {
        return Ok(None);
    };
    let is_shared = positions.is_shared(accessor);
    let mut positions = positions.read(body, accessor)?;
    check_attributes(body, primitive, positions.len())?;
    let mut indices = indices(body, primitive, positions.len())?;
    // Keep only the vertices used of an accessor that is shared.
    let used = is_shared
        .then(|| compact(&mut indices, &positions))
        .flatten();
    if let Some(used) = &used {
        positions = Rc::new(
            used.iter()
                .map(|vertex| positions[*vertex as usize])
                .collect(),
        );
    }
    let triangles = faces(&indices, mode);
    // Refuse faces with positions that are not finite; unused vertices may hold anything.
    let is_finite = |v: &u32| positions[*v as usize].iter().all(|x| x.is_finite());
    if let Some(vertex) = triangles.as_flattened().iter().find(|v| !is_finite(v)) {
        return Err(DocumentError::NonFinitePosition(format!("vertex {vertex}")));
    }
    Ok(Some(Read {
        positions: Rc::unwrap_or_clone(positions),
        triangles,
        used,
    }))
}

/// Checks that all attributes and morph targets have an element for each vertex, so that vertices can be split.
fn check_attributes(
    body: &GltfBody,
    primitive: &Value,
    n_vertices: usize,
) -> Result<(), DocumentError> {
    let attributes = &primitive["attributes"];
    for set in std::iter::once(attributes).chain(items(primitive, "targets")?) {
        let Some(set) = set.as_object() else {
            return Err(invalid("a morph target is not an object"));
        };
        for (name, index) in set {
            let index = super::json::as_unsigned(index)
                .ok_or_else(|| invalid(format!("attribute {name} is not an accessor index")))?;
            if Accessor::open(body, index)?.count != n_vertices {
                return Err(invalid(format!(
                    "attribute {name} and POSITION differ in length"
                )));
            }
        }
    }
    Ok(())
}

/// Returns the vertex indices of a primitive, all in range; without indices the vertices follow one another.
pub(super) fn indices(
    body: &GltfBody,
    primitive: &Value,
    n_vertices: usize,
) -> Result<Vec<u32>, DocumentError> {
    let Some(index) = unsigned(primitive, "indices")? else {
        return Ok((0..n_vertices as u32).collect());
    };
    let accessor = Accessor::open(body, index)?;
    let is_unsigned = matches!(
        accessor.component,
        Component::U8 | Component::U16 | Component::U32
    );
    if !accessor.is("SCALAR") || !is_unsigned {
        return Err(invalid("the indices are not unsigned integers"));
    }
    check_backed(&accessor)?;
    let packed = accessor.packed()?;
    let indices: Vec<u32> = packed
        .chunks_exact(accessor.component.size())
        .map(|bytes| accessor.component.read(bytes) as u32)
        .collect();
    match indices.iter().find(|index| **index as usize >= n_vertices) {
        Some(index) => Err(DocumentError::IndexOutOfRange(format!(
            "vertex {index} of {n_vertices}"
        ))),
        None => Ok(indices),
    }
}

/// Returns the faces with their corners in the order of the specification; incomplete ones are left out.
fn faces(indices: &[u32], mode: PrimitiveMode) -> Vec<[u32; 3]> {
    let windows = indices.windows(3).enumerate();
    match mode {
        PrimitiveMode::Triangles => indices
            .chunks_exact(3)
            .map(|face| [face[0], face[1], face[2]])
            .collect(),
        PrimitiveMode::Strip => windows
            .map(|(i, w)| {
                if i % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[0], w[2], w[1]]
                }
            })
            .collect(),
        PrimitiveMode::Fan => windows
            .map(|(i, _)| [indices[i + 1], indices[i + 2], indices[0]])
            .collect(),
    }
}

// Positions that several primitives may share.

/// Largest count of positions or indices without bytes behind them.
const MAX_UNBACKED: usize = 1 << 20;

/// Positions by accessor; those that several primitives share are read once.
pub(super) struct Positions {
    n_users: HashMap<usize, usize>,
    shared: HashMap<usize, Rc<Vec<[f32; 3]>>>,
}

impl Positions {
    pub fn new(body: &GltfBody) -> Result<Self, DocumentError> {
        let mut n_users = HashMap::new();
        for mesh in items(&body.json, "meshes")? {
            for primitive in items(mesh, "primitives")? {
                if let Some(accessor) = position_accessor(primitive)? {
                    *n_users.entry(accessor).or_insert(0) += 1;
                }
            }
        }
        let shared = HashMap::new();
        Ok(Self { n_users, shared })
    }

    pub fn is_shared(&self, accessor: usize) -> bool {
        self.n_users.get(&accessor).is_some_and(|n| *n > 1)
    }

    pub fn read(
        &mut self,
        body: &GltfBody,
        index: usize,
    ) -> Result<Rc<Vec<[f32; 3]>>, DocumentError> {
        if let Some(positions) = self.shared.get(&index) {
            return Ok(Rc::clone(positions));
        }
        let accessor = Accessor::open(body, index)?;
        if !accessor.is("VEC3") {
            return Err(invalid("POSITION is not of type VEC3"));
        }
        check_backed(&accessor)?;
        let positions = Rc::new(accessor.vectors()?);
        if self.is_shared(index) {
            self.shared.insert(index, Rc::clone(&positions));
        }
        Ok(positions)
    }
}

/// Renumbers indices by the vertices that they use; returns these, or `None` if all are used.
fn compact(indices: &mut [u32], positions: &[[f32; 3]]) -> Option<Vec<u32>> {
    let used = UsedVertices::new(indices.iter().copied());
    if used.count() == positions.len() {
        return None;
    }
    used.renumber(indices);
    Some(used.into_vec())
}

/// Refuses long accessors without data.
fn check_backed(accessor: &Accessor) -> Result<(), DocumentError> {
    if accessor.is_backed() || accessor.count <= MAX_UNBACKED {
        return Ok(());
    }
    Err(DocumentError::LimitExceeded(format!(
        "an accessor without data has {} elements",
        accessor.count
    )))
}

// Modes of primitives.

/// Arrangement of vertices into faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PrimitiveMode {
    Triangles,
    Strip,
    Fan,
}

/// Returns the mode of a primitive; `None` for points and lines.
pub(super) fn mode(primitive: &Value) -> Result<Option<PrimitiveMode>, DocumentError> {
    Ok(match unsigned(primitive, "mode")?.unwrap_or(4) {
        4 => Some(PrimitiveMode::Triangles),
        5 => Some(PrimitiveMode::Strip),
        6 => Some(PrimitiveMode::Fan),
        0..=3 => None,
        _ => return Err(invalid("unknown primitive `mode`")),
    })
}

/// Returns the POSITION accessor of a primitive with faces.
fn position_accessor(primitive: &Value) -> Result<Option<usize>, DocumentError> {
    if mode(primitive)?.is_none() {
        return Ok(None);
    }
    match primitive.get("attributes") {
        None => Ok(None),
        Some(attributes) if attributes.is_object() => unsigned(attributes, "POSITION"),
        Some(_) => Err(invalid("`attributes` is not an object")),
    }
}
