//! `unwrapd config`: the settings of a service, and their sources.

use std::collections::BTreeSet;

use clap::parser::ValueSource;
use clap::{Arg, ArgMatches};
use serde::Serialize;

use super::console::{CommandFailure, print, print_json, warn_of};
use super::serve;

/// Prefix of all environment variables of the program.
const PREFIX: &str = "UNWRAPD_";
/// Placeholder for secrets.
const HIDDEN: &str = "***";

/// Environment variables of S3, and whether they are secret.
const S3: [(&str, bool); 6] = [
    ("AWS_ENDPOINT_URL", false),
    ("AWS_ALLOW_HTTP", false),
    ("AWS_REGION", false),
    ("AWS_ACCESS_KEY_ID", false),
    ("AWS_SECRET_ACCESS_KEY", true),
    ("AWS_SESSION_TOKEN", true),
];

/// The arguments of `config`.
#[derive(clap::Args)]
#[group(id = "config")]
pub(super) struct Args {
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    serve: serve::Args,
}

/// A setting of the service.
#[derive(Serialize)]
struct SettingRow {
    option: String,
    value: Option<String>,
    /// `flag`, `environment` or `default`.
    source: &'static str,
    variable: Option<String>,
}

/// Runs the command; `typed` are the matches of its arguments.
pub(super) fn run(
    args: &Args,
    program: &clap::Command,
    typed: &ArgMatches,
) -> Result<(), CommandFailure> {
    // Collect the options of `serve` and the variables of S3.
    let serve = program.find_subcommand("serve");
    let derived = args.serve.derived();
    let options = serve.into_iter().flat_map(clap::Command::get_arguments);
    let rows: Vec<SettingRow> = options
        .filter(|option| option.get_env().is_some())
        .map(|option| SettingRow::of(option, typed, &derived))
        .collect();
    let rows: Vec<SettingRow> = rows
        .into_iter()
        .chain(S3.map(|(name, is_secret)| SettingRow::of_s3(name, is_secret)))
        .collect();
    // Warn of misspelled variables.
    for variable in unknown(program) {
        warn_of(format!("no option reads {variable}"));
    }
    // Print the rows.
    if args.json {
        return print_json(&rows);
    }
    print("option\tvalue\tsource".to_owned());
    for row in rows {
        let source = match (&row.variable, row.source) {
            (Some(variable), "environment") => variable,
            _ => row.source,
        };
        let value = row.value.as_deref().unwrap_or("-");
        print(format!("{}\t{value}\t{source}", row.option));
    }
    Ok(())
}

impl SettingRow {
    /// Creates the row of an environment variable without an option.
    fn of_s3(name: &str, is_secret: bool) -> Self {
        let value = std::env::var(name).ok();
        Self {
            option: name.to_owned(),
            source: if value.is_some() {
                "environment"
            } else {
                "default"
            },
            value: value.map(|value| shown(&value, is_secret)),
            variable: Some(name.to_owned()),
        }
    }

    fn of(option: &Arg, typed: &ArgMatches, derived: &[(&str, String)]) -> Self {
        let id = option.get_id().as_str();
        let raw = typed.get_raw(id).into_iter().flatten();
        let raw: Vec<String> = raw
            .map(|value| shown(&value.to_string_lossy(), option.is_hide_env_values_set()))
            .collect();
        let value = (!raw.is_empty()).then(|| raw.join(","));
        let otherwise = derived.iter().find(|(name, _)| *name == id);
        Self {
            option: format!("--{}", option.get_long().unwrap_or(id)),
            value: value.or_else(|| otherwise.map(|(_, value)| value.clone())),
            source: match typed.value_source(id) {
                Some(ValueSource::CommandLine) => "flag",
                Some(ValueSource::EnvVariable) => "environment",
                _ => "default",
            },
            variable: option.get_env().map(|it| it.to_string_lossy().into_owned()),
        }
    }
}

/// Returns a value without its secrets: the password and the parameters of a URL, and values that are entirely
/// secret.
fn shown(value: &str, is_secret: bool) -> String {
    let Some((scheme, rest)) = value.split_once("://") else {
        return if is_secret { HIDDEN } else { value }.to_owned();
    };
    let (rest, parameters) = match rest.split_once('?') {
        Some((rest, _)) => (rest, format!("?{HIDDEN}")),
        None => (rest, String::new()),
    };
    let (authority, path) = rest.split_at(rest.find('/').unwrap_or(rest.len()));
    let authority = match authority.rsplit_once('@') {
        Some((user, host)) => {
            let name = user.split_once(':').map(|(name, _)| name);
            name.map_or(authority.to_owned(), |name| {
                format!("{name}:{HIDDEN}@{host}")
            })
        }
        None => authority.to_owned(),
    };
    format!("{scheme}://{authority}{path}{parameters}")
}

/// Returns environment variables with the program's prefix that no option reads, such as misspelled ones.
fn unknown(program: &clap::Command) -> BTreeSet<String> {
    let options = program.get_subcommands().flat_map(every_option);
    let known: BTreeSet<String> = options
        .filter_map(|option| Some(option.get_env()?.to_string_lossy().into_owned()))
        .collect();
    let names = std::env::vars_os().map(|(name, _)| name.to_string_lossy().into_owned());
    names
        .filter(|name| name.starts_with(PREFIX) && !known.contains(name))
        .collect()
}

/// Returns the options of a command and of its subcommands.
fn every_option(command: &clap::Command) -> Vec<&Arg> {
    let below = command.get_subcommands().flat_map(every_option);
    command.get_arguments().chain(below).collect()
}
