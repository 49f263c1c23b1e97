//! Islands whose nearly straight borders become straight, as options say.

use crate::islands::{uvs, written};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::Write;
use unwrapd_files::document::{OutputFormat, Upload};
use unwrapd_layout::atlas::Rotation;
use unwrapd_layout::charts::Cut;
use unwrapd_maps::mesh::CornerUvs;
use unwrapd_method::barrier::BarrierKind;
use unwrapd_pipeline::{
    CommandOptions, Cutting, IslandControl, KeptMaps, Layout, Mapping, Options, Outcome,
    RepackOptions, Straightening, Unobserved, repack_document, unwrap_document,
};

/// An open tube that bends by a right angle: 6 rings of 8 quads.
fn elbow() -> Upload {
    let (rings, sides) = (6, 8);
    let mut text = String::new();
    for i in 0..=rings {
        let (sin, cos) = (FRAC_PI_2 * f64::from(i) / f64::from(rings)).sin_cos();
        for k in 0..sides {
            let (y, x) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
            let r = 1.0 - 0.2 * x;
            writeln!(text, "v {} {} {}", r * cos, -0.2 * y, r * sin).expect("text");
        }
    }
    for i in 0..rings {
        for k in 0..sides {
            let [a, b] = [k, (k + 1) % sides].map(|k| 1 + i * sides + k);
            writeln!(text, "f {a} {b} {} {}", b + sides, a + sides).expect("text");
        }
    }
    Upload::single("elbow.obj", text.into_bytes())
}

/// Belts around cones, of 12 quads in a row each, unrolled in the texture to narrow arcs.
fn belts(n: usize) -> Upload {
    const QUADS: usize = 12;
    let mut text = String::new();
    for belt in 0..n {
        for i in 0..=QUADS {
            let angle = i as f64 / QUADS as f64 * TAU / 6.0;
            for r in [0.42, 0.44] {
                let [x, y, z] = [r * angle.cos(), r * angle.sin(), belt as f64 + 0.5 * r];
                let slant = 1.25_f64.sqrt();
                let (sin, cos) = (angle / slant).sin_cos();
                let u = r * slant * cos + 0.06 * (belt % 6) as f64;
                let v = r * slant * sin + 0.45 * (belt / 6) as f64;
                writeln!(text, "v {x} {y} {z}\nvt {u} {v}").expect("text");
            }
        }
        for i in 0..QUADS {
            let a = 1 + 2 * (belt * (QUADS + 1) + i);
            let [b, c, d] = [a + 1, a + 3, a + 2];
            writeln!(text, "f {a}/{a} {b}/{b} {c}/{c} {d}/{d}").expect("text");
        }
    }
    Upload::single("belts.obj", text.into_bytes())
}

fn control(straighten: Option<&str>) -> IslandControl {
    IslandControl {
        straighten: straighten.map(|text| text.parse().expect("a value")),
        ..IslandControl::default()
    }
}

fn unwrapped(upload: &Upload, straighten: Option<&str>, options: Options) -> Outcome {
    let options = Options {
        control: control(straighten),
        format: OutputFormat::Obj,
        ..options
    };
    let outcome = unwrap_document(upload, &options, &Unobserved).expect("it unwraps");
    assert!(outcome.report.certified, "{:?}", outcome.report.warnings);
    outcome
}

/// Share of the border of some faces in the texture that lies within half a degree of the axes.
fn aligned_share(faces: &[CornerUvs]) -> f64 {
    let bits = |p: [f64; 2]| p.map(f64::to_bits);
    let edges = || {
        let ends = |face: &CornerUvs| [0, 1, 2].map(|k| [face[k], face[(k + 1) % 3]]);
        faces.iter().flat_map(ends)
    };
    let key = |[p, q]: [[f64; 2]; 2]| [bits(p).min(bits(q)), bits(p).max(bits(q))];
    let mut sides: BTreeMap<[[u64; 2]; 2], usize> = BTreeMap::new();
    for edge in edges() {
        *sides.entry(key(edge)).or_default() += 1;
    }
    let (mut aligned, mut all) = (0.0, 0.0);
    for [p, q] in edges().filter(|edge| sides[&key(*edge)] == 1) {
        let [x, y] = [q[0] - p[0], q[1] - p[1]];
        let length = x.hypot(y);
        all += length;
        if x.abs().min(y.abs()) < 0.5_f64.to_radians().sin() * length {
            aligned += length;
        }
    }
    aligned / all
}

fn share_of(outcome: &Outcome) -> f64 {
    aligned_share(&uvs(&written(outcome)))
}

