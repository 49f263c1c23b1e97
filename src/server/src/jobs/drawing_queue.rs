//! Turns and places of the pictures that are drawn in this process.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use tokio::sync::{OwnedMutexGuard, OwnedSemaphorePermit, Semaphore};

use super::job::JobId;
use super::settings::Settings;

/// What is drawn in this process.
pub(super) struct DrawingQueue {
    /// Jobs of which a picture is drawn, or waits to be. Others wait for their turn, and find it drawn.
    turns: Mutex<HashMap<JobId, Weak<tokio::sync::Mutex<()>>>>,
    /// Children that draw at the same time: on half of the cores, so that jobs keep the others.
    places: Arc<Semaphore>,
}

impl DrawingQueue {
    pub fn new(settings: &Settings) -> Self {
        Self {
            turns: Mutex::default(),
            places: Arc::new(Semaphore::new((settings.cores / 2).max(1))),
        }
    }

    /// Waits until no picture of a job is drawn.
    pub async fn turn(&self, id: JobId) -> OwnedMutexGuard<()> {
        let turn = {
            let mut turns = self.turns.lock().unwrap_or_else(PoisonError::into_inner);
            turns.retain(|_, turn| 0 < turn.strong_count());
            let known = turns.get(&id).and_then(Weak::upgrade);
            known.unwrap_or_else(|| {
                let turn = Arc::default();
                turns.insert(id, Arc::downgrade(&turn));
                turn
            })
        };
        turn.lock_owned().await
    }

    /// Waits for one of the places in which children may draw.
    pub async fn place(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.places).acquire_owned().await.ok()
    }
}
