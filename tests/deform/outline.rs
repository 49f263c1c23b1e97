//! Planar meshes from pictures and drawings.

use unwrapd_deform::outline::{
    ImageSettings, MeshSettings, Outline, OutlineError, OutlineResolution, SvgSettings, of_image,
    of_svg, triangulate,
};
use unwrapd_files::picture::{Image, ImageError};
use unwrapd_maps::certificate::{boundary_crossings, certify_planar};
use unwrapd_maps::mesh::PlanarMesh;

/// A picture whose alpha is a function of the pixel center.
fn picture(width: usize, height: usize, alpha: impl Fn(f64, f64) -> f64) -> Image {
    let mut image = Image::transparent(width, height);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        let (x, y) = ((k % width) as f64 + 0.5, (k / width) as f64 + 0.5);
        *pixel = [
            200,
            90,
            30,
            (255.0 * alpha(x, y).clamp(0.0, 1.0)).round() as u8,
        ];
    }
    image
}

/// A ring with anti-aliased edges, radii 20 and 40.
fn ring() -> Image {
    picture(100, 100, |x, y| {
        let r = (x - 50.0).hypot(y - 50.0);
        (40.5 - r).min(r - 19.5)
    })
}

fn svg(body: &str) -> Result<Outline, OutlineError> {
    let text = format!("<svg xmlns=\"http://www.w3.org/2000/svg\">{body}</svg>");
    of_svg(&text, &SvgSettings { tolerance: 0.01 })
}

fn code<T>(result: Result<T, OutlineError>) -> &'static str {
    result.map_or_else(|e| e.code(), |_| "made")
}

fn smallest_angle(mesh: &PlanarMesh) -> f64 {
    let angle = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]);
        (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1])
    };
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.vertices()[v as usize]);
        angle(a, b, c).min(angle(b, c, a)).min(angle(c, a, b))
    };
    mesh.triangles()
        .iter()
        .map(of)
        .fold(f64::INFINITY, f64::min)
        .to_degrees()
}

fn area(mesh: &PlanarMesh) -> f64 {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.vertices()[v as usize]);
        0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    };
    mesh.triangles().iter().map(of).sum()
}

#[test]
fn a_ring_keeps_its_hole_and_its_area() {
    let outline = of_image(&ring(), &ImageSettings::default()).expect("a ring");
    assert_eq!(outline.loops().len(), 2);
    let exact = std::f64::consts::PI * (1600.0 - 400.0);
    assert!(
        (outline.area() / exact - 1.0).abs() < 0.02,
        "{}",
        outline.area()
    );
    for boundary in outline.loops() {
        assert!(boundary.len() < 60, "{} vertices", boundary.len());
        for p in boundary {
            let r = (p[0] - 50.0).hypot(p[1] - 50.0);
            assert!(
                (r - 20.0).abs() < 0.2 || (r - 40.0).abs() < 0.2,
                "radius {r}"
            );
        }
    }
    let mesh = triangulate(&outline, &MeshSettings::default()).expect("triangles");
    assert!((area(&mesh) / outline.area() - 1.0).abs() < 1e-9);
    assert!(certify_planar(mesh.vertices(), mesh.triangles()).is_bijective());
    let n = mesh.triangles().len();
    assert!((4500..5500).contains(&n), "{n} triangles");
    assert!(smallest_angle(&mesh) > 24.9, "{}°", smallest_angle(&mesh));
    let mut used = vec![false; mesh.vertices().len()];
    mesh.triangles()
        .iter()
        .flatten()
        .for_each(|&v| used[v as usize] = true);
    assert!(used.iter().all(|&used| used), "a vertex that nothing uses");
    // Euler's formula for a ring, 3F = 2E − B.
    assert_eq!(2 * mesh.vertices().len(), n + mesh.boundary().len());
}

