//! Ranges, versions and the pages.

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::meshes;
use crate::server::{Server, assert_problem};

#[tokio::test]
async fn results_have_ranges_and_versions() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    let path = format!("{}/result", job["links"]["self"].as_str().expect("a link"));
    let whole = server.get(&path).send().await.expect("an answer");
    assert_eq!(
        (whole.status().as_u16(), &whole.headers()["accept-ranges"]),
        (200, &"bytes".parse().expect("text"))
    );
    let tag = whole.headers()["etag"].clone();
    let bytes = whole.bytes().await.expect("bytes");
    let size = bytes.len();

    let cases = [
        ("bytes=4-7".to_owned(), 4..8),
        (format!("bytes={}-", size - 3), size - 3..size),
        ("bytes=-5".to_owned(), size - 5..size),
        (format!("bytes=10-{}", size * 2), 10..size),
    ];
    for (range, expected) in cases {
        let part = server
            .get(&path)
            .header("range", range)
            .send()
            .await
            .expect("an answer");
        assert_eq!(part.status(), 206);
        let content_range = format!("bytes {}-{}/{size}", expected.start, expected.end - 1);
        assert_eq!(part.headers()["content-range"], content_range.as_str());
        assert_eq!(part.bytes().await.expect("bytes"), bytes[expected]);
    }
    let beyond = server
        .get(&path)
        .header("range", format!("bytes={size}-"))
        .send()
        .await;
    let beyond = beyond.expect("an answer");
    assert_eq!(
        beyond.headers()["content-range"],
        format!("bytes */{size}").as_str()
    );
    assert_problem(beyond, 416, "range_not_satisfiable").await;

    let ask = |name: &'static str, value: &str| server.get(&path).header(name, value.to_owned());
    let tag = tag.to_str().expect("text");
    let same = ask("if-none-match", tag).send().await.expect("an answer");
    assert_eq!(same.status(), 304);
    let weakened = format!("W/{tag}");
    let weakly = ask("if-none-match", &weakened).send().await;
    assert_eq!(weakly.expect("an answer").status(), 304);
    let other = ask("if-range", "\"other\"")
        .header("range", "bytes=0-3")
        .send()
        .await
        .expect("an answer");
    assert_eq!(
        (
            other.status().as_u16(),
            other.bytes().await.expect("bytes").len()
        ),
        (200, size)
    );
    let head = server
        .request("HEAD", &path)
        .send()
        .await
        .expect("an answer");
    assert_eq!(head.headers()["content-length"], size.to_string().as_str());
}

#[tokio::test]
async fn pages_load_nothing_from_elsewhere() {
    let server = Server::start();
    for path in [
        "/",
        "/docs",
        "/assets/page.css",
        "/assets/docs.css",
        "/assets/docs.js",
    ] {
        let answer = server.get(path).send().await.expect("an answer");
        assert_eq!(answer.status(), 200, "{path}");
        let policy = answer.headers()["content-security-policy"]
            .to_str()
            .expect("text")
            .to_owned();
        assert!(policy.contains("default-src 'none'") && !policy.contains("'unsafe-"));
        let text = answer.text().await.expect("text");
        let names_others = text.contains("http://") || text.contains("https://");
        // The viewer of the API names standards; the browser that opens it sees that it asks nobody.
        assert!(!names_others || path.starts_with("/assets/docs"), "{path}");
    }
    for path in ["/healthz", "/readyz"] {
        assert_eq!(
            server.get(path).send().await.expect("an answer").status(),
            200
        );
    }
    let metrics = server
        .get("/metrics")
        .send()
        .await
        .expect("an answer")
        .text()
        .await
        .expect("text");
    assert!(
        metrics.contains("unwrapd_jobs{state=\"queued\"} 0"),
        "{metrics}"
    );
}

/// The stored file of a job: its blob below this folder.
fn blob(server: &Server, job: &Value, folder: &str) -> PathBuf {
    let id = job["id"].as_str().expect("an id");
    let of_job = server.data().join("blobs").join(id);
    let mut folders = std::fs::read_dir(of_job).expect("a folder").flatten();
    let found = folders.find(|it| it.file_name().to_string_lossy().starts_with(folder));
    found.expect("a folder").path().join("0")
}

fn damage(file: &Path) {
    let mut bytes = std::fs::read(file).expect("a file");
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    // The file may have a second name in a folder of an attempt.
    std::fs::remove_file(file).expect("a file");
    std::fs::write(file, bytes).expect("a file");
}

#[tokio::test]
async fn a_damaged_result_is_never_whole() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    let job = server.ended(&job).await;
    let path = format!("{}/result", job["links"]["self"].as_str().expect("a link"));
    damage(&blob(&server, &job, "output"));
    let answer = server.get(&path).send().await.expect("an answer");
    assert_problem(answer, 500, "damaged_file").await;
}

#[tokio::test]
async fn a_damaged_input_fails_its_job() {
    let mut server = Server::with(&[("UNWRAPD_WORKERS", "0")]);
    let job = server.submit(meshes::small(), "").await;
    server.kill();
    damage(&blob(&server, &job, "input"));
    server.restart_with(&[]);
    let job = server.ended(&job).await;
    assert_eq!(job["error"]["code"], "damaged_file", "{job}");
}

/// A list shows small pictures, and asks for none twice.
#[tokio::test]
async fn thumbnails_are_small_and_kept() {
    let server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    let link = format!(
        "{}/thumbnail.png",
        job["links"]["self"].as_str().expect("a link")
    );
    let answer = server.get(&link).send().await.expect("an answer");
    assert_eq!(answer.headers()["content-type"], "image/png");
    let tag = answer.headers()["etag"].clone();
    let png = answer.bytes().await.expect("bytes");
    assert_eq!(png[16..24], [0, 0, 0, 72, 0, 0, 0, 72], "its sides");
    assert!(png.len() < 15_000, "{} bytes", png.len());
    let again = server.get(&link).header("if-none-match", tag);
    assert_eq!(again.send().await.expect("an answer").status(), 304);
}
