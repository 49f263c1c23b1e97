-- Version 12: ends of jobs that are still to be told.
ALTER TABLE job ADD COLUMN webhook TEXT;

CREATE TABLE outbox (
    id      TEXT PRIMARY KEY,
    owner   TEXT NOT NULL,
    url     TEXT NOT NULL,
    body    TEXT NOT NULL,
    attempt INTEGER NOT NULL,
    due     INTEGER NOT NULL                   -- when it is tried next
) STRICT, WITHOUT ROWID;
CREATE INDEX outbox_by_time ON outbox (due);
