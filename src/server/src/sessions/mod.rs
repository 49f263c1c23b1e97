//! Bodies, pictures and UVs that are pulled live: what the sessions of the service are.
//!
//! A session is what a job of kind `deform`, `warp`, `edit_uv` or `texture_map` would do, in the hand of
//! someone who watches: handles come, move and go while the solver iterates, and every iterate is a
//! valid map that is sent as a binary frame.
//!
//! ```text
//! client ──messages──► server ──pipe──► child: Course ─► deform::Session
//! client ◄─frames───── server ◄──pipe── child
//! ```
//!
//! Each session computes in a child process of its own (`unwrapd session FOLDER`), as attempts at jobs
//! do. The server
//! relays bytes: it reads no message and makes no frame. To a client that is slower than the solver it
//! sends the latest frame and drops those before.
//!
//! The child ends when its standard input closes, so a killed server leaves no orphans. Sessions end
//! when nobody has said anything for a time; there are so many at most in all, and of one owner.

mod baked;
mod pipe;
mod registry;
mod session;

pub use baked::Baked;
pub use registry::{Opened, Sessions, Settings, Unopened};
pub use session::{End, Session};
