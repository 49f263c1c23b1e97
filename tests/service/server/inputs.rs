//! The files that a job was made of.

use reqwest::multipart::Part;

use super::{Server, ended, form};
/// A triangle whose material file is named.
const PLATE: &str = "mtllib plate.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

#[tokio::test]
async fn inputs_are_listed_and_answered() {
    let server = Server::start();
    let second = Part::bytes(b"# none".to_vec()).file_name("plate.mtl");
    let input = form("unwrap", "{}", ("plate.obj", PLATE.into())).part("resource", second);
    let job = ended(&server, input).await;
    let inputs = job["links"]["inputs"].as_array().expect("a list");
    assert_eq!(inputs.len(), 2);
    assert_eq!(inputs[0]["name"], "plate.obj");
    let path = inputs[0]["href"].as_str().expect("a path");
    let answer = server.get(path).send().await.expect("an answer");
    assert_eq!(answer.status(), 200);
    let tag = answer.headers()["etag"].clone();
    assert_eq!(answer.bytes().await.expect("bytes"), PLATE.as_bytes());
    let part = server.get(path).header("range", "bytes=0-2").send().await;
    let part = part.expect("an answer");
    assert_eq!(part.status(), 206);
    assert_eq!(part.bytes().await.expect("bytes"), &PLATE.as_bytes()[..3]);
    let same = server.get(path).header("if-none-match", tag).send().await;
    assert_eq!(same.expect("an answer").status(), 304);
    for missing in ["2", "x"] {
        let path = format!(
            "{}/input/{missing}",
            job["links"]["self"].as_str().expect("a link")
        );
        let answer = server.get(&path).send().await.expect("an answer");
        assert_eq!(answer.status(), 404);
        let problem: serde_json::Value = answer.json().await.expect("JSON");
        assert_eq!(problem["code"], "no_such_file");
    }
}
