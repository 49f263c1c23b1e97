//! What is pulled.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::places;

/// What is pulled: a file, options, and the place of a handle that stays and of one that is dragged.
pub struct Case {
    pub name: String,
    pub file: (&'static str, Vec<u8>),
    pub options: Value,
    pub held: Vec<f64>,
    pub dragged: Vec<f64>,
    pub radius: f64,
    /// How far it is dragged.
    pub reach: f64,
}

/// A sheet of `n` by `n` unit squares, two triangles each.
pub fn sheet(n: u32) -> Case {
    let mut off = format!("OFF\n{} {} 0\n", (n + 1) * (n + 1), 2 * n * n);
    for i in 0..=n {
        for j in 0..=n {
            writeln!(off, "{i} {j} 0").expect("memory");
        }
    }
    for i in 0..n {
        for j in 0..n {
            let [a, b] = [i * (n + 1) + j, (i + 1) * (n + 1) + j];
            writeln!(off, "3 {a} {b} {}\n3 {a} {} {}", b + 1, b + 1, a + 1).expect("memory");
        }
    }
    let side = f64::from(n);
    Case {
        name: format!("sheet of {} triangles", 2 * n * n),
        file: ("sheet.off", off.into_bytes()),
        options: json!({}),
        held: vec![0.5 * side, 0.0],
        dragged: vec![0.5 * side, side],
        radius: 0.1 * side,
        reach: 0.1 * side,
    }
}

/// A block of `n` by `n` by `n` cubes, six tetrahedra each.
pub fn block(n: usize) -> Case {
    let index = |p: [usize; 3]| (p[0] * (n + 1) + p[1]) * (n + 1) + p[2];
    let mut tet = format!("{} {}\n", (n + 1).pow(3), 6 * n.pow(3));
    let places = |n: usize| {
        (0..n).flat_map(move |x| (0..n).flat_map(move |y| (0..n).map(move |z| [x, y, z])))
    };
    for [x, y, z] in places(n + 1) {
        writeln!(tet, "{x} {y} {z}").expect("memory");
    }
    for cell in places(n) {
        // The ways from one corner of a cube to the opposite one along its edges.
        for axes in [
            [0, 1, 2],
            [0, 2, 1],
            [1, 0, 2],
            [1, 2, 0],
            [2, 0, 1],
            [2, 1, 0],
        ] {
            let mut corner = cell;
            let mut corners = vec![index(corner).to_string()];
            for axis in axes {
                corner[axis] += 1;
                corners.push(index(corner).to_string());
            }
            writeln!(tet, "{}", corners.join(" ")).expect("memory");
        }
    }
    let side = n as f64;
    Case {
        name: format!("block of {} tetrahedra", 6 * n.pow(3)),
        file: ("block.tet", tet.into_bytes()),
        options: json!({}),
        held: vec![0.5 * side, 0.0, 0.5 * side],
        dragged: vec![0.5 * side, side, 0.5 * side],
        radius: 0.3 * side,
        reach: 0.2 * side,
    }
}

/// An armadillo, held at the feet and dragged by a hand.
pub fn armadillo() -> Case {
    let msh = std::fs::read(places::shared("data/tet/Armadillo13K.msh")).expect("test data");
    Case {
        name: "armadillo of 54,985 tetrahedra".to_owned(),
        file: ("armadillo.msh", msh),
        options: json!({}),
        held: vec![35.0, -50.0, 0.0],
        dragged: vec![63.5, 71.9, -33.1],
        radius: 20.0,
        reach: 15.0,
    }
}

/// A cow in a cage.
pub fn caged() -> Case {
    let ply = std::fs::read(places::asset("spot.ply")).expect("an asset");
    Case {
        name: "spot in a cage of 12 cubes along".to_owned(),
        file: ("spot.ply", ply),
        options: json!({ "cage": 12 }),
        held: vec![0.0, -0.7, 0.0],
        dragged: vec![0.0, 0.9, 0.3],
        radius: 0.3,
        reach: 0.4,
    }
}

impl Case {
    pub fn disc(&self, center: &[f64]) -> Value {
        json!({ "center": center, "radius": self.radius, "to": center })
    }

    /// Where the dragged handle is at this part of a turn.
    pub fn target(&self, turn: f64) -> Vec<f64> {
        let angle = std::f64::consts::TAU * turn;
        let mut to = self.dragged.clone();
        to[0] += self.reach * angle.sin();
        to[1] += self.reach * (1.0 - angle.cos());
        to
    }
}
