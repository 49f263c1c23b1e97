//! Every application as a job: its result on a real file.

use reqwest::multipart::{Form, Part};
use serde_json::Value;
use unwrapd_files::picture::Image;

use crate::meshes::{self, PLATE, bar};
use crate::places;
use crate::server::{Server, json};
use crate::textured_obj;

const DRAWING: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="60"><rect width="100" height="60"/></svg>"#;
pub const PROBLEM: &str = r#"{"mesh": "plate.off", "energy": "green", "barrier": "spline", "handles": [0, 3, 2],
    "targets": [[0, 0], [0, 1], [1.5, 0.5]]}"#;

pub fn asset(name: &str) -> Vec<u8> {
    std::fs::read(places::asset(name)).expect("an asset")
}

/// The job after its end, or the problem that it was refused with.
pub async fn ended(server: &Server, form: Form) -> Value {
    let answer = server
        .post("/v1/jobs")
        .multipart(form)
        .send()
        .await
        .expect("an answer");
    let job = json(answer).await;
    if job["links"].is_null() {
        job
    } else {
        server.ended(&job).await
    }
}

pub fn form(kind: &str, options: &str, (name, bytes): (&str, Vec<u8>)) -> Form {
    let input = Part::bytes(bytes).file_name(name.to_owned());
    Form::new()
        .text("kind", kind.to_owned())
        .text("options", options.to_owned())
        .part("mesh", input)
}

/// The files of a job that succeeded: its report, and its result.
pub async fn outcome(server: &Server, form: Form) -> (Value, String, Vec<u8>) {
    let job = ended(server, form).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    let path = job["links"]["self"].as_str().expect("a link");
    let report = server
        .get(&format!("{path}/report"))
        .send()
        .await
        .expect("an answer");
    let result = server
        .get(&format!("{path}/result"))
        .send()
        .await
        .expect("an answer");
    let media_type = result.headers()["content-type"]
        .to_str()
        .expect("text")
        .to_owned();
    let bytes = result.bytes().await.expect("bytes").to_vec();
    (json(report).await, media_type, bytes)
}

#[tokio::test]
async fn bodies_are_pulled() {
    let server = Server::start();
    let plate = Part::text(PLATE).file_name("plate.off");
    let problem = form("solve", r#"{"frames": true}"#, ("p.json", PROBLEM.into()));
    let (report, media_type, text) = outcome(&server, problem.part("resource", plate)).await;
    assert!(
        report["residual"].as_f64().is_some_and(|r| r < 1e-12),
        "{report}"
    );
    assert_eq!(media_type, "text/plain; charset=utf-8");
    assert_eq!(
        String::from_utf8_lossy(&text)
            .split_ascii_whitespace()
            .count(),
        12
    );

    let jobs = json(server.get("/v1/jobs").send().await.expect("an answer")).await;
    let files = jobs["jobs"][0]["links"]["files"].as_array().expect("files");
    // The result, the report, the trace, the start, and every iteration.
    let iterations = report["iterations"].as_u64().expect("a number");
    assert_eq!(files.len() as u64, iterations + 4, "{jobs}");
    let last = files
        .last()
        .and_then(|file| file["href"].as_str())
        .expect("a frame");
    let last = server
        .get(last)
        .send()
        .await
        .expect("an answer")
        .text()
        .await;
    assert_eq!(last.expect("text").as_bytes(), text);

    let ends = r#"{"handles": [{"center": [0, 0.5, 0.5], "radius": 0.8, "to": [0, 0.5, 0.5]},
        {"center": [6, 0.5, 0.5], "radius": 0.8, "to": [4, 3, 0.5]}]}"#;
    let plate = r#"{"handles": [{"center": [0, 30], "radius": 20, "to": [0, 30]}, {"at": [90, 30], "to": [60, 90]}],
        "triangles": 500, "bijective": true, "bias": true, "barrier_continuation": true}"#;
    let everything =
        r#"{"handles": [{"center": [0, 0, 0], "radius": 1e3, "to": [1, 2, 3]}], "cage": 6}"#;
    let cases: [(&str, &str, Vec<u8>, &str); 3] = [
        (
            ends,
            "bar.tet",
            bar(6).into_bytes(),
            "application/octet-stream",
        ),
        (plate, "plate.svg", DRAWING.into(), "model/obj"),
        (
            everything,
            "surfaces.glb",
            asset("MultiUVTest.glb"),
            "model/gltf-binary",
        ),
    ];
    for (options, name, bytes, expected) in cases {
        let (report, media_type, result) =
            outcome(&server, form("deform", options, (name, bytes))).await;
        assert_eq!(
            (&report["inverted"], &report["status"]),
            (&0.into(), &"converged".into()),
            "{name}: {report}"
        );
        assert!(
            report["smallest_ever"].as_f64().is_some_and(|s| s > 0.0),
            "{report}"
        );
        assert_eq!(media_type, expected);
        assert!(!result.is_empty());
        assert_eq!(
            report["crossings_after"].is_object(),
            name == "surfaces.glb",
            "{report}"
        );
        assert_eq!(
            report["crossings"] == 0,
            name != "bar.tet" && name != "surfaces.glb"
        );
        assert_eq!(
            report["energy_without_barrier"].is_number(),
            name == "plate.svg",
            "{report}"
        );
    }
}

