//! Equal jobs: what one made is given to the next.

use super::checksum;
use super::job::Job;
use super::keys::output_key;
use super::queue::Jobs;
use super::state::State;
use super::store_error::StoreResult;

impl Jobs {
    /// What computes: the checksum of the program, since results of another build may differ.
    pub(super) async fn engine(&self) -> StoreResult<&str> {
        let file = &self.settings.program.engine;
        let engine = self.engine.get_or_try_init(|| checksum::of(file));
        engine.await.map(String::as_str)
    }

    /// Ends a new job with copies of what an equal one of its owner made, if there is one that is
    /// whole. A copy that fails is
    /// no reason to refuse the job: the result can be computed. What was copied by then is removed with
    /// the job.
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

    /// The job whose files were copied.
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

    /// Copies what an earlier job made, if all of it is whole.
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
    /// Whether its result was made by an earlier job.
    pub fn is_copy(&self) -> bool {
        self.state == State::Succeeded && self.attempt == 0
    }

    /// Whether this engine would make the same again: the result was not cut short.
    fn is_repeatable(&self, engine: &str) -> bool {
        let is_cut_short = |code: &str| code == "ended_early";
        let mut warnings = self.verdict.warnings.iter();
        self.state == State::Succeeded
            && self.verdict.engine == engine
            && !warnings.any(|warning| is_cut_short(&warning.code))
    }
}
