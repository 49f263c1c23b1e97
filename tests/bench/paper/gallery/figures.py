"""The figures: inputs, commands, what is drawn. Words in braces are places: {data}, {reference}, {assets}.

The numbers and subjects of figures 2, 5, 13 to 15 and 17 to 20 are known to us from published comparisons; captions of the
others say that an application was chosen.
"""
import json
from dataclasses import dataclass, field

import inputs
from panels import bar, layout, picture, planar, section, surface, traces

CHOSEN = "What the paper's figure shows is not known to us. "


@dataclass
class Command:
    """Arguments of the program and the exit statuses that are right: 4 says that no valid map came out, as without a barrier."""

    text: str
    exits: tuple = (0,)


@dataclass
class Figure:
    number: int
    title: str
    caption: str
    commands: list
    panels: dict
    files: dict = field(default_factory=dict)
    columns: int = 3


def problem(name, **changes):
    """A reference problem with other settings; its mesh by its full path."""
    def content(places):
        path = places["reference"] / "problems" / f"{name}.json"
        problem = json.loads(path.read_text())
        for key in {"mesh", "initial"} & problem.keys():
            problem[key] = str((path.parent / problem[key]).resolve())
        return json.dumps(problem | changes)
    return content


def solve(name, out, *options):
    return Command(f"solve {{reference}}/problems/{name}.json -o {out} " + " ".join(options))


def handles(*list_of):
    return {"handles": list(list_of)}


def disc(center, radius, to, turn=None):
    return {"center": center, "radius": radius, "to": to} | ({} if turn is None else {"turn": turn})


BALLS = ((-1.2, -1.1), (1.2, 1.3))
BARRIERS = ("none", "spline", "auglog", "log", "neohookean")


def grid608(number, title, energies):
    """Handles of the libigl tutorial 608: the boundary held, one inner vertex moved toward a corner; with and without barrier."""
    panels, commands, files = {}, [], {}
    for energy in energies:
        for barrier in ("none", "spline"):
            name = f"{energy}_{barrier}"
            files[f"{name}.json"] = problem("grid608_arap_spline", energy=energy, barrier=barrier)
            commands.append(Command(f"solve {name}.json -o {name}.obj", (0,)))
            panels[f"{energy}, {'no barrier' if barrier == 'none' else 'inverse spline'}"] = planar(f"{name}.obj")
    caption = CHOSEN + "Energies compared on a square whose lower and left sides are held while one vertex is pulled across; each without and with barrier. Where no triangle inverts, parts may still lie over each other: the maps are locally injective."
    return Figure(number, title, caption, commands, panels, files, columns=4 if len(panels) % 4 == 0 else 2)


