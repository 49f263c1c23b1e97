//! `unwrapd keys`: creating, listing and revoking API keys.

use std::time::Duration;

use serde::Serialize;

use super::console::{CommandFailure, print, print_json, warn_of};
use super::store_args::StoreArgs;
use unwrapd_server::jobs::access::{Key, KeyId, KeyStore, KeyText, NewKey, Owner, Scopes};
use unwrapd_server::jobs::{StoreError, Timestamp};

/// Maximum length of a note in characters, so that the list keeps one line per key.
const MOST_OF_NAME: usize = 100;
/// Maximum lifetime of a key: a hundred years. A key that must not expire has no lifetime at all.
const LONGEST: Duration = Duration::from_hours(100 * 365 * 24);

/// The arguments of `keys`.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(subcommand)]
    action: KeyAction,
}

#[derive(clap::Subcommand)]
enum KeyAction {
    /// Make a key and print it. It is not shown again: only a digest of it is kept
    Create(Create),
    /// Add a key that was made elsewhere, such as one in the secrets of a cluster
    ///
    /// Its text is uw_ID_SECRET, where ID has 16 and SECRET 64 hexadecimal digits. A key that is there stays as it is, so
    /// that every process may add it before it starts.
    Add(Add),
    /// List all keys that were ever made, without their secrets
    List(List),
    /// Revoke a key. Services refuse it after two seconds at the latest
    Revoke(Revoke),
}

#[derive(clap::Args)]
struct Create {
    /// Owner of what is made with the key: other owners do not see it. An owner may have several keys
    #[arg(long, value_name = "NAME")]
    owner: Owner,
    /// Permissions of the key: read, write or both. With admin, they apply to all owners, and to
    /// /metrics, /v1/drain and /v1/pause; admin alone includes both
    #[arg(long, value_name = "SCOPES", default_value = "read,write")]
    scope: Scopes,
    /// Time for which the key is valid, such as 90d or 12h [default: until it is revoked]
    #[arg(long, value_name = "TIME", value_parser = life)]
    expires: Option<Duration>,
    /// Note for those who list keys
    #[arg(long, value_name = "TEXT", value_parser = name)]
    name: Option<String>,
    #[command(flatten)]
    store: StoreArgs,
}

#[derive(clap::Args)]
struct Add {
    /// The key. In the environment it is not seen by other users of the machine
    #[arg(
        long,
        value_name = "KEY",
        env = "UNWRAPD_INITIAL_KEY",
        hide_env_values = true
    )]
    key: String,
    /// Owner of what is made with the key
    #[arg(long, value_name = "NAME")]
    owner: Owner,
    /// Scopes of the key, as with `create`
    #[arg(long, value_name = "SCOPES", default_value = "read,write")]
    scope: Scopes,
    #[command(flatten)]
    store: StoreArgs,
}

#[derive(clap::Args)]
struct List {
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    store: StoreArgs,
}

#[derive(clap::Args)]
struct Revoke {
    /// Id of the key: what `list` shows, the part between the underscores
    id: KeyId,
    #[command(flatten)]
    store: StoreArgs,
}

fn life(text: &str) -> Result<Duration, String> {
    match humantime::parse_duration(text) {
        Ok(life) if Duration::ZERO < life && life <= LONGEST => Ok(life),
        Ok(_) => Err("expected a time between 1ms and 36500d".to_owned()),
        Err(error) => Err(format!("expected a time such as 90d or 12h: {error}")),
    }
}

fn name(text: &str) -> Result<String, String> {
    if text.chars().count() <= MOST_OF_NAME && !text.chars().any(char::is_control) {
        Ok(text.to_owned())
    } else {
        Err(format!("expected one line of {MOST_OF_NAME} characters"))
    }
}

/// Runs the command.
pub(super) fn run(args: &Args) -> Result<(), CommandFailure> {
    let runtime = super::batch::runtime()?;
    runtime.block_on(async {
        match &args.action {
            KeyAction::Create(args) => create(args).await,
            KeyAction::Add(args) => add(args).await,
            KeyAction::List(args) => list(args).await,
            KeyAction::Revoke(args) => revoke(args).await,
        }
    })
}

async fn create(args: &Create) -> Result<(), CommandFailure> {
    let text = KeyText::fresh().map_err(|error| not_made(&error))?;
    let new = NewKey {
        id: text.id().clone(),
        digest: text.digest(),
        owner: args.owner.clone(),
        scopes: args.scope.clone(),
        name: args.name.clone().unwrap_or_default(),
        life: args.expires,
        parent: None,
    };
    let store = args.store.opened().await?;
    let added = store.add_key(&new).await;
    added.map_err(|error| not_made(&error))?;
    warn_of("this is the only time that the key is shown");
    print(text.reveal());
    Ok(())
}

