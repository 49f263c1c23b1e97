//! Untangling of folded meshes, from their bytes.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;
use unwrapd_api::Upload;
use unwrapd_deform::{Boundary, RestOfFolded};
use unwrapd_files::io::{ElementFormat, Elements, Format};
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{
    BodyFormat, Observer, PipelineError, Progress, Stage, Unobserved, UntangleOptions, Untangled,
    untangle_file,
};

/// A grid of n × n squares of size 1, each cut into two triangles.
fn grid(n: u32) -> Elements {
    let at = |i: u32, j: u32| j * (n + 1) + i;
    let places = (0..=n).flat_map(|j| (0..=n).map(move |i| [f64::from(i), f64::from(j), 0.0]));
    let squares = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]]
    });
    Elements {
        vertices: places.collect(),
        triangles: triangles.collect(),
        tets: Vec::new(),
    }
}

/// A block of n³ cubes of size 1, each cut into six tetrahedra around a diagonal.
fn block(n: u32) -> Elements {
    let at = |[i, j, k]: [u32; 3]| (k * (n + 1) + j) * (n + 1) + i;
    let all = |most: u32| {
        (0..most).flat_map(move |k| (0..most).flat_map(move |j| (0..most).map(move |i| [i, j, k])))
    };
    // The axes along which a path leads from one end of the diagonal to the other; odd orders are wound the other way.
    let orders = [
        [0, 1, 2],
        [1, 2, 0],
        [2, 0, 1],
        [0, 2, 1],
        [2, 1, 0],
        [1, 0, 2],
    ];
    let tets = all(n).flat_map(|cube| {
        orders.into_iter().enumerate().map(move |(order, axes)| {
            let mut corner = cube;
            let mut tet = [at(corner); 4];
            for (place, axis) in axes.into_iter().enumerate() {
                corner[axis] += 1;
                tet[place + 1] = at(corner);
            }
            if order >= 3 {
                tet.swap(2, 3);
            }
            tet
        })
    });
    Elements {
        vertices: all(n + 1).map(|p| p.map(f64::from)).collect(),
        triangles: Vec::new(),
        tets: tets.collect(),
    }
}

/// Signed sizes of the elements, computed from their corners.
fn sizes(mesh: &Elements) -> Vec<f64> {
    let edge =
        |a: u32, b: u32, k: usize| mesh.vertices[b as usize][k] - mesh.vertices[a as usize][k];
    let triangles = mesh
        .triangles
        .iter()
        .map(|&[a, b, c]| 0.5 * (edge(a, b, 0) * edge(a, c, 1) - edge(a, b, 1) * edge(a, c, 0)));
    let tets = mesh.tets.iter().map(|&[a, b, c, d]| {
        let [p, q, r] = [b, c, d].map(|v| [0, 1, 2].map(|k| edge(a, v, k)));
        let minor = |i: usize, j: usize| q[i] * r[j] - q[j] * r[i];
        (p[0] * minor(1, 2) - p[1] * minor(0, 2) + p[2] * minor(0, 1)) / 6.0
    });
    triangles.chain(tets).collect()
}

/// Mirrors the vertices strictly inside the box of the mesh in its center: most elements fold.
fn folded(mut mesh: Elements) -> Elements {
    let high = mesh.vertices.last().copied().expect("vertices");
    let is_solid = !mesh.tets.is_empty();
    for p in &mut mesh.vertices {
        let is_inside = (0..if is_solid { 3 } else { 2 }).all(|k| p[k] > 0.0 && p[k] < high[k]);
        if is_inside {
            *p = [0, 1, 2].map(|k| high[k] - p[k]);
            p[0] += 0.1 * p[1];
        }
    }
    mesh
}

fn upload(mesh: &Elements, format: Format) -> Upload {
    let writer = ElementFormat::of(format).expect("a format of elements");
    let name = format!("mesh.{}", format.extension());
    Upload::single(name, writer.write(mesh).into_bytes())
}