#[tokio::test]
async fn pictures_are_warped_and_uvs_are_edited() {
    let server = Server::start();
    let pulled = r#"{"handles": [{"at": [300, 300], "to": [500, 400]}, {"at": [900, 400], "to": [800, 200]}], "fix_border": true}"#;
    let png = asset("pictures/spot.png");
    let webp = Image::decode(&png).expect("a picture").webp();
    let webp = webp.expect("a WebP file");
    for input in [("spot.png", png), ("spot.webp", webp)] {
        let picture = form("warp", pulled, input);
        let (report, media_type, png) = outcome(&server, picture).await;
        assert_eq!(
            (&report["bijective"], &report["certified"]),
            (&true.into(), &true.into()),
            "{report}"
        );
        assert_eq!(
            (media_type.as_str(), &png[..4]),
            ("image/png", &b"\x89PNG"[..])
        );
    }

    let (_, _, mapped) = outcome(
        &server,
        form("unwrap", "{}", ("hills.glb", meshes::small())),
    )
    .await;
    let (at, to) = ("[0.5, 0.5]", "[0.52, 0.49]");
    for (kind, list) in [("edit_uv", "anchors"), ("texture_map", "points")] {
        let options = format!(
            r#"{{"{list}": [{{"at": {at}, "to": {to}}}], "boundary": "free", "bijective": true}}"#
        );
        let edit = form(kind, &options, ("mapped.glb", mapped.clone()));
        let (report, media_type, glb) = outcome(&server, edit).await;
        // The chart is a map; whether it comes upon another is judged, too.
        assert_eq!(report["charts"][0]["bijective"], true, "{report}");
        assert_eq!(report["proven"]["locally_injective"], true, "{report}");
        let lacking = report["lacking"].as_array().expect("a list");
        let is_overlapping = lacking.contains(&"triangles overlapping".into());
        assert_eq!(lacking.len(), usize::from(is_overlapping), "{report}");
        assert_eq!(
            (&report["certified"], &report["bijective"]),
            (&(!is_overlapping).into(), &(!is_overlapping).into()),
            "{report}"
        );
        assert_eq!(media_type, "model/gltf-binary");
        assert_ne!(glb, mapped);
    }
    let bounded = form(
        "unwrap",
        r#"{"max_distortion": 4.3, "max_stretch": 1.4}"#,
        ("hills.glb", meshes::small()),
    );
    let (report, _, _) = outcome(&server, bounded).await;
    let bound = &report["groups"][0]["atlas"]["bound"];
    assert_eq!(bound["max_distortion"], 4.3, "{report}");
    assert_eq!(bound["kept"], true, "{report}");
    let repack = form(
        "repack",
        r#"{"padding": 8}"#,
        ("mapped.glb", mapped.clone()),
    );
    let (report, _, glb) = outcome(&server, repack).await;
    assert_eq!(report["proven"]["padding"]["asked_texels"], 8, "{report}");
    assert_eq!(report["proven"]["padding"]["kept"], true, "{report}");
    assert_ne!(glb, mapped);
}

