//! The commands as clap knows them.

use clap::builder::StyledStr;
use clap::{CommandFactory, FromArgMatches, Parser, Subcommand};

use super::{
    completions, deform, edit_uv, health, man, measure, repack, serve, solve, unwrap_args, verify,
    warp,
};
use crate::options::as_typed;

/// Unwraps meshes: glTF in, certified flip-free UVs and a distortion report out.
#[derive(Parser)]
#[command(name = "unwrapd", version, about, max_term_width = 100)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
pub(super) enum Command {
    /// Give a mesh UVs in which no triangle is flipped or degenerate
    Unwrap(Box<unwrap_args::Args>),
    /// Measure the UVs of a file: distortion, seams, packing, overlaps
    Measure(measure::Args),
    /// Check exactly that no face of a file's UVs is flipped or degenerate, and what else is asked
    /// for: exit 0 if so, 4 if not
    Verify(verify::Args),
    /// Pack the UV islands of all meshes into one atlas, each as it is
    Repack(repack::Args),
    /// Move anchors of a file's UVs, no face flipped
    EditUv(edit_uv::EditArgs),
    /// Align points of a surface with points of a texture, no face flipped
    TextureMap(edit_uv::TextureArgs),
    /// Pull a mesh, a picture's outline, a drawing or surfaces in a cage by handles, no element
    /// inverted
    Deform(Box<deform::Args>),
    /// Solve a problem file: handles pulled to targets, no element inverted
    Solve(solve::Args),
    /// Warp a picture by handles without folding it
    Warp(warp::Args),
    /// Run the HTTP service
    Serve(Box<serve::Args>),
    /// Print the OpenAPI document of the service
    Openapi,
    /// Ask a running service whether it is ready: exit 0 if so, 1 if not
    Health(health::Args),
    /// Print what makes a shell complete commands and options
    Completions(completions::Args),
    /// Print the manual page of the program or of one of its commands
    Man(man::Args),
}

/// What was typed; ends the process where that is wrong, or where help is asked for.
pub(super) fn typed() -> Command {
    let short = command().mut_subcommands(|command| command.mut_args(hidden_if_special));
    let cli = Cli::from_arg_matches(&short.get_matches());
    cli.unwrap_or_else(|error| error.exit()).command
}

/// The program: options take negative numbers, which are then refused by name, and help names
/// options as they are typed.
pub(super) fn command() -> clap::Command {
    Cli::command().mut_subcommands(|command| {
        let ids = command.get_arguments().map(|option| option.get_id());
        let ids: Vec<String> = ids.map(ToString::to_string).collect();
        let is_option = |name: &str| ids.iter().any(|id| id == name);
        command.mut_args(|option| with_typed_names(with_negative_numbers(option), is_option))
    })
}

fn with_typed_names(option: clap::Arg, is_option: impl Fn(&str) -> bool) -> clap::Arg {
    let typed = |help: &StyledStr| as_typed(&help.to_string(), &is_option);
    let (short, long) = (
        option.get_help().map(typed),
        option.get_long_help().map(typed),
    );
    let option = short.into_iter().fold(option, clap::Arg::help);
    long.into_iter().fold(option, clap::Arg::long_help)
}

fn with_negative_numbers(option: clap::Arg) -> clap::Arg {
    let is_option = !option.is_positional() && option.get_action().takes_values();
    option.allow_negative_numbers(is_option)
}

/// The heading under which `-h` lists options too, beside those without one.
const SHORT: &str = "Files and messages";

fn hidden_if_special(option: clap::Arg) -> clap::Arg {
    let is_special = option.get_help_heading().is_some_and(|it| it != SHORT);
    option.hide_short_help(is_special)
}
