-- Version 10: which store this is; files that no job is known to have; attempts that were lost with their workers.
CREATE TABLE identity (
    id    BIGINT PRIMARY KEY,                                   -- 1: there is one row
    store TEXT NOT NULL                                         -- the files have the same
);

CREATE TABLE quarantine (
    job   TEXT COLLATE "C" PRIMARY KEY,                         -- whose folder it is
    bytes BIGINT NOT NULL,
    since BIGINT NOT NULL,                                      -- when its files were found, without a gap until
    seen  BIGINT NOT NULL                                       -- when they were last looked at
);

ALTER TABLE job ADD COLUMN interrupted BIGINT NOT NULL DEFAULT 0;