FIGURES = [
    Figure(
        1, "A surface in a cage",
        "Spot (Keenan Crane, CC0) in a grid of voxels, six tetrahedra each; the head is pulled up and back, hooves held.",
        [Command("deform {assets}/spot.ply --cage 20 --handles none.json -o rest.obj"),
         Command("deform {assets}/spot.ply --cage 20 --handles pull.json -o deformed.obj --report report.json")],
        {"at rest": surface("rest.obj", (125, 12), ["deformed.obj"]), "deformed": surface("deformed.obj", (125, 12), ["rest.obj"]), "from the other side": surface("deformed.obj", (-125, 12), ["rest.obj"])},
        {"none.json": handles({"at": [0.0, 0.0, 0.0], "to": [0.0, 0.0, 0.0]}),
         "pull.json": inputs.spot_head_back()},
    ),
    Figure(
        2, "Woody squeezed, ARAP",
        "Hands and head of 5040 triangles pulled to the middle; without a barrier triangles invert.",
        [solve("woody-hi_disc_squeeze_arap_none", "none.obj"), solve("woody-hi_disc_squeeze_arap_spline", "spline.obj")],
        {"at rest": planar("rest.off"), "ARAP alone": planar("none.obj"), "with the inverse spline": planar("spline.obj")},
        {"rest.off": lambda p: (p["reference"] / "meshes/woody-hi.off").read_text()},
    ),
    Figure(
        3, "Barriers",
        CHOSEN + "Green's strain on the square of figures 6 to 9 with each barrier at β = 100: what they let through and how they share the distortion.",
        [Command(f"solve {b}.json -o {b}.obj") for b in BARRIERS],
        {b: planar(f"{b}.obj") for b in BARRIERS},
        {f"{b}.json": problem("grid608_green_spline", barrier=b) for b in BARRIERS},
    ),
    Figure(
        4, "Substepping",
        CHOSEN + "The paper's own iteration (Levenberg) on the same squeeze without and with substepping, and projected Newton with advancing targets.",
        [Command("solve base.json --method levenberg -o base.obj --trace base.csv"),
         Command("solve sub.json --method levenberg -o sub.obj --trace sub.csv"),
         Command("solve sub.json -o projected.obj --trace projected.csv")],
        {"": traces({"Levenberg": "base.csv", "with substepping": "sub.csv", "projected": "projected.csv"}, ("energy",)),
         "Levenberg": planar("base.obj"), "with substepping": planar("sub.obj"), "projected": planar("projected.obj")},
        {"base.json": problem("T1_woody-hi_disc_squeeze_spline_base", max_iter=600),
         "sub.json": problem("T1_woody-hi_disc_squeeze_spline_sub", max_iter=600)}, columns=4,
    ),
    Figure(
        5, "Against an interior-point method",
        "The Neo-Hookean barrier as a constraint's barrier: the same square by both iterations. tests/bench/paper/interior_point.py prints the figures of Ipopt on such problems; the paper has 4 iterations and less than a second against 1512 and 948 s of KNITRO.",
        [Command("solve p.json --method levenberg -o levenberg.obj --trace levenberg.csv"), Command("solve p.json -o projected.obj --trace projected.csv")],
        {"": traces({"Levenberg": "levenberg.csv", "projected": "projected.csv"}), "Levenberg": planar("levenberg.obj"), "projected": planar("projected.obj")},
        {"p.json": problem("grid608_dirichlet_spline", barrier="neohookean")},
    ),
    grid608(6, "Quadratic energies: Dirichlet and Laplacian", ("dirichlet", "laplacian")),
    grid608(7, "Green's strain", ("green",)),
    grid608(8, "ARAP", ("arap",)),
    grid608(9, "The uniform Laplacian", ("uniform_laplacian",)),
    Figure(
        10, "Every iterate is a map without inversion",
        CHOSEN + "Three of the iterates on the way of the squeeze, from --frames.",
        [solve("woody-hi_disc_squeeze_arap_spline", "end.obj", "--frames frames")],
        {"after 4 steps": planar("frames/00004.obj"), "after 20": planar("frames/00020.obj"), "at the end": planar("end.obj")},
    ),
    Figure(
        11, "Nested surfaces in one cage",
        "A ball in a ball, made for this figure, bent together; the sections show that they stay apart.",
        [Command("deform nested.obj --cage 16 --handles pull.json -o bent.obj"), Command("deform nested.obj --cage 16 --handles still.json -o rest.obj")],
        {"section at rest": section("rest.obj", BALLS), "section, pulled": section("bent.obj", BALLS), "from outside": surface("bent.obj", (20, 20))},
        {"nested.obj": inputs.nested_balls, "still.json": handles({"at": [0.99, 0, 0], "to": [0.99, 0, 0]}), "pull.json": inputs.bent_balls()},
    ),
    Figure(
        12, "A picture warped",
        CHOSEN + "The same handles on a picture with a free border and with a fixed one, where the map is bijective, and with a fixed border without barrier, where it folds.",
        [Command("warp in.png --handles h.json -o free.png"), Command("warp in.png --handles h.json --fix-border -o fixed.png"),
         Command("warp in.png --handles h.json --fix-border --barrier none --energy laplacian -o none.png", (0, 4))],
        {"handles": picture("in.png", "h.json"), "free border": picture("free.png"), "fixed border": picture("fixed.png"), "fixed border, Laplacian, no barrier": picture("none.png")},
        {"in.png": inputs.test_picture, "h.json": inputs.picture_handles()}, columns=2,
    ),
    Figure(
        13, "Tetrahedra, Green's strain",
        "A bunny of 19379 tetrahedra (the paper has a dinosaur of 13052): the ears pulled down to the side, the base held.",
        [Command("deform {data}/tet/bunny_19k.msh --energy green --barrier none --handles pull.json -o none.tet", (0, 4)),
         Command("deform {data}/tet/bunny_19k.msh --energy green --handles pull.json -o spline.tet")],
        {"without barrier": surface("none.tet", (110, 12), ["spline.tet"]), "with the inverse spline": surface("spline.tet", (110, 12), ["none.tet"]), "from the side": surface("spline.tet", (20, 12))},
        {"pull.json": inputs.bunny_ears()},
    ),
    Figure(
        14, "Squashed in a cage, ARAP",
        "A round fruit made for this figure, in a cage, its top pressed down through its middle (the paper has a tomato in 13500 tetrahedra).",
        [Command("deform fruit.obj --cage 10 --handles still.json -o rest.obj"),
         Command("deform fruit.obj --cage 10 --handles press.json -o pressed.obj")],
        {"at rest": surface("rest.obj", (20, 25), ["pressed.obj"]), "pressed": surface("pressed.obj", (20, 25), ["rest.obj"]),
         "section": section("pressed.obj", BALLS)},
        {"fruit.obj": inputs.fruit, "still.json": handles({"at": [0, -0.7, 0], "to": [0, -0.7, 0]}), "press.json": inputs.press_fruit()},
    ),
    Figure(
        15, "Parameterization, ARAP, two vertices fixed",
        "Bimba in one patch from Tutte's map. Without a barrier ARAP flips triangles.",
        [Command("unwrap {reference}/meshes/bimba_11k_u.off --cut disk --pin 2 --barrier none -o none.obj", (0, 4)),
         Command("unwrap {reference}/meshes/bimba_11k_u.off --cut disk --pin 2 -o spline.obj")],
        {"surface": surface("spline.obj", (25, 5), texture=20), "ARAP alone": layout("none.obj"), "with the inverse spline": layout("spline.obj")},
    ),
    Figure(
        16, "Parameterization, LSCM, two vertices fixed, and its editing",
        "The least-squares conformal map of a camel flips triangles without a barrier. With it the map has no flip, but a leg lies over another; one anchor pulls that leg away, two hold the body, and the map is bijective.",
        [Command("unwrap {reference}/meshes/camel_b_u.off --cut disk --pin 2 --energy lscm --barrier none -o none.obj", (0, 4)),
         Command("unwrap {reference}/meshes/camel_b_u.off --cut disk --pin 2 --energy lscm -o spline.obj"),
         Command("edit-uv spline.obj --anchors a.json -o edited.obj")],
        {"LSCM alone": layout("none.obj"), "with the inverse spline: one leg over another": layout("spline.obj", inputs.CAMEL), "edited: no overlap": layout("edited.obj")},
        {"a.json": {"anchors": [{"at": a, "to": b} for a, b in inputs.CAMEL]}},
    ),
    Figure(
        17, "Constrained texture mapping",
        "Sixteen points at the eyes, nose and mouth of a face (51712 triangles; the paper has 46384) aligned with a drawing, the boundary fixed.",
        [Command("unwrap {data}/disk/face.obj --cut disk -o face.obj"),
         Command("texture-map face.obj --points p.json -o aligned.obj")],
        {"texture": picture("face.png"), "before": surface("face.obj", (0, 0), texture="face.png"), "aligned": surface("aligned.obj", (0, 0), texture="face.png")},
        {"face.png": inputs.drawn_face, "p.json": inputs.face_points()},
    ),
    Figure(
        18, "Bounded distortion",
        "A disk whose middle is turned by 80 degrees, its rim held at eight places. Color is the conformal distortion σ₁/σ₂ from 1 (dark) to 5 (bright); the second map bounds it.",
        [Command("deform disk.svg --triangles 3000 --handles still.json -o rest.obj"),
         Command("deform disk.svg --triangles 3000 --handles turn.json -o arap.obj"),
         Command("deform disk.svg --triangles 3000 --handles turn.json --max-conformal 3 -o bounded.obj")],
        {"at rest": planar("rest.obj"), "ARAP, inverse spline": planar("arap.obj", rest="rest.obj", conformal=True), "σ₁/σ₂ below 3": planar("bounded.obj", rest="rest.obj", conformal=True)},
        {"disk.svg": inputs.DISK, "still.json": handles(disc([100, 100], 10, [100, 100])), "turn.json": inputs.turned_disk()},
    ),
    Figure(
        19, "Woody's hands and feet change places",
        "Each hand goes where the foot below it was; 5040 triangles, ARAP.",
        [solve("woody-hi_disc_swapAL_arap_none", "none.obj"), solve("woody-hi_disc_swapAL_arap_spline", "spline.obj")],
        {"at rest": planar("rest.off"), "ARAP alone": planar("none.obj"), "with the inverse spline": planar("spline.obj")},
        {"rest.off": lambda p: (p["reference"] / "meshes/woody-hi.off").read_text()},
    ),
    Figure(
        20, "A bar twisted seven times",
        "48 layers, Green's strain, β = 0.01, in steps of 15 degrees. The turns a result holds are the sum of the best-fit rotations between its layers; those that slip through are gone.",
        [solve("bar_t_twist7_green_none_b0.01", "none.tet"), solve("bar_t_twist7_green_spline_b0.01", "spline.tet", "--report report.json")],
        {"without barrier": bar("none.tet", "rest.tet"), "with the inverse spline": bar("spline.tet", "rest.tet")},
        {"rest.tet": lambda p: (p["reference"] / "meshes/bar_t.tet").read_text()}, columns=1,
    ),
    Figure(
        21, "Left and right change places",
        CHOSEN + "The discs at hands and feet swap sides in one jump. The authors' code does not get there; a handle that could not would end in the nearest valid map and say so.",
        [solve("woody-hi_disc_swapLR_arap_none", "none.obj"), solve("woody-hi_disc_swapLR_arap_spline", "spline.obj")],
        {"at rest": planar("rest.off"), "ARAP alone": planar("none.obj"), "with the inverse spline": planar("spline.obj")},
        {"rest.off": lambda p: (p["reference"] / "meshes/woody-hi.off").read_text()},
    ),
]
