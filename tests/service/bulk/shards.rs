//! Shards: a partition of the list, told by hand or by a scheduler.

use std::collections::BTreeMap;

use unwrapd::bulk::{ShardChoice, ShardError};

use super::Folders;
use crate::cli::{assert_status, last_error};

fn shard(text: &str, variables: &[(&str, &str)]) -> Result<(u64, u64), ShardError> {
    let variables: BTreeMap<&str, &str> = variables.iter().copied().collect();
    let choice: ShardChoice = text.parse()?;
    let shard = choice.resolved(|name| variables.get(name).map(|value| (*value).to_owned()))?;
    Ok((shard.number(), shard.count()))
}

#[test]
fn shards_are_told_by_hand_and_by_schedulers() {
    let kubernetes = &[("JOB_COMPLETION_INDEX", "2")][..];
    let aws = &[
        ("AWS_BATCH_JOB_ARRAY_INDEX", "2"),
        ("AWS_BATCH_JOB_ARRAY_SIZE", "8"),
    ];
    let slurm = |id, least, greatest, count| {
        [
            ("SLURM_ARRAY_TASK_ID", id),
            ("SLURM_ARRAY_TASK_MIN", least),
            ("SLURM_ARRAY_TASK_MAX", greatest),
            ("SLURM_ARRAY_TASK_COUNT", count),
        ]
    };
    assert_eq!(shard("3/8", &[]), Ok((3, 8)));
    assert_eq!(shard("3/8", aws), Ok((3, 8)));
    assert_eq!(shard("auto/8", kubernetes), Ok((3, 8)));
    assert_eq!(shard("auto", aws), Ok((3, 8)));
    assert_eq!(shard("auto", &slurm("7", "0", "7", "8")), Ok((8, 8)));
    // Only tasks 2 and 5 of 8 run again.
    let again = slurm("5", "2", "5", "2");
    assert_eq!(shard("auto/8", &again), Ok((6, 8)));
    let no_count = |name| Err(ShardError::NoCount(name));
    assert_eq!(shard("auto", &again), no_count("SLURM_ARRAY_TASK_ID"));
    let from_one = slurm("8", "1", "8", "8");
    assert_eq!(shard("auto", &from_one), no_count("SLURM_ARRAY_TASK_ID"));
    assert_eq!(shard("auto", kubernetes), no_count("JOB_COMPLETION_INDEX"));
    assert_eq!(shard("auto", &[]), Err(ShardError::NoIndex));
    for (text, variables, words) in [
        (
            "3",
            &[][..],
            "\"3\" is not a shard: expected I/N, auto or auto/N",
        ),
        ("0/8", &[], "\"0\" is not a number from 1 on"),
        ("1/many", &[], "\"many\" is not a number"),
        ("auto/0", &[], "\"0\" is not a number from 1 on"),
        ("9/8", &[], "there is no shard 9 of 8"),
        (
            "auto/2",
            kubernetes,
            "JOB_COMPLETION_INDEX is 2, but with 2 shards",
        ),
        (
            "auto/8",
            &[("JOB_COMPLETION_INDEX", "x")],
            "JOB_COMPLETION_INDEX is \"x\"",
        ),
    ] {
        let error = shard(text, variables).expect_err(text).to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn shards_do_every_asset_once_and_a_whole_run_sums_them_up() {
    let folders = Folders::of(7);
    let mut seen = BTreeMap::new();
    for (arguments, variable, name) in [
        (["--shard", "1/3"], ("UNUSED", ""), "summary-1-of-3.csv"),
        (
            ["--shard", "auto/3"],
            ("JOB_COMPLETION_INDEX", "1"),
            "summary-2-of-3.csv",
        ),
        (
            ["--shard", "auto/3"],
            ("SLURM_ARRAY_TASK_ID", "2"),
            "summary-3-of-3.csv",
        ),
    ] {
        let mut command = folders.command(&arguments);
        let run = command.env(variable.0, variable.1).output();
        assert_status(&run.expect("the binary runs"), 0);
        for (input, row) in folders.summary(name) {
            assert!(seen.insert(input, row).is_none(), "done twice");
        }
    }
    assert_eq!(seen.len(), 7);
    let whole = folders.batch(&["--summary-only"]);
    assert_status(&whole, 0);
    assert_eq!(folders.summary("summary.csv"), seen);
    let before = folders.written();
    assert_status(&folders.batch(&[]), 0);
    assert_eq!(folders.written(), before);
    assert_eq!(folders.summary("summary.csv"), seen);
}

#[test]
fn what_no_shard_did_is_missing_in_the_summary() {
    let folders = Folders::of(4);
    assert_status(&folders.batch(&["--shard", "2/2"]), 0);
    let whole = folders.batch(&["--summary-only"]);
    assert_status(&whole, 4);
    assert!(last_error(&whole).contains("2 of 4 assets are not accepted"));
    assert_eq!(
        folders.summary("summary.csv")["000.obj"]["status"],
        "missing"
    );
    // More shards than assets: some have nothing to do.
    assert_status(&folders.batch(&["--shard", "9/9"]), 0);
    assert!(folders.summary("summary-9-of-9.csv").is_empty());
}

#[test]
fn a_task_of_an_array_without_a_shard_is_warned() {
    let folders = Folders::of(1);
    let mut command = folders.command(&["--summary-only"]);
    let run = command.env("SLURM_ARRAY_TASK_ID", "0").output();
    let run = run.expect("the binary runs");
    let said = String::from_utf8_lossy(&run.stderr).into_owned();
    assert!(
        said.contains("without --shard auto every task does all assets"),
        "{said}"
    );
    let run = folders.batch(&["--shard", "auto"]);
    assert_status(&run, 2);
    assert!(last_error(&run).contains("--shard: auto requires one of the variables"));
}
