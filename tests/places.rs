//! Where tests find their files. It is looked up when they run, not when they are built, so that the same binaries can run on a
//! bare copy of the repository, with nothing beside it.

use std::path::PathBuf;

/// A file or folder of the repository.
pub fn repository(path: &str) -> PathBuf {
    let root = std::env::var_os("CARGO_MANIFEST_DIR").expect("tests are run by cargo");
    PathBuf::from(root).join(path)
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
