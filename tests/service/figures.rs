//! Every figure of the paper is what its caption says, and its check rejects the faults planted for it.

use std::process::Command;

use crate::places;

/// Asserts that `tests/figures` accepts a figure and rejects its faults.
fn figure(number: &str) {
    let output = Command::new(places::python())
        .arg(places::repository("tests/figures"))
        .args(["--unwrapd", env!("CARGO_BIN_EXE_unwrapd")])
        .args(["--check", "--faults", number])
        .output()
        .expect("a Python");
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("rejected: "), "{text}");
}

macro_rules! figures {
    ($($test:ident: $number:literal,)*) => {$(
        #[test]
        fn $test() {
            figure($number);
        }
    )*};
}

figures! {
    figure_01_spikes_and_spillages: "1",
    figure_02_deformation_of_the_plane: "2",
    figure_03_barrier_strength: "3",
    figure_04_barrier_and_support: "4",
    figure_05_iterates_of_a_cylinder: "5",
    figure_06_barrier_functions: "6",
    figure_07_bias: "7",
    figure_08_substepping: "8",
    figure_09_energies: "9",
    figure_10_dirichlet_and_laplacian: "10",
    figure_11_bent_cylinder: "11",
    figure_12_warped_picture: "12",
    figure_13_deformation_of_space: "13",
    figure_14_nested_surfaces: "14",
    figure_15_parameterization: "15",
    figure_16_overlap_removed: "16",
    figure_17_texture_aligned: "17",
    figure_18_bounded_distortion: "18",
    figure_19_arms_and_legs_swapped: "19",
    figure_20_twisted_bar: "20",
    figure_21_two_failures: "21",
}
