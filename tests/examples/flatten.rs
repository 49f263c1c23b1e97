//! A map of a disk that minimizes a formula, with a certificate.
//!
//! `cargo run --release --example flatten`

use std::sync::Arc;

use unwrapd_maps::certificate::certify_planar;
use unwrapd_maps::embed::{Options, parameterize};
use unwrapd_maps::mesh::Disk;
use unwrapd_method::energy::Formula;
use unwrapd_method::solver::{Control, Iterate};

/// Squares along each side.
const N: u32 = 20;

fn main() {
    // A hemisphere over a square.
    let side = f64::from(N);
    let positions: Vec<[f64; 3]> = (0..=N)
        .flat_map(|y| (0..=N).map(move |x| [x, y].map(|k| 2.0 * f64::from(k) / side - 1.0)))
        .map(|[x, y]| [x, y, (3.0 - x * x - y * y).sqrt()])
        .collect();
    let triangles: Vec<[u32; 3]> = (0..N)
        .flat_map(|y| (0..N).map(move |x| y * (N + 1) + x))
        .flat_map(|a| [[a, a + 1, a + N + 2], [a, a + N + 2, a + N + 1]])
        .collect();
    let disk = Disk::new(positions.len(), triangles).expect("a disk");

    // Hencky's energy; any `Density` can take its place.
    let hencky = Formula::parse("log(s1)^2 + log(s2)^2").expect("an energy");
    let options = Options {
        density: Arc::new(hencky),
        ..Options::default()
    };
    let go_on = |_: &Iterate| Control::Continue;
    let map = parameterize(&disk, &positions, &options, &go_on);
    println!("{:?}", map.summary);

    let certificate = certify_planar(&map.uv, &disk.triangles);
    assert!(certificate.is_bijective());
}
