//! Readers of OBJ, OFF, PLY and STL: what they read, what they refuse, and that no byte makes them panic.
use crate::places;
use std::path::Path;
use unwrapd_files::io::{
    Content, Format, IndexedTriangles, ReadError, detect, format_of_content, obj, off, ply, stl,
};

type Reader = fn(&[u8]) -> Result<IndexedTriangles, ReadError>;

fn read_obj(bytes: &[u8]) -> Result<IndexedTriangles, ReadError> {
    obj::read(bytes).map(|o| o.mesh)
}

fn code(result: Result<IndexedTriangles, ReadError>) -> &'static str {
    result.map_or_else(|e| e.code(), |_| "read")
}

fn ply_binary(big: bool, counts: (u32, u32)) -> Vec<u8> {
    let encoding = if big { "big" } else { "little" };
    let (n_vertices, n_faces) = counts;
    let mut bytes = format!(
        "ply\nformat binary_{encoding}_endian 1.0\ncomment caf\u{e9}\nelement vertex {n_vertices}\n\
         property double x\nproperty uchar red\nproperty float y\nproperty short z\n\
         element face {n_faces}\nproperty list uchar float st\nproperty list uchar uint vertex_index\nend_header\n"
    )
    .into_bytes();
    let mut push = |le: &[u8]| {
        let mut le = le.to_vec();
        if big {
            le.reverse();
        }
        bytes.extend(le);
    };
    for (x, y, z) in [(0.5, 0.0, 0), (1.0, 0.0, -2), (1.0, 1.0, 3), (0.0, 1.0, 0)] {
        push(&f64::to_le_bytes(x));
        push(&[200]);
        push(&f32::to_le_bytes(y));
        push(&i16::to_le_bytes(z));
    }
    push(&[2]);
    push(&7f32.to_le_bytes());
    push(&8f32.to_le_bytes());
    push(&[4]);
    for i in [0u32, 1, 2, 3] {
        push(&i.to_le_bytes());
    }
    bytes
}

const PLY_TEXT: &str = "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\n\
    element vertex 4\r\nproperty float x\r\nproperty float y\r\nproperty float z\r\nproperty float nx\r\nend_header\r\n\
    4 0 1 2 3\r\n0.5 0 0 nan\r\n1. .0 -2 0\r\n1 1 3e0 0\r\n-0 1 0 0\r\n";

const OFF_TEXT: &str = "COFF # colors\n\n4 1 0\n0.5 0 0 255 0 0 255\n1 0 -2 0 0 0 0\n# between\n1 1 3 0 0 0 0\n\
    -0.0 1 0 0 0 0 0\n4 0 1 2 3 0.5 0.5 0.5\n";

const STL_TEXT: &str = "solid\nfacet normal nan nan nan\n outer loop\n  vertex 0.5 0 0\n  vertex 1 0 -2\n  vertex 1 1 3\n endloop\n\
    endfacet\nendsolid\nsolid second one\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0.5 0 0\nVERTEX 1 1 3\nVERTEX -0 1 0\nENDLOOP\n\
    ENDFACET\nendsolid second one\n";

const OBJ_TEXT: &str = "# a square\nmtllib a.mtl\no first\nv 0.5 0 0 0.1 0.2 nan\nv 1 0 -2\nvt 0 0\nvt 1\nvn 0 0 1\n\
    v 1 1 \\\n 3\nv -0 1 0\nf 1/1/1 2/2/1 -2//-1 -1 # comment\nl 1 2\nf 1 2\n";

