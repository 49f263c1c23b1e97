//! The commands as clap knows them, and what is derived from that: completion scripts and manual pages.

use std::ffi::OsString;
use std::io::{self, Write};

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use clap_complete::Shell;
use clap_mangen::Man;

use super::console::{self, CommandFailure};
use super::{
    batch, check, config, deform, drain, edit_uv, keys, measure, queue, serve, untangle, unwrap,
    webhook, worker,
};
use unwrapd_api::options::as_typed;

/// The exit statuses of all commands. The README and the description of the HTTP API repeat them.
pub const EXIT_STATUSES: &str = "\
Exit statuses:
  0  done and proven
  1  any other error
  2  usage error
  3  unusable input
  4  written, but not certified or not accepted
  5  handles cannot be brought to their targets
  6  ended early, with less than was asked for
  7  partly done: textures or colors were not resampled";

/// Unwraps meshes: glTF in, glTF with certified flip-free UVs and a distortion report out.
#[derive(Parser)]
#[command(name = "unwrapd", version, about, max_term_width = 100, after_help = EXIT_STATUSES)]
struct Cli {
    #[command(subcommand)]
    command: CliCommand,
}

#[derive(Subcommand)]
pub(super) enum CliCommand {
    /// Unwrap a mesh: UVs without flipped or degenerate triangles
    ///
    /// Exit status 0 means certified: it is proven that no triangle is flipped, degenerate or
    /// overlapping, that no chart is mirrored, and that padding, pages and bits are as requested.
    ///
    /// Exit status 4 means not certified, or whatever else `accept` requests. OUT is still written, and a warning names what is
    /// missing. Only if a triangle would be flipped against the promise, no file is written.
    ///
    /// Exit status 7 means that not all textures and colors were resampled as `rebake` asks. An atlas that is complete when
    /// `time_budget` is over ends with 0; its report says `ended_early`. Other statuses: 2 usage error, 3 unusable input, 1 any
    /// other error. Distortion above the bound of `quality` is only a warning.
    Unwrap(Box<unwrap::UnwrapArgs>),
    /// Unwrap many meshes: a folder, a list, or a shard of either
    ///
    /// Outputs mirror the input directory. Each is complete or absent. A run skips what an earlier
    /// one did, as long as input, options and version are the same, so it can be repeated after
    /// any failure. Finished runs write DIR/summary.csv, a line per asset.
    ///
    /// Run every shard, then once without `shard`: that does what is missing and summarizes all.
    ///
    /// Exit status 0 means that all assets are accepted, 4 that some are not. Other statuses: 2
    /// usage error, 3 nothing to read, 1 any other error, such as a stop by a signal. A mesh that
    /// cannot be unwrapped never stops the others; its line in the summary has a code.
    Batch(Box<batch::Args>),
    /// Unwrap many meshes by a service: like `batch`, over HTTP
    ///
    /// Each mesh becomes a job of the service, which computes it; its output is fetched. A run that
    /// was killed finds its jobs again. If the service is busy, full or restarting, the command
    /// waits as long as it is asked to, and gives up after ten minutes without an answer.
    ///
    /// Outputs, shards, summary and exit statuses are those of `batch`.
    Submit(Box<batch::SubmitArgs>),
    /// Measure the UVs of a file: distortion, seams, packing, overlaps
    Measure(measure::Args),
    /// Prove that the UVs of a file have no flipped or degenerate face: exit 0 if so, 4 if not
    ///
    /// The proof is in exact arithmetic and covers whatever the options request. A face is flipped
    /// if its orientation differs from that of its chart.
    ///
    /// A file written by unwrapd has a record that names the UV set and adds requirements: no
    /// overlaps, padding, pages, bits. It never takes anything out: all faces are judged, and what
    /// shares an atlas follows from the materials or from `group_by`. That holds for files of
    /// version 0.1.0, too, whose records could name the only charts to judge. With `texcoord`, the
    /// record is ignored.
    Verify(measure::VerifyArgs),
    /// Pack the UV islands of all meshes into one atlas without changing their shapes
    ///
    /// Islands are only rotated, shifted and scaled by one common factor. `--rotate quarter` keeps
    /// rows of texels straight. Vertices are rounded to the grid of the atlas; those of triangles
    /// that rounding would flip are moved farther. Defects of islands remain: islands without area
    /// keep their shape and have a place, too. The exit status is 4, not certified, if a triangle is
    /// flipped, degenerate or overlapping, a chart is mirrored, or the padding is not kept. OUT is
    /// still written, and a warning names the defects.
    Repack(unwrap::RepackArgs),
    /// Pull UVs by anchors without flipping a face
    ///
    /// The whole UV set is judged after the edit. Exit status 4 means that OUT was written but is
    /// not certified, such as when a chart was pulled onto another.
    EditUv(edit_uv::EditArgs),
    /// Align points of a surface with points of a texture without flipping a face
    TextureMap(edit_uv::TextureArgs),
    /// Deform a mesh, an outline or surfaces in a cage by handles without inverting an element
    Deform(Box<deform::Args>),
    /// Solve a problem file: pull handles to targets without inverting an element
    Solve(deform::SolveArgs),
    /// Untangle a folded mesh: move vertices until no element is inverted
    ///
    /// Elements are those of the file, of triangles in the plane or of tetrahedra; neighbors are
    /// wound alike whatever the order of their corners. The boundary stays unless it is free. Exit
    /// status 3 means that no such mesh was found, or that the boundary allows none.
    Untangle(untangle::UntangleArgs),
    /// Warp a picture by handles without folding it
    Warp(deform::WarpArgs),
    /// Run the HTTP service
    ///
    /// It ends on SIGTERM or SIGINT. Every option can also be set by the environment variable that
    /// its help names. `unwrapd config` prints what is in force.
    Serve(Box<serve::Args>),
    /// Compute jobs that services on other machines accept
    ///
    /// It shares a database and a place for files with them and with other workers. It ends on
    /// SIGTERM or SIGINT. Every option can also be set by the environment variable that its help
    /// names.
    Worker(Box<worker::Args>),
    /// Make, list and revoke the keys with which the HTTP service is used
    ///
    /// Keys are in the database of the service and hold for all processes that share it. Once one
    /// was made, they refuse calls without a key. It can be done while they run.
    Keys(keys::Args),
    /// Look at the queue, pause it, resume it, and try failed jobs again
    ///
    /// It works on the database of the service, for all processes that share it, while they run.
    Queue(queue::Args),
    /// Compare the records of a service with its files: exit 0 if all is there
    ///
    /// It reads every file and lists those that are missing or damaged, and files without a job. The
    /// service may run meanwhile. Nothing is changed unless an option asks for it. The exit status
    /// is 1 if anything was found.
    ///
    /// A database and its files share an identity, and no process starts on two that do not belong
    /// together. After a restore of parts that do, `adopt` joins them. Files without a job are kept
    /// in quarantine for days (`quarantine-days` of `serve`) and then deleted, but not while they are
    /// more than 20 and more than 1 % of all: then a person decides, by `purge`.
    Check(check::Args),
    /// Have a service take in and start no more jobs, before it is stopped
    ///
    /// It is the service on a data folder of this machine. Running jobs end as usual, and the service
    /// is not ready meanwhile. Others that share its database go on.
    Drain(drain::Args),
    /// Print the secret by which an owner checks the webhooks of the service
    WebhookSecret(webhook::SecretArgs),
    /// Print what is in force for `serve`, and where each value comes from
    ///
    /// It takes the options of `serve`, on the command line and in the environment. The source of a
    /// value is flag, the name of the variable, or default. Passwords are hidden. Variables that
    /// begin with UNWRAPD_ and that no option reads are named in warnings.
    Config(Box<config::Args>),
    /// Print the OpenAPI document of the service
    Openapi,
    /// Check whether a running service is ready: exit 0 if so, 1 if not
    Health(drain::HealthArgs),
    /// Print a completion script for a shell
    Completions(CompletionsArgs),
    /// Print the manual page of the program or of a command
    Man(ManArgs),
}