#[test]
fn an_opaque_picture_is_its_rectangle() {
    let image = picture(30, 20, |_, _| 1.0);
    let outline = of_image(&image, &ImageSettings::default()).expect("a rectangle");
    // The perimeter times the tolerance.
    assert!((outline.area() - 600.0).abs() < 50.0, "{}", outline.area());
    let exact = ImageSettings {
        tolerance_pixels: 0.0,
        ..ImageSettings::default()
    };
    let steps = of_image(&image, &exact).expect("a rectangle");
    // Only the corners are cut, by half a pixel's triangle.
    assert!(
        (steps.area() - (600.0 - 4.0 * 0.125)).abs() < 1e-9,
        "{}",
        steps.area()
    );
}

#[test]
fn pieces_that_touch_at_a_corner_stay_apart_or_join_but_never_touch() {
    let image = picture(20, 20, |x, y| f64::from(u8::from((x < 10.0) == (y < 10.0))));
    let exact = ImageSettings {
        tolerance_pixels: 0.0,
        ..ImageSettings::default()
    };
    for settings in [exact, ImageSettings::default()] {
        let outline = of_image(&image, &settings).expect("no touching");
        assert!((1..=2).contains(&outline.loops().len()));
        triangulate(&outline, &MeshSettings::default()).expect("triangles");
    }
}

#[test]
fn polygons_that_the_judge_finds_crossed_are_no_outline() {
    let square =
        |by: f64| [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]].map(|p| p.map(|x| x + by));
    for (by, is_crossed) in [(1.0, true), (4.0, true), (5.0, false)] {
        let squares = [square(0.0), square(by)];
        let halves = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
        assert_eq!(
            boundary_crossings(&squares.concat(), &halves) > 0,
            is_crossed
        );
        let made = code(Outline::new(
            squares.map(|polygon| polygon.to_vec()).to_vec(),
        ));
        assert_eq!(made == "self_intersecting_outline", is_crossed, "{by}");
    }
}

#[test]
fn specks_are_left_out() {
    let image = picture(40, 40, |x, y| {
        let speck = (x - 35.0).abs() < 1.0 && (y - 35.0).abs() < 1.0;
        f64::from(u8::from(
            (x - 15.0).abs() < 10.0 && (y - 15.0).abs() < 10.0 || speck,
        ))
    });
    let outline = of_image(&image, &ImageSettings::default()).expect("a square");
    assert_eq!(outline.loops().len(), 1);
    let all = ImageSettings {
        smallest_area: 0.0,
        ..ImageSettings::default()
    };
    assert_eq!(of_image(&image, &all).expect("both").loops().len(), 2);
}

#[test]
fn pictures_that_cannot_be_outlined_are_refused() {
    let settings = ImageSettings::default();
    let clear = picture(10, 10, |_, _| 0.2);
    assert_eq!(code(of_image(&clear, &settings)), "empty_outline");
    assert_eq!(
        code(of_image(&Image::transparent(0, 0), &settings)),
        "empty_outline"
    );
    let noise = picture(1200, 1200, |x, y| {
        (x * 12.9898 + y * 78.233)
            .sin()
            .mul_add(43758.5, 0.0)
            .fract()
    });
    assert_eq!(
        code(of_image(
            &noise,
            &ImageSettings {
                smallest_area: 0.0,
                ..settings
            }
        )),
        "outline_too_detailed"
    );
}

#[test]
fn pictures_come_from_files() {
    let image = ring();
    let png = image.png();
    assert_eq!(Image::decode(&png).as_ref(), Ok(&image));
    assert_eq!(
        Image::decode(b"GIF89a").map_err(|e| e.code()),
        Err("unknown_format")
    );
    assert_eq!(
        Image::decode(b"").map_err(|e| e.code()),
        Err("unknown_format")
    );
    assert_eq!(
        Image::decode(&png[..png.len() / 2]).map_err(|e| e.code()),
        Err("invalid_image")
    );
    // The header alone says 20000 × 20000.
    let mut huge = png.clone();
    huge[16..24].copy_from_slice(&[0, 0, 0x4E, 0x20, 0, 0, 0x4E, 0x20]);
    let checksum = crc32(&huge[12..29]);
    huge[29..33].copy_from_slice(&checksum.to_be_bytes());
    assert_eq!(
        Image::decode(&huge),
        Err(ImageError::TooLarge {
            width: 20000,
            height: 20000
        })
    );
}

