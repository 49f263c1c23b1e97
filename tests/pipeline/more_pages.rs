//! More pages never give less density.

use unwrapd_pipeline::{Layout, Settings, Unobserved, Workers, unwrap};

use crate::zoo;

fn settings(pages: u32, threads: usize) -> Settings {
    Settings {
        layout: Layout {
            pages,
            ..Layout::default()
        },
        workers: Workers {
            threads: Some(threads),
        },
        ..Settings::default()
    }
}

/// Two steps: pages of three and more hold a few planes each, and one of them decides the scale.
fn stairs() -> zoo::Mesh {
    zoo::voxels(&[[0, 0, 0], [1, 0, 0], [1, 0, 1]])
}

#[test]
fn density_never_falls() {
    for mesh in [stairs(), zoo::voxels(&[[0; 3]])] {
        let density = |pages: u32| {
            let settings = settings(pages, 1);
            let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
            unwrapped.expect("an atlas").scale
        };
        let densities: Vec<f64> = (1..=6).map(density).collect();
        assert!(densities.is_sorted(), "{densities:?}");
        assert!(densities[5] > 1.5 * densities[0], "{densities:?}");
    }
}

#[test]
fn several_pages_are_the_same_on_any_number_of_threads() {
    let mesh = stairs();
    let on = |threads: usize| {
        let settings = settings(4, threads);
        let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
        unwrapped.expect("an atlas").grid
    };
    assert_eq!(on(1), on(2));
}
