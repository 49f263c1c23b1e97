//! Nasty meshes that every public operation meets.

use std::collections::{BTreeMap, BTreeSet};
use std::f32::consts::{PI, TAU};
use std::path::Path;

/// An indexed triangle list as a file would have it.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub name: String,
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// Both meshes in one list.
    pub fn with(mut self, other: &Mesh) -> Self {
        let shift = self.positions.len() as u32;
        self.positions.extend(&other.positions);
        self.triangles
            .extend(other.triangles.iter().map(|t| t.map(|v| v + shift)));
        self
    }

    pub fn moved(mut self, by: [f32; 3]) -> Self {
        for p in &mut self.positions {
            *p = [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
        }
        self
    }

    /// With its vertices and triangles in another order.
    pub fn shuffled(&self) -> Self {
        let order = |n: usize| {
            let mut order: Vec<usize> = (0..n).collect();
            for i in (1..n).rev() {
                order.swap(i, (i * 7919 + 13) % (i + 1));
            }
            order
        };
        let of_vertices = order(self.positions.len());
        let mut place = vec![0; of_vertices.len()];
        for (new, &old) in (0..).zip(&of_vertices) {
            place[old] = new;
        }
        let of_triangles = order(self.triangles.len()).into_iter();
        Self {
            name: format!("{}, shuffled", self.name),
            positions: of_vertices.iter().map(|&v| self.positions[v]).collect(),
            triangles: of_triangles
                .map(|t| self.triangles[t].map(|v| place[v as usize]))
                .collect(),
        }
    }

    /// Bent so that it is nowhere its own image.
    pub fn lopsided(mut self) -> Self {
        for [x, y, z] in &mut self.positions {
            *x += 0.3 * *x * *x + 0.1 * *y;
            *y += 0.2 * (*x + *z).sin();
            *z *= 1.5 + 0.1 * *x;
        }
        self
    }

    pub fn reversed(mut self) -> Self {
        for t in &mut self.triangles {
            t.swap(1, 2);
        }
        self
    }

    /// The faces for which `keep` holds.
    pub fn without(mut self, faces: &[usize]) -> Self {
        let mut f = 0;
        self.triangles.retain(|_| {
            f += 1;
            !faces.contains(&(f - 1))
        });
        self
    }

    /// With needles: divides every `every`-th face at the middle of its first side, moved by `height` times the way to the third
    /// corner. The needle lies between the middle and the side.
    pub fn with_needles(mut self, every: usize, height: f32) -> Self {
        for face in (0..self.triangles.len()).step_by(every) {
            let [a, b, c] = self.triangles[face];
            let [p, q, r] = [a, b, c].map(|v| self.positions[v as usize]);
            let m = self.positions.len() as u32;
            self.positions.push([0, 1, 2].map(|k| {
                let middle = f32::midpoint(p[k], q[k]);
                middle + height * (r[k] - middle)
            }));
            self.triangles[face] = [a, m, c];
            self.triangles.extend([[m, b, c], [a, b, m]]);
        }
        self
    }

    /// Three own vertices for every face.
    pub fn soup(&self) -> Self {
        let corners = self.triangles.iter().flatten();
        Mesh {
            name: self.name.clone(),
            positions: corners.map(|&v| self.positions[v as usize]).collect(),
            triangles: (0..self.triangles.len() as u32)
                .map(|f| [3 * f, 3 * f + 1, 3 * f + 2])
                .collect(),
        }
    }
}

fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    Mesh {
        name: String::new(),
        positions: positions.to_vec(),
        triangles: triangles.to_vec(),
    }
}

/// `n` × `m` squares over the unit square's multiples, bent upwards a little.
pub fn grid(n: u32, m: u32) -> Mesh {
    let positions = (0..=m)
        .flat_map(|j| (0..=n).map(move |i| [i as f32, j as f32, 0.1 * ((i * j) as f32).sin()]))
        .collect();
    wrapped(n, m, positions, |i, j| j * (n + 1) + i)
}

