//! Pictures pulled by handles: bijective with a fixed border whatever the handles ask, exact where nothing moves.

use unwrapd_deform::warp::{
    PictureHandle, PictureWarp, WarpError, WarpOptions, parse_handles, warp_picture,
};
use unwrapd_deform::{Boundary, Model};
use unwrapd_files::picture::Image;
use unwrapd_maps::certificate::certify_planar;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::solver::{Control, Iterate, Status};

use crate::random::Random;
use unwrapd_method::energy::{DensityKind, DisplacementKind, EnergyKind};

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

/// A picture whose color tells the place.
fn ramp(width: usize, height: usize) -> Image {
    let mut image = Image::transparent(width, height);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        let (x, y) = (k % width * 255 / width, k / width * 255 / height);
        *pixel = [x as u8, y as u8, 0, 255];
    }
    image
}

fn options(grid: usize, boundary: Boundary) -> WarpOptions {
    WarpOptions {
        grid,
        boundary,
        ..WarpOptions::default()
    }
}

/// The exact judgment, made here of the numbers that came out.
#[track_caller]
fn assert_bijective(warp: &PictureWarp, context: &str) {
    let certificate = certify_planar(&warp.deformed, warp.grid.triangles());
    assert!(certificate.is_bijective(), "{context}: {certificate:?}");
}

#[test]
fn with_a_fixed_border_extreme_moves_are_bijective() {
    const RUNS: usize = 200;
    let energies: [EnergyKind; _] = [
        DensityKind::Arap.into(),
        DensityKind::Arap.into(),
        DensityKind::SymmetricDirichlet.into(),
        DisplacementKind::Laplacian.into(),
        DensityKind::Green.into(),
    ];
    let (width, height) = (32, 24);
    let image = ramp(width, height);
    let size = [width as f64, height as f64];
    let mut random = Random::new(20_131);
    let (mut reached, mut unreachable) = (0, 0);
    for run in 0..RUNS {
        let n_handles = 1 + run % 4;
        let handles: Vec<PictureHandle> = (0..n_handles)
            .map(|_| PictureHandle::Point {
                at: random.place(size),
                to: random.place(size),
                weight: None,
            })
            .collect();
        let options = WarpOptions {
            model: Model {
                energy: energies[run % energies.len()].clone(),
                ..Model::default()
            },
            ..options(8, Boundary::Fixed)
        };
        let warp = match warp_picture(&image, &handles, &options, &go_on) {
            Ok(warp) => warp,
            Err(error) => {
                assert_eq!(error.code(), "contradictory_handles");
                continue;
            }
        };
        let context = format!("run {run}: {handles:?} {:?}", warp.summary);
        assert_bijective(&warp, &context);
        for (p, q) in warp.grid.vertices().iter().zip(&warp.deformed) {
            let on_border = (0..2).any(|k| p[k] == 0.0 || p[k] == size[k]);
            assert!(!on_border || p == q, "{context}");
        }
        let is_missed = warp.summary.status == Status::TargetsUnreachable;
        assert_eq!(!warp.summary.unreached.is_empty(), is_missed, "{context}");
        if warp.summary.residual < 1e-6 {
            reached += 1;
        } else {
            assert_eq!(warp.summary.status, Status::TargetsUnreachable, "{context}");
            unreachable += 1;
        }
    }
    // Of handles whose targets are too near to each other for the grid some stop short.
    assert!(reached >= RUNS / 3, "{reached} reached");
    assert!(unreachable >= 1 && reached + unreachable >= RUNS * 9 / 10);
}

#[test]
fn a_target_outside_a_fixed_border_is_out_of_reach() {
    let handle = PictureHandle::Point {
        at: [16.0, 12.0],
        to: [100.0, 12.0],
        weight: None,
    };
    let image = ramp(32, 24);
    let options = options(8, Boundary::Fixed);
    let warp =
        warp_picture(&image, std::slice::from_ref(&handle), &options, &go_on).expect("a warp");
    assert_eq!(warp.summary.status, Status::TargetsUnreachable);
    assert_bijective(&warp, "outside");
    assert!(warp.summary.residual > 68.0 * 68.0);
    let [unreached] = warp.summary.unreached[..] else {
        panic!("{:?}", warp.summary);
    };
    assert_eq!(unreached.handle, 0);
    let gap = warp.summary.residual.sqrt();
    assert!((unreached.distance - gap).abs() < 1e-9 * gap);
    assert_eq!(
        (warp.picture.image.width, warp.picture.image.height),
        (32, 24)
    );
}

#[test]
fn a_free_border_travels_with_its_handles() {
    // Every corner shifted: the picture is the same, elsewhere.
    let image = ramp(40, 20);
    let at = [[0.0, 0.0], [40.0, 0.0], [0.0, 20.0], [40.0, 20.0]];
    let handles = at.map(|at| PictureHandle::Point {
        at,
        to: [at[0] - 7.0, at[1] + 12.0],
        weight: None,
    });
    let warp =
        warp_picture(&image, &handles, &options(10, Boundary::Free), &go_on).expect("a warp");
    assert_eq!(warp.summary.status, Status::Converged);
    assert_eq!(warp.summary.residual, 0.0);
    for (p, q) in warp.grid.vertices().iter().zip(&warp.deformed) {
        assert!((q[0] - p[0] + 7.0).abs() < 1e-2 && (q[1] - p[1] - 12.0).abs() < 1e-2);
    }
    assert!(warp.summary.energy < 1e-6 && (warp.summary.smallest - 1.0).abs() < 1e-2);
    assert!((-8..=-7).contains(&warp.picture.origin[0]));
}

