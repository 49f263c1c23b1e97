//! Untangling of a start with inverted elements: held vertices stay exactly in place, the others move as little as
//! possible.
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
use unwrapd_method::solver::{
    Control, Iterate, Objective, Settings, Status, Summary, Watch, minimize,
};

/// Rings of vertices around bad elements that may move at first, and the factor after each failure. Fewer move less of
/// the map, more need fewer attempts.
const RINGS: usize = 2;
const WIDENING: usize = 3;

/// Most changes of ε before more vertices may move.
const ROUNDS: usize = 60;

/// Least share of its inversion that the worst element of a patch loses in each round; more vertices may move if it
/// loses less. A patch that can be untangled takes one or two rounds, one that its surroundings keep tangled would use
/// up all of them. Once all vertices may move, there is nothing to give up for.
const LEAST_GAIN: f64 = 0.1;

/// Newton steps in a round, and at the end. A round that ends before its minimum lets ε fall too early: with 20 steps a
/// sheet laid along a spiral of 1.6 turns stayed tangled that takes four rounds with 60.
const STEPS: usize = 60;
const LAST_STEPS: usize = 50;

/// Regularized determinant of the worst element in the first round: a tenth of an ordinary element's.
const FIRST: f64 = 0.1;

/// λ and, where some of the boundary is free, the largest ε. An element that has shrunk to a point costs λ/ε, at least
/// 4, one at rest less than 1 + λ, 3: if the former were smaller, a body that nothing holds would vanish. A fixed
/// boundary keeps the size within, and a bound would only make the first energies steep.
const SIZE: f64 = 2.0;
const LARGEST: f64 = 0.5;

/// Smallest and largest share of the energy that a round is taken to have gained, so that ε falls even after no gain,
/// and not all at once after a complete one. The paper's least gain is a tenth; after a round of Newton steps, which
/// come nearer to the minimum than those of a quasi-Newton method, a half needs a quarter of the rounds.
const GAINS: [f64; 2] = [0.5, 0.9];

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

/// Reason why no positions without inversions were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum StillFolded {
    /// All vertices that are not held were moved in vain.
    Failed,
    /// The watcher ended the work.
    Stopped,
}

/// Watches nothing.
pub(super) fn unwatched(_: &Iterate) -> Control {
    Control::Continue
}

