//! Keys: who is let in, and who sees what.

mod admission;
mod isolation;
mod pages;
mod secrets;

use std::process::Output;

use crate::cli::{assert_status, unwrapd};
use crate::server::Server;

/// A server that asks for keys from its start.
pub fn closed() -> Server {
    Server::with(&[("UNWRAPD_REQUIRE_KEYS", "1")])
}

/// Runs `unwrapd keys` on the records of a server.
pub fn keys(server: &Server, arguments: &[&str]) -> Output {
    let data = server.data().to_string_lossy().into_owned();
    let output = unwrapd(&[&["keys"], arguments, &["--data", &data]].concat());
    assert_status(&output, 0);
    output
}

/// A new key of an owner.
pub fn key(server: &Server, owner: &str, more: &[&str]) -> String {
    let output = keys(server, &[&["create", "--owner", owner], more].concat());
    let text = String::from_utf8(output.stdout).expect("text");
    assert_eq!(text.lines().count(), 1, "{text}");
    text.trim().to_owned()
}

/// The id in a key.
pub fn id(key: &str) -> &str {
    key.split('_').nth(1).expect("an id")
}
