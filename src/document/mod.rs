//! glTF and other files, read and written with everything else preserved.
