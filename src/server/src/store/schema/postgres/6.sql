-- Version 6: what owners have used.
CREATE TABLE spent (
    owner  TEXT NOT NULL,
    day    BIGINT NOT NULL,                                     -- since 1970, in UTC
    cpu_ms BIGINT NOT NULL,
    PRIMARY KEY (owner, day)
);
