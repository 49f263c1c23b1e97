//! Planar and tetrahedral meshes: what is checked, what files they come from and go to.

use unwrapd_files::io::{CellData, ElementFormat, Elements, ReadError, text_positions, vtu};
use unwrapd_maps::mesh::{ElementError, PlanarMesh, TetMesh, boundary_triangles};
use unwrapd_method::numerics::predicates::orient3d_sign;

const CORNERS: [[f64; 3]; 4] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
];

/// Two tetrahedra on either side of a common face, and a point beyond f32.
fn two_tets() -> Elements {
    let mut vertices = CORNERS.to_vec();
    vertices.push([1.0 / 3.0, -1e-30, 0.1 + 0.2]);
    vertices[4][1] = -1.0 / 7.0;
    Elements {
        vertices,
        triangles: Vec::new(),
        tets: vec![[0, 1, 2, 3], [0, 1, 3, 4]],
    }
}

#[test]
fn orientation_is_exact() {
    let [a, b, c, d] = CORNERS;
    assert_eq!(orient3d_sign(a, b, c, d), 1);
    assert_eq!(orient3d_sign(a, c, b, d), -1);
    let on_plane = [0.1, 0.2, 0.0];
    assert_eq!(orient3d_sign(a, b, c, on_plane), 0);
    assert_eq!(orient3d_sign(a, b, c, [0.1, 0.2, 5e-80]), 1);
    assert_eq!(orient3d_sign(a, b, c, [f64::NAN; 3]), 0);
}

#[test]
fn inverted_tets_are_turned_and_counted() {
    let mut elements = two_tets();
    elements.tets[1].swap(0, 1);
    let mesh = elements.into_tet_mesh().expect("sound but for its winding");
    assert_eq!(mesh.reoriented(), 1);
    for tet in mesh.tets() {
        let [a, b, c, d] = tet.map(|v| mesh.vertices()[v as usize]);
        assert_eq!(orient3d_sign(a, b, c, d), 1);
    }
    let boundary = mesh.boundary();
    assert_eq!(boundary.len(), 6);
    let volume: f64 = boundary.iter().map(|t| cone(mesh.vertices(), t)).sum();
    let expected = 1.0 / 6.0 + 1.0 / 42.0;
    assert!(
        (volume - expected).abs() < 1e-15,
        "the normals point out: {volume}"
    );
}

/// The signed volume between a triangle and the origin.
fn cone(vertices: &[[f64; 3]], triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| vertices[v as usize]);
    (a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0]))
        / 6.0
}

#[test]
fn clockwise_triangles_are_turned_and_counted() {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let mesh = PlanarMesh::new(square, vec![[0, 1, 2], [0, 3, 2]]).expect("a square");
    assert_eq!(mesh.reoriented(), 1);
    assert_eq!(mesh.triangles(), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.boundary(), [[0, 1], [1, 2], [2, 3], [3, 0]]);
}

#[test]
fn bad_elements_are_named() {
    let [a, b, c, d] = CORNERS;
    let tets = |vertices: &[[f64; 3]], tets: &[[u32; 4]]| {
        TetMesh::new(vertices.to_vec(), tets.to_vec()).map(|_| ())
    };
    let nan = [0.0, f64::NAN, 0.0];
    let good = [0, 1, 2, 3];
    assert_eq!(tets(&CORNERS, &[]), Err(ElementError::Empty("tetrahedra")));
    assert_eq!(
        tets(&[a, b, c, d, nan], &[good]),
        Err(ElementError::NonFinitePosition { vertex: 4 })
    );
    assert_eq!(
        tets(&CORNERS, &[good, [0, 1, 2, 9]]).map_err(|e| e.code()),
        Err("index_out_of_range")
    );
    assert_eq!(
        tets(&[a, b, c, d, [0.25, 0.5, 0.0]], &[good, [0, 1, 2, 4]]),
        Err(ElementError::ZeroSize { element: 1 })
    );
    assert_eq!(
        tets(&CORNERS, &[good, [0, 1, 1, 3]]),
        Err(ElementError::ZeroSize { element: 1 })
    );
    assert_eq!(
        tets(&[a, b, c, d, [0.1, 0.1, 0.1]], &[good, [0, 1, 2, 4]]),
        Err(ElementError::Folded { elements: [0, 1] })
    );
}

