//! Textures resampled from one UV map to another.

use unwrapd_files::bake::{
    Corners, Coverage, Frames, Plane, Sampled, Texture, baked, baked_attribute, side_for,
    stacks_agree,
};
use unwrapd_files::document::{Encoding, Tint, Wrap};
use unwrapd_files::picture::{Image, Picture};

/// A rectangle as two triangles that share the edge between its first and third corner.
fn rectangle([a, b, c, d]: [[f64; 2]; 4]) -> Vec<Corners> {
    vec![[a, b, c], [a, c, d]]
}

/// Corners of a rectangle, the first one lowest in both directions.
fn corners(low: [f64; 2], high: [f64; 2]) -> [[f64; 2]; 4] {
    [low, [high[0], low[1]], high, [low[0], high[1]]]
}

fn unit_square() -> Vec<Corners> {
    rectangle(corners([0.0; 2], [1.0; 2]))
}

fn texture(picture: &Picture, encoding: Encoding, wrap: Wrap) -> Texture<'_> {
    Texture {
        picture,
        encoding,
        wrap: [wrap; 2],
        is_nearest: false,
        tint: Tint::NONE,
    }
}

/// The texture for `to` of what `texture` shows on `from`.
fn resampled(texture: Texture, from: &[Corners], to: &[Corners], side: usize) -> Image {
    let plane = plane(texture, from);
    baked(&plane, &Coverage::new(to, side))
}

fn plane<'a>(texture: Texture<'a>, from: &[Corners]) -> Plane<'a> {
    let size = texture.size();
    let sampled = |face: &Corners| {
        Some(Sampled {
            texture: 0,
            corners: face.map(|[u, v]| [u * size[0], v * size[1]]),
        })
    };
    Plane {
        encoding: texture.encoding,
        textures: vec![texture],
        faces: from.iter().map(sampled).collect(),
        frames: None,
        colors: None,
    }
}

/// A picture by its texels.
fn image(width: usize, height: usize, texel: impl Fn(usize, usize) -> [u8; 4]) -> Picture {
    let mut image = Image::transparent(width, height);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        *pixel = texel(k % width, k / width);
    }
    Picture::Eight(image)
}

/// The texel of a picture of 8 bits.
fn texel_of(picture: &Picture, [x, y]: [usize; 2]) -> [u8; 4] {
    match picture {
        Picture::Eight(image) => image.pixels[y * image.width + x],
        Picture::Sixteen(_) => unreachable!("the picture has 8 bits"),
    }
}

/// Each texel another color.
fn colorful(side: usize) -> Picture {
    image(side, side, |x, y| {
        [
            (17 * x + 40 * y) as u8,
            (91 * x) as u8,
            (53 * y + x) as u8,
            (3 * (x % 80)) as u8,
        ]
    })
}

#[test]
fn the_same_map_and_size_give_the_same_texels() {
    let source = colorful(32);
    for encoding in [Encoding::Color, Encoding::Data] {
        let texture = texture(&source, encoding, Wrap::Clamp);
        let result = resampled(texture, &unit_square(), &unit_square(), 32);
        assert_eq!(Picture::Eight(result), source);
    }
}

#[test]
fn a_quarter_turn_turns_the_texels() {
    let source = colorful(16);
    let [a, b, c, d] = corners([0.0; 2], [1.0; 2]);
    let turned = rectangle([b, c, d, a]);
    let texture = texture(&source, Encoding::Data, Wrap::Clamp);
    let result = resampled(texture, &unit_square(), &turned, 16);
    // What was at (x, y) is at (15 − y, x).
    for y in 0..16 {
        for x in 0..16 {
            let at = x * 16 + (15 - y);
            assert_eq!(result.pixels[at], texel_of(&source, [x, y]), "{x} {y}");
        }
    }
}

