//! The solver: descent and feasibility at every iterate.
