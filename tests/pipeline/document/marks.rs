//! What a file says of the UVs that were written to it, and how it is judged by that.

use serde_json::{Value, json};
use unwrapd_deform::uv::parse_anchors;
use unwrapd_files::document::{Document, GroupBy, Marked, OutputFormat, Sets, Upload};
use unwrapd_pipeline::{
    EditOptions, EditedDocument, Editing, Layout, MeasureOptions, Options, Preset, Unobserved,
    Verified, VerifyOptions, edit_document, measure_document, unwrap_document, verify_document,
};

use unwrapd_maps::mesh::Resolution;

use crate::build::{Builder, glb, parts};

type Files = Vec<(String, Vec<u8>)>;

fn upload(files: &Files) -> Upload {
    let (name, bytes) = files[0].clone();
    Upload {
        name,
        bytes,
        resources: files[1..].iter().cloned().collect(),
    }
}

fn unwrapped(input: &Upload, options: &Options) -> Files {
    unwrap_document(input, options, &Unobserved).unwrap().files
}

/// What plain `verify` finds.
fn verified(files: &Files) -> Verified {
    verify_document(&upload(files), &VerifyOptions::default()).unwrap()
}

/// Judged by these options alone.
fn judged(options: &MeasureOptions) -> VerifyOptions {
    VerifyOptions {
        judged: options.clone(),
        ..VerifyOptions::default()
    }
}

/// Whether the file says itself that no two faces overlap.
fn is_promised(verified: &Verified) -> bool {
    verified
        .mark
        .as_ref()
        .is_some_and(|mark| !mark.terms.overlaps)
}

fn codes(verified: &Verified) -> Vec<&str> {
    verified.warnings.iter().map(|w| &*w.code).collect()
}

/// The file with its mark, or all of its JSON, changed.
fn changed(files: &Files, change: impl FnOnce(&mut Value)) -> Files {
    let (mut json, bin) = parts(&files[0].1);
    change(&mut json);
    vec![(files[0].0.clone(), glb(&json, &bin))]
}

fn mark(json: &mut Value) -> &mut Value {
    &mut json["asset"]["extras"]["unwrapd"]
}

#[test]
fn a_textured_asset_is_judged_where_its_uvs_went() {
    let mut builder = Builder::rich();
    builder.json["meshes"][0]["name"] = json!("Truck");
    builder.json["materials"][0]["name"] = json!("paint");
    let outcome = unwrap_document(&builder.upload(), &Options::default(), &Unobserved).unwrap();
    let said: Vec<&str> = outcome
        .report
        .warnings
        .iter()
        .map(|w| &*w.message)
        .collect();
    assert_eq!(
        said,
        [
            "the new UVs of `Truck` are in UV set 1, because textures sample set 0 (baseColorTexture of `paint`, normalTexture of \
          `paint`). `unwrap --rebake` resamples the textures and uses set 0; `--overwrite` uses set 0 and leaves the textures as \
          they are"
        ]
    );
    let verified = verified(&outcome.files);
    assert!(verified.proven.bijective && is_promised(&verified));
    assert_eq!(verified.mark.as_ref().unwrap().sets, Sets::One(1));
    let padding = verified.proven.padding.unwrap();
    assert!(padding.kept && padding.asked_texels == 2, "{padding:?}");
    let measured = measure_document(&upload(&outcome.files), &MeasureOptions::default()).unwrap();
    assert!(measured.proven.bijective);
    // A set that is named is judged as that of any file.
    let options = MeasureOptions {
        texcoord: Some(0),
        ..MeasureOptions::default()
    };
    let asked = verify_document(&upload(&outcome.files), &judged(&options)).unwrap();
    assert!(asked.mark.is_none() && asked.proven.padding.is_none());
}

