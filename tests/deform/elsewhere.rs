//! The same problem in another unit, another place, another direction, another order.

use unwrapd_deform::{Body, BodyElements, Problem};
use unwrapd_maps::mesh::{PlanarMesh, TetMesh};
use unwrapd_method::solver::Handles;

/// How a problem is posed again.
#[derive(Clone, Copy, Debug)]
pub struct Elsewhere {
    /// Lengths are multiplied by this,
    pub scale: f64,
    /// then turned by so many radians: in the plane, or in space about the diagonal (1, 1, 1),
    pub turn: f64,
    /// then moved along the first axis by so many diagonals of the box.
    pub shift: f64,
    /// The element that comes first; the others follow it around.
    pub first: usize,
}

/// As it is.
pub const HERE: Elsewhere = Elsewhere {
    scale: 1.0,
    turn: 0.0,
    shift: 0.0,
    first: 0,
};

impl Elsewhere {
    /// What a problem and its solutions become.
    pub fn pose(&self, problem: &Problem) -> Problem {
        let dim = problem.body.dim();
        let diagonal = self.scale * diagonal(&problem.body);
        let place = |x: &[f64]| -> Vec<f64> {
            let places = x.chunks_exact(dim);
            places.flat_map(|p| self.place(p, diagonal)).collect()
        };
        let rest = place(&problem.body.rest);
        let body = match &problem.body.elements {
            BodyElements::Triangles { corners, .. } => {
                let vertices = rest.as_chunks().0.to_vec();
                let mesh = PlanarMesh::new(vertices, self.ordered(corners));
                Body::from(&mesh.expect("a planar mesh"))
            }
            BodyElements::Tetrahedra { corners, .. } => {
                let vertices = rest.as_chunks().0.to_vec();
                let mesh = TetMesh::new(vertices, self.ordered(corners));
                Body::from(&mesh.expect("a mesh of tetrahedra"))
            }
        };
        let stations = problem.stations.iter().map(|handles| Handles {
            targets: place(&handles.targets),
            point_targets: place(&handles.point_targets),
            ..handles.clone()
        });
        let mut barrier = problem.barrier;
        barrier.epsilon *= self.scale.powi(dim as i32);
        Problem {
            start: place(&problem.start),
            stations: stations.collect(),
            barrier,
            body,
            ..problem.clone()
        }
    }

    fn place(&self, p: &[f64], diagonal: f64) -> Vec<f64> {
        let p: Vec<f64> = p.iter().map(|x| self.scale * x).collect();
        let (sin, cos) = self.turn.sin_cos();
        let mut turned = match p[..] {
            [x, y] => vec![cos * x - sin * y, sin * x + cos * y],
            // Rodrigues about (1, 1, 1)/√3.
            [x, y, z] => {
                let along = (x + y + z) / 3.0 * (1.0 - cos);
                let across = sin / 3.0_f64.sqrt();
                vec![
                    cos * x + across * (z - y) + along,
                    cos * y + across * (x - z) + along,
                    cos * z + across * (y - x) + along,
                ]
            }
            _ => p,
        };
        turned[0] += self.shift * diagonal;
        turned
    }

    fn ordered<T: Copy>(&self, elements: &[T]) -> Vec<T> {
        let mut elements = elements.to_vec();
        let count = elements.len();
        elements.rotate_left(self.first % count);
        elements
    }
}

/// Of the box around a body.
fn diagonal(body: &Body) -> f64 {
    let dim = body.dim();
    let side = |k: usize| {
        let places = || body.rest.iter().skip(k).step_by(dim).copied();
        places().fold(f64::NEG_INFINITY, f64::max) - places().fold(f64::INFINITY, f64::min)
    };
    (0..dim).map(|k| side(k).powi(2)).sum::<f64>().sqrt()
}
