//! The whole path on plain arrays: every mesh of the zoo, scale, threads, early ends.

use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use unwrapd_layout::charts::{Cut, Quality};
use unwrapd_maps::certificate::{Overlap, certify, chart_ids};
use unwrapd_maps::measure::{MeasureOptions, Measures, measure};
use unwrapd_maps::mesh::VAxis;
use unwrapd_method::energy::DensityKind;
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{
    Cutting, Mapping, Observer, PipelineError, Progress, Seams, Settings, Stage, Unobserved,
    Unwrapped, Workers, unwrap, unwrap_along,
};

use crate::zoo::{self, Mesh};

fn settings(cut: Cut) -> Settings {
    Settings {
        cutting: Cutting {
            cut,
            ..Cutting::default()
        },
        ..Settings::default()
    }
}

#[test]
fn faces_wound_against_their_neighbors_stay_in_their_chart() {
    for mesh in [zoo::grid(8, 8), zoo::sphere(8, 12), zoo::torus(12, 8)] {
        let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
        for cut in [Cut::Auto, Cut::Disk, Cut::Fast] {
            let unwrap = |triangles: &[[u32; 3]]| {
                unwrap(&positions, triangles, &settings(cut), &Unobserved).unwrap()
            };
            let consistent = unwrap(&mesh.triangles);
            for every in [3, 7] {
                let mut triangles = mesh.triangles.clone();
                for triangle in triangles.iter_mut().step_by(every) {
                    triangle.swap(1, 2);
                }
                let mixed = unwrap(&triangles);
                let n_more = mixed.charts.len().abs_diff(consistent.charts.len());
                assert!(n_more <= 1, "{cut:?} {}", mesh.name);
                for (face, [a, b, c]) in mixed.corner_uvs().into_iter().enumerate() {
                    let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
                    assert_eq!(doubled < 0.0, face % every == 0, "{cut:?} {}", mesh.name);
                }
            }
        }
    }
}

