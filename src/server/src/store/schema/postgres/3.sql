-- Version 3: whose jobs are, and the keys of the API.
ALTER TABLE job ADD COLUMN owner TEXT NOT NULL DEFAULT '';      -- empty: the anonymous one
ALTER TABLE expired ADD COLUMN owner TEXT NOT NULL DEFAULT '';
CREATE INDEX job_by_owner ON job (owner, id);

CREATE TABLE api_key (
    id      TEXT COLLATE "C" PRIMARY KEY,
    digest  TEXT NOT NULL,                                      -- SHA-256 of the secret
    owner   TEXT NOT NULL,
    scopes  TEXT NOT NULL,
    name    TEXT NOT NULL,
    parent  TEXT COLLATE "C" REFERENCES api_key (id),           -- which signed in with it
    created BIGINT NOT NULL,
    expires BIGINT,
    revoked BIGINT,
    used    BIGINT                                              -- to the hour
);
CREATE INDEX api_key_by_parent ON api_key (parent);
