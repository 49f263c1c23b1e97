//! Several pages, textures that are not square, and a density that is given.

use crate::layouts::{Chart, maps};
use crate::uv_meshes::UvMesh;
use unwrapd_layout::atlas::{
    Atlas, AtlasError, AtlasOptions, GRID_BITS, Scale, Texture, enough, fits, pack,
};
use unwrapd_maps::certificate::{Certificate, Claims, Padding, certify};
use unwrapd_maps::measure::MeasureOptions;
use unwrapd_maps::mesh::{Resolution, VAxis};

/// Fans with a wavy outline, of many sizes.
fn fans(n: usize) -> Vec<Chart> {
    let fan = |i: usize| {
        let (size, waves) = (1.0 / (1.0 + 0.2 * i as f64), (2 + i % 4) as f64);
        let rim = (0..24).map(|k| {
            let angle = std::f64::consts::TAU * f64::from(k) / 24.0;
            let r = size * (1.0 + 0.3 * (waves * angle).cos());
            [r * angle.cos(), r * angle.sin()]
        });
        let triangles = (0..24).map(|k| [0, 1 + k, 1 + (k + 1) % 24]);
        (
            std::iter::once([0.0; 2]).chain(rim).collect(),
            triangles.collect(),
        )
    };
    (0..n).map(fan).collect()
}

fn options(width: u32, height: u32, pages: u32) -> AtlasOptions {
    AtlasOptions {
        texture: Texture {
            resolution: Resolution { width, height },
            pages,
        },
        budget_words: 2_000_000,
        ..AtlasOptions::default()
    }
}

/// The UVs of all charts as one mesh, each chart apart from the others in space.
fn mesh(charts: &[Chart], atlas: &Atlas) -> UvMesh {
    let mut mesh = UvMesh::default();
    let unit = f64::from(1 << GRID_BITS);
    for ((uv, triangles), placed) in charts.iter().zip(&atlas.placed) {
        let mut chart = UvMesh::planar(uv, triangles);
        let at = |v: u32| placed.grid[v as usize].map(|x| f64::from(x) / unit);
        chart.uvs = triangles.iter().map(|t| t.map(at)).collect();
        mesh.add(&chart);
    }
    mesh
}

fn judged(mesh: &UvMesh, texture: Texture, texels: u32) -> Certificate {
    let claims = Claims {
        padding: Some(Padding {
            texels,
            resolution: texture.resolution,
        }),
        pages: Some(texture.pages),
        ..Claims::default()
    };
    certify(&mesh.positions, &mesh.triangles, &mesh.uvs, &claims)
}

/// Pages and shapes that have each step of the grid.
const TEXTURES: [(u32, u32, u32); 9] = [
    (512, 512, 1),
    (512, 512, 2),
    (512, 512, 3),
    (512, 512, 5),
    (512, 512, 10),
    (1024, 512, 1),
    (512, 2048, 4),
    (1024, 64, 2),
    (64, 1024, 9),
];

#[test]
fn what_is_laid_out_on_pages_is_exact_in_f32_and_certified() {
    let charts = fans(40);
    for (width, height, pages) in TEXTURES {
        let options = options(width, height, pages);
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        let mesh = mesh(&charts, &atlas);
        let is_exact = |x: f64| f64::from(x as f32) == x;
        let mut uvs = mesh.uvs.iter().flatten();
        // glTF has 1 − v.
        let are_exact = uvs.all(|&[u, v]| is_exact(u) && is_exact(v) && is_exact(1.0 - v));
        assert!(are_exact, "{width}x{height}, {pages} pages");
        let certificate = judged(&mesh, options.texture, 2);
        assert!(certificate.is_bijective(), "{certificate:?}");
        let padding = certificate.padding.expect("asked for");
        assert!(padding.kept, "{width}x{height}, {pages} pages: {padding:?}");
        let used = certificate.pages.expect("asked for");
        // Across a slender page the largest chart decides, and few pages hold the others.
        let are_many = width != height || 2 * used.used >= pages as usize;
        assert!(used.kept && are_many, "{used:?}");
    }
}

