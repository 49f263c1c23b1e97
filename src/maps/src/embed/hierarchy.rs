//! Coarse to fine: a map that cannot fail, and for large disks most of the path to the optimum.
//!
//! Vertices are collapsed level by level until Tutte's map of the remaining ones is safe, then put back in reverse
//! order. Each goes into the kernel of its ring, which is never empty: the neighbor onto which it was collapsed sees
//! the whole ring. Only floating point could still fail, when rings degenerate; so every level is optimized before the
//! next finer one is filled in, which keeps rings wide, and is cheap because levels shrink geometrically. The finest
//! level then has little left to do.
//!
//! From: the hierarchy of progressive embeddings (Shen, Jiang, Zorin, Panozzo 2019) turned around: all vertices, not
//! only those in bad triangles, and collapses in space rather than in the plane.

use super::decimate::{Care, Collapse, Collapses, Decimation};
use super::rest::{Least, rest_shape};
use super::star::{Corners, Star};
use super::triangulation::pairs;
use super::tutte::{ClosedDisk, first_bad_triangle, tutte};
use crate::mesh::{Disk, UsedVertices, VertexFaces};
use unwrapd_method::barrier::NoBarrier;
use unwrapd_method::energy::{RestShape, SymmetricDirichlet, Term, Triangles};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::vec2::{cross, dot, sub};
use unwrapd_method::numerics::vec3;
use unwrapd_method::solver::{
    Control, Iterate, Objective, Projection, Settings, best_scale, minimize,
};

/// Vertices of the coarsest level, if shape allows: few enough that Tutte's map of them is near the optimum even for a
/// surface with long arms.
const COARSEST: usize = 60;

/// Vertices of the coarsest level if only topology counts: Tutte's map of a handful of vertices is exact enough.
const FEWEST: usize = 8;

/// Share of vertices that a level keeps. A smaller share makes fewer levels, each farther from the next.
const SHARE: f64 = 0.3;

/// Weight of the triangles that fill holes, as a share of the weight of their area: just enough to keep holes open.
const VIRTUAL_WEIGHT: f64 = 1e-3;

/// Sweeps after the vertices of a level are back. Four halve the factorizations on the finest level, compared with one
/// or two: on a prototype, bimba_89k took 6, 4, 3 and 2 with 0, 1, 2 and 4 sweeps.
const SWEEPS: usize = 4;

/// Most Newton steps times vertices on a level, but never fewer than [`LEAST_STEPS`] steps: small levels get all the
/// steps they want, large ones the few they need if the coarser ones are good. 2,000 vertices get 100 steps, 40,000
/// and more get five.
const STEP_BUDGET: usize = 200_000;

/// Least number of steps per level; see [`STEP_BUDGET`].
const LEAST_STEPS: usize = 5;

/// Predicted gain of a Newton step, as a share of the energy, below which a level is done. With 1e-3, levels in which a
/// few stretched triangles make up the whole energy ended a millionfold above their optimum.
const STEP_GAIN: f64 = 1e-4;

/// Energy per weight of an optimized coarsest level beyond recovery: triangles that Tutte's map squeezed to nothing,
/// such as at the end of a tube behind a boundary of three vertices, are not widened again by Newton's method in
/// floating point. Good levels have 4 to 60; the one known bad one has 2e13.
const FAR: f64 = 2e3;

/// A mesh before some of its vertices were collapsed.
struct Level {
    triangles: Vec<(usize, [u32; 3])>,
    collapses: Collapses,
}

