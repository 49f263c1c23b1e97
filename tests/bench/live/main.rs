//! Live sessions over WebSockets on loopback.
//!
//! `cargo bench --bench live -- [PART …]`; without arguments all parts:
//!
//! - `moves`: 1,000 moves of one handle after 50 to warm up, each sent when the frame with the one before has come: milliseconds
//!   from sending a move to the complete frame that contains it, and what server and child work for it. Sheets of 5,000 and 50,000
//!   triangles, a block of 13,000 tetrahedra.
//! - `armadillo`: the same for a hand of the armadillo, 13,230 vertices in 54,985 tetrahedra, where `../shared/data` is.
//! - `large`: the same for 20 moves of a sheet of 500,000 triangles; the first comes when all is at rest.
//! - `fifty`: fifty sheets of 5,000 triangles at once for 30 seconds, what happens to one more, and what is left afterward.
//! - `drag`: three meshes, one after the other, their handles dragged at random. Every frame is judged by its bytes.
//!
//! `MOVES` and `SECONDS` in the environment set other counts than 1,000 moves, and than 600 seconds of dragging in all.

mod cases;
mod drag;
#[path = "../../harness/mod.rs"]
#[expect(dead_code, reason = "some is for the tests")]
mod harness;
#[path = "../../service/meshes.rs"]
#[expect(dead_code, reason = "some is for the tests")]
mod meshes;
mod moves;
#[path = "../../places.rs"]
#[expect(dead_code, reason = "some is for the tests")]
mod places;
mod service;

use std::time::Duration;

use cases::{armadillo, block, caged, sheet};

#[tokio::main]
async fn main() {
    let _ = rustls::crypto::ring::default_provider().install_default();
    let arguments = std::env::args().skip(1);
    let parts: Vec<String> = arguments.filter(|a| !a.starts_with('-')).collect();
    let is_asked = |part: &str| parts.is_empty() || parts.iter().any(|asked| asked == part);
    if is_asked("moves") {
        let moves = count("MOVES", 1000);
        for case in [sheet(50), sheet(158), block(13)] {
            moves::measure(&case, moves).await;
        }
    }
    if is_asked("armadillo") {
        moves::measure(&armadillo(), count("MOVES", 1000)).await;
    }
    if is_asked("large") {
        moves::measure(&sheet(500), 20).await;
    }
    if is_asked("fifty") {
        moves::fifty().await;
    }
    if is_asked("drag") {
        let time = Duration::from_secs(count("SECONDS", 600) as u64 / 3);
        for case in [sheet(50), block(13), caged()] {
            drag::drag(&case, time).await;
        }
    }
}

/// A count that the environment may set.
fn count(name: &str, default: usize) -> usize {
    std::env::var(name).map_or(default, |value| value.parse().expect("a number"))
}
