//! Plane geometry of makers, against brute force and against the judge, which shares no code with it.

use unwrapd_maps::certificate::{Claims, Padding, boundary_crossings, certify_planar};
use unwrapd_maps::mesh::Resolution;
use unwrapd_maps::plane::{
    BoxIndex, Visit, are_disjoint, interiors_intersect, keep_apart, meeting_point,
    overlapping_pairs, search_budget, segment_distance,
};
use unwrapd_method::numerics::bounds::{Bounds, bounds_of, touch, widened};
use unwrapd_method::numerics::random::Random;

use crate::uv_meshes::UvMesh;

/// Boxes of very different sizes, some of them flat and some equal.
fn boxes(n: usize) -> Vec<Bounds> {
    let mut random = Random::new(n as u64);
    let mut one = |_| {
        let corner = [0, 1].map(|_| random.below(64) as f64);
        let size = [0, 1].map(|_| (16.0 * random.unit().powi(4)).floor());
        [corner, [0, 1].map(|k| corner[k] + size[k])]
    };
    (0..n).map(&mut one).collect()
}

#[test]
fn pairs_are_found_once_each() {
    for n in [0, 1, 2, 7, 8, 9, 64, 65, 300] {
        let boxes = boxes(n);
        let mut found = Vec::new();
        let visit = BoxIndex::new(&boxes).pairs(search_budget(n), |i, j| {
            found.push([i.min(j), i.max(j)]);
        });
        found.sort_unstable();
        let all = (0..n as u32).flat_map(|i| (i + 1..n as u32).map(move |j| [i, j]));
        let expected = all.filter(|&[i, j]| touch(&boxes[i as usize], &boxes[j as usize]));
        assert!(found == expected.collect::<Vec<_>>(), "{n} boxes");
        assert_eq!(visit, Visit::Complete);
    }
}

#[test]
fn boxes_that_meet_one_are_found_once_each() {
    for n in [0, 1, 8, 9, 300] {
        let all = boxes(n);
        let index = BoxIndex::new(&all);
        let around = bounds_of(all.as_flattened());
        for one in boxes(20).into_iter().chain([around]) {
            let mut found = Vec::new();
            index.meeting(&one, |i| found.push(i));
            found.sort_unstable();
            let expected = (0..n as u32).filter(|&i| touch(&all[i as usize], &one));
            assert!(found == expected.collect::<Vec<_>>(), "{n} boxes");
        }
    }
}

