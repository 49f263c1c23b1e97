//! How live sessions end: by request, by silence, with the service; and that there are so many at most.

use nix::sys::signal::Signal;
use serde_json::{Value, json};

use super::applications::form;
use super::sessions::{connected, opened, sheet};
use super::{Server, assert_problem, json as read};
use crate::harness::live::{Heard, Live};
use crate::harness::{SOON, children};

/// Waits for the close of a connection: its code and its reason.
async fn closed(live: &mut Live) -> (u16, String) {
    loop {
        if let Heard::Closed(code, reason) = live.hear().await {
            return (code, reason);
        }
    }
}

/// Waits until a server has no children.
async fn childless(server: &Server) {
    let gone = async {
        while !server.children().is_empty() {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(SOON, gone).await.expect("they end");
}

#[tokio::test]
async fn sessions_are_limited_and_end_with_their_processes() {
    let server = Server::with(&[("UNWRAPD_SESSIONS", "2")]);
    let (_, off) = sheet(6);
    let upload = || form("deform", "{}", ("sheet.off", off.clone()));
    let (first, mut one) = opened(&server, upload()).await;
    let (second, mut two) = opened(&server, upload()).await;
    let answer = server.post("/v1/sessions").multipart(upload()).send().await;
    let answer = answer.expect("an answer");
    assert!(answer.headers().contains_key("retry-after"));
    assert_problem(answer, 503, "sessions_taken").await;
    let list = read(server.get("/v1/sessions").send().await.expect("an answer")).await;
    assert_eq!(list["sessions"].as_array().map(Vec::len), Some(2));
    assert_eq!((&list["limit"], server.children().len()), (&2.into(), 2));

    let path = first["links"]["self"].as_str().expect("a link");
    let answer = server
        .request("DELETE", path)
        .send()
        .await
        .expect("an answer");
    assert_eq!(answer.status(), 204);
    assert_eq!(closed(&mut one).await, (1000, "closed".to_owned()));
    let freed = async {
        while server.children().len() != 1 {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(SOON, freed).await.expect("it ends");
    let answer = server.get(path).send().await.expect("an answer");
    assert_problem(answer, 404, "session_not_found").await;
    // Its place is free a moment after its process is gone.
    let reopened = async {
        loop {
            let answer = server.post("/v1/sessions").multipart(upload()).send().await;
            let answer = answer.expect("an answer");
            if answer.status() == 201 {
                return read(answer).await;
            }
        }
    };
    let third = tokio::time::timeout(SOON, reopened).await.expect("a place");
    let mut three = connected(&server, &third).await;

    // One whose process is killed says so.
    let child = server.children()[0];
    nix::sys::signal::kill(nix::unistd::Pid::from_raw(child), Signal::SIGKILL).expect("a child");
    assert_eq!(closed(&mut two).await, (1011, "crashed".to_owned()));
    let path = second["links"]["self"].as_str().expect("a link");
    let answer = server.get(path).send().await.expect("an answer");
    assert_problem(answer, 404, "session_not_found").await;

    server.signal(Signal::SIGTERM);
    assert_eq!(closed(&mut three).await, (1001, "stopping".to_owned()));
    childless(&server).await;
}

#[tokio::test]
async fn silence_ends_a_session() {
    let server = Server::with(&[("UNWRAPD_SESSION_SECONDS", "0.5")]);
    let (_, off) = sheet(6);
    let (_, mut live) = opened(&server, form("deform", "{}", ("sheet.off", off))).await;
    assert_eq!(closed(&mut live).await, (1000, "expired".to_owned()));
    childless(&server).await;
    let scratch = server.data().join("scratch");
    let emptied = async {
        while std::fs::read_dir(&scratch).expect("a folder").count() > 0 {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(SOON, emptied)
        .await
        .expect("its folder goes");
}

#[tokio::test]
async fn a_killed_service_leaves_no_session() {
    let mut server = Server::start();
    let (_, off) = sheet(6);
    let (_, mut live) = opened(&server, form("deform", "{}", ("sheet.off", off))).await;
    let vertex = json!({ "vertex": 0, "to": [0, 0] });
    let n = live
        .say(json!({ "add": { "name": 4, "handle": vertex } }))
        .await;
    live.frame_with(n).await;
    let sessions = server.children();
    assert_eq!(sessions.len(), 1);
    server.kill();
    let gone = async {
        while sessions.iter().any(|&child| children::is_alive(child)) {
            tokio::task::yield_now().await;
        }
    };
    tokio::time::timeout(SOON, gone).await.expect("they end");
}

/// A client that says much before it reads gets every reply, and frames in their order, of which some may be dropped.
#[tokio::test]
async fn a_slow_client_gets_every_reply() {
    let server = Server::start();
    let (_, off) = sheet(80);
    let (_, mut live) = opened(&server, form("deform", "{}", ("sheet.off", off))).await;
    for (name, vertex) in [(0, 0), (1, 6560)] {
        let to = if name == 0 { [0.0, 0.0] } else { [80.0, 80.0] };
        let handle = json!({ "vertex": vertex, "to": to });
        live.say(json!({ "add": { "name": name, "handle": handle } }))
            .await;
    }
    let mut n = 0;
    for step in 0..200 {
        let to = [80.0 - 0.2 * f64::from(step), 80.0];
        n = live.say(json!({ "move": { "name": 1, "to": to } })).await;
    }
    let (mut replies, mut steps): (Vec<Value>, Vec<u32>) = (Vec::new(), Vec::new());
    loop {
        match live.hear().await {
            Heard::Frame(frame) => {
                live.judge(&frame);
                steps.push(frame.step);
                if n <= frame.message && !frame.is_moving() {
                    break;
                }
            }
            Heard::Reply(reply) => replies.push(reply),
            Heard::Closed(code, reason) => panic!("closed: {code} {reason}"),
        }
    }
    assert_eq!(replies.len() as u32, n, "no reply is dropped");
    assert!(steps.windows(2).all(|pair| pair[0] < pair[1]));
}
