"""Memory that small calls of the package `unwrapd` leave behind, and what each costs.

    python tests/bench/leaks.py [--calls N]

Each call is made N times, by default 10,000 times, after a warm-up of a tenth of that. Prints the milliseconds of a call on the wall
and of the processor, and by how many kilobytes the process grew from the first half of the calls to the second: asked at most
2,000, however many calls there are.
"""

import argparse
import ctypes
import gc
import pathlib
import resource
import time

import numpy as np

import unwrapd

#: Kilobytes that a process may grow by: pools of allocators settle late.
MOST = 2000
#: Looks at memory in each half of the calls, whose least counts: threads that end late move a single one by 2,000 kB.
LOOKS = 30

VERTICES = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.7]])
FACES = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
PLANE = VERTICES[:, :2].copy()
HENCKY = "log(s1)^2 + log(s2)^2"


def calls():
    """Name and function of each."""
    uvs = unwrapd.unwrap(VERTICES, FACES).corner_uvs
    problem = unwrapd.Problem(PLANE, FACES, energy=HENCKY)
    session = unwrapd.Session(PLANE, FACES, energy=HENCKY)
    session.add({"vertex": 0, "to": (0, 0)})
    tip = session.add({"vertex": 2, "to": (1, 1)})
    targets = iter(range(10**9))

    def drag():
        session.move(tip, (1.2, 1 + 0.1 * (next(targets) % 2)))
        session.settle()

    def refused(call):
        try:
            call()
        except unwrapd.InvalidInput:
            return
        raise AssertionError("it was taken")

    def look():
        problem.energy(), problem.gradient(), problem.hessian(), problem.elements()

    return {
        "a refused mesh": lambda: refused(lambda: unwrapd.unwrap(VERTICES, FACES + 4)),
        "verify": lambda: unwrapd.verify(VERTICES, FACES, uvs),
        "Problem": lambda: unwrapd.Problem(PLANE, FACES, energy=HENCKY),
        "a refused formula": lambda: refused(lambda: unwrapd.Problem(PLANE, FACES, energy="s1 +")),
        "energy, gradient, hessian, elements": look,
        "solve": lambda: problem.solve({0: (0, 0), 2: (1.3, 1.1)}, callback=lambda iterate: iterate.x),
        "Session.move, settle": drag,
        "unwrap": lambda: unwrapd.unwrap(VERTICES, FACES, progress=lambda progress: None),
    }


def resident():
    """Kilobytes of this process, without free ones that the allocator keeps."""
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() // 1024


def growth(call, n_calls):
    """Kilobytes, and milliseconds of a call on the wall and of the processor."""
    for _ in range(max(n_calls // 10, 20)):
        call()
    wall, processor, looks = time.perf_counter(), time.process_time(), []
    for n_done in range(1, n_calls + 1):
        call()
        if 2 * LOOKS * n_done >= n_calls * (len(looks) + 1):
            looks.append(resident())
    wall, processor = time.perf_counter() - wall, time.process_time() - processor
    return min(looks[LOOKS:]) - min(looks[:LOOKS]), 1e3 * wall / n_calls, 1e3 * processor / n_calls


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--calls", type=int, default=10_000)
    n_calls = parser.parse_args().calls
    for name, call in calls().items():
        grown, wall, processor = growth(call, n_calls)
        print(
            f"{name}: {n_calls} calls of {wall:.2f} ms, {processor:.2f} ms of the processor; "
            f"asked <= {MOST} kB more, got {grown} kB",
            flush=True,
        )


if __name__ == "__main__":
    main()
