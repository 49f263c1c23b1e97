//! Packing: positive on the grid, inside the square, apart, the same every time.
use proptest::prelude::*;
use std::sync::Mutex;
use unwrapd_layout::atlas::{
    AtlasError, AtlasOptions, ChartMap, CoarseLayout, Effort, GRID_BITS, Placed, Positions,
    Rotation, Texture, pack,
};
use unwrapd_maps::mesh::Resolution;
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::solver::Control;

use crate::layouts::{Chart, assert_positive_and_inside, bar, blob, disk, maps, smallest_gap};

#[test]
fn one_triangle_fills_half_of_its_square() {
    let chart = (vec![[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]], vec![[0, 1, 2]]);
    let atlas = pack(
        &maps(&[chart]),
        &AtlasOptions {
            texture: Texture::square(1024),
            padding_texels: 0,
            ..AtlasOptions::default()
        },
    )
    .unwrap();
    assert!(
        (atlas.utilization - 0.5).abs() < 0.01,
        "{}",
        atlas.utilization
    );
}

#[test]
fn nothing_is_an_empty_atlas() {
    let atlas = pack(&[], &AtlasOptions::default()).unwrap();
    assert!(atlas.placed.is_empty());
    let empty = pack(
        &[ChartMap {
            uv: &[],
            triangles: &[],
        }],
        &AtlasOptions::default(),
    )
    .unwrap();
    assert_eq!(empty.placed.len(), 1);
}

#[test]
fn what_cannot_be_placed_is_named() {
    let good = blob(1.0, 3, 0.2);
    let mut far = good.clone();
    far.1[3][1] = 1000;
    let mut infinite = good.clone();
    infinite.0[2][0] = f64::NAN;
    let fault =
        |bad: Chart| pack(&maps(&[good.clone(), bad]), &AtlasOptions::default()).unwrap_err();
    assert_eq!(fault(far), AtlasError::IndexOutOfRange { chart: 1 });
    assert_eq!(fault(infinite), AtlasError::NonFinite { chart: 1 });
}

#[test]
fn charts_without_area_keep_their_shape_and_have_a_place() {
    let good = blob(1.0, 3, 0.2);
    let flattened = |height: f64, width: f64| {
        let mut chart = good.clone();
        chart
            .0
            .iter_mut()
            .for_each(|p| *p = [p[0] * width, p[1] * height]);
        chart
    };
    let (line, point, hair) = (
        flattened(0.0, 1.0),
        flattened(0.0, 0.0),
        flattened(1e-39, 1.0),
    );
    let elsewhere = (
        point.0.iter().map(|[u, v]| [u + 1.0, *v]).collect(),
        point.1.clone(),
    );
    let mixed = [good.clone(), line.clone(), point.clone(), hair.clone()];
    let points = [point, elsewhere];
    let sets = [&mixed[..], &[line], &points[..1], &[hair], &points];
    for (charts, positions) in sets
        .iter()
        .flat_map(|charts| [(charts, Positions::Unrelated), (charts, Positions::Layout)])
    {
        let options = AtlasOptions {
            positions,
            ..AtlasOptions::default()
        };
        let atlas = pack(&maps(charts), &options).unwrap();
        assert!(atlas.scale.is_finite() && atlas.scale > 0.0);
        let unit = atlas.scale * f64::from(1 << GRID_BITS);
        for ((uv, _), placed) in charts.iter().zip(&atlas.placed) {
            assert!(
                placed
                    .grid
                    .as_flattened()
                    .iter()
                    .all(|x| (0..=1 << GRID_BITS).contains(x))
            );
            let exact = (uv[0][0] - uv[20][0]).hypot(uv[0][1] - uv[20][1]) * unit;
            let [a, b] = [0, 20].map(|v: usize| placed.grid[v].map(f64::from));
            assert!(((a[0] - b[0]).hypot(a[1] - b[1]) - exact).abs() < 3.0);
        }
    }
}

