//! OBJ written back, and new glTF and OBJ files for what came without a document.
use crate::simple_polygons::simple_polygon;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use unwrapd_files::document::{
    Document, GroupBy, Layout, NewUvs, OutputFormat, Primitive, Upload, WriteOptions, Written,
};
use unwrapd_files::io::obj;
use unwrapd_files::polygon::smallest_first;
use unwrapd_maps::mesh::VAxis;
use unwrapd_method::numerics::random::Random;

type GridFaces = Vec<[[i32; 2]; 3]>;

const BITS: u32 = 23;

fn read(name: &str, text: &str) -> Document {
    Document::read(&Upload::single(name, text.as_bytes().to_vec())).unwrap()
}

fn options(format: OutputFormat) -> WriteOptions {
    WriteOptions {
        format,
        stem: "out".to_owned(),
        texcoord: None,
        overwrite: false,
        terms: None,
    }
}

/// A UV for each vertex, the same in all its faces.
fn per_vertex(primitive: &Primitive) -> GridFaces {
    let uv = |vertex: u32| [1 + 3 * vertex as i32, (1 << BITS) - 7 * vertex as i32];
    primitive
        .triangles
        .iter()
        .map(|face| face.map(uv))
        .collect()
}

/// A UV for each corner, none shared.
fn per_corner(primitive: &Primitive) -> GridFaces {
    (0..primitive.triangles.len() as i32)
        .map(|face| [0, 1, 2].map(|corner| [3 * face + corner, 5 * face + 100]))
        .collect()
}

fn new_uvs(faces: &GridFaces) -> NewUvs {
    let unit = |i: i32| i as f32 / (1_u32 << BITS) as f32;
    let faces = faces.iter().map(|face| face.map(|uv| uv.map(unit)));
    NewUvs {
        layout: Layout::New,
        v_axis: VAxis::Up,
        corners: vec![Some(faces.collect())],
    }
}

fn write(document: &Document, faces: &GridFaces, format: OutputFormat) -> Written {
    let uvs = new_uvs(faces);
    document.write(&uvs, &options(format)).unwrap()
}

fn text(written: &Written) -> String {
    String::from_utf8(written.files[0].1.clone()).unwrap()
}

fn as_numbers(faces: &GridFaces, v_axis: VAxis) -> Vec<[[f64; 2]; 3]> {
    let number = |i: i32| f64::from(i) / f64::from(1 << BITS);
    let uv = |[i, j]: [i32; 2]| match v_axis {
        VAxis::Up => [number(i), number(j)],
        VAxis::Down => [number(i), number((1 << BITS) - j)],
    };
    faces.iter().map(|face| face.map(uv)).collect()
}

const SCENE: &str = "# made by hand\nmtllib a.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0.5 0.5\n\
    vn 0 0 1\ng top\nusemtl red\ns off\nf 1/1/1 2/1/1 3/1/1 4/1/1 # a quad\n\nv 0.1 0 1\nv 1 0 1.00000000000001\nv -0 1 1\n\
    g bottom\nf -3/1 -2/1 -1/1\nl 1/1 2/1\np 1\n";

#[test]
fn obj_keeps_all_but_its_texture_coordinates() {
    let document = read("scene.obj", SCENE);
    let faces = per_vertex(&document.primitives()[0]);
    let written = write(&document, &faces, OutputFormat::Obj);
    let expected = "# made by hand\nmtllib a.mtl\no thing\nv 0 0 0 1 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n\
        vn 0 0 1\ng top\nusemtl red\ns off\n\
        vt 0.00000011920928955078125 1\nvt 0.000000476837158203125 0.9999991655349731\n\
        vt 0.0000008344650268554688 0.9999983310699463\nvt 0.0000011920928955078125 0.9999974966049194\n\
        vt 0.0000015497207641601563 0.9999966621398926\nvt 0.0000019073486328125 0.9999958276748657\n\
        vt 0.0000022649765014648438 0.9999949932098389\n\
        # a quad\nf 1/1/1 2/2/1 3/3/1 4/4/1\n\nv 0.1 0 1\nv 1 0 1\nv 0 1 1\n\
        g bottom\nf 5/5 6/6 7/7\nl 1 2\np 1\n";
    assert_eq!(text(&written), expected);
    let note = &written.notes.primitives[0];
    assert!(note.replaced && note.vertices_before == 7 && note.vertices_after == 7);
    let codes = written.notes.warnings.iter().map(|w| w.code.as_ref());
    assert!(codes.eq(["material_files_missing", "uvs_replaced"]));
}

