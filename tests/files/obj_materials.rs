//! Materials, names and colors between OBJ, PLY and glTF, and what is said of those that cannot be carried.
use std::collections::BTreeSet;
use std::fmt::Write as _;
use unwrapd_files::document::{
    Corners, Document, Layout, NewUvs, OldUvs, OutputFormat, Upload, WriteOptions, Written,
    references,
};
use unwrapd_maps::mesh::VAxis;

use crate::places;

/// The beginning of a PNG with this type of color: 2 is RGB, 0 gray.
fn png(color: u8) -> Vec<u8> {
    let mut bytes = vec![0x89, b'P', b'N', b'G', 0x0D, 0x0A, 0x1A, 0x0A, 0, 0, 0, 13];
    bytes.extend(b"IHDR\0\0\0\x01\0\0\0\x01\x08");
    bytes.push(color);
    bytes
}

const HOUSE: &str = "mtllib parts/house.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
    o front wall\nusemtl wood\nf 1/1 2/2 3/3\nusemtl red\nf 3 4 5\nusemtl wood\nf 1/1 3/3 4/4\no roof\nusemtl red\nf 1 2 5\n";

const MATERIALS: &str = "newmtl wood\nKd 0.5 0.25 1\nKs 0.1 0.1 0.1\nKe 0 0 0\nNs 90\nNi 1.45\nd 1\nPr 0.7\nPm 0.25\nillum 2\n\
    map_Kd -s 2 3 1 -o 0.5 0 0 wood grain.png\nmap_Pr -imfchan g orm.png\nmap_Pm -imfchan b orm.png\n\
    map_Ke glow.jpg\nnorm bumps.png\nmap_Bump -bm 0.5 bumps.png\n\n\
    newmtl red\nKd 1 0 0\nKe 4 2 0\nNi 1.5\nd 0.5\nPr 1\nPm 0\nPc 0.5\nPcr 0.1\nillum 1\n";

fn upload(text: &str, materials: &str) -> Upload {
    let mut upload = Upload::single("house.obj", text.as_bytes().to_vec());
    let mut put = |name: &str, bytes: Vec<u8>| upload.resources.insert(name.to_owned(), bytes);
    put("parts/house.mtl", materials.as_bytes().to_vec());
    for name in ["wood grain.png", "orm.png", "bumps.png"] {
        put(&format!("parts/{name}"), png(2));
    }
    put("parts/glow.jpg", vec![0xFF, 0xD8, 0xFF, 0xE0]);
    upload
}

fn as_gltf(upload: &Upload) -> Document {
    let document = Document::read(upload).unwrap();
    let conversion = document.for_output(OutputFormat::Glb, OldUvs::Kept);
    conversion.unwrap().document
}

fn written(document: &Document, format: OutputFormat, layout: Layout) -> Written {
    let some_uvs = |n: usize| {
        let uvs: Vec<Corners> = vec![[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]; n];
        (layout == Layout::New).then_some(uvs)
    };
    let primitives = document.primitives().iter();
    let uvs = NewUvs {
        layout,
        v_axis: VAxis::Up,
        corners: primitives.map(|p| some_uvs(p.triangles.len())).collect(),
    };
    let options = WriteOptions {
        format,
        stem: "out".to_owned(),
        texcoord: None,
        overwrite: false,
        terms: None,
    };
    document.write(&uvs, &options).unwrap()
}

fn text(written: &Written, name: &str) -> String {
    let file = written.files.iter().find(|(file, _)| file == name);
    String::from_utf8(file.unwrap_or_else(|| panic!("no {name}")).1.clone()).unwrap()
}

fn codes<'a>(
    warnings: impl IntoIterator<Item = &'a unwrapd_files::document::Warning>,
) -> BTreeSet<String> {
    let codes = warnings.into_iter().map(|warning| warning.code.to_string());
    codes.collect()
}

