-- Version 9: what owners have used.
CREATE TABLE spent (
    owner  TEXT NOT NULL,
    day    INTEGER NOT NULL,                   -- since 1970, in UTC
    cpu_ms INTEGER NOT NULL,
    PRIMARY KEY (owner, day)
) STRICT, WITHOUT ROWID;
