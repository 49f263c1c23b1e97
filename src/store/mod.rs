//! SQLite records and blob files.
