//! An energy of one's own that does not know directions: three functions of the singular values.
//!
//! `cargo run --release --example own_density`

use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::{Density, RestShape, Triangles};
use unwrapd_method::numerics::square::Matrix;
use unwrapd_method::solver::{Control, Handles, Iterate, Objective, Settings, follow};

/// ψ = Σᵢ cosh(k(σᵢ − 1)) − 1: soft near rest, stiff far from it.
struct Stiffening {
    k: f64,
}

impl<const D: usize> Density<D> for Stiffening {
    fn floor(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn value(&self, sigma: &[f64; D]) -> f64 {
        sigma
            .iter()
            .map(|s| (self.k * (s - 1.0)).cosh() - 1.0)
            .sum()
    }

    fn gradient(&self, sigma: &[f64; D]) -> [f64; D] {
        sigma.map(|s| self.k * (self.k * (s - 1.0)).sinh())
    }

    fn hessian(&self, sigma: &[f64; D]) -> Matrix<D> {
        let mut hessian = [[0.0; D]; D];
        for i in 0..D {
            hessian[i][i] = self.k * self.k * (self.k * (sigma[i] - 1.0)).cosh();
        }
        hessian
    }
}

fn main() {
    // A strip of 10 × 1 squares, two triangles each.
    let vertices: Vec<[f64; 2]> = (0..22)
        .map(|v| [f64::from(v / 2), f64::from(v % 2)])
        .collect();
    let triangles: Vec<[u32; 3]> = (0..10)
        .flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]])
        .collect();
    let edge = |a: u32, b: u32| [0, 1].map(|k| vertices[b as usize][k] - vertices[a as usize][k]);
    let rest: Vec<RestShape> = (triangles.iter())
        .map(|&[a, b, c]| RestShape::from_edges(edge(a, b), edge(a, c)))
        .collect();
    let barrier = Barrier {
        kind: BarrierKind::InverseSpline,
        beta: 0.01,
        s: 1.0,
        epsilon: 1e-5,
    };
    let energy = Triangles::new(&triangles, &rest, Stiffening { k: 2.0 }, barrier);
    let mut objective = Objective::new(vertices.len(), Box::new(energy));

    // The left end stays, the right end comes over it.
    let handles = Handles {
        vertices: vec![0, 1, 20, 21],
        targets: vec![0.0, 0.0, 0.0, 1.0, 3.0, 4.0, 3.0, 3.0],
        groups: vec![0, 0, 1, 1],
        ..Handles::default()
    };
    let mut x = vertices.as_flattened().to_vec();
    let watch = |i: &Iterate| {
        println!(
            "{:3} energy {:.6} smallest {:.3}",
            i.iteration, i.energy, i.smallest
        );
        Control::Continue
    };
    let summary = follow::<2>(
        &mut objective,
        &mut x,
        &[handles],
        &Settings::follow(),
        &watch,
    );
    println!("{:?}", summary.expect("handles of the strip"));
}