#[test]
fn what_is_no_planar_mesh_is_named() {
    let [a, b, c, _] = CORNERS;
    let flat = |vertices: &[[f64; 3]], triangles: &[[u32; 3]]| {
        PlanarMesh::flat(vertices, triangles.to_vec()).map(|_| ())
    };
    assert_eq!(
        flat(&[a, b, c].map(|p| [p[0], p[1], 7.0]), &[[0, 1, 2]]),
        Ok(())
    );
    assert_eq!(
        flat(&[a, b, [0.0, 1.0, 1e-9]], &[[0, 1, 2]]),
        Err(ElementError::NotPlanar {
            vertex: 2,
            z: 1e-9,
            plane: 0.0
        })
    );
    assert_eq!(
        flat(&[a, b, c, [f64::INFINITY, 0.0, 0.0]], &[[0, 1, 2]]),
        Err(ElementError::NonFinitePosition { vertex: 3 })
    );
    assert_eq!(
        flat(&[a, b, c, [0.5, 0.0, 0.0]], &[[0, 1, 2], [0, 1, 3]]),
        Err(ElementError::ZeroSize { element: 1 })
    );
    assert_eq!(
        flat(&[a, b, c, [0.2, 0.2, 0.0]], &[[0, 1, 2], [1, 0, 3]]),
        Err(ElementError::Folded { elements: [0, 1] })
    );
}

#[test]
fn a_medit_file_that_counts_from_zero_is_refused() {
    let elements = two_tets();
    let text = ElementFormat::Medit.write(&elements);
    let from_zero = text
        .replace("1 2 3 4 0", "0 1 2 3 0")
        .replace("1 2 4 5 0", "0 1 3 4 0");
    assert_ne!(text, from_zero);
    assert_eq!(
        code(ElementFormat::Medit, from_zero.as_bytes()),
        "index_out_of_range"
    );
}

#[test]
fn what_is_written_reads_back_to_the_bit() {
    let elements = two_tets();
    for format in [
        ElementFormat::Gmsh,
        ElementFormat::Medit,
        ElementFormat::Tet,
    ] {
        let text = format.write(&elements);
        assert_eq!(
            format.read(text.as_bytes()).as_ref(),
            Ok(&elements),
            "{format:?}"
        );
    }
    let surface = Elements {
        triangles: boundary_triangles(&elements.tets),
        tets: Vec::new(),
        ..elements.clone()
    };
    for format in [
        ElementFormat::Gmsh,
        ElementFormat::Medit,
        ElementFormat::Obj,
        ElementFormat::Off,
    ] {
        let text = format.write(&surface);
        assert_eq!(
            format.read(text.as_bytes()).as_ref(),
            Ok(&surface),
            "{format:?}"
        );
    }
    let text = ElementFormat::Obj.write(&elements);
    let boundary = ElementFormat::Obj.read(text.as_bytes());
    assert_eq!(boundary.as_ref(), Ok(&surface), "tets leave their boundary");
}

#[test]
fn positions_are_written_with_17_digits() {
    let text = text_positions(&[[0.1 + 0.2, -5e-324], [0.0, 1e300]]);
    assert_eq!(
        text.lines().next(),
        Some("3.0000000000000004e-1 -4.9406564584124654e-324")
    );
    let back: Vec<f64> = text
        .split_whitespace()
        .map(|w| w.parse().expect("a number"))
        .collect();
    assert_eq!(back, [0.1 + 0.2, -5e-324, 0.0, 1e300]);
}

#[test]
fn a_vtu_file_is_sound_xml_with_all_cells() {
    let mut elements = two_tets();
    elements.triangles.push([0, 1, 2]);
    let text = ElementFormat::Vtu.write(&elements);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let array = |name: &str| -> Vec<u32> {
        let node = document
            .descendants()
            .find(|n| n.attribute("Name") == Some(name));
        let words = node.and_then(|n| n.text()).expect(name).split_whitespace();
        words.map(|w| w.parse().expect("a number")).collect()
    };
    assert_eq!(array("connectivity"), [0, 1, 2, 0, 1, 2, 3, 0, 1, 3, 4]);
    assert_eq!(array("offsets"), [3, 7, 11]);
    assert_eq!(array("types"), [5, 10, 10]);
}

