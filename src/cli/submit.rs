//! `unwrapd submit`: many meshes, each as a job of a service.

use super::batch::{run_with, runtime};
use super::bulk_args::BulkArgs;
use super::failure::Failure;
use crate::bulk::Remote;

/// The arguments of `submit`.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Address of the service, such as http://127.0.0.1:8080
    #[arg(long, value_name = "URL", env = "UNWRAPD_SERVER")]
    server: String,
    /// API key, if the service asks for one. In the environment it is not seen by other users of the
    /// machine
    #[arg(long, value_name = "KEY", env = "UNWRAPD_KEY", hide_env_values = true)]
    key: Option<String>,
    /// Number of jobs submitted at the same time
    #[arg(
        short,
        long,
        value_name = "N",
        default_value_t = 8,
        value_parser = clap::value_parser!(u16).range(1..)
    )]
    jobs: u16,
    /// Have every asset computed, even if the service has the result of an equal job
    ///
    /// A run that follows within a day finds the jobs that this one made.
    #[arg(long)]
    no_cache: bool,
    #[command(flatten)]
    bulk: BulkArgs,
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let options = serde_json::to_value(args.bulk.options()?);
    let options = options.map_err(|error| Failure::other(error.to_string()))?;
    let runtime = runtime()?;
    let remote = Remote::connect(
        &args.server,
        args.key.as_deref(),
        &options,
        args.bulk.extras(),
    );
    let mut remote = runtime.block_on(remote)?;
    remote.is_fresh = args.no_cache;
    run_with(&args.bulk, usize::from(args.jobs), remote, &runtime)
}
