//! glTF read and written.
mod again;
mod grouping;
mod lightmap;
mod marks;
mod merge;
mod rebake;
mod weights;
