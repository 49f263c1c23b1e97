//! What the command line says of options, in the words that were typed.

use crate::cli::{assert_status, asset, last_error, unwrapd};

fn unwrap(options: &[&str]) -> std::process::Output {
    let input = asset("Box.glb").to_string_lossy().into_owned();
    // Nothing can be written there: what is refused for its options is refused before.
    let output = if options.contains(&"obj") {
        "/proc/none.obj"
    } else {
        "/proc/none.glb"
    };
    unwrapd(&[&["unwrap", &input, "-o", output], options].concat())
}

/// Options of which one would do nothing: as typed, as a query, and its name. The service refuses the same.
pub const IDLE: &[(&[&str], &str, &str)] = &[
    (
        &["--cut", "fast", "--max-charts", "3"],
        "cut=fast&max_charts=3",
        "max_charts",
    ),
    (
        &["--cut", "disk", "--seam-weight", "2"],
        "cut=disk&seam_weight=2",
        "seam_weight",
    ),
    (
        &["--cut", "disk", "--quality", "few"],
        "cut=disk&quality=few",
        "quality",
    ),
    (
        &["--source-texcoord", "0"],
        "source_texcoord=0",
        "source_texcoord",
    ),
    (&["--bake-size", "512"], "bake_size=512", "bake_size"),
    (
        &["--preset", "lightmap", "--group-by", "mesh"],
        "preset=lightmap&group_by=mesh",
        "group_by",
    ),
    (
        &["--format", "obj", "--group-by", "mesh"],
        "format=obj&group_by=mesh",
        "group_by",
    ),
    (
        &["--format", "obj", "--texcoord", "1"],
        "format=obj&texcoord=1",
        "texcoord",
    ),
    (
        &["--format", "obj", "--overwrite"],
        "format=obj&overwrite=true",
        "overwrite",
    ),
    (
        &["--material-borders", "--group-by", "material"],
        "material_borders=true&group_by=material",
        "material_borders",
    ),
    (
        &["--barrier", "none", "--barrier-strength", "1"],
        "barrier=none&barrier_strength=1",
        "barrier_strength",
    ),
    (
        &["--barrier", "log", "--barrier-support", "2"],
        "barrier=log&barrier_support=2",
        "barrier_support",
    ),
    (
        &["--barrier", "none", "--max-charts", "2"],
        "barrier=none&max_charts=2",
        "max_charts",
    ),
];

#[test]
fn options_that_would_do_nothing_are_refused() {
    for (typed, _, name) in IDLE {
        let output = unwrap(typed);
        assert_status(&output, 2);
        let error = last_error(&output);
        let option = format!("--{}", name.replace('_', "-"));
        let is_named = error.contains(&option) && error.contains("invalid_options");
        assert!(is_named, "{error}");
    }
    // The picture belongs to the command line alone.
    assert_status(&unwrap(&["--heatmap-measure", "area"]), 2);
}

#[test]
fn other_commands_refuse_what_would_do_nothing_as_well() {
    let input = asset("Box.glb").to_string_lossy().into_owned();
    let deform = |options: &[&str]| {
        let arguments = [
            "deform",
            &input,
            "--handles",
            &input,
            "-o",
            "/proc/none.glb",
        ];
        unwrapd(&[&arguments[..], options].concat())
    };
    for (options, words) in [
        (&["--split"][..], "--split requires --cage"),
        (
            &["--cage", "4", "--triangles", "7"],
            "--triangles applies to outlines",
        ),
        (
            &["--barrier", "log", "--barrier-support", "2"],
            "--barrier-support requires --barrier inverse-spline",
        ),
        (
            &["--barrier", "none", "--beta", "2"],
            "--barrier-strength requires a --barrier",
        ),
        (
            &["--barrier", "none", "--barrier-continuation"],
            "--barrier-continuation requires a --barrier",
        ),
    ] {
        let output = deform(options);
        assert_status(&output, 2);
        assert!(
            last_error(&output).contains(words),
            "{}",
            last_error(&output)
        );
    }
    let negative = deform(&["--beta", "-1"]);
    assert_status(&negative, 3);
    assert!(
        last_error(&negative).contains("--barrier-strength must be a positive number"),
        "{}",
        last_error(&negative)
    );
}