fn untangled(mesh: &Elements, options: &UntangleOptions) -> Result<Untangled, PipelineError> {
    untangle_file(&upload(mesh, Format::Msh), None, options, &Unobserved)
}

/// The mesh in the main file of a result.
fn written(untangled: &Untangled) -> Elements {
    let (name, bytes) = &untangled.files[0];
    let format = ElementFormat::of_name(name).expect("a format of elements");
    format.read(bytes).expect("a mesh")
}

/// Every rest shape leads to a mesh without inversions whose border is where it was, in the plane and in space.
#[test]
fn folded_meshes_are_untangled_within_their_border() {
    for mesh in [folded(grid(8)), folded(block(4))] {
        let inverted = sizes(&mesh).iter().filter(|&&size| size <= 0.0).count();
        assert!(inverted > 10);
        let high = mesh.vertices.last().copied().expect("vertices");
        for rest in [RestOfFolded::Implied, RestOfFolded::Regular] {
            let options = UntangleOptions {
                rest,
                ..UntangleOptions::default()
            };
            let untangled = untangled(&mesh, &options).expect("a mesh without inversions");
            assert_eq!(untangled.report.inverted_before, inverted);
            let after = written(&untangled);
            assert!(sizes(&after).iter().all(|&size| size > 0.0), "{rest:?}");
            for (before, after) in mesh.vertices.iter().zip(&after.vertices) {
                let is_solid = !mesh.tets.is_empty();
                let on_border = (0..if is_solid { 3 } else { 2 })
                    .any(|k| before[k] == 0.0 || before[k] == high[k]);
                assert!(!on_border || before == after, "{before:?} {after:?}");
            }
        }
    }
}

/// Elements take the shapes of the given mesh, which must fit and be without inversions.
#[test]
fn a_given_mesh_has_the_rest_shapes() {
    let straight = block(3);
    let mut mesh = straight.clone();
    let middle = mesh
        .vertices
        .iter()
        .position(|p| p == &[1.0, 1.0, 1.0])
        .expect("a vertex");
    mesh.vertices[middle] = [2.6, 1.0, 1.0];
    let rest = upload(&straight, Format::Mesh);
    let untangled = untangle_file(
        &upload(&mesh, Format::Msh),
        Some(&rest),
        &UntangleOptions::default(),
        &Unobserved,
    );
    let untangled = untangled.expect("a mesh without inversions");
    assert!(sizes(&written(&untangled)).iter().all(|&size| size > 0.0));
    assert!(untangled.report.smallest > 0.5, "{:?}", untangled.report);
    let other = untangle_file(
        &upload(&mesh, Format::Msh),
        Some(&upload(&block(2), Format::Mesh)),
        &UntangleOptions::default(),
        &Unobserved,
    );
    assert_eq!(other.expect_err("other vertices").code(), "wrong_start");
    let both = untangle_file(
        &upload(&straight, Format::Msh),
        Some(&upload(&mesh, Format::Mesh)),
        &UntangleOptions::default(),
        &Unobserved,
    );
    assert_eq!(both.expect_err("a folded rest mesh").code(), "folded_mesh");
}

/// Files whose writer turned inverted elements around, so that all look positive, are folded all the same.
#[test]
fn the_order_of_corners_does_not_hide_folds() {
    let mut mesh = folded(grid(6));
    let sizes_before = sizes(&mesh);
    let inverted = sizes_before.iter().filter(|&&size| size < 0.0).count();
    for (triangle, size) in mesh.triangles.iter_mut().zip(sizes_before) {
        if size < 0.0 {
            triangle.swap(1, 2);
        }
    }
    let untangled =
        untangled(&mesh, &UntangleOptions::default()).expect("a mesh without inversions");
    assert_eq!(untangled.report.inverted_before, inverted);
    assert_eq!(untangled.report.turned, inverted);
    assert!(sizes(&written(&untangled)).iter().all(|&size| size > 0.0));
}

