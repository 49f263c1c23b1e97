//! Connections that are cut without anybody noticing.

use std::time::Duration;

use futures_util::future::join_all;
use sqlx::{Connection, PgConnection};
use tokio::time::Instant;
use unwrapd::jobs::JobStore;
use unwrapd::store::RecordStore;

use crate::contract::RULES;
use crate::harness::postgres::Postgres;
use crate::harness::proxy::{Cut, Proxy};

/// Of a process, and calls that need one at the same time.
const CONNECTIONS: &str = "8";
const CALLS: usize = 12;
/// Within which records can be used again.
const AGAIN: Duration = Duration::from_secs(30);

#[tokio::test]
async fn connections_that_went_silent_are_replaced() {
    let postgres = Postgres::start();
    let direct = postgres.database("unwrapd");
    let proxy = Proxy::to(postgres.port());
    let url = format!("postgres://unwrapd@127.0.0.1:{}/unwrapd", proxy.port());
    let store = RecordStore::open(&url, RULES).await.expect("a store");
    let calls = async || join_all((0..CALLS).map(|_| store.check())).await;
    assert!(calls().await.iter().all(Result::is_ok));
    // Every connection has a call under way when it is cut.
    let mut other = PgConnection::connect(&direct).await.expect("a connection");
    let mut locked = other.begin().await.expect("a transaction");
    let lock = sqlx::query("LOCK TABLE pulse").execute(&mut *locked);
    lock.await.expect("a lock");
    let (answers, ()) = tokio::join!(calls(), async {
        let waiting = "SELECT count(*) FROM pg_locks WHERE NOT granted";
        while postgres.psql("unwrapd", waiting).trim() != CONNECTIONS {
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
        proxy.cut(Cut::Silent);
    });
    for answer in answers {
        let error = answer.expect_err("nobody answers");
        assert!(error.is_passing(), "{error}");
    }

    locked.rollback().await.expect("it is there");
    proxy.mend();
    let begin = Instant::now();
    while store.check().await.is_err() {
        assert!(begin.elapsed() < AGAIN, "no connection gets through");
    }
}