/// Finds positions near `x` with every determinant above `floor` and the vertices `held` fixed.
///
/// Vertices outside the rings around bad elements that had to move stay bit for bit, and so do the held ones. Ended by its watcher, it
/// returns the positions only if no element is inverted by then.
pub(super) fn untangled(
    body: &Body,
    x: &[f64],
    held: &[u32],
    floor: f64,
    watch: &dyn Watch,
) -> Result<Vec<f64>, StillFolded> {
    if !x.iter().all(|x| x.is_finite()) {
        return Err(StillFolded::Failed);
    }
    let bad = bad_elements(body, x, floor);
    // Free wider and wider rings around the bad elements; all vertices once most would move.
    let mut rings = RINGS;
    loop {
        let mut is_free = around(body, &bad, rings);
        let is_all = 2 * is_free.iter().filter(|&&free| free).count() > is_free.len();
        if is_all {
            is_free.fill(true);
        }
        for &v in held {
            is_free[v as usize] = false;
        }
        let mut moved = x.to_vec();
        let least_gain = if is_all {
            f64::NEG_INFINITY
        } else {
            LEAST_GAIN
        };
        let status = Patch::new(body, x, &is_free).untangle(&mut moved, least_gain, watch);
        if bad_elements(body, &moved, floor).is_empty() {
            return Ok(moved);
        }
        if status == Status::Stopped {
            return Err(StillFolded::Stopped);
        }
        if is_all {
            return Err(StillFolded::Failed);
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

/// The elements around vertices that may move, with their own numbering of vertices. Its rest shapes are scaled so that
/// it has its present size.
struct Patch {
    /// Index in the body of each vertex.
    vertices: Vec<u32>,
    /// Vertices that stay fixed, in this numbering.
    fixed: Vec<u32>,
    /// Largest ε.
    largest: f64,
    elements: BodyElements,
}

impl Patch {
    fn new(body: &Body, x: &[f64], is_free: &[bool]) -> Self {
        let corners = body.corners();
        let has_free = |element: &&[u32]| element.iter().any(|&v| is_free[v as usize]);
        let kept: Vec<usize> = (0..corners.len())
            .filter(|&e| has_free(&corners[e]))
            .collect();
        let used = kept.iter().flat_map(|&e| corners[e].iter().copied());
        let vertices = UsedVertices::new(used);
        let unit = present_unit(body, x, &kept);
        let elements = match &body.elements {
            BodyElements::Triangles { corners, rest } => BodyElements::Triangles {
                corners: part(&kept, corners, &vertices),
                rest: kept.iter().map(|&e| rest[e].in_unit(unit)).collect(),
            },
            BodyElements::Tetrahedra { corners, rest } => BodyElements::Tetrahedra {
                corners: part(&kept, corners, &vertices),
                rest: kept.iter().map(|&e| rest[e].in_unit(unit)).collect(),
            },
        };
        let vertices = vertices.into_vec();
        let is_fixed = |v: &u32| !is_free[vertices[*v as usize] as usize];
        let boundary = elements.boundary_vertices(vertices.len());
        Self {
            largest: if boundary.iter().all(is_fixed) {
                f64::INFINITY
            } else {
                LARGEST
            },
            fixed: (0..vertices.len() as u32).filter(is_fixed).collect(),
            vertices,
            elements,
        }
    }

    /// Moves the free vertices in `x` until all elements of the patch are positive, if it can. Gives up if the worst
    /// element loses less than the share `least_gain` of its inversion in a round. Returns the status of the last round.
    fn untangle(&self, x: &mut [f64], least_gain: f64, watch: &dyn Watch) -> Status {
        let mut own: Vec<f64> = self.coordinates().map(|i| x[i]).collect();
        let mut objective = Objective::new(self.vertices.len(), self.term(0.0));
        objective.fix(&self.fixed);
        let (mut worst, mut status) = (FIRST, Status::IterationLimit);
        for _ in 0..ROUNDS {
            let smallest = objective.smallest(&own);
            // Once all are positive, give them good shapes.
            if smallest > 0.0 {
                objective.exchange(vec![self.term(0.0)]);
                status = descend(&mut objective, &mut own, LAST_STEPS, watch).status;
                break;
            }
            // With this ε the worst element's regularized determinant is `worst`.
            let epsilon = (2.0 * (worst * (worst - smallest)).sqrt()).min(self.largest);
            objective.exchange(vec![self.term(epsilon)]);
            let summary = descend(&mut objective, &mut own, STEPS, watch);
            status = summary.status;
            let reached = objective.smallest(&own);
            if status == Status::Stopped || reached < (1.0 - least_gain) * smallest {
                break;
            }
            let gain = 1.0 - summary.energy_last / summary.energy_first;
            let gain = gain.clamp(GAINS[0], GAINS[1]);
            worst = (1.0 - gain) * density(epsilon).regularized(reached);
        }
        for (i, own) in self.coordinates().zip(own) {
            x[i] = own;
        }
        status
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

/// Returns the unit of length in which these elements at `x` have in total the signed size that they have at rest; 1 if
/// their size is not positive.
///
/// The energy prefers elements of their size at rest. Where vertices all around are held, the total size is that which
/// they enclose, whatever the others do.
fn present_unit(body: &Body, x: &[f64], elements: &[usize]) -> f64 {
    let total = |sizes: Vec<f64>| elements.iter().map(|&e| sizes[e]).sum::<f64>();
    let ratio = total(body.determinants_at(x)) / total(body.determinants());
    if ratio > 0.0 {
        ratio.powf(-1.0 / body.dim() as f64)
    } else {
        1.0
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

/// Takes at most `steps` steps of minimization.
fn descend(objective: &mut Objective, x: &mut [f64], steps: usize, watch: &dyn Watch) -> Summary {
    let settings = Settings {
        max_iterations: steps,
        ..Settings::draft()
    };
    minimize(objective, x, &settings, watch)
}
