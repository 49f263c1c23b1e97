//! Pictures deformed on grids, probed pixel by pixel.

use unwrapd_deform::warp::{GridError, picture_grid};
use unwrapd_files::picture::{Deformation, Extent, Image, ImageError, Warped, warped};
use unwrapd_maps::mesh::PlanarMesh;

/// A picture whose color tells the place.
fn ramp(width: usize, height: usize) -> Image {
    let mut image = Image::transparent(width, height);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        let (x, y) = (k % width, k / width);
        *pixel = [
            (x * 255 / (width - 1)) as u8,
            (y * 255 / (height - 1)) as u8,
            0,
            255,
        ];
    }
    image
}

fn warp(
    image: &Image,
    mesh: &PlanarMesh,
    map: impl Fn([f64; 2]) -> [f64; 2],
    extent: Extent,
) -> Result<Warped, ImageError> {
    let deformed: Vec<[f64; 2]> = mesh.vertices().iter().map(|&p| map(p)).collect();
    let deformation = Deformation {
        rest: mesh.vertices(),
        deformed: &deformed,
        triangles: mesh.triangles(),
    };
    warped(image, &deformation, extent)
}

fn pixel(image: &Image, x: usize, y: usize) -> [u8; 4] {
    image.pixels[y * image.width + x]
}

#[test]
fn grids_fill_their_picture() {
    for (width, height, n, size) in [
        (300, 200, 30, (30, 20)),
        (5, 1000, 100, (1, 100)),
        (1, 1, 1, (1, 1)),
    ] {
        let mesh = picture_grid(width, height, n).expect("a grid");
        assert_eq!(mesh.triangles().len(), 2 * size.0 * size.1);
        assert_eq!(mesh.reoriented(), 0);
        assert_eq!(mesh.vertices().last(), Some(&[width as f64, height as f64]));
    }
    assert_eq!(picture_grid(0, 5, 3), Err(GridError::Empty));
    assert_eq!(picture_grid(5, 5, 0), Err(GridError::Cells(0)));
    assert_eq!(
        picture_grid(5, 5, 1_000_000).map_err(|e| e.code()),
        Err("invalid_setting")
    );
}

#[test]
fn the_identity_gives_the_same_pixels() {
    let mut image = ramp(97, 61);
    image.pixels[500] = [10, 20, 30, 77];
    image.pixels[501] = [99, 99, 99, 0];
    let mesh = picture_grid(97, 61, 13).expect("a grid");
    for extent in [Extent::Source, Extent::Mesh] {
        let same = warp(&image, &mesh, |p| p, extent).expect("a picture");
        assert_eq!(same.origin, [0, 0]);
        for (k, (a, b)) in same.image.pixels.iter().zip(&image.pixels).enumerate() {
            // Without alpha there is no color.
            let expected = if b[3] == 0 { [0; 4] } else { *b };
            assert!(
                (0..4).all(|c| a[c].abs_diff(expected[c]) <= 1),
                "pixel {k}: {a:?} {b:?}"
            );
        }
    }
}

#[test]
fn a_shift_leaves_transparent_pixels_or_moves_the_origin() {
    let image = ramp(50, 40);
    let mesh = picture_grid(50, 40, 5).expect("a grid");
    let shift = |p: [f64; 2]| [p[0] + 10.0, p[1] - 7.0];
    let cut = warp(&image, &mesh, shift, Extent::Source)
        .expect("a picture")
        .image;
    assert_eq!((cut.width, cut.height), (50, 40));
    assert_eq!(pixel(&cut, 9, 0), [0; 4]);
    assert_eq!(pixel(&cut, 0, 39), [0; 4]);
    assert_eq!(pixel(&cut, 10, 0), pixel(&image, 0, 7));
    assert_eq!(pixel(&cut, 49, 32), pixel(&image, 39, 39));
    let whole = warp(&image, &mesh, shift, Extent::Mesh).expect("a picture");
    assert_eq!(whole.origin, [10, -7]);
    assert_eq!(whole.image, image);
}