/// A mesh without inversions stays bit for bit.
#[test]
fn a_mesh_without_inversions_is_not_moved() {
    let mesh = grid(4);
    let untangled = untangled(&mesh, &UntangleOptions::default()).expect("a mesh");
    assert_eq!(
        (untangled.report.inverted_before, untangled.report.moved),
        (0, 0)
    );
    assert_eq!(written(&untangled).vertices, mesh.vertices);
}

#[test]
fn what_cannot_be_untangled_is_named() {
    // A corner with a single triangle, all of whose corners are on the border, pulled over the opposite side.
    let mut crossed = grid(4);
    crossed.vertices[4] = [-2.0, 6.0, 0.0];
    let free = UntangleOptions {
        boundary: Boundary::Free,
        ..UntangleOptions::default()
    };
    let error = untangled(&crossed, &UntangleOptions::default()).expect_err("a fixed border");
    assert_eq!(error.code(), "held_element_inverted");
    let after = written(&untangled(&crossed, &free).expect("a free border"));
    assert!(sizes(&after).iter().all(|&size| size > 0.0));
    // A Möbius strip of five squares laid into the plane.
    let strip = |i: u32| {
        let [a, b] = [2 * i, 2 * i + 1];
        let [c, d] = if i < 4 { [a + 2, b + 2] } else { [1, 0] };
        [[a, c, b], [b, c, d]]
    };
    let moebius = Elements {
        vertices: (0..10)
            .map(|v| [f64::from(v / 2), f64::from(v % 2), 0.0])
            .collect(),
        triangles: (0..5).flat_map(strip).collect(),
        tets: Vec::new(),
    };
    let error = untangled(&moebius, &UntangleOptions::default()).expect_err("one side");
    assert_eq!(error.code(), "not_orientable");
    let picture = UntangleOptions {
        format: Some(BodyFormat::Glb),
        ..UntangleOptions::default()
    };
    let error = untangled(&grid(2), &picture).expect_err("no document");
    assert_eq!(error.code(), "invalid_options");
}

/// A clock that advances by a second with every iteration; asks for an end after some of them.
struct Clock {
    seconds: AtomicU64,
    most: u64,
}

impl Clock {
    fn new(most: u64) -> Self {
        let seconds = AtomicU64::new(0);
        Self { seconds, most }
    }
}

impl Observer for Clock {
    fn progress(&self, progress: &Progress) -> Control {
        if progress.stage == Stage::Deform
            && self.seconds.fetch_add(1, Ordering::Relaxed) >= self.most
        {
            return Control::Finish;
        }
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::from_secs(self.seconds.load(Ordering::Relaxed))
    }
}

/// Work that ends while elements are inverted fails; once none is, the mesh at hand is the result, with a warning.
#[test]
fn a_time_limit_ends_the_work() {
    let mesh = upload(&folded(block(4)), Format::Msh);
    let within = |time_budget: Option<f64>, most: u64| {
        let options = UntangleOptions {
            time_budget,
            ..UntangleOptions::default()
        };
        let clock = Clock::new(most);
        let untangled = untangle_file(&mesh, None, &options, &clock);
        (untangled, clock.seconds.into_inner())
    };
    let (whole, n_iterations) = within(None, u64::MAX);
    assert!(whole.expect("a mesh").report.warnings.is_empty());
    let (all, _) = within(Some(n_iterations as f64 + 1.0), u64::MAX);
    assert!(all.expect("a mesh").report.warnings.is_empty());
    for (limit, most) in [(Some(2.0), u64::MAX), (Some(0.0), u64::MAX), (None, 2)] {
        let (early, n_iterations) = within(limit, most);
        let error = early.expect_err("inverted elements");
        assert_eq!((error.code(), error.exit_code()), ("ended_early", 6));
        assert!(n_iterations <= 4, "{n_iterations}");
    }
    let (last, _) = within(Some(n_iterations as f64 - 2.0), u64::MAX);
    let last = last.expect("a mesh without inversions");
    assert!(sizes(&written(&last)).iter().all(|&size| size > 0.0));
    assert_eq!(last.report.warnings[0].code, "ended_early");
}
