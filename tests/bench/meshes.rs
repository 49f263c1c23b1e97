//! What the benchmarks of the solver are run on.

use std::collections::HashMap;
use std::path::Path;

use unwrapd::io::{obj, off, ply, stl};
use unwrapd::mesh::Surface;

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/data");

/// The files of a folder of the test data.
pub fn of(folder: &str) -> Vec<String> {
    let all = std::fs::read_dir(path(folder)).expect("test data");
    let path = |entry: std::io::Result<std::fs::DirEntry>| entry.expect("readable").path();
    let mut files: Vec<String> = all
        .map(|entry| path(entry).to_string_lossy().into_owned())
        .collect();
    files.sort();
    files
}

/// A file or folder of the test data.
pub fn path(file: &str) -> String {
    format!("{DATA}/{file}")
}

/// What is in a file, if it can be read.
pub fn read(file: &str) -> Option<Surface> {
    let bytes = std::fs::read(file).ok()?;
    let extension = Path::new(file).extension()?.to_ascii_lowercase();
    let mesh = match extension.to_str()? {
        "obj" => obj::read(&bytes).ok()?.mesh,
        "off" => off::read(&bytes).ok()?,
        "ply" => ply::read(&bytes).ok()?,
        "stl" => stl::read(&bytes).ok()?,
        _ => return None,
    };
    Surface::new(&mesh.positions, &mesh.triangles).ok()
}

/// Every triangle cut into four at the middles of its edges.
pub fn subdivided(positions: &mut Vec<[f64; 3]>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            let (p, q) = (positions[a as usize], positions[b as usize]);
            positions.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
            positions.len() as u32 - 1
        })
    };
    let quarters = triangles.iter().flat_map(|&[a, b, c]| {
        let (x, y, z) = (middle(a, b), middle(b, c), middle(c, a));
        [[a, x, z], [b, y, x], [c, z, y], [x, y, z]]
    });
    quarters.collect()
}
