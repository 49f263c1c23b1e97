//! glTF read and written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use unwrapd_files::document::{
    Document, Layout, NewUvs, OutputFormat, Upload, WriteOptions, Written,
};
use unwrapd_maps::mesh::VAxis;

/// Every glTF file below a folder, sorted.
pub fn gltf_files(folder: &Path) -> Vec<PathBuf> {
    let mut found = files(folder);
    found.retain(|path| path.extension().is_some_and(|e| e == "glb" || e == "gltf"));
    found
}

/// Every file below a folder, sorted.
fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// A file with everything beside and below it.
pub fn upload(path: &Path) -> Upload {
    let folder = path.parent().unwrap();
    let mut resources = BTreeMap::new();
    let alone = path.extension().is_some_and(|e| e == "glb");
    for file in if alone { Vec::new() } else { files(folder) } {
        let name = file.strip_prefix(folder).unwrap().to_str().unwrap();
        if std::fs::metadata(&file).unwrap().len() < 8 << 20 {
            resources.insert(name.to_owned(), std::fs::read(&file).unwrap());
        }
    }
    Upload {
        name: path.file_name().unwrap().to_str().unwrap().to_owned(),
        bytes: std::fs::read(path).unwrap(),
        resources,
    }
}

/// Written files as an upload.
pub fn reread(written: &Written) -> Document {
    let (name, bytes) = written.files[0].clone();
    let resources = written.files[1..].iter().cloned().collect();
    let upload = Upload {
        name,
        bytes,
        resources,
    };
    Document::read(&upload).unwrap()
}

/// Grid UVs that differ wherever `seams` says so: every corner of every `period`-th face has UVs of its own, other
/// corners those of their vertex.
pub fn grid_uvs(document: &Document, bits: u32, period: usize) -> Vec<Vec<[[i32; 2]; 3]>> {
    let side = 1usize << bits;
    let point = |n: usize| [(n * 7 % side) as i32, (n * 13 % (side + 1)) as i32];
    let faces = |triangles: &[[u32; 3]]| {
        let face = |(f, face): (usize, &[u32; 3])| {
            std::array::from_fn(|c| {
                if f % period == 0 {
                    point(3 * f + c + 1)
                } else {
                    point(face[c] as usize)
                }
            })
        };
        triangles.iter().enumerate().map(face).collect()
    };
    let primitives = document.primitives().iter();
    primitives.map(|p| faces(&p.triangles)).collect()
}

/// Grid coordinates in units of 2⁻ᵏ for k = `bits`, v up.
pub fn new_uvs(grid: &[Vec<[[i32; 2]; 3]>], bits: u32) -> NewUvs {
    let unit = |i: i32| i as f32 / (1_u32 << bits) as f32;
    let corners = |faces: &Vec<[[i32; 2]; 3]>| {
        let faces = faces.iter().map(|face| face.map(|uv| uv.map(unit)));
        Some(faces.collect())
    };
    NewUvs {
        layout: Layout::New,
        v_axis: VAxis::Up,
        corners: grid.iter().map(corners).collect(),
    }
}

pub fn options(format: OutputFormat) -> WriteOptions {
    WriteOptions {
        format,
        stem: "out put".to_owned(),
        texcoord: None,
        overwrite: false,
        terms: None,
    }
}
