//! Projected Newton with an exact largest step.
