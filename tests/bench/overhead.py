#!/usr/bin/env python3
"""Small jobs through the service beside the same meshes through the command: processor time and bytes kept.

Each mesh is another sheet of hills. The service and the command take turns, so that both meet the same load of the machine. The
processor time is that of all processes: the service with the children that it waited for, and each command. Medians are of the
rounds; the server's start, and its first job, are left out.

    tests/bench/overhead.py --unwrapd target/release/unwrapd [--jobs 60] [--rounds 3]
"""

import argparse
import json
import math
import os
import resource
import statistics
import struct
import subprocess
import tempfile
import time
import urllib.request
from pathlib import Path

TICKS = os.sysconf("SC_CLK_TCK")


def sheet(phase, sides=6):
    """A GLB of a curved sheet: some 2 kB."""
    n = sides + 1
    at = lambda i, j: (i / sides, j / sides, 0.2 * math.sin(5 * i / sides + phase) * math.cos(4 * j / sides))
    points = [at(i, j) for i in range(n) for j in range(n)]
    faces = []
    for i in range(sides):
        for j in range(sides):
            a, b, c, d = i * n + j, i * n + j + 1, (i + 1) * n + j, (i + 1) * n + j + 1
            faces += [a, c, b, b, c, d]
    body = b"".join(struct.pack("<3f", *p) for p in points) + struct.pack(f"<{len(faces)}H", *faces)
    body += b"\0" * (-len(body) % 4)
    low, high = [min(c) for c in zip(*points)], [max(c) for c in zip(*points)]
    split = 12 * len(points)
    text = json.dumps({
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3", "min": low, "max": high},
            {"bufferView": 1, "componentType": 5123, "count": len(faces), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": split},
                        {"buffer": 0, "byteOffset": split, "byteLength": 2 * len(faces)}],
        "buffers": [{"byteLength": len(body)}],
    }).encode()
    text += b" " * (-len(text) % 4)
    total = 12 + 8 + len(text) + 8 + len(body)
    return (struct.pack("<4sII", b"glTF", 2, total) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(body), b"BIN\0") + body)


class Service:
    def __init__(self, unwrapd, data):
        self.process = subprocess.Popen(
            [unwrapd, "serve", "--listen", "127.0.0.1:0", "--data", data],
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.url = self.process.stdout.readline().split()[-1]

    def seconds(self):
        """Processor time of the service and of the children that it waited for."""
        stat = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(") ", 1)[1].split()
        return sum(int(field) for field in stat[11:15]) / TICKS

    def call(self, path, body=None):
        headers = {"content-type": "model/gltf-binary", "cache-control": "no-cache"}
        request = urllib.request.Request(self.url + path, body, headers)
        return json.loads(urllib.request.urlopen(request).read())

    def unwrap(self, meshes):
        ids = [self.call("/v1/jobs", mesh)["id"] for mesh in meshes]
        for job in ids:
            while (state := self.call(f"/v1/jobs/{job}?wait=30")["state"]) in ("queued", "running"):
                pass
            assert state == "succeeded", state


def command(unwrapd, meshes, folder):
    """Processor time of the command, a process per mesh."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    for index, mesh in enumerate(meshes):
        path = folder / f"{index}.glb"
        path.write_bytes(mesh)
        arguments = [unwrapd, "unwrap", "-q", path, "-o", folder / f"{index}.out.glb", "--report", folder / f"{index}.json"]
        subprocess.run(arguments, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--jobs", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=3)
    args = parser.parse_args()
    ratios = []
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "data"
        service = Service(args.unwrapd, data)
        try:
            service.unwrap([sheet(-1)])
            # The checksum of the program is read once.
            time.sleep(2)
            for turn in range(args.rounds):
                meshes = [sheet(turn + index / args.jobs) for index in range(args.jobs)]
                alone = command(args.unwrapd, meshes, Path(folder))
                before = service.seconds()
                service.unwrap(meshes)
                served = service.seconds() - before
                ratios.append(served / alone)
                print(f"command {alone:.2f} s, service {served:.2f} s: {served / alone:.2f} times")
            count = 1 + args.rounds * args.jobs
            kept = [path for path in (data / "blobs").rglob("*") if path.is_file()]
            size = sum(path.stat().st_size for path in kept) / count
            print(f"median {statistics.median(ratios):.2f} times; a job keeps {size / 1000:.1f} kB in {len(kept) / count:.1f} files")
        finally:
            service.process.terminate()
            service.process.wait()


main()
