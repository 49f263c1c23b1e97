//! An OBJ file with materials and pictures, made for tests.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use image::{Rgb, RgbImage};

const MATERIALS: &str = "newmtl wood\nKd 1 1 1\nKs 0.2 0.2 0.2\nNs 90\nmap_Kd pictures/wood grain.png\n\n\
    newmtl lid\nKd 1 1 1\nKs 0 0 0\nmap_Kd pictures/lid.jpg\nmap_Ks nowhere.png\n\n\
    newmtl red paint\nKd 1 0 0\nNs 250\n";

/// Writes a box and two balls of three materials, two of them with pictures, into a folder.
pub fn write(folder: &Path) -> PathBuf {
    std::fs::create_dir_all(folder.join("pictures")).expect("a folder");
    let stripes = |u: f64, v: f64| {
        let is_light = ((8.0 * u) as u32 + (8.0 * v) as u32).is_multiple_of(2);
        [
            if is_light { 200.0 } else { 90.0 },
            60.0 + 150.0 * u,
            40.0 + 120.0 * v,
        ]
    };
    let rings = |u: f64, v: f64| {
        let is_light = ((14.0 * (u - 0.5).hypot(v - 0.5)) as u32).is_multiple_of(2);
        [
            40.0 + 160.0 * v,
            if is_light { 190.0 } else { 70.0 },
            20.0 + 220.0 * u,
        ]
    };
    picture(stripes)
        .save(folder.join("pictures/wood grain.png"))
        .expect("a PNG");
    picture(rings)
        .save(folder.join("pictures/lid.jpg"))
        .expect("a JPEG");
    std::fs::write(folder.join("house.mtl"), MATERIALS).expect("a file");
    let mut text = Text::default();
    text.add_box();
    text.add_ball("globe", "wood", [0.0, 1.9, 0.0, 0.9], [32, 16]);
    text.add_ball("red ball", "red paint", [1.9, -0.4, 0.4, 0.6], [24, 12]);
    let path = folder.join("house.obj");
    std::fs::write(&path, format!("mtllib house.mtl\n{}", text.lines)).expect("a file");
    path
}

fn picture(color: impl Fn(f64, f64) -> [f64; 3]) -> RgbImage {
    const SIDE: u32 = 256;
    let part = |i: u32| f64::from(i) / f64::from(SIDE);
    RgbImage::from_fn(SIDE, SIDE, |x, y| {
        Rgb(color(part(x), part(y)).map(|c| c as u8))
    })
}

#[derive(Default)]
struct Text {
    lines: String,
    n_vertices: usize,
}

impl Text {
    fn push(&mut self, [x, y, z]: [f64; 3], [u, v]: [f64; 2]) {
        let _ = writeln!(self.lines, "v {x:.6} {y:.6} {z:.6}\nvt {u:.6} {v:.6}");
        self.n_vertices += 1;
    }

    fn face(&mut self, corners: impl Iterator<Item = usize>) {
        let corners: Vec<String> = corners.map(|c| format!("{c}/{c}")).collect();
        let _ = writeln!(self.lines, "f {}", corners.join(" "));
    }

    /// Each side shows a whole picture.
    fn add_box(&mut self) {
        let sides = [
            [0, 1, 3, 2],
            [5, 4, 6, 7],
            [4, 0, 2, 6],
            [1, 5, 7, 3],
            [2, 3, 7, 6],
            [0, 4, 5, 1],
        ];
        self.lines += "o box\n";
        for (k, side) in sides.into_iter().enumerate() {
            let first = self.n_vertices + 1;
            for (corner, uv) in side.into_iter().zip([[0, 0], [1, 0], [1, 1], [0, 1]]) {
                let bit = |k: i32| f64::from(2 * (corner >> k & 1) - 1);
                self.push([bit(2), bit(1), bit(0)], uv.map(f64::from));
            }
            self.lines += if k < 4 {
                "usemtl wood\n"
            } else {
                "usemtl lid\n"
            };
            self.face(first..first + 4);
        }
    }

    /// Longitudes and latitudes, with a seam.
    fn add_ball(&mut self, name: &str, material: &str, [x, y, z, r]: [f64; 4], [m, n]: [usize; 2]) {
        let first = self.n_vertices + 1;
        let _ = writeln!(self.lines, "o {name}");
        for j in 0..=n {
            for i in 0..=m {
                let [u, v] = [i as f64 / m as f64, j as f64 / n as f64];
                let ((sin_a, cos_a), (sin_b, cos_b)) = ((TAU * u).sin_cos(), (PI * v).sin_cos());
                let place = [x + r * sin_b * cos_a, y + r * cos_b, z + r * sin_b * sin_a];
                self.push(place, [1.0 - u, 1.0 - v]);
            }
        }
        let _ = writeln!(self.lines, "usemtl {material}");
        for j in 0..n {
            for i in 0..m {
                let at = |i: usize, j: usize| first + j * (m + 1) + i;
                let corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let is_used = |k: &usize| !(j == 0 && *k == 1 || j == n - 1 && *k == 3);
                self.face((0..4).filter(is_used).map(|k| corners[k]));
            }
        }
    }
}
