//! glTF read and written.
mod again;
mod grouping;
mod lightmap;
mod marks;
mod rebake;
mod weights;
