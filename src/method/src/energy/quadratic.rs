//! Quadratic forms of the displacement.

use super::{Assembly, RestShape, Term};
use crate::numerics::stencils::Stencils;

/// ½ Σᵢⱼ Qᵢⱼ (xᵢ − x⁰ᵢ)·(xⱼ − x⁰ⱼ): one symmetric positive semidefinite matrix Q over the vertices, the same for each
/// coordinate, on displacements from the rest positions x⁰.
///
/// Minimum 0, at rest. Domain: everywhere. From: Schüller et al. 2013, section 4 (Dirichlet, Laplacian). Tests:
/// `energy::taylor_quadratic`.
pub struct Quadratic {
    dim: usize,
    rest: Vec<f64>,
    diagonal: Vec<f64>,
    /// Row, column < row, entry.
    entries: Vec<(u32, u32, f64)>,
    /// For each vertex the start of its row in `rows`, whose items are the other vertex and the entry.
    starts: Vec<usize>,
    rows: Vec<(u32, f64)>,
}

impl Quadratic {
    /// Creates the energy. `rest` holds `dim` coordinates per vertex; Q is given by its diagonal and every entry `(row,
    /// column, value)` with row > column, each at most once.
    pub fn new(
        dim: usize,
        rest: Vec<f64>,
        diagonal: Vec<f64>,
        entries: Vec<(u32, u32, f64)>,
    ) -> Self {
        debug_assert!(entries.iter().all(|&(row, column, _)| row > column));
        let (starts, rows) = rows(diagonal.len(), &entries);
        Self {
            dim,
            rest,
            diagonal,
            entries,
            starts,
            rows,
        }
    }

    /// Returns a coordinate of Q times the displacement.
    fn image(&self, x: &[f64], coordinate: usize) -> f64 {
        let (vertex, k) = (coordinate / self.dim, coordinate % self.dim);
        let moved = |coordinate: usize| x[coordinate] - self.rest[coordinate];
        let mut image = self.diagonal[vertex] * moved(coordinate);
        for &(other, q) in &self.rows[self.starts[vertex]..self.starts[vertex + 1]] {
            image += q * moved(self.dim * other as usize + k);
        }
        image
    }
}

/// Expands the lower triangle of a symmetric matrix to whole rows, each in the order of `entries`.
fn rows(n: usize, entries: &[(u32, u32, f64)]) -> (Vec<usize>, Vec<(u32, f64)>) {
    let mut starts = vec![0; n + 1];
    for &(row, column, _) in entries {
        starts[row as usize + 1] += 1;
        starts[column as usize + 1] += 1;
    }
    for vertex in 0..n {
        starts[vertex + 1] += starts[vertex];
    }
    let mut next = starts.clone();
    let mut rows = vec![(0, 0.0); 2 * entries.len()];
    for &(row, column, q) in entries {
        for (vertex, other) in [(row, column), (column, row)] {
            rows[next[vertex as usize]] = (other, q);
            next[vertex as usize] += 1;
        }
    }
    (starts, rows)
}

impl Term for Quadratic {
    fn dim(&self) -> usize {
        self.dim
    }

    fn stencils(&self) -> Stencils {
        let pairs = self
            .entries
            .iter()
            .flat_map(|&(row, column, _)| [column, row]);
        Stencils::uniform(2, pairs)
    }

    fn value(&self, x: &[f64]) -> f64 {
        let moves = x.iter().zip(&self.rest).map(|(x, rest)| x - rest);
        let products = moves.enumerate().map(|(i, y)| self.image(x, i) * y);
        0.5 * products.sum::<f64>()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for i in 0..x.len() {
            assembly.add_to_gradient(i, self.image(x, i));
        }
        for (vertex, &q) in self.diagonal.iter().enumerate() {
            assembly.add_diagonal_identity(vertex as u32, q);
        }
        for (index, &(_, _, q)) in self.entries.iter().enumerate() {
            assembly.add_pair_identity(index, 0, q);
        }
    }
}

// Laplacians of a mesh, and energies of the displacement made of them.

/// A symmetric matrix over the vertices: for each row its columns, increasing, and entries.
type Rows = Vec<Vec<(u32, f64)>>;

/// Returns the Dirichlet energy of the displacement.
///
/// ```text
/// ½ Σ A‖J − I‖² = ½ (x − x⁰)ᵀ L (x − x⁰)     L the positive cotangent Laplacian
/// ```
/// `elements` have D + 1 vertices each, with one rest shape and true size `sizes` each; `rest` are the positions x⁰.
/// Unit: that of a size. Tests: `energy::dirichlet_is_the_distance_from_the_identity`.
pub fn dirichlet<const D: usize>(
    elements: &[&[u32]],
    shapes: &[RestShape<D>],
    sizes: &[f64],
    rest: Vec<f64>,
) -> Quadratic {
    let laplacian = cotangent(rest.len() / D, elements, shapes, sizes);
    quadratic(D, &laplacian, rest)
}

