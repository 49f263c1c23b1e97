//! Untangling of a start with inverted elements, moving as little of it as possible.
//!
//! The vertices around inverted elements move to a minimum of an energy that is finite where elements are inverted
//! ([`FoldoverFree`]); all others stay fixed. If that does not help, wider rings of vertices may move, at last all.
//! Between rounds ε falls as fast as the worst element allows. Once all elements are positive, ε = 0 gives them decent
//! shapes.
//!
//! From: Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021, Foldover-free maps in 50 lines of code; there by
//! quasi-Newton steps for the whole mesh at once, here by projected Newton.

use super::body::{Body, BodyElements};
use unwrapd_maps::mesh::UsedVertices;
use unwrapd_method::barrier::NoBarrier;
use unwrapd_method::energy::{FoldoverFree, Term, Tetrahedra, Triangles};
use unwrapd_method::numerics::predicates::{orient2d_sign, orient3d_sign};
use unwrapd_method::solver::{Control, Iterate, Objective, Settings, minimize};

/// Rings of vertices around bad elements that may move at first, and the factor after each failure. Fewer move less of
/// the map, more need fewer attempts.
const RINGS: usize = 2;
const WIDENING: usize = 3;

/// Most changes of ε before more vertices may move.
const ROUNDS: usize = 60;

/// Newton steps in a round, and at the end.
const STEPS: usize = 20;
const LAST_STEPS: usize = 50;

/// Regularized determinant of the worst element in the first round: a tenth of an ordinary element's.
const FIRST: f64 = 0.1;

/// λ and the largest ε. An element that has shrunk to a point costs λ/ε, at least 4, one at rest less than 1 + λ, 3: if
/// the former were smaller, a body that nothing holds would vanish.
const SIZE: f64 = 2.0;
const LARGEST: f64 = 0.5;

/// Smallest and largest share of the energy that a round is taken to have gained, so that ε falls even after no gain,
/// and not all at once after a complete one.
const GAINS: [f64; 2] = [0.1, 0.9];

/// Returns the indices of elements that are inverted, empty, or of a determinant of at most `floor` with the vertices
/// at `x`.
pub(super) fn bad_elements(body: &Body, x: &[f64], floor: f64) -> Vec<usize> {
    let determinants = body.determinants_at(x);
    let is_positive = |element: usize| match &body.elements {
        BodyElements::Triangles { corners, .. } => {
            let [a, b, c] = corners[element].map(|v| place::<2>(x, v));
            orient2d_sign(a, b, c) > 0
        }
        BodyElements::Tetrahedra { corners, .. } => {
            let [a, b, c, d] = corners[element].map(|v| place::<3>(x, v));
            orient3d_sign(a, b, c, d) > 0
        }
    };
    let is_good = |element: usize| determinants[element] > floor && is_positive(element);
    (0..determinants.len()).filter(|&e| !is_good(e)).collect()
}

fn place<const D: usize>(x: &[f64], vertex: u32) -> [f64; D] {
    std::array::from_fn(|k| x[D * vertex as usize + k])
}

/// Finds positions near `x` with every determinant above `floor` and the vertices `held` fixed; returns `None` if it
/// fails.
///
/// Vertices outside the rings around bad elements that had to move stay bit for bit.
pub(super) fn untangled(body: &Body, x: &[f64], held: &[u32], floor: f64) -> Option<Vec<f64>> {
    if !x.iter().all(|x| x.is_finite()) {
        return None;
    }
    let bad = bad_elements(body, x, floor);
    // Free wider and wider rings around the bad elements.
    let mut rings = RINGS;
    loop {
        let mut is_free = around(body, &bad, rings);
        let is_all = is_free.iter().all(|&free| free);
        for &v in held {
            is_free[v as usize] = false;
        }
        let mut moved = x.to_vec();
        Patch::new(body, &is_free).untangle(&mut moved);
        if bad_elements(body, &moved, floor).is_empty() {
            return Some(moved);
        }
        if is_all {
            return None;
        }
        rings *= WIDENING;
    }
}

/// Marks the vertices of these elements and `rings` rings around them.
fn around(body: &Body, elements: &[usize], rings: usize) -> Vec<bool> {
    let corners = body.corners();
    let mut is_near = vec![false; body.n_vertices()];
    for &element in elements {
        for &v in corners[element] {
            is_near[v as usize] = true;
        }
    }
    for _ in 0..rings {
        let before = is_near.clone();
        for element in &corners {
            if element.iter().any(|&v| before[v as usize]) {
                for &v in *element {
                    is_near[v as usize] = true;
                }
            }
        }
        if is_near == before {
            // The remaining vertices belong to another part or to no element.
            return vec![true; is_near.len()];
        }
    }
    is_near
}

