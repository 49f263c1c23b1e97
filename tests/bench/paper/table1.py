"""Table 1: the barriers on one squeezed body, each with the paper's iteration and with ours, and an interior-point method."""
import json
import math

from problems import solve, table, variant
from published import TABLE_1, TABLE_1_LARGE

# Of the paper's iteration: the columns of its table, and how the authors' runs of them are called.
COLUMNS = {
    "plain": ("base", {"substepping": False, "alpha_update": False}),
    "+ substepping": ("sub", {"substepping": True, "alpha_update": False}),
    "+ α-update": ("sub+alpha", {"substepping": True, "alpha_update": True}),
}

HEADER = ("barrier", "method", "β", "end", "it", "fact", "CPU s", "E", "residual", "smallest", "bias", "inverted",
          "authors' code: it · s · E · residual", "the paper: it · s · E · residual")

# The β of problem files with Green's strain that name none.
GREEN_BETA = 100.0

# β is matched when the smallest ratios differ by no more than this share; it is bracketed by so many doublings at most, which
# are then halved so many times.
MATCHED = 0.02
DOUBLINGS = 12
HALVINGS = 8


def row(barrier, method, beta, report, seconds, authors="", paper=""):
    energy, free = report["energy"], report.get("energy_without_barrier")
    bias = "" if free is None else f"{energy - free:.4g} ({100 * (energy - free) / energy:.1f} %)"
    return (barrier, method, f"{beta:.4g}", report["status"], report["iterations"], report.get("factorizations", ""),
            f"{seconds:.2f}", f"{energy:.5g}", f"{report['residual']:.1e}", f"{report['smallest']:.4f}", bias,
            report["inverted"], authors, paper)


def authors_row(cases, mesh, barrier, suffix):
    """What the authors' code does on the same problem, where its result is known; the ordinary case stands elsewhere."""
    names = [f"T1_{mesh}_disc_squeeze_{barrier}_{suffix}"]
    if suffix == "sub+alpha":
        names.append(f"{mesh}_disc_squeeze_green_{barrier}")
    for case in cases:
        if case["name"] in names:
            return f"{case['iterations']} · {case['cpu_loop_s']:.2f} · {case['E_def']:.5g} · {case['pos_err_sq']:.0e}"
    return "–"


def matched(program, problem, folder, barrier, beta, smallest):
    """The β nearest to `beta` at which the smallest element ratio with this barrier is `smallest`, or where the search gives up.

    The ratio grows with β as long as the map stays in one minimum; from afar it does not, so the search begins nearby.
    """
    def ratio(beta):
        report, _, _ = solve(program, variant(problem, folder / "matched.json", barrier=barrier, beta=beta), folder)
        return report["smallest"]

    factor = 2.0 if ratio(beta) < smallest else 0.5
    other = beta
    for _ in range(DOUBLINGS):
        beta, other = other, other * factor
        if (ratio(other) < smallest) == (factor < 1):
            break
    for _ in range(HALVINGS):
        middle = math.sqrt(beta * other)
        found = ratio(middle)
        if abs(found - smallest) < MATCHED * smallest:
            break
        if (found < smallest) == (factor > 1):
            beta = middle
        else:
            other = middle
    return middle


def rows(arguments, cases, folder, mesh):
    base = arguments.reference / "problems" / f"T1_{mesh}_disc_squeeze_spline_base.json"
    beta = json.loads(base.read_text()).get("beta", GREEN_BETA)
    published = TABLE_1_LARGE if mesh == "woody-hi-x4" else TABLE_1

    def projected(barrier, beta, *options):
        problem = variant(base, folder / "projected.json", barrier=barrier, beta=beta)
        return solve(arguments.unwrapd, problem, folder, *options)

    spline, _, _ = projected("spline", beta)
    for barrier in arguments.barriers:
        for column, (suffix, switches) in COLUMNS.items():
            limits = {"max_iter": arguments.max_iterations}
            problem = variant(base, folder / "levenberg.json", barrier=barrier, beta=beta, **switches, **limits)
            report, _, seconds = solve(arguments.unwrapd, problem, folder, "--method", "levenberg")
            paper = published.get((barrier, column), "–")
            yield row(barrier, f"the paper's, {column}", beta, report, seconds, authors_row(cases, mesh, barrier, suffix), paper)
        report, _, seconds = projected(barrier, beta, "--bias")
        yield row(barrier, "projected", beta, report, seconds)
        if barrier != "spline" and not arguments.quick:
            equal = matched(arguments.unwrapd, base, folder, barrier, beta, spline["smallest"])
            report, _, seconds = projected(barrier, equal, "--bias")
            yield row(barrier, "projected, matched β", equal, report, seconds)
    report, _, seconds = projected("spline", beta, "--bias", "--barrier-continuation")
    yield row("spline", "projected, β lowered", beta, report, seconds)
    report, _, seconds = projected("none", beta)
    yield row("none", "projected", beta, report, seconds)
    if arguments.ipopt_seconds > 0:
        from interior_point import interior_point
        ipopt = interior_point(base, arguments.ipopt_seconds)
        yield row("none (λ ≥ ε)", "Ipopt", 0.0, ipopt, ipopt["seconds"], paper=published["ipopt"])


def main(arguments, cases, folder):
    """Prints the table for each mesh asked for."""
    for mesh, size in arguments.meshes:
        title = f"Table 1: {mesh}, Green's strain, discs squeezed; the paper's columns are of a mesh of {size} triangles"
        table(title, HEADER, rows(arguments, cases, folder, mesh))
