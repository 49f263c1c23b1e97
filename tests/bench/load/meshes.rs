//! Meshes that no other number has, as OBJ.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

/// A box of 12 triangles.
pub fn block(number: usize) -> String {
    let height = 1.0 + number as f64 * 1e-4;
    let mut text = String::new();
    for z in [0.0, height] {
        for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
    }
    for corners in [
        "1 4 3 2", "5 6 7 8", "1 2 6 5", "2 3 7 6", "3 4 8 7", "4 1 5 8",
    ] {
        let _ = writeln!(text, "f {corners}");
    }
    text
}

/// A closed surface with bumps, of 80 (`rings` − 1) triangles.
pub fn bumpy_sphere(number: usize, rings: usize) -> String {
    const SEGMENTS: usize = 40;
    let number = number as f64;
    let mut text = String::from("v 0 0 1\n");
    for ring in 1..rings {
        let t = PI * ring as f64 / rings as f64;
        for segment in 0..SEGMENTS {
            let p = TAU * segment as f64 / SEGMENTS as f64;
            let wave = 0.25 * (3.0 * p + 0.1 * number).sin() * (2.0 * t).sin();
            let r = 1.0 + wave + 0.15 * (5.0 * t + 0.07 * number).cos();
            let (x, y, z) = (t.sin() * p.cos(), t.sin() * p.sin(), t.cos());
            let _ = writeln!(text, "v {:.6} {:.6} {:.6}", r * x, r * y, r * z);
        }
    }
    text.push_str("v 0 0 -1.1\n");
    let at = |ring: usize, segment: usize| 2 + (ring - 1) * SEGMENTS + segment % SEGMENTS;
    let last = 2 + (rings - 1) * SEGMENTS;
    for segment in 0..SEGMENTS {
        let _ = writeln!(text, "f 1 {} {}", at(1, segment), at(1, segment + 1));
        let (a, b) = (at(rings - 1, segment + 1), at(rings - 1, segment));
        let _ = writeln!(text, "f {last} {a} {b}");
        for ring in 1..rings - 1 {
            let (a, b) = (at(ring, segment), at(ring + 1, segment));
            let (c, d) = (at(ring + 1, segment + 1), at(ring, segment + 1));
            let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
        }
    }
    text
}
