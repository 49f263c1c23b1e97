use super::{DocumentError, Primitive};

/// Triangles of a primitive cut into pieces.
#[derive(Debug, Clone, Default)]
pub struct Subdivision {
    /// Vertices added after the primitive's own.
    pub added: Vec<AddedVertex>,
    /// All resulting triangles, over own and added vertices.
    pub triangles: Vec<[u32; 3]>,
}

/// A vertex inside a triangle or on an edge of it.
#[derive(Debug, Clone, Copy)]
pub struct AddedVertex {
    /// Its position.
    pub position: [f32; 3],
    /// Vertices of the triangle.
    pub corners: [u32; 3],
    /// Barycentric weights in the triangle, by which everything except the position is interpolated.
    pub weights: [f64; 3],
}

impl Subdivision {
    /// Cuts a primitive that has only positions and triangles.
    pub(super) fn apply(&self, primitive: &mut Primitive) {
        let added = self.added.iter().map(|vertex| vertex.position);
        primitive.positions.extend(added);
        primitive.triangles.clone_from(&self.triangles);
    }

    /// Appends the values of the added vertices to those of a primitive's own.
    pub(super) fn interpolate<const N: usize>(&self, values: &mut Vec<[f32; N]>) {
        for AddedVertex {
            corners, weights, ..
        } in &self.added
        {
            let corners = corners.map(|vertex| values[vertex as usize]);
            values.push(std::array::from_fn(|k| {
                let terms = corners.iter().zip(weights);
                terms.map(|(value, w)| f64::from(value[k]) * w).sum::<f64>() as f32
            }));
        }
    }

    /// Refuses subdivisions that do not fit the primitives.
    pub(super) fn check(all: &[Self], primitives: &[Primitive]) -> Result<(), DocumentError> {
        let fits = |(cut, primitive): (&Self, &Primitive)| {
            let own = primitive.positions.len();
            let is_own = |v: &u32| (*v as usize) < own;
            let n_vertices = own + cut.added.len();
            cut.added.iter().all(|a| a.corners.iter().all(is_own))
                && (cut.triangles.iter().flatten()).all(|v| (*v as usize) < n_vertices)
        };
        if all.len() == primitives.len() && all.iter().zip(primitives).all(fits) {
            Ok(())
        } else {
            let text = "pieces that are not those of the primitives".to_owned();
            Err(DocumentError::IndexOutOfRange(text))
        }
    }
}
