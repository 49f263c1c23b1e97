//! The mesh on which a picture is deformed.

use unwrapd_maps::mesh::PlanarMesh;

/// Most cells along the longer side: half a million triangles.
const MOST_CELLS: usize = 512;

/// Reason why a picture gets no grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// The picture has no pixel.
    #[error("the picture has no pixels")]
    Empty,
    /// The number of cells is zero or too large.
    #[error("`grid` must be between 1 and 512 cells, not {0}")]
    Cells(usize),
}

impl GridError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Empty => "empty_image",
            Self::Cells(_) => "invalid_setting",
        }
    }
}

/// Creates a grid of nearly square cells over a picture, `n_cells` along its longer side, two triangles each.
///
/// In pixels, with (0, 0) at the picture's upper left corner and y down; vertices row by row. The diagonals alternate,
/// so that no direction is preferred.
pub fn picture_grid(width: usize, height: usize, n_cells: usize) -> Result<PlanarMesh, GridError> {
    if width == 0 || height == 0 {
        return Err(GridError::Empty);
    }
    if !(1..=MOST_CELLS).contains(&n_cells) {
        return Err(GridError::Cells(n_cells));
    }
    let [w, h] = [width as f64, height as f64];
    let cells = |side: f64| ((side / w.max(h) * n_cells as f64).round() as u32).max(1);
    let (columns, rows) = (cells(w), cells(h));
    let place = |side: f64, k: u32, n: u32| side * f64::from(k) / f64::from(n);
    let vertices = (0..=rows)
        .flat_map(|j| (0..=columns).map(move |i| [place(w, i, columns), place(h, j, rows)]))
        .collect();
    let triangles = (0..rows)
        .flat_map(|j| (0..columns).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let a = j * (columns + 1) + i;
            let (b, c, d) = (a + 1, a + columns + 2, a + columns + 1);
            if (i + j).is_multiple_of(2) {
                [[a, b, c], [a, c, d]]
            } else {
                [[a, b, d], [b, c, d]]
            }
        })
        .collect();
    PlanarMesh::new(vertices, triangles).map_err(|_| GridError::Cells(n_cells))
}
