//! Broken files: a document or a named error, never a panic.
use crate::build::{Builder, glb};
use crate::documents::{grid_uvs, new_uvs, options, upload};
use crate::places;
use serde_json::json;
use unwrapd_files::document::{Document, DocumentError, OutputFormat, Upload};

fn read_and_write(upload: &Upload) -> Result<(), DocumentError> {
    let document = Document::read(upload)?;
    let grid = grid_uvs(&document, 10, 2);
    for set in 0..2 {
        let _ = document.corner_uvs(0, set);
    }
    document.write(&new_uvs(&grid, 10), &options(OutputFormat::Glb))?;
    Ok(())
}

/// A document, and what it is refused with once something in it is broken.
#[test]
fn broken_files_are_refused_by_name() {
    let json = |pointer: &'static str, value: serde_json::Value| {
        let mut builder = Builder::square();
        *builder.json.pointer_mut(pointer).unwrap() = value;
        builder.upload()
    };
    let binary = |at: usize, bytes: &[u8]| {
        let mut builder = Builder::square();
        builder.bin[at..at + bytes.len()].copy_from_slice(bytes);
        builder.upload()
    };
    let whole = Builder::square().glb();
    let file = |bytes: Vec<u8>| Upload::single("a.glb", bytes);
    let first_version = [&whole[..4], &1_u32.to_le_bytes(), &whole[8..]].concat();
    for (what, upload, code) in [
        (
            "an infinity",
            binary(4, &f32::INFINITY.to_le_bytes()),
            "non_finite_position",
        ),
        ("an index", binary(48 + 2, &[4, 0]), "index_out_of_range"),
        ("glTF 1", file(first_version), "unsupported_version"),
        (
            "glTF 3",
            json("/asset/version", json!("3.0")),
            "unsupported_version",
        ),
        (
            "a buffer",
            json("/buffers/0", json!({"uri": "b.bin", "byteLength": 60})),
            "missing_resource",
        ),
        (
            "a chunk",
            file(whole[..whole.len() - 8].to_vec()),
            "invalid_gltf",
        ),
        ("a type", json("/accessors/0", json!([])), "invalid_gltf"),
        (
            "a number",
            json("/accessors/0/count", json!("many")),
            "invalid_gltf",
        ),
        (
            "no primitive",
            json("/meshes/0/primitives", json!([])),
            "no_triangles",
        ),
    ] {
        let error = read_and_write(&upload).expect_err(what);
        assert_eq!(error.code(), code, "{what}: {error}");
        assert!(!error.to_string().contains('\n'), "{error}");
    }
}

#[test]
fn urls_never_leave_the_upload() {
    for uri in [
        "../secret.bin",
        "%2e%2e/secret.bin",
        "a/../../secret.bin",
        "/etc/hostname",
        "file:///etc/hostname",
        "C:\\secret.bin",
        "https://example.com/a.bin",
    ] {
        let mut builder = Builder::triangle();
        builder.json["buffers"][0]["uri"] = uri.into();
        let bytes = serde_json::to_vec(&builder.json).unwrap();
        let mut upload = Upload::single("a.gltf", bytes);
        upload.resources.insert("other.bin".to_owned(), builder.bin);
        let error = Document::read(&upload).err().unwrap();
        assert_eq!(error.code(), "missing_resource", "{uri}");
    }
}

#[test]
fn escaped_and_dotted_names_are_found() {
    for uri in ["my%20data.bin", "./my data.bin", "sub/../my%20data.bin"] {
        let mut builder = Builder::triangle();
        builder.json["buffers"][0]["uri"] = uri.into();
        let bytes = serde_json::to_vec(&builder.json).unwrap();
        let mut upload = Upload::single("a.gltf", bytes);
        upload
            .resources
            .insert("my data.bin".to_owned(), builder.bin);
        assert!(Document::read(&upload).is_ok(), "{uri}");
    }
}

#[test]
fn claims_without_bytes_are_refused() {
    for (pointer, value) in [
        ("/accessors/0/count", 4_000_000_000_000_u64),
        ("/accessors/0/byteOffset", u64::MAX),
        ("/bufferViews/0/byteLength", u64::MAX),
        ("/bufferViews/0/byteOffset", u64::MAX - 3),
        ("/buffers/0/byteLength", 1 << 40),
        ("/bufferViews/0/byteStride", 4),
        ("/accessors/0/componentType", 5),
    ] {
        let mut builder = Builder::triangle();
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        builder.json.pointer_mut(parent).unwrap()[key] = value.into();
        let error = Document::read(&builder.upload()).err().unwrap();
        assert_eq!(error.code(), "invalid_gltf", "{pointer}");
    }
    let mut builder = Builder::triangle();
    let position = &mut builder.json["accessors"][0];
    position.as_object_mut().unwrap().remove("bufferView");
    position["count"] = 4_000_000_000_u64.into();
    let error = Document::read(&builder.upload()).err().unwrap();
    assert_eq!(error.code(), "limit_exceeded");
}

