//! New glTF files for triangles from another format: a node and a mesh for each object, a primitive for each material.
//!
//! Only the document without new UVs is created here; they are then written as into any other glTF document, so
//! vertices are split and the set is chosen in one place.

use super::gltf::GltfDocument;
use super::material::GltfMaterials;
use super::new_obj::{Color, WHITE};
use super::{DocumentError, Upload};
use serde_json::{Value, json};
use std::collections::HashMap;
use unwrapd_maps::mesh::UsedVertices;

/// Name of the only buffer while the document is created.
const BUFFER: &str = "data.bin";

/// Triangles and their attributes.
pub(super) struct NewShape<'a> {
    pub positions: &'a [[f32; 3]],
    pub triangles: &'a [[u32; 3]],
    /// UVs per face, v down.
    pub uvs: Vec<Option<[[f32; 2]; 3]>>,
    /// Unit normals per face.
    pub normals: Vec<Option<[[f32; 3]; 3]>>,
    /// Colors per vertex.
    pub colors: Option<&'a [Color]>,
}

/// Some triangles of a shape that form a mesh.
pub(super) struct NewMesh {
    pub name: Option<String>,
    pub primitives: Vec<NewPrimitive>,
}

/// Triangles with one material.
pub(super) struct NewPrimitive {
    pub material: Option<usize>,
    /// Indices of the triangles, in increasing order.
    pub faces: Vec<u32>,
    /// `true` if existing UVs are kept.
    pub with_uvs: bool,
}

/// A new document.
pub(super) struct New {
    pub document: GltfDocument,
    /// For each vertex over all primitives the vertex of the shape.
    pub vertices: Vec<u32>,
    /// For each triangle over all primitives the triangle of the shape.
    pub faces: Vec<u32>,
}

/// Creates the document of these meshes.
pub(super) fn document(
    shape: &NewShape,
    meshes: &[NewMesh],
    materials: &GltfMaterials,
) -> Result<New, DocumentError> {
    let is_one = meshes.len() == 1 && meshes[0].primitives.len() == 1;
    let mut parts = GltfParts::default();
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    let mut objects = Vec::with_capacity(meshes.len());
    for mesh in meshes {
        let mut primitives = Vec::with_capacity(mesh.primitives.len());
        for primitive in &mesh.primitives {
            let of_file = if is_one {
                // All vertices keep their numbers.
                (0..shape.positions.len() as u32).collect::<Vec<_>>()
            } else {
                used(shape, &primitive.faces)
            };
            let own = vertices_of(shape, primitive, &of_file);
            primitives.push(parts.primitive(shape, &own, primitive.material));
            vertices.extend(&own.origins);
            faces.extend(&primitive.faces);
        }
        let mut object = json!({"primitives": primitives});
        if let Some(name) = &mesh.name {
            object["name"] = json!(name);
        }
        objects.push(object);
    }
    // Read the result like any file, so that it passes the same checks.
    let upload = upload(parts, &objects, materials);
    Ok(New {
        document: GltfDocument::read(&upload)?,
        vertices,
        faces,
    })
}

/// Returns the vertices of some faces, in increasing order.
fn used(shape: &NewShape, faces: &[u32]) -> Vec<u32> {
    let corners = faces.iter().flat_map(|&f| shape.triangles[f as usize]);
    UsedVertices::new(corners).into_vec()
}

/// Returns the vertices of a primitive, with the attributes that all its corners have.
fn vertices_of(shape: &NewShape, primitive: &NewPrimitive, of_file: &[u32]) -> Vertices {
    let faces = || primitive.faces.iter().map(|&face| face as usize);
    let has_normals = faces().all(|face| shape.normals[face].is_some());
    let has_uvs = primitive.with_uvs && faces().all(|face| shape.uvs[face].is_some());
    let normals = |face: usize| shape.normals[face].filter(|_| has_normals);
    let uvs = |face: usize| shape.uvs[face].filter(|_| has_uvs);
    let corners = faces().map(|face| {
        let (normals, uvs) = (normals(face), uvs(face));
        [0, 1, 2].map(|k| GltfCorner {
            vertex: shape.triangles[face][k],
            normal: normals.map(|n| n[k]),
            uv: uvs.map(|uv| uv[k]),
        })
    });
    Vertices::new(of_file, corners, has_normals, has_uvs)
}

