//! The child of a live session: messages in, frames out.
//!
//! [`Course`] is all that the child does between its pipes: it takes messages in their order and makes a frame after each
//! iteration, so that whoever has both can make the frames again.

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
