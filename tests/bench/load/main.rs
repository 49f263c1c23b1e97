//! What the service bears, on loopback. Every input is different, and the result cache is refused.
//!
//! `cargo bench --bench load -- [PART …]`; without arguments all parts but `claims`:
//!
//! - `burst`: 5,000 jobs of 12 faces at once; quantiles of POST and of GET meanwhile, memory, losses.
//! - `sockets`: 1,000 WebSockets while jobs run; the delay between an end and its event.
//! - `assets`: 500 assets of 1,600 faces, beside the command under `xargs -P2`.
//! - `overhead`: what the service adds to one small job, beside the command alone.
//! - `claims`: claims and ends per second of 8 workers over SQLite, and over PostgreSQL if
//!   `DATABASE_URL` names an empty database.
//!
//! `JOBS`, `SOCKETS` and `ASSETS` in the environment set other counts.

mod assets;
mod burst;
mod claims;
mod meshes;
mod overhead;
mod quantiles;
mod service;
mod sockets;

#[tokio::main]
async fn main() {
    let arguments = std::env::args().skip(1);
    let parts: Vec<String> = arguments.filter(|a| !a.starts_with('-')).collect();
    let is_asked = |part: &str| match parts.len() {
        0 => part != "claims",
        _ => parts.iter().any(|asked| asked == part),
    };
    if is_asked("burst") {
        burst::run().await;
    }
    if is_asked("sockets") {
        sockets::run().await;
    }
    if is_asked("assets") {
        assets::run().await;
    }
    if is_asked("overhead") {
        overhead::run().await;
    }
    if is_asked("claims") {
        claims::run().await;
    }
}

/// A count that the environment may set.
fn count(name: &str, default: usize) -> usize {
    std::env::var(name).map_or(default, |value| value.parse().expect("a number"))
}
