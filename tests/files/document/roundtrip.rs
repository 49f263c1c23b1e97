//! Every real file: positions per corner stay, UVs are what was written.
use crate::documents::{gltf_files, grid_uvs, new_uvs, options, reread, upload};
use crate::places;
use std::path::Path;
use unwrapd_files::document::{Document, OutputFormat};

const BITS: u32 = 12;

#[test]
fn every_file_comes_back_with_its_new_uvs() {
    check_all(&places::asset(""));
}

fn check_all(folder: &Path) {
    for path in gltf_files(folder) {
        let upload = upload(&path);
        let document = match Document::read(&upload) {
            Ok(document) => document,
            Err(error) => {
                assert_eq!(error.code(), "no_triangles", "{}: {error}", path.display());
                continue;
            }
        };
        for (period, format) in [(1, OutputFormat::Glb), (5, OutputFormat::Gltf)] {
            check(&document, period, format, &path.display().to_string());
        }
    }
}

fn check(document: &Document, period: usize, format: OutputFormat, name: &str) {
    let grid = grid_uvs(document, BITS, period);
    let uvs = new_uvs(&grid, BITS);
    let written = document.write(&uvs, &options(format)).unwrap();
    let again = document.write(&uvs, &options(format)).unwrap();
    assert!(written.files == again.files, "{name}: not deterministic");
    let back = reread(&written);
    assert_eq!(
        back.primitives().len(),
        document.primitives().len(),
        "{name}"
    );
    for (index, (new, old)) in back
        .primitives()
        .iter()
        .zip(document.primitives())
        .enumerate()
    {
        assert_eq!(
            (new.mesh, new.primitive, new.material),
            (old.mesh, old.primitive, old.material)
        );
        let corners = |p: &unwrapd_files::document::Primitive| -> Vec<[[u32; 3]; 3]> {
            let position = |v: u32| p.positions[v as usize].map(f32::to_bits);
            p.triangles.iter().map(|face| face.map(position)).collect()
        };
        assert!(corners(new) == corners(old), "{name}: positions moved");
        let set = written.notes.primitives[index].texcoord;
        let stored = back.corner_uvs(index, set).unwrap().unwrap();
        let scale = f64::from(1 << BITS);
        for (stored, grid) in stored.iter().zip(&grid[index]) {
            let expected = grid.map(|[u, v]| [f64::from(u) / scale, 1.0 - f64::from(v) / scale]);
            assert_eq!(*stored, expected, "{name}");
        }
    }
}

mod shared {
    use super::{check_all, places};

    #[test]
    #[ignore = "needs ../shared"]
    fn every_file_comes_back_with_its_new_uvs() {
        check_all(&places::shared("data/gltf"));
    }
}