/// Returns a map of the closed disk, positive in every triangle, exactly, and near an optimum of the symmetric
/// Dirichlet energy.
///
/// `positions` are in the unit of the rest shapes. Returns `None` if floating point failed nevertheless; no mesh is
/// known for which it does.
pub(super) fn coarse_to_fine(
    closed: &ClosedDisk,
    positions: &[[f64; 3]],
    least: Least,
) -> Option<Vec<[f64; 2]>> {
    let shape = DiskShape { positions, least };
    let mut decimation = Decimation::new(positions, &closed.triangles, closed.n_real);
    let mut levels = Vec::new();
    // Coarsen as far as the shape allows, and map the coarsest level.
    coarsen(&mut decimation, COARSEST, Care::Shape, &mut levels);
    let mut coarsest = coarsest_map(closed, &decimation, &shape);
    // If Tutte's map squeezed it beyond recovery, coarsen on to a handful of vertices.
    if coarsest.as_ref().is_none_or(|map| map.mean_energy >= FAR) {
        coarsen(&mut decimation, FEWEST, Care::Topology, &mut levels);
        coarsest = coarsest_map(closed, &decimation, &shape);
    }
    let mut uv = coarsest?.uv;
    // Put the vertices back, level by level. The caller optimizes the finest level with its own energy.
    while let Some(level) = levels.pop() {
        reinsert(&level.collapses, &shape, &mut uv).ok()?;
        let system = System::new(&level.triangles, closed.n_real, &shape);
        system.sweep(&mut uv);
        if !levels.is_empty() {
            system.minimize(&mut uv);
        }
    }
    Some(uv)
}

/// Adds levels until `goal` vertices are left or none can be collapsed.
fn coarsen(decimation: &mut Decimation, goal: usize, care: Care, levels: &mut Vec<Level>) {
    loop {
        let n = decimation.triangulation.vertices().len();
        let next = ((SHARE * n as f64) as usize).max(goal);
        if next >= n {
            return;
        }
        let triangles = decimation.triangulation.triangles().collect();
        let collapses = decimation.coarsen(next, care);
        if collapses.list.is_empty() {
            return;
        }
        levels.push(Level {
            triangles,
            collapses,
        });
    }
}

/// A map of the remaining vertices; positions of collapsed ones are meaningless.
struct CoarsestMap {
    uv: Vec<[f64; 2]>,
    mean_energy: f64,
}

/// Returns Tutte's map of the remaining vertices, optimized.
fn coarsest_map(
    closed: &ClosedDisk,
    decimation: &Decimation,
    shape: &DiskShape,
) -> Option<CoarsestMap> {
    let triangles: Vec<_> = decimation.triangulation.triangles().collect();
    let system = System::new(&triangles, closed.n_real, shape);
    let disk = Disk::new(system.vertices.len(), system.triangles.clone()).ok()?;
    let positions: Vec<_> = (system.vertices.iter())
        .map(|&v| shape.positions[v as usize])
        .collect();
    let mut coarse = tutte(&ClosedDisk::new(&disk, &positions))?;
    let scale = best_scale(&|x| system.term.value(x), coarse.as_flattened());
    for p in &mut coarse {
        *p = p.map(|x| x * scale);
    }
    let mut uv = vec![[0.0; 2]; shape.positions.len()];
    keep(
        &system.vertices,
        &system.triangles,
        coarse.as_flattened(),
        &mut uv,
    );
    let mean_energy = system.minimize(&mut uv);
    Some(CoarsestMap { uv, mean_energy })
}

/// The energy of one level, with its vertices numbered without gaps.
struct System {
    vertices: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    term: Box<dyn Term>,
    corners: Vec<Corners>,
}

impl System {
    fn new(level: &[(usize, [u32; 3])], n_real: usize, shape: &DiskShape) -> Self {
        let mut triangles: Vec<[u32; 3]> = level.iter().map(|(_, t)| *t).collect();
        let vertices = UsedVertices::new(triangles.iter().flatten().copied());
        vertices.renumber(triangles.as_flattened_mut());
        let rest: Vec<RestShape> = (level.iter())
            .map(|&(original, t)| {
                let rest = rest_shape(t.map(|v| shape.positions[v as usize]), shape.least);
                let factor = if original < n_real {
                    1.0
                } else {
                    VIRTUAL_WEIGHT
                };
                RestShape {
                    weight: factor * rest.weight,
                    ..rest
                }
            })
            .collect();
        Self {
            // Infinite for flipped triangles, it drives every ring back into shape, so that rings stay wide enough for
            // floating point.
            term: Box::new(Triangles::new(
                &triangles,
                &rest,
                SymmetricDirichlet,
                NoBarrier,
            )),
            corners: rest.iter().map(Corners::new).collect(),
            vertices: vertices.into_vec(),
            triangles,
        }
    }

