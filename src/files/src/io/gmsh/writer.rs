use super::{Elements, TETRAHEDRON, TRIANGLE};
use std::fmt::Write;

/// Returns the text of the elements in version 2.2, which more programs read than 4.1; triangles before tetrahedra.
pub fn write(elements: &Elements) -> String {
    let n_vertices = elements.vertices.len();
    let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{n_vertices}\n");
    for (k, [x, y, z]) in elements.vertices.iter().enumerate() {
        let _ = writeln!(text, "{} {x:?} {y:?} {z:?}", k + 1); // writing to a string cannot fail
    }
    let n_elements = elements.triangles.len() + elements.tets.len();
    let _ = writeln!(text, "$EndNodes\n$Elements\n{n_elements}");
    let mut tag = 0;
    let mut line = |element_type: i32, corners: &[u32]| {
        tag += 1;
        let _ = write!(text, "{tag} {element_type} 2 0 1");
        for &corner in corners {
            let _ = write!(text, " {}", u64::from(corner) + 1);
        }
        text.push('\n');
    };
    for triangle in &elements.triangles {
        line(TRIANGLE, triangle);
    }
    for tet in &elements.tets {
        line(TETRAHEDRON, tet);
    }
    text.push_str("$EndElements\n");
    text
}