/// Parses the command line. Exits the process on a usage error, or after printing help.
pub(super) fn typed(arguments: Vec<OsString>) -> (CliCommand, ArgMatches) {
    let short = command().mut_subcommands(|command| command.mut_args(hidden_if_special));
    let matches = short.try_get_matches_from(arguments);
    let mut matches = matches.unwrap_or_else(|error| refuse(error));
    let cli = Cli::from_arg_matches(&matches);
    let command = cli.unwrap_or_else(|error| error.exit()).command;
    let typed = matches.remove_subcommand();
    (command, typed.map(|(_, typed)| typed).unwrap_or_default())
}

/// Exits the process with a command line error. Adds a tip for the calling conventions of similar programs.
fn refuse(mut error: clap::Error) -> ! {
    if let Some(ContextValue::String(unknown)) = error.get(ContextKind::InvalidArg)
        && error.kind() == ErrorKind::UnknownArgument
    {
        if ["--version", "-V"].contains(&&**unknown) {
            console::print(concat!("unwrapd ", env!("CARGO_PKG_VERSION")));
            std::process::exit(0);
        }
        if !unknown.starts_with('-') {
            let tip = format!("an output is named by an option: '-o {unknown}'");
            error.insert(
                ContextKind::Suggested,
                ContextValue::StyledStrs(vec![tip.into()]),
            );
        }
    }
    error.exit()
}