#[test]
fn obj_uvs_come_back_exactly() {
    let document = read("scene.obj", SCENE);
    for faces in [
        per_vertex(&document.primitives()[0]),
        per_corner(&document.primitives()[0]),
    ] {
        let written = write(&document, &faces, OutputFormat::Obj);
        let again = read("out.obj", &text(&written));
        assert_eq!(again.primitives(), document.primitives());
        assert_eq!(
            again.corner_uvs(0, 0).unwrap(),
            Some(as_numbers(&faces, again.v_axis()))
        );
        assert_eq!(again.corner_uvs(0, 1).unwrap(), None);
    }
}

#[test]
fn polygons_are_split_only_where_their_uvs_differ() {
    let pentagon = "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 3 0\nv 0 1 0\nf 1 2 3 4 5\n";
    let document = read("a.obj", pentagon);
    let mut faces = per_vertex(&document.primitives()[0]);
    let polygons = |faces: &GridFaces| {
        let written = write(&document, faces, OutputFormat::Obj);
        let obj = obj::read(&written.files[0].1).unwrap();
        let sizes: Vec<usize> = obj.polygons().map(<[_]>::len).collect();
        let mut triangles: Vec<_> = obj.mesh.triangles.into_iter().map(smallest_first).collect();
        triangles.sort_unstable();
        assert_eq!(triangles, document.primitives()[0].triangles);
        (sizes, written.notes.warnings.len())
    };
    assert_eq!(polygons(&faces), (vec![5], 0));
    faces[2][0] = [500, 500];
    assert_eq!(polygons(&faces), (vec![4, 3], 1));
    faces[1][0] = [400, 400];
    assert_eq!(polygons(&faces), (vec![3, 3, 3], 1));
}

/// The triangles of a document with their UVs, in any order.
fn mapped(document: &Document) -> Vec<([u32; 3], [[u64; 2]; 3])> {
    let uvs = document.corner_uvs(0, 0).unwrap().unwrap();
    let triangles = document.primitives()[0].triangles.iter().zip(uvs);
    let mut mapped: Vec<_> = triangles
        .map(|(&triangle, uvs)| {
            let first = smallest_first(triangle)[0];
            let shift = triangle.iter().position(|&v| v == first).unwrap();
            let (mut triangle, mut uvs) = (triangle, uvs.map(|uv| uv.map(f64::to_bits)));
            triangle.rotate_left(shift);
            uvs.rotate_left(shift);
            (triangle, uvs)
        })
        .collect();
    mapped.sort_unstable();
    mapped
}

#[test]
fn cut_polygons_come_back_with_the_same_triangles_and_uvs() {
    let mut random = Random::new(17);
    for number in 0..100 {
        let polygon = simple_polygon(4 + number % 40, &mut random);
        let mut file = String::new();
        for [x, y, z] in &polygon.space {
            writeln!(file, "v {x} {y} {z}").unwrap();
        }
        let corners: Vec<String> = (1..=polygon.space.len()).map(|v| v.to_string()).collect();
        writeln!(file, "f {}", corners.join(" ")).unwrap();
        let document = read("a.obj", &file);
        let mut faces = per_vertex(&document.primitives()[0]);
        // As many charts as chance makes: triangles of another one have other UVs.
        let n_charts = 1 + number as i32 % 4;
        for face in &mut faces {
            let chart = random.below(n_charts as usize) as i32;
            *face = face.map(|[i, j]| [i + 1000 * chart, j]);
        }
        let written = write(&document, &faces, OutputFormat::Obj);
        let again = read("out.obj", &text(&written));
        let uvs = as_numbers(&faces, again.v_axis());
        let n_faces = text(&written)
            .lines()
            .filter(|line| line.starts_with("f "))
            .count();
        assert!(n_charts > 1 || n_faces == 1, "polygon {number} is whole");
        let triangles = document.primitives()[0].triangles.iter().copied();
        let expected = triangles
            .zip(uvs)
            .map(|(t, uvs)| (t, uvs.map(|uv| uv.map(f64::to_bits))));
        let mut expected: Vec<_> = expected.collect();
        expected.sort_unstable();
        assert_eq!(mapped(&again), expected, "polygon {number}");
    }
}

