//! The map of space defined by a deformed cage, and the pieces of triangles on which it is linear.

use unwrapd_deform::cage::{Cage, CagedSurface, Embedding};
use unwrapd_files::document::{AddedVertex, Primitive, SpaceMap, Subdivision};

use crate::PipelineError;

/// Piecewise linear map of a deformed cage.
pub struct CageMap<'a> {
    pub cage: &'a Cage,
    pub deformed: &'a [[f64; 3]],
}

impl CageMap<'_> {
    /// Embeds places in the cage. Nonfinite places, which only unused vertices of shared accessors can have, count as
    /// the origin.
    fn embed(&self, places: &[[f32; 3]]) -> Embedding {
        let finite = |place: &[f64; 3]| {
            if place.iter().all(|x| x.is_finite()) {
                *place
            } else {
                [0.0; 3]
            }
        };
        let places: Vec<[f64; 3]> = widened(places).iter().map(finite).collect();
        self.cage.embed(&places).unwrap_or_default()
    }
}

impl SpaceMap for CageMap<'_> {
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(&self.cage.interpolate(&embedding, self.deformed))
    }

    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(
            &self
                .cage
                .normals(&embedding, self.deformed, &widened(normals)),
        )
    }

    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(
            &self
                .cage
                .tangents(&embedding, self.deformed, &widened(tangents)),
        )
    }
}

/// Splits the triangles of a primitive so that each piece lies in one tetrahedron.
pub fn subdivision(cage: &Cage, primitive: &Primitive) -> Result<Subdivision, PipelineError> {
    let positions = widened(&primitive.positions);
    let split = cage.split(&CagedSurface {
        positions: &positions,
        triangles: &primitive.triangles,
    })?;
    let places = rounded(&split.positions[positions.len()..]);
    let added = split.added.iter().zip(places);
    let added = added.map(|(added, position)| AddedVertex {
        position,
        corners: primitive.triangles[added.triangle as usize],
        weights: added.weights,
    });
    Ok(Subdivision {
        added: added.collect(),
        triangles: split.triangles,
    })
}

pub fn widened(vectors: &[[f32; 3]]) -> Vec<[f64; 3]> {
    vectors.iter().map(|v| v.map(f64::from)).collect()
}

fn rounded(vectors: &[[f64; 3]]) -> Vec<[f32; 3]> {
    vectors.iter().map(|v| v.map(|x| x as f32)).collect()
}