    fn gather(&self, uv: &[[f64; 2]]) -> Vec<[f64; 2]> {
        self.vertices.iter().map(|&v| uv[v as usize]).collect()
    }

    /// Improves the map by sweeps. The result is kept only if the exact check confirms it, as in
    /// [`minimize`](Self::minimize).
    fn sweep(&self, uv: &mut [[f64; 2]]) {
        let mut x = self.gather(uv);
        sweep(&self.triangles, &self.corners, SWEEPS, &mut x);
        keep(&self.vertices, &self.triangles, x.as_flattened(), uv);
    }

    /// Minimizes the energy; returns the energy per weight that it reached.
    fn minimize(self, uv: &mut [[f64; 2]]) -> f64 {
        let mut x = self.gather(uv).into_flattened();
        let weight = self.term.scale();
        let settings = Settings {
            max_iterations: (STEP_BUDGET / self.vertices.len()).max(LEAST_STEPS),
            tolerance: STEP_GAIN,
            projection: Projection::PositiveSemidefinite,
        };
        let mut objective = Objective::new(self.vertices.len(), self.term);
        let summary = minimize(&mut objective, &mut x, &settings, &|_: &Iterate| {
            Control::Continue
        });
        keep(&self.vertices, &self.triangles, &x, uv);
        summary.energy_last / weight
    }
}

/// Copies positions to `uv` if all triangles are exactly positive.
fn keep(vertices: &[u32], triangles: &[[u32; 3]], x: &[f64], uv: &mut [[f64; 2]]) {
    let points: &[[f64; 2]] = x.as_chunks().0;
    if first_bad_triangle(triangles, points).is_none() {
        for (&v, &point) in vertices.iter().zip(points) {
            uv[v as usize] = point;
        }
    }
}

// Gauss–Seidel sweeps: moves one vertex at a time to the minimum of its triangles' energy.

/// Visits every vertex `n_sweeps` times; the energy falls, and stays finite.
fn sweep(triangles: &[[u32; 3]], corners: &[Corners], n_sweeps: usize, uv: &mut [[f64; 2]]) {
    let faces = VertexFaces::new(uv.len(), triangles);
    let mut star = Star::default();
    for _ in 0..n_sweeps {
        for v in 0..uv.len() as u32 {
            star.clear();
            for &face in faces.of(v) {
                let triangle = triangles[face as usize];
                let corner = if triangle[0] == v {
                    0
                } else {
                    1 + usize::from(triangle[2] == v)
                };
                let ends = [1, 2].map(|i| uv[triangle[(corner + i) % 3] as usize]);
                star.push(&corners[face as usize], corner, ends);
            }
            uv[v as usize] = star.settle(uv[v as usize], |_| true);
        }
    }
}

// Reinsertion of collapsed vertices into a map without flipping a triangle.

/// Steps of the walk toward the neighbor, each 0.6 times the one before: the last is 1e-33 of the first.
const WALK: usize = 150;

/// A ring left no room that floating point can represent.
#[derive(Clone, Copy, Debug)]
struct NoRoom;

/// Surfaces in space: positions in the unit of the rest shapes, and the least size of shapes.
#[derive(Clone, Copy)]
struct DiskShape<'a> {
    pub positions: &'a [[f64; 3]],
    pub least: Least,
}

/// Undoes the collapses, last first; `uv` must be positive on the coarse triangles and is then positive on the fine
/// ones, exactly.
fn reinsert(collapses: &Collapses, shape: &DiskShape, uv: &mut [[f64; 2]]) -> Result<(), NoRoom> {
    for collapse in collapses.list.iter().rev() {
        let ring = collapses.ring(collapse);
        let is_free = |p: &[f64; 2]| {
            pairs(ring, collapse.closed)
                .all(|[a, b]| orient2d_sign(*p, uv[a as usize], uv[b as usize]) > 0)
        };
        let place = Some(similar_place(collapse, ring, shape, uv))
            .filter(is_free)
            .or_else(|| walk(collapse, ring, uv).find(is_free))
            .ok_or(NoRoom)?;
        uv[collapse.vertex as usize] =
            improved_place(collapse, ring, shape, uv, place, |p| is_free(&p));
    }
    Ok(())
}