#[test]
fn a_chart_wound_one_way_as_much_as_the_other_is_cut_between_them() {
    let mesh = zoo::grid(8, 8);
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    let mut triangles = mesh.triangles.clone();
    for triangle in &mut triangles[64..] {
        triangle.swap(1, 2);
    }
    let mixed = unwrap(&positions, &triangles, &settings(Cut::Auto), &Unobserved).unwrap();
    assert_eq!(mixed.charts.len(), 2);
    for [a, b, c] in mixed.corner_uvs() {
        assert!((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0);
    }
}

#[test]
fn a_bound_on_the_stretch_makes_nothing_worse_where_the_number_of_charts_decides() {
    let bytes = std::fs::read(crate::places::asset("spot.ply")).unwrap();
    let mesh = unwrapd_files::io::ply::read(&bytes).unwrap();
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    let figures = |max_stretch: Option<f64>| {
        let settings = Settings {
            cutting: Cutting {
                max_charts: Some(2),
                max_stretch,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let unwrapped = unwrap(&positions, &mesh.triangles, &settings, &Unobserved).unwrap();
        let uvs = unwrapped.corner_uvs();
        let measured = measure(
            &positions,
            &mesh.triangles,
            &uvs,
            VAxis::Up,
            &MeasureOptions::default(),
        );
        (
            unwrapped.charts.len(),
            measured.distortion.stretch_p99.unwrap(),
        )
    };
    let (free, bounded) = (figures(None), figures(Some(1.3)));
    assert!(free.0 <= 2 && bounded.0 <= 2);
    assert!(bounded.1 <= 1.001 * free.1, "{free:?} {bounded:?}");
}

fn has_a_triangle(mesh: &Mesh) -> bool {
    mesh.triangles.iter().any(|t| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        a != b && b != c && c != a
    })
}

/// Without flips; and without overlaps, unless one chart per component was asked for.
#[track_caller]
fn assert_certified(mesh: &Mesh, cut: Cut, unwrapped: &Unwrapped) {
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    let uvs = unwrapped.corner_uvs();
    assert_eq!(uvs.len(), mesh.triangles.len(), "{}", mesh.name);
    let inside = |x: &f64| (0.0..=1.0).contains(x);
    assert!(
        uvs.as_flattened().as_flattened().iter().all(inside),
        "{}",
        mesh.name
    );
    let certificate = certify(&positions, &mesh.triangles, &uvs, &Overlap::Test.into());
    assert!(certificate.is_valid(), "{}: {certificate:?}", mesh.name);
    let is_bijective = cut == Cut::Disk || certificate.is_bijective();
    assert!(is_bijective, "{}: {certificate:?}", mesh.name);
    // Of each chart the larger part, in the plane, is seen from the front; [front less back, both].
    let mut areas = vec![[0.0; 2]; uvs.len()];
    for (chart, [a, b, c]) in chart_ids(&positions, &mesh.triangles, &uvs)
        .into_iter()
        .zip(&uvs)
    {
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let [front, all] = &mut areas[chart as usize];
        *front += doubled;
        *all += doubled.abs();
    }
    let is_mirrored = |[front, all]: &[f64; 2]| *front < -1e-5 * all;
    assert!(!areas.iter().any(is_mirrored), "{}", mesh.name);
}

#[test]
fn the_zoo_is_certified_in_both_modes() {
    for mesh in zoo::zoo().iter().filter(|mesh| has_a_triangle(mesh)) {
        for cut in [Cut::Auto, Cut::Fast, Cut::Disk] {
            let unwrapped = unwrap(
                &mesh.positions,
                &mesh.triangles,
                &settings(cut),
                &Unobserved,
            )
            .unwrap_or_else(|error| panic!("{}: {error}", mesh.name));
            assert_certified(mesh, cut, &unwrapped);
        }
    }
}

#[test]
fn every_energy_is_certified_on_a_torus() {
    let mesh = zoo::torus(12, 8);
    for energy in [
        DensityKind::Arap,
        DensityKind::Green,
        DensityKind::Lscm,
        DensityKind::SymmetricDirichlet,
        DensityKind::Mips,
        DensityKind::Amips,
        DensityKind::StVenantKirchhoff,
        DensityKind::NeoHookean,
        "log(s1)^2 + log(s2)^2".parse().expect("a formula"),
    ] {
        let settings = Settings {
            mapping: Mapping {
                energy,
                ..settings(Cut::Disk).mapping
            },
            ..settings(Cut::Disk)
        };
        let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved)
            .expect("a torus is a mesh");
        assert_certified(&mesh, settings.cutting.cut, &unwrapped);
    }
}

#[test]
fn the_number_of_threads_does_not_show() {
    let mesh = zoo::sphere(24, 16).with(&zoo::torus(16, 12).moved([3.0, 0.0, 0.0]));
    let with_threads = |threads| {
        let settings = Settings {
            workers: Workers {
                threads: Some(threads),
            },
            ..Settings::default()
        };
        unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved)
            .expect("two closed surfaces are a mesh")
            .grid
    };
    let one = with_threads(1);
    assert_eq!(one, with_threads(2));
    assert_eq!(one, with_threads(4));
}

#[test]
fn positions_may_have_either_precision() {
    let mesh = zoo::sphere(12, 7);
    let unwrapped = |positions: &[[f64; 3]]| {
        let settings = Settings::default();
        let unwrapped = unwrap(positions, &mesh.triangles, &settings, &Unobserved);
        unwrapped.expect("it unwraps")
    };
    let single = unwrap(
        &mesh.positions,
        &mesh.triangles,
        &Settings::default(),
        &Unobserved,
    );
    let double: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    assert_eq!(
        unwrapped(&double).corner_uvs(),
        single.expect("it unwraps").corner_uvs()
    );
    // So far away that all positions would be one in f32.
    let far: Vec<[f64; 3]> = double.iter().map(|p| p.map(|x| x + 1e9)).collect();
    let uvs = unwrapped(&far).corner_uvs();
    let certificate = certify(&far, &mesh.triangles, &uvs, &Overlap::Test.into());
    assert!(certificate.is_bijective(), "{certificate:?}");
    assert_eq!(certificate.degenerate, 0);
}

/// The corners of a face, by the bits of their positions, and its UVs.
type Placed = ([[u32; 3]; 3], [[i32; 2]; 3]);