/// Copies keep what filtering reads beside an island, whatever the old texture has there.
#[test]
fn islands_moved_by_whole_texels_are_copied_with_their_borders() {
    let source = colorful(64);
    // An island with corners between texels, and its place after a flip, a quarter turn and a shift.
    let island = [[5.3, 6.1], [20.7, 7.4], [22.2, 19.9], [4.8, 17.6]];
    let unit = |[x, y]: [f64; 2]| [x / 64.0, y / 64.0];
    let moved = |[x, y]: [f64; 2]| [y + 30.0, x + 9.0];
    let from = rectangle(island.map(unit));
    let to = rectangle(island.map(|place| unit(moved(place))));
    let coverage = Coverage::new(&to, 64);
    for encoding in [Encoding::Color, Encoding::Data, Encoding::Normal] {
        let plane = plane(texture(&source, encoding, Wrap::Clamp), &from);
        let result: Image = baked(&plane, &coverage);
        let mut n_copied = [0, 0];
        for (k, texel) in result.pixels.iter().enumerate() {
            let [x, y] = [k % 64, k / 64];
            if coverage.at(x, y).is_some() {
                assert_eq!(*texel, texel_of(&source, [y - 9, x - 30]), "{x} {y}");
                n_copied[usize::from(coverage.is_inside(x, y))] += 1;
            }
        }
        assert!(n_copied[0] > 50 && n_copied[1] > 150, "{n_copied:?}");
    }
}

/// One face that has moved otherwise makes all of its island new: its texels fit together.
#[test]
fn islands_that_change_shape_are_resampled_as_a_whole() {
    let source = image(64, 64, |x, _| if x < 32 { [0; 4] } else { [255; 4] });
    let unit = |[x, y]: [f64; 2]| [x / 64.0, y / 64.0];
    // The right border of the island lies where the source changes; copies would read beyond it.
    let from = rectangle([[8.0, 8.0], [32.0, 8.0], [32.0, 32.0], [8.0, 32.0]].map(unit));
    let to =
        |last: f64| rectangle([[18.0, 8.0], [42.0, 8.0], [42.0, 32.0], [last, 32.0]].map(unit));
    let beside = |last: f64| {
        let texture = texture(&source, Encoding::Data, Wrap::Clamp);
        resampled(texture, &from, &to(last), 64).pixels[20 * 64 + 42]
    };
    assert_eq!(beside(18.0), [255; 4]);
    assert_ne!(beside(18.5), [255; 4]);
}

/// Every code of 16 bits in every encoding.
#[test]
fn copies_of_16_bits_are_exact() {
    let mut pixels: Vec<[u16; 4]> = (0..=u16::MAX)
        .map(|code| [code, !code, code, !code])
        .collect();
    pixels.rotate_left(1);
    let source = Image {
        width: 256,
        height: 256,
        pixels,
    };
    let picture = Picture::Sixteen(source.clone());
    for encoding in [Encoding::Color, Encoding::Data, Encoding::Normal] {
        let plane = plane(texture(&picture, encoding, Wrap::Clamp), &unit_square());
        let result: Image<u16> = baked(&plane, &Coverage::new(&unit_square(), 256));
        assert!(result == source, "{encoding:?}");
    }
}

/// A slope that 8 bits would show as steps.
#[test]
fn resampling_keeps_16_bits() {
    let source = Image {
        width: 64,
        height: 1,
        pixels: (0..64).map(|x| [1000 + 40 * x; 4]).collect(),
    };
    let picture = Picture::Sixteen(source);
    let plane = plane(
        texture(&picture, Encoding::Data, Wrap::Clamp),
        &unit_square(),
    );
    assert!(plane.is_deep());
    let result: Image<u16> = baked(&plane, &Coverage::new(&unit_square(), 32));
    let row: Vec<u16> = result.pixels[..32].iter().map(|texel| texel[0]).collect();
    let expected: Vec<u16> = (0..32).map(|x| 1020 + 80 * x).collect();
    assert_eq!(row, expected);
}

