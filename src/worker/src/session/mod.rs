//! The child of a live session: messages in, frames out.
//!
//! [`Course`] is the whole state between the pipes of the child: it handles messages in order and produces a frame
//! after each iteration, so the frames can be reproduced from input and messages.

mod body_hand;
mod child;
mod course;
mod frame;
mod hand;
mod message;
mod names;
mod uv_hand;

pub use child::run;
pub use course::Course;
pub use message::{Message, Reply, Wish};
