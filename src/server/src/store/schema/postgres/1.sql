-- Version 1. Times are milliseconds since 1970 in UTC; what SQL does not look into is JSON.
CREATE TABLE job (
    id           TEXT COLLATE "C" PRIMARY KEY,  -- UUID version 7: sorts by time
    kind         TEXT NOT NULL,
    state        TEXT NOT NULL,
    options      TEXT NOT NULL,
    input        TEXT NOT NULL,
    output       TEXT NOT NULL,
    verdict      TEXT NOT NULL,
    attempt      BIGINT NOT NULL,
    token        BIGINT NOT NULL,               -- names the holder; 0: never claimed
    worker       TEXT,
    lease        BIGINT,                        -- when the worker must have beaten
    due          BIGINT NOT NULL,               -- when it may be started
    lost         BIGINT NOT NULL,
    cancel       BIGINT NOT NULL,
    finish_early BIGINT NOT NULL,
    ephemeral    BIGINT NOT NULL,
    seq          BIGINT NOT NULL,
    progress     TEXT NOT NULL,
    failure      TEXT,
    created      BIGINT NOT NULL,
    started      BIGINT,
    finished     BIGINT,
    bytes        BIGINT NOT NULL                -- of the files that are kept of it
);
CREATE INDEX job_by_state ON job (state, id);
CREATE INDEX job_by_end ON job (finished);

CREATE TABLE idempotency (
    key         TEXT PRIMARY KEY,
    fingerprint TEXT NOT NULL,
    job         TEXT COLLATE "C" NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    created     BIGINT NOT NULL
);
CREATE INDEX idempotency_by_job ON idempotency (job);

CREATE TABLE expired (
    id TEXT COLLATE "C" PRIMARY KEY,
    at BIGINT NOT NULL
);
CREATE INDEX expired_by_time ON expired (at);

CREATE TABLE pulse (
    id BIGINT PRIMARY KEY,
    at BIGINT NOT NULL
);
INSERT INTO pulse VALUES (1, 0);
