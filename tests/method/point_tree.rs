//! Nearest neighbors.

use unwrapd_method::numerics::point_tree::PointTree;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::numerics::vec3::distance;

/// The point found is the nearest of all, the first one among equals, and none lies beyond the reach.
#[test]
fn the_nearest_point_is_that_of_a_comparison_with_all() {
    let mut random = Random::new(1);
    for n in [1, 7, 8, 9, 100, 1000] {
        // Places on a lattice, so that many points coincide and many are equally far.
        let mut point = || [0; 3].map(|_: i32| random.below(12) as f64 / 4.0);
        let points: Vec<[f64; 3]> = (0..n).map(|_| point()).collect();
        let targets: Vec<[f64; 3]> = (0..200).map(|_| point().map(|x| x + 0.125)).collect();
        let tree = PointTree::new(points.clone());
        for (to, reach) in targets.iter().zip([f64::INFINITY, 0.5].into_iter().cycle()) {
            let all = (0..).zip(&points).map(|(v, p)| (v, distance(*p, *to)));
            let near = all.filter(|(_, distance)| *distance < reach);
            let nearest = near.min_by(|a, b| a.1.total_cmp(&b.1));
            let found = tree.nearest(*to, reach, |_| true);
            assert_eq!(found.map(|it| it.0), nearest.map(|it: (u32, f64)| it.0));
        }
    }
}
