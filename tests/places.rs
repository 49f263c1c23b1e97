//! Where tests find their files. It is looked up when they run, not when they are built, so that the same binaries can run on a
//! bare copy of the repository, with nothing beside it.

use std::path::PathBuf;

/// A file or folder of the repository.
pub fn repository(path: &str) -> PathBuf {
    let member = std::env::var_os("CARGO_MANIFEST_DIR").expect("tests are run by cargo");
    let member = PathBuf::from(member);
    let root = member
        .ancestors()
        .find(|folder| folder.join("Cargo.lock").is_file());
    root.expect("the root has the lock file").join(path)
}

/// A file of the tests' own.
pub fn asset(name: &str) -> PathBuf {
    repository("tests/assets").join(name)
}

/// A file or folder of the larger test data beside the repository: for modules named `shared` alone.
pub fn shared(path: &str) -> PathBuf {
    let found = repository("../shared").join(path);
    assert!(found.exists(), "{} is not there", found.display());
    found
}

/// A Python with numpy, where `tests/run` put one.
pub fn python() -> PathBuf {
    let own = repository("tests/.venv/bin/python");
    if own.exists() { own } else { "python3".into() }
}
