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

mod limits;
pub mod options;
mod picture;
pub mod pipe;
mod progress;
mod task;
mod upload;

pub use limits::{Limits, from_json};
pub use picture::{DRAWING, Drawing, MAPS, PICTURE, Picture, Subject, frame_header, number_frame};
pub use progress::{Failure, Progress, Quality, Stage, Verdict, Warning};
pub use task::{
    Catalog, ERROR, Kind, Message, NO_SPACE, OUTCOME, Outcome, Pictures, RefusedOptions, TASK,
    Task, input_file, output_file, read_json, read_upload, write_json,
};
pub use upload::{
    Content, Format, InputFile, OutputFile, SEARCHED_BYTES, START, Upload, extension, sha256,
    without_mark,
};
