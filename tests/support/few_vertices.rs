//! Random meshes on few vertices.

use proptest::strategy::Strategy;

use crate::zoo::Mesh;

/// Strategy of random triangles on nine vertices: edges have many faces and vertices many fans.
pub fn few_vertices() -> impl Strategy<Value = Mesh> {
    let triangle = [0..9u32, 0..9, 0..9];
    proptest::collection::vec(triangle, 0..40).prop_map(|triangles| Mesh {
        name: "random".to_owned(),
        positions: (0..9u8)
            .map(|i| {
                let t = f32::from(i);
                [t.sin(), (2.0 * t).cos(), 0.3 * t]
            })
            .collect(),
        triangles,
    })
}
