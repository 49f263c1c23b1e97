//! Polygons of planar surfaces in the bytes of unwrapped files.

use crate::simple_polygons::{SimplePolygon, doubled_area, simple_polygon};
use std::fmt::Write;
use unwrapd_files::document::{Document, OutputFormat, Upload};
use unwrapd_files::io::obj;
use unwrapd_layout::charts::Cut;
use unwrapd_method::numerics::random::Random;
use unwrapd_pipeline::{Cutting, Options, Outcome, Unobserved, unwrap_document};

/// All polygons in one file, none with a vertex of another.
fn file_of(polygons: &[SimplePolygon]) -> Upload {
    let (mut text, mut first) = (String::new(), 1);
    for polygon in polygons {
        for [x, y, z] in &polygon.space {
            writeln!(text, "v {x} {y} {z}").expect("a string takes it");
        }
        text.push('f');
        for k in 0..polygon.space.len() {
            write!(text, " {}", first + k).expect("a string takes it");
        }
        text.push('\n');
        first += polygon.space.len();
    }
    Upload::single("polygons.obj", text.into_bytes())
}

fn unwrapped(upload: &Upload, format: OutputFormat) -> Outcome {
    let options = Options {
        format,
        cutting: Cutting {
            cut: Cut::Disk,
            ..Cutting::default()
        },
        ..Options::default()
    };
    unwrap_document(upload, &options, &Unobserved).expect("a result")
}

fn area(polygon: &SimplePolygon) -> f64 {
    doubled_area(&polygon.plane) / 2.0 * polygon.scale * polygon.scale
}

#[test]
fn a_thousand_polygons_keep_their_areas() {
    let mut random = Random::new(8);
    let polygons: Vec<_> = (0..1000)
        .map(|k| simple_polygon(3 + k % 198, &mut random))
        .collect();
    let total: f64 = polygons.iter().map(area).sum();
    let outcome = unwrapped(&file_of(&polygons), OutputFormat::Obj);
    assert!(outcome.report.proven.bijective);
    let measured = outcome.report.groups[0].measures.size.area_3d;
    assert!(
        (measured / total - 1.0).abs() < 1e-9,
        "{measured} is not {total}"
    );

    let written = obj::read(&outcome.files[0].1).expect("an OBJ file");
    let uvs: Vec<Vec<[f64; 2]>> = written
        .polygons()
        .map(|corners| {
            corners
                .iter()
                .map(|c| written.texcoords[c.texcoord.expect("a UV") as usize])
                .collect()
        })
        .collect();
    assert_eq!(uvs.len(), polygons.len(), "no polygon was cut");
    let total_uv: f64 = uvs.iter().map(|uvs| doubled_area(uvs) / 2.0).sum();
    let scale = (total_uv / total).sqrt();
    for (number, (polygon, uvs)) in polygons.iter().zip(&uvs).enumerate() {
        let ratio = doubled_area(uvs) / 2.0 / area(polygon) / scale / scale;
        assert!((ratio - 1.0).abs() < 1e-3, "polygon {number}: area {ratio}");
        let sides = side_lengths(&polygon.plane).zip(side_lengths(uvs));
        for (side, in_uvs) in sides {
            let wanted = side * polygon.scale * scale;
            let difference = (in_uvs - wanted).abs();
            assert!(
                difference < 0.005 * wanted + 8.0 * GRID,
                "polygon {number}: a side of {wanted} is {in_uvs} long"
            );
        }
    }
}

/// UVs are multiples of this; ends of sides move by some, so that no triangle flips.
const GRID: f64 = 1.0 / (1 << 23) as f64;

/// The lengths of a polygon's sides.
fn side_lengths(corners: &[[f64; 2]]) -> impl Iterator<Item = f64> {
    let after = corners.iter().cycle().skip(1);
    let sides = corners.iter().zip(after);
    sides.map(|(p, q)| (q[0] - p[0]).hypot(q[1] - p[1]))
}

#[test]
fn a_gltf_has_the_area_of_the_polygons() {
    let mut random = Random::new(9);
    let polygons: Vec<_> = (0..20)
        .map(|k| simple_polygon(4 + 7 * k, &mut random))
        .collect();
    let total: f64 = polygons.iter().map(area).sum();
    let outcome = unwrapped(&file_of(&polygons), OutputFormat::Glb);
    let (name, bytes) = outcome.files[0].clone();
    let document = Document::read(&Upload::single(name, bytes)).expect("a glTF file");
    let n_triangles: usize = polygons.iter().map(|polygon| polygon.plane.len() - 2).sum();
    assert_eq!(document.primitives()[0].triangles.len(), n_triangles);
    let measured = outcome.report.groups[0].measures.size.area_3d;
    assert!(
        (measured / total - 1.0).abs() < 1e-9,
        "{measured} is not {total}"
    );
}

/// A cylinder with its caps as one polygon each, an L, a quad of which one corner is given twice.
#[test]
fn a_modelers_file_keeps_its_polygons_and_all_else() {
    let mut text = "mtllib scene.mtl\no Cap\n".to_owned();
    let n = 12;
    for z in [0, 1] {
        for k in 0..n {
            let (sin, cos) =
                ((f64::from(k) + 0.5) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            writeln!(text, "v {cos:.6} {sin:.6} {z}.000000").expect("a string takes it");
        }
    }
    text += "vn 0 0 -1\nvn 0 0 1\nvn 1 0 0\ns 1\nusemtl side\n";
    for k in 1..=n {
        let next = k % n + 1;
        writeln!(text, "f {k}//3 {next}//3 {}//3 {}//3", next + n, k + n)
            .expect("a string takes it");
    }
    text += "s off\nusemtl caps\nf";
    for k in (1..=n).rev() {
        write!(text, " {k}//1").expect("a string takes it");
    }
    text += "\nf";
    for k in 1..=n {
        write!(text, " {}//2", k + n).expect("a string takes it");
    }
    text += "\no L\nv 5 1 0\nv 3 1 0\nv 3 2 0\nv 2 2 0\nv 2 0 0\nv 5 0 0\nf -6//2 -5//2 -4//2 -3//2 -2//2 -1//2\n\
        v 7 0 0\nv 8 0 0\nv 8 1 0\nf -3 -2 -1 -1\n";
    let upload = Upload::single("scene.obj", text.clone().into_bytes());
    let options = Options {
        format: OutputFormat::Obj,
        ..Options::default()
    };
    let outcome = unwrap_document(&upload, &options, &Unobserved).expect("a result");
    assert!(outcome.report.certified);
    let sizes = |bytes: &[u8]| -> Vec<usize> {
        let file = obj::read(bytes).expect("an OBJ file");
        file.polygons().map(<[_]>::len).collect()
    };
    let [before, after] = [text.as_bytes(), &outcome.files[0].1].map(sizes);
    // Only where a seam runs through them are polygons in pieces.
    let n_triangles = |sizes: &[usize]| sizes.iter().map(|n| n - 2).sum::<usize>();
    assert_eq!(n_triangles(&after), n_triangles(&before));
    assert!(after.len() < n_triangles(&before), "{before:?} {after:?}");
    let written = String::from_utf8(outcome.files[0].1.clone()).expect("text");
    let kept = |text: &str| -> Vec<String> {
        let is_kept = |line: &&str| {
            !["f ", "vt ", "# unwrapd "]
                .iter()
                .any(|start| line.starts_with(start))
        };
        text.lines().filter(is_kept).map(str::to_owned).collect()
    };
    assert_eq!(
        kept(&written),
        kept(&text),
        "vertices, normals, groups and materials"
    );
}
