//! Messages of live sessions, a line each, to a sheet in the hand; after each one a few iterations.
#![no_main]

use libfuzzer_sys::fuzz_target;
use serde_json::json;
use unwrapd::document::Upload;
use unwrapd_api::Kind;
use unwrapd::pipeline::Limits;
use unwrapd_worker::session::{LiveSession, Message};

const SHEET: &[u8] = b"OFF\n9 8 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n\
    3 0 1 4\n3 0 4 3\n3 1 2 5\n3 1 5 4\n3 3 4 7\n3 3 7 6\n3 4 5 8\n3 4 8 7\n";
const MOST_MESSAGES: usize = 16;

fuzz_target!(|text: &[u8]| {
    let upload = Upload::single("a.off", SHEET.to_vec());
    let limits = Limits {
        threads: Some(1),
        ..Limits::default()
    };
    let Ok(mut session) = LiveSession::new(Kind::Deform, &json!({}), &upload, limits) else {
        panic!("a sheet can be pulled");
    };
    for line in text.split(|&byte| byte == b'\n').take(MOST_MESSAGES) {
        let Ok(message) = serde_json::from_slice::<Message>(line) else {
            continue;
        };
        let reply = session.execute(&message);
        assert!(serde_json::to_vec(&reply).is_ok());
        for _ in 0..3 {
            session.step();
        }
        assert!(!session.frame().is_empty());
    }
});
