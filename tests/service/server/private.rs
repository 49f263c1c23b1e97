//! Who may read what the service keeps.

use std::fs::{Permissions, set_permissions};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};

use crate::meshes;
use crate::server::Server;

fn mode(path: &Path) -> u32 {
    let data = path.symlink_metadata().expect("a file");
    data.permissions().mode() & 0o7777
}

/// All files and folders below one, and itself.
fn all(folder: &Path) -> Vec<PathBuf> {
    let mut found = vec![folder.to_owned()];
    let mut next = 0;
    while let Some(path) = found.get(next).cloned() {
        let below = std::fs::read_dir(path).into_iter().flatten().flatten();
        found.extend(below.map(|entry| entry.path()));
        next += 1;
    }
    found
}

#[tokio::test]
async fn nobody_else_reads_the_data() {
    let mut server = Server::start();
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    let found = all(server.data());
    assert!(10 < found.len());
    for path in &found {
        assert_eq!(mode(path) & 0o077, 0, "{}", path.display());
    }
    // What an earlier version left is tightened.
    server.kill();
    let database = server.data().join("unwrapd.sqlite");
    for (path, loose) in [(server.data(), 0o755), (&database, 0o644)] {
        set_permissions(path, Permissions::from_mode(loose)).expect("it is ours");
    }
    server.restart();
    assert_eq!((mode(server.data()), mode(&database)), (0o700, 0o600));
}

/// Kubernetes makes a volume that is shared by a group like that.
#[tokio::test]
async fn a_group_that_shares_the_data_keeps_its_access() {
    let data = tempfile::tempdir().expect("a folder");
    let shared = Permissions::from_mode(0o2775);
    set_permissions(data.path(), shared).expect("it is ours");
    let server = Server::on(data, &[]);
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    assert_eq!(mode(server.data()), 0o2770);
    // Another user of the group goes on with it.
    for name in ["unwrapd.sqlite", "unwrapd.sqlite-wal", "unwrapd.sqlite-shm"] {
        assert_eq!(mode(&server.data().join(name)), 0o660, "{name}");
    }
    for path in all(server.data()) {
        assert_eq!(mode(&path) & 0o007, 0, "{}", path.display());
    }
}