fn stl_binary() -> Vec<u8> {
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(2u32.to_le_bytes());
    for facet in [
        [[0.5, 0.0, 0.0], [1.0, 0.0, -2.0], [1.0, 1.0, 3.0]],
        [[0.5, 0.0, 0.0], [1.0, 1.0, 3.0], [-0.0, 1.0, 0.0]],
    ] {
        bytes.extend([0; 12]);
        bytes.extend(facet.iter().flatten().flat_map(|x: &f32| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

/// One square of two triangles in every format and encoding.
fn squares() -> Vec<(&'static str, Reader, Vec<u8>)> {
    vec![
        ("a.obj", read_obj, OBJ_TEXT.into()),
        ("a.off", off::read, OFF_TEXT.into()),
        ("text.ply", ply::read, PLY_TEXT.into()),
        ("little.ply", ply::read, ply_binary(false, (4, 1))),
        ("big.ply", ply::read, ply_binary(true, (4, 1))),
        ("text.stl", stl::read, STL_TEXT.into()),
        ("binary.stl", stl::read, stl_binary()),
    ]
}

#[test]
fn every_format_gives_the_same_square() {
    let positions = vec![
        [0.5, 0.0, 0.0],
        [1.0, 0.0, -2.0],
        [1.0, 1.0, 3.0],
        [0.0, 1.0, 0.0],
    ];
    for (name, read, bytes) in squares() {
        let mesh = read(&bytes).expect(name);
        assert_eq!(mesh.positions, positions, "{name}");
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]], "{name}");
        assert!(
            mesh.positions
                .iter()
                .flatten()
                .all(|x| !x.is_sign_negative() || *x < 0.0),
            "{name}: −0"
        );
    }
}

/// An L whose first corner does not see all of it.
const L: [[f32; 2]; 6] = [
    [3.0, 1.0],
    [1.0, 1.0],
    [1.0, 2.0],
    [0.0, 2.0],
    [0.0, 0.0],
    [3.0, 0.0],
];

#[test]
fn every_format_fills_a_concave_polygon() {
    let lines = |prefix: &str| -> String {
        let lines = L.map(|[x, y]| format!("{prefix}{x} {y} 0.5\n"));
        lines.concat()
    };
    let obj = format!("{}f 1 2 3 4 5 6\n", lines("v "));
    let off = format!("OFF\n6 1 0\n{}6 0 1 2 3 4 5\n", lines(""));
    let ply = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 6\n\
        property float x\nproperty float y\nproperty float z\nend_header\n6 0 1 2 3 4 5\n";
    let ply = ply.to_owned() + &lines("");
    let stl = format!(
        "solid\nfacet normal 0 0 1\nouter loop\n{}endloop\nendfacet\nendsolid\n",
        lines("vertex ")
    );
    let files: [(&str, Reader, String); 4] = [
        ("obj", read_obj, obj),
        ("off", off::read, off),
        ("ply", ply::read, ply),
        ("stl", stl::read, stl),
    ];
    for (name, read, text) in files {
        let mesh = read(text.as_bytes()).expect(name);
        assert_eq!(mesh.triangles.len(), 4, "{name}");
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        };
        let areas: Vec<f32> = mesh.triangles.iter().map(area).collect();
        assert!(areas.iter().all(|&area| area > 0.0), "{name}: {areas:?}");
        assert_eq!(areas.iter().sum::<f32>(), 4.0, "{name}");
        assert_eq!(mesh.fanned.n_polygons, 0, "{name}");
    }
}

fn detected(name: &str, bytes: &[u8]) -> Option<Format> {
    detect(name, bytes, Content::Surface)
}

#[test]
fn formats_are_told_by_content_then_by_name() {
    for (name, _, bytes) in squares() {
        let expected = match &name[name.len() - 3..] {
            "obj" => Format::Obj,
            "off" => Format::Off,
            "ply" => Format::Ply,
            _ => Format::Stl,
        };
        assert_eq!(detected(name, &bytes), Some(expected), "{name}");
        assert_eq!(
            detected("upload", &bytes),
            Some(expected),
            "{name} without its name"
        );
    }
    assert_eq!(detected("a.OFF", b"3 1 0\n"), Some(Format::Off));
    assert_eq!(detected("a.png", b"\x89PNG\r\n\x1a\n"), None);
    assert_eq!(detected("", b""), None);
}

