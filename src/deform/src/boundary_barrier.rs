//! Barrier that keeps the boundary of a map of the plane from crossing itself.
//!
//! A map without inverted triangles is bijective as long as its boundary does not meet itself, and a boundary that
//! moves continuously first meets itself where one of its vertices touches one of its edges. So besides the barrier of
//! elements there is one for such pairs: zero while they are apart, infinite as their distance goes to zero. With steps
//! that end before the first contact no iterate has crossed: that is decided along the whole step (`term`), not at
//! its ends.
//!
//! The set of near pairs changes as the map moves, and with it the pattern of the Hessian. The pattern is neither
//! approximated nor kept: pairs have full blocks, a search finds them anew at every point, and when a pair comes near
//! that the pattern lacks, the pattern is analyzed again with all pairs within twice the support, so that this is rare
//! ([`Term::renew`]).
//!
//! From: Smith and Schaefer 2015, Bijective Parameterization with Free Boundaries, with Newton's method in the place of
//! theirs and the support of each pair no wider than its distance at the start, so that nothing moves where nothing
//! pulls. The time of contact is that of Li, Kaufman, Jiang 2021, Codimensional Incremental Potential Contact:
//! conservative under rounding.
//!
//! [`Term::renew`]: unwrapd_method::energy::Term::renew

use unwrapd_maps::mesh::boundary_edges;
use unwrapd_maps::plane::BoxIndex;
use unwrapd_method::barrier::InverseSpline;
use unwrapd_method::energy::{Assembly, Guard, Term};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, widened};
use unwrapd_method::numerics::stencils::Stencils;
use unwrapd_method::numerics::vec2::{cross, dot, sub};

// The sum of the barrier over pairs.

/// Largest support, in units of the boundary's mean edge: less than the distance of ordinary vertices.
const SUPPORT: f64 = 0.25;

/// Pairs up to this many times their support apart are in the pattern, so that most pairs that come near are there
/// already.
const FORESIGHT: f64 = 2.0;

/// Σ over the pairs of a boundary vertex and a boundary edge of φ(distance): infinite where they meet.
///
/// ```text
/// φ(d) = β (1/g(y) − 1)   for y < 1, 0 above     y = d/d⁰     g(y) = y³ − 3y² + 3y
/// ```
/// [`InverseSpline`] of the distance; d⁰ is a quarter of the boundary's mean edge, or the distance of the pair at the
/// start if that is less. Minimum 0, at the start and wherever nothing is near. Domain: d > 0, connected with the
/// start. Twice continuously differentiable except where the nearest point of the edge reaches an end. Tests:
/// `bijective::taylor_*`, `bijective::no_step_passes_through`.
#[derive(Clone, Debug)]
pub struct BoundaryBarrier {
    edges: Vec<[u32; 2]>,
    start: Vec<f64>,
    support: f64,
    beta: f64,
    /// Pairs in the pattern, in increasing order.
    pairs: Vec<Pair>,
}

impl BoundaryBarrier {
    /// Creates the barrier around `triangles`, which neither overlap nor touch with their vertices at `start`.
    pub fn new(triangles: &[[u32; 3]], start: &[f64]) -> Self {
        let edges = boundary_edges(start.len() / 2, triangles);
        let mean = edges
            .iter()
            .map(|[a, b]: &[u32; 2]| {
                let [x, y] = sub(place(start, *a), place(start, *b));
                x.hypot(y)
            })
            .sum::<f64>()
            / edges.len().max(1) as f64;
        Self {
            support: SUPPORT * mean,
            start: start.to_vec(),
            beta: 0.0,
            pairs: Vec::new(),
            edges,
        }
    }

    /// Changes the strength to β.
    #[must_use]
    pub fn with_beta(&self, beta: f64) -> Self {
        Self {
            beta,
            ..self.clone()
        }
    }

    /// Returns φ for a pair.
    fn spline(&self, pair: &Pair) -> InverseSpline {
        InverseSpline {
            beta: self.beta,
            s: self
                .support
                .min(Gap::new(pair.places(&self.start)).distance),
            epsilon: 0.0,
        }
    }