#[test]
fn half_of_the_padding_is_kept_to_the_borders_of_pages() {
    let charts = fans(40);
    for (width, height, pages) in TEXTURES {
        let options = AtlasOptions {
            padding_texels: 6,
            ..options(width, height, pages)
        };
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        for uv in mesh(&charts, &atlas).uvs.iter().flatten() {
            let texels = [uv[0].fract() * f64::from(width), uv[1] * f64::from(height)];
            let sides = [width, height].map(f64::from);
            let nearest = (0..2).map(|k| texels[k].min(sides[k] - texels[k]));
            assert!(nearest.fold(f64::INFINITY, f64::min) >= 3.0, "{uv:?}");
        }
    }
}

#[test]
fn the_page_that_grows_most_decides_how_far_charts_are_apart_on_all() {
    // Squeezed one by one, two pages are not as large as each other.
    for (n, pages) in [(4, 2), (5, 2), (9, 1)] {
        let charts = fans(n);
        let options = AtlasOptions {
            padding_texels: 16,
            budget_words: 20_000_000,
            ..options(512, 512, pages)
        };
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        let mesh = mesh(&charts, &atlas);
        let certificate = judged(&mesh, options.texture, 16);
        let padding = certificate.padding.expect("asked for");
        assert!(padding.kept, "{padding:?}");
        for uv in mesh.uvs.as_flattened() {
            let nearest = [uv[0].fract(), uv[1]].map(|x| x.min(1.0 - x));
            assert!(nearest.iter().all(|x| 512.0 * x >= 8.0), "{uv:?}");
        }
    }
}

#[test]
fn texels_are_square_on_the_surface() {
    let charts = fans(7);
    for (width, height, pages) in TEXTURES {
        let atlas = pack(&maps(&charts), &options(width, height, pages)).expect("a layout");
        let longer = f64::from(width.max(height));
        let texel = [width, height].map(|side| f64::from(side) / f64::from(1 << GRID_BITS));
        for ((uv, _), placed) in charts.iter().zip(&atlas.placed) {
            for (p, q) in [(0, 1), (3, 9), (7, 20)] {
                let length = (uv[p][0] - uv[q][0]).hypot(uv[p][1] - uv[q][1]);
                let along = |axis: usize| {
                    f64::from(placed.grid[p][axis] - placed.grid[q][axis]) * texel[axis]
                };
                let texels = along(0).hypot(along(1));
                assert!((texels - length * atlas.scale * longer).abs() < 0.01);
            }
        }
    }
}

#[test]
fn a_scale_that_is_given_is_kept_on_the_first_pages() {
    let charts = fans(30);
    for texels in [20.0, 60.0] {
        let options = AtlasOptions {
            scale: Scale::TexelsPerUnit(texels),
            ..options(512, 256, 10)
        };
        assert!(fits(&maps(&charts), &options).expect("charts"));
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        assert!((atlas.scale * 512.0 / texels - 1.0).abs() < 1e-12);
        let mesh = mesh(&charts, &atlas);
        let certificate = judged(&mesh, options.texture, 2);
        assert!(certificate.is_bijective() && certificate.padding.expect("asked for").kept);
        let used = certificate.pages.expect("asked for").used;
        let measured = MeasureOptions {
            aspect: 2.0,
            ..MeasureOptions::default()
        };
        let pages = mesh.measure_with(VAxis::Up, measured).pages;
        let numbers: Vec<u32> = pages.iter().map(|page| page.udim).collect();
        assert_eq!(numbers, (1001..1001 + used as u32).collect::<Vec<_>>());
        assert!(
            pages.iter().rev().skip(1).all(|page| page.fill > 0.5),
            "{pages:?}"
        );
    }
}

#[test]
fn a_scale_that_one_placement_misses_is_searched_and_squeezed_for() {
    let charts = fans(9);
    for pages in [1, 2] {
        let largest = AtlasOptions {
            budget_words: 50_000_000,
            ..options(512, 512, pages)
        };
        let fullest = pack(&maps(&charts), &largest).expect("a layout");
        let options = AtlasOptions {
            scale: Scale::TexelsPerUnit(0.995 * fullest.scale * 512.0),
            ..largest
        };
        assert!(!fits(&maps(&charts), &options).expect("charts"));
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        assert!((atlas.scale / fullest.scale / 0.995 - 1.0).abs() < 1e-12);
        let certificate = judged(&mesh(&charts, &atlas), options.texture, 2);
        assert!(certificate.is_bijective() && certificate.padding.expect("asked for").kept);
    }
}

