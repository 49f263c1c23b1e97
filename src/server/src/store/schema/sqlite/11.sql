-- Version 11: what results have to be.
ALTER TABLE job ADD COLUMN accept TEXT;