#[test]
fn unknown_required_extensions_matter_only_on_geometry() {
    let mut builder = Builder::triangle();
    builder.json["extensionsRequired"] = serde_json::json!(["ACME_gizmo"]);
    builder.json["extensions"] = serde_json::json!({"ACME_gizmo": {}});
    assert!(Document::read(&builder.upload()).is_ok());
    builder.json["accessors"][0]["extensions"] = serde_json::json!({"ACME_gizmo": {}});
    let error = Document::read(&builder.upload()).err().unwrap();
    assert_eq!(
        error,
        DocumentError::UnsupportedExtension("ACME_gizmo".to_owned())
    );
}

/// Damaged copies of small files; the seed is fixed.
#[test]
fn damaged_files_never_panic() {
    let folder = places::asset("gltf");
    let mut seeds = vec![("synthetic.glb".to_owned(), Builder::rich().glb())];
    for name in [
        "BoxMeshopt.glb",
        "box_sparse.glb",
        "cubeQuantized.glb",
        "cubeStripIndexed.glb",
        "boxExtMeshManifold.glb",
        "singleBlendshapeCube_sparse.glb",
    ] {
        seeds.push((name.to_owned(), std::fs::read(folder.join(name)).unwrap()));
    }
    for name in [
        "BoxMetaDraco/BoxMetaDraco.gltf",
        "KHR_meshopt-no-fallback/meshopt-no-fallback.gltf",
    ] {
        seeds.push((name.to_owned(), packed(&upload(&folder.join(name)))));
    }
    let mut random = 0x9E37_79B9_7F4A_7C15_u64;
    let mut next = move |below: usize| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 11) as usize % below.max(1)
    };
    let (mut accepted, mut refused) = (0, 0);
    for (name, seed) in &seeds {
        assert!(
            Document::read(&Upload::single(name.clone(), seed.clone())).is_ok(),
            "{name}"
        );
        for _ in 0..600 {
            let mut bytes = seed.clone();
            for _ in 0..=next(4) {
                let at = next(bytes.len());
                match next(4) {
                    0 => bytes[at] = next(256) as u8,
                    1 => bytes[at] ^= 1 << next(8),
                    2 => bytes[at] = b"0123456789-{}[],\":"[next(18)],
                    _ => bytes.truncate(bytes.len() - next(bytes.len() / 8)),
                }
            }
            match read_and_write(&Upload::single("a.glb", bytes)) {
                Ok(()) => accepted += 1,
                Err(_) => refused += 1,
            }
        }
    }
    assert!(
        accepted > 100 && refused > 100,
        "{accepted} accepted, {refused} refused"
    );
}

/// A `.gltf` with its first buffer as one GLB, still compressed.
fn packed(upload: &Upload) -> Vec<u8> {
    let mut json: serde_json::Value = serde_json::from_slice(&upload.bytes).unwrap();
    let buffer = json["buffers"][0].as_object_mut().unwrap();
    let uri = buffer.remove("uri").unwrap();
    glb(&json, &upload.resources[uri.as_str().unwrap()])
}

mod shared {
    use super::{places, read_and_write, upload};
    use crate::documents::gltf_files;
    use std::collections::BTreeMap;

    #[test]
    #[ignore = "needs ../shared"]
    fn every_broken_file_is_read_or_refused_by_name() {
        let folder = places::shared("data/invalid");
        let mut codes = BTreeMap::new();
        for path in gltf_files(&folder) {
            let code = match read_and_write(&upload(&path)) {
                Ok(()) => "ok",
                Err(error) => {
                    assert!(!error.to_string().contains('\n'), "{error}");
                    error.code()
                }
            };
            let name = path.strip_prefix(&folder).unwrap().display().to_string();
            println!("{code:24} {name}");
            codes.insert(name, code);
        }
        for (name, code) in [
            ("BoxWithInfinites.glb", "non_finite_position"),
            ("IndexOutOfRange/IndexOutOfRange.gltf", "index_out_of_range"),
            ("cubeSomeBadIndices.glb", "index_out_of_range"),
            ("glTF1/Box.glb", "unsupported_version"),
            ("version-unsupported.gltf", "unsupported_version"),
            ("validator/buffer/not_found.gltf", "missing_resource"),
            ("validator/glb/truncated_chunk_data.glb", "invalid_gltf"),
            ("mesh-invalid-empty-primitives.gltf", "no_triangles"),
        ] {
            assert_eq!(codes.get(name), Some(&code), "{name}");
        }
    }
}
