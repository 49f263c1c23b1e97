//! Drawings of UV layouts and distortion.
