//! A service with sessions, and what they cost.

use std::time::{Duration, Instant};

use reqwest::Client;
use reqwest::multipart::{Form, Part};
use serde_json::{Value, json};

use crate::cases::Case;
use crate::harness::live::{Frame, Heard, Live};
use crate::harness::process::{Process, Role};

/// A service with so many sessions at most, and a client of it.
pub struct Service {
    pub process: Process,
    pub client: Client,
}

/// A session and a connection to it.
pub struct Opened {
    pub path: String,
    pub live: Live,
}

impl Service {
    pub fn start(most: usize) -> Self {
        let data = tempfile::tempdir().expect("a folder");
        let settings = [
            ("UNWRAPD_SESSIONS", most.to_string()),
            ("UNWRAPD_LOG", "error".to_owned()),
        ];
        let settings = settings.map(|(name, value)| (name.to_owned(), value));
        Self {
            process: Process::start(Role::Serve, data, &settings),
            client: Client::new(),
        }
    }

    pub async fn post(&self, case: &Case) -> reqwest::Response {
        let (name, bytes) = case.file.clone();
        let form = Form::new()
            .text("options", case.options.to_string())
            .part("mesh", Part::bytes(bytes).file_name(name));
        let url = format!("http://{}/v1/sessions?kind=deform", self.process.address());
        let answer = self.client.post(url).multipart(form).send().await;
        answer.expect("an answer")
    }

    /// Opens a session with both handles and waits until it is at rest.
    pub async fn open(&self, case: &Case) -> Opened {
        let answer = self.post(case).await;
        let session: Value = answer.json().await.expect("JSON");
        let link = |name: &str| session["links"][name].as_str().expect("a link").to_owned();
        let url = format!("ws://{}{}", self.process.address(), link("live"));
        let mut live = Live::connect(&url).await;
        for (name, center) in [(0, &case.held), (1, &case.dragged)] {
            let add = json!({ "name": name, "handle": case.disc(center) });
            let n = live.say(json!({ "add": add })).await;
            until(&mut live, n).await;
        }
        let path = link("self");
        Opened { path, live }
    }

    pub async fn close(&self, session: &Opened) {
        let url = format!("http://{}{}", self.process.address(), session.path);
        let answer = self.client.delete(url).send().await.expect("an answer");
        assert_eq!(answer.status(), 204);
        while !self.process.children().is_empty() {
            tokio::time::sleep(Duration::from_millis(10)).await;
        }
    }

    /// Seconds that the server and its children have worked.
    pub fn worked(&self) -> (f64, f64) {
        let children = self.process.children().into_iter();
        (
            worked(self.process.id()),
            children.map(|child| worked(child as u32)).sum(),
        )
    }

    /// Memory of the children in MiB.
    pub fn resident(&self) -> u64 {
        self.process.children().into_iter().map(resident).sum()
    }
}

/// Processor seconds of a process.
fn worked(process: u32) -> f64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    let fields = text.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks = fields.split_whitespace().skip(11).take(2);
    ticks
        .filter_map(|field| field.parse::<f64>().ok())
        .sum::<f64>()
        / 100.0
}

fn resident(process: i32) -> u64 {
    let text = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = text.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kib.unwrap_or(0) >> 10
}

/// The first frame that contains a message.
pub async fn until(live: &mut Live, n: u32) -> Frame {
    loop {
        match live.hear().await {
            Heard::Frame(frame) if n <= frame.message => {
                assert_eq!(frame.flips, 0);
                return frame;
            }
            Heard::Closed(code, reason) => panic!("closed: {code} {reason}"),
            _ => {}
        }
    }
}

/// Milliseconds from sending a move to the frame that contains it.
pub async fn moved(live: &mut Live, to: &[f64]) -> f64 {
    let begin = Instant::now();
    let n = live.say(json!({ "move": { "name": 1, "to": to } })).await;
    until(live, n).await;
    1e3 * begin.elapsed().as_secs_f64()
}
