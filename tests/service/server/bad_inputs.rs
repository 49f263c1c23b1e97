//! Every input that cannot be used has a code of its own: of the job, and of the command.

use std::path::{Path, PathBuf};

use reqwest::multipart::Part;
use serde_json::Value;

use super::applications::{PROBLEM, asset, ended, form, outcome};
use crate::cli::unwrapd;
use crate::meshes::{self, PLATE, bar};
use crate::server::Server;

/// Its second square turned over the first.
const FOLDED: &str = "OFF\n6 4 0\n0 0 0\n1 0 0\n.2 .1 0\n0 1 0\n1 1 0\n.2 .9 0\n3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n";
/// A surface without tetrahedra, and in no plane.
const PYRAMID: &str =
    "OFF\n5 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n.5 .5 1\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";

/// An input that cannot be used.
struct Bad {
    kind: &'static str,
    name: &'static str,
    input: Vec<u8>,
    /// Members of the options that the command line has in a file.
    handles: String,
    /// Others, by name and value.
    options: &'static [(&'static str, &'static str)],
    code: &'static str,
}

fn bad(
    kind: &'static str,
    (name, input): (&'static str, impl Into<Vec<u8>>),
    handles: &str,
    code: &'static str,
) -> Bad {
    let (input, handles) = (input.into(), handles.to_owned());
    Bad {
        kind,
        name,
        input,
        handles,
        options: &[],
        code,
    }
}

impl Bad {
    fn with(self, options: &'static [(&'static str, &'static str)]) -> Self {
        Self { options, ..self }
    }

    /// The code that a job ends with, or is refused with.
    async fn code_of_job(&self, server: &Server) -> Value {
        let json = |text: &str| match text.parse::<f64>() {
            Err(_) if text != "true" => format!("{text:?}"),
            _ => text.to_owned(),
        };
        let others: Vec<String> = self
            .options
            .iter()
            .map(|(name, value)| format!(r#""{name}": {}"#, json(value)))
            .collect();
        let members: Vec<&str> = others
            .iter()
            .map(String::as_str)
            .chain([self.handles.as_str()])
            .filter(|m| !m.is_empty())
            .collect();
        let options = format!("{{{}}}", members.join(", "));
        let form = form(self.kind, &options, (self.name, self.input.clone()));
        let plate = Part::text(PLATE).file_name("plate.off");
        let form = if self.kind == "solve" {
            form.part("resource", plate)
        } else {
            form
        };
        let ended = ended(server, form).await;
        let problem = if ended["error"].is_object() {
            &ended["error"]
        } else {
            &ended
        };
        assert_eq!(problem["status"], 422, "{ended}");
        assert_ne!(
            problem["title"], "The input cannot be used",
            "{} is not in the table",
            self.code
        );
        problem["code"].clone()
    }

    /// The last word of what the command prints, which must be one line that ends in exit status 3.
    fn code_of_command(&self, folder: &Path) -> String {
        let path = |name: &str| -> PathBuf { folder.join(name) };
        std::fs::write(path(self.name), &self.input).expect("a file");
        std::fs::write(path("plate.off"), PLATE).expect("a file");
        std::fs::write(path("h.json"), format!("{{{}}}", self.handles)).expect("a file");
        let (command, list, output) = match self.kind {
            "deform" if self.options.iter().any(|o| o.0 == "cage") => {
                ("deform", Some("--handles"), "o.glb")
            }
            "deform" => ("deform", Some("--handles"), "o.obj"),
            "warp" => ("warp", Some("--handles"), "o.png"),
            "edit_uv" => ("edit-uv", Some("--anchors"), "o.glb"),
            "texture_map" => ("texture-map", Some("--points"), "o.glb"),
            _ => ("solve", None, "o.txt"),
        };
        let text = |path: PathBuf| path.to_string_lossy().into_owned();
        let mut arguments = vec![
            command.to_owned(),
            text(path(self.name)),
            "-o".to_owned(),
            text(path(output)),
        ];
        arguments.extend(
            list.into_iter()
                .flat_map(|list| [list.to_owned(), text(path("h.json"))]),
        );
        arguments.extend(self.options.iter().map(|(name, value)| match *value {
            "true" => format!("--{name}"),
            _ => format!("--{}={value}", name.replace('_', "-")),
        }));
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let run = unwrapd(&arguments);
        let said = String::from_utf8_lossy(&run.stderr).into_owned();
        assert_eq!(run.status.code(), Some(3), "{arguments:?}: {said}");
        let lines: Vec<&str> = said
            .lines()
            .filter(|line| line.starts_with("unwrapd: "))
            .collect();
        assert_eq!(lines.len(), 1, "{said}");
        assert!(!path(output).exists(), "{arguments:?}");
        let code = lines[0]
            .rsplit_once('(')
            .map(|(_, code)| code.trim_end_matches(')'));
        code.unwrap_or_default().to_owned()
    }
}

async fn assert_codes(server: &Server, inputs: Vec<Bad>) {
    let folder = tempfile::tempdir().expect("a folder");
    for input in inputs {
        let of_job = input.code_of_job(server).await;
        assert_eq!(of_job, input.code, "{}, {}", input.name, input.handles);
        assert_eq!(
            input.code_of_command(folder.path()),
            input.code,
            "{}, {}",
            input.name,
            input.handles
        );
    }
}

#[tokio::test]
async fn bodies_that_cannot_be_pulled_have_codes() {
    let plate = || ("plate.off", PLATE);
    let one = r#""handles": [{"vertex": 0, "to": [0, 0]}]"#;
    let two = r#""handles": [{"vertex": 2, "to": [3, 0]}, {"vertex": 2, "to": [3, 1]}]"#;
    let space = r#""handles": [{"vertex": 0, "to": [0, 0, 0]}]"#;
    let damaged: &[u8] = b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\nmany\n";
    let inputs = vec![
        bad(
            "deform",
            plate(),
            r#""handles": [{"vertex": 99, "to": [0, 0]}]"#,
            "unknown_handle",
        ),
        bad(
            "deform",
            plate(),
            r#""handles": [{"vertex": 0, "to": [NaN, 0]}]"#,
            "bad_target",
        ),
        bad(
            "deform",
            plate(),
            r#""handles": [{"vertex": 0, "to": [null, -Infinity]}]"#,
            "bad_target",
        ),
        bad(
            "deform",
            plate(),
            r#""handles": [{"vertex": 0, "to": [1, 2, 3]}]"#,
            "bad_target",
        ),
        bad(
            "deform",
            plate(),
            r#""handles": [{"at": [9, 9], "to": [0, 0]}]"#,
            "handle_outside",
        ),
        bad(
            "deform",
            plate(),
            r#""handles": [{"center": [9, 9], "radius": 1, "to": [0, 0]}]"#,
            "handle_outside",
        ),
        bad("deform", plate(), two, "contradictory_handles"),
        bad("deform", plate(), r#""handles": []"#, "no_handle"),
        bad("deform", plate(), one, "bad_parameter").with(&[("beta", "-1")]),
        bad("deform", ("folded.off", FOLDED), one, "folded_mesh"),
        bad(
            "deform",
            ("flat.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n"),
            one,
            "zero_size_element",
        ),
        bad("deform", ("pyramid.off", PYRAMID), space, "not_planar"),
        bad("deform", ("damaged.msh", damaged), space, "invalid_mesh"),
        bad(
            "deform",
            ("words.xyz", "no mesh at all"),
            space,
            "unknown_format",
        ),
        bad("deform", ("bar.tet", bar(2)), one, "bad_target"),
        bad("deform", ("bar.tet", bar(2)), space, "planar_energy").with(&[("energy", "lscm")]),
        bad("deform", ("bar.tet", bar(2)), space, "invalid_formula")
            .with(&[("energy", "(s1 - 1)^2 + (s2 - 1)^2")]),
        bad("deform", ("bar.tet", bar(2)), space, "planar_bijectivity")
            .with(&[("bijective", "true")]),
        bad(
            "deform",
            (
                "two.off",
                "OFF\n6 2 0\n0 0 0\n2 0 0\n0 2 0\n1 0.5 0\n3 0.5 0\n1 2.5 0\n3 0 1 2\n3 3 4 5\n",
            ),
            one,
            "overlapping_start",
        )
        .with(&[("bijective", "true")]),
        bad("deform", ("pyramid.off", PYRAMID), space, "vertex_of_cage").with(&[("cage", "4")]),
        bad(
            "deform",
            ("open.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>"),
            one,
            "empty_outline",
        ),
    ];
    assert_codes(&Server::start(), inputs).await;
}

#[tokio::test]
async fn problems_that_cannot_be_solved_have_codes() {
    let problem = |from: &str, to: &str| {
        assert!(PROBLEM.contains(from));
        ("p.json", PROBLEM.replace(from, to))
    };
    let inputs = vec![
        bad(
            "solve",
            problem("[0, 3, 2]", "[0, 3, 77]"),
            "",
            "unknown_handle",
        ),
        bad(
            "solve",
            problem("[1.5, 0.5]", "[NaN, 0.5]"),
            "",
            "bad_target",
        ),
        bad(
            "solve",
            problem("[0, 3, 2]", "[0, 3, 3]"),
            "",
            "contradictory_handles",
        ),
        bad(
            "solve",
            problem("[0, 1]", "[0, 0]"),
            "",
            "held_element_inverted",
        ),
        bad(
            "solve",
            problem("[0, 3, 2]", "[0, 3]"),
            "",
            "unpaired_handles",
        ),
        bad(
            "solve",
            problem("plate.off", "absent.off"),
            "",
            "missing_resource",
        ),
        bad(
            "solve",
            problem("plate.off", "plate.png"),
            "",
            "unknown_format",
        ),
        bad(
            "solve",
            problem("\"green\"", "\"blue\""),
            "",
            "invalid_formula",
        ),
        bad("solve", problem("\"green\"", "5"), "", "malformed_problem"),
    ];
    assert_codes(&Server::start(), inputs).await;
}

#[tokio::test]
async fn pictures_that_cannot_be_warped_have_codes() {
    let picture = || ("spot.png", asset("pictures/spot.png"));
    let one = r#""handles": [{"at": [300, 300], "to": [310, 300]}]"#;
    let two = r#""handles": [{"at": [300, 300], "to": [310, 300]}, {"at": [300, 300], "to": [320, 300]}]"#;
    let mut large = asset("pictures/spot.png");
    large.resize(100_000_000, 0);
    let mut cut_off = asset("pictures/spot.png");
    cut_off.truncate(1000);
    let inputs = vec![
        bad(
            "warp",
            picture(),
            r#""handles": [{"at": [-5, 0], "to": [0, 0]}]"#,
            "handle_outside",
        ),
        bad(
            "warp",
            picture(),
            r#""handles": [{"at": [5, 5], "to": [Infinity, 0]}]"#,
            "bad_target",
        ),
        bad("warp", picture(), r#""handles": []"#, "handle_count"),
        bad("warp", picture(), two, "contradictory_handles"),
        bad("warp", picture(), one, "invalid_setting").with(&[("grid", "1000")]),
        bad("warp", ("large.png", large), one, "image_too_large"),
        bad("warp", ("bomb.png", bomb()), one, "image_too_large"),
        bad("warp", ("cut_off.png", cut_off), one, "invalid_image"),
        bad("warp", ("mesh.png", PLATE), one, "unknown_format"),
    ];
    assert_codes(&Server::start(), inputs).await;
}

#[tokio::test]
async fn uvs_that_cannot_be_edited_have_codes() {
    let server = Server::start();
    let (_, _, mapped) = outcome(
        &server,
        form("unwrap", "{}", ("hills.glb", meshes::small())),
    )
    .await;
    let mapped = || ("mapped.glb", mapped.clone());
    let two = r#""anchors": [{"at": [0.5, 0.5], "to": [0.5, 0.5]}, {"at": [0.5, 0.5], "to": [0.4, 0.5]}]"#;
    let inputs = vec![
        bad(
            "edit_uv",
            mapped(),
            r#""anchors": [{"vertex": 99999, "to": [0, 0]}]"#,
            "unknown_handle",
        ),
        bad(
            "edit_uv",
            mapped(),
            r#""anchors": [{"vertex": 3, "to": [0, NaN]}]"#,
            "bad_target",
        ),
        bad("edit_uv", mapped(), r#""anchors": []"#, "handle_count"),
        bad("edit_uv", mapped(), two, "contradictory_handles"),
        bad("edit_uv", mapped(), two, "no_uvs").with(&[("texcoord", "3")]),
        bad(
            "texture_map",
            mapped(),
            r#""points": [{"vertex": 0, "to": [0.5, 0.5]}]"#,
            "anchor_on_boundary",
        ),
        bad(
            "texture_map",
            ("plate.off", PLATE),
            r#""points": [{"vertex": 0, "to": [0.5, 0.5]}]"#,
            "no_uvs",
        ),
    ];
    assert_codes(&server, inputs).await;
}

/// A small file that says it is a picture of 60000 × 60000 pixels.
fn bomb() -> Vec<u8> {
    let chunk = |kind: &[u8; 4], data: &[u8]| {
        let body = [&kind[..], data].concat();
        let length = (data.len() as u32).to_be_bytes();
        [&length[..], &body, &crc32(&body).to_be_bytes()].concat()
    };
    let side = 60_000_u32.to_be_bytes();
    let header = [&side[..], &side, &[8, 6, 0, 0, 0]].concat();
    // An empty stream of zlib.
    let data = [0x78, 0x9c, 3, 0, 0, 0, 0, 1];
    [
        b"\x89PNG\r\n\x1a\n".to_vec(),
        chunk(b"IHDR", &header),
        chunk(b"IDAT", &data),
        chunk(b"IEND", &[]),
    ]
    .concat()
}

/// The checksum of PNG's chunks.
fn crc32(bytes: &[u8]) -> u32 {
    let of_byte = |sum: u32, &byte: &u8| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| {
            (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg())
        })
    };
    !bytes.iter().fold(!0, of_byte)
}
