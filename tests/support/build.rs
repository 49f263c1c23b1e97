//! Small documents made by hand.
use serde_json::{Value, json};
use unwrapd_files::document::{Document, Upload};

pub struct Builder {
    pub json: Value,
    pub bin: Vec<u8>,
}

/// A GLB file.
pub fn glb(json: &Value, bin: &[u8]) -> Vec<u8> {
    let mut text = json.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bin = bin.to_vec();
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    let length = 12 + 8 + text.len() + 8 + bin.len();
    bytes.extend((length as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &bin)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

impl Builder {
    pub fn new() -> Self {
        Self {
            json: json!({
                "asset": {"version": "2.0"},
                "accessors": [],
                "bufferViews": [],
                "buffers": [{"byteLength": 0}],
                "meshes": [],
            }),
            bin: Vec::new(),
        }
    }

    /// Adds an accessor over its own view.
    pub fn accessor(&mut self, kind: &str, component: u32, count: usize, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let accessors = self.json["accessors"].as_array_mut().unwrap();
        accessors.push(json!({
            "bufferView": view, "componentType": component, "count": count, "type": kind,
        }));
        accessors.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bin.resize(self.bin.len().next_multiple_of(4), 0);
        let offset = self.bin.len();
        self.bin.extend_from_slice(bytes);
        self.json["buffers"][0]["byteLength"] = json!(self.bin.len());
        let views = self.json["bufferViews"].as_array_mut().unwrap();
        views.push(json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}));
        views.len() - 1
    }

    pub fn floats(&mut self, kind: &str, width: usize, values: &[f32]) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(kind, 5126, values.len() / width, &bytes)
    }

    pub fn primitive(&mut self, primitive: &Value) {
        let meshes = self.json["meshes"].as_array_mut().unwrap();
        meshes.push(json!({"primitives": [primitive]}));
    }

    /// One triangle without indices.
    pub fn triangle() -> Self {
        let mut builder = Self::new();
        let position = builder.floats("VEC3", 3, &[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
        builder.primitive(&json!({"attributes": {"POSITION": position}}));
        builder
    }

    /// The unit square as two triangles that share an edge, `u16` indices.
    pub fn square() -> Self {
        let mut builder = Self::new();
        builder.push_square();
        builder
    }

    fn push_square(&mut self) {
        let corners = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.];
        let position = self.floats("VEC3", 3, &corners);
        let bytes: Vec<u8> = [0u16, 1, 2, 0, 2, 3]
            .iter()
            .flat_map(|i| i.to_le_bytes())
            .collect();
        let indices = self.accessor("SCALAR", 5123, 6, &bytes);
        self.primitive(&json!({"attributes": {"POSITION": position}, "indices": indices}));
    }

    /// A square with every kind of attribute, morph targets, a skin, an animation, extras and unknown extensions.
    pub fn rich() -> Self {
        let mut b = Self::square();
        let normal = b.floats("VEC3", 3, &[0., 0., 1.].repeat(4));
        let tangent = b.floats("VEC4", 4, &[1., 0., 0., 1.].repeat(4));
        let texcoord = b.accessor(
            "VEC2",
            5123,
            4,
            &[
                0, 0, 0, 0, 255, 255, 0, 0, 255, 255, 255, 255, 0, 0, 255, 255,
            ],
        );
        b.json["accessors"][texcoord]["normalized"] = json!(true);
        let joints_view = b.view(&[0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0]);
        b.json["bufferViews"][joints_view]["byteStride"] = json!(4);
        let joints = push(
            &mut b.json,
            json!({"bufferView": joints_view, "componentType": 5121, "count": 4, "type": "VEC4"}),
        );
        let weights = b.floats("VEC4", 4, &[0.5, 0.5, 0., 0.].repeat(4));
        let colors_view = b.view(&[1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 0]);
        b.json["bufferViews"][colors_view]["byteStride"] = json!(4);
        let color = push(
            &mut b.json,
            json!({"bufferView": colors_view, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3"}),
        );
        let feature = b.floats("SCALAR", 1, &[10., 11., 12., 13.]);
        let indices = b.view(&[1, 0, 3, 0]);
        let values: Vec<u8> = [0f32, 0., 5., 0., 0., 7.]
            .iter()
            .flat_map(|x| x.to_le_bytes())
            .collect();
        let values = b.view(&values);
        let morph = push(
            &mut b.json,
            json!({"componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 7],
            "sparse": {"count": 2, "indices": {"bufferView": indices, "componentType": 5123}, "values": {"bufferView": values}}}),
        );
        let times = b.floats("SCALAR", 1, &[0., 1.]);
        let output = b.floats("SCALAR", 1, &[0., 1.]);
        let matrices = b.floats(
            "MAT4",
            16,
            &[
                1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.,
            ]
            .repeat(2),
        );
        let primitive = &mut b.json["meshes"][0]["primitives"][0];
        primitive["attributes"] = json!({"NORMAL": normal, "POSITION": 0, "TANGENT": tangent, "TEXCOORD_0": texcoord,
            "JOINTS_0": joints, "WEIGHTS_0": weights, "COLOR_0": color, "_FEATURE_ID_0": feature});
        primitive["targets"] = json!([{"POSITION": morph}]);
        primitive["material"] = json!(0);
        primitive["extras"] = json!({"keep": [1, {"me": null}]});
        let shared = primitive.clone();
        b.json["meshes"][0]["weights"] = json!([0.25]);
        b.json["meshes"][0]["extensions"] = json!({"ACME_mesh": {"x": 1}});
        let meshes = b.json["meshes"].as_array_mut().unwrap();
        meshes.push(json!({"primitives": [{"attributes": shared["attributes"], "mode": 0}], "name": "points"}));
        b.json["materials"] = json!([{
            "pbrMetallicRoughness": {"baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}},
            "normalTexture": {"index": 0, "scale": 0.5},
        }]);
        b.json["textures"] = json!([{"source": 0}]);
        b.json["images"] = json!([{"uri": "data:image/png;base64,iVBORw0KGgo="}]);
        b.json["nodes"] = json!([{"mesh": 0, "skin": 0, "extras": {"n": 1}}, {"children": [2]}, {"translation": [0.1, 1e-7, 3]}, {"mesh": 1}]);
        b.json["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": matrices}]);
        b.json["animations"] = json!([{"channels": [{"sampler": 0, "target": {"node": 0, "path": "weights", "extras": 7}}],
            "samplers": [{"input": times, "output": output}]}]);
        b.json["scenes"] = json!([{"nodes": [0, 1, 3]}]);
        b.json["extensionsUsed"] = json!(["KHR_texture_transform", "ACME_mesh", "ACME_root"]);
        b.json["extensions"] = json!({"ACME_root": {"big": 12_345_678_901_u64, "small": 6.1e-5}});
        b.json["unknown member"] = json!([true]);
        b
    }

    pub fn glb(&self) -> Vec<u8> {
        glb(&self.json, &self.bin)
    }

    pub fn upload(&self) -> Upload {
        Upload::single("a.glb", self.glb())
    }

    pub fn document(&self) -> Document {
        Document::read(&self.upload()).unwrap()
    }
}

fn push(json: &mut Value, accessor: Value) -> usize {
    let accessors = json["accessors"].as_array_mut().unwrap();
    accessors.push(accessor);
    accessors.len() - 1
}

/// JSON and binary chunk of a GLB file.
pub fn parts(glb: &[u8]) -> (Value, Vec<u8>) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    let length = word(12);
    let json = serde_json::from_slice(&glb[20..20 + length]).unwrap();
    let bin = glb.get(28 + length..).unwrap_or_default();
    (json, bin.to_vec())
}
