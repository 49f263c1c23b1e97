//! Deformation energies as functions of singular values.
