//! Live sessions: bodies, pictures and UVs that clients edit while the solver runs.
//!
//! A session does interactively what a job of kind `deform`, `warp`, `edit_uv`, `texture_map` or `repack` does. A
//! client adds, moves and removes handles while the solver iterates. Every iterate is a valid map, which is sent as a binary frame.
//!
//! ```text
//! client ──messages──► server ──pipe──► child: LiveSession ─► deform::Session
//! client ◄─frames───── server ◄──pipe── child
//! ```
//!
//! Each session computes in a child process of its own (`unwrapd session FOLDER`), as attempts at jobs do. The server
//! relays bytes: it parses no message and builds no frame. A client that is slower than the solver gets the latest
//! frame and skips those before.
//!
//! The child exits when its standard input closes, so a killed server leaves no orphans. Sessions end after a period
//! without messages. Their number is limited, in total and per owner.

mod registry;
mod session;

pub use registry::{NewSession, Sessions, Settings, Unopened};
pub use session::Baked;
pub use session::{OpenSession, SessionEnd};
