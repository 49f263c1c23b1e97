//! Meshes to send.

use std::fmt::Write as _;

use serde_json::json;

/// A GLB with one sheet of n × n × 2 triangles with hills of various heights in it.
pub fn hills(n: u32) -> Vec<u8> {
    hills_of([n, n], 0.0)
}

/// The same of so many squares across and along; the hills of each phase are others.
pub fn hills_of([across, along]: [u32; 2], phase: f64) -> Vec<u8> {
    let mut positions = Vec::new();
    for y in 0..=along {
        for x in 0..=across {
            let u = f64::from(x) / f64::from(across);
            let v = f64::from(y) / f64::from(along);
            let height = 0.2 * (9.0 * u + 4.0 * v * v + phase).sin() * (7.0 * v).cos()
                + 0.02 * (61.0 * u * v).sin();
            positions.push([u as f32, v as f32, height as f32]);
        }
    }
    let mut indices = Vec::new();
    for y in 0..along {
        for x in 0..across {
            let corner = y * (across + 1) + x;
            let (right, up) = (corner + 1, corner + across + 1);
            indices.extend([corner, right, up + 1, corner, up + 1, up]);
        }
    }
    glb(&positions, &indices)
}

fn glb(positions: &[[f32; 3]], indices: &[u32]) -> Vec<u8> {
    let index_bytes = indices.len() * 4;
    let bytes: Vec<u8> = indices
        .iter()
        .flat_map(|index| index.to_le_bytes())
        .chain(positions.iter().flatten().flat_map(|x| x.to_le_bytes()))
        .collect();
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 1 }, "indices": 0 }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5125, "count": indices.len(), "type": "SCALAR" },
            { "bufferView": 1, "componentType": 5126, "count": positions.len(), "type": "VEC3",
              "min": [0, 0, -1], "max": [1, 1, 1] },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": index_bytes },
            { "buffer": 0, "byteOffset": index_bytes, "byteLength": positions.len() * 12 },
        ],
        "buffers": [{ "byteLength": bytes.len() }],
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let length = 12 + 8 + text.len() + 8 + bytes.len();
    let mut file = b"glTF".to_vec();
    file.extend(
        [2, length as u32, text.len() as u32]
            .iter()
            .flat_map(|n| n.to_le_bytes()),
    );
    file.extend(b"JSON");
    file.extend(text);
    file.extend((bytes.len() as u32).to_le_bytes());
    file.extend(b"BIN\0");
    file.extend(bytes);
    file
}

/// One triangle as OBJ.
pub const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Quick to unwrap.
pub fn small() -> Vec<u8> {
    hills(12)
}

/// Takes seconds to unwrap, so that something can happen meanwhile.
pub fn large() -> Vec<u8> {
    hills(400)
}

/// Two squares side by side.
pub const PLATE: &str =
    "OFF\n6 4 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n";

/// A bar of `n` cubes, six tetrahedra each.
pub fn bar(n: usize) -> String {
    let mut text = format!("{} {}\n", 4 * (n + 1), 6 * n);
    for x in 0..=n {
        for (y, z) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            writeln!(text, "{x} {y} {z}").expect("memory");
        }
    }
    // The ways from one corner of a cube to the opposite one along its edges.
    for axes in [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ] {
        for x in 0..n {
            let (mut corner, mut corners) = (4 * x, vec![4 * x]);
            for axis in axes {
                corner += [4, 1, 2][axis];
                corners.push(corner);
            }
            let [a, b, c, d] = corners[..] else {
                unreachable!("four corners")
            };
            writeln!(text, "{a} {b} {c} {d}").expect("memory");
        }
    }
    text
}