#[test]
fn what_was_asked_for_is_what_is_judged() {
    let mut builder = Builder::square();
    let copy = builder.json["meshes"][0]["primitives"][0].clone();
    builder.primitive(&copy);
    builder.json["nodes"] = json!([{"mesh": 0}, {"mesh": 1}, {"mesh": 1}]);
    let lightmap = Options {
        preset: Preset::Lightmap,
        ..Options::default()
    };
    let by_scene = Options {
        group_by: Some(GroupBy::Scene),
        layout: Layout {
            padding: 5,
            ..Layout::default()
        },
        ..Options::default()
    };
    for (options, padding, aligned, groups) in [
        (lightmap, 8, Some(true), 1),
        (by_scene, 5, None, 1),
        (Options::default(), 2, None, 2),
    ] {
        let written = upload(&unwrapped(&builder.upload(), &options));
        // The record adds requirements; what shares an atlas is for the caller to say.
        let by_caller = MeasureOptions {
            group_by: (groups == 1).then_some(GroupBy::Scene),
            ..MeasureOptions::default()
        };
        let found = verify_document(&written, &judged(&by_caller)).unwrap();
        assert!(found.proven.bijective && codes(&found).is_empty());
        assert_eq!(found.proven.padding.unwrap().asked_texels, padding);
        assert_eq!(found.proven.aligned, aligned);
        assert_eq!(found.groups.len(), groups);
    }
}

#[test]
fn a_file_that_was_changed_is_judged_as_one_that_says_nothing() {
    let files = unwrapped(&Builder::rich().upload(), &Options::default());
    // What is asked of a mark that does not hold, or that asks for what cannot be asked, is nothing.
    let other_set = changed(&files, |json| mark(json)["texcoord"] = json!(0));
    let moved = {
        let (json, mut bin) = parts(&files[0].1);
        let index = &json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"];
        let view = &json["accessors"][index.as_u64().unwrap() as usize]["bufferView"];
        let view = &json["bufferViews"][view.as_u64().unwrap() as usize];
        bin[view["byteOffset"].as_u64().unwrap() as usize] ^= 1;
        vec![(files[0].0.clone(), glb(&json, &bin))]
    };
    let newer = changed(&files, |json| mark(json)["version"] = json!(2));
    let absurd = changed(&files, |json| {
        mark(json)["padding"] = json!(4_000_000_000_u32);
    });
    let wild = changed(&files, |json| mark(json)["mips"] = json!(31));
    let word = changed(&files, |json| *mark(json) = json!("here"));
    let too_many = changed(&files, |json| mark(json)["texcoord"] = json!([1, 1, 1]));
    for files in [other_set, moved, newer, absurd, wild, word, too_many] {
        let found = verified(&files);
        assert_eq!(codes(&found), ["mark_stale"]);
        assert!(found.mark.is_none() && found.proven.padding.is_none());
    }
    let none = changed(&files, |json| {
        drop(json["asset"].as_object_mut().unwrap().remove("extras"));
    });
    assert!(codes(&verified(&none)).is_empty());
}

#[test]
fn extras_that_are_no_object_stay_as_they_are() {
    let mut builder = Builder::square();
    builder.json["asset"]["extras"] = json!("mine");
    let outcome = unwrap_document(&builder.upload(), &Options::default(), &Unobserved).unwrap();
    assert_eq!(outcome.report.warnings[0].code, "not_marked");
    let (json, _) = parts(&outcome.files[0].1);
    assert_eq!(json["asset"]["extras"], "mine");
}

#[test]
fn an_obj_file_is_marked_in_its_first_line() {
    let options = Options {
        format: OutputFormat::Obj,
        layout: Layout {
            padding: 3,
            ..Layout::default()
        },
        ..Options::default()
    };
    let first = unwrapped(&Builder::rich().upload(), &options);
    let again = unwrapped(
        &upload(&first),
        &Options {
            layout: Layout {
                padding: 4,
                ..options.layout
            },
            ..options
        },
    );
    for (files, padding) in [(&first, 3), (&again, 4)] {
        let found = verified(files);
        assert_eq!(found.proven.padding.unwrap().asked_texels, padding);
        assert!(found.proven.bijective);
        let text = String::from_utf8(files[0].1.clone()).unwrap();
        assert_eq!(text.matches("# unwrapd").count(), 1);
    }
    let text = String::from_utf8(first[0].1.clone())
        .unwrap()
        .replace("vt 0.", "vt 0.0");
    let moved = vec![("a.obj".to_owned(), text.into_bytes())];
    assert_eq!(codes(&verified(&moved)), ["mark_stale"]);
}

