"""The nearest case to every timing that the paper gives beside a figure."""
import json

from problems import read_mesh, run, solve, table
from published import FIGURES

HEADER = ("figure", "our case", "elements", "end", "it", "fact", "CPU s", "E", "residual", "inverted", "authors' code: it · s · E", "the paper")

INTERIOR = ("grid608_dirichlet_spline", "grid608_green_spline", "grid608_arap_spline", "woody-lo_pt_bend_green_spline",
            "woody-lo_pt_squeeze_green_spline")
INTERIOR_HEADER = ("problem", "method", "end", "it", "CPU s", "E", "residual", "smallest", "inverted")


def reference_row(arguments, case, figure, folder):
    report, _, seconds = solve(arguments.unwrapd, arguments.reference / case["problem"], folder)
    authors = f"{case['iterations']} · {case['cpu_init_s'] + case['cpu_loop_s']:.2f} · {case['E_def']:.5g}"
    return (figure, case["name"], case["elements"], report["status"], report["iterations"], report["factorizations"], f"{seconds:.2f}",
            f"{report['energy']:.5g}", f"{report['residual']:.1e}", report["inverted"], authors, FIGURES[figure])


def texture_row(arguments, folder):
    """Figure 17: a face parameterized with a disk's boundary, which stays while four points move by a twentieth to the middle."""
    mesh, unwrapped, points, report = (folder / name for name in ("face.obj", "unwrapped.obj", "points.json", "r.json"))
    problem = arguments.reference / "problems" / "face_u_param_lscm_pin2_spline.json"
    vertices, faces = read_mesh(problem.parent / json.loads(problem.read_text())["mesh"])
    mesh.write_text("".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in vertices) + "".join(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces))
    run([arguments.unwrapd, "unwrap", mesh, "-o", unwrapped, "--cut", "disk"])
    uvs = [[float(w) for w in line.split()[1:3]] for line in unwrapped.read_text().splitlines() if line.startswith("vt ")]
    low, high = (tuple(choose(uv[k] for uv in uvs) for k in (0, 1)) for choose in (min, max))
    at = [[low[k] + share[k] * (high[k] - low[k]) for k in (0, 1)] for share in ((0.35, 0.4), (0.65, 0.4), (0.35, 0.65), (0.65, 0.65))]
    middle = [0.5 * (low[k] + high[k]) for k in (0, 1)]
    to = [[0.95 * uv[k] + 0.05 * middle[k] for k in (0, 1)] for uv in at]
    points.write_text(json.dumps({"points": [{"at": a, "to": b} for a, b in zip(at, to)]}))
    seconds = run([arguments.unwrapd, "texture-map", unwrapped, "--points", points, "-o", folder / "mapped.obj", "--report", report])
    chart = json.loads(report.read_text())["charts"][0]
    return ("17", "face, four points, boundary fixed", len(faces), chart["status"], chart["iterations"], chart["factorizations"],
            f"{seconds:.2f}", f"{chart['energy']:.5g}", f"{chart['residual']:.1e}", 0 if chart["bijective"] else "not bijective", "–", FIGURES["17"])


def rows(arguments, cases, folder):
    by_name = {case["name"]: case for case in cases}
    for figure, names in (("2", ("woody-hi_pt_bend_arap_spline", "woody-hi_disc_squeeze_arap_spline")), ("Bimba", ("bimba_11k_u_param_arap_pin1_spline",)),
                          ("13", ("bar_f_bend_green_spline",)), ("14", ("bar_m_bend_arap_spline", "bar_m_compress_arap_spline")),
                          ("19", ("woody-hi_disc_swapAL_arap_spline", "woody-hi_disc_swapAL_arap_none"))):
        for name in names:
            if name in by_name:
                yield reference_row(arguments, by_name[name], figure, folder)
    if not arguments.quick:
        yield texture_row(arguments, folder)


def interior_rows(arguments, folder):
    from interior_point import interior_point
    for name in INTERIOR:
        problem = arguments.reference / "problems" / f"{name}.json"
        ipopt = interior_point(problem, arguments.ipopt_seconds)
        report, _, seconds = solve(arguments.unwrapd, problem, folder, "--barrier-continuation")
        for method, result, taken in (("Ipopt", ipopt, ipopt["seconds"]), ("projected, β lowered", report, seconds)):
            yield (name, method, result["status"], result["iterations"], f"{taken:.2f}", f"{result['energy']:.6g}",
                   f"{result['residual']:.1e}", f"{result['smallest']:.4f}", result["inverted"])


def main(arguments, cases, folder):
    table("Timings of the figures", HEADER, rows(arguments, cases, folder))
    if arguments.ipopt_seconds > 0:
        table(f"Figure 5: an interior-point method beside (the paper: {FIGURES['5']})", INTERIOR_HEADER, interior_rows(arguments, folder))
