//! The interface between the library, the command line, the server and its child processes: plain data, no
//! computation.
//!
//! | module | contents |
//! |---|---|
//! | [`mod@options`] | options declared once, for code, JSON, schemas and the command line |
//! | [`pipe`] | records between a server and the child of a live session |
//!
//! The other items are the tasks of a child ([`Task`], [`Drawing`]), its answers ([`Message`], [`Outcome`],
//! [`Failure`]), the files and formats that both sides name ([`Upload`], [`Format`]), and the server's view of the
//! computations that it does not contain ([`Catalog`]).
#![cfg_attr(docsrs, feature(doc_cfg))]

mod catalog;
mod failure;
mod files;
mod format;
mod json;
mod kind;
mod limits;
mod map_frame;
pub mod options;
mod picture;
pub mod pipe;
mod progress;
mod task;
mod upload;
mod verdict;
mod warning;

pub use catalog::{Catalog, RefusedOptions};
pub use failure::Failure;
pub use files::{InputFile, OutputFile, sha256};
pub use format::{Content, Format, SEARCHED_BYTES, extension, without_mark};
pub use json::from_json;
pub use kind::Kind;
pub use limits::Limits;
pub use map_frame::{MAPS, frame_header, number_frame};
pub use picture::{DRAWING, Drawing, PICTURE, Picture};
pub use progress::{Progress, Stage};
pub use task::{
    ERROR, Message, NO_SPACE, OUTCOME, Outcome, Pictures, TASK, Task, input_file, output_file,
    read_json, read_upload, write_json,
};
pub use upload::{START, Upload};
pub use verdict::{Quality, Verdict};
pub use warning::Warning;