#[test]
fn a_vtu_file_holds_data_of_its_last_cells() {
    let mut elements = two_tets();
    elements.triangles.push([0, 1, 2]);
    let data = CellData {
        name: "sizes",
        components: 2,
        values: vec![0.1 + 0.2, -1.0, 3.0, 4.0],
    };
    let text = vtu::write(&elements, &[data]);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let mut nodes = document.descendants();
    let node = nodes.find(|n| n.attribute("Name") == Some("sizes"));
    let node = node.expect("the data");
    assert_eq!(
        node.parent().map(|n| n.tag_name().name().to_owned()),
        Some("CellData".to_owned())
    );
    assert_eq!(node.attribute("NumberOfComponents"), Some("2"));
    let lines: Vec<&str> = node.text().expect("numbers").trim().lines().collect();
    assert_eq!(lines, ["NaN NaN", "0.30000000000000004 -1.0", "3.0 4.0"]);
}

/// The two tets and a triangle in Gmsh's framings, binary ones in both byte orders, with tags that are not consecutive.
fn gmsh_files() -> Vec<(&'static str, Vec<u8>)> {
    let text_41 = b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\n$ 1 2 $Nodes\n$EndComments\n$Nodes\n2 5 7 99\n\
        2 1 1 2\n7\n9\n0 0 0 0.5 0.5\n1 0 0 0.5 0.5\n3 1 0 3\n20\n21\n99\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n\
        $Elements\n3 3 1 4\n1 1 1 1\n4 7 9\n2 1 2 1\n1 7 9 20\n3 1 4 1\n2 7 9 20 21\n$EndElements\n";
    let text_22 = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n7 0 0 0\n9 1 0 0\n20 0 1 0\n21 0 0 1\n99 1 1 1\n\
        $EndNodes\n$Elements\n3\n4 1 2 0 1 7 9\n1 2 3 0 1 0 7 9 20\n2 4 0 7 9 20 21\n$EndElements\n";
    vec![
        ("4.1 text", text_41.to_vec()),
        ("2.2 text", text_22.to_vec()),
        ("2.2 little", gmsh_binary(false, false)),
        ("2.2 big", gmsh_binary(false, true)),
        ("4.1 little", gmsh_binary(true, false)),
        ("4.1 big", gmsh_binary(true, true)),
    ]
}

fn gmsh_binary(is_41: bool, big: bool) -> Vec<u8> {
    let points = [[0.0; 3], CORNERS[1], CORNERS[2], CORNERS[3], [1.0; 3]];
    let tags = [7_u64, 9, 20, 21, 99];
    let mut file = Vec::new();
    let number = |bytes: &[u8]| {
        let mut bytes = bytes.to_vec();
        if big {
            bytes.reverse();
        }
        bytes
    };
    let int = |n: i32| number(&n.to_le_bytes());
    let size = |n: u64| number(&n.to_le_bytes());
    let point = |p: &[f64; 3]| {
        p.iter()
            .flat_map(|x| number(&x.to_le_bytes()))
            .collect::<Vec<_>>()
    };
    file.extend(if is_41 {
        b"$MeshFormat\n4.1 1 8\n"
    } else {
        b"$MeshFormat\n2.2 1 8\n"
    });
    file.extend(int(1));
    file.extend(b"\n$EndMeshFormat\n$Nodes\n");
    if is_41 {
        file.extend([1, 5, 7, 99].map(size).concat());
        file.extend([int(3), int(1), int(0), size(5)].concat());
        file.extend(tags.map(size).concat());
        file.extend(points.iter().flat_map(point));
        file.extend(b"\n$EndNodes\n$Elements\n");
        file.extend([2, 2, 1, 2].map(size).concat());
        file.extend([int(2), int(1), int(2), size(1)].concat());
        file.extend([1, 7, 9, 20].map(size).concat());
        file.extend([int(3), int(1), int(4), size(1)].concat());
        file.extend([2, 7, 9, 20, 21].map(size).concat());
    } else {
        file.extend(b"5\n");
        for (tag, p) in tags.iter().zip(&points) {
            file.extend([int(*tag as i32), point(p)].concat());
        }
        file.extend(b"\n$EndNodes\n$Elements\n2\n");
        file.extend([2, 1, 2, 1, 0, 1, 7, 9, 20].map(int).concat());
        file.extend([4, 1, 0, 2, 7, 9, 20, 21].map(int).concat());
    }
    file.extend(b"\n$EndElements\n");
    file
}

