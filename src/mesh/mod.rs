//! Surfaces: welding, adjacency, boundary loops, defects; readers of mesh files.
