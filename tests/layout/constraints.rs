//! Charts packed in regions, in groups and around islands that stay.
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, ConstraintError, Constraints, GRID_BITS, Region, Rotation, Stay,
    Texture, pack, pack_within,
};
use unwrapd_maps::certificate::{Claims, Padding, certify};
use unwrapd_maps::mesh::Resolution;
use unwrapd_method::solver::Control;

use crate::layouts::{Chart, bar, blob, maps};
use crate::uv_meshes::UvMesh;

fn texture(width: u32, height: u32, pages: u32) -> Texture {
    Texture {
        resolution: Resolution { width, height },
        pages,
    }
}

fn options(texture: Texture) -> AtlasOptions {
    AtlasOptions {
        texture,
        budget_words: 40_000_000,
        ..AtlasOptions::default()
    }
}

fn blobs(n: usize) -> Vec<Chart> {
    (0..n)
        .map(|i| blob(1.0 / (1.0 + 0.3 * i as f64), 3 + i as u32 % 4, 0.3))
        .collect()
}

fn packed(
    charts: &[Chart],
    constraints: &Constraints,
    options: &AtlasOptions,
) -> Result<Atlas, ConstraintError> {
    pack_within(&maps(charts), constraints, options, &|_| Control::Continue)
}

/// The UVs of a chart in the atlas.
fn uvs(atlas: &Atlas, chart: usize) -> Vec<[f64; 2]> {
    let unit = f64::from(1 << GRID_BITS);
    let grid = &atlas.placed[chart].grid;
    grid.iter()
        .map(|p| p.map(|x| f64::from(x) / unit))
        .collect()
}

/// Checks that no two triangles overlap and that all charts keep the padding.
fn assert_certified(charts: &[Chart], atlas: &Atlas, options: &AtlasOptions) {
    let mut mesh = UvMesh::default();
    for (chart, (points, triangles)) in charts.iter().enumerate() {
        let at = uvs(atlas, chart);
        let mut one = UvMesh::planar(points, triangles);
        one.uvs = triangles
            .iter()
            .map(|t| t.map(|v| at[v as usize]))
            .collect();
        mesh.add(&one);
    }
    let claims = Claims {
        padding: Some(Padding {
            texels: options.padding_texels,
            resolution: options.texture.resolution,
        }),
        pages: Some(options.texture.pages),
        ..Claims::default()
    };
    let certificate = certify(&mesh.positions, &mesh.triangles, &mesh.uvs, &claims);
    assert!(certificate.is_bijective(), "{certificate:?}");
    assert!(certificate.padding.expect("asked for").kept);
    assert!(certificate.pages.expect("asked for").kept);
}

/// Checks that a chart lies in a region, half of the padding away from its sides.
fn assert_inside(atlas: &Atlas, chart: usize, region: Region, options: &AtlasOptions) {
    let Resolution { width, height } = options.texture.resolution;
    let half = f64::from(options.padding_texels) / 2.0;
    for uv in uvs(atlas, chart) {
        for (k, side) in [width, height].into_iter().enumerate() {
            let inset = half / f64::from(side) - 1e-6;
            let is_inside = uv[k] >= region.low[k] + inset && uv[k] <= region.high[k] - inset;
            assert!(is_inside, "chart {chart} at {uv:?} leaves {region:?}");
        }
    }
}

/// Returns the distances of the vertices of a chart from its first one, relative to those of the map.
fn ratios(atlas: &Atlas, charts: &[Chart], members: &[usize], sides: [f64; 2]) -> Vec<f64> {
    let points = members.iter().flat_map(|&chart| charts[chart].0.clone());
    let places = members.iter().flat_map(|&chart| uvs(atlas, chart));
    let places: Vec<[f64; 2]> = places.map(|[u, v]| [u * sides[0], v * sides[1]]).collect();
    let points: Vec<[f64; 2]> = points.collect();
    let length = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let pairs = (1..points.len()).filter(|&i| length(points[i], points[0]) > 0.1);
    pairs
        .map(|i| length(places[i], places[0]) / length(points[i], points[0]))
        .collect()
}

