"""Unwraps a folder of meshes on Ray.

    pip install ray
    python on_ray.py FOLDER DIR [--shards N] [--unwrapd PATH] [OPTION...]

Each task is one shard. Other options are those of `unwrapd batch`. Ray runs the task of a lost
worker again, which goes on where that one was. The last run, without a shard, does what is still
missing, writes DIR/summary.csv and decides the exit status.
"""

import argparse
import ctypes
import signal
import subprocess
import sys
from pathlib import Path

import ray


def end_with_worker() -> None:
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


@ray.remote(num_cpus=1, max_retries=3)
def unwrap(command: list[str]) -> int:
    return subprocess.run(command, capture_output=True, preexec_fn=end_with_worker).returncode


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("dir", type=Path)
    parser.add_argument("--shards", type=int, default=20)
    parser.add_argument("--unwrapd", default="unwrapd")
    given, options = parser.parse_known_args()

    # Every machine needs these paths: a shared file system.
    batch = [given.unwrapd, "batch", str(given.folder.resolve()), "-o", str(given.dir.resolve())]
    batch += options
    shards = [f"{shard}/{given.shards}" for shard in range(1, given.shards + 1)]
    ray.init(include_dashboard=False, log_to_driver=False)
    ray.get([unwrap.remote([*batch, "--jobs", "1", "--shard", shard]) for shard in shards])
    ray.shutdown()
    return subprocess.run(batch).returncode


if __name__ == "__main__":
    sys.exit(main())