/// Where a map takes a point.
fn image_of(warp: &PictureWarp, p: [f64; 2]) -> [f64; 2] {
    let grid = warp.grid.vertices();
    for t in warp.grid.triangles() {
        let [a, b, c] = t.map(|v| grid[v as usize]);
        let area = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        let weights = [area(p, b, c), area(a, p, c), area(a, b, p)].map(|w| w / area(a, b, c));
        if weights.iter().all(|&w| w >= -1e-12) {
            let places = t.map(|v| warp.deformed[v as usize]);
            return [0, 1].map(|k| (0..3).map(|c| weights[c] * places[c][k]).sum());
        }
    }
    panic!("{p:?} is not in the picture");
}

#[test]
fn a_handle_holds_the_very_point_it_names() {
    let image = ramp(40, 20);
    // Grid vertices are 4 pixels apart.
    let pairs = [
        ([13.0, 9.0], [16.0, 11.0]),
        ([24.0, 8.0], [22.0, 7.0]),
        ([30.5, 13.1], [33.25, 9.75]),
    ];
    let handles = pairs.map(|(at, to)| PictureHandle::Point {
        at,
        to,
        weight: None,
    });
    for boundary in [Boundary::Free, Boundary::Fixed] {
        let warp = warp_picture(&image, &handles, &options(10, boundary), &go_on).expect("a warp");
        assert_eq!(warp.summary.status, Status::Converged);
        for (at, to) in pairs {
            let there = image_of(&warp, at);
            let is_there = (0..2).all(|k| (there[k] - to[k]).abs() < 1e-6);
            assert!(is_there, "{at:?} is at {there:?}, not {to:?}");
        }
    }
}

#[test]
fn next_to_a_fixed_border_a_handle_moves_the_nearest_inner_vertex() {
    let image = ramp(40, 20);
    let handle = PictureHandle::Point {
        at: [13.0, 0.5],
        to: [14.0, 1.5],
        weight: None,
    };
    let options = options(10, Boundary::Fixed);
    let warp =
        warp_picture(&image, std::slice::from_ref(&handle), &options, &go_on).expect("a warp");
    let vertex = (warp.grid.vertices().iter())
        .position(|p| *p == [12.0, 4.0])
        .expect("a grid vertex");
    assert_eq!(warp.deformed[vertex], [13.0, 5.0]);
}

#[test]
fn without_a_barrier_the_map_may_fold_and_the_report_says_so() {
    let image = ramp(32, 32);
    let handle = PictureHandle::Point {
        at: [8.0, 16.0],
        to: [28.0, 16.0],
        weight: None,
    };
    let fold = |barrier| {
        let options = WarpOptions {
            model: Model {
                barrier,
                ..Model::default()
            },
            ..options(8, Boundary::Fixed)
        };
        warp_picture(&image, std::slice::from_ref(&handle), &options, &go_on).expect("a warp")
    };
    let without = fold(BarrierKind::None);
    let judged = certify_planar(&without.deformed, without.grid.triangles());
    assert!(judged.inverted > 0 && !judged.is_bijective());
    assert_bijective(&fold(BarrierKind::InverseSpline), "with a barrier");
}

#[test]
fn what_cannot_be_warped_has_a_code() {
    let image = ramp(32, 24);
    let handle = |at: [f64; 2], to: [f64; 2]| PictureHandle::Point {
        at,
        to,
        weight: None,
    };
    let middle = [16.0, 12.0];
    let code = |handles: &[PictureHandle], options: &WarpOptions| {
        warp_picture(&image, handles, options, &go_on)
            .expect_err("an error")
            .code()
    };
    let fixed = options(8, Boundary::Fixed);
    assert_eq!(code(&[], &fixed), "handle_count");
    assert_eq!(
        code(&vec![handle(middle, middle); 1001], &fixed),
        "handle_count"
    );
    for outside in [[33.0, 3.0], [f64::NAN, 3.0]] {
        assert_eq!(code(&[handle(outside, middle)], &fixed), "handle_outside");
    }
    for nowhere in [[f64::INFINITY, 0.0], [0.0, 1e10]] {
        assert_eq!(code(&[handle(middle, nowhere)], &fixed), "bad_target");
    }
    let two = [handle(middle, middle), handle(middle, [17.0, 12.0])];
    assert_eq!(code(&two, &fixed), "contradictory_handles");
    let one = [handle(middle, middle)];
    assert_eq!(code(&one, &options(1, Boundary::Fixed)), "grid_too_coarse");
    assert_eq!(code(&one, &options(0, Boundary::Fixed)), "invalid_setting");
    for beta in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let model = Model {
            barrier_strength: Some(beta),
            ..Model::default()
        };
        assert_eq!(code(&one, &WarpOptions { model, ..fixed }), "bad_parameter");
    }
    let empty = Image::transparent(0, 5);
    let error = warp_picture(&empty, &one, &fixed, &go_on).expect_err("no pixels");
    assert_eq!(error.code(), "empty_image");
    for text in [
        "",
        "[]",
        "{\"handles\": [{\"at\": [1, 2]}]}",
        "{\"handles\": 1}",
    ] {
        let error = parse_handles(text.as_bytes()).expect_err("no handles");
        assert!(matches!(error, WarpError::Malformed(_)));
    }
    let parsed = parse_handles(b"{\"handles\": [{\"at\": [1, 2], \"to\": [3, 4.5]}]}");
    assert_eq!(parsed, Ok(vec![handle([1.0, 2.0], [3.0, 4.5])]));
}
