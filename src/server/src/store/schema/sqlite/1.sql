-- Version 1. Times are milliseconds since 1970 in UTC; what SQL does not look into is JSON.
CREATE TABLE job (
    id           TEXT PRIMARY KEY,             -- UUID version 7: sorts by time
    kind         TEXT NOT NULL,
    state        TEXT NOT NULL,
    options      TEXT NOT NULL,
    input        TEXT NOT NULL,
    output       TEXT NOT NULL,
    attempt      INTEGER NOT NULL,
    lost         INTEGER NOT NULL,
    cancel       INTEGER NOT NULL DEFAULT 0,   -- wished while it ran
    finish_early INTEGER NOT NULL,
    ephemeral    INTEGER NOT NULL,
    seq          INTEGER NOT NULL,
    progress     TEXT NOT NULL,
    failure      TEXT,
    created      INTEGER NOT NULL,
    started      INTEGER,
    finished     INTEGER
) STRICT, WITHOUT ROWID;

CREATE INDEX job_by_state ON job (state, id);

CREATE TABLE idempotency (
    key         TEXT PRIMARY KEY,
    fingerprint TEXT NOT NULL,
    job         TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    created     INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_by_job ON idempotency (job);

PRAGMA user_version = 1;
