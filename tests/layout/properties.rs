//! Properties of every layout: what changes of the problem may and may not change.
use std::f64::consts::TAU;

use unwrapd_layout::atlas::{Atlas, AtlasError, AtlasOptions, Rotation, Scale, Texture, pack};
use unwrapd_method::numerics::random::Random;

use crate::layouts::{Chart, assert_positive_and_inside, bar, blob, maps, smallest_gap};

/// Share by which the scales of two searches may differ, whose luck is not the same.
const LUCK: f64 = 0.03;

fn packed(charts: &[Chart], options: &AtlasOptions) -> Atlas {
    let atlas = pack(&maps(charts), options).expect("a layout");
    // On several pages, u goes on to their number.
    if options.texture.pages == 1 {
        assert_positive_and_inside(charts, &atlas);
    }
    atlas
}

/// Blobs and bars of several sizes.
fn mixed(n: usize, seed: u64) -> Vec<Chart> {
    let mut random = Random::new(seed);
    let chart = |i: usize| match i % 3 {
        0 => bar(1 + random.below(4)),
        _ => blob(0.4 + random.unit(), 2 + random.below(4) as u32, 0.3),
    };
    (0..n).map(chart).collect()
}

fn changed(charts: &[Chart], to: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Chart> {
    let changed = |(uv, triangles): &Chart| {
        let uv = uv.iter().map(|&p| to(p)).collect();
        (uv, triangles.clone())
    };
    charts.iter().map(changed).collect()
}

#[test]
fn the_gap_is_kept_by_any_number_of_charts() {
    // One chart, few that are searched, a crowd that is squeezed, and one that stays on the raster.
    for n in [1, 2, 12, 70, 600] {
        let charts = mixed(n, n as u64);
        let atlas = packed(&charts, &AtlasOptions::default());
        if n <= 70 {
            let gap = smallest_gap(&charts, &atlas, 1024);
            assert!(gap >= 1.999, "{n} charts: {gap}");
        }
        assert!(atlas.padding_texels > 1.999, "{n} charts: {atlas:?}");
    }
}

#[test]
fn a_wider_gap_never_makes_charts_larger() {
    for seed in 0..3 {
        let charts = mixed(9, seed);
        let scale = |padding_texels| {
            let options = AtlasOptions {
                padding_texels,
                ..AtlasOptions::default()
            };
            packed(&charts, &options).scale
        };
        let scales = [0, 4, 16, 64].map(scale);
        for pair in scales.windows(2) {
            assert!(pair[1] < pair[0] * (1.0 + LUCK), "{seed}: {scales:?}");
        }
        assert!(scales[3] < 0.95 * scales[0], "{seed}: {scales:?}");
    }
}

#[test]
fn more_pages_never_make_charts_smaller() {
    let charts = mixed(12, 5);
    let scale = |pages| {
        let options = AtlasOptions {
            texture: Texture {
                pages,
                ..Texture::square(1024)
            },
            ..AtlasOptions::default()
        };
        packed(&charts, &options).scale
    };
    let scales = [1, 2, 4].map(scale);
    assert!(scales.is_sorted(), "{scales:?}");
    // Four pages have room for charts of twice the size, if none is as long as a page.
    assert!(scales[2] > 1.5 * scales[0], "{scales:?}");
}

#[test]
fn more_rotations_never_empty_the_page() {
    for seed in 0..3 {
        let charts = mixed(8, seed);
        let fill = |rotation| {
            let options = AtlasOptions {
                rotation,
                ..AtlasOptions::default()
            };
            packed(&charts, &options).utilization
        };
        let fills = [Rotation::None, Rotation::Quarter, Rotation::Any].map(fill);
        for pair in fills.windows(2) {
            assert!(pair[1] > pair[0] - LUCK, "{seed}: {fills:?}");
        }
    }
}

#[test]
fn rotation_and_scale_of_the_charts_change_little() {
    for seed in 0..3 {
        let charts = mixed(7, seed);
        let options = AtlasOptions::default();
        let first = packed(&charts, &options);
        for k in 1..4 {
            let (sin, cos) = (TAU * f64::from(k) / 7.0).sin_cos();
            let turned = changed(&charts, |[x, y]| [cos * x - sin * y, sin * x + cos * y]);
            let fill = packed(&turned, &options).utilization;
            let by = fill - first.utilization;
            assert!(by.abs() < LUCK, "{seed}, {k} sevenths of a turn: {by}");
        }
        for scale in [1e-9, 1e-3, 1e6, 1e9] {
            let scaled = changed(&charts, |p| p.map(|x| scale * x));
            let atlas = packed(&scaled, &options);
            let by = atlas.scale * scale / first.scale - 1.0;
            assert!(by.abs() < LUCK, "{seed}, scale {scale}: {by}");
        }
    }
}

#[test]
fn a_prescribed_scale_is_kept_or_refused() {
    let charts = mixed(10, 2);
    let largest = packed(&charts, &AtlasOptions::default());
    let at = |share: f64| {
        let options = AtlasOptions {
            scale: Scale::TexelsPerUnit(share * 1024.0 * largest.scale),
            ..AtlasOptions::default()
        };
        pack(&maps(&charts), &options).map(|atlas| atlas.scale / largest.scale)
    };
    for share in [0.2, 0.7, 0.9] {
        let reached = at(share).expect("room");
        assert!((reached / share - 1.0).abs() < 1e-6, "{share}: {reached}");
    }
    // Charts that would cover more than the page have no room.
    let too_much = 1.01 / largest.utilization.sqrt();
    assert_eq!(at(too_much), Err(AtlasError::TextureTooSmall));
}

/// Returns a rectangle of two triangles.
fn rectangle([width, height]: [f64; 2]) -> Chart {
    let uv = vec![[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    (uv, vec![[0, 1, 2], [0, 2, 3]])
}

#[test]
fn bricks_and_pages_of_their_own_shape_are_filled() {
    let touching = |texture| AtlasOptions {
        texture,
        padding_texels: 0,
        rotation: Rotation::Quarter,
        ..AtlasOptions::default()
    };
    for n in [1, 2, 3, 5] {
        // Two bricks make a square.
        let bricks = vec![rectangle([2.0, 1.0]); 2 * n * n];
        let fill = packed(&bricks, &touching(Texture::square(1024))).utilization;
        assert!(fill > 0.97, "{} bricks: {fill}", bricks.len());
    }
    for pages in [1, 3] {
        let wide = Texture {
            resolution: unwrapd_maps::mesh::Resolution {
                width: 1024,
                height: 512,
            },
            pages,
        };
        let bricks = vec![rectangle([2.0, 1.0]); 9 * pages as usize];
        let fill = packed(&bricks, &touching(wide)).utilization;
        assert!(fill > 0.97, "{pages} pages: {fill}");
    }
}
