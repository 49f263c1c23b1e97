//! Permissions of the data folder: its owner, and the group of a setgid folder.

use std::fs::{DirBuilder, Metadata, OpenOptions, Permissions};
use std::os::unix::fs::{DirBuilderExt, MetadataExt, PermissionsExt};
use std::path::Path;

use nix::sys::stat::{Mode, umask};

/// Name of the database, if it is a file.
const DATABASE: &str = "unwrapd.sqlite";

/// Location of the database.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Database {
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
/// Permission bits: access of group and others, of others alone, of the group, and special bits.
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
pub(super) fn make_private(folder: &Path, has_database: Database) -> Result<(), String> {
    // Create the folder.
    let failed = |error: std::io::Error| format!("cannot create {}: {error}", folder.display());
    let mut builder = DirBuilder::new();
    builder.recursive(true).mode(0o700);
    builder.create(folder).map_err(failed)?;
    // Find out who shares it.
    let found = folder.metadata().map_err(failed)?;
    let is_own = |data: &Metadata| is_owner(data.uid());
    let is_of_group =
        found.mode() & SETGID != 0 || (!is_own(&found) && found.mode() & GROUP_WRITES != 0);
    let denied = if is_of_group {
        OTHERS
    } else {
        GROUP_AND_OTHERS
    };
    umask(Mode::from_bits_truncate(denied));
    let database = folder.join(DATABASE);
    if is_of_group && has_database == Database::Here {
        share(&database)
            .map_err(|error| format!("cannot share {}: {error}", database.display()))?;
    }
    // Tighten the folder and our files in it.
    if found.mode() & denied != 0 {
        // A folder such as /tmp is meant for all.
        if is_own(&found) && found.mode() & STICKY == 0 {
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
        if is_own(&data) && !data.is_symlink() && data.mode() & denied != 0 {
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