#[test]
fn content_is_told_apart_by_what_it_is_read_for() {
    use Content::{Body, Picture, Problem, Surface, Texture};
    let png: &[u8] = b"\x89PNG\r\n\x1a\n";
    let jpeg: &[u8] = b"\xFF\xD8\xFF\xE0";
    let webp: &[u8] = b"RIFF\x04\0\0\0WEBP";
    let ktx2: &[u8] = b"\xABKTX 20\xBB\r\n\x1A\n";
    let drawing: &[u8] = b"\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<svg/>";
    for (bytes, content, expected) in [
        (&b" {}"[..], Surface, Some(Format::Gltf)),
        (b" {}", Problem, Some(Format::Json)),
        (b" {}", Picture, None),
        (png, Body, Some(Format::Png)),
        (png, Picture, Some(Format::Png)),
        (png, Surface, None),
        (jpeg, Body, None),
        (jpeg, Picture, Some(Format::Jpeg)),
        (webp, Texture, Some(Format::Webp)),
        (webp, Picture, Some(Format::Webp)),
        (ktx2, Texture, Some(Format::Ktx2)),
        (ktx2, Picture, None),
        (drawing, Body, Some(Format::Svg)),
        (b"<html>", Body, None),
        (b"12 4\n0 0 0\n", Body, Some(Format::Tet)),
        (b"12 4\n0 0 0\n", Surface, None),
        (b"# a comment\nOFF\n", Surface, Some(Format::Off)),
        (b"solid words", Surface, None),
    ] {
        let found = format_of_content(bytes, bytes.len() as u64, content);
        assert_eq!(found, expected, "{content:?}: {}", bytes.escape_ascii());
    }
}

#[test]
fn a_name_outdoes_text_that_only_resembles_a_format() {
    assert_eq!(detected("a.stl", b"v 0 0 0\n"), Some(Format::Stl));
    assert_eq!(detected("a.glb", b"ply\n"), Some(Format::Ply));
    assert_eq!(detected("a.JPEG", b""), None);
    assert_eq!(Format::of_name("b.c/a.JPEG"), Some(Format::Jpeg));
    assert_eq!(Format::of_name("b.png/a"), None);
}

#[test]
fn obj_keeps_polygons_and_corners() {
    let obj = obj::read(OBJ_TEXT.as_bytes()).unwrap();
    let polygons: Vec<usize> = obj.polygons().map(<[_]>::len).collect();
    assert_eq!(polygons, [4, 2]);
    assert_eq!(
        obj.corners[1],
        obj::Corner {
            vertex: 1,
            texcoord: Some(1),
            normal: Some(0)
        }
    );
    assert_eq!(
        obj.corners[2],
        obj::Corner {
            vertex: 2,
            texcoord: None,
            normal: Some(0)
        }
    );
    assert_eq!(obj.texcoords, [[0.0, 0.0], [1.0, 0.0]]);
    let joined: Vec<u8> = obj::statements(OBJ_TEXT.as_bytes())
        .flat_map(|s| s.raw.to_vec())
        .collect();
    assert_eq!(joined, OBJ_TEXT.as_bytes());
}

#[test]
fn a_vertex_that_no_face_uses_may_hold_anything() {
    let texts: [(Reader, &str); 3] = [
        (
            read_obj,
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan inf 1e39\nf 1 2 3\n",
        ),
        (
            off::read,
            "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\nnan inf 1e39\n3 0 1 2\n",
        ),
        (
            ply::read,
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
             property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\nnan inf 1e39\n3 0 1 2\n",
        ),
    ];
    for (read, text) in texts {
        let mesh = read(text.as_bytes()).expect("a triangle");
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
    }
}

#[test]
fn bytes_after_a_binary_stl_are_ignored_by_whoever_reads_it() {
    let mut bytes = stl_binary();
    let mesh = stl::read(&bytes).expect("a square");
    bytes.extend([7; 82]);
    assert_eq!(detected("upload", &bytes), Some(Format::Stl));
    assert_eq!(stl::read(&bytes), Ok(mesh));
}