#[test]
fn a_gradient_stays_itself_on_any_affine_map() {
    let source = image(64, 64, |x, y| {
        [(2 * x + 20) as u8, (3 * y + 10) as u8, (x + y) as u8, 255]
    });
    let from = [[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8]];
    let to = [[0.1, 0.3], [0.7, 0.1], [0.9, 0.6], [0.3, 0.8]];
    let texture = texture(&source, Encoding::Data, Wrap::Clamp);
    let result = resampled(texture, &rectangle(from), &rectangle(to), 100);
    let mut n = 0;
    for y in 0..100 {
        for x in 0..100 {
            // Weights of the two edges at the first corner, which span the parallelogram.
            let (p, e, f) = (
                [0, 1].map(|k| ([x, y][k] as f64 + 0.5) / 100.0 - to[0][k]),
                [0.6, -0.2],
                [0.2, 0.5],
            );
            let area = e[0] * f[1] - e[1] * f[0];
            let (s, t) = (
                (p[0] * f[1] - p[1] * f[0]) / area,
                (e[0] * p[1] - e[1] * p[0]) / area,
            );
            if !(0.0..=1.0).contains(&s) || !(0.0..=1.0).contains(&t) {
                continue;
            }
            let texel = [0.2 + 0.6 * s, 0.2 + 0.6 * t].map(|u| u * 64.0 - 0.5);
            let wanted = [
                2.0 * texel[0] + 20.0,
                3.0 * texel[1] + 10.0,
                texel[0] + texel[1],
            ];
            for (c, wanted) in wanted.into_iter().enumerate() {
                let found = f64::from(result.pixels[y * 100 + x][c]);
                assert!((found - wanted).abs() <= 0.51, "{x} {y}: {found} {wanted}");
            }
            n += 1;
        }
    }
    assert!(n > 2500);
}

/// Black and white in equal parts are half of the light, 188 in sRGB; as data they are 128.
#[test]
fn what_gets_smaller_is_averaged_in_linear_light() {
    let source = image(64, 64, |x, y| {
        let value = 255 * ((x + y) % 2) as u8;
        [value, value, value, 255]
    });
    for (encoding, wanted) in [(Encoding::Color, 188), (Encoding::Data, 128)] {
        let texture = texture(&source, encoding, Wrap::Clamp);
        let result = resampled(texture, &unit_square(), &unit_square(), 16);
        for texel in &result.pixels {
            assert!((i32::from(texel[0]) - wanted).abs() <= 1, "{texel:?}");
        }
    }
}

/// A gray of many repeats, each of which is smaller than a texel.
#[test]
fn what_repeats_often_is_averaged_too() {
    let source = image(64, 64, |x, y| {
        let value = 255 * u8::from(x / 4 % 2 == y / 4 % 2);
        [value, value, value, 255]
    });
    let from = rectangle(corners([0.0; 2], [40.0; 2]));
    let texture = texture(&source, Encoding::Color, Wrap::Repeat);
    let result = resampled(texture, &from, &unit_square(), 16);
    for texel in &result.pixels {
        assert!((i32::from(texel[0]) - 188).abs() <= 2, "{texel:?}");
    }
}

#[test]
fn a_border_does_not_bleed_and_its_color_goes_on() {
    // The left half of the source is red, the right half green; the chart has the red one and is shrunk eightfold.
    let source = image(256, 256, |x, _| {
        if x < 128 {
            [255, 0, 0, 255]
        } else {
            [0, 255, 0, 255]
        }
    });
    let from = rectangle(corners([0.0, 0.0], [0.498, 1.0]));
    let to = rectangle(corners([0.3, 0.3], [0.5, 0.7]));
    let texture = texture(&source, Encoding::Color, Wrap::Clamp);
    let result = resampled(texture, &from, &to, 64);
    assert!(result.pixels.iter().all(|texel| *texel == [255, 0, 0, 255]));
}

#[test]
fn a_face_without_a_source_takes_the_colors_around() {
    let source = image(8, 8, |_, _| [7, 8, 9, 255]);
    let from = [unit_square(), unit_square()].concat();
    let to = [
        rectangle(corners([0.1, 0.1], [0.4, 0.9])),
        rectangle(corners([0.6, 0.1], [0.9, 0.9])),
    ]
    .concat();
    let mut plane = plane(texture(&source, Encoding::Data, Wrap::Clamp), &from);
    plane.faces[2] = None;
    plane.faces[3] = None;
    let result: Image = baked(&plane, &Coverage::new(&to, 32));
    assert!(result.pixels.iter().all(|texel| *texel == [7, 8, 9, 255]));
}