#[test]
fn the_order_of_the_input_does_not_show() {
    let unwrapped = |mesh: &Mesh| -> Vec<Placed> {
        let done = unwrap(
            &mesh.positions,
            &mesh.triangles,
            &settings(Cut::Auto),
            &Unobserved,
        );
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize].map(f32::to_bits));
        let mut faces: Vec<_> = (mesh.triangles.iter().map(corners))
            .zip(done.expect("an atlas").grid)
            .collect();
        faces.sort_unstable();
        faces
    };
    for mesh in [zoo::sphere(24, 17), zoo::slab(1)].map(Mesh::lopsided) {
        assert_eq!(unwrapped(&mesh), unwrapped(&mesh.shuffled()));
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let mesh = zoo::sphere(16, 12);
    for scale in [1e-9_f32, 1.0, 1e9] {
        let mut scaled = mesh.clone();
        for x in scaled.positions.as_flattened_mut() {
            *x *= scale;
        }
        let unwrapped = unwrap(
            &scaled.positions,
            &scaled.triangles,
            &Settings::default(),
            &Unobserved,
        )
        .expect("a sphere is a mesh");
        assert_certified(&scaled, Cut::Auto, &unwrapped);
    }
}

/// Ends the work at its first iteration and records what it was told.
struct Impatient {
    reports: std::sync::Mutex<Vec<Progress>>,
    ticks: AtomicUsize,
}

impl Observer for Impatient {
    fn progress(&self, progress: &Progress) -> Control {
        self.reports
            .lock()
            .expect("no reporter panics")
            .push(progress.clone());
        Control::Finish
    }
    fn elapsed(&self) -> Duration {
        Duration::from_millis(self.ticks.fetch_add(1, Ordering::Relaxed) as u64)
    }
}

#[test]
fn work_ended_early_is_valid_and_its_progress_never_falls() {
    let mesh = zoo::sphere(24, 16);
    let observer = Impatient {
        reports: std::sync::Mutex::default(),
        ticks: AtomicUsize::new(0),
    };
    let settings = Settings {
        workers: Workers { threads: Some(1) },
        ..settings(Cut::Disk)
    };
    let unwrapped = unwrap(&mesh.positions, &mesh.triangles, &settings, &observer)
        .expect("an early end is not an error");
    assert_certified(&mesh, settings.cutting.cut, &unwrapped);
    assert!(
        unwrapped
            .charts
            .iter()
            .all(|chart| chart.summary.iterations <= 1)
    );
    let reports = observer.reports.into_inner().expect("no reporter panics");
    assert!(reports.windows(2).all(|w| w[0].fraction <= w[1].fraction));
    assert!(reports.iter().any(|report| report.stage == Stage::Pack));
}

#[test]
fn charts_are_counted_once_they_are_known_and_none_is_slit_when_the_time_is_up() {
    let mesh = zoo::torus(24, 16);
    let smooth = Settings {
        cutting: Cutting {
            quality: Quality::Smooth,
            ..settings(Cut::Auto).cutting
        },
        ..settings(Cut::Auto)
    };
    let observer = Impatient {
        reports: std::sync::Mutex::default(),
        ticks: AtomicUsize::new(0),
    };
    let hasty = unwrap(&mesh.positions, &mesh.triangles, &smooth, &observer);
    let hasty = hasty.expect("an early end is not an error");
    assert_certified(&mesh, smooth.cutting.cut, &hasty);
    let reports = observer.reports.into_inner().expect("no reporter panics");
    let packing = reports.iter().find(|report| report.stage == Stage::Pack);
    let packing = packing.expect("it was packed");
    assert_eq!(
        (packing.chart, packing.charts),
        (hasty.charts.len(), hasty.charts.len())
    );
    assert!(
        reports
            .iter()
            .all(|report| report.charts == 0 || report.charts == packing.charts)
    );
    let seam = |made: &Unwrapped| {
        let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
        let uvs = made.corner_uvs();
        let options = MeasureOptions::default();
        let measures = measure(&positions, &mesh.triangles, &uvs, VAxis::Up, &options);
        measures.seams.seam_over_sqrt_area.expect("it has an area")
    };
    let patient = unwrap(&mesh.positions, &mesh.triangles, &smooth, &Unobserved);
    assert!(seam(&hasty) < seam(&patient.expect("a torus is a mesh")));
}

