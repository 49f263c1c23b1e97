-- Version 2: what is known of a result beside its files.
ALTER TABLE job ADD COLUMN verdict TEXT NOT NULL DEFAULT '{}';

PRAGMA user_version = 2;
