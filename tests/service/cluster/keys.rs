//! Keys are in the database: all services have the same.

use std::process::Command;
use std::time::Duration;

use super::Cluster;
use crate::harness::program;
use crate::server::{SOON, Server, json};

/// What `unwrapd keys` prints on the database of a cluster.
fn keys(cluster: &Cluster, arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let mut command = Command::new(program());
    command.arg("keys").args(arguments);
    command.arg("--data").arg(folder.path());
    let output = command.envs(cluster.settings.iter().cloned()).output();
    let output = output.expect("it runs");
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    text.trim().to_owned()
}

/// Waits until a service answers a header in this way.
async fn becomes(api: &Server, (name, value): (&str, &str), wanted: u16) {
    let asked = async {
        loop {
            let answer = api.get("/v1/jobs").header(name, value).send().await;
            if answer.expect("an answer").status() == wanted {
                return;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
    };
    let seen = tokio::time::timeout(SOON, asked).await;
    seen.unwrap_or_else(|_| panic!("it does not become {wanted}"));
}

#[tokio::test]
async fn services_share_keys_and_who_signed_in() {
    let cluster = Cluster::start();
    let [one, other] = [cluster.api(), cluster.api()];
    becomes(&one, ("accept", "*/*"), 200).await;
    let alice = keys(&cluster, &["create", "--owner", "alice"]);
    let bearer = format!("Bearer {alice}");
    for api in [&one, &other] {
        becomes(api, ("accept", "*/*"), 401).await;
        becomes(api, ("authorization", &bearer), 200).await;
    }
    let signed = one.post("/v1/sign-in").bearer_auth(&alice).send().await;
    let signed = signed.expect("an answer");
    let cookie = signed.headers()["set-cookie"].to_str().expect("text");
    let cookie = cookie.split(';').next().unwrap_or_default();
    becomes(&other, ("cookie", cookie), 200).await;

    let job = one.post("/v1/jobs").bearer_auth(&alice);
    let job = job.body(crate::meshes::small()).send().await;
    let job = json(job.expect("an answer")).await;
    let path = job["links"]["self"].as_str().expect("a link");
    let bob = keys(&cluster, &["create", "--owner", "bob"]);
    for (key, wanted) in [(&alice, 200), (&bob, 404)] {
        let answer = other.get(path).bearer_auth(key).send().await;
        assert_eq!(answer.expect("an answer").status(), wanted);
    }

    let id = alice.split('_').nth(1).expect("an id");
    keys(&cluster, &["revoke", id]);
    for api in [&one, &other] {
        becomes(api, ("authorization", &bearer), 401).await;
        becomes(api, ("cookie", cookie), 401).await;
    }
    let listed = keys(&cluster, &["list"]);
    assert!(
        listed.contains(&format!("{id}\trevoked\talice")),
        "{listed}"
    );
}