#[test]
fn odd_lines_survive() {
    let odd = "v\t0 0 0\r\n  v 1 0 0\r\nv 0 \\\r\n 1 0\r\n# C:\\\r\nfo 1 2 3\r\nf 1 2\r\nf\r\nvp 0 1\r\nf 3 2 1";
    let document = read("odd.obj", odd);
    let faces = per_vertex(&document.primitives()[0]);
    let written = text(&write(&document, &faces, OutputFormat::Obj));
    let lines: Vec<&str> = written
        .split("\r\n")
        .filter(|line| !line.starts_with("vt "))
        .collect();
    let expected = [
        "v 0 0 0",
        "v 1 0 0",
        "v 0 1 0",
        "# C:\\",
        "f 1/1 2/2 3/3",
        "f 1 2",
        "f",
        "vp 0 1",
        "f 3/3 2/2 1/1",
        "",
    ];
    assert_eq!(lines, expected);
}

#[test]
fn positions_that_are_one_are_written_as_one() {
    let close = "v 0.1 0 0\nv 0.10000000001 0 0\nv 1e-1 0 16777217\nv 0 1 0\nf 1 3 4\nf 2 3 4\n";
    let document = read("a.obj", close);
    let faces = per_vertex(&document.primitives()[0]);
    let written = text(&write(&document, &faces, OutputFormat::Obj));
    let positions: Vec<&str> = written
        .lines()
        .filter(|line| line.starts_with("v "))
        .collect();
    assert_eq!(
        positions,
        ["v 0.1 0 0", "v 0.1 0 0", "v 1e-1 0 16777216", "v 0 1 0"]
    );
}

#[test]
fn material_files_come_along() {
    let mut upload = Upload::single("scene.obj", SCENE.as_bytes().to_vec());
    upload.resources = BTreeMap::from([
        ("a.mtl".to_owned(), b"newmtl red\n".to_vec()),
        ("b.mtl".to_owned(), b"newmtl blue\n".to_vec()),
    ]);
    let document = Document::read(&upload).unwrap();
    let faces = per_vertex(&document.primitives()[0]);
    let written = write(&document, &faces, OutputFormat::Obj);
    let names: Vec<&str> = written.files.iter().map(|file| file.0.as_str()).collect();
    assert_eq!(names, ["out.obj", "a.mtl"]);
}

#[test]
fn obj_has_one_uv_set_and_one_group() {
    let document = read("scene.obj", SCENE);
    let faces = per_vertex(&document.primitives()[0]);
    let uvs = new_uvs(&faces);
    let mut options = options(OutputFormat::Obj);
    options.texcoord = Some(1);
    assert_eq!(
        document.write(&uvs, &options).unwrap_err().code(),
        "unsupported_output"
    );
    for by in [
        GroupBy::Mesh,
        GroupBy::Scene,
        GroupBy::Material,
        GroupBy::Primitive,
    ] {
        let groups = document.groups(by);
        assert_eq!((groups.len(), groups[0].name.as_str()), (1, "scene"));
    }
}

#[test]
fn files_without_triangles_are_told_so() {
    let empty = [
        ("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n"),
        ("a.off", "OFF\n1 0 0\n0 0 0\n"),
        (
            "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n",
        ),
        ("a.stl", "solid\nendsolid\n"),
    ];
    for (name, text) in empty {
        let read = Document::read(&Upload::single(name, text.as_bytes().to_vec()));
        assert_eq!(read.err().map(|e| e.code()), Some("no_triangles"), "{name}");
    }
}

const OFF: &str = "OFF\n5 1 0\n0 0 0\n1 0 0.1\n1 1 0\n0 1 0\n9 9 9\n4 0 1 2 3\n";