#[test]
fn the_closest_pair_is_of_two_groups() {
    for seed in 0..40 {
        let mut random = Random::new(seed);
        let points: Vec<[f64; 2]> = (0..120).map(|_| [random.unit(), random.unit()]).collect();
        let boxes: Vec<Bounds> = points.iter().map(|p| [*p, *p]).collect();
        let n_groups = [1, 2, 7, 120][seed as usize % 4];
        let groups: Vec<u32> = points
            .iter()
            .map(|p| (p[0] * f64::from(n_groups)) as u32)
            .collect();
        let distance = |i: u32, j: u32| {
            let [p, q] = [i, j].map(|k| points[k as usize]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let pairs = (0..120).flat_map(|i| (0..i).map(move |j| [i, j]));
        let apart = pairs.filter(|&[i, j]| groups[i as usize] != groups[j as usize]);
        let distances = apart.map(|[i, j]| distance(i, j));
        let expected = distances.fold(f64::INFINITY, f64::min);
        let found = BoxIndex::new(&boxes).closest(&groups, 1_000_000, distance);
        assert_eq!(found, (expected, Visit::Complete));
    }
}

#[test]
fn a_heap_of_boxes_ends_the_search() {
    let index = BoxIndex::new(&vec![[[0.0; 2], [1.0; 2]]; 1000]);
    let mut n_found = 0;
    assert_eq!(index.pairs(10_000, |_, _| n_found += 1), Visit::Truncated);
    assert!(n_found > 0 && n_found <= 10_000);
    let groups: Vec<u32> = (0..1000).collect();
    let (_, visit) = index.closest(&groups, 100, |_, _| 1.0);
    assert_eq!(visit, Visit::Truncated);
}

#[test]
fn what_encloses_nothing_meets_nothing() {
    let nothing = bounds_of(&[[f64::NAN; 2]]);
    let boxes = [[[0.0; 2], [1.0; 2]], nothing, [[1.0; 2], [2.0; 2]], nothing];
    let mut found = Vec::new();
    BoxIndex::new(&boxes[..3]).pairs(1000, |i, j| found.push([i, j]));
    assert_eq!(found, [[0, 2]]);
    assert!(!touch(&boxes[0], &widened(boxes[2], -0.5)));
}

/// Corners with small whole coordinates, so that much touches and lies on one line.
fn corners(n: usize, side: usize, random: &mut Random) -> Vec<[f64; 2]> {
    let mut one = |_| [0, 1].map(|_| random.below(side) as f64);
    (0..n).map(&mut one).collect()
}

#[test]
fn triangles_overlap_where_the_judge_says_so() {
    let mut random = Random::new(1);
    let mut n_overlapping = 0;
    for run in 0..400 {
        let n = [2, 3, 12][run % 3];
        let vertices = corners(3 * n, 8, &mut random);
        let mut triangles: Vec<[u32; 3]> = (0..n as u32)
            .map(|t| [0, 1, 2].map(|k| 3 * t + k))
            .collect();
        let at = |t: &[u32; 3]| t.map(|v| vertices[v as usize]);
        for triangle in &mut triangles {
            let own = std::slice::from_ref(triangle);
            if certify_planar(&vertices, own).inverted == 1 {
                triangle.swap(1, 2);
            }
        }
        let judged = certify_planar(&vertices, &triangles);
        assert_eq!(are_disjoint(&vertices, &triangles), judged.is_bijective());
        triangles.retain(|t| certify_planar(&vertices, &[*t]).is_valid());
        let faces: Vec<_> = triangles.iter().map(at).collect();
        let mut found = Vec::new();
        overlapping_pairs(&faces, |_| true, |pair| found.push(pair));
        found.sort_unstable();
        let pairs = (0..faces.len()).flat_map(|i| (i + 1..faces.len()).map(move |j| [i, j]));
        let overlap = |&[i, j]: &[usize; 2]| {
            certify_planar(&vertices, &[triangles[i], triangles[j]]).overlapping_pairs > 0
        };
        let expected: Vec<[usize; 2]> = pairs.filter(overlap).collect();
        assert_eq!(
            found,
            expected
                .iter()
                .map(|p| p.map(|i| i as u32))
                .collect::<Vec<_>>()
        );
        for &[i, j] in &expected {
            assert!(interiors_intersect(&faces[i], &faces[j]));
        }
        n_overlapping += found.len();
    }
    assert!(n_overlapping > 1000, "{n_overlapping}");
}

#[test]
fn polygons_meet_where_the_judge_says_so() {
    let mut random = Random::new(2);
    let (mut n_simple, mut n_not) = (0, 0);
    for run in 0..3000 {
        let polygon = corners(3 + run % 5, [5, 9, 100][run % 3], &mut random);
        let n = polygon.len() as u32;
        let fan: Vec<[u32; 3]> = (1..n - 1).map(|k| [0, k, k + 1]).collect();
        let crossings = boundary_crossings(&polygon, &fan);
        let found = meeting_point(std::slice::from_ref(&polygon));
        assert_eq!(found.is_some(), crossings > 0, "{polygon:?}");
        *(if crossings > 0 {
            &mut n_not
        } else {
            &mut n_simple
        }) += 1;
    }
    assert!(n_simple > 500 && n_not > 500, "{n_simple} {n_not}");
}

#[test]
fn polygons_meet_each_other_where_the_judge_says_so() {
    let mut random = Random::new(4);
    let mut n_of = [0; 2];
    for run in 0..600 {
        let polygons = [0, 1].map(|_| corners(3 + run % 3, 24, &mut random));
        if (polygons.iter()).any(|polygon| meeting_point(std::slice::from_ref(polygon)).is_some()) {
            continue;
        }
        let mut fans: Vec<[u32; 3]> = Vec::new();
        for polygon in &polygons {
            let first = fans.last().map_or(0, |fan| fan[2] + 1);
            fans.extend((2..polygon.len() as u32).map(|k| [first, first + k - 1, first + k]));
        }
        let do_cross = boundary_crossings(&polygons.concat(), &fans) > 0;
        assert_eq!(meeting_point(&polygons).is_some(), do_cross, "{polygons:?}");
        n_of[usize::from(do_cross)] += 1;
    }
    assert!(n_of.iter().all(|&n| n > 50), "{n_of:?}");
}

#[test]
fn the_first_edge_that_meets_another_is_named() {
    let crossed = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, -1.0]];
    for (turns, at) in [
        (0, [0.0, 0.0]),
        (1, [4.0, 4.0]),
        (2, [4.0, 4.0]),
        (3, [0.0, 0.0]),
    ] {
        let mut polygon = crossed.to_vec();
        polygon.rotate_left(turns);
        assert_eq!(meeting_point(&[polygon]), Some(at), "{turns}");
    }
}

