//! A new glTF file for triangles that came from another format: one mesh, one node, one scene.
//!
//! Only the document without UVs is made here; the UVs are then written as into any other glTF document, so vertices are
//! split and the set is chosen in one place.
use super::gltf::GltfDocument;
use super::{DocumentError, NewUvs, Primitive, Upload, WriteOptions, Written};
use serde_json::{Value, json};
use std::collections::{BTreeMap, HashMap};

/// The one buffer's name while the document is made.
const BUFFER: &str = "data.bin";

/// Writes a primitive with its UVs, and with normals where every corner has one.
pub(super) fn write(
    primitive: &Primitive,
    normals: Option<&[[[f32; 3]; 3]]>,
    uvs: &NewUvs,
    options: &WriteOptions,
) -> Result<Written, DocumentError> {
    let vertices = Vertices::new(primitive, normals);
    let (json, bin) = vertices.gltf();
    let upload = Upload {
        name: "new.gltf".to_owned(),
        bytes: json.to_string().into_bytes(),
        resources: BTreeMap::from([(BUFFER.to_owned(), bin)]),
    };
    GltfDocument::read(&upload)?.write(uvs, options, None, None)
}

/// Vertices with all attributes.
struct Vertices {
    positions: Vec<[f32; 3]>,
    normals: Vec<[f32; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl Vertices {
    /// The primitive's vertices, split where the corners of one have different normals. Normals that cannot be made of
    /// unit length are left out, all of them.
    fn new(primitive: &Primitive, normals: Option<&[[[f32; 3]; 3]]>) -> Self {
        let mut vertices = Self {
            positions: primitive.positions.clone(),
            normals: Vec::new(),
            triangles: primitive.triangles.clone(),
        };
        if let Some(normals) = normals.and_then(unit) {
            vertices.split_by(&normals);
        }
        vertices
    }

    /// The first normal met stays with the vertex, copies for the others follow behind.
    fn split_by(&mut self, normals: &[[[f32; 3]; 3]]) {
        let mut given: Vec<Option<[f32; 3]>> = vec![None; self.positions.len()];
        let mut copies: HashMap<(u32, [u32; 3]), u32> = HashMap::new();
        for (face, normals) in self.triangles.iter_mut().zip(normals) {
            for (vertex, normal) in face.iter_mut().zip(normals) {
                let first = given[*vertex as usize].get_or_insert(*normal);
                if first == normal {
                    continue;
                }
                let old = *vertex as usize;
                *vertex = *copies
                    .entry((*vertex, normal.map(f32::to_bits)))
                    .or_insert_with(|| {
                        given.push(Some(*normal));
                        self.positions.push(self.positions[old]);
                        self.positions.len() as u32 - 1
                    });
            }
        }
        // A vertex of no face has none; any unit vector will do.
        self.normals = given
            .into_iter()
            .map(|n| n.unwrap_or([0.0, 0.0, 1.0]))
            .collect();
    }

    /// The JSON and the buffer.
    fn gltf(&self) -> (Value, Vec<u8>) {
        let mut parts = Parts::default();
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for position in &self.positions {
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
        }
        let n_vertices = self.positions.len();
        let mut attributes = json!({});
        attributes["POSITION"] = parts.push(
            self.positions.iter().flatten().flat_map(|x| x.to_le_bytes()).collect(),
            34962,
            json!({"componentType": 5126, "count": n_vertices, "type": "VEC3", "min": low, "max": high}),
        );
        if !self.normals.is_empty() {
            attributes["NORMAL"] = parts.push(
                self.normals
                    .iter()
                    .flatten()
                    .flat_map(|x| x.to_le_bytes())
                    .collect(),
                34962,
                json!({"componentType": 5126, "count": n_vertices, "type": "VEC3"}),
            );
        }
        let indices = self.triangles.as_flattened();
        // The greatest index is then below the greatest u16, which is the restart index.
        let (component, bytes) = if u16::try_from(n_vertices).is_ok() {
            (
                5123,
                indices
                    .iter()
                    .flat_map(|&i| (i as u16).to_le_bytes())
                    .collect(),
            )
        } else {
            (5125, indices.iter().flat_map(|i| i.to_le_bytes()).collect())
        };
        let accessor =
            json!({"componentType": component, "count": indices.len(), "type": "SCALAR"});
        let indices = parts.push(bytes, 34963, accessor);
        let json = json!({
            "asset": {"generator": "unwrapd", "version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}],
            "accessors": parts.accessors,
            "bufferViews": parts.views,
            "buffers": [{"uri": BUFFER, "byteLength": parts.bin.len()}],
        });
        (json, parts.bin)
    }
}

/// Unit normals, rounded once from f64.
fn unit(normals: &[[[f32; 3]; 3]]) -> Option<Vec<[[f32; 3]; 3]>> {
    let unit = |n: [f32; 3]| {
        let n = n.map(f64::from);
        let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
        (length.is_finite() && length > 1e-12).then(|| n.map(|x| (x / length) as f32 + 0.0))
    };
    let face = |face: &[[f32; 3]; 3]| Some([unit(face[0])?, unit(face[1])?, unit(face[2])?]);
    normals.iter().map(face).collect()
}

/// Accessors, buffer views and the buffer, growing together.
#[derive(Default)]
struct Parts {
    bin: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Parts {
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