#[test]
fn charts_stay_in_their_regions_on_any_texture() {
    let charts = blobs(12);
    let region = |low: [f64; 2], high: [f64; 2]| Region { low, high };
    for (width, height, pages) in [(1024, 1024, 1), (1024, 512, 3), (256, 1024, 2)] {
        let options = options(texture(width, height, pages));
        let last = pages - 1;
        let trim = region([0.1, 0.6], [0.55, 0.9]);
        let corner = region([f64::from(last) + 0.7, 0.0], [f64::from(last) + 1.0, 0.3]);
        let regions: Vec<Option<Region>> = (0..charts.len())
            .map(|chart| match chart % 4 {
                0 => None,
                1 => Some(trim),
                2 => Some(corner),
                _ => Some(Region::page(last)),
            })
            .collect();
        let constraints = Constraints {
            regions: &regions,
            ..Constraints::default()
        };
        let atlas = packed(&charts, &constraints, &options).expect("a layout");
        assert_certified(&charts, &atlas, &options);
        for (chart, region) in regions.iter().enumerate() {
            if let Some(region) = region {
                assert_inside(&atlas, chart, *region, &options);
            }
        }
    }
}

#[test]
fn groups_keep_the_positions_of_their_charts() {
    let mut charts = blobs(9);
    // Three charts of a group, beside each other.
    for (chart, x) in [(2, 0.0), (5, 3.0), (7, 5.0)] {
        for p in &mut charts[chart].0 {
            p[0] += x;
        }
    }
    let groups = [10, 11, 7, 12, 13, 7, 14, 7, 15];
    for rotation in [Rotation::Any, Rotation::Quarter, Rotation::None] {
        let options = AtlasOptions {
            rotation,
            ..options(texture(1024, 1024, 1))
        };
        let constraints = Constraints {
            groups: &groups,
            ..Constraints::default()
        };
        let atlas = packed(&charts, &constraints, &options).expect("a layout");
        assert_certified(&charts, &atlas, &options);
        let ratios = ratios(&atlas, &charts, &[2, 5, 7], [1.0; 2]);
        // Each vertex is at most a diagonal half step from its place.
        let most = 4.0 / f64::from(1 << GRID_BITS) / 0.1;
        let is_rigid = ratios.iter().all(|r| (r - atlas.scale).abs() < most);
        assert!(is_rigid, "{rotation:?}: {ratios:?}, {}", atlas.scale);
    }
}

#[test]
fn islands_stay_where_they_are() {
    let charts = blobs(10);
    let options = options(texture(1024, 1024, 1));
    let first = pack(&maps(&charts), &options).expect("a layout");
    let kept = [0, 4];
    let at: Vec<Vec<[f64; 2]>> = kept.iter().map(|&chart| uvs(&first, chart)).collect();
    let stays: Vec<Stay> = (kept.iter().zip(&at).enumerate())
        .map(|(island, (&chart, uv))| Stay {
            map: ChartMap {
                uv,
                triangles: &charts[chart].1,
            },
            island,
        })
        .collect();
    let is_free = |chart: &usize| !kept.contains(chart);
    let order: Vec<usize> = (0..charts.len()).filter(is_free).chain(kept).collect();
    let all: Vec<Chart> = order.iter().map(|&chart| charts[chart].clone()).collect();
    let constraints = Constraints {
        stays: &stays,
        ..Constraints::default()
    };
    let atlas = packed(&all[..8], &constraints, &options).expect("a layout");
    assert_certified(&all, &atlas, &options);
    for (place, &chart) in order.iter().enumerate().skip(8) {
        assert_eq!(atlas.placed[place], first.placed[chart]);
    }
    // The room that the others had before is still there.
    assert!(
        atlas.scale > 0.9 * first.scale,
        "{} {}",
        atlas.scale,
        first.scale
    );
}

