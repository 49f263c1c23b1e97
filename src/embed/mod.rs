//! A valid start for every disk, and the way from it to the optimum.
