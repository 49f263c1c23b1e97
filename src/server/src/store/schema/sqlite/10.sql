-- Version 10: what clients note of their jobs.
ALTER TABLE job ADD COLUMN metadata TEXT;

CREATE TABLE label (
    digest TEXT NOT NULL,                      -- of a member of the metadata
    job    TEXT NOT NULL REFERENCES job (id) ON DELETE CASCADE,
    PRIMARY KEY (digest, job)
) STRICT, WITHOUT ROWID;
CREATE INDEX label_by_job ON label (job);
CREATE INDEX job_by_time ON job (created);
