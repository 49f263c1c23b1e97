//! Large cages and the coarser ones they start from.

use unwrapd_deform::cage::{Cage, Caged, CagedSurface};
use unwrapd_deform::{Body, Handle, Model, Problem};
use unwrapd_method::solver::{Control, Iterate};

use crate::zoo;

/// A cube whose lower side is held and whose upper one is shifted.
#[test]
fn a_large_cage_starts_where_a_coarse_one_ends() {
    let cube = zoo::voxels(&[[0, 0, 0]]);
    let positions: Vec<[f64; 3]> = cube.positions.iter().map(|p| p.map(f64::from)).collect();
    let surface = CagedSurface {
        positions: &positions,
        triangles: &cube.triangles,
    };
    let side = |z: f64, shift: f64| Handle::Disc {
        center: vec![0.5, 0.5, z],
        radius: 0.3,
        to: vec![0.5 + shift, 0.5, z],
        turn: 0.0,
        axis: None,
        weight: None,
    };
    let caged = Caged {
        surfaces: &[surface],
        handles: &[side(0.0, 0.0), side(1.0, 0.4)],
        model: &Model::default(),
    };
    let go_on = |_: &Iterate| Control::Continue;
    let problem = |n_voxels| {
        let cage = Cage::around(caged.surfaces, n_voxels).expect("a cage");
        let body = Body::from(cage.mesh());
        let mut problem = Problem::new(body, caged.handles, caged.model).expect("a problem");
        caged.start(&mut problem, &cage, n_voxels, &go_on);
        problem
    };
    let small = problem(8);
    assert_eq!(small.start, small.body.rest);
    let large = problem(20);
    let n_tets = large.body.determinants().len();
    assert!(n_tets > 50_000, "{n_tets}");
    let now = large.body.determinants_at(&large.start);
    assert!(now.iter().all(|&d| d > large.barrier.epsilon));
    // It has most of the way behind it.
    let residual = |x: &[f64]| large.quality(x).residual;
    let ratio = residual(&large.start) / residual(&large.body.rest);
    assert!(ratio < 0.1, "{ratio}");
}
