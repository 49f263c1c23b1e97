#!/usr/bin/env python3
"""Draws every figure of the paper with our meshes, each from commands, and a page that shows them.

    python3 tests/bench/paper/gallery/build.py --unwrapd PROGRAM --shared DIR --out DIR [NUMBER ...]

`--shared` holds `reference/` (the problems) and `data/` (meshes), whose licenses `data/SOURCES.md` states: many of them do not
allow the pictures to be passed on. Needs numpy and matplotlib. Figures whose numbers are given are drawn anew; the page
shows all that are there. Exits with 1 if a command fails that should not.
"""
import argparse
import html
import json
import os
import shlex
import subprocess
import sys
import time
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from figures import FIGURES

ASSETS = Path(__file__).resolve().parents[3] / "assets"

PAGE = """<!doctype html>
<meta charset="utf-8"><title>Locally Injective Mappings: the figures, drawn by unwrapd</title>
<style>body{font:15px/1.45 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;color:#222}
img{max-width:100%%}figure{margin:2.5rem 0}pre{background:#f4f4f2;padding:.6rem;overflow-x:auto;font-size:12px}</style>
<h1>Locally Injective Mappings: the figures, drawn by unwrapd</h1>
<p>One figure for each of the paper's, with our meshes. Where a caption says so, what the paper's figure shows is not known
to us, and the nearest application stands in its place. Red triangles are inverted.</p>
%s
"""


def run(figure, folder, places):
    """Runs the figure's commands in its folder; prints and returns a line for each, with its processor seconds."""
    for name, content in figure.files.items():
        content = content(places) if callable(content) else content
        if isinstance(content, bytes):
            (folder / name).write_bytes(content)
        else:
            (folder / name).write_text(content if isinstance(content, str) else json.dumps(content))
    lines = []
    for command in figure.commands:
        words = [word.format(**places) for word in shlex.split(command.text)]
        child = subprocess.Popen([places["unwrapd"], *words], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        output = child.stdout.read()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
        if child.returncode not in command.exits:
            raise RuntimeError(f"unwrapd {command.text}: exit {child.returncode}: {output}")
        said = output.strip().splitlines()
        lines.append({"command": command.text, "says": said[-1] if said else "", "seconds": round(usage.ru_utime + usage.ru_stime, 2)})
        print(f"  {lines[-1]['seconds']:7.2f} s  {command.text}\n             {lines[-1]['says']}", flush=True)
    return lines


def draw(figure, folder):
    """The figure's panels side by side, in `figure.png`."""
    rows = -(-len(figure.panels) // figure.columns)
    canvas, axes = plt.subplots(rows, figure.columns, figsize=(3.6 * max(figure.columns, 2), (3.7 if figure.columns > 1 else 1.3) * rows), squeeze=False, layout="constrained")
    for axis in axes.flat[len(figure.panels):]:
        axis.axis("off")
    for axis, (title, panel) in zip(axes.flat, figure.panels.items()):
        remark = panel(axis, folder)
        axis.set_title(f"{title}\n{remark}" if remark else title, fontsize=9)
    canvas.savefig(folder / "figure.png", dpi=110)
    plt.close(canvas)


def section(figure, folder):
    """The figure's part of the page."""
    lines = json.loads((folder / "commands.json").read_text())
    commands = "\n".join(f"unwrapd {line['command']}    # {line['seconds']} s: {line['says']}" for line in lines)
    name = f"Figure {figure.number}"
    return (f"<figure id='f{figure.number}'><h2>{name}: {html.escape(figure.title)}</h2>"
            f"<img src='{folder.name}/figure.png' alt='{name}'><figcaption>{html.escape(figure.caption)}</figcaption>"
            f"<pre>{html.escape(commands)}</pre></figure>")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--unwrapd", required=True, type=Path)
    parser.add_argument("--shared", required=True, type=Path)
    parser.add_argument("--out", required=True, type=Path)
    parser.add_argument("numbers", nargs="*", type=int)
    args = parser.parse_args()
    places = {"unwrapd": args.unwrapd.resolve(), "assets": ASSETS,
              "data": args.shared.resolve() / "data", "reference": args.shared.resolve() / "reference"}
    failed = []
    for figure in FIGURES:
        if args.numbers and figure.number not in args.numbers:
            continue
        folder = args.out / f"{figure.number:02}"
        folder.mkdir(parents=True, exist_ok=True)
        print(f"figure {figure.number}: {figure.title}", flush=True)
        begin = time.monotonic()
        try:
            lines = run(figure, folder, places)
            draw(figure, folder)
            (folder / "commands.json").write_text(json.dumps(lines, indent=1))
        except Exception as error:  # One figure's failure does not cost the others.
            print(f"  FAILED: {error}", flush=True)
            failed.append(figure.number)
        print(f"  {time.monotonic() - begin:.0f} s", flush=True)
    there = [(f, args.out / f"{f.number:02}") for f in FIGURES]
    parts = [section(f, folder) for f, folder in there if (folder / "commands.json").exists()]
    (args.out / "index.html").write_text(PAGE % "\n".join(parts))
    if failed:
        sys.exit(f"failed: {failed}")


if __name__ == "__main__":
    main()
