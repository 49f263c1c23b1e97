//! Files in an S3 server.

use futures_util::TryStreamExt;
use unwrapd::jobs::{Blobs, JobId};
use unwrapd::store::ObjectBlobs;

use crate::harness::s3::{S3, URL, serve_if_asked};

/// A server starts the binary of the tests with this one alone; then it is the server.
#[tokio::test]
async fn files_come_back_from_a_server_of_its_own() {
    serve_if_asked().await;
    let server = S3::start();
    let blobs = ObjectBlobs::open(URL, server.settings().into_iter()).expect("a bucket");
    let local = tempfile::tempdir().expect("a folder");
    let file = local.path().join("file");
    // Longer than what is sent at once.
    let content: Vec<u8> = (0..12_000_000_u32)
        .map(|n| (n.wrapping_mul(n) / 7) as u8)
        .collect();
    std::fs::write(&file, &content).expect("a file");
    let id = JobId::fresh();
    let (key, folder) = (format!("{id}/input/0"), format!("{id}/input"));
    blobs.put(&key, &file).await.expect("it is stored");
    assert_eq!(server.objects(), std::slice::from_ref(&key));
    assert_eq!(blobs.owners().await.expect("an answer"), [id]);
    let copy = local.path().join("copy");
    blobs.fetch(&key, &copy).await.expect("it is there");
    assert!(std::fs::read(&copy).expect("a file") == content);
    let part = blobs.read(&key, 5_000_000..5_000_007).await;
    let part: Vec<Vec<u8>> = part.expect("it is there").try_collect().await.expect("all");
    assert_eq!(part.concat(), content[5_000_000..5_000_007]);
    let second = format!("{folder}/1");
    blobs.copy(&key, &second).await.expect("it is copied");
    blobs.fetch(&second, &copy).await.expect("it is there");
    assert!(std::fs::read(&copy).expect("a file") == content);
    let missing = format!("{folder}/7");
    assert!(blobs.copy(&missing, &second).await.is_err());
    blobs.check().await.expect("it answers");
    // What begins alike is another folder.
    blobs
        .remove(&folder[..folder.len() - 1])
        .await
        .expect("none");
    assert_eq!(server.objects(), [key.clone(), second]);
    blobs.remove(&folder).await.expect("it is removed");
    assert_eq!(server.objects(), Vec::<String>::new());
    assert!(blobs.fetch(&key, &copy).await.is_err());
    // One that has not answered a moment ago.
    let unasked = ObjectBlobs::open(URL, server.settings().into_iter()).expect("a bucket");
    drop(server);
    let down = unasked.check().await.expect_err("nobody answers");
    assert!(down.is_passing(), "{down}");
}

/// It is no fault of a job: another worker may have access.
#[tokio::test]
async fn a_refused_access_may_pass() {
    let server = S3::start();
    let mut settings = server.settings();
    settings.push(("AWS_SECRET_ACCESS_KEY".to_owned(), "another".to_owned()));
    let blobs = ObjectBlobs::open(URL, settings.into_iter()).expect("a bucket");
    let local = tempfile::NamedTempFile::new().expect("a file");
    let key = format!("{}/input/0", JobId::fresh());
    let refused = [
        blobs.put(&key, local.path()).await,
        blobs.fetch(&key, local.path()).await,
        blobs.remove(&key).await,
    ];
    for refused in refused {
        let error = refused.expect_err("the key is another");
        assert!(error.is_passing(), "{error}");
    }
    assert_eq!(server.objects(), Vec::<String>::new());
}
