//! Islands that make room for one that is dragged.
use unwrapd_layout::atlas::{
    Atlas, AtlasOptions, ChartMap, Followers, GRID_BITS, LiveLayout, pack,
};
use unwrapd_maps::plane::are_disjoint;
use unwrapd_method::numerics::bounds::bounds_of;

use crate::layouts::{Chart, blob, maps};

/// Wavy islands on a page, the first one for dragging.
fn islands(n: usize) -> Vec<Chart> {
    let charts: Vec<Chart> = (0..n)
        .map(|i| blob(1.0 / (1.0 + 0.2 * i as f64), 3 + i as u32 % 4, 0.3))
        .collect();
    let options = AtlasOptions {
        budget_words: 5_000_000,
        ..AtlasOptions::default()
    };
    let atlas: Atlas = pack(&maps(&charts), &options).expect("a layout");
    let unit = f64::from(1 << GRID_BITS);
    let on_page = charts.into_iter().zip(&atlas.placed);
    on_page
        .map(|((_, triangles), placed)| {
            let uv = placed.grid.iter().map(|p| p.map(|x| f64::from(x) / unit));
            (uv.collect(), triangles)
        })
        .collect()
}

fn center(uv: &[[f64; 2]]) -> [f64; 2] {
    let [low, high] = bounds_of(uv);
    [0, 1].map(|k| f64::midpoint(low[k], high[k]))
}

/// The island scaled, turned and moved to another center.
fn moved((uv, triangles): &Chart, to: [f64; 2], angle: f64, scale: f64) -> Chart {
    let from = center(uv);
    let (sin, cos) = angle.sin_cos();
    let place = |p: &[f64; 2]| {
        let [x, y] = [0, 1].map(|k| scale * (p[k] - from[k]));
        [to[0] + cos * x - sin * y, to[1] + sin * x + cos * y]
    };
    (uv.iter().map(place).collect(), triangles.clone())
}

/// The islands around as they make room.
fn around(islands: &[Chart], followers: &Followers) -> Vec<Chart> {
    let each = islands.iter().zip(&followers.middles);
    each.map(|(island, &middle)| moved(island, middle, 0.0, followers.scale))
        .collect()
}

fn live(islands: &[Chart]) -> LiveLayout {
    let maps: Vec<ChartMap> = maps(islands);
    LiveLayout::new(&maps[1..], &maps[..1], 1.0, &AtlasOptions::default()).expect("islands")
}

fn dragged(live: &mut LiveLayout, to: [f64; 2], angle: f64) -> Followers {
    live.drag(0, to, angle);
    live.make_room()
}

#[test]
fn islands_never_overlap_while_one_is_dragged() {
    for n in [2, 10, 30] {
        let islands = islands(n);
        let mut live = live(&islands);
        for step in 0..60 {
            let t = f64::from(step) / 60.0;
            let angle = std::f64::consts::TAU * t;
            let to = [0.5 + 0.3 * angle.cos(), 0.5 + 0.3 * (2.0 * angle).sin()];
            let followers = dragged(&mut live, to, angle);
            let mut all = around(&islands[1..], &followers);
            for (uv, _) in &all {
                let is_inside = uv.iter().flatten().all(|x| (0.0..=1.0).contains(x));
                assert!(is_inside, "{n} islands, step {step}");
            }
            all.push(moved(&islands[0], to, angle, 1.0));
            let mut uv = Vec::new();
            let mut triangles = Vec::new();
            for (points, faces) in all {
                let first = uv.len() as u32;
                uv.extend(points);
                triangles.extend(faces.into_iter().map(|t| t.map(|v| first + v)));
            }
            assert!(are_disjoint(&uv, &triangles), "{n} islands, step {step}");
        }
    }
}

#[test]
fn islands_keep_their_size_where_there_is_room() {
    let mut islands = islands(6);
    // Half as large, so that most of the page is free.
    for island in &mut islands {
        let [x, y] = center(&island.0);
        *island = moved(island, [x, y], 0.0, 0.5);
    }
    let mut live = live(&islands);
    let from = center(&islands[0].0);
    for step in 1..20 {
        let t = f64::from(step) / 20.0;
        let to = [0, 1].map(|k| from[k] + t * (0.5 - from[k]));
        let scale = dragged(&mut live, to, 0.0).scale;
        assert!(scale > 0.999, "step {step}: {scale}");
    }
}

#[test]
fn islands_that_are_not_in_the_way_stay() {
    let islands = islands(8);
    let mut live = live(&islands);
    let followers = dragged(&mut live, center(&islands[0].0), 0.0);
    let moves = islands[1..].iter().zip(&followers.middles);
    for ((uv, _), middle) in moves {
        let from = center(uv);
        let far = (middle[0] - from[0]).hypot(middle[1] - from[1]);
        // The page is full: islands that lay at the padding get a little more room.
        assert!(far < 1e-2, "{far}");
    }
}

#[test]
fn islands_regain_their_size_after_a_fast_drag() {
    for n in [3, 8, 20] {
        let islands = islands(n);
        let mut live = live(&islands);
        let from = center(&islands[0].0);
        let first = rested(&mut live, from);
        for corner in [[0.8, 0.8], [0.2, 0.8], [0.8, 0.2], [0.2, 0.2]] {
            dragged(&mut live, corner, 0.0);
        }
        let last = rested(&mut live, from);
        assert!(last > 0.995 * first, "{n} islands: {first} > {last}");
    }
}

/// Holds the first island at a place until the others no longer grow. Returns their scale.
fn rested(live: &mut LiveLayout, at: [f64; 2]) -> f64 {
    let mut scale = dragged(live, at, 0.0).scale;
    loop {
        let next = dragged(live, at, 0.0).scale;
        if next <= scale {
            return scale;
        }
        scale = next;
    }
}
