#!/usr/bin/env bash
# A rolling update from the program of an earlier commit to the present one, under load; see update.rs.
# tests/bench/update.sh COMMIT [OPTION]…
set -euo pipefail
cd "$(dirname "$0")/../.."
commit=$(git rev-parse --verify "$1^{commit}")
shift

older=$PWD/target/older/$commit
if [ ! -x "$older" ]; then
    source=$(mktemp -d)
    trap 'rm -rf "$source"' EXIT
    git archive "$commit" | tar -x -C "$source"
    # The same folder of builds: most crates are compiled already.
    CARGO_TARGET_DIR=$PWD/target cargo build --release --bin unwrapd --manifest-path "$source/Cargo.toml"
    mkdir -p target/older
    mv target/release/unwrapd "$older"
fi
cargo bench --bench update -- --older "$older" "$@"