/// A single chart grows into the room that an island leaves; beside one that covers the page there is none.
#[test]
fn one_chart_takes_what_an_island_leaves() {
    let square: Chart = (
        vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let options = options(texture(1024, 1024, 1));
    let beside = |width: f64| {
        let stay = Stay {
            map: ChartMap {
                uv: &[[0.0, 0.0], [width, 0.0], [width, 1.0], [0.0, 1.0]],
                triangles: &square.1,
            },
            island: 0,
        };
        let constraints = Constraints {
            stays: &[stay],
            ..Constraints::default()
        };
        packed(std::slice::from_ref(&square), &constraints, &options)
    };
    let atlas = beside(0.5).expect("a layout");
    let [left, right] = bounds(&uvs(&atlas, 0));
    assert!(
        0.5 < left[0] && 0.47 < right[0] - left[0],
        "{left:?} {right:?}"
    );
    assert_eq!(beside(1.0).expect_err("no room"), ConstraintError::NoRoom);
}

fn bounds(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let by = |start: f64, of: fn(f64, f64) -> f64| {
        [0, 1].map(|axis| points.iter().fold(start, |most, p| of(most, p[axis])))
    };
    [by(f64::INFINITY, f64::min), by(f64::NEG_INFINITY, f64::max)]
}

#[test]
fn without_constraints_pages_are_about_as_full() {
    for n in [2, 9, 30] {
        let charts = blobs(n);
        let options = options(texture(1024, 1024, 1));
        let free = pack(&maps(&charts), &options).expect("a layout");
        let around = packed(&charts, &Constraints::default(), &options).expect("a layout");
        assert_certified(&charts, &around, &options);
        let [free, around] = [free, around].map(|atlas| atlas.utilization);
        assert!(around > free - 0.06, "{n} charts: {around}, {free}");
    }
}

#[test]
fn a_larger_padding_is_kept_within_constraints() {
    let charts = blobs(8);
    let regions = vec![Some(Region::page(1)); 8];
    let options = AtlasOptions {
        padding_texels: 24,
        ..options(texture(512, 512, 2))
    };
    let constraints = Constraints {
        regions: &regions,
        ..Constraints::default()
    };
    let atlas = packed(&charts, &constraints, &options).expect("a layout");
    assert_certified(&charts, &atlas, &options);
    for chart in 0..charts.len() {
        assert_inside(&atlas, chart, Region::page(1), &options);
    }
}

#[test]
fn what_cannot_be_met_is_named() {
    let charts = blobs(3);
    let options = options(texture(1024, 1024, 1));
    let refused = |regions: &[Option<Region>]| {
        let constraints = Constraints {
            regions,
            ..Constraints::default()
        };
        packed(&charts, &constraints, &options).expect_err("a fault")
    };
    let region = |low, high| Some(Region { low, high });
    let faulty = [
        Some(Region::page(1)),
        region([0.5, 0.0], [0.5, 1.0]),
        region([-0.1, 0.0], [0.5, 1.0]),
        region([0.0, 0.0], [1.0, 1.1]),
        region([f64::NAN, 0.0], [1.0, 1.0]),
    ];
    for region in faulty {
        assert_eq!(
            refused(&[None, region]),
            ConstraintError::Region { chart: 1 }
        );
    }
    // Within a texel of a page, nothing has room beside the padding.
    let narrow = region([0.0, 0.0], [1.0 / 1024.0, 1.0]);
    assert_eq!(refused(&[narrow]), ConstraintError::NoRoom);
}

#[test]
fn nothing_and_extremes_are_packed_within_constraints() {
    let options = options(texture(1024, 1024, 1));
    let none = packed(&[], &Constraints::default(), &options).expect("an atlas");
    assert!(none.placed.is_empty());
    let empty: Chart = (Vec::new(), Vec::new());
    let all = [bar(40), empty, blob(1.0, 3, 0.2), blob(1e-6, 3, 0.2)];
    let half = Region {
        low: [0.0, 0.5],
        high: [1.0, 1.0],
    };
    for groups in [&[][..], &[0, 0, 1, 2], &[0, 1, 2, 2]] {
        let constraints = Constraints {
            groups,
            regions: &[Some(half), Some(half)],
            ..Constraints::default()
        };
        // In a group, charts must not overlap.
        let mut charts = all.to_vec();
        for p in &mut charts[3].0 {
            p[0] += 3.0;
        }
        let atlas = packed(&charts, &constraints, &options).expect("a layout");
        assert_inside(&atlas, 0, half, &options);
        assert_certified(&charts[..3], &atlas, &options);
    }
}