#[test]
fn bad_files_are_refused_with_their_code() {
    let cases: [(&str, Reader, &str); 23] = [
        ("v 0 0 nan\nf 1 1 1\n", read_obj, "non_finite_position"),
        ("v 0 0 1e39\nf 1 1 1\n", read_obj, "non_finite_position"),
        ("v 0 0\n", read_obj, "invalid_mesh"),
        ("v 0 0 0\nf 1 1 x\n", read_obj, "invalid_mesh"),
        ("v 0 0 0\nf 1/1/1/1 1 1\n", read_obj, "invalid_mesh"),
        ("v 0 0 0\nf 1 1 2\n", read_obj, "index_out_of_range"),
        ("v 0 0 0\nf 0 1 1\n", read_obj, "index_out_of_range"),
        ("v 0 0 0\nf -2 1 1\n", read_obj, "index_out_of_range"),
        (
            "v 0 0 0\nf -9223372036854775808 1 1\n",
            read_obj,
            "index_out_of_range",
        ),
        (
            "v 0 0 0\nf 9223372036854775807 1 1\n",
            read_obj,
            "index_out_of_range",
        ),
        ("", off::read, "invalid_mesh"),
        ("OFF\n1 0\n", off::read, "invalid_mesh"),
        ("4OFF\n1 0 0\n0 0 0 1\n", off::read, "invalid_mesh"),
        (
            "OFF\n1 1 0\n0 0 inf\n3 0 0 0\n",
            off::read,
            "non_finite_position",
        ),
        (
            "OFF\n1 1 0\n0 0 0\n3 0 0 1\n",
            off::read,
            "index_out_of_range",
        ),
        (
            "OFF\n1 1 0\n0 0 0\n99999999999 0 0 0\n",
            off::read,
            "invalid_mesh",
        ),
        ("ply\nformat ascii 1.0\n", ply::read, "invalid_mesh"),
        (
            "ply\nformat ascii 1.0\nelement vertex 9999999999999\nend_header\n",
            ply::read,
            "invalid_mesh",
        ),
        (
            "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\nend_header\n3 0 0 0",
            ply::read,
            "index_out_of_range",
        ),
        (
            "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\nend_header\n-3 0 0 0",
            ply::read,
            "invalid_mesh",
        ),
        (
            "solid a\nfacet\nvertex 0 0 0\nvertex 0 0 1\nendfacet",
            stl::read,
            "invalid_mesh",
        ),
        (
            "solid a\nfacet\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 1",
            stl::read,
            "invalid_mesh",
        ),
        ("neither text nor long enough", stl::read, "invalid_mesh"),
    ];
    for (text, read, expected) in cases {
        assert_eq!(code(read(text.as_bytes())), expected, "{text}");
    }
}

#[test]
fn false_counts_end_with_the_file() {
    let mut claims = stl_binary();
    claims[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    claims[..5].copy_from_slice(b"     ");
    assert_eq!(code(stl::read(&claims)), "invalid_mesh");
    assert_eq!(
        code(ply::read(&ply_binary(false, (u32::MAX, 1)))),
        "invalid_mesh"
    );
    assert_eq!(
        code(ply::read(&ply_binary(false, (4, u32::MAX)))),
        "invalid_mesh"
    );
    let endless =
        "ply\nformat binary_little_endian 1.0\nelement nothing 18446744073709551615\nend_header\n";
    assert_eq!(
        ply::read(endless.as_bytes()),
        Ok(IndexedTriangles::default())
    );
    assert_eq!(
        code(off::read(
            b"OFF\n18446744073709551615 18446744073709551615 0\n0 0 0\n"
        )),
        "invalid_mesh"
    );
}

#[test]
fn mutated_files_never_panic() {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let mut random = move |n: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % n as u64) as usize
    };
    let interesting = b"0123456789-+.eE/#\\ \n\r\t\0\xffnfvl";
    let mut refused = 0;
    for (name, read, bytes) in squares() {
        for _ in 0..4000 {
            let mut mutant = bytes.clone();
            for _ in 0..=random(4) {
                let at = random(mutant.len());
                match random(4) {
                    0 => mutant[at] ^= 1 << random(8),
                    1 => mutant[at] = interesting[random(interesting.len())],
                    2 => mutant.insert(at, interesting[random(interesting.len())]),
                    _ => mutant.truncate(at.max(1)),
                }
            }
            match read(&mutant) {
                Ok(mesh) => assert!(
                    mesh.triangles
                        .iter()
                        .flatten()
                        .all(|&i| (i as usize) < mesh.positions.len())
                        && (mesh.triangles.iter().flatten())
                            .all(|&i| mesh.positions[i as usize].iter().all(|x| x.is_finite())),
                    "{name}"
                ),
                Err(_) => refused += 1,
            }
            detected(name, &mutant);
        }
    }
    assert!(refused > 1000, "the mutations were harmless");
}

