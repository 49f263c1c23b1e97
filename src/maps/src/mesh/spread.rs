//! Searches over glued faces.

use super::edges::CUT;

/// Lets a search spread breadth first over glued edges from the faces in `faces`, to which it adds
/// those that it enters.
///
/// `enters` is asked at each halfedge of a face that is glued, with the halfedge and its twin. It
/// says whether the face of the twin is entered, and must say so once for each face at most. O(n).
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
