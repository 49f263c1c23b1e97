//! Files that are made to use up memory or time: what they take is counted in bytes and in what is left undone, not in seconds.

#[path = "support/build.rs"]
#[allow(dead_code)]
mod build;

use std::f64::consts::TAU;
use std::sync::Mutex;

use build::Builder;
use serde_json::{Value, json};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, Stats, StatsAlloc};
use unwrapd::certificate::{Claims, certify};
use unwrapd::document::{Document, Upload};
use unwrapd::pipeline::{Options, Preset, Unobserved, unwrap_document};

#[global_allocator]
static ALLOCATOR: &StatsAlloc<std::alloc::System> = &INSTRUMENTED_SYSTEM;

/// One at a time: allocations are those of the whole process.
static ALONE: Mutex<()> = Mutex::new(());

/// What `work` returns, and what it allocated.
fn counted<T>(work: impl FnOnce() -> T) -> (T, Stats) {
    let region = Region::new(ALLOCATOR);
    let result = work();
    (result, region.change())
}

/// Reads a file that has to be refused with few bytes allocated.
fn assert_refused(upload: &Upload, most_bytes: usize) {
    let (read, stats) = counted(|| Document::read(upload).err());
    assert_eq!(read.expect("too much").code(), "limit_exceeded");
    let bytes = stats.bytes_allocated + stats.bytes_reallocated.max(0) as usize;
    assert!(bytes < most_bytes, "{stats:?}");
}

/// A triangle with so many bytes of an item beside it.
fn with_extras(item: &str, bytes: usize) -> Upload {
    let mut builder = Builder::triangle();
    builder.json["buffers"][0]["uri"] = json!("triangle.bin");
    let mut text = builder.json.to_string();
    text.truncate(text.len() - 1);
    text.push_str(",\"extras\":[");
    let n = bytes / (item.len() + 1);
    text.push_str(&vec![item; n].join(","));
    text.push_str("]}");
    let mut upload = Upload::single("a.gltf", text.into_bytes());
    (upload.resources).insert("triangle.bin".to_owned(), builder.bin);
    upload
}

#[test]
fn json_that_would_fill_the_memory_is_not_read() {
    let _alone = ALONE.lock();
    for (item, bytes) in [
        (r#"{"a":0}"#, 16 << 20),
        (r#"{"a":{"a":{}}}"#, 16 << 20),
        ("[0]", 16 << 20),
        ("0", 50 << 20),
    ] {
        assert_refused(&with_extras(item, bytes), 1 << 20);
    }
}

#[test]
fn json_that_fits_is_read() {
    let _alone = ALONE.lock();
    for (item, bytes) in [("{}", 8 << 20), ("0", 8 << 20), (r#"{"a":0}"#, 8 << 20)] {
        assert!(Document::read(&with_extras(item, bytes)).is_ok(), "{item}");
    }
}

/// The codec has streams in which every byte stands for a thousand.
#[test]
fn compressed_views_may_not_claim_what_their_bytes_cannot_hold() {
    let _alone = ALONE.lock();
    let (count, stride) = ((512 << 20) / 12, 12);
    let mut builder = Builder::triangle();
    let mut data = vec![0xA1];
    data.resize(data.len() + count / 256 * stride / 4, 0xAA);
    data.extend([0; 24]);
    let compressed = builder.view(&data);
    let offset = builder.json["bufferViews"][compressed]["byteOffset"].clone();
    let views = builder.json["bufferViews"].as_array_mut().unwrap();
    for _ in 0..4 {
        views.push(json!({
            "buffer": 0, "byteLength": count * stride,
            "extensions": {"EXT_meshopt_compression": {
                "buffer": 0, "byteOffset": offset, "byteLength": data.len(),
                "byteStride": stride, "count": count, "mode": "ATTRIBUTES",
            }},
        }));
    }
    assert_refused(&builder.upload(), 4 * data.len());
}

#[test]
fn nodes_do_not_multiply_primitives_without_end() {
    let _alone = ALONE.lock();
    let mut builder = Builder::triangle();
    let primitive = builder.json["meshes"][0]["primitives"][0].clone();
    builder.json["meshes"][0]["primitives"] = Value::Array(vec![primitive; 3000]);
    builder.json["nodes"] = Value::Array(vec![json!({"mesh": 0}); 3000]);
    let options = Options {
        preset: Preset::Lightmap,
        ..Options::default()
    };
    let upload = builder.upload();
    let (result, stats) = counted(|| unwrap_document(&upload, &options, &Unobserved).err());
    assert_eq!(result.expect("too much").code(), "limit_exceeded");
    assert!(stats.bytes_allocated < 32 << 20, "{stats:?}");
}

/// Each node's transform is found once, from that of its parent.
#[test]
fn a_chain_of_nodes_costs_what_its_nodes_cost() {
    const N: usize = 4000;
    let _alone = ALONE.lock();
    let mut builder = Builder::triangle();
    let mesh = builder.json["meshes"][0].clone();
    builder.json["meshes"] = Value::Array(vec![mesh; N]);
    let node = |i: usize| {
        let mut node = json!({"mesh": i, "translation": [0, 0, 1]});
        if i + 1 < N {
            node["children"] = json!([i + 1]);
        }
        node
    };
    builder.json["nodes"] = (0..N).map(node).collect();
    let document = Document::read(&builder.upload()).unwrap();
    let (placed, stats) = counted(|| document.primitives_in_scene().unwrap());
    assert_eq!(placed[N - 1].positions[0], [0.0, 0.0, N as f32]);
    assert!(stats.allocations < 20 * N, "{stats:?}");
}

/// The boxes of all its triangles meet, so that a search among them would end unfinished.
#[test]
fn a_fan_is_bijective_by_its_boundary() {
    const N: u32 = 60_000;
    let _alone = ALONE.lock();
    let rim = (0..N).map(|i| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(N)).sin_cos();
        [cos, sin, 0.0].map(|x| f64::from(x as f32))
    });
    let positions: Vec<[f64; 3]> = [[0.0; 3]].into_iter().chain(rim).collect();
    let triangles: Vec<[u32; 3]> = (0..N).map(|i| [0, 1 + i, 1 + (i + 1) % N]).collect();
    let uv = |v: u32| [positions[v as usize][0], positions[v as usize][1]];
    let uvs: Vec<[[f64; 2]; 3]> = triangles.iter().map(|t| t.map(uv)).collect();
    let certificate = certify(&positions, &triangles, &uvs, &Claims::default());
    assert!(certificate.is_bijective(), "{certificate:?}");
}

/// A crowd of meshes is packed in less time each, on coarser rasters, and judged on such.
#[test]
fn each_of_many_meshes_takes_less() {
    let _alone = ALONE.lock();
    let mut builder = Builder::new();
    for i in 0..300 {
        let height = 1.0 + i as f32 / 300.0;
        let corners = [0., 0., 0., 1., 0., 0., 0., height, 0.];
        let position = builder.floats("VEC3", 3, &corners);
        builder.primitive(&json!({"attributes": {"POSITION": position}}));
    }
    let outcome = unwrap_document(&builder.upload(), &Options::default(), &Unobserved).unwrap();
    assert!(outcome.report.proven.bijective);
    let rasters = outcome.report.groups.iter();
    assert!(
        rasters
            .map(|g| g.measures.packing.raster_res)
            .all(|n| n == 2048)
    );
}