/// Returns the mean of the places at which the vertex would form, with each edge of its ring, a triangle similar to
/// that in space.
fn similar_place(
    collapse: &Collapse,
    ring: &[u32],
    shape: &DiskShape,
    uv: &[[f64; 2]],
) -> [f64; 2] {
    let at = |v: u32| shape.positions[v as usize];
    let (mut sum, mut n) = ([0.0; 2], 0.0);
    for [a, b] in pairs(ring, collapse.closed) {
        let (edge, side) = (
            vec3::sub(at(b), at(a)),
            vec3::sub(at(collapse.vertex), at(a)),
        );
        let squared = vec3::dot(edge, edge).max(shape.least.size * shape.least.size);
        let along = vec3::dot(edge, side) / squared;
        let height = vec3::norm(vec3::cross(edge, side)) / squared;
        let (p, q) = (uv[a as usize], uv[b as usize]);
        let [x, y] = sub(q, p);
        sum[0] += p[0] + along * x - height * y;
        sum[1] += p[1] + along * y + height * x;
        n += 1.0;
    }
    sum.map(|x| x / n)
}

/// Iterates over points ever nearer to the neighbor onto which the vertex was collapsed.
///
/// That neighbor sees the whole ring, because its triangles are positive; so does every point close to it in a
/// direction inside its angle. For a boundary vertex the direction is perpendicular to the neighbor's boundary edge
/// that stays.
fn walk(
    collapse: &Collapse,
    ring: &[u32],
    uv: &[[f64; 2]],
) -> impl Iterator<Item = [f64; 2]> + use<> {
    let n = ring.len();
    let at = collapse.at as usize;
    let origin = uv[ring[at] as usize];
    let edge = |i: usize| sub(uv[ring[i % n] as usize], origin);
    let (direction, reach) = if collapse.closed {
        let (after, before) = (edge(at + 1), edge(at + n - 1));
        (bisector(after, before), length(after).min(length(before)))
    } else if at == 0 {
        let [x, y] = edge(1);
        ([-y, x], length([x, y]))
    } else {
        let [x, y] = edge(at - 1);
        ([y, -x], length([x, y]))
    };
    let unit = reach / length(direction).max(f64::MIN_POSITIVE);
    (0..WALK as i32).map(move |i| {
        let step = unit * 0.6_f64.powi(i);
        [
            origin[0] + step * direction[0],
            origin[1] + step * direction[1],
        ]
    })
}

fn length(a: [f64; 2]) -> f64 {
    a[0].hypot(a[1])
}

/// Returns the direction halfway from `a` counter-clockwise to `b`.
fn bisector(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    let angle = cross(a, b).atan2(dot(a, b));
    let half = 0.5
        * if angle <= 0.0 {
            angle + std::f64::consts::TAU
        } else {
            angle
        };
    let (sin, cos) = half.sin_cos();
    [cos * a[0] - sin * a[1], sin * a[0] + cos * a[1]]
}

/// Improves the place by local Newton steps; every step is checked exactly.
fn improved_place(
    collapse: &Collapse,
    ring: &[u32],
    shape: &DiskShape,
    uv: &[[f64; 2]],
    place: [f64; 2],
    is_free: impl Fn([f64; 2]) -> bool,
) -> [f64; 2] {
    let at = |v: u32| shape.positions[v as usize];
    let mut star = Star::default();
    for [a, b] in pairs(ring, collapse.closed) {
        let rest = rest_shape([at(collapse.vertex), at(a), at(b)], shape.least);
        star.push(&Corners::new(&rest), 0, [uv[a as usize], uv[b as usize]]);
    }
    star.settle(place, is_free)
}