    /// Visits the pairs that are nearer at `x` than `times` their support.
    fn near(&self, x: &[f64], times: f64, mut visit: impl FnMut(Pair, &InverseSpline, Gap)) {
        near_pairs(&self.edges, x, x, times * self.support, |pair| {
            let gap = Gap::new(pair.places(x));
            if gap.distance < times * self.support {
                let spline = self.spline(&pair);
                if gap.distance < times * spline.s || gap.distance == 0.0 {
                    visit(pair, &spline, gap);
                }
            }
        });
    }
}

impl Term for BoundaryBarrier {
    fn dim(&self) -> usize {
        2
    }

    fn stencils(&self) -> Stencils {
        let vertices = self.pairs.iter().flat_map(|pair| {
            let mut vertices = pair.vertices();
            vertices.sort_unstable();
            vertices
        });
        Stencils::uniform(3, vertices)
    }

    fn renew(&mut self, x: &[f64]) -> bool {
        let mut is_missing = false;
        self.near(x, 1.0, |pair, _, _| {
            is_missing |= self.pairs.binary_search(&pair).is_err();
        });
        if is_missing {
            let mut pairs = Vec::new();
            self.near(x, FORESIGHT, |pair, _, _| pairs.push(pair));
            pairs.sort_unstable();
            self.pairs = pairs;
        }
        is_missing
    }

    fn value(&self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.near(x, 1.0, |_, spline, gap| {
            sum += spline.value(gap.distance, 1.0);
        });
        sum
    }

    fn barrier(&self, x: &[f64]) -> f64 {
        self.value(x)
    }

    fn add_derivatives(&self, x: &[f64], tau: f64, assembly: &mut Assembly) {
        for (stencil, pair) in self.pairs.iter().enumerate() {
            let gap = Gap::new(pair.places(x));
            let spline = self.spline(pair);
            if gap.distance < spline.s {
                let derivatives = spline.derivatives(gap.distance, 1.0);
                add(pair, stencil, &gap, derivatives, tau, assembly);
            }
        }
    }

    fn largest_step(&self, x: &[f64], direction: &[f64]) -> f64 {
        time_of_contact(&self.edges, x, direction, self.support)
    }
}

/// Adds the derivatives of one summand.
fn add(
    pair: &Pair,
    stencil: usize,
    gap: &Gap,
    derivatives: [f64; 2],
    tau: f64,
    assembly: &mut Assembly,
) {
    let vertices = pair.vertices();
    for (vertex, gradient) in vertices.iter().zip(gap.gradient(derivatives[0])) {
        assembly.add_gradient(*vertex, &gradient);
    }
    // Sum the modes to blocks; negative curvature is scaled by τ.
    let modes = gap.modes(derivatives);
    let block = |i: usize, j: usize| {
        let mut block = [[0.0; 2]; 2];
        for (lambda, u) in &modes {
            let lambda = lambda.max(tau * lambda);
            for r in 0..2 {
                for c in 0..2 {
                    block[r][c] += lambda * u[i][r] * u[j][c];
                }
            }
        }
        block
    };
    // Add the blocks in the order of the stencil, whose vertices increase.
    let mut order = [0, 1, 2];
    order.sort_unstable_by_key(|&i| vertices[i]);
    for (k, &i) in order.iter().enumerate() {
        assembly.add_diagonal(vertices[i], &block(i, i));
        for (l, &j) in order[..k].iter().enumerate() {
            assembly.add_pair(stencil, k * (k - 1) / 2 + l, &block(i, j));
        }
    }
}

// Largest step before a boundary meets itself.

/// Longest step that is ever asked for: twice a Newton step.
const LONGEST: f64 = 2.0;

/// Growth of the searched part of a step while it has no contact.
const GROWTH: f64 = 4.0;

/// Least share of a distance left at the reported contact; at most twice that.
const LEFT: f64 = 0.1;

/// Most advances. Each is safe, so a pair that slides for long only gets a shorter step.
const MOST_ADVANCES: usize = 100;

