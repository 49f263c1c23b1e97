"""Problem files of `unwrapd solve`: meshes read, problems written and run."""
import json
import math
import os
import statistics
import subprocess
from pathlib import Path


def run(command):
    """Runs a program and returns processor seconds of the whole process; exit status 0, 4 (no valid map), 5
    (targets not reached) or 6 (limit of iterations), or a failure."""
    child = subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    error = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in (0, 4, 5, 6):
        raise RuntimeError(f"{' '.join(map(str, command))}: {error.strip()}")
    return usage.ru_utime + usage.ru_stime


def solve(program, problem, folder, *options):
    """Our report, positions and processor seconds for one problem file."""
    positions, report = folder / "x.txt", folder / "r.json"
    seconds = run([program, "solve", problem, "-o", positions, "--report", report, *options])
    return json.loads(report.read_text()), positions, seconds


def read_mesh(path):
    """Vertices and elements of an .off, .obj, .tet or .mesh file; of the last, tetrahedra."""
    if path.suffix == ".mesh":
        return read_medit(path.read_text().split())
    rows = [line.split() for line in path.read_text().splitlines() if line.strip()]
    if path.suffix == ".obj":
        vertices = [[float(w) for w in row[1:4]] for row in rows if row[0] == "v"]
        return vertices, [[int(w.split("/")[0]) - 1 for w in row[1:4]] for row in rows if row[0] == "f"]
    is_off = path.suffix == ".off"
    n, m = (int(w) for w in rows[1 if is_off else 0][:2])
    begin = 2 if is_off else 1
    vertices = [[float(w) for w in row[:3]] for row in rows[begin:begin + n]]
    return vertices, [[int(w) for w in row][1 if is_off else 0:] for row in rows[begin + n:begin + n + m]]


def read_medit(words):
    """The same of the words of a .mesh file. Rows end in a reference."""
    def rows(name, width, number):
        begin = words.index(name) + 2
        count = int(words[begin - 1])
        each = (words[begin + (width + 1) * row:][:width] for row in range(count))
        return [[number(word) for word in row] for row in each]
    return rows("Vertices", 3, float), rows("Tetrahedra", 4, lambda word: int(word) - 1)


def read_positions(path):
    """One vertex per line."""
    return [[float(w) for w in line.split()] for line in path.read_text().splitlines()]


def mean_edge(problem):
    """Mean edge length of the rest mesh of a problem file, over every pair of neighboring corners."""
    x, elements = read_mesh(problem.parent / json.loads(problem.read_text())["mesh"])
    return statistics.fmean(math.dist(x[e[i]], x[e[i - 1]]) for e in elements for i in range(len(e)))


def variant(problem, path, **changes):
    """Writes a copy of a problem file with some keys changed, at `path`; returns `path`."""
    keys = json.loads(problem.read_text())
    for key in ("mesh", "initial"):
        if key in keys:
            keys[key] = os.path.relpath(Path(problem).parent / keys[key], path.parent)
    path.write_text(json.dumps(keys | changes))
    return path


def table(title, header, rows):
    """Prints rows as they come, as Markdown."""
    print(f"\n## {title}\n\n| {' | '.join(header)} |\n|{'|'.join('---' for _ in header)}|", flush=True)
    for row in rows:
        print(f"| {' | '.join(str(cell) for cell in row)} |", flush=True)