/// The UVs of a palette: every edge has two faces, and all lie on one line.
#[test]
fn a_closed_surface_on_a_line_has_a_place() {
    let on_line = |x: f64| -> Chart {
        let uv = [0.1, 0.4, 0.2, 0.9].map(|y| [x, y]).to_vec();
        (uv, vec![[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]])
    };
    for charts in [
        vec![on_line(0.1)],
        (1..6).map(|i| on_line(f64::from(i) / 8.0)).collect(),
    ] {
        let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
        let side = 1 << GRID_BITS;
        let coordinates = atlas
            .placed
            .iter()
            .flat_map(|placed| placed.grid.as_flattened());
        assert!(coordinates.into_iter().all(|x| (0..=side).contains(x)));
        let grid = &atlas.placed[0].grid;
        assert_ne!(grid[0], grid[3]);
    }
}

#[test]
fn a_chart_finer_than_the_grid_is_rounded_as_it_is() {
    // A fan in a disk of 1e-9 of the chart: no grid has room for its triangles.
    let mut chart = blob(1.0, 3, 0.2);
    let first = chart.0.len() as u32;
    let n = 64;
    for k in 0..n {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
        chart.0.push([3.0 + 1e-9 * cos, 1e-9 * sin]);
    }
    chart.0.push([3.0, 0.0]);
    for k in 0..n {
        chart.1.push([first + k, first + (k + 1) % n, first + n]);
    }
    let atlas = pack(&maps(&[chart]), &AtlasOptions::default()).unwrap();
    assert_eq!(atlas.placed.len(), 1);
}

#[test]
fn a_chart_is_turned_but_not_mirrored_or_bent() {
    let charts = [blob(1.0, 3, 0.3), blob(0.4, 5, 0.2), blob(0.7, 2, 0.5)];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    let unit = atlas.scale * f64::from(1 << GRID_BITS);
    for ((uv, _), placed) in charts.iter().zip(&atlas.placed) {
        for (p, q) in [(0, 5), (3, 30), (18, 22)] {
            let exact = (uv[p][0] - uv[q][0]).hypot(uv[p][1] - uv[q][1]) * unit;
            let [a, b] = [p, q].map(|v| placed.grid[v].map(f64::from));
            assert!(((a[0] - b[0]).hypot(a[1] - b[1]) - exact).abs() < 3.0);
        }
    }
    assert!(atlas.utilization > 0.4, "{}", atlas.utilization);
    assert!(atlas.moved_vertices == 0 && atlas.largest_move < 1.0);
}

#[test]
fn thousands_of_tiny_charts_fit() {
    let charts: Vec<Chart> = (0..5000)
        .map(|i| blob(1.0 + f64::from(i % 7) / 7.0, 3, 0.1))
        .collect();
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(atlas.utilization > 0.4, "{}", atlas.utilization);
    assert!((atlas.padding_texels - 2.0).abs() < 1e-9);
}

#[test]
fn a_crowd_leaves_little_empty() {
    let part = |i: u32, times: f64| (f64::from(i) * times).fract();
    let blobs =
        (0..6000).map(|i| blob(0.3 + part(i, 0.618).powi(2), 3, 0.1 + 0.6 * part(i, 0.414)));
    let charts: Vec<Chart> = blobs.collect();
    let options = AtlasOptions {
        texture: Texture::square(4096),
        ..AtlasOptions::default()
    };
    let atlas = pack(&maps(&charts), &options).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(atlas.utilization > 0.63, "{}", atlas.utilization);
}

#[test]
fn padding_shrinks_when_it_leaves_no_room() {
    let charts: Vec<Chart> = (0..300)
        .map(|i| blob(1.0 + f64::from(i) / 300.0, 3, 0.1))
        .collect();
    let options = AtlasOptions {
        texture: Texture::square(64),
        padding_texels: 32,
        ..AtlasOptions::default()
    };
    let atlas = pack(&maps(&charts), &options).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(
        atlas.padding_texels < 4.0 && atlas.padding_texels > 0.5,
        "{}",
        atlas.padding_texels
    );
    assert!(smallest_gap(&charts[..40], &atlas, 64) >= atlas.padding_texels);
}

/// The angle by which a chart lies turned beyond how it was given, in turns.
fn turn(chart: &Chart, placed: &Placed) -> f64 {
    let angle = |p: [f64; 2], q: [f64; 2]| (q[1] - p[1]).atan2(q[0] - p[0]);
    let last = chart.0.len() - 1;
    let grid = |v: usize| placed.grid[v].map(f64::from);
    let turned = angle(grid(0), grid(last)) - angle(chart.0[0], chart.0[last]);
    (turned / std::f64::consts::TAU).rem_euclid(1.0)
}

