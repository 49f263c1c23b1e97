//! Tests that look at pages and pictures with a real browser: `tests/run` leaves them out where it cannot install one.

mod page;
mod rendering;
