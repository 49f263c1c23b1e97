//! Splitting of vertices whose corners differ.
use std::collections::HashMap;
use std::hash::Hash;

/// Vertices after a split: the old ones keep their places, the copies follow.
pub(super) struct Split<K> {
    /// Old vertex of each copy.
    pub copies: Vec<u32>,
    /// Faces with the new vertices.
    pub triangles: Vec<[u32; 3]>,
    /// Common key of the corners of each vertex; `None` for vertices without a face.
    pub keys: Vec<Option<K>>,
}

/// Splits `n_vertices` vertices so that all corners of a vertex have the same key. The first key found stays with the
/// vertex.
pub(super) fn split<K: Copy + Eq + Hash>(
    n_vertices: usize,
    triangles: &[[u32; 3]],
    keys_of_corners: &[[K; 3]],
) -> Split<K> {
    let mut keys: Vec<Option<K>> = vec![None; n_vertices];
    let mut copies = Vec::new();
    let mut copy_of: HashMap<(u32, K), u32> = HashMap::new();
    let mut new_triangles = Vec::with_capacity(triangles.len());
    for (face, corners) in triangles.iter().zip(keys_of_corners) {
        new_triangles.push(std::array::from_fn(|corner| {
            let (vertex, key) = (face[corner], corners[corner]);
            match keys[vertex as usize] {
                Some(first) if first == key => vertex,
                None => {
                    keys[vertex as usize] = Some(key);
                    vertex
                }
                Some(_) => *copy_of.entry((vertex, key)).or_insert_with(|| {
                    copies.push(vertex);
                    keys.push(Some(key));
                    keys.len() as u32 - 1
                }),
            }
        }));
    }
    Split {
        copies,
        triangles: new_triangles,
        keys,
    }
}