/// Two squares side by side; the second has its UVs upside down in one half, so that a face is flipped.
fn half_flipped() -> Upload {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n\
                vt 0 0\nvt 0.25 0\nvt 0.25 0.25\nvt 0 0.25\n\
                vt 0.5 0.5\nvt 0.75 0.5\nvt 0.75 0.75\nvt 0.8125 0.5625\n\
                f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 5/5 6/6 7/7\nf 5/5 7/7 8/8\n";
    Upload::single("a.obj", text.as_bytes().to_vec())
}

fn edited(input: &Upload, to: [f64; 2], bijective: bool, format: OutputFormat) -> EditedDocument {
    let anchors = json!({"anchors": [
        {"vertex": 0, "to": [0.0, 0.0]}, {"vertex": 2, "to": to},
    ]});
    let mut options = EditOptions {
        anchors: parse_anchors(anchors.to_string().as_bytes()).unwrap(),
        format,
        ..EditOptions::default()
    };
    options.model.bijective = bijective;
    edit_document(input, Editing::Map, &options, &Unobserved).unwrap()
}

/// What `verify --bijective` finds, and with other options.
fn verified_bijective(files: &Files, judged: MeasureOptions) -> Verified {
    let options = VerifyOptions {
        bijective: true,
        judged,
        ..VerifyOptions::default()
    };
    verify_document(&upload(files), &options).unwrap()
}

#[test]
fn an_edit_is_certified_over_the_whole_set() {
    for format in [OutputFormat::Glb, OutputFormat::Obj] {
        for bijective in [false, true] {
            let edited = edited(&half_flipped(), [0.25, 0.3], bijective, format);
            let report = &edited.report;
            assert!(!report.certified && !report.bijective, "{report:?}");
            let warned: Vec<&str> = report.warnings.iter().map(|w| &*w.code).collect();
            assert!(warned.contains(&"flipped"), "{warned:?}");
            assert!(warned.contains(&"uncertified_before"), "{warned:?}");
            let found = verified(&edited.files);
            assert!(!found.certified && !found.proven.locally_injective);
            assert!(!is_promised(&found));
        }
    }
}

#[test]
fn a_chart_dragged_onto_another_is_not_certified() {
    // Two squares side by side; the anchors take the first one to where the second is.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\n\
                vt 0 0\nvt 0.25 0\nvt 0.25 0.25\nvt 0 0.25\n\
                vt 0.5 0.5\nvt 0.75 0.5\nvt 0.75 0.75\nvt 0.5 0.75\n\
                f 1/1 2/2 3/3\nf 1/1 3/3 4/4\nf 5/5 6/6 7/7\nf 5/5 7/7 8/8\n";
    let input = Upload::single("a.obj", text.as_bytes().to_vec());
    for bijective in [false, true] {
        let anchors = json!({"anchors": [
            {"vertex": 0, "to": [0.55, 0.55]}, {"vertex": 2, "to": [0.8, 0.8]},
        ]});
        let mut options = EditOptions {
            anchors: parse_anchors(anchors.to_string().as_bytes()).unwrap(),
            ..EditOptions::default()
        };
        options.model.bijective = bijective;
        let edited = edit_document(&input, Editing::Map, &options, &Unobserved).unwrap();
        assert!(!edited.report.certified && !edited.report.bijective);
        assert!(edited.report.charts.iter().all(|chart| chart.map.bijective));
        let codes: Vec<&str> = edited.report.warnings.iter().map(|w| &*w.code).collect();
        assert_eq!(codes, ["overlapping"]);
        // The record of 0.1.0 named the charts that were to be judged.
        let old = changed(&edited.files, |json| mark(json)["charts"] = json!([0]));
        for files in [&edited.files, &old] {
            let found = verified_bijective(files, MeasureOptions::default());
            assert!(!found.certified && found.groups.len() == 1);
            assert!(found.groups[0].certificate.overlapping_pairs > Some(0));
        }
    }
}

