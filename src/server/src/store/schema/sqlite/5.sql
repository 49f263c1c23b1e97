-- Version 5: which jobs are equal, and which start first.
ALTER TABLE job ADD COLUMN digest TEXT NOT NULL DEFAULT '';      -- of input, kind and options
ALTER TABLE job ADD COLUMN priority INTEGER NOT NULL DEFAULT 0;  -- the highest starts first
CREATE INDEX job_by_digest ON job (digest);
CREATE INDEX job_by_turn ON job (state, priority DESC, id);
