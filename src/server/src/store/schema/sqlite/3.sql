-- Version 3: how much the files of a job take; a row to write to when somebody asks whether records can be written.
ALTER TABLE job ADD COLUMN bytes INTEGER NOT NULL DEFAULT 0;
UPDATE job SET bytes =
    (SELECT total(value ->> 'bytes') FROM json_each(input)) + (SELECT total(value ->> 'bytes') FROM json_each(output));
CREATE INDEX job_by_bytes ON job (bytes);

CREATE TABLE pulse (
    id INTEGER PRIMARY KEY,
    at INTEGER NOT NULL
) STRICT;
INSERT INTO pulse VALUES (1, 0);

PRAGMA user_version = 3;
