-- Version 14: pictures that were drawn after the job ended, as JSON like output.
ALTER TABLE job ADD COLUMN drawn TEXT NOT NULL DEFAULT '[]';
