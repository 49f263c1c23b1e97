-- Version 4: who works on a job and until when; the jobs that there were. From here on, the table
-- _sqlx_migrations knows the version.
ALTER TABLE job ADD COLUMN token INTEGER NOT NULL DEFAULT 0;   -- names the holder; 0: never claimed
ALTER TABLE job ADD COLUMN worker TEXT;
ALTER TABLE job ADD COLUMN lease INTEGER;                      -- when the worker must have beaten
ALTER TABLE job ADD COLUMN due INTEGER NOT NULL DEFAULT 0;     -- when it may be started
CREATE INDEX job_by_end ON job (finished);

CREATE TABLE expired (
    id TEXT PRIMARY KEY,
    at INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX expired_by_time ON expired (at);
