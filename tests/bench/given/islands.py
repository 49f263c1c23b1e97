"""Islands as the certificate calls them, beside an own reading of the file."""
from collections import Counter

from files import Unreadable, meshes_of, write_obj
from judge import Islands, areas
from scenes import odd_uvs

FAULTS = ["without_area", "folded", "overlapping", "tiled", "outside"]


def said(program, path):
    """For each atlas the faults of islands by their first faces, and the number of sound ones; None if it is refused."""
    judgment, _ = program.verified(path, "--bijective", "--texcoord", "0", "--skip-missing")
    if judgment is None:
        return None
    found = {}
    for group in judgment["groups"]:
        islands = group["certificate"]["islands"]
        found[group["name"]] = ({island["face"]: island["fault"] for island in islands["faulty"]}, islands["sound"])
    return found


def own(meshes):
    found = {}
    for mesh in meshes:
        islands = Islands(mesh)
        facts = islands.facts(islands.overlapping())
        faulty = {face: fault for face, fault in facts if fault}
        found[mesh.name] = (faulty, len(facts) - len(faulty))
    return found


def fill(meshes):
    return sum(areas(mesh.uv).sum() for mesh in meshes) / len(meshes)


def repacked(program, path, folder):
    """The mean share of the square that islands cover with the options off, and the exit status."""
    out = folder / f"repacked{'.obj' if path.suffix.lower() == '.obj' else '.glb'}"
    options = ["--stack", "off"] + ([] if out.suffix == ".obj" else ["--texcoord", "0", "--overwrite"])
    report, status = program.written("repack", path, out, *options)
    return (None if report is None else fill(meshes_of(out))), status


def short(counts):
    return " ".join(f"{counts[fault]} {fault}" for fault in ["sound", *FAULTS] if counts[fault])


def run(program, before, files, folder):
    faults = 0
    made = []
    for name, (positions, polygons, uvs) in odd_uvs().items():
        made.append(folder / f"{name}.obj")
        write_obj(made[-1], positions, polygons, uvs)
    print("file | atlases | islands said to be | read here | differ | repack: exit | fill | before")
    for path in [*files, *made]:
        try:
            meshes = meshes_of(path)
        except Unreadable as reason:
            print(f"{path.name} | not read here: {reason}")
            continue
        said_of, own_of = said(program, path), own(meshes)
        if said_of is None:
            faults += 1
            print(f"{path.name} | refused")
            continue
        counts, counts_here, differ = Counter(), Counter(), 0
        for name in said_of.keys() | own_of.keys():
            (faulty, sound), (faulty_here, sound_here) = said_of.get(name, ({}, 0)), own_of.get(name, ({}, 0))
            counts.update(faulty.values())
            counts_here.update(faulty_here.values())
            counts["sound"] += sound
            counts_here["sound"] += sound_here
            differ += len(set(faulty.items()) ^ set(faulty_here.items())) + (sound != sound_here)
        now, status = repacked(program, path, folder)
        then = repacked(before, path, folder)[0] if before else None
        is_short = now is None or (then is not None and now < then - 1e-4)
        faults += differ + is_short
        shown = ["-" if x is None else f"{x:.3f}" for x in (now, then)]
        print(f"{path.name} | {len(said_of)} | {short(counts)} | {short(counts_here)} | {differ} | {status} | {' | '.join(shown)}",
              flush=True)
    return faults
