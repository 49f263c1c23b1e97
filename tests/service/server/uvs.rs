//! The UVs as arrays, beside the result that they are of.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;
use unwrapd::document::{Document, Primitive, Upload};

use super::{Server, assert_problem, ended, form};
use crate::cli::asset;
use crate::meshes;

type Places = [[f32; 3]; 3];

/// What the file says of a primitive.
struct Arrays {
    place: [u32; 2],
    uvs: Vec<[[f32; 2]; 3]>,
    faces: Vec<u32>,
    vertices: Vec<u32>,
}

/// Reads the file as its description has it.
fn read(bytes: &[u8]) -> Vec<Arrays> {
    let (magic, rest) = bytes.split_at(4);
    assert_eq!(magic, b"UVS1");
    let (words, odd) = rest.as_chunks::<4>();
    assert!(odd.is_empty());
    let mut words = words.iter().map(|word| u32::from_le_bytes(*word));
    let mut take = |n: u32| -> Vec<u32> { words.by_ref().take(n as usize).collect() };
    let n = take(1)[0];
    let heads: Vec<Vec<u32>> = (0..n).map(|_| take(4)).collect();
    let arrays = heads.iter().map(|head| {
        let floats: Vec<f32> = take(6 * head[2]).into_iter().map(f32::from_bits).collect();
        Arrays {
            place: [head[0], head[1]],
            uvs: floats.as_chunks().0.as_chunks().0.to_vec(),
            faces: take(head[2]),
            vertices: take(head[3]),
        }
    });
    let arrays = arrays.collect();
    assert_eq!(words.next(), None, "nothing follows");
    arrays
}

fn document(name: &str, bytes: &[u8]) -> Document {
    let upload = Upload {
        name: name.to_owned(),
        bytes: bytes.to_vec(),
        resources: std::collections::BTreeMap::default(),
    };
    Document::read(&upload).expect("a document")
}

fn triangles(primitive: &Primitive) -> Vec<Places> {
    let place = |vertex: u32| primitive.positions[vertex as usize];
    primitive
        .triangles
        .iter()
        .map(|face| face.map(place))
        .collect()
}

/// Unwraps a file and compares the arrays with the result, and both with what was sent: its vertices, and its triangles by the
/// primitives of the result.
async fn compare(
    server: &Server,
    (name, bytes, format): (&str, Vec<u8>, &str),
    (positions, faces): (&[[f32; 3]], &[Vec<Places>]),
) {
    let options = json!({ "format": format }).to_string();
    let job = ended(server, form("unwrap", &options, (name, bytes))).await;
    let of_job = job["links"]["self"].as_str().expect("a link");
    let path = format!("{of_job}/uvs.bin");
    let listed = job["links"]["files"].as_array().expect("a list");
    assert!(listed.iter().any(|file| file["href"] == path), "{job}");
    let answer = server.get(&path).send().await.expect("an answer");
    assert_eq!(answer.headers()["content-type"], "application/octet-stream");
    let arrays = read(&answer.bytes().await.expect("bytes"));
    let result = server.get(&format!("{of_job}/result")).send().await;
    let result = result.expect("an answer").bytes().await.expect("bytes");
    let written = document(&format!("result.{format}"), &result);
    // An OBJ file has one primitive for all.
    assert!(format == "obj" || arrays.len() == written.primitives().len());
    let mut all = Vec::new();
    for ((index, own), sent) in arrays.iter().enumerate().zip(faces) {
        let back = own.faces.iter().map(|&face| sent[face as usize]);
        let back: Vec<Places> = back.collect();
        all.extend(own.uvs.iter().map(|face| face.map(|uv| uv.map(f64::from))));
        if format != "obj" {
            let primitive = &written.primitives()[index];
            assert_eq!(
                own.place,
                [primitive.mesh as u32, primitive.primitive as u32]
            );
            let sources = own.vertices.iter().map(|&v| positions[v as usize]);
            assert!(sources.eq(primitive.positions.iter().copied()), "{name}");
            assert_eq!(back, triangles(primitive), "{name}");
        }
    }
    let n = written.primitives().len();
    let uvs = (0..n).flat_map(|p| written.corner_uvs(p, 0).expect("UVs").expect("a set"));
    assert!(uvs.eq(all), "{name}");
}

/// Two primitives of some elements each of the same accessors.
fn shared() -> (Vec<u8>, Vec<[f32; 3]>) {
    let corner = |i: u32| [0, 1, 2].map(|axis| (i >> axis & 1) as f32);
    let positions: Vec<[f32; 3]> = (0..8).map(corner).collect();
    let indices: [[u32; 3]; 4] = [[0, 1, 3], [0, 3, 2], [5, 4, 7], [4, 6, 7]];
    let mut bin: Vec<u8> = positions
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    bin.extend(indices.iter().flatten().flat_map(|i| i.to_le_bytes()));
    let data = STANDARD.encode(&bin);
    let primitive = |indices: u32| json!({ "attributes": { "POSITION": 0 }, "indices": indices });
    let list = |first: u32| json!({ "bufferView": 1, "byteOffset": first, "componentType": 5125, "count": 6, "type": "SCALAR" });
    let gltf = json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [primitive(1), primitive(2)] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1] },
            list(0), list(24),
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 96 },
            { "buffer": 0, "byteOffset": 96, "byteLength": 48 },
        ],
        "buffers": [{
            "byteLength": bin.len(),
            "uri": format!("data:application/octet-stream;base64,{data}"),
        }],
    });
    (gltf.to_string().into_bytes(), positions)
}

#[tokio::test]
async fn arrays_agree_with_the_result_and_the_input() {
    let server = Server::start();
    let glb = meshes::hills(8);
    let sent = document("hills.glb", &glb);
    let own = &sent.primitives()[0];
    let of = (own.positions.as_slice(), &[triangles(own)][..]);
    compare(&server, ("hills.glb", glb.clone(), "glb"), of).await;
    compare(&server, ("hills.glb", glb, "obj"), of).await;

    let (gltf, positions) = shared();
    let sent = document("shared.gltf", &gltf);
    let faces: Vec<Vec<Places>> = sent.primitives().iter().map(triangles).collect();
    compare(&server, ("shared.gltf", gltf, "glb"), (&positions, &faces)).await;
}

/// Objects become meshes: the faces of the second stand before the last of the first.
#[tokio::test]
async fn arrays_count_as_the_input_does() {
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n\
        o a\nf 1 2 3\no b\nf 7 5 6\no a\nf 1 3 4\n";
    let server = Server::start();
    let sent = document("two.obj", obj.as_bytes());
    let own = &sent.primitives()[0];
    let all = triangles(own);
    let of = (own.positions.as_slice(), &[all.clone(), all][..]);
    compare(&server, ("two.obj", obj.into(), "glb"), of).await;
}

#[tokio::test]
async fn only_atlases_have_arrays() {
    let server = Server::start();
    let glb = std::fs::read(asset("MultiUVTest.glb")).expect("a file");
    let job = ended(&server, form("measure", "{}", ("uvs.glb", glb))).await;
    let of_job = job["links"]["self"].as_str().expect("a link");
    let answer = server.get(&format!("{of_job}/uvs.bin")).send().await;
    assert_problem(answer.expect("an answer"), 404, "no_such_file").await;
}