#[test]
fn pairs_that_are_no_edges_are_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    std::fs::write(path("m.obj"), mesh).expect("a file");
    let seamed = |pairs: &str| {
        std::fs::write(path("s.json"), pairs).expect("a file");
        unwrapd(&[
            "unwrap",
            &path("m.obj"),
            "-o",
            &path("out.obj"),
            "--seams",
            &path("s.json"),
        ])
    };
    assert_status(&seamed("[[0, 2]]"), 0);
    for (pairs, words) in [
        (
            "[[0, 2], [1, 3], [0, 0]]",
            "2 of 3 vertex pairs are not joined by an edge; the first is [1, 3]",
        ),
        (
            "[[0, 9]]",
            "a pair names vertex 9, but there are only 4 vertices",
        ),
    ] {
        let output = seamed(pairs);
        assert_status(&output, 3);
        let error = last_error(&output);
        assert!(
            error.contains(words) && error.contains("invalid_seams"),
            "{error}"
        );
    }
}

#[test]
fn messages_are_about_what_was_typed() {
    for (options, words) in [
        (
            &["--seam-weight", "-1"][..],
            "--seam-weight must lie between 0 and 1000000, not -1",
        ),
        (
            &["--mips", "12"],
            "--mips 12 turns --padding 2 into 8192 texels at --resolution 1024, which allows 128",
        ),
        (
            &["--padding", "129"],
            "--padding must lie between 0 and 128, not 129",
        ),
        (
            &["--padding", "9999"],
            "--padding must lie between 0 and 128, not 9999: at --resolution 1024, an eighth of the shorter side is the most",
        ),
        (
            &["--padding", "9999", "--resolution", "4096x2048"],
            "--padding must lie between 0 and 256, not 9999: at --resolution 4096x2048",
        ),
        (
            &["--preset", "lightmap", "--padding", "40"],
            "--mips 2 turns --padding 40 into 160 texels",
        ),
        (
            &["--max-stretch", "-2"],
            "--max-stretch must lie between 1.001 and 1000000, not -2",
        ),
        (
            &["--time-budget", "-5"],
            "--time-budget must lie between 0 and 1000000, not -5",
        ),
    ] {
        let output = unwrap(options);
        assert_status(&output, 2);
        assert!(
            last_error(&output).contains(words),
            "{}",
            last_error(&output)
        );
    }
    let negative = unwrap(&["--padding", "-1"]);
    assert_status(&negative, 2);
    let error = String::from_utf8_lossy(&negative.stderr).into_owned();
    assert!(error.contains("'-1' for '--padding"), "{error}");
    assert!(
        error.contains("from 0 on; an eighth of the shorter side"),
        "{error}"
    );
    assert!(!error.contains("4294967295"), "{error}");
}

/// A tip is a texture that does: the largest is not suggested where it is too small, too.
#[test]
fn a_texture_that_is_too_small_as_well_is_no_tip() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("Box.glb").to_string_lossy().into_owned();
    let output = path("out.glb");
    let run = |options: &[&str]| unwrapd(&[&["unwrap", &input, "-o", &output], options].concat());
    for options in [
        &["--texels-per-unit", "1e9"][..],
        &["--texels-per-unit", "1e9", "--resolution", "65536"],
    ] {
        let refused = run(options);
        assert_status(&refused, 3);
        let said = last_error(&refused);
        assert!(said.contains("and so is the largest texture"), "{said}");
        assert!(!said.contains("use resolution"), "{said}");
    }
    let refused = run(&["--texels-per-unit", "20000"]);
    assert_status(&refused, 3);
    let said = last_error(&refused);
    let (_, tip) = said.split_once("use resolution ").expect("a tip");
    let resolution: String = tip.chars().take_while(char::is_ascii_digit).collect();
    let followed = ["--texels-per-unit", "20000", "--resolution", &resolution];
    assert_status(&run(&followed), 0);
}