/// Triangles as wide as each other, one above the other, shifted so that an index by places has
/// nodes that all meet; no two boxes do.
fn slivers(n: u32) -> Vec<[[f64; 2]; 3]> {
    let mut random = Random::new(5);
    (0..n)
        .map(|k| {
            let (x, y) = (random.unit(), f64::from(k));
            [[x, y], [x + 1.0, y], [x + 0.5, y + 0.5]].map(|[x, y]| [x, y / f64::from(n)])
        })
        .collect()
}

/// The same and one more, which comes upon the one at `part` of their height.
fn heap(n: u32, part: f64) -> Vec<[[f64; 2]; 3]> {
    let mut heap = slivers(n);
    let covered = heap[(part * f64::from(n - 1)) as usize];
    heap.push(covered.map(|[x, y]| [x + 0.25, y + 0.1 / f64::from(n)]));
    heap
}

#[test]
fn what_is_not_found_in_a_heap_is_taken_to_be_there() {
    // Parts to which the searches do not come before they end.
    let slivers = heap(150_000, 0.5);
    let vertices = slivers.as_flattened();
    let triangles: Vec<[u32; 3]> = (0..slivers.len() as u32)
        .map(|t| [0, 1, 2].map(|k| 3 * t + k))
        .collect();
    let mut n_found = 0;
    let visit = overlapping_pairs(&slivers, |_| true, |_| n_found += 1);
    assert_eq!((n_found, visit), (0, Visit::Truncated));
    assert!(!certify_planar(vertices, &triangles).is_bijective());
    assert!(!are_disjoint(vertices, &triangles));
    let polygons: Vec<_> = (heap(60_000, 0.375).iter()).map(|t| t.to_vec()).collect();
    assert!(meeting_point(&polygons).is_some());
}

#[test]
fn segments_are_as_far_apart_as_the_judge_measures() {
    let mut random = Random::new(3);
    for run in 0..300 {
        let mut mesh = UvMesh::default();
        let mut vertices = corners(6, 64, &mut random);
        if run % 10 == 0 {
            // Two edges on one line, apart.
            let by = [0, 1].map(|k| 2.0 * (vertices[1][k] - vertices[0][k]));
            let first = [0, 1, 2].map(|v| vertices[v]);
            vertices.truncate(3);
            vertices.extend(first.map(|[x, y]| [x + by[0], y + by[1]]));
        }
        for side in 0..2 {
            let mut chart = UvMesh::grid(1);
            chart.triangles.truncate(1);
            chart.uvs = vec![[0, 1, 2].map(|k| vertices[3 * side + k].map(|x| x / 64.0))];
            mesh.add(&chart);
        }
        let padding = Padding {
            texels: 1,
            resolution: Resolution::square(64),
        };
        let claims = Claims {
            padding: Some(padding),
            ..Claims::default()
        };
        let certificate = unwrapd_maps::certificate::certify(
            &mesh.positions,
            &mesh.triangles,
            &mesh.uvs,
            &claims,
        );
        let edges =
            |side: usize| [0, 1, 2].map(|k| [k, (k + 1) % 3].map(|k| vertices[3 * side + k]));
        let pairs = edges(0)
            .into_iter()
            .flat_map(|s| edges(1).map(move |t| [s, t]));
        let found = pairs
            .map(|[s, t]| segment_distance(s, t))
            .fold(f64::INFINITY, f64::min);
        let Some(verdict) = certificate.padding else {
            continue;
        };
        let reached = verdict.reached_texels.expect("two charts");
        assert!((found - reached).abs() < 1e-9, "{found} {reached}");
        let [low, high] = bounds_of(&vertices);
        let part = reached / (high[0] - low[0]).max(high[1] - low[1]);
        let polygons = [0, 3].map(|first| vertices[first..first + 3].to_vec());
        assert!(!keep_apart(&polygons, 1.001 * part + 1e-9));
        assert!(reached == 0.0 || keep_apart(&polygons, 0.999 * part));
    }
}
