//! Broken files: a document or a named error, never a panic.
use super::build::{Builder, glb};
use super::{files, grid_uvs, new_uvs, options, shared, upload};
use unwrapd::document::{Document, DocumentError, OutputFormat, Upload};

fn read_and_write(upload: &Upload) -> Result<(), DocumentError> {
    let document = Document::read(upload)?;
    let grid = grid_uvs(&document, 10, 2);
    for set in 0..2 {
        let _ = document.corner_uvs(0, set);
    }
    document.write(&new_uvs(&grid, 10), &options(OutputFormat::Glb))?;
    Ok(())
}

#[test]
fn every_invalid_file_is_read_or_refused_by_name() {
    let Some(folder) = shared("invalid") else {
        return;
    };
    let mut codes = std::collections::BTreeMap::new();
    for path in files(&folder) {
        if !path.extension().is_some_and(|e| e == "glb" || e == "gltf") {
            continue;
        }
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
    let mut seeds = vec![("synthetic.glb".to_owned(), Builder::rich().glb())];
    if let Some(folder) = shared("gltf") {
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
