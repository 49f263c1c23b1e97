//! Layouts whose best fill is known, and what holds for all.
use unwrapd_layout::atlas::{Atlas, AtlasOptions, GRID_BITS, Positions, Rotation, pack};
use unwrapd_method::numerics::random::Random;

use crate::layouts::{Chart, assert_positive_and_inside, bar, blob, maps, smallest_gap};

fn rectangle([width, height]: [f64; 2]) -> Chart {
    let uv = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    (uv, vec![[0, 1, 2], [0, 2, 3]])
}

fn packed(charts: &[Chart], options: &AtlasOptions) -> Atlas {
    let atlas = pack(&maps(charts), options).expect("a layout");
    assert_positive_and_inside(charts, &atlas);
    atlas
}

/// Options without padding.
fn touching(rotation: Rotation) -> AtlasOptions {
    AtlasOptions {
        padding_texels: 0,
        rotation,
        ..AtlasOptions::default()
    }
}

#[test]
fn square_numbers_of_squares_fill_the_page() {
    for side in [1, 2, 3, 4, 6, 8, 12] {
        let charts = vec![rectangle([1.0; 2]); side * side];
        for rotation in [Rotation::Any, Rotation::None] {
            let fill = packed(&charts, &touching(rotation)).utilization;
            assert!(fill >= 0.97, "{side}² squares, {rotation:?}: {fill}");
        }
    }
}

#[test]
fn a_cut_square_is_put_together_again() {
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let mut sides: Vec<[f64; 2]> = vec![[1.0, 1.0]];
        // The largest piece is cut across its longer side.
        for _ in 0..4 + seed {
            let area = |i: &usize| sides[*i][0] * sides[*i][1];
            let largest = (0..sides.len()).max_by(|a, b| area(a).total_cmp(&area(b)));
            let [width, height] = sides.swap_remove(largest.expect("pieces"));
            let at = 0.3 + 0.4 * random.unit();
            sides.extend(if width > height {
                [[at * width, height], [(1.0 - at) * width, height]]
            } else {
                [[width, at * height], [width, (1.0 - at) * height]]
            });
        }
        let charts: Vec<Chart> = sides.into_iter().map(rectangle).collect();
        // As tight packing.
        let options = AtlasOptions {
            patience: 10,
            ..touching(Rotation::Quarter)
        };
        let fill = packed(&charts, &options).utilization;
        assert!(fill >= 0.97, "{} pieces: {fill}", charts.len());
    }
}

#[test]
fn more_patience_never_gives_an_emptier_page() {
    for seed in 0..4 {
        let mut random = Random::new(seed);
        let chart = |_| blob(0.5 + random.unit(), 2 + random.below(4) as u32, 0.3);
        let charts: Vec<Chart> = (0..7).map(chart).collect();
        let scale = |patience: u64| {
            let options = AtlasOptions {
                patience,
                budget_words: patience * 40_000_000,
                ..AtlasOptions::default()
            };
            packed(&charts, &options).scale
        };
        let scales = [1, 2, 4].map(scale);
        assert!(scales.is_sorted(), "{seed}: {scales:?}");
    }
}

#[test]
fn extremes_have_a_place_beside_others() {
    let point = rectangle([1e-7; 2]);
    let needle = rectangle([3.0, 1e-3]);
    let long = bar(40);
    let ring = |radius: f64| {
        let (uv, triangles) = crate::layouts::disk(2, 24, |ring, _| radius * ring as f64);
        // Without the triangles around the center.
        (uv, triangles[24..].to_vec())
    };
    let zoo = [
        vec![point.clone(), blob(1.0, 3, 0.2)],
        vec![needle.clone(), blob(1.0, 3, 0.2), blob(0.5, 5, 0.2)],
        vec![long, rectangle([1.0; 2]), rectangle([1.0; 2])],
        vec![point, needle, ring(1.0), blob(0.6, 4, 0.1)],
    ];
    for (number, charts) in (0..).zip(&zoo) {
        for rotation in [Rotation::Any, Rotation::Quarter, Rotation::None] {
            let options = AtlasOptions {
                rotation,
                ..AtlasOptions::default()
            };
            let atlas = packed(charts, &options);
            let gap = smallest_gap(charts, &atlas, 1024);
            assert!(gap >= 1.999, "zoo {number}, {rotation:?}: {gap}");
        }
    }
}