#[test]
fn repeated_faces_lie_on_an_edge_of_a_neighbor() {
    let mut mesh = zoo::grid(4, 4);
    mesh.triangles.push([0, 0, 1]);
    mesh.triangles.push([2, 2, 2]);
    let unwrapped = unwrap(
        &mesh.positions,
        &mesh.triangles,
        &Settings::default(),
        &Unobserved,
    )
    .expect("a grid is a mesh");
    assert_certified(&mesh, Cut::Auto, &unwrapped);
    let corners = |vertex: u32| -> Vec<[i32; 2]> {
        let faces = mesh
            .triangles
            .iter()
            .zip(&unwrapped.grid)
            .take(mesh.triangles.len() - 2);
        faces
            .flat_map(|(t, uv)| {
                t.iter()
                    .zip(uv)
                    .filter(|(v, _)| **v == vertex)
                    .map(|(_, p)| *p)
            })
            .collect()
    };
    let [a, b, c] = unwrapped.grid[mesh.triangles.len() - 2];
    assert_eq!(a, b);
    assert!(corners(0).contains(&a) && corners(1).contains(&c));
    assert!(corners(2).contains(&unwrapped.grid[mesh.triangles.len() - 1][0]));
}

/// Without cuts for a fuller atlas, which are another matter; with what the UVs measure.
fn measured(settings: &Settings, mesh: &Mesh) -> Measures {
    let settings = Settings {
        cutting: Cutting {
            seam_weight: 1e6,
            ..settings.cutting
        },
        ..settings.clone()
    };
    let unwrapped =
        unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved).expect("a mesh");
    assert_certified(mesh, settings.cutting.cut, &unwrapped);
    let positions: Vec<[f64; 3]> = mesh.positions.iter().map(|p| p.map(f64::from)).collect();
    let uvs = unwrapped.corner_uvs();
    let options = MeasureOptions::default();
    measure(&positions, &mesh.triangles, &uvs, VAxis::Up, &options)
}

fn unwrapped_under(quality: Quality, mesh: &Mesh) -> Measures {
    let settings = Settings {
        cutting: Cutting {
            quality,
            ..Cutting::default()
        },
        ..Settings::default()
    };
    let measures = measured(&settings, mesh);
    let mean = measures.distortion.sym_dirichlet_mean.expect("faces");
    assert!(mean <= quality.bound(), "{quality:?}: {mean}");
    measures
}

