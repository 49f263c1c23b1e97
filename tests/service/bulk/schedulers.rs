//! The examples for schedulers that exist: run where they can be, judged by validators otherwise.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Instant;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use super::{Folders, QUICK, Writing};
use crate::cli::assert_status;
use crate::places;
use crate::server::SOON;

const PROGRAM: &str = env!("CARGO_BIN_EXE_unwrapd");

fn example(name: &str) -> PathBuf {
    places::repository("tests/examples/bulk").join(name)
}

fn python() -> Command {
    Command::new(places::python())
}

fn output(command: &mut Command) -> Output {
    command.output().expect("a program")
}

/// The records of written outputs that were seen: one that is written anew is work done twice.
struct Watch<'a> {
    folders: &'a Folders,
    seen: BTreeMap<String, Writing>,
}

impl Watch<'_> {
    fn look(&mut self) -> usize {
        for (name, writing) in self.folders.written() {
            // A shard that is killed with its worker may still record that the worker was lost: that work is done again.
            let record = || fs::read_to_string(self.folders.path("out").join(&name));
            if name.starts_with(".unwrapd/records")
                && record().is_ok_and(|text| text.contains(r#""status": "written""#))
            {
                let first = *self.seen.entry(name.clone()).or_insert(writing);
                assert_eq!(first, writing, "{name} was done twice");
            }
        }
        self.seen.len()
    }

    /// Waits for so many records.
    fn wait_for(&mut self, count: usize) {
        let start = Instant::now();
        while self.look() < count {
            assert!(start.elapsed() < 10 * SOON, "too slow");
            std::thread::yield_now();
        }
    }
}

/// Process ids of shards in work.
fn shards(folders: &Folders) -> Vec<i32> {
    let input = folders.text("in");
    let entries = fs::read_dir("/proc").expect("/proc");
    let names = entries.filter_map(|entry| entry.ok()?.file_name().to_str()?.parse().ok());
    let is_shard = |pid: &i32| {
        let command = fs::read(format!("/proc/{pid}/cmdline")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command).into_owned();
        command.starts_with(PROGRAM) && command.contains(&input) && command.contains("--shard")
    };
    names.filter(is_shard).collect()
}

fn on_hyperqueue(folders: &Folders) -> Child {
    python()
        .arg(example("on_hyperqueue.py"))
        .args([folders.text("in"), folders.text("out")])
        .args(["--unwrapd", PROGRAM, "--shards", "16", "--workers", "2"])
        .args(QUICK)
        .current_dir(folders.path("tmp"))
        .env("TMPDIR", folders.path("tmp"))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("a Python")
}

#[test]
fn hyperqueue_loses_a_task_and_then_everything_and_all_is_there_once() {
    const COUNT: usize = 200;
    let folders = Folders::of(COUNT);
    fs::create_dir(folders.path("tmp")).expect("a folder");
    let mut watch = Watch {
        folders: &folders,
        seen: BTreeMap::new(),
    };
    let mut engine = on_hyperqueue(&folders);
    watch.wait_for(20);
    let task = *shards(&folders).first().expect("a task");
    // It may just have ended by itself: then the next one is hit.
    let _ = kill(Pid::from_raw(task), Signal::SIGKILL);
    watch.wait_for(80);
    // Server and workers are one process here.
    engine.kill().expect("it runs");
    engine.wait().expect("an end");
    let start = Instant::now();
    while !shards(&folders).is_empty() {
        assert!(start.elapsed() < SOON, "an orphan is left");
        std::thread::yield_now();
    }
    assert!(watch.look() < COUNT, "killed too late");
    assert!(!folders.path("out/summary.csv").exists());

    let mut engine = on_hyperqueue(&folders);
    watch.wait_for(COUNT);
    assert!(engine.wait().expect("an end").success());
    assert_eq!(watch.look(), COUNT);
    assert_eq!(folders.outputs().len(), COUNT);
    let summary = folders.summary("summary.csv");
    assert_eq!(summary.len(), COUNT);
    assert!(summary.values().all(|row| row["certified"] == "true"));
}

#[test]
fn the_kubernetes_job_is_valid_and_its_arguments_work() {
    let job = example("kubernetes.yaml");
    let validated = output(
        python()
            .args(["-m", "kubernetes_validate", "--strict"])
            .arg(&job),
    );
    assert_status(&validated, 0);
    let script = "import json, sys, yaml\njob = yaml.safe_load(open(sys.argv[1]))['spec']\n\
                  container = job['template']['spec']['containers'][0]\n\
                  print(json.dumps([str(job['completions']), *container['args']]))";
    let printed = output(python().args(["-c", script]).arg(&job));
    assert_status(&printed, 0);
    let words: Vec<String> = serde_json::from_slice(&printed.stdout).expect("JSON");
    let folders = Folders::of(2);
    let here = |word: &String| word.replace("/assets", &folders.text(""));
    for index in ["0", "1", "99"] {
        let mut command = Command::new(PROGRAM);
        command.args(words[1..].iter().map(here)).args(QUICK);
        assert_status(&output(command.env("JOB_COMPLETION_INDEX", index)), 0);
    }
    assert_eq!(folders.outputs(), ["000.glb", "001.glb"]);
    assert!(words.contains(&format!("auto/{}", words[0])), "{words:?}");
}

#[test]
fn the_slurm_script_is_valid_and_runs() {
    let script = example("slurm.sbatch");
    assert_status(&output(Command::new("shellcheck").arg(&script)), 0);
    let folders = Folders::of(2);
    let own = Path::new(PROGRAM).parent().expect("a folder");
    let path = format!(
        "{}:{}",
        own.display(),
        std::env::var("PATH").expect("a path")
    );
    for index in ["0", "1", "99"] {
        let mut command = Command::new("bash");
        command
            .arg(&script)
            .args([folders.text("in"), folders.text("out")]);
        command.env("PATH", &path).env("SLURM_ARRAY_TASK_ID", index);
        assert_status(&output(&mut command), 0);
    }
    assert_eq!(folders.outputs(), ["000.glb", "001.glb"]);
}
