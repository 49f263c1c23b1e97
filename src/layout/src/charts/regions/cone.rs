//! Which directions a chart's normals take.

use unwrapd_method::numerics::vec3::{dot, norm, unit};

/// Cells along each edge of the cube that sorts directions: one cell is about 11° wide.
const CELLS: usize = 8;

/// A distribution of normals: area vectors summed by cells of direction.
#[derive(Clone, Debug, Default)]
pub struct Normals {
    /// Cells and the sums in them, sorted by cell.
    cells: Vec<(u16, [f64; 3])>,
    /// Sum of the areas.
    pub area: f64,
    /// Sum of the area vectors.
    pub sum: [f64; 3],
}

/// How far a chart's normals may lie from their mean.
#[derive(Clone, Copy, Debug)]
pub struct Cone {
    /// Cosine of the largest angle to the mean normal.
    pub cos: f64,
    /// The share of the area that may lie outside, so that noise does not shatter a scan.
    pub stray: f64,
    /// The share of the area that the projection along the mean normal may lose.
    pub spread: f64,
}

impl Normals {
    /// Adds one triangle's area vector.
    pub fn add(&mut self, normal: [f64; 3]) {
        let area = norm(normal);
        if area > 0.0 {
            let cell = cell(normal);
            match self.cells.binary_search_by_key(&cell, |c| c.0) {
                Ok(i) => self.cells[i].1 = sum(self.cells[i].1, normal),
                Err(i) => self.cells.insert(i, (cell, normal)),
            }
            self.area += area;
            self.sum = sum(self.sum, normal);
        }
    }

    /// Adds another distribution.
    pub fn merge(&mut self, other: &Self) {
        let mut merged = Vec::with_capacity(self.cells.len() + other.cells.len());
        let (mut a, mut b) = (self.cells.iter().peekable(), other.cells.iter().peekable());
        while let (Some(&&x), Some(&&y)) = (a.peek(), b.peek()) {
            if x.0 <= y.0 {
                a.next();
            }
            if y.0 <= x.0 {
                b.next();
            }
            merged.push(match x.0.cmp(&y.0) {
                std::cmp::Ordering::Less => x,
                std::cmp::Ordering::Equal => (x.0, sum(x.1, y.1)),
                std::cmp::Ordering::Greater => y,
            });
        }
        merged.extend(a);
        merged.extend(b);
        self.cells = merged;
        self.area += other.area;
        self.sum = sum(self.sum, other.sum);
    }

    /// By how much the area exceeds its projection along the mean normal: 0 when flat.
    pub fn spread(&self) -> f64 {
        self.area - norm(self.sum)
    }

    /// Whether the union of two distributions fits into a cone around its mean.
    pub fn fit(&self, other: &Self, cone: Cone) -> bool {
        let (area, both) = (self.area + other.area, sum(self.sum, other.sum));
        if area - norm(both) > cone.spread * area {
            return false;
        }
        let axis = unit(both);
        let stray = |normals: &Self| -> f64 {
            normals
                .cells
                .iter()
                .map(|c| (dot(c.1, axis), norm(c.1)))
                .filter(|(along, area)| *along < cone.cos * area)
                .map(|(_, area)| area)
                .sum()
        };
        stray(self) + stray(other) <= cone.stray * area
    }
}

fn sum(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// The cell of a direction: the face of the cube it points through, and a square of that face.
fn cell(v: [f64; 3]) -> u16 {
    let axis = (1..3).fold(
        0,
        |best, i| if v[i].abs() > v[best].abs() { i } else { best },
    );
    let square = |x: f64| {
        let half = CELLS as f64 / 2.0;
        ((half + half * x / v[axis].abs()) as usize).min(CELLS - 1)
    };
    let (row, column) = (square(v[(axis + 1) % 3]), square(v[(axis + 2) % 3]));
    let face = 2 * axis + usize::from(v[axis] < 0.0);
    ((face * CELLS + row) * CELLS + column) as u16
}
