//! The child of a live session: messages in, frames out.
//!
//! [`LiveSession`] is the whole state between the pipes of the child: it handles messages in order and produces a frame
//! after each iteration, so the frames can be reproduced from input and messages. [`Editor`](unwrapd_deform::Editor) has
//! the editing protocol; here handles get the names of clients.

mod child;
mod editing;
mod frame;
mod live_session;

pub use child::run;
pub use editing::{Message, Reply, SessionCommand};
pub use live_session::LiveSession;
