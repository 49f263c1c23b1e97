-- Version 5: whose turn it is, and whether jobs are started at all.
CREATE TABLE turn (
    owner TEXT PRIMARY KEY,
    at    BIGINT NOT NULL                                       -- rises with every start
);
CREATE INDEX turn_by_start ON turn (at);

CREATE TABLE pause (
    id    BIGINT PRIMARY KEY,                                   -- a row: no job is started
    since BIGINT NOT NULL
);
