//! What a file says of the UVs that were written to it, and how it is judged by that.

use serde_json::{Value, json};
use unwrapd::deform::uv::parse_anchors;
use unwrapd::document::{Document, GroupBy, Marked, OutputFormat, Sets, Upload};
use unwrapd::pipeline::{
    EditOptions, Editing, Layout, MeasureOptions, Options, Preset, Unobserved, Verified,
    VerifyOptions, edit_document, measure_document, unwrap_document, verify_document,
};

use super::build::{Builder, glb, parts};

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
        let found = verified(&unwrapped(&builder.upload(), &options));
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

fn edited(input: &Upload, to: [f64; 2], bijective: bool, format: OutputFormat) -> Files {
    let anchors = json!({"anchors": [
        {"vertex": 0, "to": [0.0, 0.0]}, {"vertex": 2, "to": to},
    ]});
    let mut options = EditOptions {
        anchors: parse_anchors(anchors.to_string().as_bytes()).unwrap(),
        format,
        ..EditOptions::default()
    };
    options.model.bijective = bijective;
    edit_document(input, Editing::Map, &options, &Unobserved)
        .unwrap()
        .files
}

#[test]
fn edited_charts_are_spoken_of_alone_where_others_do_not_hold() {
    for format in [OutputFormat::Glb, OutputFormat::Obj] {
        for bijective in [false, true] {
            let files = edited(&half_flipped(), [0.25, 0.3], bijective, format);
            let found = verified(&files);
            assert!(found.proven.locally_injective, "{:?}", found.mark);
            let terms = found.mark.unwrap().terms;
            assert_eq!((terms.charts, terms.overlaps), (Some(vec![0]), !bijective));
            let options = MeasureOptions {
                texcoord: Some(0),
                ..MeasureOptions::default()
            };
            let all = verify_document(&upload(&files), &judged(&options)).unwrap();
            assert!(!all.proven.locally_injective);
        }
    }
}

#[test]
fn edited_maps_may_overlap_unless_they_may_not() {
    let input = Builder::square().upload();
    let files = unwrapped(&input, &Options::default());
    for bijective in [false, true] {
        let files = edited(&upload(&files), [0.9, 0.9], bijective, OutputFormat::Glb);
        let found = verified(&files);
        let mark = found.mark.as_ref().unwrap();
        assert_eq!(
            (mark.terms.overlaps, &mark.terms.charts),
            (!bijective, &None)
        );
        assert_eq!(is_promised(&found), bijective);
        assert!(found.proven.locally_injective);
        assert!(matches!(
            Document::read(&upload(&files)).unwrap().marked().unwrap(),
            Marked::Fits(_)
        ));
    }
}
