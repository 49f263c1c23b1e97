"""Every file of some folders unwrapped, verified as it says itself, and unwrapped again.

    python3 tests/bench/again.py ../shared/data/gltf --old OLD/unwrapd

For each file: exit statuses of `unwrap`, plain `verify --bijective` of its output, `unwrap` of that output and `verify` of what came
of it; bytes of the input with what lies beside it and of both outputs; how many UV sets, accessors, buffer views and images each has;
and the Khronos validator's findings (errors, warnings, infos, hints, of these the unused objects that are no UV sets) of all three. With --old the same
by another program, such as one from before a change. At fault is a file of which an output cannot be verified, has an error or an
unused object more than its input, or more of anything than the output before it. The validator is that of tests/validator, after
`npm install` there.
"""
import argparse
import json
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path
from urllib.parse import unquote

HERE = Path(__file__).resolve().parent
COUNTED = ["accessors", "bufferViews", "images"]


def document(path):
    """The JSON of a glTF file."""
    data = path.read_bytes()
    if data[:4] == b"glTF":
        length, = struct.unpack("<I", data[12:16])
        data = data[20:20 + length]
    return json.loads(data.decode("utf-8-sig"))


def size(path):
    """Bytes of a glTF file with what it refers to."""
    try:
        root = document(path)
    except ValueError:
        return path.stat().st_size
    uris = {o.get("uri", "data:") for key in ("buffers", "images") for o in root.get(key, [])}
    beside = [path.parent / unquote(uri) for uri in uris if not uri.startswith("data:")]
    return path.stat().st_size + sum(f.stat().st_size for f in beside if f.is_file())


def counts(path):
    """UV sets and objects of a glTF file."""
    root = document(path)
    primitives = [p for mesh in root.get("meshes", []) for p in mesh["primitives"]]
    sets = sum(name.startswith("TEXCOORD_") for p in primitives for name in p.get("attributes", {}))
    return [sets, *(len(root.get(key, [])) for key in COUNTED)]


def validated(paths):
    """What the validator finds in each file; nothing for those it cannot read."""
    done = subprocess.run(["node", "validate.mjs", "--counts"], cwd=HERE.parent / "validator", text=True,
                          input="\n".join(map(str, paths)), capture_output=True, check=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def status(program, limit, *arguments):
    try:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return None
    return done.returncode


def chain(program, path, folder, options, limit):
    """Exit statuses of the four steps and the files that were written."""
    folder.mkdir(parents=True)
    first, second = folder / "first.glb", folder / "second.glb"
    steps = [(("unwrap", path, "-o", first, *options), first), (("verify", first, "--bijective"), None),
             (("unwrap", first, "-o", second, *options), second), (("verify", second, "--bijective"), None)]
    statuses, written = [], []
    for arguments, output in steps:
        statuses.append(status(program, limit, *arguments))
        if output is not None and statuses[-1] != 0:
            break
        written += [output] if output else []
    return statuses, written


def row(path, statuses, written, findings):
    files = [path, *written]
    return {"file": str(path), "exits": statuses, "bytes": [size(f) for f in files],
            "counts": [counts(f) for f in files], "findings": findings}


def faults(row):
    if row["exits"][0] != 0:
        return []
    found = [f"exits {row['exits']}"] if any(row["exits"]) else []
    for before, after in zip(row["counts"][1:], row["counts"][2:]):
        names = ["UV sets", *COUNTED]
        found += [f"{b - a} more {name}" for name, a, b in zip(names, before, after) if b > a]
    known = [f for f in row["findings"] if f is not None]
    if len(known) == len(row["findings"]):
        found += [f"{f[0] - known[0][0]} more errors" for f in known[1:] if f[0] > known[0][0]]
        found += [f"{f[4] - known[0][4]} more unused" for f in known[1:] if f[4] > known[0][4]]
    return found


def survey(program, files, options, limit):
    """A row for each file, printed as it comes."""
    folder = Path(tempfile.mkdtemp(prefix="again"))
    chains = []
    for number, path in enumerate(files):
        chains.append((path, *chain(program, path, folder / str(number), options, limit)))
    findings = iter(validated([f for path, _, written in chains for f in (path, *written)]))
    rows = [row(path, statuses, written, [next(findings) for _ in range(1 + len(written))])
            for path, statuses, written in chains]
    for r in rows:
        texts = [" ".join(f"{b:9}" for b in r["bytes"]), " > ".join("/".join(map(str, c)) for c in r["counts"]),
                 " > ".join("-" if f is None else "/".join(map(str, f)) for f in r["findings"])]
        name = "/".join(Path(r["file"]).parts[-2:])
        print(f"{name:50} {r['exits']}  {'  '.join(texts)}  {'; '.join(faults(r))}", flush=True)
    done = [r for r in rows if len(r["bytes"]) == 3]
    total = [sum(r["bytes"][k] for r in done) for k in range(3)]
    grown = sum(r["bytes"][2] > r["bytes"][1] for r in done)
    print(f"{program}: {len(rows)} files, {sum(r['exits'][0] == 0 for r in rows)} unwrapped, "
          f"{sum(r['exits'][1:] == [0, 0, 0] for r in rows)} verified and unwrapped again, {sum(bool(faults(r)) for r in rows)} at "
          f"fault; bytes {total[0]} > {total[1]} > {total[2]}, {grown} of {len(done)} grow when unwrapped again")
    shutil.rmtree(folder)
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("inputs", nargs="+", type=Path)
    parser.add_argument("--unwrapd", default="target/release/unwrapd")
    parser.add_argument("--old", help="another program to be measured first")
    parser.add_argument("--options", nargs="*", default=[], help="of `unwrap`, without their dashes, as in rebake")
    parser.add_argument("--without", nargs="*", default=[], help="names of files to leave out")
    parser.add_argument("--limit", type=float, default=300, help="seconds after which a step is given up")
    parser.add_argument("--json", type=Path, help="where to write the rows")
    arguments = parser.parse_args()
    files = [f for i in arguments.inputs for f in (sorted(i.rglob("*")) if i.is_dir() else [i])
             if f.suffix.lower() in (".glb", ".gltf") and f.name not in arguments.without]
    options = [f"--{option}" for option in arguments.options]
    rows = {}
    for program in filter(None, [arguments.old, arguments.unwrapd]):
        rows[program] = survey(program, [f.resolve() for f in files], options, arguments.limit)
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1))
    sys.exit(any(faults(r) for r in rows[arguments.unwrapd]))


if __name__ == "__main__":
    main()