fn rotated((uv, triangles): &Chart, turns: f64) -> Chart {
    let (sin, cos) = (turns * std::f64::consts::TAU).sin_cos();
    let rotated = uv
        .iter()
        .map(|[x, y]| [cos * x - sin * y, sin * x + cos * y]);
    (rotated.collect(), triangles.clone())
}

fn is_whole(x: f64) -> bool {
    (x - x.round()).abs() < 1e-5
}

#[test]
fn charts_are_only_turned_as_permitted() {
    let charts: Vec<Chart> = (0..12)
        .map(|i| rotated(&bar(1 + i % 4), f64::from(i as u32) / 50.0))
        .collect();
    for (rotation, times) in [(Rotation::Quarter, 4.0), (Rotation::None, 1.0)] {
        for charts in [&charts[..1], &charts] {
            let options = AtlasOptions {
                rotation,
                ..AtlasOptions::default()
            };
            let atlas = pack(&maps(charts), &options).unwrap();
            assert_positive_and_inside(charts, &atlas);
            for (chart, placed) in charts.iter().zip(&atlas.placed) {
                assert!(is_whole(times * turn(chart, placed)), "{rotation:?}");
            }
        }
    }
}

#[test]
fn a_lone_straight_chart_lies_along_the_axes() {
    // Across the square it would be larger.
    for turns in [0.0, 0.1, 0.2] {
        let chart = rotated(&bar(6), turns);
        let atlas = pack(
            &maps(std::slice::from_ref(&chart)),
            &AtlasOptions::default(),
        )
        .unwrap();
        assert!(is_whole(4.0 * (turns + turn(&chart, &atlas.placed[0]))));
    }
}

#[test]
fn copies_lie_alike() {
    // A brick without a corner, and the same mirrored: to lie head to foot gains them nothing.
    let shape: Chart = (
        vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.2, 1.0], [0.0, 0.8]],
        vec![[0, 1, 2], [0, 2, 3], [0, 3, 4]],
    );
    let mirrored: Chart = (
        shape.0.iter().map(|[x, y]| [-x, *y]).collect(),
        shape.1.iter().map(|&[a, b, c]| [a, c, b]).collect(),
    );
    for n in [8, 80, 800] {
        let given = |i: usize| f64::from(i as u32) * 0.137;
        let charts: Vec<Chart> = (0..n)
            .map(|i| rotated(if i % 4 == 3 { &mirrored } else { &shape }, given(i)))
            .collect();
        let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        let lies = |i: usize| given(i) + turn(&charts[i], &atlas.placed[i]);
        for i in 0..n {
            let first = if i % 4 == 3 { 3 } else { 0 };
            assert!(
                is_whole(lies(i) - lies(first)),
                "{i} of {n}: {}",
                lies(i) - lies(first)
            );
        }
    }
}

#[test]
fn more_charts_than_are_searched_are_squeezed() {
    let charts: Vec<Chart> = (0..100)
        .map(|i| blob(1.0 + f64::from(i % 9) / 3.0, 2 + i % 4, 0.3))
        .collect();
    let fill = |budget_words| {
        let options = AtlasOptions {
            budget_words,
            ..AtlasOptions::default()
        };
        let atlas = pack(&maps(&charts), &options).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
        atlas.utilization
    };
    let [placed, squeezed] = [0, 500_000_000].map(fill);
    assert!(squeezed > placed + 0.005, "{placed} {squeezed}");
}

#[test]
fn an_extreme_aspect_ratio_is_kept() {
    let needle = (
        vec![[0.0, 0.0], [1e6, 0.0], [1e6, 1.0], [0.0, 1.0]],
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let charts = [needle, blob(1e5, 3, 0.2)];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

#[test]
fn sizes_over_twelve_orders_of_magnitude_are_all_represented() {
    let charts: Vec<Chart> = (0..13).map(|k| blob(10.0_f64.powi(-k), 3, 0.2)).collect();
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(
        atlas.enlarged_charts > 0 && atlas.enlarged_charts < 9,
        "{}",
        atlas.enlarged_charts
    );
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

#[test]
fn a_hole_receives_a_small_chart() {
    // A frame with a hole of 80 % of its width, and charts that only fit together inside it.
    let ring = |r: f64| [[-r, -r], [r, -r], [r, r], [-r, r]];
    let uv = [ring(1.0), ring(0.8)].concat();
    let triangles = (0..4u32).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, 4 + j], [i, 4 + j, 4 + i]]
    });
    let square = (ring(0.7).to_vec(), vec![[0, 1, 2], [0, 2, 3]]);
    let charts = [(uv, triangles.collect()), square];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert!(atlas.utilization > 0.8, "{}", atlas.utilization);
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

