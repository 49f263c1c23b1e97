-- Version 6: whose jobs are, and the keys of the API.
ALTER TABLE job ADD COLUMN owner TEXT NOT NULL DEFAULT '';      -- empty: the anonymous one
ALTER TABLE expired ADD COLUMN owner TEXT NOT NULL DEFAULT '';
CREATE INDEX job_by_owner ON job (owner, id);

CREATE TABLE api_key (
    id      TEXT PRIMARY KEY,
    digest  TEXT NOT NULL,                     -- SHA-256 of the secret
    owner   TEXT NOT NULL,
    scopes  TEXT NOT NULL,
    name    TEXT NOT NULL,
    parent  TEXT REFERENCES api_key (id),      -- which signed in with it
    created INTEGER NOT NULL,
    expires INTEGER,
    revoked INTEGER,
    used    INTEGER                            -- to the hour
) STRICT, WITHOUT ROWID;
CREATE INDEX api_key_by_parent ON api_key (parent);