#[test]
fn known_files_have_their_known_sizes() {
    let files: [(&str, Reader, usize, usize); 3] = [
        ("spot.ply", ply::read, 2930, 5856),
        ("cat_head.obj", read_obj, 131, 248),
        ("moebius.obj", read_obj, 280, 448),
    ];
    for (file, read, n_vertices, n_triangles) in files {
        assert_sizes(&places::asset(file), read, n_vertices, n_triangles);
    }
}

fn assert_sizes(file: &Path, read: Reader, n_vertices: usize, n_triangles: usize) {
    let mesh = read(&std::fs::read(file).expect("a file")).expect("a mesh");
    let sizes = (mesh.positions.len(), mesh.triangles.len());
    assert_eq!(sizes, (n_vertices, n_triangles), "{}", file.display());
}

#[test]
fn odd_obj_texts() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    for (rest, expected) in [
        ("f 1 2 12 3", "index_out_of_range"),
        ("f 0 1 2", "index_out_of_range"),
        ("v 0.5 0.5 0.5 nan nan nan\nf 1 2 5", "read"),
        (
            "mtllib a.mtl\nusemtl b\ns 1\nf 1// 2//\nf 1// 2// 3//",
            "read",
        ),
    ] {
        let text = format!("{vertices}{rest}\n");
        assert_eq!(code(read_obj(text.as_bytes())), expected, "{rest}");
    }
}

mod shared {
    use super::{Reader, assert_sizes, code, off, places, ply, read_obj, stl};

    #[test]
    #[ignore = "needs ../shared"]
    fn known_files_have_their_known_sizes() {
        let files: [(&str, Reader, usize, usize); 9] = [
            ("closed/cave_595k.ply", ply::read, 297_679, 595_410),
            ("disk/bimba_357k_midpoint.ply", ply::read, 178_806, 356_860),
            ("closed/rangemap_121k.ply", ply::read, 62_702, 120_995),
            ("closed/spot.ply", ply::read, 2930, 5856),
            ("closed/1002_tray_bottom.STL", stl::read, 2216, 4520),
            ("closed/fandisk.off", off::read, 7229, 14_454),
            ("disk/camelhead.off", off::read, 11_381, 22_704),
            ("closed/sword-quad-dominant.obj", read_obj, 22_293, 44_582),
            ("closed/stanford_bunny_69k.obj", read_obj, 35_947, 69_451),
        ];
        let folder = places::shared("data");
        for (file, read, n_vertices, n_triangles) in files {
            assert_sizes(&folder.join(file), read, n_vertices, n_triangles);
        }
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn hostile_text_meshes() {
        let files: [(&str, Reader, &str); 4] = [
            ("malformed.obj", read_obj, "index_out_of_range"),
            ("nancolor.obj", read_obj, "read"),
            ("notenoughindices.obj", read_obj, "read"),
            ("OutOfMemory.off", off::read, "invalid_mesh"),
        ];
        let folder = places::shared("data/invalid/mesh_text");
        for (file, read, expected) in files {
            let bytes = std::fs::read(folder.join(file)).expect("a file");
            assert_eq!(code(read(&bytes)), expected, "{file}");
        }
    }
}