#[test]
fn a_search_finds_what_the_first_layout_does_not() {
    // Placed by size the bars of a square of side 5 lie crosswise; every one of them fits along another.
    let charts: Vec<Chart> = [5, 4, 4, 3, 3, 2, 2, 1, 1].map(bar).into();
    let with = |budget_words| {
        let options = AtlasOptions {
            budget_words,
            ..AtlasOptions::default()
        };
        let atlas = pack(&maps(&charts), &options).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
        atlas.utilization
    };
    let [first, searched] = [0, 100_000_000].map(with);
    assert!(searched >= first && searched > 0.9, "{first} {searched}");
}

#[test]
fn charts_come_as_near_as_they_may() {
    // A raster of cells keeps them up to a cell farther apart.
    let charts: Vec<Chart> = (0..9)
        .map(|i| blob(1.0 + f64::from(i % 3), 2 + i % 4, 0.2))
        .collect();
    for padding_texels in [2, 8, 40] {
        let options = AtlasOptions {
            padding_texels,
            ..AtlasOptions::default()
        };
        let atlas = pack(&maps(&charts), &options).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        let gap = smallest_gap(&charts, &atlas, 1024);
        let wanted = f64::from(padding_texels);
        assert!((wanted..wanted + 0.3).contains(&gap), "{gap}");
        let side = f64::from(1 << GRID_BITS);
        let border = wanted / 2.0 / 1024.0 * side;
        let mut grid = atlas
            .placed
            .iter()
            .flat_map(|placed| &placed.grid)
            .flatten();
        assert!(grid.all(|&x| (border..=side - border).contains(&f64::from(x))));
    }
}

#[test]
fn a_chart_that_is_enlarged_takes_no_room_from_others() {
    // At the scale of the others, the last one has no cell of the grid.
    let mut charts: Vec<Chart> = (0..5).map(|i| blob(1.0, 2 + i, 0.2)).collect();
    let squeezed = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    charts.push(blob(1e-9, 3, 0.2));
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_eq!([squeezed.enlarged_charts, atlas.enlarged_charts], [0, 1]);
    assert_positive_and_inside(&charts, &atlas);
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
    let kept = atlas.utilization / squeezed.utilization;
    assert!(kept > 0.99, "{kept}");
}

#[test]
fn a_layout_becomes_fuller_when_a_chart_is_cut() {
    let options = AtlasOptions::default();
    let whole = bar(4);
    let mut layout = CoarseLayout::new(&maps(&[bar(1), whole, bar(1)]), &options)
        .unwrap()
        .unwrap();
    layout.improve(Effort::High, 20_000_000, &|_| Control::Continue);
    // The bar lies across the square, whose side is 5 / √2: 6 of 12.5.
    assert!((0.46..0.48).contains(&layout.fill()), "{}", layout.fill());
    let parts = [bar(2), bar(2)];
    let mut cut = layout.replaced(1, &maps(&parts)).unwrap();
    cut.improve(Effort::High, 20_000_000, &|_| Control::Continue);
    // 6 of 9.
    assert!(cut.fill() > 0.55, "{}", cut.fill());
    let again = {
        let mut again = layout.replaced(1, &maps(&parts)).unwrap();
        again.improve(Effort::High, 20_000_000, &|_| Control::Continue);
        again.fill()
    };
    assert!(again == cut.fill());
}