#[test]
fn bounds_of_ones_own_are_kept() {
    let mesh = zoo::sphere(48, 31);
    let under = |max_distortion, max_stretch| {
        let settings = Settings {
            cutting: Cutting {
                max_distortion,
                max_stretch,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let Measures {
            distortion, seams, ..
        } = measured(&settings, &mesh);
        let mean = distortion.sym_dirichlet_mean.expect("faces");
        let stretch = distortion.stretch_p99.expect("faces");
        (mean, stretch, seams.seam_length)
    };
    let loose = under(Some(5.0), None);
    let tight = under(Some(4.03), None);
    assert!(loose.0 <= 5.0 && tight.0 <= 4.03 && loose.2 < tight.2);
    let most = 0.5 * (1.0 + loose.1);
    let (mean, stretch, _) = under(Some(5.0), Some(most));
    assert!(mean <= 5.0 && stretch <= most, "{stretch} over {most}");
}

#[test]
fn bounds_without_sense_are_refused() {
    let mesh = zoo::sphere(8, 5);
    let refused = |cut, max_distortion, max_stretch| {
        let settings = Settings {
            cutting: Cutting {
                max_distortion,
                max_stretch,
                ..settings(cut).cutting
            },
            ..settings(cut)
        };
        let made = unwrap(&mesh.positions, &mesh.triangles, &settings, &Unobserved);
        matches!(made, Err(PipelineError::InvalidOptions(_)))
    };
    for distortion in [4.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refused(Cut::Auto, Some(distortion), None), "{distortion}");
    }
    for stretch in [1.0, 0.0, f64::NAN, f64::INFINITY] {
        assert!(refused(Cut::Auto, None, Some(stretch)), "{stretch}");
    }
    assert!(refused(Cut::Fast, Some(4.2), None));
    assert!(refused(Cut::Disk, None, Some(2.0)));
    assert!(!refused(Cut::Auto, Some(4.2), Some(2.0)));
}

/// One chart with less distortion; only `cut` disk has cones.
#[test]
fn cones_need_one_chart() {
    let mesh = zoo::torus(20, 12);
    let with = |cut, cones| Settings {
        cutting: Cutting {
            cones,
            ..settings(cut).cutting
        },
        ..settings(cut)
    };
    let [before, after] = [None, Some(4)].map(|cones| measured(&with(Cut::Disk, cones), &mesh));
    assert_eq!(after.seams.charts, 1);
    assert!(after.distortion.sym_dirichlet_mean < before.distortion.sym_dirichlet_mean);
    assert!(after.seams.seam_length > before.seams.seam_length);
    for cut in [Cut::Auto, Cut::Fast, Cut::Seams] {
        let made = unwrap(
            &mesh.positions,
            &mesh.triangles,
            &with(cut, Some(4)),
            &Unobserved,
        );
        assert!(
            matches!(made, Err(PipelineError::InvalidOptions(_))),
            "{cut:?}"
        );
    }
}

/// A component with many cones is parted where its map would overlap itself, and nothing overlaps.
#[test]
fn maps_with_many_cones_do_not_overlap() {
    for mesh in [zoo::sphere(24, 13), zoo::torus(20, 12), zoo::slab(2)] {
        let settings = Settings {
            cutting: Cutting {
                cones: Some(60),
                ..settings(Cut::Disk).cutting
            },
            ..settings(Cut::Disk)
        };
        let measures = measured(&settings, &mesh);
        assert_eq!(measures.overlaps.overlap_pairs_exact, Some(0));
    }
}

/// Returns whether an edge at a vertex, found by its position, has different UVs on its two sides.
pub fn is_on_seam(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    uvs: &[[[f64; 2]; 3]],
    vertex: u32,
) -> bool {
    let key = |v: u32| positions[v as usize].map(f64::to_bits);
    let mut sides: HashMap<[u64; 3], HashSet<[[u64; 2]; 2]>> = HashMap::new();
    for (triangle, uvs) in triangles.iter().zip(uvs) {
        let at = |k: usize| uvs[k].map(f64::to_bits);
        for k in (0..3).filter(|&k| key(triangle[k]) == key(vertex)) {
            for other in [(k + 1) % 3, (k + 2) % 3] {
                let ends = sides.entry(key(triangle[other])).or_default();
                ends.insert([at(k), at(other)]);
            }
        }
    }
    sides.values().any(|ends| ends.len() > 1)
}

/// Charts of a mesh that is slit through given cones.
fn through(mesh: &Mesh, cones: &[u32], cut: Cut) -> Result<usize, PipelineError> {
    let seams = Seams {
        cones: Some(cones.to_vec()),
        ..Seams::default()
    };
    let (positions, triangles) = (&mesh.positions, &mesh.triangles);
    let made = unwrap_along(positions, triangles, &seams, &settings(cut), &Unobserved)?;
    let positions: Vec<[f64; 3]> = positions.iter().map(|p| p.map(f64::from)).collect();
    let uvs = made.corner_uvs();
    let certificate = certify(&positions, triangles, &uvs, &Overlap::Test.into());
    assert!(certificate.is_bijective(), "{cones:?}: {certificate:?}");
    for &cone in cones {
        assert!(
            is_on_seam(&positions, triangles, &uvs, cone),
            "{cone} of {cones:?}"
        );
    }
    Ok(made.charts.len())
}

/// Seams pass through given cones, and a map that overlaps itself is parted.
#[test]
fn cones_may_be_given() {
    for mesh in [zoo::sphere(12, 7), zoo::torus(12, 8)] {
        let all: Vec<u32> = (0..mesh.positions.len() as u32).collect();
        assert_eq!(
            through(&mesh, &all[3..5], Cut::Disk).expect("it unwraps"),
            1
        );
        through(&mesh, &all, Cut::Disk).expect("it unwraps");
        let error = through(&mesh, &[all.len() as u32], Cut::Disk).expect_err("no such vertex");
        assert_eq!(error.code(), "invalid_seams");
        let error = through(&mesh, &all[..1], Cut::Fast).expect_err("many charts");
        assert_eq!(error.code(), "invalid_options");
    }
}

/// `cut` disk under a bound slits a component to as many cones as the bound needs.
#[test]
fn cones_keep_a_bound() {
    let mesh = zoo::torus(20, 12);
    let with = |cut, max_distortion| Settings {
        cutting: Cutting {
            max_distortion: Some(max_distortion),
            ..settings(cut).cutting
        },
        ..settings(cut)
    };
    let mut before = f64::INFINITY;
    for most in [4.02, 4.1, 4.5] {
        let measures = measured(&with(Cut::Disk, most), &mesh);
        let mean = measures.distortion.sym_dirichlet_mean.expect("faces");
        assert!(mean <= most, "{mean} for {most}");
        assert!(measures.seams.seam_length <= before);
        before = measures.seams.seam_length;
    }
    let mut both = with(Cut::Disk, 4.1);
    both.cutting.cones = Some(4);
    for wrong in [both, with(Cut::Fast, 4.1)] {
        let made = unwrap(&mesh.positions, &mesh.triangles, &wrong, &Unobserved);
        assert!(matches!(made, Err(PipelineError::InvalidOptions(_))));
    }
}

#[test]
fn an_atlas_keeps_its_bound_with_few_charts() {
    let mesh = zoo::sphere(32, 24).with(&zoo::torus(32, 16).moved([4.0, 0.0, 0.0]));
    let seams = [Quality::Few, Quality::Balanced, Quality::Smooth].map(|quality| {
        let measures = unwrapped_under(quality, &mesh);
        assert!(measures.seams.charts <= 12, "{quality:?}");
        measures.seams.seam_length
    });
    assert!(seams[0] < seams[2], "{seams:?}");
}

#[test]
fn large_charts_keep_their_bound_with_slits_planned_on_simpler_ones() {
    let seam = |[n, m]: [u32; 2]| {
        let measures = unwrapped_under(Quality::Balanced, &zoo::sphere(n, m));
        assert!(measures.seams.charts <= 12, "{n} x {m}");
        measures.seams.seam_length
    };
    let [small, large] = [[64, 63], [192, 191]].map(seam);
    assert!(large < 1.3 * small, "{large} beside {small}");
}

#[test]
fn a_tube_is_cut_open() {
    // Without curvature, but whole it is a ring with an energy of more than 5.
    let mesh = zoo::tube(48, 2.0);
    let measures = unwrapped_under(Quality::Balanced, &mesh);
    assert_eq!(measures.seams.charts, 1);
    assert!((measures.seams.seam_length - 2.0).abs() < 1e-5);
}

#[test]
fn charts_are_cut_for_a_fuller_atlas_unless_seams_are_dear() {
    // A domed cross of five squares fills five ninths of its square. A plane would not be cut.
    let arms = [[0, 0], [4, 0], [-4, 0], [0, 4], [0, -4]];
    let cells = || (0..16).map(|cell| [cell % 4, cell / 4]);
    let vertex = |[x, y]: [i32; 2]| {
        let [x, y] = [x, y].map(|k| k as f32 / 4.0);
        let square = |x: f32| (x - 0.5).powi(2);
        [x, y, 0.15 * (square(x) + square(y))]
    };
    let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
    let cross = Mesh {
        triangles: (0..5 * 16)
            .flat_map(|i: u32| [[4 * i, 4 * i + 1, 4 * i + 2], [4 * i, 4 * i + 2, 4 * i + 3]])
            .collect(),
        positions: (arms
            .iter()
            .flat_map(|arm| cells().map(move |cell| (arm, cell))))
        .flat_map(|(arm, cell)| corners.map(|c| [0, 1].map(|k| arm[k] + cell[k] + c[k])))
        .map(vertex)
        .collect(),
        name: "cross".into(),
    };
    let with = |seam_weight| {
        let settings = Settings {
            cutting: Cutting {
                seam_weight,
                ..Cutting::default()
            },
            ..Settings::default()
        };
        let unwrapped = unwrap(&cross.positions, &cross.triangles, &settings, &Unobserved).unwrap();
        assert_certified(&cross, Cut::Auto, &unwrapped);
        (unwrapped.charts.len(), unwrapped.scale)
    };
    let (free, dear) = (with(0.0), with(1e6));
    assert_eq!(dear.0, 1);
    assert!(free.0 > 1 && free.1 > 1.02 * dear.1, "{free:?} {dear:?}");
}
