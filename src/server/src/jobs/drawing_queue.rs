//! Scheduling of picture drawing in this process.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError, Weak};

use tokio::sync::{OwnedMutexGuard, OwnedSemaphorePermit, Semaphore};

use super::job::JobId;
use super::settings::Settings;

/// Limits drawing to one picture per job, and to a number of children at a time.
pub(super) struct DrawingQueue {
    /// Locks of jobs with a picture being drawn or waiting. Later requests wait, then find it drawn.
    turns: Mutex<HashMap<JobId, Weak<tokio::sync::Mutex<()>>>>,
    /// Slots for drawing children: half of the cores, so that jobs keep the rest.
    places: Arc<Semaphore>,
}

impl DrawingQueue {
    pub fn new(settings: &Settings) -> Self {
        Self {
            turns: Mutex::default(),
            places: Arc::new(Semaphore::new((settings.cores / 2).max(1))),
        }
    }

    /// Waits until no picture of the job is being drawn.
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

    /// Waits for a drawing slot.
    pub async fn place(&self) -> Option<OwnedSemaphorePermit> {
        Arc::clone(&self.places).acquire_owned().await.ok()
    }
}
