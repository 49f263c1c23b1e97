//! A run over assets: keeps recorded ones and processes the rest concurrently.

use std::collections::HashMap;
use std::pin::pin;
use std::sync::Arc;

use tokio::task::{JoinError, JoinSet};

use super::asset::Asset;
use super::one;
use super::order::{Fate, Order};
use super::place::Place;
use super::record::Record;
use super::row::{Row, Status};
use super::worker::Worker;
use unwrapd_api::Failure;

/// Callback for every row as it is produced.
pub type Seen<'a> = &'a mut (dyn FnMut(&Row, Fate) + Send);

/// Runs an order. Returns the rows in the order of the assets, or `None` if `stop` completed first: then all work has
/// stopped, and unfinished work is not recorded.
pub async fn run<W: Worker>(
    order: Order,
    worker: W,
    seen: Seen<'_>,
    stop: impl Future<Output = ()>,
) -> Option<Vec<Row>> {
    let mut stop = pin!(stop);
    let (order, worker) = (Arc::new(order), Arc::new(worker));
    let mut rows: Vec<Option<Row>> = vec![None; order.assets.len()];
    let mut waiting = 0..order.assets.len();
    let mut running = JoinSet::new();
    let mut places = HashMap::new();
    loop {
        // Start assets while there are free slots.
        while running.len() < order.concurrency.max(1)
            && let Some(index) = waiting.next()
        {
            let (order, worker) = (Arc::clone(&order), Arc::clone(&worker));
            let handle = running.spawn(async move { one::asset(&order, &*worker, index).await });
            places.insert(handle.id(), index);
        }
        // Wait for the next asset, or for the stop.
        let ended = tokio::select! {
            ended = running.join_next_with_id() => ended,
            () = &mut stop => {
                running.shutdown().await;
                return None;
            }
        };
        let Some(ended) = ended else {
            break;
        };
        // Turn a panic into a row, and report the row.
        let (id, (row, fate)) = ended.unwrap_or_else(|error| {
            let asset = &order.assets[places[&error.id()]];
            let row = Row::new(asset, 0.0, broken(&error).into());
            (error.id(), (row, Fate::Done))
        });
        seen(&row, fate);
        rows[places[&id]] = Some(row);
    }
    Some(rows.into_iter().flatten().collect())
}

/// Returns the rows that earlier runs have recorded.
pub fn recorded(assets: &[Asset], place: &Place) -> Vec<Row> {
    let row = |asset| {
        let record = Record::load(place, asset).filter(|record| record.is_whole(place));
        record.map_or_else(
            || Row::new(asset, 0.0, Status::Missing),
            |Record { row, .. }| Row::new(asset, row.seconds, row.status),
        )
    };
    assets.iter().map(row).collect()
}

/// Returns the failure of a task that panicked, which is a bug of this program.
fn broken(error: &JoinError) -> Failure {
    Failure::new("crashed", format!("{error}, which is a bug"))
}