#[test]
fn new_gltf_holds_the_same_surface() {
    let document = read("a.off", OFF);
    for format in [OutputFormat::Glb, OutputFormat::Gltf] {
        for faces in [
            per_vertex(&document.primitives()[0]),
            per_corner(&document.primitives()[0]),
        ] {
            let written = write(&document, &faces, format);
            assert_eq!(written.files, write(&document, &faces, format).files);
            let again = Document::read(&Upload {
                name: written.files[0].0.clone(),
                bytes: written.files[0].1.clone(),
                resources: written.files[1..].iter().cloned().collect(),
            })
            .unwrap();
            let (old, new) = (&document.primitives()[0], &again.primitives()[0]);
            let corners = |p: &Primitive| -> Vec<_> {
                p.triangles
                    .iter()
                    .flatten()
                    .map(|&v| p.positions[v as usize])
                    .collect()
            };
            assert_eq!(corners(old), corners(new));
            assert_eq!(
                again.corner_uvs(0, 0).unwrap(),
                Some(as_numbers(&faces, again.v_axis()))
            );
            let json = String::from_utf8_lossy(&written.files[0].1);
            assert!(json.contains("unwrapd"));
            assert_eq!(
                written.files[0].0,
                if format == OutputFormat::Glb {
                    "out.glb"
                } else {
                    "out.gltf"
                }
            );
        }
    }
}

#[test]
fn new_obj_holds_the_same_surface() {
    let document = read("a.off", OFF);
    let faces = per_corner(&document.primitives()[0]);
    let written = write(&document, &faces, OutputFormat::Obj);
    let again = read("out.obj", &text(&written));
    assert_eq!(again.primitives(), document.primitives());
    assert_eq!(
        again.corner_uvs(0, 0).unwrap(),
        Some(as_numbers(&faces, VAxis::Up))
    );
    assert!(text(&written).contains("\no mesh0\nf 1/1 2/2 3/3\nf 1/4 3/5 4/6\n"));
}

#[test]
fn obj_normals_reach_the_gltf() {
    let cube_corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 -3\nvn 0 -1 0\nf 1//1 3//1 2//1\nf 1//2 2//2 4//2\n";
    let document = read("a.obj", cube_corner);
    let faces = per_vertex(&document.primitives()[0]);
    let written = write(&document, &faces, OutputFormat::Glb);
    let again = Document::read(&Upload::single("out.glb", written.files[0].1.clone())).unwrap();
    assert!(String::from_utf8_lossy(&written.files[0].1).contains("\"NORMAL\""));
    // The two vertices of the common edge have two normals each.
    assert_eq!(again.primitives()[0].positions.len(), 6);
    let without = cube_corner.replace("vn 0 -1 0", "vn 0 0 0");
    let written = write(&read("a.obj", &without), &faces, OutputFormat::Glb);
    assert!(!String::from_utf8_lossy(&written.files[0].1).contains("\"NORMAL\""));
}

#[test]
fn polygons_without_an_inside_are_named() {
    let bow_ties = |n: usize| {
        let vertices = "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n";
        vertices.to_owned() + &"f 1 2 3 4\n".repeat(n)
    };
    let messages = |name: &str, text: &str| -> Vec<(String, String)> {
        let document = read(name, text);
        let warnings = document.warnings().iter();
        warnings
            .map(|w| (w.code.to_string(), w.message.clone()))
            .collect()
    };
    assert_eq!(messages("a.obj", &bow_ties(0)), []);
    let one = messages("a.obj", &bow_ties(1));
    assert_eq!(one.len(), 1);
    assert_eq!(one[0].0, "polygon_fanned");
    assert!(
        one[0]
            .1
            .starts_with("1 polygon crosses itself or has no area (line 6). "),
        "{}",
        one[0].1
    );
    let many = messages("a.obj", &bow_ties(70));
    assert_eq!(many.len(), 1);
    let start = "70 polygons cross themselves or have no area (lines 6, 7, 8, 9, 10, …). ";
    assert!(many[0].1.starts_with(start), "{}", many[0].1);
    let ply = "ply\nformat ascii 1.0\nelement face 2\nproperty list uchar int vertex_indices\nelement vertex 4\n\
        property float x\nproperty float y\nproperty float z\nend_header\n3 0 2 1\n4 0 1 2 3\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n";
    assert!(messages("a.ply", ply)[0].1.contains("(face 1)"));
    let off = "OFF\n4 2 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n3 0 2 1\n4 0 1 2 3\n";
    assert!(messages("a.off", off)[0].1.contains("(line 8)"));
}
