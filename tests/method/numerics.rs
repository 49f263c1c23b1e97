//! Exact orientation, convex hulls, random numbers.

use unwrapd_method::numerics::hull::{Enclosure, convex_hull, smallest_page, smallest_rectangle};
use unwrapd_method::numerics::predicates::orient2d_sign;
use unwrapd_method::numerics::random::Random;
use unwrapd_method::numerics::support::{Directions, Support};
use unwrapd_method::numerics::vec2::doubled_area;

#[test]
fn orientation_is_exact_where_rounding_is_not() {
    // Shewchuk's example: points within a few last places of the line y = x, where the rounded determinant errs.
    let (b, c) = ([12.0, 12.0], [24.0, 24.0]);
    let last_place = f64::EPSILON / 2.0;
    let mut rounded_wrong = 0;
    for i in 0..16_i32 {
        for j in 0..16_i32 {
            let a = [
                0.5 + f64::from(i) * last_place,
                0.5 + f64::from(j) * last_place,
            ];
            let expected = (j - i).signum();
            assert_eq!(i32::from(orient2d_sign(b, c, a)), expected);
            rounded_wrong += i32::from((doubled_area(a, b, c) > 0.0) != (expected > 0));
        }
    }
    assert!(rounded_wrong > 0, "the example no longer shows rounding");
    assert_eq!(orient2d_sign([f64::NAN, 0.0], b, [1.0, 2.0]), 0);
}

#[test]
fn a_hull_has_the_outer_corners_only() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]];
    let inner = [[2.0, 0.0], [1.0, 1.0], [4.0, 1.5], [0.0, 0.0]];
    let hull = convex_hull(corners.into_iter().chain(inner));
    assert_eq!(hull, corners);
    assert_eq!(convex_hull([[1.0, 2.0], [1.0, 2.0]]).len(), 0);
}

#[test]
fn the_smallest_page_is_found_at_any_angle() {
    let turned = |corners: &[[f64; 2]], angle: f64| {
        let (sin, cos) = f64::sin_cos(angle);
        let turned = corners
            .iter()
            .map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
        convex_hull(turned)
    };
    let rectangle = |w: f64, h: f64| [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]];
    for angle in [0.0, 0.1, 0.7, 1.4, 2.9] {
        let page =
            |corners: &[[f64; 2]], aspect| smallest_page(&turned(corners, angle), aspect).area;
        let cases = [
            // A square has itself around it, a page of its own shape too.
            (page(&rectangle(1.0, 1.0), 1.0), 1.0),
            (page(&rectangle(2.0, 1.0), 2.0), 2.0),
            (page(&rectangle(1.0, 2.0), 2.0), 2.0),
            // A strip lies on the diagonal.
            (page(&rectangle(10.0, 0.1), 1.0), 10.1_f64.powi(2) / 2.0),
            // A regular triangle leans in its square by 15 degrees.
            (
                page(&[[0.0, 0.0], [1.0, 0.0], [0.5, 0.75_f64.sqrt()]], 1.0),
                (std::f64::consts::PI / 12.0).cos().powi(2),
            ),
        ];
        for (found, expected) in cases {
            assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
        }
    }
    assert_eq!(smallest_page(&[], 1.0).area, 0.0);
}

#[test]
fn enclosures_have_the_angle_at_which_they_fit() {
    let mut random = Random::new(3);
    for _ in 0..50 {
        let points: Vec<[f64; 2]> = (0..9)
            .map(|_| [2.0 * random.unit(), random.unit()])
            .collect();
        let hull = convex_hull(points);
        let extent = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            let span = |of: &dyn Fn(&[f64; 2]) -> f64| {
                let all = || hull.iter().map(of);
                all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
            };
            [
                span(&|p| cos * p[0] + sin * p[1]),
                span(&|p| cos * p[1] - sin * p[0]),
            ]
        };
        let Enclosure { area, angle } = smallest_rectangle(&hull);
        let [length, width] = extent(angle);
        assert!(width <= length && (length * width / area - 1.0).abs() < 1e-9);
        for aspect in [1.0, 2.0, 4.0] {
            let Enclosure { area, angle } = smallest_page(&hull, aspect);
            let [length, width] = extent(angle);
            let around = (length / aspect).max(width);
            assert!((around * around * aspect / area - 1.0).abs() < 1e-9);
            // No other angle does with less.
            for step in 0..180 {
                let [length, width] = extent(f64::from(step).to_radians());
                let around = (length / aspect).max(width);
                assert!(around * around * aspect > area * (1.0 - 1e-9));
                assert!(length * width > smallest_rectangle(&hull).area * (1.0 - 1e-9));
            }
        }
    }
    assert_eq!(smallest_rectangle(&[]).area, 0.0);
}

#[test]
fn supports_know_the_area_of_hulls() {
    let directions = Directions::default();
    let disk = |x: f64| {
        let mut support = Support::EMPTY;
        for k in 0..1000 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 1000.0).sin_cos();
            support.add([x + cos, sin], &directions);
        }
        support
    };
    let pi = std::f64::consts::PI;
    let mut both = disk(0.0);
    assert!((both.area() / pi - 1.0).abs() < 0.004);
    both.unite(&disk(3.0));
    assert!((both.area() / (pi + 6.0) - 1.0).abs() < 0.004);
    assert_eq!(Support::EMPTY.area(), 0.0);
}

#[test]
fn supports_know_the_smallest_square_around() {
    let directions = Directions::default();
    let rectangle = |[width, height]: [f64; 2], angle: f64| {
        let (sin, cos) = angle.sin_cos();
        let mut support = Support::EMPTY;
        for [x, y] in [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]] {
            support.add([x * cos - y * sin, x * sin + y * cos], &directions);
        }
        support
    };
    for k in 0..20 {
        let angle = 0.1 * f64::from(k);
        // A needle lies along the diagonal, a square in itself. What is known of them is a little larger than they are.
        let needle = rectangle([10.0, 0.0], angle).square() / 50.0;
        assert!((1.0 - 1e-9..1.22).contains(&needle), "{angle}: {needle}");
        let square = rectangle([3.0, 3.0], angle).square() / 9.0;
        assert!((1.0 - 1e-9..1.22).contains(&square), "{angle}: {square}");
    }
    let bar = rectangle([4.0, 1.0], 0.3);
    assert_eq!(bar.room(bar.square()), bar.area());
    let excess = bar.room(10.0) - bar.area();
    assert!(
        (excess - 2.0 * (bar.square() - 10.0)).abs() < 1e-12,
        "{excess}"
    );
    assert_eq!(Support::EMPTY.room(1.0), 0.0);
}

#[test]
fn random_numbers_are_spread_evenly_and_repeat() {
    let mut random = Random::new(7);
    let mut counts = [0; 10];
    for _ in 0..10_000 {
        counts[random.below(10)] += 1;
    }
    assert!(counts.iter().all(|n| (900..1100).contains(n)), "{counts:?}");
    let [mut a, mut b] = [3, 3].map(Random::new);
    assert!((0..100).all(|_| a.bits() == b.bits()));
}
