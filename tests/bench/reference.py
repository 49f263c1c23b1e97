#!/usr/bin/env python3
"""Solves every reference problem with `unwrapd solve` and compares with the results of the authors' code.

    python3 tests/bench/reference.py --reference DIR --checker CHECKER --unwrapd PROGRAM [--method levenberg] [NAME...]

DIR holds `index.json` and `problems/`, CHECKER is a program `CHECKER PROBLEM POSITIONS` that prints energies, residual
and inverted elements of positions as JSON: our own figures are not trusted. Prints a row per problem and a summary;
exits with 1 if a barrier let an element invert or a problem that the authors' code solves was not.
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
    print("problem | elements | it | fact | CPU s | energy | residual | inverted | theirs: it | fact | CPU s | energy | ratio | remark")
    with tempfile.TemporaryDirectory() as folder:
        for case in cases:
            problem = arguments.reference / case["problem"]
            report, positions, seconds = solve(arguments.unwrapd, problem, Path(folder), "--method", arguments.method)
            checked = subprocess.run([sys.executable, arguments.checker, problem, positions], capture_output=True, text=True)
            ours = json.loads(checked.stdout)
            faults, energy, excess = judged(case, ours, report, 1e-8 * mean_edge(problem) ** 2)
            theirs = case["cpu_init_s"] + case["cpu_loop_s"]
            ratio = theirs / seconds
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
                  f"{seconds:.3f} | {energy:.6g} ({100 * excess:+.2f} %) | "
                  f"{ours['pos_err_sq']:.1e} | {ours['flips']} | {case['iterations']} | {case['n_factor']} | {theirs:.3f} | "
                  f"{case['E_total'] if case['barrier'] != 'none' else case['E_def']:.6g} | {ratio:.1f} | "
                  f"{', '.join(faults) or report['status']} [{case['compare']}]", flush=True)
    unsolved = sum(case["compare"] == "unsolved" for case in cases)
    print(f"\n{len(cases)} problems; inverted: {inverted or 'none'}; energy more than 1 % above: {above or 'none'}; "
          f"targets missed: {missed or 'none'}; solved {len(solved)} of the {unsolved} that the authors' code leaves unsolved")
    if ratios:
        print(f"processor seconds, theirs (set-up and iterations) over ours (the whole process), where theirs are above 0.1: median {statistics.median(ratios):.1f} of {len(ratios)}")
    return 1 if inverted or any(rule != "unsolved" for _, rule in missed) else 0


if __name__ == "__main__":
    sys.exit(main())