#[test]
fn every_framing_of_gmsh_gives_the_same_elements() {
    for (name, bytes) in gmsh_files() {
        let elements = ElementFormat::Gmsh.read(&bytes).expect(name);
        assert_eq!(elements.vertices.len(), 5, "{name}");
        assert_eq!(elements.vertices[1..4], CORNERS[1..4], "{name}");
        assert_eq!(elements.triangles, [[0, 1, 2]], "{name}");
        assert_eq!(elements.tets, [[0, 1, 2, 3]], "{name}");
    }
}

#[test]
fn medit_sections_that_say_more_are_passed_over() {
    let text = "MeshVersionFormatted 1\n# made by hand\nDimension\n2\nVertices 3\n0 0 1\n1 0 1\n0 1 1\nRidges\n1\n2\n\
        Edges 1\n1 2 0\nTriangles\n1\n1 2 3 7\nEnd\nTriangles 5\n";
    let elements = ElementFormat::Medit.read(text.as_bytes()).expect("sound");
    assert_eq!(elements.triangles, [[0, 1, 2]]);
    assert_eq!(elements.vertices[1], [1.0, 0.0, 0.0]);
}

fn code(format: ElementFormat, bytes: &[u8]) -> &'static str {
    format
        .read(bytes)
        .map_or_else(|e: ReadError| e.code(), |_| "read")
}

#[test]
fn bad_files_are_refused_with_their_code() {
    use ElementFormat::{Gmsh, Medit, Off, Tet, Vtu};
    let head = "MeshVersionFormatted 1\nDimension 3\n";
    let medit = |body: &str| code(Medit, format!("{head}{body}").as_bytes());
    assert_eq!(medit("Vertices 99999999999\n0 0 0 0\n"), "invalid_mesh");
    assert_eq!(medit("Vertices 1\n0 nan 0 0\n"), "non_finite_position");
    assert_eq!(
        medit("Vertices 1\n0 0 0 0\nTetrahedra 1\n1 1 1 2 0\n"),
        "index_out_of_range"
    );
    assert_eq!(
        medit("Vertices 1\n0 0 0 0\nTetrahedra 1\n0 1 1 1 0\n"),
        "index_out_of_range"
    );
    assert_eq!(medit("Vertices -1\n"), "invalid_mesh");
    assert_eq!(medit("Vertices 1\n0 0 0 0\nHexahedra 1\n"), "invalid_mesh");
    assert_eq!(
        code(Medit, b"MeshVersionFormatted 1\nDimension 4\n"),
        "invalid_mesh"
    );
    assert_eq!(code(Medit, b""), "invalid_mesh");
    assert_eq!(code(Tet, b"99999999999 1\n0 0 0\n"), "invalid_mesh");
    assert_eq!(
        code(Tet, b"1 18446744073709551615\n0 0 0\n"),
        "invalid_mesh"
    );
    assert_eq!(
        code(Tet, b"1 1\n0 0 1e999\n0 0 0 0\n"),
        "non_finite_position"
    );
    assert_eq!(code(Tet, b"1 1\n0 0 0\n0 0 0 -1\n"), "index_out_of_range");
    assert_eq!(code(Tet, b"1 1\n0 0 0\n0 0 0 0\n5\n"), "invalid_mesh");
    assert_eq!(
        code(Gmsh, b"$MeshFormat\n4.0 0 8\n$EndMeshFormat\n"),
        "invalid_mesh"
    );
    assert_eq!(code(Gmsh, b"$MeshFormat\n2.2 0 4\n"), "invalid_mesh");
    assert_eq!(code(Gmsh, b"$MeshFormat\n2.2 1 8\nabcd"), "invalid_mesh");
    let gmsh = |body: &str| {
        code(
            Gmsh,
            format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{body}").as_bytes(),
        )
    };
    assert_eq!(gmsh("$Nodes\n99999999999\n1 0 0 0\n"), "invalid_mesh");
    assert_eq!(
        gmsh("$Nodes\n2\n1 0 0 0\n1 0 0 0\n$EndNodes\n"),
        "invalid_mesh"
    );
    assert_eq!(gmsh("$Nodes\n1\n1 0 inf 0\n"), "non_finite_position");
    assert_eq!(gmsh("$Elements\n1\n1 2 0 1 2 3\n"), "index_out_of_range");
    assert_eq!(
        gmsh("$Elements\n1\n1 5 0 1 2 3 4 5 6 7 8\n"),
        "invalid_mesh"
    );
    assert_eq!(gmsh("$Elements\n1\n1 2 2147483647 1\n"), "invalid_mesh");
    assert_eq!(gmsh("$Elements\n1\n-1 2 0 1 2 3\n"), "invalid_mesh");
    assert_eq!(gmsh("$PhysicalNames\n1\n"), "invalid_mesh");
    assert_eq!(code(Off, b"OFF\n99999999999 1 0\n0 0 0\n"), "invalid_mesh");
    assert_eq!(code(Vtu, b"<VTKFile/>"), "invalid_mesh");
}