#[test]
fn a_record_takes_nothing_out_of_the_judgment() {
    // Two primitives of one mesh with the same UVs: they overlap.
    let mut builder = Builder::square();
    let copy = builder.json["meshes"][0]["primitives"][0].clone();
    let primitives = builder.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap();
    primitives.push(copy);
    let files = vec![("a.glb".to_owned(), builder.upload().bytes)];
    let certified = unwrapped(&upload(&files), &Options::default());
    let overlapping = changed(&certified, |json| {
        let primitives = json["meshes"][0]["primitives"].as_array_mut().unwrap();
        primitives[1]["attributes"]["TEXCOORD_0"] =
            primitives[0]["attributes"]["TEXCOORD_0"].clone();
    });
    let record = |change: &dyn Fn(&mut Value)| changed(&overlapping, |json| change(mark(json)));
    let forged = [
        record(&|_| ()),
        record(&|mark| mark["charts"] = json!([0])),
        record(&|mark| mark["group_by"] = json!("primitive")),
        record(&|mark| mark["separate_nodes"] = json!(true)),
        record(&|mark| mark["overlaps"] = json!(true)),
        record(&|mark| mark["texcoord"] = json!([0, null])),
        record(&|mark| mark["texcoord"] = json!([null, 0])),
        record(&|mark| mark["resolution"] = json!(65536)),
        record(&|mark| *mark = json!({"version": 1, "group_by": "primitive"})),
    ];
    for files in &forged {
        // A digest that fits is no secret.
        for files in [files.clone(), with_digest(files)] {
            let found = verified_bijective(&files, MeasureOptions::default());
            assert!(!found.certified, "{:?}", found.mark);
            let judged: usize = found.groups.iter().map(|g| g.certificate.faces).sum();
            assert_eq!(judged, 4);
        }
    }
}

/// The file with the digest in its record that fits the UVs, as anybody can compute it.
fn with_digest(files: &Files) -> Files {
    use sha2::{Digest as _, Sha256};
    let document = Document::read(&upload(files)).unwrap();
    changed(files, |json| {
        let sets = mark(json)["texcoord"].clone();
        let mut digest = Sha256::new();
        for primitive in 0..document.primitives().len() {
            let set = sets.as_u64().or_else(|| sets[primitive].as_u64());
            let Some(set) = set.map(|set| set as u32) else {
                continue;
            };
            let uvs = document.corner_uvs(primitive, set).unwrap().unwrap();
            digest.update(set.to_le_bytes());
            digest.update((uvs.len() as u64).to_le_bytes());
            for number in uvs.as_flattened().as_flattened() {
                digest.update(number.to_le_bytes());
            }
        }
        let bytes = digest.finalize();
        let bytes = std::array::from_fn(|k| bytes[k]);
        mark(json)["digest"] = json!(format!("{:032x}", u128::from_be_bytes(bytes)));
    })
}

#[test]
fn the_padding_of_a_caller_is_counted_in_the_texture_of_the_caller() {
    let fine = Options {
        layout: Layout {
            padding: 2,
            resolution: Resolution::square(4096),
            ..Layout::default()
        },
        ..Options::default()
    };
    let files = unwrapped(&Builder::rich().upload(), &fine);
    let recorded = verified(&files).proven.padding.unwrap();
    assert_eq!(
        (recorded.asked_texels, recorded.resolution.width),
        (2, 4096)
    );
    let asked = MeasureOptions {
        padding: Some(2),
        ..MeasureOptions::default()
    };
    let found = verify_document(&upload(&files), &judged(&asked)).unwrap();
    assert_eq!(found.proven.padding.unwrap().resolution.width, 1024);
}

#[test]
fn edited_maps_that_stay_apart_promise_it() {
    let input = Builder::square().upload();
    let files = unwrapped(&input, &Options::default());
    for bijective in [false, true] {
        let edited = edited(&upload(&files), [0.9, 0.9], bijective, OutputFormat::Glb);
        assert!(edited.report.certified, "{:?}", edited.report);
        let found = verified(&edited.files);
        assert!(found.certified && is_promised(&found) && found.proven.bijective);
        assert!(matches!(
            Document::read(&upload(&edited.files))
                .unwrap()
                .marked()
                .unwrap(),
            Marked::Fits(_)
        ));
    }
}