#[tokio::test]
async fn islands_stay_where_they_are_put() {
    let server = Server::start();
    let unwrap = form("unwrap", "{}", ("hills.glb", meshes::small()));
    let (_, _, mapped) = outcome(&server, unwrap).await;
    let around = |islands: &str| {
        let options = format!(r#"{{"islands": {islands}}}"#);
        form("repack", &options, ("mapped.glb", mapped.clone()))
    };
    let put = r#"[{"face": 0, "turn": 90, "scale": 0.5}]"#;
    let (report, _, glb) = outcome(&server, around(put)).await;
    assert_eq!(report["certified"], true, "{report}");
    assert_ne!(glb, mapped);
    let job = ended(&server, around(r#"[{"face": 0, "move": [3, 0]}]"#)).await;
    assert_eq!(job["error"]["code"], "island_off_page", "{job}");
    assert_eq!(job["error"]["status"], 422, "{job}");
    let problem = ended(&server, around(r#"[{"face": 0, "scale": -1}]"#)).await;
    assert_eq!(problem["code"], "invalid_options", "{problem}");
    assert_eq!(problem["status"], 400, "{problem}");
}

#[tokio::test]
async fn rules_for_islands_hold_and_their_faults_are_named() {
    let server = Server::start();
    let triangles = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvt .125 .125\nvt .375 .125\n\
                     vt .125 .375\nvt .625 .625\nvt .875 .625\nvt .625 .875\nusemtl a\nf 1/1 2/2 3/3\nusemtl b\n\
                     f 4/4 5/5 6/6\n";
    let by = |rules: &str| {
        let options = format!(r#"{{"control": {rules}, "format": "obj"}}"#);
        form(
            "repack",
            &options,
            ("in.obj", triangles.as_bytes().to_vec()),
        )
    };
    let (report, _, obj) =
        outcome(&server, by(r#"["material=a: lock", "all: density 150"]"#)).await;
    assert_eq!(report["certified"], true, "{report}");
    let rules = &report["groups"][0]["rules"];
    assert_eq!(rules[0]["islands"], 1, "{rules}");
    assert_eq!(
        rules[1]["changed"].as_array().map(Vec::len),
        Some(1),
        "{rules}"
    );
    assert_eq!(
        report["options"]["control"][0], "material=a: lock",
        "{report}"
    );
    assert!(String::from_utf8_lossy(&obj).contains("vt 0.125 0.125"));
    for (rules, code, status) in [
        (r#"["color=00ff00: lock"]"#, "selects_nothing", 422),
        (
            r#"["material=a: group", "all: group"]"#,
            "island_in_two_groups",
            422,
        ),
        (r#"["all: density 5000"]"#, "texture_too_small", 422),
    ] {
        let job = ended(&server, by(rules)).await;
        assert_eq!(job["error"]["code"], code, "{job}");
        assert_eq!(job["error"]["status"], status, "{job}");
    }
    let problem = ended(&server, by(r#"["a: lock"]"#)).await;
    assert_eq!(problem["code"], "invalid_options", "{problem}");
}

#[tokio::test]
async fn a_body_stops_early_with_a_valid_map() {
    let server = Server::start();
    let swung = r#"{"handles": [{"center": [0, 0.5, 0.5], "radius": 0.8, "to": [0, 0.5, 0.5]},
        {"center": [3000, 0.5, 0.5], "radius": 0.8, "to": [-900, 1500, 400]}]}"#;
    let job = form("deform", swung, ("bar.tet", bar(3000).into_bytes()));
    let job = json(
        server
            .post("/v1/jobs")
            .multipart(job)
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    let event = server.mapping(&job).await;
    assert_eq!(event["stage"], "deform", "{event}");
    assert!(
        event["smallest"].as_f64().is_some_and(|s| s > 0.0),
        "{event}"
    );
    let path = job["links"]["self"].as_str().expect("a link");
    let answer = server
        .post(&format!("{path}/finish"))
        .send()
        .await
        .expect("an answer");
    assert_eq!(answer.status(), 202);
    assert_eq!(server.ended(&job).await["state"], "succeeded");
    let report = json(
        server
            .get(&format!("{path}/report"))
            .send()
            .await
            .expect("an answer"),
    )
    .await;
    assert_eq!(
        (&report["status"], &report["inverted"]),
        (&"stopped".into(), &0.into()),
        "{report}"
    );

    let at_once = swung.replace("}]}", "}], \"time_budget\": 0}");
    let (report, _, _) = outcome(
        &server,
        form("deform", &at_once, ("bar.tet", bar(3000).into_bytes())),
    )
    .await;
    assert_eq!(
        (&report["status"], &report["iterations"]),
        (&"stopped".into(), &0.into()),
        "{report}"
    );
}

mod shared {
    use super::{Part, Server, Value, form, outcome, places};

    /// Real problems in the plane and in space.
    #[tokio::test]
    #[ignore = "needs ../shared"]
    async fn problems_are_solved() {
        let problems = places::shared("reference/problems");
        let server = Server::start();
        for name in [
            "woody-lo_pt_bend_arap_spline.json",
            "bar_c_bend_arap_spline.json",
        ] {
            let problem = std::fs::read(problems.join(name)).expect("a problem");
            let parsed: Value = serde_json::from_slice(&problem).expect("JSON");
            let mut request = form("solve", "{}", (name, problem));
            for name in ["mesh", "initial"]
                .into_iter()
                .filter_map(|key| parsed[key].as_str())
            {
                let bytes = std::fs::read(problems.join(name)).expect("what the problem names");
                request = request.part("resource", Part::bytes(bytes).file_name(name.to_owned()));
            }
            let (report, _, _) = outcome(&server, request).await;
            assert_eq!(
                (&report["status"], &report["inverted"]),
                (&"converged".into(), &0.into()),
                "{name}: {report}"
            );
        }
    }
}

/// The material file and the pictures of an OBJ file come as resources, and the report says what cannot be carried.
#[tokio::test]
async fn an_obj_comes_with_its_materials() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a folder");
    let obj = textured_obj::write(folder.path());
    let mut form = form(
        "unwrap",
        "{}",
        ("house.obj", std::fs::read(obj).expect("a file")),
    );
    for path in ["house.mtl", "pictures/wood grain.png", "pictures/lid.jpg"] {
        let bytes = std::fs::read(folder.path().join(path)).expect("a file");
        // Browsers leave the folders out.
        let name = path.rsplit('/').next().unwrap_or(path).to_owned();
        form = form.part("resource", Part::bytes(bytes).file_name(name));
    }
    let (report, _, glb) = outcome(&server, form).await;
    let warnings = report["warnings"].as_array().expect("a list");
    let codes: Vec<&Value> = warnings.iter().map(|warning| &warning["code"]).collect();
    assert_eq!(
        codes,
        ["material_statements_dropped", "uvs_beside_set_0"],
        "{report}"
    );
    let text = String::from_utf8_lossy(&glb);
    assert!(text.contains("image/png") && text.contains("image/jpeg"));
}

/// A square of 4 × 4 cells whose middle vertex lies outside, as OFF.
fn folded(middle: [f64; 2]) -> Vec<u8> {
    let place = |v: u32| match v {
        12 => middle,
        _ => [f64::from(v % 5), f64::from(v / 5)],
    };
    let vertices = (0..25).map(|v| {
        let [x, y] = place(v);
        format!("{x} {y} 0")
    });
    let squares = (0..16).map(|s| s / 4 * 5 + s % 4);
    let faces = squares.map(|a| {
        let [b, c, d] = [a + 1, a + 6, a + 5];
        format!("3 {a} {b} {c}\n3 {a} {c} {d}")
    });
    let lines: Vec<String> = vertices.chain(faces).collect();
    format!("OFF\n25 32 0\n{}\n", lines.join("\n")).into_bytes()
}

#[tokio::test]
async fn folded_meshes_are_untangled() {
    let server = Server::start();
    let mesh = || ("folded.off", folded([3.6, 3.4]));
    let (report, media_type, result) = outcome(&server, form("untangle", "{}", mesh())).await;
    assert_eq!(report["elements"], 32, "{report}");
    assert!(report["inverted_before"].as_u64() > Some(0), "{report}");
    assert!(report["moved"].as_u64() > Some(0), "{report}");
    assert!(report["smallest"].as_f64() > Some(0.0), "{report}");
    assert!(result.starts_with(b"OFF"), "{media_type}");
    // Rest shapes come in a part of their own.
    let rest = Part::bytes(folded([2.0, 2.0])).file_name("rest.off");
    let given = form(
        "untangle",
        r#"{"rest_mesh": "rest.off", "format": "obj"}"#,
        mesh(),
    );
    let (report, _, _) = outcome(&server, given.part("resource", rest)).await;
    assert!(report["inverted_before"].as_u64() > Some(0), "{report}");
    // What cannot be is named.
    let missing = form("untangle", r#"{"rest_mesh": "rest.off"}"#, mesh());
    let job = ended(&server, missing).await;
    assert_eq!(job["error"]["code"], "missing_resource", "{job}");
    let late = form("untangle", r#"{"time_budget": 0}"#, mesh());
    let job = ended(&server, late).await;
    assert_eq!(job["error"]["code"], "ended_early", "{job}");
    let unknown = form("untangle", r#"{"rest": "none"}"#, mesh());
    assert_eq!(ended(&server, unknown).await["code"], "invalid_options");
    let surface = form("untangle", "{}", ("surface.glb", meshes::small()));
    let job = ended(&server, surface).await;
    let code = [&job["code"], &job["error"]["code"]];
    assert!(code.contains(&&"unknown_format".into()), "{job}");
}

/// An OBJ of two materials side by side, each a row of 4 cells; the vertices of the right end are red.
pub fn two_materials() -> Vec<u8> {
    let vertices = (0..27).map(|v| {
        let (i, j) = (v % 9, v / 9);
        let color = if i == 8 { "1 0 0" } else { "1 1 1" };
        format!("v {i} {j} 0 {color}")
    });
    let part = |name: &str, first: u32| {
        let squares = (0..8).map(|s| s / 4 * 9 + s % 4 + first);
        let faces = squares.map(|a| {
            let [b, c, d] = [a + 1, a + 10, a + 9];
            format!("f {a} {b} {c}\nf {a} {c} {d}")
        });
        let faces: Vec<String> = faces.collect();
        format!("o {name}side\nusemtl {name}\n{}", faces.join("\n"))
    };
    let parts = [part("Left", 1), part("Right", 5)];
    let lines: Vec<String> = vertices.chain(parts).collect();
    format!("{}\n", lines.join("\n")).into_bytes()
}

#[tokio::test]
async fn handles_select_by_material_object_and_color() {
    let server = Server::start();
    let deformed = async |select: &str| {
        let options = format!(
            r#"{{"handles": [{{"select": "{select}", "by": [0.5, 0.25]}}, {{"vertex": 9, "to": [0, 1]}}], "format": "txt"}}"#
        );
        let job = form("deform", &options, ("two.obj", two_materials()));
        let (_, _, result) = outcome(&server, job).await;
        let text = String::from_utf8(result).expect("text");
        let numbers = text
            .split_whitespace()
            .map(|x| x.parse::<f64>().expect("a number"));
        let numbers: Vec<f64> = numbers.collect();
        // The columns that moved by the offset.
        let moved = (0..27).filter(|v| {
            let [x, y] = [f64::from(v % 9), f64::from(v / 9)];
            let at = &numbers[2 * *v as usize..];
            (at[0] - x - 0.5).hypot(at[1] - y - 0.25) < 1e-9
        });
        let columns: std::collections::BTreeSet<u32> = moved.map(|v| v % 9).collect();
        columns.into_iter().collect::<Vec<_>>()
    };
    assert_eq!(deformed("material=Right").await, [4, 5, 6, 7, 8]);
    assert_eq!(deformed("object=Rightside").await, [4, 5, 6, 7, 8]);
    assert_eq!(deformed("color=ff0000").await, [8]);
    for (select, code) in [
        ("material=Glass", "unknown_material"),
        ("colour=ff0000", "malformed_handles"),
        ("color=00ff00", "handle_outside"),
    ] {
        let options = format!(r#"{{"handles": [{{"select": "{select}", "by": [1, 1]}}]}}"#);
        let job = ended(
            &server,
            form("deform", &options, ("two.obj", two_materials())),
        )
        .await;
        assert_eq!(job["error"]["code"], code, "{job}");
    }
}
