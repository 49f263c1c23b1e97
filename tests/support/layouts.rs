//! Charts to be packed, and what holds for every layout of them.

use unwrapd_layout::atlas::{Atlas, ChartMap, GRID_BITS};

pub type Chart = (Vec<[f64; 2]>, Vec<[u32; 3]>);

pub fn maps(charts: &[Chart]) -> Vec<ChartMap<'_>> {
    charts
        .iter()
        .map(|(uv, triangles)| ChartMap { uv, triangles })
        .collect()
}

/// Rings of vertices around a centre; `radius(ring, angle)`, ring 0 is the centre.
pub fn disk(rings: usize, sectors: usize, radius: impl Fn(usize, f64) -> f64) -> Chart {
    let mut uv = vec![[0.0; 2]];
    let mut triangles = Vec::new();
    let id = |ring: usize, j: usize| (1 + (ring - 1) * sectors + j % sectors) as u32;
    for ring in 1..=rings {
        for j in 0..sectors {
            let angle = std::f64::consts::TAU * j as f64 / sectors as f64;
            let r = radius(ring, angle);
            uv.push([r * angle.cos(), r * angle.sin()]);
            if ring == 1 {
                triangles.push([0, id(1, j), id(1, j + 1)]);
            } else {
                triangles.push([id(ring - 1, j), id(ring, j), id(ring, j + 1)]);
                triangles.push([id(ring - 1, j), id(ring, j + 1), id(ring - 1, j + 1)]);
            }
        }
    }
    (uv, triangles)
}

/// A blob with a wavy outline.
pub fn blob(size: f64, waves: u32, depth: f64) -> Chart {
    let wavy = move |angle: f64| 1.0 + depth * (f64::from(waves) * angle).cos();
    disk(2, 18, move |ring, angle| size * ring as f64 * wavy(angle))
}

fn area(grid: &[[i32; 2]], t: &[u32; 3]) -> i128 {
    let [a, b, c] = t.map(|v| grid[v as usize].map(i128::from));
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

pub fn assert_positive_and_inside(charts: &[Chart], atlas: &Atlas) {
    assert_eq!(charts.len(), atlas.placed.len());
    for ((uv, triangles), placed) in charts.iter().zip(&atlas.placed) {
        assert_eq!(uv.len(), placed.grid.len());
        assert!(
            placed
                .grid
                .iter()
                .flatten()
                .all(|&x| (0..=1 << GRID_BITS).contains(&x))
        );
        for t in triangles {
            assert!(area(&placed.grid, t) > 0, "triangle {t:?}");
        }
    }
}

fn boundary(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let edges = || {
        triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
    };
    let all: std::collections::HashSet<[u32; 2]> = edges().collect();
    edges().filter(|&[a, b]| !all.contains(&[b, a])).collect()
}

fn point_to_segment(p: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let d = [b[0] - a[0], b[1] - a[1]];
    let along = (p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1];
    let t = (along / (d[0] * d[0] + d[1] * d[1])).clamp(0.0, 1.0);
    (p[0] - a[0] - t * d[0]).hypot(p[1] - a[1] - t * d[1])
}

/// Smallest distance between the outlines of two charts, in texels; charts inside one another or
/// crossing are found by their triangles.
pub fn smallest_gap(charts: &[Chart], atlas: &Atlas, resolution: u32) -> f64 {
    let texel = f64::from(1 << GRID_BITS) / f64::from(resolution);
    let mut gap = f64::INFINITY;
    for i in 0..charts.len() {
        for j in 0..charts.len() {
            let at = |chart: usize, v: u32| atlas.placed[chart].grid[v as usize].map(f64::from);
            if i == j {
                continue;
            }
            for &[a, b] in &boundary(&charts[i].1) {
                for &[p, _] in &boundary(&charts[j].1) {
                    gap = gap.min(point_to_segment(at(j, p), [at(i, a), at(i, b)]));
                }
            }
            let inside = |t: &[u32; 3], p: [i32; 2]| {
                let corner = |v: u32| atlas.placed[i].grid[v as usize];
                let [a, b, c] = t.map(corner);
                [[a, b, p], [b, c, p], [c, a, p]]
                    .iter()
                    .all(|s| area(s, &[0, 1, 2]) > 0)
            };
            let covered = charts[i]
                .1
                .iter()
                .any(|t| atlas.placed[j].grid.iter().any(|&p| inside(t, p)));
            assert!(!covered, "chart {j} lies on chart {i}");
        }
    }
    gap / texel
}

/// A bar of so many squares.
pub fn bar(n: usize) -> Chart {
    let uv = (0..=n).flat_map(|i| [[i as f64, 0.0], [i as f64, 1.0]]);
    let triangles = (0..n as u32).flat_map(|i| {
        let [a, b, c, d] = [2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 3];
        [[a, c, d], [a, d, b]]
    });
    (uv.collect(), triangles.collect())
}