#[test]
fn materials_and_names_come_back_from_gltf() {
    let document = as_gltf(&upload(HOUSE, MATERIALS));
    assert!(document.warnings().is_empty(), "{:?}", document.warnings());
    let shape: Vec<_> = (document.primitives().iter())
        .map(|p| (p.mesh, p.material, p.triangles.len()))
        .collect();
    assert_eq!(shape, [(0, Some(0), 2), (0, Some(1), 1), (1, Some(1), 1)]);
    assert_eq!(document.material("red"), Some(1));
    let glb = written(&document, OutputFormat::Glb, Layout::Edited);
    assert_eq!(glb.files.len(), 1, "the pictures are in it");
    let again = Document::read(&Upload::single("out.glb", glb.files[0].1.clone())).unwrap();
    let obj = written(&again, OutputFormat::Obj, Layout::Edited);
    assert_eq!(codes(&obj.notes.warnings), BTreeSet::new());
    let expected = MATERIALS
        .replace("wood grain.png", "wood_grain.png")
        .replace("Ke 0 0 0", "Ke 1 1 1");
    let lines = |text: &str| -> BTreeSet<String> { text.lines().map(str::to_owned).collect() };
    assert_eq!(lines(&text(&obj, "out.mtl")), lines(&expected));
    let obj_text = text(&obj, "out.obj");
    let statements: Vec<&str> = (obj_text.lines())
        .filter(|line| ["m", "o", "u", "f"].contains(&&line[..1]))
        .collect();
    let expected = [
        "mtllib out.mtl",
        "o front wall",
        "usemtl wood",
        "f 1/1 2/2 3/3",
        "f 1/1 3/3 4/4",
        "usemtl red",
        "f 5 6 7",
        "o roof",
        "usemtl red",
        "f 8 9 10",
    ];
    assert_eq!(statements, expected);
    assert_eq!(again.primitives().len(), document.primitives().len());
}

#[test]
fn what_gltf_has_no_place_for_is_named() {
    let materials = "newmtl wood\nmap_Kd /home/me/wood grain.png\nmap_Ks a.png\nmap_d b.png\nTf 1 1 1\nbump gray.png\n\
        newmtl red\nKd spectral a.rfl\nmap_Ks c.png\nmap_Kd nowhere.png\nrefl -type sphere d.png\n";
    let text =
        HOUSE.replace("o roof\n", "o roof\ng tiles\n") + "g gable\nusemtl blue\nf 2 3 5\nl 1 2\n";
    let mut upload = upload(&text, materials);
    upload.resources.insert("parts/gray.png".to_owned(), png(0));
    let document = as_gltf(&upload);
    let warning = |code: &str| {
        let found = document.warnings().iter().find(|w| w.code == code);
        found
            .unwrap_or_else(|| panic!("no {code} in {:?}", document.warnings()))
            .message
            .as_str()
    };
    assert!(
        warning("material_statements_dropped").ends_with("kd (1), map_d (1), map_ks (2), refl (1)")
    );
    assert!(warning("pictures_missing").contains("nowhere.png;"));
    assert!(warning("bump_dropped").ends_with("materials wood"));
    assert!(warning("groups_dropped").contains("the 2 groups"));
    assert!(warning("elements_dropped").ends_with("1 statements"));
    assert!(warning("materials_unknown").ends_with(": blue"));
    assert_eq!(document.warnings().len(), 6);
    // An absolute path is that of another machine: the file of that name is taken.
    let json = String::from_utf8(
        written(&document, OutputFormat::Gltf, Layout::Edited).files[0]
            .1
            .clone(),
    );
    assert!(json.unwrap().contains("parts/wood%20grain.png"));
}

#[test]
fn what_obj_has_no_place_for_is_named() {
    for (asset, expected) in [
        (
            "SimpleSkin.gltf",
            &["animations_dropped", "skins_dropped"][..],
        ),
        (
            "SimpleMorph.gltf",
            &["animations_dropped", "morph_targets_dropped"],
        ),
        (
            "MultiUVTest.glb",
            &["cameras_dropped", "textures_stale", "uv_sets_dropped"],
        ),
    ] {
        let upload = Upload::single(asset, std::fs::read(places::asset(asset)).unwrap());
        let document = Document::read(&upload).unwrap();
        let obj = written(&document, OutputFormat::Obj, Layout::New);
        let expected: BTreeSet<String> = expected.iter().map(|code| (*code).to_owned()).collect();
        assert_eq!(
            codes(&obj.notes.warnings),
            expected,
            "{asset}: {:?}",
            obj.notes.warnings
        );
    }
}

#[test]
fn textures_of_replaced_uvs_are_named() {
    let document = Document::read(&upload(HOUSE, MATERIALS)).unwrap();
    let obj = written(&document, OutputFormat::Obj, Layout::New);
    let [warning] = &obj.notes.warnings[..] else {
        panic!("{:?}", obj.notes.warnings);
    };
    assert!(warning.code == "textures_misplaced" && warning.message.contains("materials wood;"));
    let names: BTreeSet<&str> = obj.files[1..].iter().map(|file| file.0.as_str()).collect();
    let expected = [
        "house.mtl",
        "wood grain.png",
        "orm.png",
        "bumps.png",
        "glow.jpg",
    ];
    assert_eq!(
        names,
        expected
            .map(|name| format!("parts/{name}"))
            .iter()
            .map(String::as_str)
            .collect()
    );
    // In glTF they keep their UVs, and the new ones go to another set.
    let glb = written(
        &as_gltf(&upload(HOUSE, MATERIALS)),
        OutputFormat::Glb,
        Layout::New,
    );
    let sets: Vec<u32> = glb
        .notes
        .primitives
        .iter()
        .map(|note| note.texcoord)
        .collect();
    assert_eq!(sets, [1, 1, 0]);
    // From glTF to OBJ every one is listed, as there is one set.
    let obj = written(
        &as_gltf(&upload(HOUSE, MATERIALS)),
        OutputFormat::Obj,
        Layout::New,
    );
    assert_eq!(obj.notes.textures_affected.len(), 4);
}

