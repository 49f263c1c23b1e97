//! Maps with two vertices pinned: these stay, the others do what the energy asks for.

use std::cell::RefCell;

use unwrapd_layout::charts::Cut;
use unwrapd_maps::embed::{Embedding, Options, Pins, default_beta, is_positive, parameterize};
use unwrapd_maps::mesh::Disk;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_method::energy::DensityKind;
use unwrapd_method::solver::{Control, Iterate, Watch};
use unwrapd_pipeline::{Cutting, Mapping, Settings, Unobserved, unwrap};

use crate::zoo;

/// Remembers the positions of every iterate.
#[derive(Default)]
struct Memory(RefCell<Vec<Vec<f64>>>);

impl Memory {
    /// The vertices that were at one place in all iterates, of which there were several.
    fn stayed(self) -> Vec<usize> {
        let iterates = self.0.into_inner();
        assert!(iterates.len() > 2);
        let at = |x: &[f64], v: usize| [x[2 * v], x[2 * v + 1]];
        (0..iterates[0].len() / 2)
            .filter(|&v| iterates.iter().all(|x| at(x, v) == at(&iterates[0], v)))
            .collect()
    }
}

impl Watch for Memory {
    fn iterate(&self, _: &Iterate) -> Control {
        Control::Continue
    }

    fn positions(&self, _: &Iterate, x: &[f64]) {
        self.0.borrow_mut().push(x.to_vec());
    }
}

/// A grid of 12 × 8 squares, bent by `place`.
fn sheet(place: impl Fn([f64; 3]) -> [f64; 3]) -> (Disk, Vec<[f64; 3]>) {
    let mesh = zoo::grid(12, 8);
    let positions: Vec<_> = (mesh.positions.iter())
        .map(|p| place(p.map(f64::from)))
        .collect();
    let disk = Disk::new(positions.len(), mesh.triangles).expect("a disk");
    (disk, positions)
}

fn options(energy: &DensityKind) -> Options {
    Options {
        density: energy.planar().expect("an energy of the plane"),
        pins: Pins::Two,
        ..Options::default()
    }
}

fn distance(embedding: &Embedding, [a, b]: [usize; 2]) -> f64 {
    let [p, q] = [a, b].map(|v| embedding.uv[v]);
    (p[0] - q[0]).hypot(p[1] - q[1])
}

#[test]
fn pinned_vertices_stay_where_they_are_and_no_others() {
    let (disk, positions) = sheet(|[x, y, _]| {
        let (dx, dy) = (x - 6.0, y - 4.0);
        [x, y, 3.0 * (-(dx * dx + dy * dy) / 8.0).exp()]
    });
    for energy in [
        DensityKind::Arap,
        DensityKind::Lscm,
        DensityKind::SymmetricDirichlet,
    ] {
        let memory = Memory::default();
        let embedding = parameterize(&disk, &positions, &options(&energy), &memory);
        assert!(is_positive(&disk.triangles, &embedding.uv), "{energy:?}");
        let stayed = memory.stayed();
        let on_boundary = |v: &usize| disk.loops[0].contains(&(*v as u32));
        assert!(
            stayed.len() == 2 && stayed.iter().all(on_boundary),
            "{stayed:?}"
        );
    }
}

/// From two corners of a parallelogram the other end of the shorter diagonal is what is farthest.
#[test]
fn it_does_not_matter_where_the_border_begins() {
    let (mut disk, positions) = sheet(|[x, y, _]| [x + 0.05 * y, y, (x / 6.0).cos()]);
    let n = disk.loops[0].len();
    let pins: Vec<Vec<usize>> = (0..n / 4)
        .map(|_| {
            disk.loops[0].rotate_left(4);
            let memory = Memory::default();
            parameterize(&disk, &positions, &options(&DensityKind::Arap), &memory);
            memory.stayed()
        })
        .collect();
    let ends = vec![0, disk.n_vertices - 1];
    assert_eq!(pins, vec![ends; n / 4]);
}

/// The map of a surface that can be laid flat is that without any distortion, up to its size.
#[test]
fn a_developable_surface_is_laid_flat() {
    let flat = sheet(|[x, y, _]| [x, y, 0.0]);
    let (disk, bent) = sheet(|[x, y, _]| [6.0 * (x / 6.0).sin(), y, 6.0 * (x / 6.0).cos()]);
    for barrier in [BarrierKind::None, BarrierKind::InverseSpline] {
        let options = Options {
            barrier,
            ..options(&DensityKind::Lscm)
        };
        let embedding = parameterize(&disk, &bent, &options, &Memory::default());
        let length = |[a, b]: [usize; 2]| {
            let [p, q] = [a, b].map(|v| flat.1[v]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let n = disk.n_vertices;
        let pairs = [[0, n - 1], [12, n - 13], [3, n / 2], [0, 1]];
        let ratios = pairs.map(|pair| distance(&embedding, pair) / length(pair));
        // The triangles are chords of the cylinder.
        assert!(ratios.iter().all(|r| (r - 1.0).abs() < 0.01), "{ratios:?}");
    }
}

/// A barrier that is strong beside a small energy would keep triangles near their rest sizes, which costs conformality.
#[test]
fn conformal_maps_are_as_conformal_as_those_without_a_barrier() {
    let (disk, positions) = sheet(|[x, y, _]| {
        let (dx, dy) = (x - 6.0, y - 4.0);
        [x, y, 6.0 * (-(dx * dx + dy * dy) / 8.0).exp()]
    });
    let energy_of = |options: &Options| {
        let embedding = parameterize(&disk, &positions, options, &Memory::default());
        assert!(is_positive(&disk.triangles, &embedding.uv));
        embedding.summary.energy_last
    };
    let strong = options(&DensityKind::Lscm);
    let free = energy_of(&Options {
        barrier: BarrierKind::None,
        ..strong.clone()
    });
    assert!(energy_of(&strong) > 1.2 * free);
    let weak = Options {
        beta: default_beta(&*strong.density),
        ..strong.clone()
    };
    let weakened = Options {
        barrier_continuation: true,
        ..strong
    };
    for options in [weak, weakened] {
        let energy = energy_of(&options);
        assert!(energy < 1.01 * free, "{energy} {free}");
    }
}

#[test]
fn pins_are_two_and_need_one_chart_per_component() {
    let mesh = zoo::sphere(12, 8);
    let run = |pin: u32, cut: Cut| {
        let settings = Settings {
            mapping: Mapping {
                energy: DensityKind::Lscm,
                pin,
                ..Mapping::default()
            },
            cutting: Cutting {
                cut,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved)
    };
    for (pin, cut) in [(1, Cut::Disk), (3, Cut::Disk), (2, Cut::Auto)] {
        let error = run(pin, cut).expect_err("not possible");
        assert_eq!(error.code(), "invalid_options");
    }
    assert_eq!(run(2, Cut::Disk).expect("an atlas").charts.len(), 1);
}
