#!/usr/bin/env python3
"""Solves every reference problem with `unwrapd solve` and compares with the results of the authors' code.

    python3 tests/bench/reference.py --reference DIR --checker CHECKER --unwrapd PROGRAM [--method levenberg] [NAME...]

DIR holds `index.json` and `problems/`, CHECKER is a program `CHECKER PROBLEM POSITIONS` that prints energies, residual
and inverted elements of positions as JSON: our own figures are not trusted. Prints a row per problem and a summary;
exits with 1 if a barrier let an element invert or a problem that the authors' code solves was not.
"""
import argparse
import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path


def solve(program, problem, method, folder):
    """Our report and positions of one problem; exit status 0 or a failure."""
    positions, report = folder / "x.txt", folder / "r.json"
    command = [program, "solve", problem, "-o", positions, "--report", report, "--method", method]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 4):
        raise RuntimeError(done.stderr.strip())
    return json.loads(report.read_text()), positions


def mean_edge(problem):
    """Mean edge length of the rest mesh's elements, over every pair of corners."""
    description = json.loads(problem.read_text())
    path = problem.parent / description["mesh"]
    words = path.read_text().split()
    if path.suffix == ".off":
        n, m, corners, at = int(words[1]), int(words[2]), 3, 4
    else:
        n, m, corners, at = int(words[0]), int(words[1]), 4, 2
    x = [[float(w) for w in words[at + 3 * i:at + 3 * i + 3]] for i in range(n)]
    at, stride = at + 3 * n, corners + (path.suffix == ".off")
    total, count = 0.0, 0
    for e in range(m):
        ids = [int(w) for w in words[at + stride * e:at + stride * (e + 1)]][-corners:]
        for i in range(corners):
            total += math.dist(x[ids[i]], x[ids[i - 1]])
            count += 1
    return total / count


def judged(case, ours, report, tolerance):
    """Faults of our result by the rule of the case, and our energy over theirs."""
    faults = []
    has_barrier = case["barrier"] != "none"
    if has_barrier and (ours["flips"] or ours["below_eps"] or report["smallest_ever"] <= 0):
        faults.append("INVERTED")
    if ours["pos_err_sq"] > max(case["pos_err_sq"], tolerance):
        faults.append("targets missed")
    theirs = case["E_total"] if has_barrier else case["E_def"]
    energy = ours["E_def"] + (ours["E_bar"] if has_barrier else 0.0)
    excess = (energy - theirs) / abs(theirs)
    if case["compare"] == "energy" and excess > 0.01:
        faults.append("energy above")
    return faults, energy, excess


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--reference", type=Path, required=True)
    parser.add_argument("--checker", required=True)
    parser.add_argument("--unwrapd", required=True)
    parser.add_argument("--method", default="projected")
    parser.add_argument("names", nargs="*", help="only problems whose name contains one of these")
    arguments = parser.parse_args()
    cases = json.loads((arguments.reference / "index.json").read_text())["cases"]
    if arguments.names:
        cases = [c for c in cases if any(name in c["name"] for name in arguments.names)]
    ratios, inverted, missed, above, solved = [], [], [], [], []
    print("problem | elements | it | fact | s (set-up) | energy | residual | inverted | theirs: it | fact | s | energy | s ratio | remark")
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            problem = arguments.reference / case["problem"]
            report, positions = solve(arguments.unwrapd, problem, arguments.method, Path(folder))
            checked = subprocess.run([sys.executable, arguments.checker, problem, positions], capture_output=True, text=True)
            ours = json.loads(checked.stdout)
            faults, energy, excess = judged(case, ours, report, 1e-8 * mean_edge(problem) ** 2)
            theirs = case["cpu_init_s"] + case["cpu_loop_s"]
            ratio = theirs / report["solve_seconds"]
            if theirs > 0.1:
                ratios.append(ratio)
            if "INVERTED" in faults:
                inverted.append(case["name"])
            if "targets missed" in faults:
                missed.append((case["name"], case["compare"]))
            elif case["compare"] == "unsolved" and not faults:
                solved.append(case["name"])
            if "energy above" in faults:
                above.append(f"{case['name']} {100 * excess:+.1f} %")
            print(f"{case['name']} | {case['elements']} | {report['iterations']} | {report['factorizations']} | "
                  f"{report['solve_seconds']:.3f} ({report['setup_seconds']:.3f}) | {energy:.6g} ({100 * excess:+.2f} %) | "
                  f"{ours['pos_err_sq']:.1e} | {ours['flips']} | {case['iterations']} | {case['n_factor']} | {theirs:.3f} | "
                  f"{case['E_total'] if case['barrier'] != 'none' else case['E_def']:.6g} | {ratio:.1f} | "
                  f"{', '.join(faults) or report['status']} [{case['compare']}]", flush=True)
    unsolved = sum(case["compare"] == "unsolved" for case in cases)
    print(f"\n{len(cases)} problems; inverted: {inverted or 'none'}; energy more than 1 % above: {above or 'none'}; "
          f"targets missed: {missed or 'none'}; solved {len(solved)} of the {unsolved} that the authors' code leaves unsolved")
    if ratios:
        print(f"seconds, theirs over ours, where theirs are above 0.1: median {statistics.median(ratios):.1f} of {len(ratios)}")
    return 1 if inverted or any(rule != "unsolved" for _, rule in missed) else 0


if __name__ == "__main__":
    sys.exit(main())
