-- Version 8: whose turn it is, and whether jobs are started at all.
CREATE TABLE turn (
    owner TEXT PRIMARY KEY,
    at    INTEGER NOT NULL                     -- rises with every start
) STRICT, WITHOUT ROWID;
CREATE INDEX turn_by_start ON turn (at);

CREATE TABLE pause (
    id    INTEGER PRIMARY KEY,                 -- a row: no job is started
    since INTEGER NOT NULL
) STRICT;