#[test]
fn places_go_where_the_map_takes_them() {
    let image = ramp(200, 200);
    let mesh = picture_grid(200, 200, 40).expect("a grid");
    // A swirl that leaves the border alone.
    let swirl = |p: [f64; 2]| {
        let (x, y) = (p[0] - 100.0, p[1] - 100.0);
        let angle = 1.2 * (1.0 - x.hypot(y) / 100.0).max(0.0);
        let (sin, cos) = angle.sin_cos();
        [100.0 + cos * x - sin * y, 100.0 + sin * x + cos * y]
    };
    let result = warp(&image, &mesh, swirl, Extent::Source)
        .expect("a picture")
        .image;
    let mut worst = 0.0_f64;
    for i in 0..20 {
        for j in 0..20 {
            let from = [10.0 * f64::from(i) + 5.0, 10.0 * f64::from(j) + 5.0];
            let to = swirl(from);
            let shown = pixel(&result, to[0] as usize, to[1] as usize);
            let expected = from.map(|x| (x - 0.5) / 199.0 * 255.0);
            for k in 0..2 {
                worst = worst.max((f64::from(shown[k]) - expected[k]).abs());
            }
            assert_eq!(shown[3], 255);
        }
    }
    // A pixel is 1.3 steps of color; the map is linear on cells of 5 pixels only.
    assert!(worst < 3.0, "{worst}");
}

#[test]
fn what_shrinks_is_averaged() {
    // Stripes of one pixel.
    let mut image = Image::transparent(256, 256);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        let dark = (k % 256) % 2 == 0;
        *pixel = if dark {
            [0, 0, 0, 255]
        } else {
            [255, 255, 255, 255]
        };
    }
    let mesh = picture_grid(256, 256, 8).expect("a grid");
    for scale in [[0.11, 0.11], [0.3, 0.3], [0.07, 1.0], [0.25, 0.9]] {
        let small = warp(
            &image,
            &mesh,
            |p| [p[0] * scale[0], p[1] * scale[1]],
            Extent::Mesh,
        );
        let small = small.expect("a picture").image;
        for y in 2..small.height - 2 {
            for x in 2..small.width - 2 {
                let gray = pixel(&small, x, y)[0];
                assert!((85..170).contains(&gray), "{scale:?}: {gray} at {x}, {y}");
            }
        }
    }
}

#[test]
fn transparent_pixels_lend_no_color() {
    // An opaque red half beside a transparent green one.
    let mut image = Image::transparent(64, 64);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        *pixel = if k % 64 < 32 {
            [255, 0, 0, 255]
        } else {
            [0, 255, 0, 0]
        };
    }
    let mesh = picture_grid(64, 64, 4).expect("a grid");
    let map = |p: [f64; 2]| [0.37 * p[0] + 0.2, 0.37 * p[1]];
    let small = warp(&image, &mesh, map, Extent::Source)
        .expect("a picture")
        .image;
    let border = small
        .pixels
        .iter()
        .filter(|p| p[3] > 0 && p[3] < 255)
        .count();
    assert!(border > 10, "the border is soft");
    assert!(
        small.pixels.iter().all(|p| p[1] == 0),
        "green shines through"
    );
}

#[test]
fn flat_and_distant_triangles_are_bounded() {
    let image = ramp(32, 32);
    let mesh = picture_grid(32, 32, 4).expect("a grid");
    let flat = warp(&image, &mesh, |p| [p[0], 5.0], Extent::Mesh).expect("nothing");
    assert!(flat.image.pixels.is_empty());
    let far = warp(&image, &mesh, |p| p.map(|x| 1e12 * x), Extent::Source).expect("a corner");
    assert!(far.image.pixels.iter().all(|p| p[3] == 255));
    let huge = warp(&image, &mesh, |p| p.map(|x| 1e6 * x), Extent::Mesh);
    assert_eq!(huge.map_err(|e| e.code()), Err("image_too_large"));
    let empty = warp(&Image::transparent(0, 0), &mesh, |p| p, Extent::Source).expect("nothing");
    assert!(empty.image.pixels.is_empty());
}
