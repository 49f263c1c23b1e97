//! The page.

use std::process::Command;

use crate::meshes::PLATE;
use crate::server::{Server, ended, form};

/// The page as Chromium has it after its scripts ran.
fn rendered(url: &str) -> String {
    let profile = tempfile::tempdir().expect("a folder for the profile");
    let output = Command::new("chromium")
        .args([
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-background-networking",
        ])
        .arg(format!("--user-data-dir={}", profile.path().display()))
        .args(["--virtual-time-budget=5000", "--dump-dom", url])
        .output()
        .expect("Chromium runs");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[tokio::test]
async fn the_page_and_the_docs_run_their_scripts() {
    let server = Server::start();
    let url = |path: &str| server.url(path);
    let (page, docs) = (url("/"), url("/docs"));
    let dumped = tokio::task::spawn_blocking(move || (rendered(&page), rendered(&docs)));
    let (page, docs) = dumped.await.expect("a browser");
    assert!(page.contains("type=\"file\""), "{page}");
    // Listed from /openapi.json by the script.
    assert!(docs.contains("/v1/jobs/{id}/result"), "{docs}");
}

#[tokio::test]
async fn the_page_shows_jobs_of_other_kinds() {
    let server = Server::start();
    let pulled = r#"{"handles": [{"center": [0, 0], "radius": 0, "to": [0, 0]}, {"vertex": 2, "to": [2, 1]}]}"#;
    let body = form("deform", pulled, ("plate.off", PLATE.into()));
    let job = ended(&server, body).await;
    let url = server.url(&format!("/#{}", job["id"].as_str().expect("an id")));
    let page = tokio::task::spawn_blocking(move || rendered(&url)).await;
    let page = page.expect("a browser");
    for words in [
        "deform: plate.off",
        "converged",
        "plate.off",
        "trace.csv",
        "Latest jobs",
    ] {
        assert!(page.contains(words), "{words}: {page}");
    }
    assert!(!page.contains("layout.png"), "{page}");
}

#[tokio::test]
async fn the_page_shows_what_is_proven() {
    let server = Server::start();
    let job = ended(&server, form("unwrap", "{}", ("plate.off", PLATE.into()))).await;
    let url = server.url(&format!("/#{}", job["id"].as_str().expect("an id")));
    let page = tokio::task::spawn_blocking(move || rendered(&url)).await;
    let page = page.expect("a browser");
    for words in ["no faces overlap", "holds at", "seam / √area", "layout.png"] {
        assert!(page.contains(words), "{words}: {page}");
    }
}
