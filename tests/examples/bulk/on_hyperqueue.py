"""Unwraps a folder of meshes on HyperQueue, whose engine is in its Python wheel.

    pip install hyperqueue
    python on_hyperqueue.py FOLDER DIR [--shards N] [--workers N] [--unwrapd PATH] [OPTION...]

Each task is one shard. Other options are those of `unwrapd batch`. What a lost task left undone
is done by the last run, without a shard, which writes DIR/summary.csv and decides the exit
status. After a crash, run the script again.
"""

import argparse
import subprocess
import sys
from pathlib import Path

from hyperqueue import Job, LocalCluster
from hyperqueue.cluster import WorkerConfig


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("dir", type=Path)
    parser.add_argument("--shards", type=int, default=20)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--unwrapd", default="unwrapd")
    given, options = parser.parse_known_args()

    # Tasks run elsewhere: paths have to be absolute.
    batch = [given.unwrapd, "batch", str(given.folder.resolve()), "-o", str(given.dir.resolve())]
    batch += options
    job = Job(max_fails=None)
    for shard in range(1, given.shards + 1):
        job.program(
            [*batch, "--jobs", "1", "--shard", f"{shard}/{given.shards}"], stdout=None, stderr=None
        )
    with LocalCluster() as cluster:
        for _ in range(given.workers):
            cluster.start_worker(WorkerConfig(cores=1))
        client = cluster.client()
        client.wait_for_jobs([client.submit(job)], raise_on_error=False)
    return subprocess.run(batch).returncode


if __name__ == "__main__":
    sys.exit(main())
