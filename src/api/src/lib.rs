//! What the library, the command line and the service agree on.
//!
//! | module | contents |
//! |---|---|
//! | [`mod@options`] | options declared once, for code, JSON, schemas and the command line |

pub mod options;
