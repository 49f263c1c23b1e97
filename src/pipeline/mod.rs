//! From a mesh to a certified atlas and its report.
