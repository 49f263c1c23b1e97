//! The page, driven as a person would: each test is a scenario of `tests/page`.

mod pulling;

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::Value;

use crate::cli::{assert_status, unwrapd};
use crate::cluster::Cluster;
use crate::meshes::{self, PLATE};
use crate::places;
use crate::server::{Server, ended, form, keys};

/// Runs a scenario at an address with arguments; what it returns.
async fn scenario(name: &str, url: String, arguments: &[String]) -> Value {
    let mut node = Command::new("node");
    node.arg(places::repository("tests/page").join("drive.mjs"))
        .args([name, &url])
        .args(arguments);
    let output = tokio::task::spawn_blocking(move || node.output().expect("node runs")).await;
    let output = output.expect("no panic");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// Runs a scenario that asks, by lines of its output, for a server that is killed and started again.
fn scenario_of_a_lost_server(name: &str, url: &str, arguments: &[String], server: &mut Server) {
    let mut node = Command::new("node")
        .arg(places::repository("tests/page").join("drive.mjs"))
        .args([name, url])
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("node runs");
    let mut answers = node.stdin.take().expect("piped");
    let lines = BufReader::new(node.stdout.take().expect("piped")).lines();
    for line in lines {
        match line.expect("text").as_str() {
            "kill" => server.kill(),
            "restart" => server.restart_in_place(),
            _ => continue,
        }
        answers.write_all(b"done").expect("it waits");
    }
    assert!(node.wait().expect("node ends").success(), "{name}");
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

fn asset(name: &str) -> String {
    text(&places::asset(name))
}

/// The address of the page with a job, unwrapped from an asset.
async fn unwrapped(server: &Server, name: &str) -> String {
    unwrapped_with(server, name, "{}").await
}

/// Unwraps a mesh so that several islands can be told apart; by default it has one.
async fn unwrapped_into_islands(server: &Server) -> String {
    unwrapped_with(server, "cat_head.obj", r#"{"seam_weight": 0.1}"#).await
}

async fn unwrapped_with(server: &Server, name: &str, options: &str) -> String {
    let mesh = std::fs::read(places::asset(name)).expect("an asset");
    let job = ended(server, form("unwrap", options, (name, mesh))).await;
    assert_eq!(job["state"], "succeeded", "{job}");
    with_job(server, &job)
}

fn with_job(server: &Server, job: &Value) -> String {
    server.url(&format!("/#job={}", id(job)))
}

fn id(job: &Value) -> &str {
    job["id"].as_str().expect("an id")
}

#[tokio::test]
async fn a_mesh_is_uploaded_watched_seen_and_downloaded() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a folder");
    let output = text(&folder.path().join("out.glb"));
    let arguments = [asset("gltf/Fox.glb"), output.clone()];
    scenario("unwrap", server.url("/"), &arguments).await;
    let verified =
        tokio::task::spawn_blocking(move || unwrapd(&["verify", &output, "--bijective"]));
    assert_status(&verified.await.expect("no panic"), 0);
}

#[tokio::test]
async fn charts_relax_in_the_uv_view() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    // It ends when the page says so, however fast it could be.
    let before = server.submit(meshes::hills(800), "").await;
    let folder = tempfile::tempdir().expect("a folder");
    let mesh = folder.path().join("hills.glb");
    std::fs::write(&mesh, meshes::hills(170)).expect("written");
    let before = before["links"]["self"].as_str().expect("a link").to_owned();
    scenario("relaxing", server.url("/"), &[text(&mesh), before]).await;
}

#[tokio::test]
async fn a_job_that_a_worker_runs_says_so() {
    let cluster = Cluster::with_lease("60");
    let service = cluster.api();
    let worker = cluster.worker();
    let job = service.submit(meshes::hills(800), "cut=disk").await;
    service.mapping(&job).await;
    // The job lasts until the page has looked, however long that takes.
    let signal = |signal| {
        for child in worker.children() {
            kill(Pid::from_raw(child), signal).expect("a child");
        }
    };
    signal(Signal::SIGSTOP);
    scenario("elsewhere", with_job(&service, &job), &[]).await;
    signal(Signal::SIGCONT);
}

#[tokio::test]
async fn both_views_show_what_is_pointed_at() {
    let server = Server::start();
    let url = unwrapped(&server, "spot.ply").await;
    scenario("pointing", url, &[]).await;
}

#[tokio::test]
async fn fills_and_seams_change_what_is_seen() {
    let server = Server::start();
    let url = unwrapped_into_islands(&server).await;
    scenario("looks", url, &[]).await;
}

#[tokio::test]
async fn what_the_table_of_viewers_promises_is_there() {
    let server = Server::start();
    let url = unwrapped(&server, "spot.ply").await;
    scenario("viewers", url, &[asset("pictures/spot.png")]).await;
}

#[tokio::test]
async fn another_uv_set_is_chosen() {
    let server = Server::start();
    let url = unwrapped(&server, "MultiUVTest.glb").await;
    scenario("sets", url, &[]).await;
}

#[tokio::test]
async fn an_address_opens_the_same_state() {
    let server = Server::start();
    let url = unwrapped(&server, "cat_head.obj").await;
    scenario("reload", url, &[]).await;
}

#[tokio::test]
async fn what_is_known_of_a_job_is_said_at_once() {
    let server = Server::start();
    let url = unwrapped(&server, "cat_head.obj").await;
    let (page, job) = url.split_once("#job=").expect("a job");
    scenario("prompt", page.to_owned(), &[job.to_owned()]).await;
}

#[tokio::test]
async fn errors_say_what_to_do() {
    let server = Server::start();
    scenario("errors", server.url("/"), &[]).await;
}

#[tokio::test]
async fn faces_without_uvs_hide_no_overlap() {
    let server = Server::start();
    scenario("unmapped", server.url("/"), &[]).await;
}

#[tokio::test]
async fn nothing_of_a_file_is_said_of_the_next() {
    let server = Server::start();
    let meshes = ["cat_head.obj", "spot.ply"].map(asset);
    scenario("in_a_row", server.url("/"), &meshes).await;
}

#[tokio::test]
async fn the_result_is_seen_as_the_input_was() {
    let server = Server::start();
    scenario("ours", server.url("/"), &[asset("cat_head.obj")]).await;
}

#[tokio::test]
async fn what_is_on_screen_is_unwrapped_as_the_person_has_set_it() {
    let server = Server::start();
    for name in ["cat_head.obj", "gltf/Fox.glb"] {
        unwrapped(&server, name).await;
    }
    let arguments = [asset("Box.glb"), "cat_head.obj".into(), "Fox.glb".into()];
    scenario("again", server.url("/"), &arguments).await;
}

#[tokio::test]
async fn work_that_takes_a_while_is_seen_and_can_be_undone() {
    let server = Server::with(&[("UNWRAPD_WORKERS", "1")]);
    // It keeps the worker busy until the page has asked for an early finish.
    let before = server.submit(meshes::hills(800), "").await;
    let before = before["links"]["self"].as_str().expect("a link").to_owned();
    let arguments = [asset("gltf/Fox.glb"), before];
    scenario("at_work", server.url("/"), &arguments).await;
}

#[tokio::test]
async fn before_and_after_are_seen_side_by_side() {
    let server = Server::start();
    let url = unwrapped(&server, "gltf/Fox.glb").await;
    scenario("beside", url, &[]).await;
}

#[tokio::test]
async fn every_pane_has_room_at_every_width() {
    let server = Server::start();
    let url = unwrapped(&server, "cat_head.obj").await;
    scenario("layouts", url, &[]).await;
}

#[tokio::test]
async fn the_dark_theme_covers_views_and_pictures() {
    let server = Server::start();
    let url = unwrapped(&server, "cat_head.obj").await;
    scenario("dark", url, &[]).await;
}

#[tokio::test]
async fn the_surface_hides_seams_behind_it() {
    let server = Server::start();
    let url = unwrapped(&server, "spot.ply").await;
    scenario("hidden_seams", url, &[]).await;
}

#[tokio::test(flavor = "multi_thread")]
async fn a_chart_on_another_is_red_while_it_is_pulled() {
    let mut server = Server::start();
    let url = unwrapped(&server, "spot.ply").await;
    tokio::task::block_in_place(|| {
        scenario_of_a_lost_server("pull_onto", &url, &[], &mut server);
    });
}

#[tokio::test]
async fn many_jobs_take_no_more_memory_than_a_few() {
    let server = Server::start();
    let mut ids = Vec::new();
    // Spot has no materials, the fox has a texture and bones.
    for name in ["spot.ply", "cat_head.obj", "gltf/Fox.glb"] {
        let url = unwrapped(&server, name).await;
        let (_, id) = url.split_once("#job=").expect("a job");
        ids.push(id.to_owned());
    }
    scenario("many", server.url("/"), &ids).await;
}

#[tokio::test]
async fn materials_of_obj_files_are_seen() {
    let server = Server::start();
    scenario("materials", server.url("/"), &[asset("pictures/spot.png")]).await;
}

#[tokio::test]
async fn textures_of_any_size_are_seen_with_their_padding() {
    let server = Server::start();
    scenario("texture", server.url("/"), &[asset("cat_head.obj")]).await;
}

#[tokio::test]
async fn what_cannot_be_unwrapped_is_pulled() {
    let server = Server::start();
    let folder = tempfile::tempdir().expect("a folder");
    let body = folder.path().join("body.tet");
    std::fs::write(&body, TETRAHEDRON).expect("a file");
    let files = [asset("pictures/spot.png"), text(&body)];
    scenario("in_hand", server.url("/"), &files).await;
}

/// One tetrahedron as plain text.
const TETRAHEDRON: &str = "4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2 3\n";

#[tokio::test]
async fn the_api_can_be_read_and_tried_out() {
    let server = Server::start();
    let said = scenario("api", server.url("/"), &[]).await;
    assert!(
        said["operations"].as_u64().is_some_and(|n| 30 < n),
        "{said}"
    );
}

#[tokio::test]
async fn nothing_on_the_pages_is_inaccessible() {
    let server = Server::start();
    let mesh = std::fs::read(places::asset("cat_head.obj")).expect("an asset");
    let made = form("unwrap", "{}", ("cat_head.obj", mesh));
    let job = ended(&server, made.text("metadata", r#"{"batch": "heads"}"#)).await;
    let said = scenario("accessible", server.url("/"), &[id(&job).to_owned()]).await;
    assert_eq!(said["checked"], 48);
}

#[tokio::test]
async fn without_webgl_there_are_pictures_and_the_report() {
    let server = Server::start();
    let url = unwrapped(&server, "cat_head.obj").await;
    scenario("without_webgl", url.clone(), &[]).await;
    scenario("lost", url, &[]).await;
}

#[tokio::test]
async fn a_path_prefix_works() {
    let server = Server::start();
    scenario("prefix", server.url("/"), &[asset("MultiUVTest.glb")]).await;
}

#[tokio::test]
async fn a_key_is_asked_for_and_kept_nowhere() {
    let server = keys::closed();
    let key = keys::key(&server, "alice", &[]);
    let arguments = [key, asset("Box.glb")];
    scenario("sign_in", server.url("/"), &arguments).await;
}

#[tokio::test]
async fn several_files_are_unwrapped_at_once() {
    let server = Server::start();
    let meshes = ["cat_head.obj", "Box.glb"].map(asset);
    scenario("jobs", server.url("/"), &meshes).await;
}

#[tokio::test]
async fn a_folder_is_a_batch_with_a_table_and_an_archive() {
    let server = Server::start();
    let given = ["cat_head.obj", "gltf/BoxInterleaved"].map(asset);
    scenario("batch", server.url("/"), &given).await;
}

#[tokio::test]
async fn jobs_are_found_by_what_is_known_of_them() {
    let server = Server::start();
    let mesh = |name: &str| std::fs::read(places::asset(name)).expect("an asset");
    let noted = form("unwrap", "{}", ("Box.glb", mesh("Box.glb")));
    let noted = noted.text("metadata", r#"{"batch":7,"asset":"chair"}"#);
    let noted = ended(&server, noted.text("accept", "max_charts=1")).await;
    ended(
        &server,
        form("measure", "{}", ("Fox.glb", mesh("gltf/Fox.glb"))),
    )
    .await;
    ended(
        &server,
        form("unwrap", "{}", ("bad.obj", b"v 0 0 0\n".to_vec())),
    )
    .await;
    scenario("filters", server.url("/"), &[id(&noted).to_owned()]).await;
}

#[tokio::test]
async fn a_whole_run_needs_no_pointer() {
    let server = Server::start();
    scenario("keyboard", server.url("/"), &[asset("spot.ply")]).await;
}

#[tokio::test]
async fn the_surface_is_turned_as_in_other_programs() {
    let server = Server::start();
    let url = unwrapped(&server, "spot.ply").await;
    scenario("navigation", url, &[]).await;
}

#[tokio::test]
async fn compressed_meshes_are_seen() {
    let server = Server::start();
    let faces = [
        ("gltf/BoxMetaDraco", 12),
        ("gltf/CesiumMilkTruck-Draco", 2856),
        ("gltf/BoxMeshopt.glb", 12),
        ("gltf/KHR_meshopt-no-fallback", 60),
    ];
    let given = faces.map(|(name, faces)| format!("{}={faces}", asset(name)));
    scenario("compressed", server.url("/"), &given).await;
}

#[tokio::test]
async fn a_picture_that_cannot_be_read_is_named() {
    let server = Server::start();
    scenario("undecodable", server.url("/"), &[]).await;
}

#[tokio::test]
async fn options_are_saved_under_names() {
    let server = Server::start();
    scenario("presets", server.url("/"), &[]).await;
}

#[tokio::test]
async fn jobs_are_named_tagged_and_sought() {
    let server = Server::start();
    let mesh = |name: &str| std::fs::read(places::asset(name)).expect("an asset");
    let noted = form("unwrap", "{}", ("cat_head.obj", mesh("cat_head.obj")));
    let noted = ended(&server, noted.text("metadata", r#"{"project": "atlas"}"#)).await;
    let other = form("unwrap", "{}", ("Fox.glb", mesh("gltf/Fox.glb")));
    let other = ended(&server, other).await;
    let ids = [&noted, &other].map(|job| id(job).to_owned());
    scenario("named", server.url("/"), &ids).await;
}

/// Two squares of one triangle pair each that overlap in a corner, and a pair of charts half a texel apart.
const WRONG: &str = "\
v 0 0 0\nv 4 0 0\nv 0 4 0\nv 10 0 0\nv 14 0 0\nv 10 4 0\nv 20 0 0\nv 24 0 0\nv 20 4 0\nv 30 0 0\nv 34 0 0\nv 30 4 0
vt 0.0625 0.0625\nvt 0.3125 0.0625\nvt 0.0625 0.3125
vt 0.09375 0.09375\nvt 0.34375 0.09375\nvt 0.09375 0.34375
vt 0.5 0.5\nvt 0.75 0.5\nvt 0.5 0.75
vt 0.5 0.49951171875\nvt 0.5 0.25\nvt 0.75 0.49951171875
f 1/1 2/2 3/3\nf 4/4 5/5 6/6\nf 7/7 8/8 9/9\nf 10/10 11/11 12/12
";

#[tokio::test]
async fn overlaps_and_near_islands_are_red() {
    let server = Server::start();
    let input = ("wrong.obj", WRONG.into());
    let job = ended(&server, form("measure", r#"{"padding": 2}"#, input)).await;
    let faces = ["0", "2", "2"].map(str::to_owned);
    scenario("problems", with_job(&server, &job), &faces).await;
}

#[tokio::test]
async fn certified_stacks_are_no_overlaps() {
    let server = Server::start();
    let stacked = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nvt .1 .1\nvt .6 .1\nvt .1 .6\n\
                   f 1/1 2/2 3/3\nf 4/1 5/2 6/3\n";
    let input = ("stacked.obj", stacked.into());
    let job = ended(&server, form("repack", "{}", input)).await;
    scenario("stacks", with_job(&server, &job), &[]).await;
}

#[tokio::test]
async fn jobs_of_every_kind_are_shown() {
    let server = Server::start();
    let handles = r#"{"handles": [{"center": [0, 0], "radius": 0, "to": [0, 0]}, {"vertex": 2, "to": [2, 1]}]}"#;
    let texcoord = r#"{"texcoord": 1}"#;
    let mut shown = Vec::new();
    for (kind, options, words) in [
        ("deform", handles, &["Deform", "trace.csv", "converged"][..]),
        ("unwrap", texcoord, &["Certified", "layout.png", "Warnings"]),
        ("repack", "{}", &["Failed", "Retry"]),
    ] {
        let job = ended(&server, form(kind, options, ("plate.off", PLATE.into()))).await;
        shown.push(
            [id(&job), "plate.off"]
                .iter()
                .chain(words)
                .copied()
                .collect::<Vec<_>>()
                .join("|"),
        );
    }
    scenario("kinds", server.url("/"), &shown).await;
}

/// Sources and bundle agree: building it again gives the same bytes.
#[test]
fn the_bundle_is_that_of_its_sources() {
    let folder = tempfile::tempdir().expect("a folder");
    let sources = places::repository("src/server/src/http/page");
    let built = Command::new("node")
        .arg(sources.join("build.mjs"))
        .arg(folder.path())
        .output()
        .expect("node runs");
    assert!(built.status.success(), "{built:?}");
    let checked = Command::new("npm")
        .args(["run", "--silent", "check"])
        .current_dir(&sources)
        .output();
    let checked = checked.expect("npm runs");
    assert!(
        checked.status.success(),
        "{}",
        String::from_utf8_lossy(&checked.stdout)
    );
    let committed = std::fs::read_dir(sources.join("dist")).expect("a bundle");
    let mut names: Vec<_> = committed
        .map(|entry| entry.expect("a file").file_name())
        .collect();
    names.sort();
    let fresh = std::fs::read_dir(folder.path()).expect("a bundle");
    assert_eq!(fresh.count(), names.len());
    for name in names {
        let read = |folder: &Path| std::fs::read(folder.join(&name)).expect("a file");
        let is_same = read(folder.path()) == read(&sources.join("dist"));
        assert!(
            is_same,
            "{}: run `npm run build` in src/server/src/http/page",
            name.display()
        );
    }
}

/// What the page computes itself has the right numbers.
#[test]
fn the_analysis_of_the_page_is_right() {
    let script = places::repository("tests/page/analysis.mjs");
    let output = Command::new("node")
        .arg(script)
        .output()
        .expect("node runs");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
}