/// Returns a time t > 0 before which no pair of a boundary meets when its vertices move from `x` along `direction`; +∞
/// if none does up to [`LONGEST`]. At most a fifth short of the first contact, unless a pair slides.
///
/// Searches piece by piece, the first no longer than `reach`, so that a long direction does not sweep over everything.
fn time_of_contact(edges: &[[u32; 2]], x: &[f64], direction: &[f64], reach: f64) -> f64 {
    let motion = relative(edges, direction);
    let speeds = edges.iter().map(|e| norm(place(&motion, e[0])));
    let fastest = speeds.fold(0.0, f64::max);
    if fastest == 0.0 {
        return f64::INFINITY;
    }
    let mut horizon = (reach / fastest).min(LONGEST);
    loop {
        let to: Vec<f64> = (x.iter().zip(&motion))
            .map(|(x, d)| x + horizon * d)
            .collect();
        let mut first = horizon;
        // Enlarge the boxes a little, so that rounding hides no contact.
        near_pairs(edges, x, &to, 1e-6 * reach, |pair| {
            first = contact_before(first, pair.places(x), pair.places(&motion));
        });
        if first < horizon {
            return first;
        }
        if horizon >= LONGEST {
            return f64::INFINITY;
        }
        horizon = (GROWTH * horizon).min(LONGEST);
    }
}

/// Subtracts the mean motion of the boundary, which brings nothing nearer.
fn relative(edges: &[[u32; 2]], direction: &[f64]) -> Vec<f64> {
    let mut mean = [0.0; 2];
    for edge in edges {
        let d = place(direction, edge[0]);
        for k in 0..2 {
            mean[k] += d[k] / edges.len() as f64;
        }
    }
    let mut motion = direction.to_vec();
    for d in motion.as_chunks_mut::<2>().0 {
        *d = [d[0] - mean[0], d[1] - mean[1]];
    }
    motion
}

/// Returns a time before the vertex and the edge of a pair meet if that is less than `most`, else `most`.
///
/// In a time t the distance falls by at most t times the greatest relative speed, so each advance by what this allows
/// is safe.
fn contact_before(most: f64, places: [[f64; 2]; 3], motion: [[f64; 2]; 3]) -> f64 {
    let mean = [0, 1].map(|k| (motion[0][k] + motion[1][k] + motion[2][k]) / 3.0);
    let motion = motion.map(|d| [d[0] - mean[0], d[1] - mean[1]]);
    let speed = norm(motion[0]) + norm(motion[1]).max(norm(motion[2]));
    let distance_at = |t: f64| {
        let moved = [0, 1, 2].map(|i| [0, 1].map(|k| places[i][k] + t * motion[i][k]));
        Gap::new(moved).distance
    };
    let mut distance = distance_at(0.0);
    let left = LEFT * distance;
    let mut time = 0.0;
    for _ in 0..MOST_ADVANCES {
        let advanced = time + (distance - left) / speed;
        if advanced >= most || advanced.is_nan() {
            return most;
        }
        time = advanced;
        distance = distance_at(time);
        if distance < 2.0 * left {
            break;
        }
    }
    time
}

fn norm([x, y]: [f64; 2]) -> f64 {
    x.hypot(y)
}

// Distance of a vertex from an edge, with first and second derivatives of functions of it.

/// The vector from the nearest point of an edge to a vertex.
///
/// Continuously differentiable in all three positions while its length is positive; the second derivative jumps where
/// the nearest point reaches an end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub distance: f64,
    /// Direction, of length 1.
    normal: [f64; 2],
    /// Direction across it: that of the edge, if the nearest point is not an end.
    tangent: [f64; 2],
    /// Derivatives of the distance along the normal with respect to the vertex and the ends of the edge.
    weights: [f64; 3],
    /// One over the edge's length; `None` if the nearest point is an end.
    curvature: Option<f64>,
}

/// A summand λuuᵀ of a Hessian, with u given at the vertex and the ends of the edge.
pub(super) type GapCurvature = (f64, [[f64; 2]; 3]);

impl Gap {
    /// Computes the gap between the vertex at `p` and the edge from `a` to `b`.
    pub fn new([p, a, b]: [[f64; 2]; 3]) -> Self {
        let (edge, arm) = (sub(b, a), sub(p, a));
        let length_squared = dot(edge, edge);
        let along = dot(arm, edge);
        if along <= 0.0 {
            return Self::to_end(arm, [1.0, -1.0, 0.0]);
        }
        if along >= length_squared {
            return Self::to_end(sub(p, b), [1.0, 0.0, -1.0]);
        }
        let length = length_squared.sqrt();
        let height = cross(edge, arm) / length;
        let side = 1.0_f64.copysign(height);
        let tangent = edge.map(|x| x / length);
        let share = along / length_squared;
        Self {
            distance: height.abs(),
            normal: [-side * tangent[1], side * tangent[0]],
            tangent,
            weights: [1.0, share - 1.0, -share],
            curvature: Some(1.0 / length),
        }
    }

