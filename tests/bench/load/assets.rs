//! Assets of common size by the service, and by the command under `xargs`.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Instant;

use super::service::{PROGRAM, Service};
use super::{count, meshes};

const RINGS: usize = 21;

pub async fn run() {
    let count = count("ASSETS", 500);
    let mesh = |number| meshes::bumpy_sphere(number, RINGS);
    let folder = tempfile::tempdir().expect("a folder");
    let mut names = String::new();
    for number in 0..count {
        let name = format!("{number:05}.obj");
        fs::write(folder.path().join(&name), mesh(number)).expect("a file");
        names.push_str(&name);
        names.push('\n');
    }
    let list = folder.path().join("list");
    fs::write(&list, names).expect("a file");
    let begin = Instant::now();
    let extras = "--report {}.json --layout {}.layout.png --heatmap {}.heatmap.png";
    let command = format!("{PROGRAM} unwrap {{}} -o {{}}.glb --quiet --threads 1 {extras}");
    let status = Command::new("xargs")
        .args(["-a"])
        .arg(&list)
        .args(["-P2", "-I{}", "sh", "-c", &command])
        .current_dir(folder.path())
        .stdout(Stdio::null())
        .status();
    assert!(status.expect("xargs").success());
    let by_command = begin.elapsed().as_secs_f64();

    let service = Service::start();
    let begin = Instant::now();
    let jobs = service.submit_all((0..count).map(mesh), 4).await.0;
    let losses = service.losses(&jobs).await;
    let by_service = begin.elapsed().as_secs_f64();
    let an_hour = |seconds: f64| 3600.0 * count as f64 / seconds;
    println!("{count} assets of {} faces", 80 * (RINGS - 1));
    println!(
        "  xargs -P2: {by_command:.1} s, {:.0} an hour",
        an_hour(by_command)
    );
    println!(
        "  service: {by_service:.1} s, {:.0} an hour, lost {losses}",
        an_hour(by_service)
    );
    println!("  ratio {:.2}", by_command / by_service);
}
