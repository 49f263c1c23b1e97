-- Version 7: the trace that a job is a part of.
ALTER TABLE job ADD COLUMN trace TEXT;
