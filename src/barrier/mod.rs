//! Barriers that go to infinity as an element degenerates.
