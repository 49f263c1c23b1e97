//! Whether deformations depend on the unit, the place, the direction and the order of their mesh.
//!
//! `cargo bench --bench units -- --reference DIR`; DIR holds `problems/` and what they name. Solves twenty of them with their
//! numbers meant for a mean element of size 1, as `deform` means them, and each again at five scales, shifted by 10,000 diagonals,
//! turned three times, with its elements in three other orders, and all of that at once. Tells for each problem its energy, by how
//! much the others differ from it at worst, iterations, the fewest and the most of the others, and which pose differs most.

#[path = "../deform/elsewhere.rs"]
mod elsewhere;

use std::path::{Path, PathBuf};

use elsewhere::{Elsewhere, HERE};
use unwrapd::deform::{Problem, ProblemFile, Solution, Units};
use unwrapd::io::ElementFormat;
use unwrapd::solver::{Control, Iterate, Settings};

const PROBLEMS: [&str; 20] = [
    "grid608_arap_spline",
    "grid608_dirichlet_spline",
    "grid608_green_spline",
    "grid608_laplacian_spline",
    "grid608_uniform_laplacian_spline",
    "woody-lo_pt_bend_arap_spline",
    "woody-lo_pt_squeeze_green_spline",
    "woody-lo_pt_swapAL_arap_spline",
    "woody-hi_disc_bend_green_spline",
    "woody-hi_disc_squeeze_arap_spline",
    "woody-hi_disc_squeeze_green_spline",
    "woody-hi_pt_bend_arap_spline",
    "woody-hi_disc_swapAL_green_spline",
    "woody-hi-x4_pt_bend_arap_spline",
    "bar_c_bend_arap_spline",
    "bar_c_bend_green_spline",
    "bar_c_twist1_arap_spline",
    "bar_c_twist1_green_spline",
    "bar_m_bend_arap_spline",
    "bar_m_bend_green_spline",
];

fn main() {
    let mut arguments = std::env::args().skip_while(|a| a != "--reference").skip(1);
    let Some(folder) = arguments.next().map(PathBuf::from) else {
        println!("units: give the folder of the problems as --reference DIR");
        return;
    };
    println!("problem | energy | differs by | iterations | others | where most");
    let mut worst = [0.0_f64; 2];
    for name in PROBLEMS {
        let of_problem = row(name, &folder);
        worst = [0, 1].map(|k| worst[k].max(of_problem[k]));
    }
    let [energy, iterations] = worst;
    println!("the worst difference of an energy: {energy:.1e}, of iterations: {iterations:.2}");
}

/// The worst differences of a problem, of the energy and of the iterations, as shares.
fn row(name: &str, folder: &Path) -> [f64; 2] {
    let problem = read(&folder.join("problems"), name);
    let here = solved(&problem);
    let (mut worst, mut place) = (0.0_f64, HERE);
    let (mut fewest, mut most) = (usize::MAX, 0);
    for elsewhere in poses() {
        let there = solved(&elsewhere.pose(&problem));
        let difference = (there.quality.energy / here.quality.energy - 1.0).abs();
        if worst < difference {
            (worst, place) = (difference, elsewhere);
        }
        fewest = fewest.min(there.summary.iterations);
        most = most.max(there.summary.iterations);
    }
    println!(
        "{name} | {:.8} | {worst:.1e} | {} | {fewest} to {most} | {place:?}",
        here.quality.energy, here.summary.iterations
    );
    let as_posed = here.summary.iterations as f64;
    let apart = [fewest, most].map(|n| (n as f64 - as_posed).abs() / as_posed);
    [worst, apart[0].max(apart[1])]
}

fn poses() -> Vec<Elsewhere> {
    let scales = [1e-6, 1e-3, 1.0, 1e3, 1e6].map(|scale| Elsewhere { scale, ..HERE });
    let turns = [0.4, 2.0, 4.5].map(|turn| Elsewhere { turn, ..HERE });
    let orders = [101, 211, 307].map(|first| Elsewhere { first, ..HERE });
    let far = Elsewhere { shift: 1e4, ..HERE };
    let all = Elsewhere {
        scale: 1e-3,
        turn: 2.0,
        shift: 1e4,
        first: 211,
    };
    [&scales[..], &turns, &orders, &[far, all]].concat()
}

fn solved(problem: &Problem) -> Solution {
    let go_on = |_: &Iterate| Control::Continue;
    let solution = problem.solve(&Settings::follow(), &go_on);
    solution.expect("an energy of its dimension")
}

/// A problem that means its numbers for a mean element of size 1.
fn read(folder: &Path, name: &str) -> Problem {
    let bytes = |path: &str| std::fs::read(folder.join(path)).expect("a file of the problem");
    let file = ProblemFile::parse(&bytes(&format!("{name}.json"))).expect("a problem");
    let format = ElementFormat::of_name(&file.mesh).expect("a mesh");
    let mesh = format.read(&bytes(&file.mesh)).expect("a mesh");
    let start = file.initial.as_ref().map(|path| {
        let text = String::from_utf8(bytes(path)).expect("text");
        let numbers = text.split_ascii_whitespace();
        numbers.map(|x| x.parse().expect("a number")).collect()
    });
    let file = ProblemFile {
        units: Units::Normalized,
        ..file
    };
    file.with(mesh, start).expect("a problem")
}
