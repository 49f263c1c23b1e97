//! `unwrapd serve`.

#[derive(clap::Args)]
pub(super) struct Args {
    /// Address to listen on; port 0 takes a free one
    #[arg(
        long,
        value_name = "ADDRESS",
        env = "UNWRAPD_LISTEN",
        default_value = "127.0.0.1:8080"
    )]
    listen: std::net::SocketAddr,
    /// Folder for the records and files of jobs; made if it does not exist
    #[arg(
        long,
        value_name = "DIR",
        env = "UNWRAPD_DATA",
        default_value = "./data"
    )]
    data: std::path::PathBuf,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    Err(format!(
        "not ready yet: {} {}",
        args.listen,
        args.data.display()
    ))
}