fn upload(parts: GltfParts, meshes: &[Value], materials: &GltfMaterials) -> Upload {
    let nodes: Vec<Value> = meshes
        .iter()
        .enumerate()
        .map(|(index, mesh): (usize, &Value)| {
            let mut node = json!({"mesh": index});
            if let Some(name) = mesh.get("name") {
                node["name"] = name.clone();
            }
            node
        })
        .collect();
    let mut json = json!({
        "asset": {"generator": "unwrapd", "version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": (0..nodes.len()).collect::<Vec<_>>()}],
        "nodes": nodes,
        "meshes": meshes,
        "accessors": parts.accessors,
        "bufferViews": parts.views,
        "buffers": [{"uri": BUFFER, "byteLength": parts.bin.len()}],
    });
    materials.insert_into(&mut json);
    let mut resources = materials.resources.clone();
    resources.insert(BUFFER.to_owned(), parts.bin);
    Upload {
        name: "new.gltf".to_owned(),
        bytes: json.to_string().into_bytes(),
        resources,
    }
}

/// Accessors, buffer views and the buffer, which grow together.
#[derive(Default)]
struct GltfParts {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl GltfParts {
    /// Appends the data of a primitive and returns its JSON.
    fn primitive(&mut self, shape: &NewShape, own: &Vertices, material: Option<usize>) -> Value {
        let n = own.origins.len();
        let positions = || own.origins.iter().map(|&v| shape.positions[v as usize]);
        let bound = |bound: fn(f32, f32) -> f32| {
            let bounds = positions().reduce(|a, b| [0, 1, 2].map(|k| bound(a[k], b[k])));
            bounds.unwrap_or_default()
        };
        // Positions have bounds, which glTF requires.
        let mut position = floats(n, "VEC3");
        position["min"] = json!(bound(f32::min));
        position["max"] = json!(bound(f32::max));
        let mut attributes = json!({});
        attributes["POSITION"] = self.push(little(positions().flatten()), 34962, position);
        if let Some(normals) = &own.normals {
            let bytes = little(normals.iter().flatten().copied());
            attributes["NORMAL"] = self.push(bytes, 34962, floats(n, "VEC3"));
        }
        if let Some(uvs) = &own.uvs {
            let bytes = little(uvs.iter().flatten().copied());
            attributes["TEXCOORD_0"] = self.push(bytes, 34962, floats(n, "VEC2"));
        }
        // White everywhere is the default and needs no attribute.
        let colors = shape
            .colors
            .map(|colors| own.origins.iter().map(|&v| colors[v as usize]));
        if let Some(colors) = colors.filter(|colors| colors.clone().any(|c| c != WHITE)) {
            let short = |x: f32| (x * 65535.0 + 0.5) as u16;
            let bytes = colors.flatten().flat_map(|x| short(x).to_le_bytes());
            let accessor =
                json!({"componentType": 5123, "normalized": true, "count": n, "type": "VEC4"});
            attributes["COLOR_0"] = self.push(bytes.collect(), 34962, accessor);
        }
        let mut primitive = json!({"attributes": attributes, "indices": self.indices(own)});
        if let Some(material) = material {
            primitive["material"] = json!(material);
        }
        primitive
    }

    fn indices(&mut self, own: &Vertices) -> Value {
        let indices = own.triangles.as_flattened();
        // The greatest index is then below the greatest u16, which is the restart index.
        let (component, bytes) = if u16::try_from(own.origins.len()).is_ok() {
            let short = indices.iter().flat_map(|&i| (i as u16).to_le_bytes());
            (5123, short.collect())
        } else {
            (5125, indices.iter().flat_map(|i| i.to_le_bytes()).collect())
        };
        let accessor =
            json!({"componentType": component, "count": indices.len(), "type": "SCALAR"});
        self.push(bytes, 34963, accessor)
    }

