#!/usr/bin/env python3
"""Kills a service on embedded storage again and again while it works through small jobs, and counts how they end.

Jobs are not to blame for the process that they run in: `worker_lost` must be 0, and every job must succeed.

    tests/bench/kills.py --unwrapd target/release/unwrapd [--jobs 150] [--every 4] FILE...
"""

import argparse
import collections
import json
import signal
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from pathlib import Path


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def asked(request, until):
    """The answer to a request, which is repeated while the service is away."""
    while True:
        try:
            with urllib.request.urlopen(request, timeout=10) as answer:
                return json.load(answer)
        except urllib.error.HTTPError:
            raise
        except OSError:
            if time.monotonic() > until:
                raise
            time.sleep(0.05)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--jobs", type=int, default=150)
    parser.add_argument("--every", type=float, default=4.0, metavar="SECONDS")
    parser.add_argument("--limit", type=float, default=900.0, metavar="SECONDS")
    parser.add_argument("files", nargs="+", type=Path)
    arguments = parser.parse_args()
    until = time.monotonic() + arguments.limit
    port = free_port()
    base = f"http://127.0.0.1:{port}"

    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.unwrapd, "serve", "--listen", f"127.0.0.1:{port}", "--data", folder]

        def start():
            return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        server = start()
        try:
            ids = []
            for number in range(arguments.jobs):
                file = arguments.files[number % len(arguments.files)]
                # Of another size each, so that no job is answered from the cache.
                url = f"{base}/v1/jobs?filename={file.name}&resolution={512 + number}"
                headers = {"Idempotency-Key": f"job-{number}"}
                request = urllib.request.Request(url, file.read_bytes(), headers)
                ids.append(asked(request, until)["id"])
            open_jobs, ended, n_kills = set(ids), [], 0
            next_kill = time.monotonic() + arguments.every
            while open_jobs and time.monotonic() < until:
                for job in sorted(open_jobs):
                    if time.monotonic() >= next_kill:
                        server.send_signal(signal.SIGKILL)
                        server.wait()
                        server = start()
                        n_kills += 1
                        next_kill = time.monotonic() + arguments.every
                    state = asked(f"{base}/v1/jobs/{job}", until)
                    if state["state"] not in ("queued", "running"):
                        open_jobs.discard(job)
                        code = (state.get("error") or {}).get("code")
                        ended.append((state["state"], code))
                time.sleep(0.2)
        finally:
            server.kill()
            server.wait()
    for (state, code), number in sorted(collections.Counter(ended).items(), key=str):
        print(f"{number} {state}" + (f" {code}" if code else ""))
    print(f"{n_kills} kills, {len(open_jobs)} jobs not ended")
    sys.exit(bool(open_jobs) or any(state != "succeeded" for state, _ in ended))


if __name__ == "__main__":
    main()
