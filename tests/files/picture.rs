//! Pictures of layouts and distortion, probed pixel by pixel.
use image::RgbImage;
use unwrapd_files::picture::{HeatmapMeasure, Image, Panel, Picture, heatmap_png, layout_png};
use unwrapd_maps::measure::FaceDistortion;
use unwrapd_maps::mesh::VAxis;

type CornerUvs = [[f64; 2]; 3];

const WHITE: [u8; 3] = [255; 3];
const YELLOW: [u8; 3] = [255, 214, 10];
const MEASURES: [HeatmapMeasure; 3] = [
    HeatmapMeasure::Conformal,
    HeatmapMeasure::Area,
    HeatmapMeasure::SymmetricDirichlet,
];

fn decode(png: &[u8]) -> RgbImage {
    image::load_from_memory(png).unwrap().into_rgb8()
}

/// The color at a place given in parts of the width, from the upper left corner.
fn at(picture: &RgbImage, x: f64, y: f64) -> [u8; 3] {
    let side = f64::from(picture.width());
    picture.get_pixel((x * side) as u32, (y * side) as u32).0
}

fn face(value: f64, flipped: bool) -> FaceDistortion {
    FaceDistortion {
        counts: true,
        conformal: value,
        area: value,
        symmetric_dirichlet: 4.0 * value,
        stretch: value,
        flipped,
        degenerate: !value.is_finite(),
    }
}

/// Two faces of one chart that make the square between two corners.
fn square(low: [f64; 2], high: [f64; 2]) -> [CornerUvs; 2] {
    let [a, c] = [low, high];
    let (b, d) = ([high[0], low[1]], [low[0], high[1]]);
    [[a, b, c], [a, c, d]]
}

/// A chart at the lower left (v up) and another at the upper right.
fn two_charts() -> Vec<CornerUvs> {
    let mut uvs = square([0.05, 0.05], [0.45, 0.45]).to_vec();
    uvs.extend(square([0.55, 0.55], [0.95, 0.95]));
    uvs
}

fn is_reddish([r, g, b]: [u8; 3]) -> bool {
    r > 180 && g < 110 && b < 110
}

#[test]
fn a_face_has_the_color_of_its_chart_where_the_texture_has_it() {
    let uvs = two_charts();
    let panel = Panel {
        name: "scene",
        uvs: &uvs,
        charts: &[0, 0, 1, 1],
        distortion: &[face(1.0, false); 4],
    };
    let up = decode(&layout_png(&[panel], 256, VAxis::Up));
    assert_eq!(up.dimensions(), (256, 256));
    let (first, second) = (at(&up, 0.3, 0.8), at(&up, 0.7, 0.3));
    assert!(first != second && first != WHITE && second != WHITE);
    assert_eq!(at(&up, 0.2, 0.7), first, "both faces of a chart");
    assert_eq!(at(&up, 0.2, 0.2), WHITE);
    let down = decode(&layout_png(&[panel], 256, VAxis::Down));
    assert_eq!(at(&down, 0.3, 0.2), first);
    assert_eq!(at(&down, 0.7, 0.7), second);
    assert_eq!(at(&down, 0.2, 0.8), WHITE);
    assert!(
        at(&down, 0.05, 0.25)[0] < 120,
        "the border of a chart is dark"
    );
}

#[test]
fn flipped_faces_are_yellow() {
    let uvs = two_charts();
    let distortion = [
        face(1.0, false),
        face(1.0, false),
        face(9.0, true),
        face(1.0, false),
    ];
    let panel = Panel {
        name: "scene",
        uvs: &uvs,
        charts: &[0; 4],
        distortion: &distortion,
    };
    assert_eq!(
        at(&decode(&layout_png(&[panel], 256, VAxis::Up)), 0.8, 0.3),
        YELLOW
    );
    for measure in MEASURES {
        let picture = decode(&heatmap_png(&[panel], measure, 256, VAxis::Up));
        assert_eq!(at(&picture, 0.8, 0.3), YELLOW);
        assert_ne!(at(&picture, 0.7, 0.2), YELLOW);
    }
}

#[test]
fn overlaps_are_red_and_common_edges_are_not() {
    // A fan around a point that is on no sample, all round.
    let center = [0.512_345, 0.487_654];
    let rim = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 97.0;
        [0.5 + 0.49 * angle.cos(), 0.5 + 0.49 * angle.sin()]
    };
    let mut uvs: Vec<CornerUvs> = (0..97)
        .map(|k| [center, rim(k), rim((k + 1) % 97)])
        .collect();
    let charts = vec![3; 98];
    let distortion = vec![face(1.0, false); 98];
    let draw = |uvs: &[CornerUvs]| {
        let panel = Panel {
            name: "scene",
            uvs,
            charts: &charts[..uvs.len()],
            distortion: &distortion[..uvs.len()],
        };
        decode(&layout_png(&[panel], 300, VAxis::Up))
    };
    assert!(!draw(&uvs).pixels().any(|pixel| is_reddish(pixel.0)));
    uvs.push([[0.3, 0.2], [0.7, 0.2], [0.5, 0.3]]);
    let picture = draw(&uvs);
    assert!(
        is_reddish(at(&picture, 0.5, 0.77)),
        "{:?}",
        at(&picture, 0.5, 0.77)
    );
    assert!(!is_reddish(at(&picture, 0.5, 0.5)));
}

