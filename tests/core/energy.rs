//! Densities: derivatives, projection, minima.