/// The summary is in plain words, says what was written, and nothing that is not known yet.
#[test]
fn the_summary_is_plain_and_names_what_was_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("Box.glb").to_string_lossy().into_owned();
    let (output, report) = (path("out.glb"), path("r.json"));
    let run = unwrapd(&["unwrap", &input, "-o", &output, "--report", &report]);
    assert_status(&run, 0);
    let progress = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(progress.contains("pack the charts"), "{progress}");
    let said = String::from_utf8_lossy(&run.stdout).into_owned();
    assert!(said.contains("texels per unit  seams per √area"), "{said}");
    assert!(said.contains(" 340 ") && said.contains(" 3.27 "), "{said}");
    let last = said.lines().last().expect("lines");
    let files = format!("wrote {output} (2.1");
    assert!(last.starts_with(&files) && last.contains(&report), "{last}");
    // The model has no texture, so nothing is resampled.
    let run = unwrapd(&["unwrap", &input, "-o", &output, "--rebake"]);
    assert_status(&run, 0);
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(said.contains("no textures to resample"), "{said}");
    assert!(!said.contains("resample the textures"), "{said}");
}

/// No line of the help is wider than a terminal of 100 columns, and all options have one layout.
#[test]
fn help_is_wrapped() {
    for command in ["unwrap", "batch", "worker", "verify"] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_unwrapd"))
            .args([command, "-h"])
            .env("COLUMNS", "80")
            .output()
            .expect("the binary runs");
        let text = String::from_utf8(output.stdout).expect("text");
        let widest = text.lines().map(|line| line.chars().count()).max();
        assert!(widest <= Some(80), "{command}: {widest:?}");
        let options = text
            .lines()
            .filter(|line| line.trim_start().starts_with("--"));
        for line in options {
            let is_alone = !line.trim().contains("  ");
            assert!(is_alone, "{command}: {line}");
        }
    }
}

#[test]
fn help_is_in_groups_and_knows_no_child_process() {
    let said = |arguments: &[&str]| {
        let output = unwrapd(arguments);
        let text = [output.stdout, output.stderr].concat();
        String::from_utf8(text).expect("text")
    };
    let (short, long) = (said(&["unwrap", "-h"]), said(&["unwrap", "--help"]));
    let firsts = [
        "--output",
        "--cut",
        "--quality",
        "--resolution",
        "--padding",
        "--rebake",
    ];
    for text in [&short, &long] {
        let (_, text) = text.split_once("Options:").expect("options");
        let places = firsts.map(|option| text.find(&format!("{option} ")).or(text.find(option)));
        assert!(places.is_sorted(), "{text}");
        assert!(text.find("Files and messages:") > places[5]);
    }
    for heading in [
        "Where to cut:",
        "Atlas:",
        "UV sets and textures:",
        "Energy and barrier:",
        "Time:",
    ] {
        let has_heading = |text: &str| text.lines().any(|line| line == heading);
        assert!(has_heading(&long) && !has_heading(&short), "{heading}");
    }
    assert!(!short.contains("--barrier-support") && long.contains("--barrier-support"));
    for word in ["comput", "compute", "--help", "help"] {
        let text = said(&[word]);
        let typed = format!("'{word}'");
        assert!(!text.replace(&typed, "").contains("compute"), "{text}");
    }
}

#[test]
fn every_option_says_what_it_is_in_the_words_that_are_typed() {
    let commands = [
        "unwrap",
        "repack",
        "measure",
        "verify",
        "edit-uv",
        "texture-map",
        "deform",
        "solve",
        "warp",
    ];
    for command in commands {
        let output = unwrapd(&["man", command]);
        assert_status(&output, 0);
        let page = String::from_utf8(output.stdout)
            .expect("text")
            .replace("\\-", "-");
        assert!(page.contains("--threads"), "{command}: {page}");
        let silent = page
            .split(".TP\n")
            .skip(1)
            .find(|part| part.trim().lines().count() < 2);
        assert_eq!(silent, None, "{command}");
        for name in [
            "texel_weight",
            "seam_weight",
            "group_by",
            "time_budget",
            "source_texcoord",
        ] {
            assert!(!page.contains(name), "{command} names {name}");
        }
    }
}

