//! What tests of packages in other languages share: the native module that cargo builds for them, and their files of tests.

use std::path::PathBuf;
use std::process::Output;

/// A file or folder of the repository.
pub fn repository(path: &str) -> PathBuf {
    let package = std::env::var_os("CARGO_MANIFEST_DIR").expect("tests are run by cargo");
    PathBuf::from(package).join("../..").join(path)
}

/// The native module of a crate, which lies beside this program.
pub fn module(library: &str) -> PathBuf {
    let program = std::env::current_exe().expect("a path");
    let name = format!(
        "{}{library}{}",
        std::env::consts::DLL_PREFIX,
        std::env::consts::DLL_SUFFIX
    );
    program.with_file_name(name)
}

/// What a test runner said of tests that all passed.
pub fn passed(output: &Output) -> String {
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}{errors}");
    text
}

/// The names of the files of tests in a folder, without what each begins and ends with, in order.
pub fn files(folder: &str, begin: &str, end: &str) -> Vec<String> {
    let entries = std::fs::read_dir(repository(folder)).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut found: Vec<String> = names
        .filter_map(|name| {
            let stem = name.to_str()?.strip_prefix(begin)?.strip_suffix(end)?;
            Some(stem.to_owned())
        })
        .collect();
    found.sort_unstable();
    found
}

/// A test for each file, and one that none is left out.
macro_rules! tests_of_files {
    ($group:ident, $passes:path, $found:expr, [$($file:ident),* $(,)?]) => {
        mod $group {
            $(#[test]
            fn $file() {
                $passes(stringify!($file));
            })*
        }

        #[test]
        fn no_file_is_left_out() {
            assert_eq!($found, [$(stringify!($file)),*]);
        }
    };
}

pub(crate) use tests_of_files;
