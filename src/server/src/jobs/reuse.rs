//! Reuse of results among equal jobs.

use super::checksum;
use super::job::Job;
use super::keys::output_key;
use super::queue::Jobs;
use super::state::State;
use super::store_error::StoreResult;

impl Jobs {
    /// Returns the checksum of the program, since another build may compute different results.
    pub(super) async fn engine(&self) -> StoreResult<&str> {
        let file = &self.settings.program.engine;
        let engine = self.engine.get_or_try_init(|| checksum::of(file));
        engine.await.map(String::as_str)
    }

    /// Completes a new job with copies of the results of an equal, undamaged job of its owner, if there is one. If
    /// copying fails, the job stays queued and is computed; partial copies are removed with the job.
    pub(super) async fn reuse(&self, job: &mut Job) {
        match self.copy_equal(job).await {
            Ok(Some(earlier)) => {
                tracing::info!(job = %job.id, %earlier.id, "equal to an earlier job");
                job.state = State::Succeeded;
                job.progress.fraction = 1.0;
                job.finished = Some(job.created);
                job.output = earlier.output;
                job.verdict = earlier.verdict;
            }
            Ok(None) => {}
            Err(error) => tracing::warn!(job = %job.id, %error, "no earlier result reused"),
        }
    }

    /// Copies the files of an equal job and returns that job.
    async fn copy_equal(&self, job: &Job) -> StoreResult<Option<Job>> {
        let engine = self.engine().await?;
        let equal = self.store.equal(job).await?;
        for earlier in equal {
            if !earlier.is_repeatable(engine) {
                continue;
            }
            match self.copy_verified(&earlier, job).await {
                Ok(()) => return Ok(Some(earlier)),
                Err(error) if error.is_loss() => self.spoil(&earlier).await,
                Err(error) => return Err(error),
            }
        }
        Ok(None)
    }

    /// Copies the output of an earlier job if all of it is intact.
    async fn copy_verified(&self, earlier: &Job, job: &Job) -> StoreResult<()> {
        for (index, file) in earlier.output.iter().enumerate() {
            self.verify(earlier, index, file).await?;
        }
        for index in 0..earlier.output.len() {
            let from = output_key(earlier.id, earlier.token, index);
            let to = output_key(job.id, job.token, index);
            self.blobs.copy(&from, &to).await?;
        }
        Ok(())
    }
}

impl Job {
    /// Returns whether the result is a copy of an earlier job's.
    pub fn is_copy(&self) -> bool {
        self.state == State::Succeeded && self.attempt == 0
    }

    /// Returns whether this engine would compute the same result: the job was not ended early.
    fn is_repeatable(&self, engine: &str) -> bool {
        let is_cut_short = |code: &str| code == "ended_early";
        let mut warnings = self.verdict.warnings.iter();
        self.state == State::Succeeded
            && self.verdict.engine == engine
            && !warnings.any(|warning| is_cut_short(&warning.code))
    }
}