#[test]
fn a_search_ends_when_all_has_been_tried() {
    let squares = [bar(1), bar(1)];
    let layout = CoarseLayout::new(&maps(&squares), &AtlasOptions::default()).unwrap();
    let told = Mutex::new(Vec::new());
    layout
        .unwrap()
        .improve(Effort::Low, 1_000_000_000, &|words| {
            told.lock().unwrap().push(words);
            Control::Continue
        });
    let told = told.into_inner().unwrap();
    assert_eq!(told.iter().sum::<u64>(), 1_000_000_000);
    // What was not read is told at the end.
    assert!(*told.last().unwrap() > 900_000_000, "{told:?}");
}

/// The bound of the fill holds on square and long pages: a page that it rules out needs no search.
#[test]
fn no_layout_is_fuller_than_its_bound() {
    let longer = Texture {
        resolution: Resolution {
            width: 1024,
            height: 256,
        },
        pages: 1,
    };
    for texture in [Texture::square(1024), longer] {
        let options = AtlasOptions {
            texture,
            ..AtlasOptions::default()
        };
        for charts in [vec![bar(4)], vec![bar(9), bar(1)], vec![bar(2), bar(3)]] {
            let mut layout = CoarseLayout::new(&maps(&charts), &options)
                .unwrap()
                .unwrap();
            let most = layout.most_fill();
            layout.improve(Effort::High, 20_000_000, &|_| Control::Continue);
            // Coarse layouts are accurate to a fraction of a cell of 96.
            assert!(layout.fill() <= 1.02 * most, "{} of {most}", layout.fill());
        }
    }
}

#[test]
fn crowds_and_needles_have_no_coarse_layout() {
    let crowd: Vec<Chart> = (0..600).map(|_| bar(1)).collect();
    let needle = (vec![[0.0, 0.0], [1e6, 0.0], [1e6, 1.0]], vec![[0, 1, 2]]);
    // On the finer raster of many charts the sheets of such long ones would take hundreds of megabytes.
    let mut long: Vec<Chart> = (0..80).map(|_| bar(1)).collect();
    long.push((
        vec![[0.0, 0.0], [120.0, 0.0], [120.0, 0.1]],
        vec![[0, 1, 2]],
    ));
    for charts in [crowd, vec![needle], long] {
        let layout = CoarseLayout::new(&maps(&charts), &AtlasOptions::default());
        assert!(layout.unwrap().is_none());
    }
}

/// A map without a barrier may lie on itself upside down; the room below is taken all the same.
#[test]
fn a_folded_chart_keeps_its_room() {
    let square = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.5]];
    let folded = (square, vec![[0, 1, 2], [0, 2, 3], [2, 1, 4]]);
    let mut charts = vec![folded];
    charts.extend((0..8).map(|_| blob(0.05, 3, 0.1)));
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

#[test]
fn threads_and_order_do_not_matter() {
    let charts: Vec<Chart> = (0..60)
        .map(|i| {
            blob(
                1.0 + f64::from(i * 37 % 60),
                2 + i % 4,
                f64::from(i) / 200.0,
            )
        })
        .collect();
    let on = |threads: usize, charts: &[Chart]| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| pack(&maps(charts), &AtlasOptions::default()).unwrap())
    };
    let atlas = on(1, &charts);
    assert!(atlas == on(2, &charts));
    assert!(atlas == on(4, &charts));
    let reversed: Vec<Chart> = charts.iter().rev().cloned().collect();
    let mut other = on(2, &reversed);
    other.placed.reverse();
    assert!(atlas == other);
}

