"""The researcher's part: energies of deformation, at any point and minimized."""

from __future__ import annotations

import importlib
import json
from typing import TYPE_CHECKING, Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _bodies, _energy, _native
from ._options import to_json

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from ._option_types import ProblemOptions, SolveOptions

#: A list of handles as files of handles have them, or a mapping of vertices to targets.
Handles = Union[Sequence[Mapping[str, Any]], Mapping[int, Any]]


class Problem:
    """An energy of deformation with a barrier, on a mesh.

    Parameters
    ----------
    vertices : (V, 2) or (V, 3) array
    elements : (F, 3) or (T, 4) array of integers
        Triangles in the plane, triangles in space, which are mapped to the plane, or tetrahedra.
    start : (V, D) array
        Where solutions start; the vertices themselves unless given. Triangles in space need one, as `unwrap` makes it. What is
        inverted in it is untangled. D is 3 for tetrahedra and 2 otherwise.
    units : "given" or "normalized"
        Whether energies and `barrier_strength` are meant in the unit of the mesh, or in one in which the mean element has
        size 1.
    **options
        `energy`: a name ("arap", "symmetric-dirichlet", "green", …) or a formula of the signed singular values of an element, s1
        and s2, for tetrahedra s3, such as ``"log(s1)^2 + log(s2)^2"``, or functions on arrays, an `Energy`. `barrier`: a name,
        ``"none"`` for none. `barrier_strength`, `barrier_support`, `max_conformal`, `bijective`: as ``unwrapd deform`` has them.

    Raises
    ------
    InvalidInput
        If this is no mesh; with the code ``"invalid_formula"`` and, if it cannot be read, the `column`, if a formula is no
        energy: it must be symmetric, and smooth and minimal at 1. So must functions, which may be ``"invalid_energy"``, too.
    InvalidOptions, TypeError, ValueError
    """

    def __init__(
        self,
        vertices: Any,
        elements: Any,
        *,
        start: Any = None,
        units: str = "given",
        **options: Unpack[ProblemOptions],
    ) -> None:
        if units not in ("given", "normalized"):
            raise ValueError(f'units must be "given" or "normalized", not {units!r}')
        body = _bodies.native(vertices, elements, start)
        texts, functions = _energy.split(options)
        given = to_json("Problem", texts)
        self._native = _native.Problem(*body, given, functions, units == "normalized")

    @property
    def start(self) -> np.ndarray:
        """Where solutions start, (V, D) float64."""
        return self._table(self._native.start)

    def energy(self, x: Any = None) -> float:
        """The energy with its barriers at the positions `x`, (V, D), by default the start; infinite outside the domain."""
        return self._native.value(self._flat(x))

    def gradient(self, x: Any = None) -> np.ndarray:
        """Its gradient at `x`, (V, D) float64. Raises `InvalidInput` where the energy is infinite."""
        return self._table(self._native.gradient(self._flat(x)))

    def hessian(self, x: Any = None) -> Any:
        """Its Hessian at `x`, (VD, VD), with the coordinates of a vertex one after another; nothing is projected.

        A `scipy.sparse.csr_matrix` if SciPy is there, otherwise the tuple ``(data, indices, indptr)`` that makes one. Raises
        `InvalidInput` where the energy is infinite.
        """
        parts = self._native.hessian(self._flat(x))
        try:
            sparse = importlib.import_module("scipy.sparse")
        except ImportError:
            return parts
        n_unknowns = len(parts[2]) - 1
        return sparse.csr_matrix(parts, shape=(n_unknowns, n_unknowns))

    def elements(self, x: Any = None) -> dict[str, np.ndarray]:
        """What each element has at `x`, without the barrier.

        ``"singular_values"`` (E, D), greatest first, the last negative where an element is inverted; ``"relative_size"`` (E,),
        its area or volume over that at rest; and ``"energy_density"`` (E,), the energy per size at rest, of energies that are
        functions of singular values.
        """
        found = self._native.elements(self._flat(x))
        return {
            name: values if name == "singular_values" else values[:, 0] for name, values in found
        }

    def solve(
        self,
        handles: Handles = (),
        *,
        callback: Optional[Callable[[_native.Iterate], Any]] = None,
        **options: Unpack[SolveOptions],
    ) -> Solution:
        """Pull handles to their targets and minimize the energy, over maps that are all valid; without handles, from the start.

        Parameters
        ----------
        handles : mapping of vertices to targets, or list of dict
            ``{0: (0, 0), 7: (2, 1)}``, or as files of handles have them: ``{"vertex": 7, "to": …}``, ``{"at": …, "to": …}`` for
            points inside elements, ``{"center": …, "radius": …, "to": …, "turn": degrees, "axis": …}``,
            ``{"line": […], "to": […]}``, ``{"vertices": […], "by": …}``, each softly with a ``"weight"``.
        callback : callable
            Called with every `Iterate`, on this thread, before the next is made. Returning False ends the work with that map; an
            exception cancels it.
        **options
            `method`: "projected" or "levenberg", the paper's own. `tolerance`, `search`, `barrier_continuation`, `bias`: as
            ``unwrapd solve`` has them. `time_budget`: seconds. `threads`: a number.

        Raises
        ------
        InvalidInput, InvalidOptions, NoValidResult
        """
        given = to_json("solve", options)
        x, report = self._native.solve(_bodies.handles_json(handles), given, callback)
        return Solution(self._table(x), report)

    def _flat(self, x: Any) -> np.ndarray:
        start = self._native.start
        if x is None:
            return start
        return _bodies.flat(x, len(start) // self._native.dim, self._native.dim, "x")

    def _table(self, x: np.ndarray) -> np.ndarray:
        return x.reshape(-1, self._native.dim)


class Solution:
    """A map that minimizes an energy.

    Attributes
    ----------
    x : (V, D) float64
        Where the vertices are.
    report : dict
        `status` ("converged", "targets-unreachable", "stopped", …), `iterations`, `factorizations`, `energy`, `barrier`,
        `inverted`, `smallest`, `unreached` handles, seconds.
    """

    def __init__(self, x: np.ndarray, report: str) -> None:
        self.x = x
        self.report: dict[str, Any] = json.loads(report)

    @property
    def status(self) -> str:
        """How the minimization ended."""
        return str(self.report["status"])

    @property
    def iterations(self) -> int:
        """Steps taken."""
        return int(self.report["iterations"])

    @property
    def energy(self) -> float:
        """The energy of the map without barriers."""
        return float(self.report["energy"])

    def __repr__(self) -> str:
        return f"<unwrapd.Solution: {self.status}, {self.iterations} iterations, energy {self.energy:.6g}>"
