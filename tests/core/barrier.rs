//! Barriers: derivatives, domain.