/// Returns the biharmonic energy of the displacement, ½ (x − x⁰)ᵀ L M⁻¹ L (x − x⁰) with the cotangent Laplacian L and
/// lumped masses M.
///
/// From: Botsch and Sorkine 2008, On Linear Variational Surface Deformation Methods. Tests: `energy::taylor_quadratic`.
pub fn biharmonic<const D: usize>(
    elements: &[&[u32]],
    shapes: &[RestShape<D>],
    sizes: &[f64],
    masses: &[f64],
    rest: Vec<f64>,
) -> Quadratic {
    let laplacian = cotangent(rest.len() / D, elements, shapes, sizes);
    quadratic(D, &gram(&laplacian, |row| 1.0 / masses[row]), rest)
}

/// Returns ½ ‖G(x − x⁰)‖² with the graph Laplacian G: the number of neighbors of a vertex on the diagonal, −1 for each
/// neighbor.
///
/// Tests: `energy::taylor_quadratic`.
pub fn uniform_biharmonic(dim: usize, elements: &[&[u32]], rest: Vec<f64>) -> Quadratic {
    let mut pairs = Vec::new();
    for element in elements {
        for (k, &a) in element.iter().enumerate() {
            for &b in &element[..k] {
                pairs.extend([(a, b), (b, a)]);
            }
        }
    }
    pairs.sort_unstable();
    pairs.dedup();
    let mut entries: Vec<(u32, u32, f64)> = pairs.iter().map(|&(a, b)| (a, b, -1.0)).collect();
    entries.extend(pairs.iter().map(|&(a, _)| (a, a, 1.0)));
    quadratic(
        dim,
        &gram(&summed_rows(rest.len() / dim, entries), |_| 1.0),
        rest,
    )
}

/// Returns lumped masses for [`biharmonic`] in the plane: hybrid Voronoi areas (Meyer et al. 2003), which give half of
/// an obtuse triangle to its obtuse corner and a quarter to each of the others.
pub fn voronoi_areas(n_vertices: usize, triangles: &[[u32; 3]], x: &[[f64; 2]]) -> Vec<f64> {
    let mut masses = vec![0.0; n_vertices];
    for triangle in triangles {
        let p = triangle.map(|v| x[v as usize]);
        let edge = |k: usize| {
            let (a, b) = (p[(k + 1) % 3], p[(k + 2) % 3]);
            [b[0] - a[0], b[1] - a[1]]
        };
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let area = 0.5 * crate::numerics::vec2::cross(edge(0), edge(1));
        // Corner k lies between the edges opposite to the two others.
        let cosine = |k: usize| -dot(edge((k + 1) % 3), edge((k + 2) % 3));
        let obtuse = (0..3).find(|&k| cosine(k) < 0.0);
        for (k, &v) in triangle.iter().enumerate() {
            masses[v as usize] += match obtuse {
                Some(o) if o == k => 0.5 * area,
                Some(_) => 0.25 * area,
                None => {
                    let part = |i: usize| dot(edge(i), edge(i)) * cosine(i) / (16.0 * area);
                    part((k + 1) % 3) + part((k + 2) % 3)
                }
            };
        }
    }
    masses
}

/// Returns L, the sum of size·∇λₖ·∇λₗ over the elements.
fn cotangent<const D: usize>(
    n_vertices: usize,
    elements: &[&[u32]],
    shapes: &[RestShape<D>],
    sizes: &[f64],
) -> Rows {
    let mut entries = Vec::new();
    for ((element, shape), &size) in elements.iter().zip(shapes).zip(sizes) {
        let first = shape
            .inverse
            .iter()
            .fold([0.0; D], |sum, g| std::array::from_fn(|k| sum[k] - g[k]));
        let gradients: Vec<[f64; D]> = std::iter::once(first).chain(shape.inverse).collect();
        for (&a, g) in element.iter().zip(&gradients) {
            for (&b, h) in element.iter().zip(&gradients) {
                let dot: f64 = g.iter().zip(h).map(|(g, h)| g * h).sum();
                entries.push((a, b, size * dot));
            }
        }
    }
    summed_rows(n_vertices, entries)
}

/// Groups entries by row and sums those at the same place.
fn summed_rows(n_vertices: usize, mut entries: Vec<(u32, u32, f64)>) -> Rows {
    entries.sort_by_key(|&(row, column, _)| (row, column));
    let mut rows: Rows = vec![Vec::new(); n_vertices];
    for (row, column, value) in entries {
        match rows[row as usize].last_mut() {
            Some((last, sum)) if *last == column => *sum += value,
            _ => rows[row as usize].push((column, value)),
        }
    }
    rows
}

/// Returns LᵀWL for a symmetric L and a diagonal W.
fn gram(laplacian: &Rows, weight: impl Fn(usize) -> f64) -> Rows {
    let mut entries = Vec::new();
    for (k, row) in laplacian.iter().enumerate() {
        for &(i, a) in row {
            for &(j, b) in row {
                entries.push((i, j, a * weight(k) * b));
            }
        }
    }
    summed_rows(laplacian.len(), entries)
}

fn quadratic(dim: usize, matrix: &Rows, rest: Vec<f64>) -> Quadratic {
    let mut diagonal = vec![0.0; matrix.len()];
    let mut entries = Vec::new();
    for (row, list) in matrix.iter().enumerate() {
        for &(column, value) in list {
            match (column as usize).cmp(&row) {
                std::cmp::Ordering::Less => entries.push((row as u32, column, value)),
                std::cmp::Ordering::Equal => diagonal[row] = value,
                std::cmp::Ordering::Greater => {}
            }
        }
    }
    Quadratic::new(dim, rest, diagonal, entries)
}
