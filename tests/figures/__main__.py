"""Redraws the figures of the paper, each under its own number, and checks that each is what its caption says.

    python tests/figures --unwrapd BIN --out DIR [NUMBER...]      draws, with all files and commands of a figure in DIR/NN
    python tests/figures --unwrapd BIN --check [NUMBER...]        checks what was computed, without pictures
    python tests/figures --unwrapd BIN --faults [NUMBER...]       plants faults, each of which the check has to reject
    python tests/figures --unwrapd BIN --out DIR --sheet P.png    draws all and puts them on one sheet

Needs numpy and pillow.
"""
import argparse
import sys
import tempfile
import time
from pathlib import Path

from catalog import FIGURES
from work import Failed, Work


def parsed():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("numbers", nargs="*", type=int, metavar="NUMBER")
    parser.add_argument("--unwrapd", required=True, type=Path)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--faults", action="store_true")
    parser.add_argument("--sheet", type=Path)
    return parser.parse_args()


def checked(figure, work):
    """What was made, unless it is not what the caption says."""
    made = figure.make(work, None)
    print(f"{figure.number:2} {figure.name}: {figure.check(made)}", flush=True)
    return made


def faults_pass(figure, work):
    """The planted faults that the check does not reject."""
    passed = []
    for fault in figure.faults:
        try:
            figure.check(figure.make(work, fault))
            passed.append(fault)
        except Failed as error:
            print(f"{figure.number:2} {figure.name}, {fault}: rejected: {error}", flush=True)
    return passed


def drawn(figure, made, work, out):
    picture = figure.draw(made)
    picture.save(out / f"figure-{figure.number:02}.png")
    (work.folder / "commands.txt").write_text("\n".join(work.commands) + "\n")
    return picture


def main():
    arguments = parsed()
    figures = [figure for figure in FIGURES if not arguments.numbers or figure.number in arguments.numbers]
    bad, pictures = [], {}
    with tempfile.TemporaryDirectory() as temporary:
        out = (arguments.out or Path(temporary)).resolve()
        for figure in figures:
            begin, work = time.time(), Work(arguments.unwrapd, out / f"{figure.number:02}")
            try:
                made = checked(figure, work)
                if arguments.faults:
                    bad += [f"{figure.number}: {fault}: not rejected" for fault in faults_pass(figure, work)]
            except Failed as error:
                bad.append(f"{figure.number}: {error}")
                continue
            if arguments.out and not arguments.check:
                pictures[figure] = drawn(figure, made, work, out)
            print(f"   {time.time() - begin:.1f} s", file=sys.stderr, flush=True)
    if arguments.sheet:
        from sheet import contact
        contact(pictures).save(arguments.sheet, optimize=True)
    for line in bad:
        print(line, file=sys.stderr)
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