    fn to_end(arm: [f64; 2], weights: [f64; 3]) -> Self {
        let distance = arm[0].hypot(arm[1]);
        let normal = arm.map(|x| x / distance);
        Self {
            distance,
            normal,
            tangent: [-normal[1], normal[0]],
            weights,
            curvature: None,
        }
    }

    /// Returns the gradient of a function of the distance with the derivative `first`.
    pub fn gradient(&self, first: f64) -> [[f64; 2]; 3] {
        self.weights.map(|w| self.normal.map(|n| first * w * n))
    }

    /// Returns the Hessian of a function of the distance with these derivatives, the first of them negative or zero.
    ///
    /// Let q be the weighted moves, h = n·q and k = τ·q along normal and edge, and θ the turn of the edge. The Hessian
    /// is φ″h² + φ′(k²/d) at an end and φ″h² − φ′(2θk + dθ²) along the edge. k and θ are orthogonal, so the
    /// eigenvectors of the part with φ′ are known.
    pub fn modes(&self, [first, second]: [f64; 2]) -> [GapCurvature; 3] {
        let spread = |direction: [f64; 2], weights: [f64; 3], factor: f64| {
            weights.map(|w| direction.map(|x| factor * w * x))
        };
        let pushing = (second, spread(self.normal, self.weights, 1.0));
        // At an end of the edge the second mode slides around that end.
        let Some(curvature) = self.curvature else {
            let sliding = spread(self.tangent, self.weights, 1.0);
            return [
                pushing,
                (first / self.distance, sliding),
                (0.0, [[0.0; 2]; 3]),
            ];
        };
        // Along the edge sliding and turning are coupled: find the eigenvectors of the part with φ′ in closed form.
        let norm = self.weights.iter().map(|w| w * w).sum::<f64>().sqrt();
        let sliding = spread(self.tangent, self.weights, 1.0 / norm);
        let turning = spread(self.normal, [0.0, -1.0, 1.0], 0.5_f64.sqrt());
        let mixed = 2.0_f64.sqrt() * norm * curvature;
        let half = self.distance * curvature * curvature;
        let root = half.hypot(mixed);
        let mode = |lambda: f64| {
            let length = lambda.hypot(mixed);
            let (c, s) = (mixed / length, lambda / length);
            let mix = |k: usize| [0, 1].map(|i| c * sliding[k][i] + s * turning[k][i]);
            (-first * lambda, [mix(0), mix(1), mix(2)])
        };
        [
            pushing,
            mode(half + root),
            mode(-mixed * mixed / (half + root)),
        ]
    }
}

// Search for boundary vertices near boundary edges.

/// A vertex of a boundary and an edge of it that does not end there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub vertex: u32,
    pub edge: [u32; 2],
}

impl Pair {
    /// Returns the vertex and the ends of the edge.
    pub fn vertices(&self) -> [u32; 3] {
        [self.vertex, self.edge[0], self.edge[1]]
    }

    /// Returns the positions of these.
    pub fn places(&self, x: &[f64]) -> [[f64; 2]; 3] {
        self.vertices().map(|v| place(x, v))
    }
}

pub(super) fn place(x: &[f64], vertex: u32) -> [f64; 2] {
    let first = 2 * vertex as usize;
    [x[first], x[first + 1]]
}

/// Visits every pair whose distance may fall below `radius` while the vertices move from `x` to `to`, in a fixed order.
///
/// Boundaries are closed, so that each vertex is the first of an edge; one at which several meet is visited for each.
fn near_pairs(edges: &[[u32; 2]], x: &[f64], to: &[f64], radius: f64, mut visit: impl FnMut(Pair)) {
    let swept = |edge: &[u32; 2]| {
        let [a, b] = *edge;
        let ends = [place(x, a), place(x, b), place(to, a), place(to, b)];
        widened(bounds_of(&ends), 0.5 * radius)
    };
    let boxes: Vec<Bounds> = edges.iter().map(swept).collect();
    // Without a budget: an edge that was left out could be crossed.
    BoxIndex::new(&boxes).pairs(u64::MAX, |i, j| {
        for (i, j) in [(i, j), (j, i)] {
            let (vertex, edge) = (edges[i as usize][0], edges[j as usize]);
            if !edge.contains(&vertex) {
                visit(Pair { vertex, edge });
            }
        }
    });
}
