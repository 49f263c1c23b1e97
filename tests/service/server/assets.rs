//! What the pages load: compressed, and kept by content.

use super::Server;

/// The names in the page, each with its version.
async fn named(server: &Server) -> Vec<String> {
    let page = server.get("/").send().await.expect("an answer");
    let policy = page.headers()["content-security-policy"]
        .to_str()
        .expect("text")
        .to_owned();
    assert!(
        policy.contains("script-src 'self'") && !policy.contains("'unsafe-"),
        "{policy}"
    );
    assert_eq!(page.headers()["cache-control"], "no-cache");
    let page = page.text().await.expect("text");
    let named = page.split("assets/").skip(1);
    named
        .map(|rest| rest.split('"').next().expect("a name").to_owned())
        .collect()
}

#[tokio::test]
async fn assets_are_compressed_and_kept_by_content() {
    let server = Server::start();
    let mut compressed = 0;
    for name in named(&server).await {
        let path = format!("/assets/{name}");
        let plain = server.get(&path).send().await.expect("an answer");
        assert!(plain.headers().get("content-encoding").is_none());
        assert_eq!(
            plain.headers()["cache-control"],
            "public, max-age=31536000, immutable"
        );
        let plain = plain.bytes().await.expect("bytes");

        let packed = server
            .get(&path)
            .header("accept-encoding", "br, gzip")
            .send()
            .await;
        let packed = packed.expect("an answer");
        assert_eq!(packed.headers()["content-encoding"], "gzip");
        assert_eq!(packed.headers()["vary"], "accept-encoding");
        let tag = packed.headers()["etag"].clone();
        let size = packed.bytes().await.expect("bytes").len();
        assert!(size < plain.len(), "{name}");
        compressed += size;

        let again = server
            .get(&path)
            .header("accept-encoding", "gzip")
            .header("if-none-match", tag);
        assert_eq!(again.send().await.expect("an answer").status(), 304);
        // Another version is not kept under this address.
        let (bare, _) = name.split_once("?v=").expect("a version");
        for query in ["", "?v=0123456789abcdef"] {
            let other = server.get(&format!("/assets/{bare}{query}")).send().await;
            assert_eq!(
                other.expect("an answer").headers()["cache-control"],
                "no-cache"
            );
        }
    }
    assert!(compressed < 300_000, "the page has {compressed} bytes");
    let refused = server
        .get("/assets/page.css")
        .header("accept-encoding", "gzip;q=0");
    let refused = refused.send().await.expect("an answer");
    assert!(refused.headers().get("content-encoding").is_none());
    let missing = server
        .get("/assets/other.js")
        .send()
        .await
        .expect("an answer");
    assert_eq!(missing.status(), 404);
}
