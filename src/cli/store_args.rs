//! Arguments for the location of records.

use super::console::CommandFailure;
use nix::sys::stat::{Mode, umask};
use percent_encoding::{NON_ALPHANUMERIC, utf8_percent_encode};
use std::fs::{DirBuilder, Metadata, OpenOptions, Permissions};
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::path::{Path, PathBuf};
use unwrapd_server::jobs::Rules;
use unwrapd_server::store::RecordStore;

/// Location of records.
#[derive(clap::Args)]
pub(super) struct StoreArgs {
    /// Folder for what this process keeps; created if missing. Without `database`, that is
    /// everything
    #[arg(
        long,
        value_name = "DIR",
        env = "UNWRAPD_DATA",
        default_value = "./data"
    )]
    pub data: PathBuf,
    /// PostgreSQL database for job records and keys, shared with other processes:
    /// postgres://USER:PASSWORD@HOST/NAME
    #[arg(
        long,
        value_name = "URL",
        env = "UNWRAPD_DATABASE_URL",
        hide_env_values = true
    )]
    pub database: Option<String>,
}

impl StoreArgs {
    /// Returns the URL of the database.
    pub fn database_url(&self) -> Result<String, String> {
        if let Some(database) = &self.database {
            return Ok(database.clone());
        }
        Ok(format!(
            "sqlite://{}?mode=rwc",
            url_path(&self.data.join("unwrapd.sqlite"))?
        ))
    }

    /// Opens the database, and creates it if needed.
    pub async fn opened(&self) -> Result<RecordStore, CommandFailure> {
        self.make_folder().map_err(CommandFailure::other)?;
        let url = self.database_url().map_err(CommandFailure::other)?;
        let store = RecordStore::open(&url, Rules::default()).await;
        store.map_err(|error| CommandFailure::other(format!("cannot use the database: {error}")))
    }

    /// Opens the database. Fails if it does not exist.
    pub async fn present(&self) -> Result<RecordStore, CommandFailure> {
        let file = self.data.join("unwrapd.sqlite");
        if self.database.is_none() && !file.exists() {
            return Err(CommandFailure::other(format!(
                "there is no database {}: name the folder of the service with --data",
                file.display()
            )));
        }
        self.opened().await
    }

    /// Creates the data folder, and protects it and all files created from now on from other users.
    pub fn make_folder(&self) -> Result<(), String> {
        let database = match self.database {
            None => DatabaseAddress::Here,
            Some(_) => DatabaseAddress::Elsewhere,
        };
        make_private(&self.data, database)
    }
}

/// Encodes a path for a URL.
pub(super) fn url_path(path: &Path) -> Result<String, String> {
    let path = std::path::absolute(path).map_err(|error| error.to_string())?;
    let path = path.to_string_lossy();
    let parts = path.split('/');
    let parts: Vec<_> = parts
        .map(|part| utf8_percent_encode(part, NON_ALPHANUMERIC).to_string())
        .collect();
    Ok(parts.join("/"))
}

// Permissions of the data folder: its owner, and the group of a setgid folder.

/// Name of the database, if it is a file.
const DATABASE: &str = "unwrapd.sqlite";

/// Location of the database.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DatabaseAddress {
    /// A file in the data folder.
    Here,
    /// A server elsewhere.
    Elsewhere,
}

/// Names of our files in a data folder. Other files in it are not ours.
const NAMES: [&str; 7] = [
    DATABASE,
    "unwrapd.sqlite-wal",
    "unwrapd.sqlite-shm",
    "lock",
    "address",
    "blobs",
    "scratch",
];
/// Permission bits of POSIX: access of group and others, of others alone, of the group, and special bits.
const GROUP_AND_OTHERS: u32 = 0o077;
const OTHERS: u32 = 0o007;
const GROUP_WRITES: u32 = 0o020;
const GROUP_READS_WRITES: u32 = 0o060;
const SETGID: u32 = 0o2000;
const STICKY: u32 = 0o1000;

/// Creates a data folder that only this user can read, and makes this process create all files like that. Tightens a
/// looser folder if this user owns it, and warns otherwise. A group keeps its access if the folder is shared that
/// way: it has the setgid bit, which Kubernetes sets for `fsGroup`, or it belongs to another user and its group may
/// write.
fn make_private(folder: &Path, has_database: DatabaseAddress) -> Result<(), String> {
    // Create the folder.
    let mut builder = DirBuilder::new();
    builder.recursive(true).mode(0o700);
    let found = (builder.create(folder))
        .and_then(|()| folder.metadata())
        .map_err(|error| format!("cannot create {}: {error}", folder.display()))?;
    // Find out whether a group shares it, and deny access to everybody else.
    let is_own = is_owner(found.uid());
    let is_of_group = found.mode() & SETGID != 0 || (!is_own && found.mode() & GROUP_WRITES != 0);
    let denied = if is_of_group {
        OTHERS
    } else {
        GROUP_AND_OTHERS
    };
    umask(Mode::from_bits_truncate(denied));
    let database = folder.join(DATABASE);
    if is_of_group && has_database == DatabaseAddress::Here {
        share(&database)
            .map_err(|error| format!("cannot share {}: {error}", database.display()))?;
    }
    // Tighten the folder and our files in it.
    if found.mode() & denied != 0 {
        // A sticky folder, such as /tmp, is meant for all users.
        if is_own && found.mode() & STICKY == 0 {
            tighten(folder, &found, denied);
        } else {
            let folder = folder.display();
            tracing::warn!(
                "others can read {folder}: it belongs to another user, or is meant for all"
            );
        }
    }
    for name in NAMES {
        let path = folder.join(name);
        let Ok(data) = path.symlink_metadata() else {
            continue;
        };
        if is_owner(data.uid()) && !data.is_symlink() && data.mode() & denied != 0 {
            tighten(&path, &data, denied);
        }
    }
    Ok(())
}

/// Lets the group write the database. SQLite creates its file writable for the owner only, and gives its logs the
/// mode of the file, so the file is created here, empty.
fn share(database: &Path) -> std::io::Result<()> {
    let opened = OpenOptions::new()
        .append(true)
        .create(true)
        .open(database)?;
    let data = opened.metadata()?;
    let (mode, shared) = (data.mode() & 0o7777, GROUP_READS_WRITES);
    if is_owner(data.uid()) && mode & shared != shared {
        opened.set_permissions(Permissions::from_mode(mode | shared))?;
    }
    Ok(())
}

/// Removes the denied permissions from a file.
fn tighten(path: &Path, data: &Metadata, denied: u32) {
    let mode = data.mode() & 0o7777 & !denied;
    let path_shown = path.display();
    match std::fs::set_permissions(path, Permissions::from_mode(mode)) {
        Ok(()) => tracing::info!("access to {path_shown} is now {mode:03o}"),
        Err(error) => tracing::warn!("others can read {path_shown}: {error}"),
    }
}

/// Returns whether this process runs as a user.
fn is_owner(user: u32) -> bool {
    std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == user)
}