#[test]
fn files_are_found_in_two_steps_and_never_outside() {
    let text = "mtllib parts/house.mtl ../b.mtl /etc/passwd C:\\c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mut upload = Upload::single("house.obj", text.as_bytes().to_vec());
    let is_inside =
        |path: &String| !path.starts_with('/') && !path.contains("..") && !path.contains(':');
    let first = references(&upload);
    assert!(
        first.contains("parts/house.mtl") && first.iter().all(is_inside),
        "{first:?}"
    );
    let materials = "newmtl a\nmap_Kd -bm 2 -s 1 1 1 some wood.png\nmap_Ke ../../up.png\nnorm D:\\x\\n.png\ndisp sub\\d.png\n";
    upload
        .resources
        .insert("parts/house.mtl".to_owned(), materials.as_bytes().to_vec());
    let second = references(&upload);
    for path in [
        "parts/some wood.png",
        "parts/n.png",
        "parts/sub/d.png",
        "up.png",
    ] {
        assert!(second.contains(path), "{path} of {second:?}");
    }
    assert!(second.iter().all(is_inside), "{second:?}");
}

#[test]
fn colors_of_vertices_come_back() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n\
        end_header\n";
    let colors = [[0, 1, 2], [17, 128, 254], [255, 90, 40]];
    let vertex =
        |(k, [r, g, b]): (usize, [u8; 3])| format!("{} {} 0 0 {r} {g} {b}\n", k % 2, k / 2);
    let vertices: String = colors.into_iter().enumerate().map(vertex).collect();
    let ply = format!("{header}{vertices}3 0 1 2\n");
    let document = Document::read(&Upload::single("a.ply", ply.into_bytes())).unwrap();
    assert_eq!(document.warnings()[0].code, "properties_dropped");
    let glb = written(&document, OutputFormat::Glb, Layout::New);
    let again = Document::read(&Upload::single("a.glb", glb.files[0].1.clone())).unwrap();
    for document in [&document, &again] {
        let obj = text(
            &written(document, OutputFormat::Obj, Layout::New),
            "out.obj",
        );
        let read: Vec<[u8; 3]> = (obj.lines())
            .filter_map(|line| line.strip_prefix("v "))
            .map(|line| {
                let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
                [3, 4, 5].map(|k| (255.0 * numbers[k]).round() as u8)
            })
            .collect();
        assert_eq!(read, colors);
        // And of an OBJ they are read, too.
        let upload = Upload::single("a.obj", obj.into_bytes());
        let glb = written(&as_gltf(&upload), OutputFormat::Glb, Layout::New);
        assert!(String::from_utf8_lossy(&glb.files[0].1).contains("\"COLOR_0\""));
    }
}

#[test]
fn names_of_gltf_are_each_others_and_one_line_in_obj() {
    let json = r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "name": "a#b"}, {"mesh": 1}, {"mesh": 2}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]},
                   {"name": "A_b", "primitives": [{"attributes": {"POSITION": 0}, "material": 1}]},
                   {"name": "x\ny", "primitives": [{"attributes": {"POSITION": 0}}]}],
        "materials": [{"name": "m"}, {"name": "m"}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;
    let document = Document::read(&Upload::single("a.gltf", json.as_bytes().to_vec())).unwrap();
    let obj = text(
        &written(&document, OutputFormat::Obj, Layout::New),
        "out.obj",
    );
    let names: Vec<&str> = obj
        .lines()
        .filter(|line| line.starts_with(['o', 'u']))
        .collect();
    assert_eq!(
        names,
        ["o a_b", "usemtl m", "o A_b_2", "usemtl m_2", "o x_y"]
    );
}

#[test]
fn too_many_objects_become_one_mesh() {
    let mut text = String::from("v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    for object in 0..10_000 {
        let _ = write!(text, "o part {object}\nusemtl m{}\nf 1 2 3\n", object % 2);
    }
    let document = as_gltf(&Upload::single("a.obj", text.into_bytes()));
    let faces: Vec<usize> = document
        .primitives()
        .iter()
        .map(|p| p.triangles.len())
        .collect();
    assert_eq!(faces, [5000, 5000]);
    assert_eq!(
        codes(document.warnings()),
        BTreeSet::from(["parts_joined".to_owned()])
    );
}