/// The checksum of PNG chunks.
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0_u32, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| {
            (crc >> 1) ^ (0xEDB8_8320 & (crc & 1).wrapping_neg())
        })
    })
}

#[test]
fn shapes_and_transforms_have_the_right_area() {
    let cases = [
        ("<rect x='1' y='2' width='10px' height='20'/>", 200.0),
        (
            "<rect width='10' height='20' rx='5'/>",
            100.0 + 25.0 * std::f64::consts::PI,
        ),
        (
            "<circle cx='5' cy='5' r='10'/>",
            100.0 * std::f64::consts::PI,
        ),
        ("<ellipse rx='10' ry='5'/>", 50.0 * std::f64::consts::PI),
        ("<polygon points='0,0 10,0 10,10 0 10'/>", 100.0),
        ("<path d='M0 0h10v10h-10z'/>", 100.0),
        (
            "<g transform='scale(2) rotate(30)'><rect width='10' height='10' transform='translate(3,4)'/></g>",
            400.0,
        ),
        (
            "<rect width='10' height='10' transform='matrix(-1 0 0 1 0 0)'/>",
            100.0,
        ),
        (
            "<rect width='10' height='10' transform='skewX(45)'/>",
            100.0,
        ),
        // A hole by winding, one by rule, and none: nested the same way.
        ("<path d='M0 0h10v10h-10z M2 2v6h6v-6z'/>", 64.0),
        (
            "<path fill-rule='evenodd' d='M0 0h10v10h-10z M2 2h6v6h-6z'/>",
            64.0,
        ),
        ("<path d='M0 0h10v10h-10z M2 2h6v6h-6z'/>", 100.0),
        // Shapes in one another are one; in a hole they are an island.
        (
            "<rect width='10' height='10'/><circle cx='5' cy='5' r='2'/>",
            100.0,
        ),
        (
            "<path d='M0 0h10v10h-10z M2 2v6h6v-6z'/><rect x='4' y='4' width='2' height='2'/>",
            68.0,
        ),
        // What is not drawn.
        (
            "<rect width='10' height='10'/><g style='display:none'><rect width='99' height='99'/></g>",
            100.0,
        ),
        (
            "<defs><rect width='99' height='99'/></defs><rect width='10' height='10'/><path fill='none' d='M0 0L5 5'/>",
            100.0,
        ),
    ];
    for (body, expected) in cases {
        let outline = svg(body).expect(body);
        assert!(
            (outline.area() / expected - 1.0).abs() < 0.005,
            "{body}: {}",
            outline.area()
        );
        let mesh = triangulate(&outline, &MeshSettings::default()).expect(body);
        assert!((area(&mesh) / outline.area() - 1.0).abs() < 1e-8, "{body}");
    }
}