/// The elements around vertices that may move, with their own numbering of vertices.
struct Patch {
    /// Index in the body of each vertex.
    vertices: Vec<u32>,
    /// Vertices that stay fixed, in this numbering.
    fixed: Vec<u32>,
    elements: BodyElements,
}

impl Patch {
    fn new(body: &Body, is_free: &[bool]) -> Self {
        let corners = body.corners();
        let has_free = |element: &&[u32]| element.iter().any(|&v| is_free[v as usize]);
        let kept: Vec<usize> = (0..corners.len())
            .filter(|&e| has_free(&corners[e]))
            .collect();
        let used = kept.iter().flat_map(|&e| corners[e].iter().copied());
        let vertices = UsedVertices::new(used);
        let elements = match &body.elements {
            BodyElements::Triangles { corners, rest } => BodyElements::Triangles {
                corners: part(&kept, corners, &vertices),
                rest: kept.iter().map(|&e| rest[e]).collect(),
            },
            BodyElements::Tetrahedra { corners, rest } => BodyElements::Tetrahedra {
                corners: part(&kept, corners, &vertices),
                rest: kept.iter().map(|&e| rest[e]).collect(),
            },
        };
        let vertices = vertices.into_vec();
        Self {
            fixed: (0..vertices.len() as u32)
                .filter(|v: &u32| !is_free[vertices[*v as usize] as usize])
                .collect(),
            vertices,
            elements,
        }
    }

    /// Moves the free vertices in `x` until all elements of the patch are positive, if it can.
    fn untangle(&self, x: &mut [f64]) {
        let mut own: Vec<f64> = self.coordinates().map(|i| x[i]).collect();
        let mut objective = Objective::new(self.vertices.len(), self.term(0.0));
        objective.fix(&self.fixed);
        let mut worst = FIRST;
        for _ in 0..ROUNDS {
            let smallest = objective.smallest(&own);
            // Once all are positive, give them good shapes.
            if smallest > 0.0 {
                objective.exchange(vec![self.term(0.0)]);
                descend(&mut objective, &mut own, LAST_STEPS);
                break;
            }
            // With this ε the worst element's regularized determinant is `worst`.
            let epsilon = (2.0 * (worst * (worst - smallest)).sqrt()).min(LARGEST);
            objective.exchange(vec![self.term(epsilon)]);
            let gain = descend(&mut objective, &mut own, STEPS).clamp(GAINS[0], GAINS[1]);
            worst = (1.0 - gain) * density(epsilon).regularized(objective.smallest(&own));
        }
        for (i, own) in self.coordinates().zip(own) {
            x[i] = own;
        }
    }

    /// Iterates over the indices of the patch's coordinates among those of the body.
    fn coordinates(&self) -> impl Iterator<Item = usize> {
        let dim = match self.elements {
            BodyElements::Triangles { .. } => 2,
            BodyElements::Tetrahedra { .. } => 3,
        };
        let first = self.vertices.iter().map(move |&v| dim * v as usize);
        first.flat_map(move |first| first..first + dim)
    }

    fn term(&self, epsilon: f64) -> Box<dyn Term> {
        let density = density(epsilon);
        match &self.elements {
            BodyElements::Triangles { corners, rest } => {
                Box::new(Triangles::new(corners, rest, density, NoBarrier))
            }
            BodyElements::Tetrahedra { corners, rest } => {
                Box::new(Tetrahedra::new(corners, rest, density, NoBarrier))
            }
        }
    }
}

/// Returns some of the elements in the patch's numbering of vertices.
fn part<const N: usize>(
    kept: &[usize],
    elements: &[[u32; N]],
    vertices: &UsedVertices,
) -> Vec<[u32; N]> {
    let mut part: Vec<[u32; N]> = kept.iter().map(|&e| elements[e]).collect();
    vertices.renumber(part.as_flattened_mut());
    part
}

fn density(epsilon: f64) -> FoldoverFree {
    FoldoverFree {
        epsilon,
        lambda: SIZE,
    }
}

/// Takes at most `steps` steps of minimization; returns the decrease as a share of the energy.
fn descend(objective: &mut Objective, x: &mut [f64], steps: usize) -> f64 {
    let settings = Settings {
        max_iterations: steps,
        ..Settings::draft()
    };
    let summary = minimize(objective, x, &settings, &|_: &Iterate| Control::Continue);
    1.0 - summary.energy_last / summary.energy_first
}
