//! Needles put back where seams run along flipped edges.

use crate::zoo;
use unwrapd_layout::charts::{
    Cut, Folds, MappedChart, Unobserved, charts, map_chart, with_needles,
};
use unwrapd_maps::embed::{self, Options};
use unwrapd_maps::mesh::{Surface, longest_side, looks_like_edge, origin};
use unwrapd_method::numerics::vec2;
use unwrapd_method::numerics::vec3::{dot, sub};

#[test]
fn a_face_beyond_a_seam_is_laid_beside_the_other() {
    let mesh = zoo::needle_on_a_side();
    let surface = Surface::new(&mesh.positions, &mesh.triangles).unwrap();
    // Seams: none, a slit along the flipped edge, and a cut through it.
    for seams in [&[][..], &[[2, 3]], &[[2, 3], [2, 4]]] {
        let (mut without, of, steps) = surface.without_needles().unwrap();
        let ends = |h: u32| {
            let to = if h % 3 == 2 { h - 2 } else { h + 1 };
            [h, to].map(|h| {
                // Vertices are numbered anew: compare them by their places.
                let p = without.positions[origin(&without.triangles, h) as usize];
                surface.positions.iter().position(|q| *q == p).unwrap()
            })
        };
        let is_seam: Vec<bool> = (0..3 * without.triangles.len() as u32)
            .map(|h| {
                let [a, b] = ends(h);
                seams.contains(&[a.min(b), a.max(b)])
            })
            .collect();
        without.cut_along(|h, _| is_seam[h as usize]);
        let mut maps: Vec<MappedChart> = charts(&without, Cut::Seams)
            .into_iter()
            .flat_map(|chart| map_chart(chart, &Options::default(), Folds::Cut, &Unobserved))
            .collect();
        for corner in maps
            .iter_mut()
            .flat_map(|map| map.chart.corners.as_flattened_mut())
        {
            *corner = 3 * of[*corner as usize / 3] + *corner % 3;
        }
        let n_charts = maps.len();
        let maps = with_needles(&surface, &steps, maps, &Options::default(), &Unobserved);
        assert_eq!(maps.len(), n_charts, "{seams:?}");
        let mut corners = Vec::new();
        for map in &maps {
            let triangles = &map.chart.disk.triangles;
            assert!(
                embed::is_positive(triangles, &map.embedding.uv),
                "{seams:?}"
            );
            for (triangle, of_face) in triangles.iter().zip(&map.chart.corners) {
                for (&v, &corner) in triangle.iter().zip(of_face) {
                    let expected = surface.corners(corner as usize / 3)[corner as usize % 3];
                    assert_eq!(map.chart.positions[v as usize], expected, "{seams:?}");
                    corners.push(corner);
                }
            }
        }
        corners.sort_unstable();
        assert!(corners.into_iter().eq(0..15), "{seams:?}");
        // The shape is flat: nothing but the needle and what it pushes is distorted.
        let area: f64 = maps.iter().map(MappedChart::area).sum();
        assert!((area - 3.0).abs() < 1e-3, "{seams:?}: {area}");
    }
}

/// A needle is sheared a thousandfold if its vertex lies a little off its place along the longest side.
#[test]
fn needles_are_not_sheared() {
    let mesh = zoo::needle_on_a_side();
    let surface = Surface::new(&mesh.positions, &mesh.triangles).unwrap();
    let (without, of, steps) = surface.without_needles().unwrap();
    let mut maps: Vec<MappedChart> = charts(&without, Cut::Disk)
        .into_iter()
        .flat_map(|chart| map_chart(chart, &Options::default(), Folds::Cut, &Unobserved))
        .collect();
    for map in &mut maps {
        // Stretch the map unevenly.
        let size = map.area().sqrt();
        for p in &mut map.embedding.uv {
            *p = [
                p[0] + 0.1 * p[0] * p[0] / size,
                p[1] + 0.1 * p[1] * p[1] / size,
            ];
        }
        for corner in map.chart.corners.as_flattened_mut() {
            *corner = 3 * of[*corner as usize / 3] + *corner % 3;
        }
    }
    let maps = with_needles(&surface, &steps, maps, &Options::default(), &Unobserved);
    let mut n_needles = 0;
    for map in &maps {
        assert!(embed::is_positive(
            &map.chart.disk.triangles,
            &map.embedding.uv
        ));
        for triangle in &map.chart.disk.triangles {
            let rest = triangle.map(|v| map.chart.positions[v as usize]);
            if looks_like_edge(rest) {
                let uv = triangle.map(|v| map.embedding.uv[v as usize]);
                let (first, _) = longest_side(rest);
                let [p, q, r] = [0, 1, 2].map(|k| rest[(first + k) % 3]);
                let at_rest = dot(sub(r, p), sub(q, p)) / dot(sub(q, p), sub(q, p));
                let [p, q, r] = [0, 1, 2].map(|k| uv[(first + k) % 3]);
                let side = vec2::sub(q, p);
                let mapped = vec2::dot(vec2::sub(r, p), side) / vec2::dot(side, side);
                assert!((mapped - at_rest).abs() < 1e-9, "{mapped} for {at_rest}");
                n_needles += 1;
            }
        }
    }
    assert_eq!(n_needles, 1);
}
