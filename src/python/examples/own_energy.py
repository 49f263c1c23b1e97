"""An energy of one's own, as a formula and as functions: a strip is bent by Hencky's energy, and its iterates are looked at.

    python own_energy.py

Hencky's strain is the logarithm of a stretch, so that halving a length costs as much as doubling it. The strip is also bent by the
energy ARAP, to which shrinking to half costs a quarter of doubling: the table shows what that does to its elements.
"""

import numpy as np

import unwrapd

HENCKY = "log(s1)^2 + log(s2)^2"

#: The same, ψ and its derivatives as functions of the singular values of all elements, one row each.
HENCKY_ON_ARRAYS = unwrapd.Energy(
    value=lambda sigma: (np.log(sigma) ** 2).sum(axis=1),
    gradient=lambda sigma: 2 * np.log(sigma) / sigma,
    hessian=lambda sigma: (2 * (1 - np.log(sigma)) / sigma**2)[:, :, None] * np.eye(2),
)


def strip(length):
    """A strip of `length` by 2 squares, two triangles each."""
    vertices = np.array([(x, y) for x in range(length + 1) for y in range(3)], float)
    corners = [3 * x + y for x in range(length) for y in range(2)]
    faces = [t for a in corners for t in ((a, a + 3, a + 4), (a, a + 4, a + 1))]
    return vertices, np.array(faces)


def main():
    vertices, faces = strip(12)
    ends = {
        **{v: vertices[v] for v in (0, 1, 2)},
        36: (6.0, 5.0),
        37: (5.0, 5.0),
        38: (4.0, 5.0),
    }
    energies_of_strips = {"arap": "arap", HENCKY: HENCKY, "on arrays": HENCKY_ON_ARRAYS}
    for name, energy in energies_of_strips.items():
        problem = unwrapd.Problem(vertices, faces, energy=energy)
        energies = []

        def watch(iterate, energies=energies):
            assert iterate.smallest > 0  # no iterate has an inverted element
            energies.append(iterate.energy)

        solution = problem.solve(ends, callback=watch, tolerance=1e-10)
        stretches = problem.elements(solution.x)["singular_values"]
        free = np.setdiff1d(np.arange(len(vertices)), list(ends))
        slope = np.abs(problem.gradient(solution.x)[free]).max()
        print(
            f"{name}: {solution.status} after {len(energies) - 1} iterations, energy {solution.energy:.4f}, "
            f"stretches {stretches.min():.3f} to {stretches.max():.3f}, largest slope {slope:.1e}"
        )
        assert solution.status == "converged" and slope < 1e-3

    # A drag: each map starts from the one before.
    session = unwrapd.Session(vertices, faces, energy=HENCKY_ON_ARRAYS)
    for vertex in (0, 1, 2):
        session.add({"vertex": vertex, "to": vertices[vertex]})
    tip = session.add({"vertex": 37, "to": vertices[37]})
    for angle in np.linspace(0, 1, 20):
        session.move(tip, (12 * np.cos(angle), 1 + 12 * np.sin(angle)))
        session.step()
    print(f"dragged: {session.settle()} after {session.summary['iterations']} iterations")


if __name__ == "__main__":
    main()