#[test]
fn what_lies_beyond_a_picture_is_what_its_sampler_says() {
    let source = image(4, 4, |x, _| [60 * x as u8, 0, 0, 255]);
    // Two and a half pictures beside each other.
    let from = rectangle(corners([-0.5, 0.0], [2.0, 1.0]));
    let row = |wrap: Wrap| -> Vec<u8> {
        let mut texture = texture(&source, Encoding::Data, wrap);
        texture.is_nearest = true;
        let result = resampled(texture, &from, &unit_square(), 10);
        result.pixels[..10].iter().map(|texel| texel[0]).collect()
    };
    assert_eq!(
        row(Wrap::Repeat),
        [120, 180, 0, 60, 120, 180, 0, 60, 120, 180]
    );
    assert_eq!(row(Wrap::Mirror), [60, 0, 0, 60, 120, 180, 180, 120, 60, 0]);
    assert_eq!(
        row(Wrap::Clamp),
        [0, 0, 0, 60, 120, 180, 180, 180, 180, 180]
    );
}

/// A bump along +u of the old map. On the new one, turned by a quarter, +u of the old one is where v falls on the picture, that is up.
#[test]
fn directions_turn_with_the_tangents() {
    let slanted = |x: f64, y: f64| {
        let z = (1.0 - x * x - y * y).sqrt();
        let [r, g, b] = [x, y, z].map(|c| (127.5 * c + 127.5).round() as u8);
        [r, g, b, 255]
    };
    let source = image(8, 8, |_, _| slanted(0.6, 0.0));
    let mut plane = plane(
        texture(&source, Encoding::Normal, Wrap::Clamp),
        &unit_square(),
    );
    let same = |tangent: [f32; 4]| vec![[tangent; 3]; 2];
    for (tangent, wanted) in [
        ([0.0, -1.0, 0.0, 1.0], slanted(0.0, 0.6)),
        ([-1.0, 0.0, 0.0, -1.0], slanted(-0.6, 0.0)),
        ([1.0, 0.0, 0.0, 1.0], slanted(0.6, 0.0)),
    ] {
        plane.frames = Some(Frames {
            normals: vec![[[0.0, 0.0, 2.0]; 3]; 2],
            from: same([1.0, 0.0, 0.0, 1.0]),
            to: same(tangent),
        });
        let result: Image = baked(&plane, &Coverage::new(&unit_square(), 8));
        for texel in &result.pixels {
            let apart = (0..3).map(|c| texel[c].abs_diff(wanted[c])).max();
            assert!(apart <= Some(1), "{tangent:?}: {texel:?} {wanted:?}");
        }
    }
}

/// In a quarter of the square a texture has to be twice as wide to show as much, and powers of two are wanted.
#[test]
fn a_texture_has_as_many_texels_as_before() {
    let source = colorful(300);
    let texture = texture(&source, Encoding::Color, Wrap::Clamp);
    let plane = plane(texture, &unit_square());
    assert_eq!(side_for(&plane, &unit_square()), 512);
    let quarter = rectangle(corners([0.0, 0.0], [0.5, 0.5]));
    assert_eq!(side_for(&plane, &quarter), 1024);
    let tiny = rectangle(corners([0.0, 0.0], [0.001, 0.001]));
    assert_eq!(side_for(&plane, &tiny), 4096);
}

/// The picture with most texels on its surface decides; one of a single color never does.
#[test]
fn the_side_suits_the_finest_picture() {
    let [fine, coarse, plain] = [colorful(256), colorful(16), colorful(1)];
    let halves = [
        rectangle(corners([0.0, 0.0], [0.5, 1.0])),
        rectangle(corners([0.5, 0.0], [1.0, 1.0])),
    ];
    let side = |other: &Picture| {
        let pictures = [&fine, other];
        let [first, second] = pictures.map(|picture| {
            plane(
                texture(picture, Encoding::Color, Wrap::Clamp),
                &unit_square(),
            )
        });
        let others = second.faces.into_iter().flatten().map(|sampled| {
            Some(Sampled {
                texture: 1,
                ..sampled
            })
        });
        let both = Plane {
            textures: [first.textures, second.textures].concat(),
            faces: first.faces.into_iter().chain(others).collect(),
            ..first
        };
        side_for(&both, &halves.concat())
    };
    // 256 texels on half of the square: 256 √2 along its side.
    assert_eq!(side(&fine), 512);
    assert_eq!((side(&coarse), side(&plain)), (512, 512));
}

