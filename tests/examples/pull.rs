//! A body that follows a moving handle, an iteration at a time.
//!
//! `cargo run --release --example pull`

use unwrapd_deform::{Body, Handle, Model, Session};
use unwrapd_maps::mesh::PlanarMesh;

fn main() {
    // A strip of 10 × 1 squares, two triangles each.
    let vertices: Vec<[f64; 2]> = (0..22)
        .map(|v| [f64::from(v / 2), f64::from(v % 2)])
        .collect();
    let triangles: Vec<[u32; 3]> = (0..10)
        .flat_map(|i| [[2 * i, 2 * i + 2, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 1]])
        .collect();
    let strip = PlanarMesh::new(vertices, triangles).expect("a planar mesh");
    let mut session = Session::new(Body::from(&strip), &Model::default()).expect("a model");

    // Hold the left end, and drag a corner of the right end.
    for vertex in [0, 1] {
        let to = vec![0.0, f64::from(vertex)];
        session
            .add(Handle::Vertex {
                vertex,
                to,
                weight: None,
            })
            .expect("a handle");
    }
    let corner = Handle::Vertex {
        vertex: 21,
        to: vec![10.0, 1.0],
        weight: None,
    };
    let corner = session.add(corner).expect("a handle");
    for step in 1..=20 {
        let angle = f64::from(step) / 20.0;
        let target = [10.0 * angle.cos(), 1.0 + 10.0 * angle.sin()];
        session.move_handle(corner, &target).expect("a target");
        // One iteration per frame of a display; more while there is time.
        session.step();
        println!("{step:2} {:?}", session.quality());
    }
    session.step_while(|_| true);
    println!("{:?} {:?}", session.stage(), session.quality());
}
