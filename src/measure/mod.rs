//! What a UV map is worth: distortion, seams, packing, overlaps.