#[test]
fn heat_grows_darker_with_distortion() {
    let uvs = two_charts();
    let distortion = [
        face(1.0, false),
        face(1.3, false),
        face(1.9, false),
        face(f64::INFINITY, false),
    ];
    let panel = Panel {
        name: "scene",
        uvs: &uvs,
        charts: &[0; 4],
        distortion: &distortion,
    };
    for measure in MEASURES {
        let picture = decode(&heatmap_png(&[panel], measure, 512, VAxis::Up));
        assert!(picture.height() > picture.width(), "a legend below");
        let light = |x, y| at(&picture, x, y).map(u32::from).iter().sum::<u32>();
        let (none, some, much) = (light(0.3, 0.85), light(0.15, 0.7), light(0.8, 0.35));
        assert!(
            none > 600 && none > some && some > much,
            "{none} {some} {much}"
        );
        assert_eq!(
            at(&picture, 0.65, 0.15),
            [176; 3],
            "a face without a value is gray"
        );
        let legend = picture.rows().skip(512).flatten();
        assert!(
            legend.filter(|pixel| pixel.0[0] < 140).count() > 100,
            "letters"
        );
    }
}

#[test]
fn equal_input_gives_equal_bytes() {
    let uvs = two_charts();
    let panel = Panel {
        name: "mesh0",
        uvs: &uvs,
        charts: &[0, 0, 1, 1],
        distortion: &[face(1.2, false); 4],
    };
    for panels in [&[panel][..], &[panel, panel, panel]] {
        assert_eq!(
            layout_png(panels, 128, VAxis::Down),
            layout_png(panels, 128, VAxis::Down)
        );
        let heat = || heatmap_png(panels, HeatmapMeasure::Area, 128, VAxis::Down);
        assert_eq!(heat(), heat());
    }
}

#[test]
fn several_groups_share_a_sheet_of_bounded_size() {
    let uvs = two_charts();
    let panel = Panel {
        name: "mesh0/prim0",
        uvs: &uvs,
        charts: &[0, 0, 1, 1],
        distortion: &[face(1.2, false); 4],
    };
    let sheet = decode(&layout_png(&[panel, panel], 200, VAxis::Up));
    assert!(
        sheet.width() >= 380 && sheet.width() <= 420,
        "{}",
        sheet.width()
    );
    assert!(sheet.height() < sheet.width());
    let title = sheet.rows().take(8).flatten();
    assert!(title.filter(|pixel| pixel.0[0] < 100).count() > 20, "names");
    for n in [0, 5, 36, 500] {
        let sheet = decode(&layout_png(&vec![panel; n], 512, VAxis::Up));
        assert!(
            sheet.width() <= 1100 && sheet.height() <= 1400,
            "{n}: {:?}",
            sheet.dimensions()
        );
    }
    let smallest = decode(&layout_png(&[panel], 0, VAxis::Up));
    assert_eq!(smallest.dimensions(), (64, 64));
}

#[test]
fn strange_numbers_are_drawn_or_left_out() {
    let strange = [
        f64::NAN,
        f64::INFINITY,
        -f64::INFINITY,
        1e300,
        -1e300,
        1e-300,
        0.0,
        0.5,
        -7.0,
    ];
    let mut uvs: Vec<CornerUvs> = Vec::new();
    let mut distortion = Vec::new();
    for &a in &strange {
        for &b in &strange {
            uvs.push([[a, b], [b, 0.3], [0.1, a]]);
            distortion.push(face(a, b > 0.0));
        }
    }
    for n in [0, 1, 10, uvs.len()] {
        let panel = Panel {
            name: "\u{1F600} Üñ",
            uvs: &uvs[..n],
            charts: &[],
            distortion: &distortion[..n / 2],
        };
        for measure in MEASURES {
            decode(&heatmap_png(&[panel, panel], measure, 100, VAxis::Up));
        }
        decode(&layout_png(&[panel], 100, VAxis::Down));
    }
}

/// Files without loss bring back every pixel, with its bits.
#[test]
fn pictures_without_loss_are_read_as_written() {
    let mut image = Image::transparent(20, 10);
    for (k, pixel) in image.pixels.iter_mut().enumerate() {
        *pixel = [k as u8, (3 * k) as u8, (7 * k) as u8, (255 - k) as u8];
    }
    assert_eq!(Image::decode(&image.webp().unwrap()).unwrap(), image);
    assert_eq!(
        Picture::decode(&image.png()).unwrap(),
        Picture::Eight(image)
    );
    let deep = Image {
        width: 2,
        height: 1,
        pixels: vec![[1, 256, u16::MAX, 1000], [40_000, 3, 2, 1]],
    };
    assert_eq!(
        Picture::decode(&deep.png()).unwrap(),
        Picture::Sixteen(deep)
    );
}

/// A KTX2 file is not believed: neither the length that it claims for a level, nor its size, nor that it is whole.
#[test]
fn ktx2_is_not_believed() {
    let file = include_bytes!("../assets/ktx2/uastc.ktx2");
    assert_eq!(Picture::decode(file).unwrap().size(), [64, 64]);
    let with = |at: usize, bytes: &[u8]| {
        let mut file = file.to_vec();
        file[at..at + bytes.len()].copy_from_slice(bytes);
        Picture::decode(&file).unwrap_err()
    };
    let claimed = with(96, &u64::MAX.to_le_bytes());
    assert!(claimed.to_string().contains("wrong length"), "{claimed}");
    let large = with(
        20,
        &[u32::MAX.to_le_bytes(), u32::MAX.to_le_bytes()].concat(),
    );
    assert_eq!(large.code(), "image_too_large");
    assert_eq!(with(20, &[0; 4]).code(), "invalid_image");
    assert_eq!(with(36, &[6, 0, 0, 0]).code(), "invalid_image");
    for length in 0..file.len() {
        assert!(Picture::decode(&file[..length]).is_err(), "{length}");
    }
}
