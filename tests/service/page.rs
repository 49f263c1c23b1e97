//! The page in a browser, where one is installed.

use std::process::Command;

use crate::server::Server;

/// The page as Chromium has it after its scripts ran; `None` without Chromium.
fn rendered(url: &str) -> Option<String> {
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
        .output();
    match output {
        Ok(output) => Some(String::from_utf8_lossy(&output.stdout).into_owned()),
        Err(error) => {
            eprintln!("skipped: no chromium ({error})");
            None
        }
    }
}

#[tokio::test]
async fn the_page_and_the_docs_run_their_scripts() {
    let server = Server::start();
    let url = |path: &str| server.url(path);
    let (page, docs) = (url("/"), url("/docs"));
    let dumped = tokio::task::spawn_blocking(move || Some((rendered(&page)?, rendered(&docs)?)));
    let Some((page, docs)) = dumped.await.expect("a browser") else {
        return;
    };
    assert!(page.contains("type=\"file\""), "{page}");
    // Listed from /openapi.json by the script.
    assert!(docs.contains("/v1/jobs/{id}/result"), "{docs}");
}
