//! Welding of equal positions.

/// Welded vertices: equal positions (−0 = 0) share one, numbered in lexicographic order of the coordinates.
pub(crate) struct Weld {
    /// Welded vertex of every position.
    pub vertex: Vec<u32>,
    /// Position of every welded vertex.
    pub points: Vec<[f64; 3]>,
}

pub(crate) fn weld(positions: &[[f64; 3]]) -> Weld {
    let mut sorted: Vec<([f64; 3], u32)> = positions
        .iter()
        .map(|p| p.map(|x| x + 0.0))
        .zip(0..)
        .collect(); // −0 + 0 = 0
    sorted.sort_unstable_by(|(a, _), (b, _)| {
        a[0].total_cmp(&b[0])
            .then_with(|| a[1].total_cmp(&b[1]))
            .then_with(|| a[2].total_cmp(&b[2]))
    });
    let mut vertex = vec![0; positions.len()];
    let mut points: Vec<[f64; 3]> = Vec::new();
    for (point, index) in sorted {
        if points.last() != Some(&point) {
            points.push(point);
        }
        vertex[index as usize] = points.len() as u32 - 1;
    }
    Weld { vertex, points }
}