fn not_made(error: &StoreError) -> CommandFailure {
    CommandFailure::other(format!("the key was not made: {error}"))
}

/// Minimum number of hexadecimal digits of a secret: 256 bits, as in generated keys.
const SECRET_DIGITS: usize = 64;

async fn add(args: &Add) -> Result<(), CommandFailure> {
    // Check the form of the key, including the length of its secret.
    let text = args.key.trim();
    let secret = text.rsplit('_').next().unwrap_or_default();
    let is_long =
        SECRET_DIGITS <= secret.len() && secret.bytes().all(|byte| byte.is_ascii_hexdigit());
    let key = KeyText::parse(text).filter(|_| is_long);
    let key = key.ok_or_else(|| {
        CommandFailure::usage(
            "the key must be uw_ID_SECRET, with 16 and 64 hexadecimal digits in lower case",
        )
    })?;
    let new = NewKey {
        id: key.id().clone(),
        digest: key.digest(),
        owner: args.owner.clone(),
        scopes: args.scope.clone(),
        name: "added".to_owned(),
        life: None,
        parent: None,
    };
    // Add it, then compare the stored key with it.
    let store = args.store.opened().await?;
    let added = store.add_key(&new).await;
    // The error is ignored at first: the key may exist already, or another process may have been faster.
    let keys = store.keys().await;
    let keys = keys.map_err(|error| CommandFailure::other(format!("no keys read: {error}")))?;
    match (keys.iter().find(|known| known.id == new.id), added) {
        (Some(known), _) if !key.has_digest(&known.digest) => Err(CommandFailure::other(format!(
            "there is another key {} with another secret",
            new.id
        ))),
        (Some(known), _) if known.revoked.is_some() => Err(CommandFailure::other(format!(
            "the key {} is revoked",
            new.id
        ))),
        (None, Err(error)) => Err(CommandFailure::other(format!(
            "the key was not added: {error}"
        ))),
        _ => Ok(()),
    }
}

async fn list(args: &List) -> Result<(), CommandFailure> {
    let keys = args.store.present().await?.keys().await;
    let keys = keys.map_err(|error| CommandFailure::other(format!("no keys read: {error}")))?;
    let rows: Vec<KeyRow> = keys.iter().map(KeyRow::of).collect();
    if args.json {
        return print_json(&rows);
    }
    print(HEAD.map(str::to_owned).join("\t"));
    for row in &rows {
        print(row.line());
    }
    Ok(())
}

async fn revoke(args: &Revoke) -> Result<(), CommandFailure> {
    let store = args.store.present().await;
    let store = store.map_err(|failure| failure.about(format_args!("no key {}", args.id)))?;
    let revoked = store.revoke(&args.id).await;
    match revoked {
        Ok(true) => Ok(()),
        Ok(false) => Err(CommandFailure::other(format!(
            "no key {} that is not revoked",
            args.id
        ))),
        Err(error) => Err(CommandFailure::other(format!(
            "the key was not revoked: {error}"
        ))),
    }
}

const HEAD: [&str; 8] = [
    "id", "state", "owner", "scopes", "created", "expires", "used", "name",
];

/// A key as it is listed.
#[derive(Serialize)]
struct KeyRow {
    id: String,
    state: &'static str,
    owner: String,
    scopes: String,
    created: Timestamp,
    expires: Option<Timestamp>,
    used: Option<Timestamp>,
    name: String,
}

impl KeyRow {
    fn of(key: &Key) -> Self {
        let is_over = key.expires.is_some_and(|end| end <= Timestamp::now());
        Self {
            id: key.id.to_string(),
            state: match key.revoked {
                Some(_) => "revoked",
                None if is_over => "expired",
                None => "valid",
            },
            owner: key.owner.as_str().to_owned(),
            scopes: key.scopes.to_string(),
            created: key.created,
            expires: key.expires,
            used: key.used,
            name: key.name.clone(),
        }
    }

    fn line(&self) -> String {
        let Self {
            id,
            state,
            owner,
            scopes,
            name,
            ..
        } = self;
        let times = [Some(self.created), self.expires, self.used];
        let times = times.map(|time| time.map_or("-".to_owned(), |it| it.to_string()));
        let times = times.join("\t");
        format!("{id}\t{state}\t{owner}\t{scopes}\t{times}\t{name}")
    }
}