    /// Appends one accessor with a view of its own and returns its index.
    fn push(&mut self, bytes: Vec<u8>, target: u32, mut accessor: Value) -> Value {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        accessor["bufferView"] = json!(self.views.len());
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bin.len(), "byteLength": bytes.len(), "target": target,
        }));
        self.bin.extend(bytes);
        self.accessors.push(accessor);
        json!(self.accessors.len() - 1)
    }
}

fn floats(count: usize, kind: &str) -> Value {
    json!({"componentType": 5126, "count": count, "type": kind})
}

fn little(numbers: impl Iterator<Item = f32>) -> Vec<u8> {
    numbers.flat_map(f32::to_le_bytes).collect()
}

/// Normalizes normals, rounding once from f64; returns `None` if one has no direction.
pub(super) fn unit_normals(normals: [[f64; 3]; 3]) -> Option<[[f32; 3]; 3]> {
    let unit = |n: [f64; 3]| {
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length.is_finite() && length > 1e-12).then(|| n.map(|x| (x / length) as f32 + 0.0))
    };
    let [a, b, c] = normals;
    Some([unit(a)?, unit(b)?, unit(c)?])
}

// Vertices with attributes, made from corners that have attributes each.

/// Attributes of a corner of a triangle.
#[derive(Clone, Copy)]
struct GltfCorner {
    /// Vertex of the file.
    pub vertex: u32,
    pub normal: Option<[f32; 3]>,
    pub uv: Option<[f32; 2]>,
}

/// Attributes in which corners must agree to be one vertex.
type CornerKey = (Option<[u32; 3]>, Option<[u32; 2]>);

/// Vertices and triangles of a primitive.
struct Vertices {
    /// For each vertex that of the file.
    pub origins: Vec<u32>,
    pub triangles: Vec<[u32; 3]>,
    pub normals: Option<Vec<[f32; 3]>>,
    pub uvs: Option<Vec<[f32; 2]>>,
}

impl Vertices {
    /// Splits the vertices `of_file`, increasing, whose corners differ. The first corner found stays with the vertex,
    /// copies for the others follow after all vertices.
    pub fn new(
        of_file: &[u32],
        corners: impl Iterator<Item = [GltfCorner; 3]>,
        has_normals: bool,
        has_uvs: bool,
    ) -> Self {
        let is_identity = of_file
            .last()
            .is_none_or(|last| *last as usize + 1 == of_file.len());
        // Give the vertex to its first corner, and a copy to each corner that differs.
        let mut given: Vec<Option<GltfCorner>> = vec![None; of_file.len()];
        let mut copies: HashMap<(u32, CornerKey), u32> = HashMap::new();
        let mut origins = of_file.to_vec();
        let mut place = |corner: GltfCorner| {
            let own = if is_identity {
                corner.vertex
            } else {
                // Every corner's vertex is among those of its file.
                of_file.binary_search(&corner.vertex).unwrap_or_default() as u32
            };
            let first = given[own as usize].get_or_insert(corner);
            if key(first) == key(&corner) {
                return own;
            }
            *copies.entry((own, key(&corner))).or_insert_with(|| {
                given.push(Some(corner));
                origins.push(corner.vertex);
                origins.len() as u32 - 1
            })
        };
        let triangles = corners.map(|face| face.map(&mut place)).collect();
        // A vertex of no face has neither; any unit vector will do.
        Self {
            normals: has_normals.then(|| {
                given
                    .iter()
                    .map(|corner: &Option<GltfCorner>| {
                        corner.and_then(|c| c.normal).unwrap_or([0.0, 0.0, 1.0])
                    })
                    .collect()
            }),
            uvs: has_uvs.then(|| {
                given
                    .iter()
                    .map(|corner: &Option<GltfCorner>| {
                        corner.and_then(|c| c.uv).unwrap_or_default()
                    })
                    .collect()
            }),
            origins,
            triangles,
        }
    }
}

fn key(corner: &GltfCorner) -> CornerKey {
    (
        corner.normal.map(|normal| normal.map(f32::to_bits)),
        corner.uv.map(|uv| uv.map(f32::to_bits)),
    )
}