#[test]
fn no_truncation_and_no_byte_makes_a_reader_panic() {
    let elements = two_tets();
    let mut files: Vec<(ElementFormat, Vec<u8>)> = gmsh_files()
        .into_iter()
        .map(|(_, bytes)| (ElementFormat::Gmsh, bytes))
        .collect();
    for format in [
        ElementFormat::Medit,
        ElementFormat::Tet,
        ElementFormat::Gmsh,
    ] {
        files.push((format, format.write(&elements).into_bytes()));
    }
    let mut refused = 0;
    for (format, bytes) in files {
        for end in 0..bytes.len() {
            refused += usize::from(format.read(&bytes[..end]).is_err());
        }
        for at in 0..bytes.len() {
            for value in [0, b'-', b'9', b'$', b'\n', 0xFF] {
                let mut changed = bytes.clone();
                changed[at] = value;
                refused += usize::from(format.read(&changed).is_err());
            }
        }
    }
    assert!(refused > 1000, "only {refused} of the changes were noticed");
}

mod shared {
    use super::{ElementFormat, Elements};
    use crate::places;

    fn read(file: &str) -> Elements {
        let bytes = std::fs::read(places::shared(file)).expect(file);
        let format = ElementFormat::of_name(file).expect("a known extension");
        format.read(&bytes).expect(file)
    }

    #[test]
    #[ignore = "needs ../shared"]
    fn real_files_are_read_whole() {
        // Vertices, elements, boundary triangles, as the tables beside the files have them.
        let tets: [(&str, usize, usize, usize); 11] = [
            ("data/tet/Armadillo13K.msh", 13230, 54985, 17296),
            ("data/tet/bar.mesh", 2152, 8118, 3200),
            ("data/tet/bunny.mesh", 5433, 34055, 670),
            ("data/tet/bunny_19k.msh", 4670, 19379, 6266),
            ("data/tet/decimated-knight.mesh", 1822, 5452, 3544),
            ("data/tet/hand.mesh", 7234, 29998, 9556),
            ("data/tet/homer.mesh", 16592, 61257, 24972),
            ("data/tet/octopus-low.mesh", 452, 1140, 898),
            ("data/tet/square_beam.mesh", 739, 2886, 894),
            ("reference/meshes/bar_c.tet", 153, 384, 272),
            ("reference/meshes/bar_f.tet", 3969, 18432, 3328),
        ];
        for (file, n_vertices, n_tets, n_boundary) in tets {
            let mesh = read(file).into_tet_mesh().expect(file);
            let sizes = (
                mesh.vertices().len(),
                mesh.tets().len(),
                mesh.boundary().len(),
            );
            assert_eq!(sizes, (n_vertices, n_tets, n_boundary), "{file}");
        }
        let planar: [(&str, usize, usize, usize); 9] = [
            ("data/planar/grid.off", 145, 256, 32),
            ("data/planar/woody-lo.off", 199, 336, 60),
            ("data/planar/bar792.obj", 597, 792, 400),
            ("data/planar/woody_gingerbread.obj", 694, 1267, 119),
            ("data/planar/kangaroo_fine.msh", 1508, 2700, 314),
            ("data/planar/woody-hi.off", 2642, 5040, 242),
            ("data/planar/alligator.obj", 3208, 5981, 433),
            ("data/planar/bump-domain.obj", 4172, 8058, 284),
            ("data/planar/annulus.obj", 4985, 9724, 246),
        ];
        for (file, n_vertices, n_triangles, n_boundary) in planar {
            let mesh = read(file).into_planar_mesh().expect(file);
            let sizes = (
                mesh.vertices().len(),
                mesh.triangles().len(),
                mesh.boundary().len(),
            );
            assert_eq!(sizes, (n_vertices, n_triangles, n_boundary), "{file}");
        }
    }
}