/// Two triangles for each square of a grid whose vertices `index` numbers.
fn wrapped(n: u32, m: u32, positions: Vec<[f32; 3]>, index: impl Fn(u32, u32) -> u32) -> Mesh {
    let mut triangles = Vec::new();
    for j in 0..m {
        for i in 0..n {
            let [a, b] = [index(i, j), index(i + 1, j)];
            let [d, c] = [index(i, j + 1), index(i + 1, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh {
        name: String::new(),
        positions,
        triangles,
    }
}

/// A cone's side: an apex and `n` triangles around it.
pub fn cone(n: u32) -> Mesh {
    let mut positions = vec![[0.0, 0.0, 2.0]];
    positions.extend((0..n).map(|i| {
        let t = TAU * i as f32 / n as f32;
        [t.cos(), t.sin(), 0.0]
    }));
    let triangles: Vec<_> = (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
    mesh(&positions, &triangles)
}

/// The side of a cylinder of radius 1: `n` squares around.
pub fn tube(n: u32, height: f32) -> Mesh {
    let positions = [0.0, height].into_iter().flat_map(|z| {
        (0..n).map(move |i| {
            let t = TAU * i as f32 / n as f32;
            [t.cos(), t.sin(), z]
        })
    });
    let triangles: Vec<_> = (0..n)
        .flat_map(|i| {
            let next = (i + 1) % n;
            [[i, next, n + next], [i, n + next, n + i]]
        })
        .collect();
    mesh(&positions.collect::<Vec<_>>(), &triangles)
}

/// A sphere of `n` meridians and `m` parallels.
pub fn sphere(n: u32, m: u32) -> Mesh {
    let mut positions = vec![[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]];
    for j in 1..=m {
        let phi = PI * j as f32 / (m + 1) as f32;
        positions.extend((0..n).map(|i| {
            let t = TAU * i as f32 / n as f32;
            [phi.sin() * t.cos(), phi.sin() * t.sin(), phi.cos()]
        }));
    }
    let at = |i: u32, j: u32| 2 + j * n + i % n;
    let mut triangles = Vec::new();
    for i in 0..n {
        triangles.push([0, at(i, 0), at(i + 1, 0)]);
        triangles.push([1, at(i + 1, m - 1), at(i, m - 1)]);
        for j in 0..m - 1 {
            triangles.push([at(i, j), at(i, j + 1), at(i + 1, j + 1)]);
            triangles.push([at(i, j), at(i + 1, j + 1), at(i + 1, j)]);
        }
    }
    mesh(&positions, &triangles)
}

/// A torus of `n` × `m` squares.
pub fn torus(n: u32, m: u32) -> Mesh {
    let positions = (0..m)
        .flat_map(|j| {
            (0..n).map(move |i| {
                let (t, p) = (TAU * i as f32 / n as f32, TAU * j as f32 / m as f32);
                let r = 2.0 + 0.7 * p.cos();
                [r * t.cos(), r * t.sin(), 0.7 * p.sin()]
            })
        })
        .collect();
    wrapped(n, m, positions, |i, j| (j % m) * n + i % n)
}

/// A band of `n` squares around and `m` across with half a turn, or closed up to a Klein bottle.
pub fn half_turned(n: u32, m: u32, closed: bool) -> Mesh {
    let rows = if closed { m } else { m + 1 };
    let positions = (0..rows)
        .flat_map(|j| {
            (0..n).map(move |i| {
                let t = TAU * i as f32 / n as f32;
                if closed {
                    // The figure-8 immersion.
                    let p = TAU * j as f32 / m as f32;
                    let x = (t / 2.0).cos() * p.sin() - (t / 2.0).sin() * (2.0 * p).sin();
                    let z = (t / 2.0).sin() * p.sin() + (t / 2.0).cos() * (2.0 * p).sin();
                    [(3.0 + x) * t.cos(), (3.0 + x) * t.sin(), z]
                } else {
                    let s = j as f32 / m as f32 - 0.5;
                    let r = 2.0 + s * (t / 2.0).cos();
                    [r * t.cos(), r * t.sin(), s * (t / 2.0).sin()]
                }
            })
        })
        .collect();
    let row = move |i: u32, j: u32| match (i == n, closed) {
        (false, true) => j % m,
        (false, false) => j,
        (true, true) => (m - j % m) % m,
        (true, false) => m - j,
    };
    wrapped(n, m, positions, move |i, j| row(i, j) * n + i % n)
}

/// The real projective plane on six vertices.
pub fn projective_plane() -> Mesh {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.1, 0.2],
        [0.3, 1.0, 0.4],
        [-0.8, 0.5, 0.7],
        [-0.6, -0.9, 0.1],
        [0.5, -0.7, 0.9],
    ];
    let triangles = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    mesh(&positions, &triangles)
}

/// The surface of unit cubes: two triangles for each square between a cube and what is none.
pub fn voxels(cubes: &[[i32; 3]]) -> Mesh {
    let solid: BTreeSet<[i32; 3]> = cubes.iter().copied().collect();
    let mut index = BTreeMap::new();
    let mut out = Mesh::default();
    for &cube in &solid {
        for axis in 0..3 {
            for side in [0, 1] {
                let mut beyond = cube;
                beyond[axis] += 2 * side - 1;
                if solid.contains(&beyond) {
                    continue;
                }
                let corner = |u: i32, v: i32| {
                    let mut p = cube;
                    p[axis] += side;
                    p[(axis + 1) % 3] += u;
                    p[(axis + 2) % 3] += v;
                    p
                };
                let square = if side == 1 {
                    [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]
                } else {
                    [corner(0, 0), corner(0, 1), corner(1, 1), corner(1, 0)]
                };
                let [a, b, c, d] = square.map(|p| {
                    *index.entry(p).or_insert_with(|| {
                        out.positions.push(p.map(|x| x as f32));
                        out.positions.len() as u32 - 1
                    })
                });
                out.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    out
}

/// A slab of cubes with `genus` holes through it.
pub fn slab(genus: i32) -> Mesh {
    let cubes: Vec<[i32; 3]> = (0..=2 * genus)
        .flat_map(|x| (0..3).map(move |y| [x, y, 0]))
        .filter(|c| !(c[0] % 2 == 1 && c[1] == 1))
        .collect();
    voxels(&cubes)
}

/// `n` triangles around one edge.
pub fn book(n: u32) -> Mesh {
    let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    positions.extend((0..n).map(|i| {
        let t = TAU * i as f32 / n as f32;
        [t.cos(), t.sin(), 0.5]
    }));
    let page = |i| {
        if i % 2 == 0 {
            [0, 1, 2 + i]
        } else {
            [1, 0, 2 + i]
        }
    };
    mesh(&positions, &(0..n).map(page).collect::<Vec<_>>())
}

/// A face below a side on which a vertex of three others lies, and the needle between: its side cannot go without a flip.
pub fn needle_on_a_side() -> Mesh {
    mesh(
        &[
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [1.25, 1e-6, 0.0],
            [1.0, -1.0, 0.0],
            [0.0, 1.0, 0.0],
            [2.0, 1.0, 0.0],
        ],
        &[[1, 0, 3], [0, 2, 4], [2, 5, 4], [2, 1, 5], [0, 1, 2]],
    )
    .named("needle on a side")
}

/// Two triangles glued along all three edges.
pub fn pillow() -> Mesh {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    mesh(&positions, &[[0, 1, 2], [0, 2, 1]])
}

/// A sphere two of whose edges, far from each other, lie at one place.
pub fn pinched_sphere() -> Mesh {
    let mut pinched = sphere(12, 9);
    let at = |i: usize, j: usize| 2 + 12 * j + i;
    pinched.positions[at(6, 4)] = pinched.positions[at(0, 4)];
    pinched.positions[at(6, 5)] = pinched.positions[at(0, 5)];
    pinched
}

/// A sphere two of whose edges, with one vertex between them, lie at one place.
pub fn folded_sphere() -> Mesh {
    let mut folded = sphere(12, 9);
    let at = |i: usize, j: usize| 2 + 12 * j + i;
    folded.positions[at(2, 4)] = folded.positions[at(0, 4)];
    folded.positions[at(2, 5)] = folded.positions[at(0, 5)];
    folded
}

/// Everything nasty that is small.
pub fn zoo() -> Vec<Mesh> {
    let wall = grid(4, 3);
    let mut slivers = grid(6, 6);
    for p in &mut slivers.positions {
        *p = [p[0], p[1] * 1e-6, p[2] * 1e-6];
    }
    let mut mixed = torus(8, 6);
    for t in mixed.triangles.iter_mut().step_by(3) {
        t.swap(0, 2);
    }
    let mut lined_up = grid(3, 3);
    lined_up.positions[5] = [0.5, 0.0, 0.0];
    let mut repeating = grid(2, 2);
    repeating.triangles.extend([[0, 0, 1], [3, 4, 4]]);
    let mut unused = grid(2, 1);
    unused.positions.push([f32::NAN; 3]);
    vec![
        Mesh::default().named("empty"),
        mesh(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]).named("triangle"),
        wall.clone().named("grid"),
        grid(5, 5).without(&[24, 25]).named("grid with a hole"),
        cone(7).named("cone"),
        sphere(12, 9).named("sphere"),
        sphere(3, 1).named("two tetrahedra"),
        mesh(
            &[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        )
        .named("tetrahedron"),
        pillow().named("pillow"),
        torus(9, 7).named("torus"),
        torus(9, 7).without(&[0]).named("torus with a hole"),
        torus(9, 7)
            .without(&[0, 40, 41, 90])
            .named("torus with holes"),
        slab(2).named("genus 2"),
        slab(5).named("genus 5"),
        slab(5).without(&[3, 30, 31]).named("genus 5 with holes"),
        half_turned(16, 3, false).named("Moebius strip"),
        half_turned(14, 9, true).named("Klein bottle"),
        projective_plane().named("projective plane"),
        cone(5)
            .with(&cone(5).moved([0.0, 0.0, 0.0]).reversed_through_apex())
            .named("hourglass"),
        book(3).named("three faces on an edge"),
        book(5).named("five faces on an edge"),
        book(200).named("200 faces on an edge"),
        slivers.named("slivers"),
        torus(9, 7).soup().named("duplicate vertices"),
        wall.clone().with(&wall).named("doubled wall"),
        wall.clone()
            .with(&wall.clone().reversed())
            .named("wall with a back"),
        sphere(6, 4).with(&sphere(6, 4)).named("doubled sphere"),
        sphere(6, 4)
            .with(&sphere(6, 4))
            .with(&sphere(6, 4).reversed())
            .named("tripled sphere"),
        pillow().with(&pillow()).named("doubled pillow"),
        mixed.named("inconsistent winding"),
        wall.clone()
            .with(&torus(5, 4).moved([9.0, 0.0, 0.0]))
            .named("two components"),
        voxels(&[[0, 0, 0], [1, 1, 0]]).named("cubes sharing an edge"),
        voxels(&[[0, 0, 0], [1, 1, 1]]).named("cubes sharing a corner"),
        voxels(&[[0, 0, 0], [1, 1, 0], [0, 1, 1], [1, 0, 1]]).named("checkered cubes"),
        pinched_sphere().named("pinched sphere"),
        folded_sphere().named("folded sphere"),
        lined_up.named("zero-area face"),
        repeating.named("faces that repeat a vertex"),
        unused.named("unreferenced NaN"),
    ]
}

impl Mesh {
    /// Mirrored at the height of a cone's apex.
    fn reversed_through_apex(mut self) -> Self {
        for p in &mut self.positions {
            p[2] = 4.0 - p[2];
        }
        self.reversed()
    }
}

/// Reads `v` and `f` lines of an OBJ file, or an OFF file; polygons are cut into fans.
pub fn read_mesh(path: &Path) -> Option<Mesh> {
    let text = std::fs::read_to_string(path).ok()?;
    let mut out = Mesh::default().named(&path.file_name()?.to_string_lossy());
    let mut fan = |polygon: &[u32]| {
        for i in 1..polygon.len().saturating_sub(1) {
            out.triangles.push([polygon[0], polygon[i], polygon[i + 1]]);
        }
    };
    if path.extension()? == "off" {
        let mut words = text.split_whitespace().skip(1);
        let mut count = || words.next()?.parse::<u32>().ok();
        let (n, m) = (count()?, count()?);
        let mut words = words.skip(1);
        for _ in 0..n {
            let mut x = || words.next()?.parse().ok();
            out.positions.push([x()?, x()?, x()?]);
        }
        for _ in 0..m {
            let k = words.next()?.parse::<usize>().ok()?;
            let polygon: Vec<u32> = words.by_ref().take(k).flat_map(str::parse).collect();
            fan(&polygon);
        }
        return Some(out);
    }
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let mut x = || words.next()?.parse().ok();
                out.positions.push([x()?, x()?, x()?]);
            }
            Some("f") => {
                let vertex = |word: &str| word.split('/').next()?.parse::<u32>().ok();
                let polygon: Vec<u32> = words.filter_map(vertex).map(|v| v - 1).collect();
                fan(&polygon);
            }
            _ => {}
        }
    }
    Some(out)
}