/// New charts of tubes become rectangles unless the caller declines, and keep the bound.
#[test]
fn an_elbow_becomes_a_rectangle() {
    for (straighten, is_straight) in [(None, true), (Some("auto"), true), (Some("off"), false)] {
        let outcome = unwrapped(&elbow(), straighten, Options::default());
        let share = share_of(&outcome);
        assert_eq!(share > 0.99, is_straight, "{straighten:?}: {share}");
        assert!(is_straight || share < 0.3, "{straighten:?}: {share}");
        let distortion = &outcome.report.groups[0].measures.distortion;
        let mean = distortion.sym_dirichlet_mean;
        assert!(mean < Some(4.1 + 1e-6), "{straighten:?}: {mean:?}");
    }
}

/// With `cut` keep islands are the caller's: none becomes straight without being asked for.
#[test]
fn kept_islands_stay_as_they_are() {
    let kept = || Options {
        cutting: Cutting {
            cut: Cut::Keep,
            ..Cutting::default()
        },
        ..Options::default()
    };
    let default = unwrapped(&belts(1), None, kept());
    let off = unwrapped(&belts(1), Some("off"), kept());
    assert_eq!(uvs(&written(&default)), uvs(&written(&off)));
    assert!(share_of(&default) < 0.3);
    let as_given = Options {
        cutting: Cutting {
            kept_maps: KeptMaps::AsGiven,
            ..kept().cutting
        },
        ..kept()
    };
    assert!(share_of(&unwrapped(&belts(1), None, as_given)) < 0.3);
    // Asked for, they do, where others need as large a page.
    let auto = unwrapped(&belts(12), Some("auto"), kept());
    assert!(share_of(&auto) > 0.99, "{}", share_of(&auto));
}

/// A list that cannot be read, or selects no island, is refused with the reason.
#[test]
fn a_bad_list_is_refused() {
    for text in ["", "straight", "auto;off", "faces=0/0;;all", "all: lock"] {
        let error = text.parse::<Straightening>().expect_err(text);
        assert!(error.contains("auto"), "{text}: {error}");
    }
    let options = RepackOptions {
        control: control(Some("color=123456")),
        ..RepackOptions::default()
    };
    let error = repack_document(&belts(1), &options, &Unobserved).expect_err("nothing is selected");
    assert!(error.to_string().contains("color=123456"), "{error}");
}

/// A named island that cannot become straight under the bound is reported, not passed over.
#[test]
fn islands_that_stay_bent_are_reported() {
    let with = |max_distortion| {
        let options = Options {
            cutting: Cutting {
                max_distortion: Some(max_distortion),
                ..Cutting::default()
            },
            ..Options::default()
        };
        let outcome = unwrapped(&elbow(), Some("all"), options);
        let warnings = outcome.report.warnings.iter();
        let bent = warnings
            .filter(|warning| warning.code == "bent_borders")
            .count();
        (share_of(&outcome) > 0.99, bent)
    };
    assert_eq!(with(4.2), (true, 0));
    assert_eq!(with(4.06), (false, 1));
}

/// Without a barrier a map may flip while its borders turn, so that is refused instead of being left undone.
#[test]
fn straightening_needs_a_barrier() {
    let with = |straighten| {
        let options = Options {
            control: control(Some(straighten)),
            mapping: Mapping {
                barrier: BarrierKind::None,
                ..Mapping::default()
            },
            ..Options::default()
        };
        options.check().map_err(|error| error.to_string())
    };
    for straighten in ["auto", "all"] {
        let error = with(straighten).expect_err(straighten);
        assert!(
            error.contains("`straighten` requires a `barrier`"),
            "{error}"
        );
    }
    assert_eq!(with("off"), Ok(()));
}

/// A value is written as it is read.
#[test]
fn values_survive_a_round_trip() {
    for text in ["auto", "off", "all", "material=skin;faces=0/1,0/5"] {
        let value: Straightening = text.parse().expect(text);
        let again: Straightening = value.to_string().parse().expect(text);
        assert_eq!(value, again, "{text}");
    }
}

/// A list names islands by any of their faces; all others stay.
#[test]
fn a_list_names_islands() {
    let options = |straighten| RepackOptions {
        control: control(straighten),
        format: OutputFormat::Obj,
        layout: Layout {
            rotate: Rotation::Quarter,
            ..Layout::default()
        },
        ..RepackOptions::default()
    };
    let repacked = |straighten| {
        let outcome = repack_document(&belts(12), &options(straighten), &Unobserved);
        let faces = uvs(&written(&outcome.expect("it fits")));
        [0, 1, 2].map(|belt| aligned_share(&faces[24 * belt..24 * (belt + 1)]))
    };
    let straight = |straighten| repacked(straighten).map(|share| share > 0.99);
    assert_eq!(straight(None), [false; 3]);
    assert_eq!(
        straight(Some("faces=0/0; faces=0/40,0/41")),
        [true, true, false]
    );
    assert_eq!(straight(Some("all")), [true; 3]);
}
