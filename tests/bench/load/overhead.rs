//! What the service adds to one job: the command does the same work and writes the same files.

use std::process::Command;
use std::time::{Duration, Instant};

use super::service::{PROGRAM, Service};
use super::{count, meshes, quantiles};

pub async fn run() {
    let count = count("PAIRS", 200);
    let service = Service::start();
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    let (mut calls, mut commands, mut added) = (Vec::new(), Vec::new(), Vec::new());
    for number in 0..count {
        let mesh = meshes::block(number);
        std::fs::write(path("mesh.obj"), &mesh).expect("a file");
        let begin = Instant::now();
        let status = Command::new(PROGRAM)
            .args(["unwrap", "--quiet"])
            .arg(path("mesh.obj"))
            .arg("-o")
            .arg(path("mesh.glb"))
            .arg("--report")
            .arg(path("report.json"))
            .arg("--layout")
            .arg(path("layout.png"))
            .arg("--heatmap")
            .arg(path("heatmap.png"))
            .status();
        assert!(status.expect("the command").success());
        let by_command = begin.elapsed();

        let begin = Instant::now();
        let (job, _) = service.submit(mesh).await;
        let itself = job["links"]["self"].as_str().expect("a link");
        let ended = service.get(&format!("{itself}?wait=60")).await;
        assert_eq!(ended["state"], "succeeded");
        let by_service = begin.elapsed();
        calls.push(by_service);
        commands.push(by_command);
        added.push(by_service.saturating_sub(by_command).max(Duration::ZERO));
    }
    println!("one job of 12 faces, from POST to its end");
    println!("  the command: {}", quantiles::of(commands));
    println!("  the service: {}", quantiles::of(calls));
    println!("  added: {}", quantiles::of(added));
}
