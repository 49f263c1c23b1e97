//! A search for the lowest energy where pictures are warped and UVs edited.

use unwrapd_deform::uv::{Anchor, UvEditOptions, UvMesh, edit_uvs};
use unwrapd_deform::warp::{PictureHandle, WarpOptions, warp_picture};
use unwrapd_files::picture::Image;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::solver::{Control, Iterate, Status};

use crate::bodies::sheet;

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}

#[test]
fn a_warp_that_searches_tries_bent_ways_too() {
    let image = Image::transparent(64, 64);
    let handles = [
        PictureHandle::Point {
            at: [16.0, 32.0],
            to: [24.0, 24.0],
            weight: None,
        },
        PictureHandle::Point {
            at: [48.0, 32.0],
            to: [40.0, 44.0],
            weight: None,
        },
    ];
    let of = |search| {
        let options = WarpOptions {
            grid: 16,
            search,
            ..WarpOptions::default()
        };
        let warp = warp_picture(&image, &handles, &options, &go_on);
        warp.expect("a warp").summary
    };
    let (first, best) = (of(false), of(true));
    assert_eq!(best.status, Status::Converged);
    assert!(best.iterations > 2 * first.iterations, "{first:?} {best:?}");
    assert!(best.energy <= first.energy * 1.01, "{first:?} {best:?}");
}

#[test]
fn so_do_edits_of_uvs() {
    let mesh = sheet(10);
    let size = mesh.vertices().last().expect("vertices")[0];
    let place = |v: u32| mesh.vertices()[v as usize].map(|x| x / size);
    let positions: Vec<[f64; 3]> = (mesh.vertices().iter())
        .map(|&[x, y]| [x, y, 0.0])
        .collect();
    let uvs: Vec<CornerUvs> = mesh.triangles().iter().map(|t| t.map(place)).collect();
    let arrays = UvMesh {
        positions: &positions,
        triangles: mesh.triangles(),
        uvs: &uvs,
    };
    let anchors = [(36, 0.1), (84, -0.1)].map(|(vertex, by)| Anchor::Vertex {
        vertex,
        to: place(vertex).map(|x| x + by),
        weight: None,
    });
    let of = |search| {
        let options = UvEditOptions {
            search,
            ..UvEditOptions::edit()
        };
        let edited = edit_uvs(&arrays, &anchors, &options, &go_on).expect("an edit");
        edited.charts[0].summary.clone()
    };
    let (first, best) = (of(false), of(true));
    assert_eq!(best.status, Status::Converged);
    assert!(best.iterations > 2 * first.iterations, "{first:?} {best:?}");
    assert!(best.energy <= first.energy * 1.01, "{first:?} {best:?}");
}
