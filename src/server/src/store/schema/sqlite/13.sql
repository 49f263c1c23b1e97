-- Version 13: which store this is; files that no job is known to have; attempts that were lost with their workers.
CREATE TABLE identity (
    id    INTEGER PRIMARY KEY,                 -- 1: there is one row
    store TEXT NOT NULL                        -- the files have the same
) STRICT;

CREATE TABLE quarantine (
    job   TEXT PRIMARY KEY,                    -- whose folder it is
    bytes INTEGER NOT NULL,
    since INTEGER NOT NULL,                    -- when its files were found, without a gap until
    seen  INTEGER NOT NULL                     -- when they were last looked at
) STRICT, WITHOUT ROWID;

ALTER TABLE job ADD COLUMN interrupted INTEGER NOT NULL DEFAULT 0;