#[test]
fn shells_and_manuals_know_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = unwrapd(&["completions", shell]);
        assert_status(&output, 0);
        let script = String::from_utf8_lossy(&output.stdout);
        assert!(
            script.contains("texture-map") && script.contains("--seam-weight") || shell == "fish"
        );
        let others = script.replace("computed", "");
        assert!(!others.contains("compute"), "{shell}");
    }
    let page = |arguments: &[&str]| {
        let output = unwrapd(&[&["man"], arguments].concat());
        assert_status(&output, 0);
        String::from_utf8(output.stdout).expect("text")
    };
    let all = page(&[]);
    assert!(all.starts_with(".ie") || all.contains(".TH unwrapd 1"));
    assert!(all.contains("texture\\-map") && !all.contains("compute"));
    let one = page(&["unwrap"]);
    assert!(
        one.contains("unwrapd\\-unwrap") || one.contains("unwrapd-unwrap"),
        "{one}"
    );
    assert!(one.contains("Vertices of each chart"), "{one}");
    assert_status(&unwrapd(&["man", "compute"]), 2);
}

#[test]
fn quiet_says_nothing_and_json_is_all_there_is() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    let input = asset("Box.glb").to_string_lossy().into_owned();
    let (output, report) = (path("out.glb"), path("r.json"));
    let quiet = unwrapd(&["unwrap", &input, "-o", &output, "-q"]);
    assert_status(&quiet, 0);
    assert!(quiet.stdout.is_empty() && quiet.stderr.is_empty());
    for (command, from, to) in [
        ("unwrap", &input, &output),
        ("repack", &output, &path("packed.glb")),
    ] {
        let run = unwrapd(&[command, from, "-o", to, "--report", &report, "--json", "-q"]);
        assert_status(&run, 0);
        assert!(run.stderr.is_empty());
        let printed: serde_json::Value = serde_json::from_slice(&run.stdout).expect("JSON");
        let written = std::fs::read(&report).expect("a report");
        let written: serde_json::Value = serde_json::from_slice(&written).expect("JSON");
        assert_eq!(printed, written);
        assert_eq!(printed["proven"]["bijective"], true);
    }
    let verified = unwrapd(&["verify", &output, "--quiet"]);
    assert_status(&verified, 0);
    assert!(verified.stdout.is_empty() && verified.stderr.is_empty());
}

/// A reader that goes away, and a disk that is full, are no bugs of the program.
#[test]
fn completions_end_with_their_reader() {
    for to in ["| head -1", "> /dev/full"] {
        let script = format!("\"$0\" completions bash {to}");
        let mut shell = std::process::Command::new("bash");
        let shell = shell.args(["-c", &script, env!("CARGO_BIN_EXE_unwrapd")]);
        let output = shell.output().expect("a shell");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!said.contains("panicked"), "{to}: {said}");
        assert_status(&output, 0);
    }
}

/// Who calls it as other programs are called is told how it is called.
#[test]
fn what_is_typed_from_habit_is_answered() {
    let output = unwrapd(&["unwrap", "Box.glb", "out.glb"]);
    assert_status(&output, 2);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("-o out.glb"), "{said}");
    let output = unwrapd(&["unwrap", "--version"]);
    assert_status(&output, 0);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(said.trim(), concat!("unwrapd ", env!("CARGO_PKG_VERSION")));
}

/// Messages about an input begin with its name, and looking at keys makes no database.
#[test]
fn messages_name_their_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    std::fs::write(folder.path().join("text.obj"), "no mesh").expect("written");
    let output = unwrapd(&["unwrap", &path("text.obj"), "-o", &path("out.glb")]);
    assert_status(&output, 3);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("text.obj: "), "{said}");
    let output = unwrapd(&["keys", "list", "--data", &path("data")]);
    assert_status(&output, 1);
    assert!(!folder.path().join("data").exists());
}
