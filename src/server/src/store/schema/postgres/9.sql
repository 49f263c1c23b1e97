-- Version 9: ends of jobs that are still to be told.
ALTER TABLE job ADD COLUMN webhook TEXT;

CREATE TABLE outbox (
    id      TEXT COLLATE "C" PRIMARY KEY,
    owner   TEXT NOT NULL,
    url     TEXT NOT NULL,
    body    TEXT NOT NULL,
    attempt BIGINT NOT NULL,
    due     BIGINT NOT NULL                                     -- when it is tried next
);
CREATE INDEX outbox_by_time ON outbox (due);