/// Factors and offsets apply to linear light and to numbers, before rounding.
#[test]
fn a_tint_maps_decoded_values() {
    let mut picture = Image::transparent(2, 2);
    picture.pixels.fill([188, 100, 0, 200]);
    let picture = Picture::Eight(picture);
    let tint = Tint {
        factor: [0.5, 1.0, 1.0, 0.0],
        offset: [0.0, 0.0, 1.0, 1.0],
    };
    let shown = |encoding: Encoding| {
        let texture = Texture {
            tint,
            ..texture(&picture, encoding, Wrap::Clamp)
        };
        resampled(texture, &unit_square(), &unit_square(), 8).pixels[9]
    };
    // 188 is half of the light of 255, and 137 a quarter.
    assert_eq!(shown(Encoding::Color), [137, 100, 255, 255]);
    assert_eq!(shown(Encoding::Data), [94, 100, 255, 255]);
}

#[test]
fn any_number_of_threads_gives_the_same_picture() {
    let source = colorful(50);
    let ring: Vec<Corners> = (0..200)
        .map(|k| {
            let at = |k: f64, radius: f64| {
                let (sin, cos) = (k * std::f64::consts::TAU / 200.0).sin_cos();
                [0.5 + radius * cos, 0.5 + radius * sin]
            };
            let k = f64::from(k);
            [at(k, 0.2), at(k + 1.0, 0.45), at(k + 0.5, 0.3)]
        })
        .collect();
    let from: Vec<Corners> = ring.iter().map(|[a, b, c]| [*b, *c, *a]).collect();
    let in_pool = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool").install(|| {
            resampled(
                texture(&source, Encoding::Color, Wrap::Mirror),
                &from,
                &ring,
                150,
            )
        })
    };
    let one = in_pool(1);
    assert!(one.pixels.iter().any(|texel| *texel != one.pixels[0]));
    assert_eq!(one, in_pool(3));
}

/// What corners have is interpolated in faces, goes on beside them, and fills what is left.
#[test]
fn attributes_are_interpolated() {
    let faces = rectangle(corners([0.25, 0.25], [0.75, 0.75]));
    let coverage = Coverage::new(&faces, 16);
    let linear = |[u, v]: [f64; 2]| (3.0 * u - 2.0 * v) as f32;
    let values: Vec<[f32; 3]> = faces.iter().map(|face| face.map(linear)).collect();
    let image = baked_attribute(&coverage, &values);
    for (texel, &value) in image.iter().enumerate() {
        let (x, y) = (texel % 16, texel / 16);
        let at = [x, y].map(|c| (c as f64 + 0.5) / 16.0);
        let is_inside = (4..12).contains(&x) && (4..12).contains(&y);
        assert_eq!(coverage.is_inside(x, y), is_inside, "{x} {y}");
        let nearest = at.map(|c| c.clamp(0.25, 0.75));
        let is_beside = (3..13).contains(&x) && (3..13).contains(&y);
        if is_beside {
            assert!((value - linear(nearest)).abs() < 1e-6, "{x} {y}");
        }
        assert!((-0.75..=1.75).contains(&value), "{x} {y}: {value}");
    }
}

/// Colors multiply the texels in linear light, and go on beyond the border of their face.
#[test]
fn vertex_colors_multiply_texels() {
    let source = image(16, 16, |_, _| [188, 188, 188, 255]);
    let from = rectangle(corners([0.25, 0.25], [0.75, 0.75]));
    for to in [from.clone(), rectangle(corners([0.1, 0.2], [0.9, 0.8]))] {
        let mut plane = plane(texture(&source, Encoding::Color, Wrap::Clamp), &from);
        let red = [1.0, 0.0, 0.0, 0.4];
        plane.colors = Some(vec![[red; 3]; 2]);
        let result: Image = baked(&plane, &Coverage::new(&to, 16));
        assert!(result.pixels.iter().all(|texel| *texel == [188, 0, 0, 102]));
    }
}

