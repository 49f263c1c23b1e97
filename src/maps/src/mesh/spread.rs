//! Searches over glued faces.

use super::edges::CUT;

/// Searches breadth first over glued edges from the faces in `faces`, to which it adds those that it enters.
///
/// Calls `enters` at each halfedge of a face that is glued, with the halfedge and its twin. `enters` returns whether to
/// enter the face of the twin, and must return `true` at most once for each face. O(n).
pub fn spread(twin: &[u32], faces: &mut Vec<u32>, mut enters: impl FnMut(u32, u32) -> bool) {
    let mut done = 0;
    while let Some(&face) = faces.get(done) {
        done += 1;
        for h in 3 * face..3 * face + 3 {
            let t = twin[h as usize];
            if t != CUT && enters(h, t) {
                faces.push(t / 3);
            }
        }
    }
}