/// Returns the clap command. Options accept negative numbers, so that the range check can name the option. Help shows
/// option names as they are typed, and all options in the same layout.
pub(super) fn command() -> clap::Command {
    Cli::command().mut_subcommands(|command| as_people_type(command).next_line_help(true))
}

fn as_people_type(command: clap::Command) -> clap::Command {
    let ids = command.get_arguments().map(clap::Arg::get_id);
    let ids: Vec<String> = ids.map(ToString::to_string).collect();
    let is_option = |name: &str| ids.iter().any(|id| id == name);
    let long = command.get_long_about();
    let long = long.map(|text| as_typed(&text.to_string(), is_option));
    let command =
        command.mut_args(|option| with_typed_names(with_negative_numbers(option), is_option));
    let command = long.into_iter().fold(command, clap::Command::long_about);
    command.mut_subcommands(as_people_type)
}

fn with_typed_names(option: clap::Arg, is_option: impl Fn(&str) -> bool) -> clap::Arg {
    let help = [option.get_help(), option.get_long_help()];
    let [short, long] = help.map(|help| Some(as_typed(&help?.to_string(), &is_option)));
    let option = short.into_iter().fold(option, clap::Arg::help);
    long.into_iter().fold(option, clap::Arg::long_help)
}

fn with_negative_numbers(option: clap::Arg) -> clap::Arg {
    let is_option = !option.is_positional() && option.get_action().takes_values();
    option.allow_negative_numbers(is_option)
}

/// Heading of options that `-h` lists, too, beside those without a heading.
const SHORT: &str = "Files and messages";

fn hidden_if_special(option: clap::Arg) -> clap::Arg {
    let is_special = option.get_help_heading().is_some_and(|it| it != SHORT);
    option.hide_short_help(is_special)
}

// `unwrapd completions`: shell completion scripts.

/// Prints a completion script for a shell.
#[derive(clap::Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

/// Runs `completions` of a program.
pub(super) fn print_completions(args: &CompletionsArgs, mut program: clap::Command) {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut program, "unwrapd", &mut script);
    // The reader may have closed the pipe, as with any output.
    let _ = io::stdout().write_all(&script);
}

// `unwrapd man`: manual pages.

/// Prints the manual page of the program or of a command.
#[derive(clap::Args)]
pub(super) struct ManArgs {
    /// The command [default: the manual page of the program, which lists all commands]
    command: Option<String>,
}

/// Runs `man` of a program.
pub(super) fn print_manual(
    args: &ManArgs,
    mut program: clap::Command,
) -> Result<(), CommandFailure> {
    program.build();
    let page = match &args.command {
        None => &program,
        Some(name) => program.find_subcommand(name).ok_or_else(|| {
            CommandFailure::usage(format!("unknown command {name}: see unwrapd --help"))
        })?,
    };
    let mut text = Vec::new();
    let rendered = Man::new(page.clone()).render(&mut text);
    rendered.map_err(|error| CommandFailure::other(error.to_string()))?;
    // The reader may have closed the pipe, as with any output.
    let _ = io::stdout().write_all(&text);
    Ok(())
}
