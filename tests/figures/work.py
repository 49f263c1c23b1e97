"""Problem files and commands of one figure: written, run with `unwrapd`, read back."""
import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import numpy as np

# Exit status of `solve`: 0 done, 4 inverted elements (only without a barrier), 5 targets that are out of reach.
DONE, INVERTED, UNREACHABLE, ENDED_EARLY = 0, 4, 5, 6


@dataclass
class Run:
    """What one command wrote."""
    x: np.ndarray
    report: dict
    trace: list
    frames: list


class Failed(Exception):
    """A figure is not what its caption says."""


def require(holds, what):
    if not holds:
        raise Failed(what)


class Work:
    """A folder and a program. The same command on the same files is run once."""

    def __init__(self, program, folder):
        self.program, self.folder, self.known, self.commands = Path(program).resolve(), Path(folder), {}, []
        self.folder.mkdir(parents=True, exist_ok=True)

    def run(self, *words, statuses=(DONE,), flags=("--quiet", "--force")):
        command = [str(self.program), *map(str, words), *flags]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        require(done.returncode in statuses, f"{' '.join(map(str, words))}: exit {done.returncode}: {done.stderr.strip()}")
        self.commands.append("unwrapd " + " ".join(map(str, words)))

    def named(self, name, content):
        """A file with this content, under this name, or with a number behind if another has the name."""
        path, number = self.folder / name, 1
        data = content if isinstance(content, bytes) else content.encode()
        while path.exists() and path.read_bytes() != data:
            number += 1
            path = self.folder / f"{Path(name).stem}-{number}{Path(name).suffix}"
        path.write_bytes(data)
        return path.name

    def mesh(self, name, x, elements):
        """An .off file of triangles or a .tet file of tetrahedra."""
        x = np.column_stack([x, np.zeros(len(x))]) if x.shape[1] == 2 else x
        corners = elements.shape[1]
        lead = "3 " if corners == 3 else ""
        head = f"OFF\n{len(x)} {len(elements)} 0" if corners == 3 else f"{len(x)} {len(elements)}"
        rows = [" ".join(map(repr, row)) for row in x.tolist()] + [lead + " ".join(map(str, row)) for row in elements.tolist()]
        return self.named(name + (".off" if corners == 3 else ".tet"), head + "\n" + "\n".join(rows) + "\n")

    def solve(self, name, mesh, pull, energy, barrier="spline", *options, sequence=(), statuses=(DONE, INVERTED), **keys):
        """One problem: `mesh` is (name, positions, elements), `pull` maps vertices to targets."""
        vertices = sorted(pull)
        keys = {"mesh": self.mesh(*mesh), "energy": energy, "barrier": barrier, "handles": [int(v) for v in vertices],
                "targets": [np.asarray(pull[v], float).tolist() for v in vertices], "units": "normalized", **keys}
        if len(sequence):
            keys["sequence"] = [[np.asarray(step[v], float).tolist() for v in vertices] for step in sequence]
        file = self.named(f"{name}.json", json.dumps(keys))
        if (file, options) not in self.known:
            stem = Path(file).stem
            self.run("solve", file, "-o", f"{stem}.txt", "--report", f"{stem}-report.json", "--trace", f"{stem}.csv", *options,
                     statuses=statuses)
            self.known[file, options] = self.read(stem, options, mesh[1].shape[1])
        return self.known[file, options]

    def read(self, stem, options, dimension):
        frames = []
        if "--frames" in options:
            folder = self.folder / options[options.index("--frames") + 1]
            frames = [positions(path)[:, :dimension] for path in sorted(folder.iterdir())]
        report = json.loads((self.folder / f"{stem}-report.json").read_text())
        return Run(positions(self.folder / f"{stem}.txt")[:, :dimension], report, table(self.folder / f"{stem}.csv"), frames)


def positions(path):
    return np.array([[float(word) for word in line.split()] for line in path.read_text().splitlines()])


def table(path):
    """The rows of a CSV file."""
    header, *rows = [line.split(",") for line in path.read_text().splitlines()]
    return [dict(zip(header, map(float, row))) for row in rows]


def read_off(path):
    """Positions and triangles."""
    rows = [line.split() for line in path.read_text().splitlines()]
    n, m = int(rows[1][0]), int(rows[1][1])
    return np.array(rows[2:2 + n], float), np.array(rows[2 + n:2 + n + m], int)[:, 1:]


def read_obj(path):
    """Positions, triangles, and of every corner its place in the texture, or none."""
    x, uv, corners = [], [], []
    for row in map(str.split, path.read_text().splitlines()):
        if row[:1] == ["v"]:
            x.append(row[1:4])
        elif row[:1] == ["vt"]:
            uv.append(row[1:3])
        elif row[:1] == ["f"]:
            corners.append([[int(word or 0) - 1 for word in (corner.split("/") + ["0"])[:2]] for corner in row[1:4]])
    corners = np.array(corners)
    return np.array(x, float), corners[..., 0], np.array(uv, float)[corners[..., 1]] if uv else None
