//! Energies of one's own that know directions, as terms beside a barrier: a target Jacobian for each triangle, and springs
//! between vertices.
//!
//! `cargo run --release --example own_term`

use unwrapd_method::barrier::{Barrier, BarrierKind};
use unwrapd_method::energy::{Assembly, RestShape, Term, Triangles, Zero};
use unwrapd_method::numerics::square::{Matrix, identity};
use unwrapd_method::numerics::stencils::Stencils;
use unwrapd_method::solver::{Control, Iterate, Objective, Settings, minimize};

/// ½ Σ A‖J − T‖²: every triangle wants a Jacobian of its own. Quadratic, so its Hessian needs no projection.
struct TargetJacobians {
    elements: Vec<Element>,
}

struct Element {
    /// In increasing order.
    vertices: [u32; 3],
    /// Of their barycentric coordinates.
    gradients: [[f64; 2]; 3],
    area: f64,
    target: Matrix<2>,
}

impl Element {
    /// J − T.
    fn gap(&self, x: &[f64]) -> Matrix<2> {
        let entry = |r: usize, c: usize| {
            let corners = self.vertices.iter().zip(&self.gradients);
            let sum: f64 = corners.map(|(&v, g)| x[2 * v as usize + r] * g[c]).sum();
            sum - self.target[r][c]
        };
        [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
    }
}

impl TargetJacobians {
    fn new(
        triangles: &[[u32; 3]],
        rest: &[RestShape],
        target: impl Fn(usize) -> Matrix<2>,
    ) -> Self {
        let element = |(i, (triangle, rest)): (usize, (&[u32; 3], &RestShape))| {
            let [g, h] = rest.inverse;
            let gradients = [[-g[0] - h[0], -g[1] - h[1]], g, h];
            let mut order = [0, 1, 2];
            order.sort_unstable_by_key(|&k: &usize| triangle[k]);
            Element {
                vertices: order.map(|k| triangle[k]),
                gradients: order.map(|k| gradients[k]),
                area: rest.size,
                target: target(i),
            }
        };
        let elements = triangles.iter().zip(rest).enumerate().map(element);
        Self {
            elements: elements.collect(),
        }
    }
}

impl Term for TargetJacobians {
    fn dim(&self) -> usize {
        2
    }

    fn stencils(&self) -> Stencils {
        Stencils::uniform(3, self.elements.iter().flat_map(|e| e.vertices))
    }

    fn value(&self, x: &[f64]) -> f64 {
        let share = |e: &Element| {
            let gap = e.gap(x);
            0.5 * e.area * gap.as_flattened().iter().map(|g| g * g).sum::<f64>()
        };
        self.elements.iter().map(share).sum()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (index, e) in self.elements.iter().enumerate() {
            let gap = e.gap(x);
            let mut pair = 0;
            for (j, g) in e.gradients.iter().enumerate() {
                let slope = gap.map(|row| e.area * (row[0] * g[0] + row[1] * g[1]));
                assembly.add_gradient(e.vertices[j], &slope);
                let dot = |h: &[f64; 2]| e.area * (g[0] * h[0] + g[1] * h[1]);
                assembly.add_diagonal(e.vertices[j], &identity::<2>(dot(g)));
                for h in &e.gradients[..j] {
                    assembly.add_pair(index, pair, &identity::<2>(dot(h)));
                    pair += 1;
                }
            }
        }
    }
}

/// ½ k Σ ‖xᵢ − xⱼ − r‖² over pairs of vertices: couples what no triangle does.
struct Springs {
    pairs: Vec<[u32; 2]>,
    rest: [f64; 2],
    k: f64,
}

impl Term for Springs {
    fn dim(&self) -> usize {
        2
    }

    fn stencils(&self) -> Stencils {
        Stencils::uniform(2, self.pairs.iter().flatten().copied())
    }

    fn value(&self, x: &[f64]) -> f64 {
        let stretch = |[i, j]: &[u32; 2]| -> f64 {
            let gap =
                [0, 1].map(|c| x[2 * *i as usize + c] - x[2 * *j as usize + c] - self.rest[c]);
            0.5 * self.k * (gap[0] * gap[0] + gap[1] * gap[1])
        };
        self.pairs.iter().map(stretch).sum()
    }

    fn add_derivatives(&self, x: &[f64], _tau: f64, assembly: &mut Assembly) {
        for (index, &[i, j]) in self.pairs.iter().enumerate() {
            let gap = [0, 1].map(|c| x[2 * i as usize + c] - x[2 * j as usize + c] - self.rest[c]);
            assembly.add_gradient(i, &gap.map(|g| self.k * g));
            assembly.add_gradient(j, &gap.map(|g| -self.k * g));
            assembly.add_diagonal_identity(i, self.k);
            assembly.add_diagonal_identity(j, self.k);
            assembly.add_pair_identity(index, 0, -self.k);
        }
    }
}

fn main() {
    let side = 8;
    let at = |column: u32, row: u32| column * (side + 1) + row;
    let vertices: Vec<[f64; 2]> = (0..=side)
        .flat_map(|column| (0..=side).map(move |row| [f64::from(column), f64::from(row)]))
        .collect();
    let triangles: Vec<[u32; 3]> = (0..side)
        .flat_map(|c| (0..side).map(move |r| (c, r)))
        .flat_map(|(c, r)| {
            let [a, b, d, e] = [at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r + 1)];
            [[a, b, d], [a, d, e]]
        })
        .collect();
    let edge = |a: u32, b: u32| [0, 1].map(|k| vertices[b as usize][k] - vertices[a as usize][k]);
    let rest: Vec<RestShape> = (triangles.iter())
        .map(|&[a, b, c]| RestShape::from_edges(edge(a, b), edge(a, c)))
        .collect();
    // The left half is to be sheared, the right half turned; the lower edge is drawn to the upper one.
    let targets = TargetJacobians::new(&triangles, &rest, |i| {
        if i < triangles.len() / 2 {
            [[1.0, 0.8], [0.0, 1.0]]
        } else {
            [[0.6, -0.8], [0.8, 0.6]]
        }
    });
    let springs = Springs {
        pairs: (0..=side).map(|c| [at(c, 0), at(c, side)]).collect(),
        rest: [0.0, -2.0],
        k: 1.0,
    };
    let barrier = Barrier {
        kind: BarrierKind::InverseSpline,
        beta: 0.01,
        s: 1.0,
        epsilon: 1e-5,
    };
    let guard = Triangles::new(&triangles, &rest, Zero, barrier);
    let terms: Vec<Box<dyn Term>> = vec![Box::new(targets), Box::new(springs), Box::new(guard)];
    let mut objective = Objective::of_terms(vertices.len(), terms);
    let mut x = vertices.as_flattened().to_vec();
    let watch = |i: &Iterate| {
        println!(
            "{:3} energy {:.6} smallest {:.4}",
            i.iteration, i.energy, i.smallest
        );
        Control::Continue
    };
    let summary = minimize(&mut objective, &mut x, &Settings::normal(), &watch);
    println!("{summary:?}");
}
