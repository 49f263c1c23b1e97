//! Cuts that only make the atlas fuller, by the cost of the layout.

use unwrapd_maps::mesh::Resolution;
use unwrapd_pipeline::{Cutting, Layout, Settings, Unobserved, Unwrapped, unwrap};

/// Flat strips of `n` unit squares each.
fn strips(lengths: &[u32]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for (place, &n) in (0_u8..).zip(lengths) {
        let first = positions.len() as u32;
        for i in 0..=n {
            for y in [0.0, 1.0] {
                positions.push([i as f32, y, 10.0 * f32::from(place)]);
            }
        }
        for i in 0..n {
            let a = first + 2 * i;
            triangles.extend([[a, a + 2, a + 3], [a, a + 3, a + 1]]);
        }
    }
    (positions, triangles)
}

fn unwrapped(lengths: &[u32], cutting: Cutting, resolution: Resolution) -> Unwrapped {
    let (positions, triangles) = strips(lengths);
    let settings = Settings {
        cutting,
        layout: Layout {
            resolution,
            ..Layout::default()
        },
        ..Settings::default()
    };
    unwrap(&positions, &triangles, &settings, &Unobserved).expect("strips")
}

/// A hair card is not chopped to fill a square: textures come in other shapes.
#[test]
fn a_lone_strip_stays_whole() {
    for n in [4, 10] {
        let unwrapped = unwrapped(&[n], Cutting::default(), Resolution::square(1024));
        assert_eq!(unwrapped.charts.len(), 1, "{n} squares");
    }
}

/// Without a price of seams, every cut that gains anything is made.
#[test]
fn a_lone_strip_is_cut_if_seams_are_free() {
    let free = Cutting {
        seam_weight: 0.0,
        ..Cutting::default()
    };
    let unwrapped = unwrapped(&[10], free, Resolution::square(1024));
    assert!(unwrapped.charts.len() > 1);
}

/// Each of many cards stays one chart, even if one card is long.
#[test]
fn cards_stay_whole() {
    let lengths = [10, 3, 4, 5, 3, 4];
    let unwrapped = unwrapped(&lengths, Cutting::default(), Resolution::square(1024));
    assert_eq!(unwrapped.charts.len(), lengths.len());
}
