#!/usr/bin/env python3
"""Solves every reference problem with `unwrapd solve` and compares with the results of the authors' code.

    python3 tests/bench/reference.py --reference DIR --checker CHECKER --unwrapd PROGRAM [--method levenberg] [NAME...]

DIR holds `index.json` and `problems/`, CHECKER is a program `CHECKER PROBLEM POSITIONS` that prints energies, residual
and inverted elements of positions as JSON: our own figures are not trusted. Prints a row per problem and a summary. A problem
whose energy ends more than 1 % above theirs is in another minimum: it is solved again with `--search`, in a row of its own.
Exits with 1 if a barrier let an element invert, a problem that the authors' code solves was not, or one stays above.
"""
import argparse
import json
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from paper.problems import mean_edge, solve


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


class Bench:
    """What is run with, and what came of it."""

    def __init__(self, arguments, folder):
        self.arguments, self.folder = arguments, folder
        self.ratios, self.inverted, self.missed, self.above, self.solved, self.searched = [], [], [], [], [], []

    def row(self, case, *options):
        """Solves a problem, prints its row and returns its faults, its energy over theirs and its CPU seconds over theirs."""
        problem = self.arguments.reference / case["problem"]
        report, positions, seconds = solve(self.arguments.unwrapd, problem, self.folder, "--method", self.arguments.method, *options)
        checked = subprocess.run([sys.executable, self.arguments.checker, problem, positions], capture_output=True, text=True, check=True)
        ours = json.loads(checked.stdout)
        faults, energy, excess = judged(case, ours, report, 1e-8 * mean_edge(problem) ** 2)
        theirs = case["cpu_init_s"] + case["cpu_loop_s"]
        name = " ".join((case["name"], *options))
        print(f"{name} | {case['elements']} | {report['iterations']} | {report['factorizations']} | "
              f"{seconds:.3f} | {energy:.6g} ({100 * excess:+.2f} %) | "
              f"{ours['pos_err_sq']:.1e} | {ours['flips']} | {case['iterations']} | {case['n_factor']} | {theirs:.3f} | "
              f"{case['E_total'] if case['barrier'] != 'none' else case['E_def']:.6g} | {theirs / seconds:.1f} | "
              f"{', '.join(faults) or report['status']} [{case['compare']}]", flush=True)
        return faults, excess, theirs / seconds

    def add(self, case):
        faults, excess, ratio = self.row(case)
        if case["cpu_init_s"] + case["cpu_loop_s"] > 0.1:
            self.ratios.append(ratio)
        if "INVERTED" in faults:
            self.inverted.append(case["name"])
        if "targets missed" in faults:
            self.missed.append((case["name"], case["compare"]))
        elif case["compare"] == "unsolved" and not faults:
            self.solved.append(case["name"])
        if "energy above" in faults:
            before, (faults, excess, _) = excess, self.row(case, "--search")
            self.searched.append(f"{case['name']} {100 * before:+.1f} % to {100 * excess:+.1f} %")
            if faults:
                self.above.append(case["name"])

    def conclude(self, cases):
        unsolved = sum(case["compare"] == "unsolved" for case in cases)
        print(f"\n{len(cases)} problems; inverted: {self.inverted or 'none'}; targets missed: {self.missed or 'none'}; "
              f"solved {len(self.solved)} of the {unsolved} that the authors' code leaves unsolved")
        print(f"energy more than 1 % above: {self.above or 'none'}, after a search for these: {self.searched or 'none'}")
        if self.ratios:
            print("processor seconds, theirs (set-up and iterations) over ours (the whole process), where theirs are above 0.1: "
                  f"median {statistics.median(self.ratios):.1f} of {len(self.ratios)}")
        return 1 if self.inverted or self.above or any(rule != "unsolved" for _, rule in self.missed) else 0


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
    print("problem | elements | it | fact | CPU s | energy | residual | inverted | theirs: it | fact | CPU s | energy | ratio | remark")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(arguments, Path(folder))
        for case in cases:
            bench.add(case)
    return bench.conclude(cases)


if __name__ == "__main__":
    sys.exit(main())