#[test]
fn vertex_colors_are_linear_between_the_corners() {
    let white = image(1, 1, |_, _| [255; 4]);
    let mut plane = plane(
        texture(&white, Encoding::Color, Wrap::Clamp),
        &unit_square(),
    );
    let of = |corner: &[f64; 2]| [corner[0] as f32, corner[1] as f32, 0.0, 1.0];
    let colors = unit_square()
        .iter()
        .map(|face| face.each_ref().map(of))
        .collect();
    plane.colors = Some(colors);
    let result: Image<u16> = baked(&plane, &Coverage::new(&unit_square(), 64));
    let srgb = |linear: f64| {
        if linear <= 0.003_130_8 {
            12.92 * linear
        } else {
            1.055 * linear.powf(1.0 / 2.4) - 0.055
        }
    };
    for (k, texel) in result.pixels.iter().enumerate() {
        let center = [k % 64, k / 64].map(|x| (x as f64 + 0.5) / 64.0);
        for axis in [0, 1] {
            let wanted = 65_535.0 * srgb(center[axis]);
            assert!(
                (f64::from(texel[axis]) - wanted).abs() < 2.0,
                "{k} {texel:?}"
            );
        }
    }
}

/// Many faces of several colors need many texels; those of one color need none.
#[test]
fn the_side_suits_the_vertex_colors() {
    let white = image(1, 1, |_, _| [255; 4]);
    let n = 200;
    let at = |k: usize| k as f64 / n as f64;
    let cells = (0..n * n).map(|k| (k % n, k / n));
    let faces: Vec<Corners> = cells
        .flat_map(|(x, y)| rectangle(corners([at(x), at(y)], [at(x + 1), at(y + 1)])))
        .collect();
    let mut plane = plane(texture(&white, Encoding::Color, Wrap::Clamp), &faces);
    assert_eq!(side_for(&plane, &faces), 16);
    plane.colors = Some(vec![[[0.5; 4]; 3]; faces.len()]);
    assert_eq!(side_for(&plane, &faces), 16);
    // Two texels for each of 200 vertices along a side.
    plane.colors = Some(vec![[[0.5; 4], [0.1; 4], [0.5; 4]]; faces.len()]);
    assert_eq!(side_for(&plane, &faces), 512);
}

/// Stacked faces can share texels if they showed the same ones, whole periods apart or not.
#[test]
fn stacks_agree_where_they_show_the_same_texels() {
    let source = colorful(32);
    let place = |shift: f64| rectangle(corners([0.1 + shift, 0.1], [0.4 + shift, 0.4]));
    let to = [place(0.3), place(0.3)].concat();
    let coverage = Coverage::new(&to, 32);
    let agree = |shift: f64, wrap: Wrap| {
        let from = [place(0.0), place(shift)].concat();
        stacks_agree(
            &plane(texture(&source, Encoding::Color, wrap), &from),
            &coverage,
        )
    };
    assert!(agree(0.0, Wrap::Clamp));
    assert!(agree(2.0, Wrap::Repeat) && agree(2.0, Wrap::Mirror));
    assert!(!agree(1.0, Wrap::Mirror) && !agree(1.0, Wrap::Clamp));
    assert!(!agree(0.01, Wrap::Clamp));
    // Other texels of one color, and other colors of the same texels.
    let white = image(1, 1, |_, _| [255; 4]);
    let from = [place(0.0), place(0.5)].concat();
    let mut plain = plane(texture(&white, Encoding::Color, Wrap::Clamp), &from);
    assert!(stacks_agree(&plain, &coverage));
    let colors = [[1.0; 4], [1.0; 4], [0.5; 4], [0.5; 4]];
    plain.colors = Some(colors.map(|color| [color; 3]).to_vec());
    assert!(!stacks_agree(&plain, &coverage));
    // Faces without a texture need no texel; those on top of others own theirs.
    let sources = plain.faces.clone();
    plain.faces[..2].fill(None);
    assert!(stacks_agree(&plain, &coverage));
    plain.faces = sources;
    plain.faces[2..].fill(None);
    assert!(!stacks_agree(&plain, &coverage));
}