#[test]
fn needles_thinner_than_a_cell_are_opened() {
    let n = 600;
    let at = |i: u32| (1e-9 * f64::from(i)).sin_cos();
    let mut uv = vec![[0.0, 0.0]];
    uv.extend((0..=n).map(|i| [at(i).1, at(i).0]));
    let triangles = (1..=n).map(|i| [0, i, i + 1]).collect();
    let charts = [(uv, triangles), blob(0.3, 3, 0.2)];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(atlas.moved_vertices > 0);
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

/// A square with a slit from its lower side, `width` wide, its sides of `n[0]` and `n[1]` edges.
fn slit_square(width: f64, n: [u32; 2]) -> Chart {
    let (mouth, tip) = ([0.3, 0.0], [0.45, 0.8]);
    let mut uv = vec![tip, [0.0, 1.0], [1.0, 1.0]];
    let mut triangles = Vec::new();
    let mut ends = Vec::new();
    for (side, n) in [0.0, 1.0].into_iter().zip(n) {
        let first = uv.len() as u32;
        let mut last = first;
        for i in 0..=n {
            let t = f64::from(i) / f64::from(n);
            uv.push([side, t * tip[1]]);
            let shift = (side - 0.5) * width * (1.0 - t);
            let along = |k: usize| mouth[k] + t * (tip[k] - mouth[k]);
            let on_slit = if i == n { 0 } else { uv.len() as u32 };
            if i < n {
                uv.push([along(0) + shift, along(1)]);
            }
            if i > 0 {
                let slit_before = last + 1;
                let outer = first + 2 * i;
                let strip = [[last, slit_before, on_slit], [last, on_slit, outer]];
                let turned = |[a, b, c]: [u32; 3]| if side > 0.5 { [a, c, b] } else { [a, b, c] };
                triangles.extend(strip.map(turned));
                last = outer;
            }
        }
        ends.push(last);
    }
    triangles.extend([[ends[0], 0, 1], [0, 2, 1], [0, ends[1], 2]]);
    (uv, triangles)
}

/// Rounding alone lets the sides of such a slit cross.
#[test]
fn a_slit_thinner_than_a_cell_does_not_overlap() {
    for width in [1e-7, 1e-8, 1e-9, 0.0] {
        for n in [[3, 7], [11, 5], [31, 29]] {
            let chart = slit_square(width, n);
            let triangles = chart.1.clone();
            assert!(width == 0.0 || are_disjoint(&chart.0, &triangles));
            let atlas = pack(&maps(&[chart]), &AtlasOptions::default()).unwrap();
            let grid: Vec<_> = (atlas.placed[0].grid.iter())
                .map(|p| p.map(f64::from))
                .collect();
            assert!(are_disjoint(&grid, &triangles), "{width} {n:?}");
        }
    }
}

#[test]
fn a_thousand_triangles_within_one_cell_are_opened() {
    // Twelve rings of 40 within 1e-9 of the center of a disk of radius 1.
    let radius = |ring: usize, _| {
        if ring <= 12 {
            1e-10 * ring as f64
        } else {
            0.1 * (ring - 12) as f64
        }
    };
    let chart = disk(22, 40, radius);
    let fine = chart.1.iter().flatten().filter(|&&v| v <= 12 * 40).count();
    assert!(fine > 2500);
    let charts = [chart];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(atlas.largest_move < 4000.0, "{}", atlas.largest_move);
}

#[test]
fn a_graded_disk_keeps_every_ring() {
    for ratio in [0.5, 0.1, 0.01] {
        let charts = [disk(20, 12, |ring, _| f64::powi(ratio, 20 - ring as i32))];
        let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        assert!(
            atlas.largest_move < 2000.0,
            "{ratio}: {}",
            atlas.largest_move
        );
    }
}

#[test]
fn a_cramped_corner_of_the_outline_keeps_its_distance() {
    // The fine part is at the outline, which has to move.
    let mut fine = disk(6, 30, |ring, _| 1e-9 * ring as f64);
    for i in 0..30 {
        let j = (i + 1) % 30;
        let [a, b] = [i, j].map(|k: u32| 1 + 5 * 30 + k);
        let [x, y] = fine.0[a as usize];
        if i < 10 {
            fine.0.push([1e9 * x, 1e9 * y]);
            let tip = fine.0.len() as u32 - 1;
            fine.1.push([b, a, tip].map(|v| v));
            fine.1.last_mut().unwrap().rotate_left(1);
        }
    }
    fine.1.retain(|&t| {
        let [a, b, c] = t.map(|v| fine.0[v as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0
    });
    let charts = [fine, blob(1.0, 4, 0.3), blob(0.5, 3, 0.3)];
    let atlas = pack(&maps(&charts), &AtlasOptions::default()).unwrap();
    assert_positive_and_inside(&charts, &atlas);
    assert!(smallest_gap(&charts, &atlas, 1024) >= 2.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn random_charts_are_positive_inside_and_apart(
        shapes in prop::collection::vec((-3.0..3.0f64, 1u32..7, 0.0..0.6f64), 1..14),
        resolution in 64u32..2048,
        padding_texels in 0u32..6,
    ) {
        let charts: Vec<Chart> = shapes.iter().map(|&(size, waves, depth)| blob(size.exp(), waves, depth)).collect();
        let atlas = pack(&maps(&charts), &AtlasOptions { texture: Texture::square(resolution), padding_texels, ..AtlasOptions::default() }).unwrap();
        assert_positive_and_inside(&charts, &atlas);
        let gap = smallest_gap(&charts, &atlas, resolution);
        prop_assert!(gap >= atlas.padding_texels, "{gap} < {}", atlas.padding_texels);
        prop_assert!(gap > 0.0);
    }
}

/// A staircase of unit squares turned by an angle: its outline runs along two directions, and the
/// smallest rectangle around it along neither.
fn staircase(steps: u32, angle: f64) -> Chart {
    let (sin, cos) = angle.sin_cos();
    let mut uv = Vec::new();
    let mut triangles = Vec::new();
    let mut id = std::collections::HashMap::new();
    let mut vertex = |x: u32, y: u32| {
        *id.entry((x, y)).or_insert_with(|| {
            let (x, y) = (f64::from(x), f64::from(y));
            uv.push([cos * x - sin * y, sin * x + cos * y]);
            uv.len() as u32 - 1
        })
    };
    for step in 0..steps {
        for x in [step, step + 1] {
            let [a, b] = [vertex(x, step), vertex(x + 1, step)];
            let [c, d] = [vertex(x + 1, step + 1), vertex(x, step + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (uv, triangles)
}

#[test]
fn charts_with_straight_outlines_are_packed_upright() {
    let square = |side: f64| -> Chart {
        let uv = [[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]];
        (uv.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
    };
    for angle in [0.0, 0.3, 1.0, 2.5] {
        let charts = [staircase(5, angle), square(6.0), square(6.0), square(6.0)];
        let atlas = pack(&maps(&charts), &AtlasOptions::default()).expect("it packs");
        assert_positive_and_inside(&charts, &atlas);
        let grid = &atlas.placed[0].grid;
        // The first edge of every square is a side, the last of its first triangle a diagonal.
        for [a, b, _] in charts[0].1.iter().step_by(2) {
            let [p, q] = [a, b].map(|v| grid[*v as usize]);
            let off = [0, 1].map(|k| (q[k] - p[k]).abs());
            assert!(off[0].min(off[1]) <= 4, "{angle}: {off:?}");
        }
    }
}

#[test]
fn straight_charts_lie_along_the_axes_if_that_costs_little() {
    let hexagon = |turn: f64| -> Chart {
        let angle = |k: u32| std::f64::consts::TAU * (f64::from(k) / 6.0 + turn);
        let uv = (0..6).map(|k| [angle(k).cos(), angle(k).sin()]);
        (uv.collect(), (2..6).map(|k| [0, k - 1, k]).collect())
    };
    for turn in [0.05, 0.11] {
        let charts = [hexagon(turn), hexagon(2.0 * turn)];
        let atlas = pack(&maps(&charts), &AtlasOptions::default()).expect("a layout");
        for placed in &atlas.placed {
            let off_axis = |k: usize| {
                let [p, q] = [placed.grid[k], placed.grid[(k + 1) % 6]];
                (p[0] - q[0]).abs().min((p[1] - q[1]).abs())
            };
            let least = (0..6).map(off_axis).min();
            assert!(least <= Some(4), "{turn}: {least:?}");
        }
    }
}

#[test]
fn pages_that_are_not_square_are_squeezed_too() {
    let charts: Vec<Chart> = (0..8)
        .map(|i| blob(1.0 + f64::from(i % 3), 2 + i % 4, 0.2))
        .collect();
    let scale = |width: u32, height: u32| {
        let options = AtlasOptions {
            texture: Texture {
                resolution: Resolution { width, height },
                pages: 1,
            },
            ..AtlasOptions::default()
        };
        let atlas = pack(&maps(&charts), &options).expect("a layout");
        assert_positive_and_inside(&charts, &atlas);
        atlas.scale
    };
    // As much of a page is filled, about, whatever its shape.
    let square = scale(1024, 1024);
    for ratio in [scale(2048, 1024) / square, scale(1024, 2048) / square] {
        assert!((ratio - 0.5_f64.sqrt()).abs() < 0.04, "{ratio}");
    }
}
