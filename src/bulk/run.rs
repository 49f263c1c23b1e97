//! A run over assets: what is recorded is kept, the rest is done, several at once.

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

/// Told of every row as it comes.
pub type Seen<'a> = &'a mut (dyn FnMut(&Row, Fate) + Send);

/// Does what an order asks for; the rows are in the order of the assets. `None` if `stop` ended first:
/// then nothing is in work any more, and what was is not recorded.
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
        while running.len() < order.concurrency.max(1)
            && let Some(index) = waiting.next()
        {
            let (order, worker) = (Arc::clone(&order), Arc::clone(&worker));
            let handle = running.spawn(async move { one::asset(&order, &*worker, index).await });
            places.insert(handle.id(), index);
        }
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

/// The rows that earlier runs have recorded.
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

/// A mistake of this program that one asset brought to light.
fn broken(error: &JoinError) -> Failure {
    Failure::new("crashed", format!("{error}, which is a bug"))
}