#[test]
fn a_chart_as_long_as_the_page_is_said_to_set_the_scale() {
    let options = AtlasOptions::default();
    let long = [bar(40), rectangle([1.0; 2]), rectangle([0.5; 2])];
    let limit = packed(&long, &options).limit.expect("a limit");
    assert_eq!(limit.chart, 0);
    // On its diagonal, which is √2 long, a bar of 40 × 1 has a scale of √2 / 41.
    let bound = (40.0 + 1.0 + 0.25) * 2.0 / (41.0 * 41.0);
    assert!(
        (limit.utilization / bound - 1.0).abs() < 0.02,
        "{limit:?}, {bound}"
    );
    let alike = vec![rectangle([1.0; 2]); 9];
    assert_eq!(packed(&alike, &options).limit, None);
    // It lies along the axes, but is shorter on the diagonal.
    assert_eq!(packed(&[bar(3)], &options).limit, None);
    let upright = AtlasOptions {
        rotation: Rotation::Quarter,
        ..options
    };
    assert!(packed(&[bar(3)], &upright).limit.is_some());
}

#[test]
fn a_full_page_that_is_packed_again_is_not_emptied() {
    let unit = f64::from(1 << GRID_BITS);
    for seed in 0..3 {
        let mut random = Random::new(seed);
        let chart = |_| blob(0.5 + random.unit(), 2 + random.below(4) as u32, 0.3);
        let charts: Vec<Chart> = (0..9).map(chart).collect();
        let first = packed(&charts, &AtlasOptions::default());
        let on_page: Vec<Chart> = (charts.iter().zip(&first.placed))
            .map(|((_, triangles), placed)| {
                let uv = placed.grid.iter().map(|p| p.map(|x| f64::from(x) / unit));
                (uv.collect(), triangles.clone())
            })
            .collect();
        for rotation in [Rotation::Any, Rotation::Quarter, Rotation::None] {
            let options = AtlasOptions {
                rotation,
                positions: Positions::Layout,
                // Too few for a search that finds a layout like this one.
                budget_words: 100_000,
                ..AtlasOptions::default()
            };
            let again = packed(&on_page, &options);
            assert!(smallest_gap(&charts, &again, 1024) >= 1.999);
            let [before, after] = [first.utilization, again.utilization];
            assert!(
                after > before - 0.002,
                "{seed}, {rotation:?}: {before}, {after}"
            );
        }
    }
}

#[test]
fn stacked_charts_form_no_layout() {
    // All in one place, as parts that share their texels are.
    let charts: Vec<Chart> = (0..60).map(|_| blob(1.0, 3, 0.3)).collect();
    let layout = |positions| {
        let options = AtlasOptions {
            positions,
            ..AtlasOptions::default()
        };
        packed(&charts, &options)
    };
    assert_eq!(layout(Positions::Layout), layout(Positions::Unrelated));
}

/// A search that ends where it knows all arrangements around finds one more only from another place.
#[test]
fn charts_that_lie_rotated_fill_as_much() {
    let charts = [steps(10), rectangle([10.0, 25.0]), rectangle([10.0, 23.0])];
    let fill = |rotated: &[usize]| {
        let mut charts = charts.clone();
        for &chart in rotated {
            for [x, y] in &mut charts[chart].0 {
                (*x, *y) = (-*y, *x);
            }
        }
        packed(&charts, &AtlasOptions::default()).utilization
    };
    let fills = [&[][..], &[0], &[1], &[2], &[0, 1], &[0, 2], &[1, 2]].map(fill);
    let [least, most] = [f64::min, f64::max].map(|of| fills.into_iter().reduce(of).unwrap());
    assert!(most - least < 0.005, "{fills:?}");
}

/// Returns a chart of `n` steps on either side of a column, the widest at the top.
fn steps(n: u32) -> Chart {
    let height = 3.34;
    let mut uv = vec![[10.0, 0.0], [20.0, 0.0], [10.0, 5.34], [20.0, 5.34]];
    let mut triangles = vec![[0, 1, 2], [1, 3, 2]];
    for step in 1..=n {
        let by = f64::from(step);
        let [bottom, top] = [by, by + 1.0].map(|k| 2.0 + height * k);
        let (left, right) = (10.0 - by, 20.0 + by);
        let [l, r] = [uv.len() as u32 - 2, uv.len() as u32 - 1];
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| uv.len() as u32 + k);
        uv.extend([[left, bottom], [right, bottom], [left, top], [right, top]]);
        triangles.extend([[a, l, c], [l, r, c], [r, d, c], [r, b, d]]);
    }
    (uv, triangles)
}
