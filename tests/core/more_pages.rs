//! More pages never give less density.

use unwrapd::charts::Cut;
use unwrapd::pipeline::{Cutting, Layout, Settings, Unobserved, Workers, unwrap};

use crate::zoo;

fn settings(cut: Cut, pages: u32, threads: usize) -> Settings {
    Settings {
        cutting: Cutting {
            cut,
            ..Cutting::default()
        },
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

/// A flight of three steps, of which one page fits all, two and more a few planes each.
fn stairs() -> zoo::Mesh {
    let steps: Vec<[i32; 3]> = (0..3)
        .flat_map(|x| (0..=x).flat_map(move |z| (0..3).map(move |y| [x, y, z])))
        .collect();
    zoo::voxels(&steps)
}

#[test]
fn density_never_falls() {
    for (mesh, cut) in [
        (stairs(), Cut::Auto),
        (zoo::torus(9, 6), Cut::Auto),
        (stairs(), Cut::Fast),
    ] {
        let density = |pages: u32| {
            let settings = settings(cut, pages, 1);
            let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
            unwrapped.expect("an atlas").scale
        };
        let densities: Vec<f64> = (1..=10).map(density).collect();
        assert!(densities.is_sorted(), "{}: {densities:?}", mesh.name);
        assert!(densities[9] > 1.3 * densities[0], "{densities:?}");
    }
}

#[test]
fn several_pages_are_the_same_on_any_number_of_threads() {
    let mesh = stairs();
    let on = |threads: usize| {
        let settings = settings(Cut::Auto, 4, threads);
        let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
        unwrapped.expect("an atlas").grid
    };
    assert_eq!(on(1), on(2));
}