#[test]
fn what_is_named_for_a_texture_that_is_too_small_does() {
    let charts = fans(30);
    let options = AtlasOptions {
        scale: Scale::TexelsPerUnit(150.0),
        ..options(512, 512, 1)
    };
    let error = pack(&maps(&charts), &options).expect_err("too small");
    assert_eq!(error, AtlasError::TextureTooSmall);
    let enough = enough(&maps(&charts), &options).expect("charts");
    for (resolution, pages) in [
        (enough.resolution.expect("one of few texels"), 1),
        (options.texture.resolution, enough.pages.expect("few")),
    ] {
        let texture = Texture { resolution, pages };
        let larger = AtlasOptions {
            texture,
            ..options.clone()
        };
        pack(&maps(&charts), &larger).expect("enough");
    }
}

#[test]
fn charts_across_borders_and_beyond_all_pages_are_counted() {
    let grid = |low: [f64; 2], size: f64| {
        UvMesh::grid(2).map_uvs(|[u, v]| [low[0] + size * u, low[1] + size * v])
    };
    let verdict = |low, size, pages| {
        let mesh = grid(low, size);
        let claims = Claims {
            pages: Some(pages),
            ..Claims::default()
        };
        let verdict = certify(&mesh.positions, &mesh.triangles, &mesh.uvs, &claims);
        verdict.pages.expect("asked for")
    };
    let step = f64::from(1 << 22).recip();
    assert!(
        verdict([2.0, 0.0], 1.0, 3).kept,
        "borders are part of a page"
    );
    for (low, size, pages) in [
        ([2.0, 0.0], 1.0, 2),
        ([1.0 - step, 0.5], 0.25, 2),
        ([0.75, 0.5], 0.25 + step, 2),
        ([-0.5, 0.0], 0.25, 2),
        ([0.5, 0.875], 0.25, 2),
        ([0.5, -0.125], 0.25, 2),
    ] {
        let verdict = verdict(low, size, pages);
        assert!(
            !verdict.kept && verdict.charts_across == 1,
            "{low:?} {verdict:?}"
        );
    }
}

#[test]
fn padding_is_counted_in_texels_along_each_axis() {
    // Two squares 4 texels apart along one axis, of a texture of 512 by 256.
    for (axis, side) in [(0, 512.0), (1, 256.0)] {
        let mut low = [0.25, 0.25];
        let small = |low: [f64; 2]| {
            UvMesh::grid(1).map_uvs(move |[u, v]| [low[0] + 0.125 * u, low[1] + 0.125 * v])
        };
        let mut mesh = small(low);
        low[axis] += 0.125 + 4.0 / side;
        mesh.add(&small(low));
        let texture = Texture {
            resolution: Resolution {
                width: 512,
                height: 256,
            },
            pages: 1,
        };
        let at = |texels| judged(&mesh, texture, texels).padding.expect("asked for");
        assert!(at(4).kept && !at(5).kept);
        assert_eq!(at(4).reached_texels, Some(4.0));
    }
}

#[test]
fn an_isometry_in_texels_is_measured_as_one() {
    let mesh = UvMesh::grid(3).map_uvs(|[u, v]| [0.1 + 0.25 * u, 0.2 + 0.5 * v]);
    let options = MeasureOptions {
        aspect: 2.0,
        ..MeasureOptions::default()
    };
    let measures = mesh.measure_with(VAxis::Up, options);
    let energy = measures.distortion.sym_dirichlet_max.expect("faces");
    assert!((energy - 4.0).abs() < 1e-9, "{energy}");
    let fill = measures.packing.pack_unit.expect("inside");
    assert!((fill - 0.125).abs() < 1e-3, "{fill}");
    assert!((measures.pages[0].fill - 0.125).abs() < 1e-12);
}