#[test]
fn drawings_that_cannot_be_outlined_are_refused() {
    let cases = [
        ("", "empty_outline"),
        ("<path d='M0 0L10 0L10 10'/>", "open_path"),
        ("<polyline points='0,0 10,0 10,10'/>", "open_path"),
        (
            "<path d='M0 0L10 10L10 0L0 10z'/>",
            "self_intersecting_outline",
        ),
        (
            "<path d='M0 0L10 0L5 0L5 5z'/>",
            "self_intersecting_outline",
        ),
        (
            "<rect width='10' height='10'/><rect x='5' y='5' width='10' height='10'/>",
            "self_intersecting_outline",
        ),
        (
            "<rect width='10' height='10'/><rect x='10' width='10' height='10'/>",
            "self_intersecting_outline",
        ),
        ("<path d='M0 0Lx'/>", "invalid_svg"),
        ("<rect width='3cm' height='1'/>", "invalid_svg"),
        (
            "<rect width='1' height='1' transform='twist(3)'/>",
            "invalid_svg",
        ),
        (
            "<rect width='1e300' height='1e300' transform='scale(1e300)'/>",
            "invalid_svg",
        ),
        ("<rect", "invalid_svg"),
    ];
    for (body, expected) in cases {
        assert_eq!(code(svg(body)), expected, "{body}");
    }
    let settings = SvgSettings::default();
    let bomb = "<!DOCTYPE svg [<!ENTITY a 'aaaa'><!ENTITY b '&a;&a;'>]><svg>&b;</svg>";
    assert_eq!(code(of_svg(bomb, &settings)), "invalid_svg");
    assert_eq!(code(of_svg("<html/>", &settings)), "invalid_svg");
    let deep = format!("{}{}", "<g>".repeat(5000), "</g>".repeat(5000));
    assert_eq!(code(svg(&deep)), "invalid_svg");
    let declared = "<!DOCTYPE svg PUBLIC \"-//W3C//DTD SVG 1.1//EN\" \"http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd\">\
        <svg><rect width='1' height='1'/></svg>";
    assert_eq!(code(of_svg(declared, &settings)), "made");
    assert_eq!(
        code(of_svg(declared, &SvgSettings { tolerance: 0.0 })),
        "invalid_setting"
    );
}

#[test]
fn meshes_are_as_fine_as_asked_or_refused() {
    let outline = svg("<circle r='100'/>").expect("a disk");
    let with = |resolution| MeshSettings {
        resolution,
        ..MeshSettings::default()
    };
    for n in [2000, 5000, 20_000] {
        let mesh =
            triangulate(&outline, &with(OutlineResolution::Triangles(n))).expect("triangles");
        let ratio = mesh.triangles().len() as f64 / n as f64;
        assert!((0.85..1.15).contains(&ratio), "{n}: {ratio}");
    }
    let h = 5.0;
    let mesh = triangulate(&outline, &with(OutlineResolution::EdgeLength(h))).expect("triangles");
    let mean: f64 = mesh
        .triangles()
        .iter()
        .map(|t| {
            let [a, b] = [t[0], t[1]].map(|v| mesh.vertices()[v as usize]);
            (a[0] - b[0]).hypot(a[1] - b[1])
        })
        .sum::<f64>()
        / mesh.triangles().len() as f64;
    assert!((0.8..1.2).contains(&(mean / h)), "{mean}");
    assert_eq!(
        code(triangulate(
            &outline,
            &with(OutlineResolution::EdgeLength(0.001))
        )),
        "too_many_triangles"
    );
    assert_eq!(
        code(triangulate(
            &outline,
            &with(OutlineResolution::EdgeLength(f64::NAN))
        )),
        "invalid_setting"
    );
    assert_eq!(
        code(triangulate(
            &outline,
            &with(OutlineResolution::Triangles(0))
        )),
        "invalid_setting"
    );
    let sharp = MeshSettings {
        smallest_angle: 60.0,
        ..MeshSettings::default()
    };
    assert_eq!(code(triangulate(&outline, &sharp)), "invalid_setting");
}

#[test]
fn equal_outlines_give_equal_meshes_wherever_they_lie() {
    let outline = of_image(&ring(), &ImageSettings::default()).expect("a ring");
    let mesh = triangulate(&outline, &MeshSettings::default()).expect("triangles");
    let again = triangulate(&outline, &MeshSettings::default()).expect("triangles");
    assert_eq!(mesh, again);
    for (scale, shift) in [(1e-6, 0.0), (1e6, -1e9), (1.0, 1e6)] {
        let moved = |l: &Vec<[f64; 2]>| l.iter().map(|p| p.map(|x| scale * x + shift)).collect();
        let moved = Outline::new(outline.loops().iter().map(moved).collect()).expect("a ring");
        let mesh = triangulate(&moved, &MeshSettings::default()).expect("triangles");
        assert!((area(&mesh) / (scale * scale * outline.area()) - 1.0).abs() < 1e-6);
        assert!(smallest_angle(&mesh) > 24.0);
    }
}
