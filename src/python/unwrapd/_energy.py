"""Energies as functions."""

from __future__ import annotations

from typing import Any, Callable, Mapping, NamedTuple, Optional, Tuple

import numpy as np

from ._errors import InvalidInput

#: A function of the singular values of all elements.
Function = Callable[[np.ndarray], Any]


class Energy(NamedTuple):
    """An energy of deformation as three functions of the singular values of all elements.

    Each takes `sigma`, (n, D) float64: the signed singular values of the Jacobian of n elements, greatest first, the last negative
    where an element is inverted. D is 2 for triangles and 3 for tetrahedra. The energy is the sum over the elements of area or
    volume at rest times ψ. Its Hessian in the positions is made positive definite by the solver; the functions do not project.

    Attributes
    ----------
    value : callable
        ψ(sigma), (n,). Symmetric in the columns of `sigma`, smooth and minimal at 1. Infinite where a map must not be. If ψ or a
        derivative is not finite for flat or inverted elements, these are outside the domain, and never asked for again.
    gradient : callable
        ∂ψ/∂σᵢ, (n, D).
    hessian : callable
        ∂²ψ/∂σᵢ∂σⱼ, (n, D, D).

    Notes
    -----
    The functions are called once per evaluation, on a thread of the solver, one at a time. What they raise ends the work and is
    raised to the caller. Another shape, a ψ that is not a number, and derivatives that are not finite inside the domain are an
    `InvalidInput` with the code ``"invalid_energy"``. With `max_conformal`, they are called for each element.

    >>> import numpy, unwrapd
    >>> symmetric_dirichlet = unwrapd.Energy(
    ...     lambda sigma: (sigma**2 + sigma**-2.0).sum(1),
    ...     lambda sigma: 2 * (sigma - sigma**-3.0),
    ...     lambda sigma: (2 + 6 * sigma**-4.0)[:, :, None] * numpy.eye(sigma.shape[1]),
    ... )
    >>> square, halves = [[0, 0], [1, 0], [1, 1], [0, 1]], [[0, 1, 2], [0, 2, 3]]
    >>> unwrapd.Problem(square, halves, energy=symmetric_dirichlet).energy()
    4.0
    """

    value: Function
    gradient: Function
    hessian: Function


#: The functions as the native part takes them: each returns a flat array of float64, checked.
Native = Tuple[Function, Function, Function]


def split(options: Mapping[str, Any]) -> Tuple[Mapping[str, Any], Optional[Native]]:
    """Options, and the functions of their energy if it is no text."""
    energy = options.get("energy")
    if energy is None or isinstance(energy, str):
        return options, None
    return {name: value for name, value in options.items() if name != "energy"}, _native(energy)


def _native(energy: Any) -> Native:
    functions = tuple(energy) if isinstance(energy, (tuple, list)) else ()
    if len(functions) != 3 or not all(map(callable, functions)):
        raise TypeError(
            "energy must be a name, a formula or three functions, unwrapd.Energy(value, gradient, hessian), "
            f"not {energy!r}"
        )
    value, gradient, hessian = (
        _Checked(name, function, rank)
        for rank, (name, function) in enumerate(zip(Energy._fields, functions))
    )
    return value, gradient, hessian


class _Checked:
    """A function whose results have the right shape and are numbers."""

    def __init__(self, name: str, function: Function, rank: int) -> None:
        self.name, self.function, self.rank = name, function, rank

    def __call__(self, sigma: np.ndarray) -> np.ndarray:
        n_elements, dim = sigma.shape
        # Where an element is flat or inverted the domain is not known yet.
        is_inside = bool((sigma[:, -1] > 0).all())
        with np.errstate(all="ignore") if not is_inside else np.errstate():
            found = self.function(sigma)
        found = np.ascontiguousarray(found, dtype=np.float64)
        shape = (n_elements, *(dim,) * self.rank)
        if found.shape != shape:
            raise _invalid(f"{self.name} must return an array of the shape {shape}, not {found.shape}")
        if is_inside:
            self._check(found)
        elif self.rank == 0:
            found = np.where(np.isnan(found), np.inf, found)
        return found.reshape(-1)

    def _check(self, found: np.ndarray) -> None:
        if self.rank == 0:
            if not (found > -np.inf).all():
                raise _invalid("value must return numbers, or infinity outside the domain")
        elif not np.isfinite(found).all():
            raise _invalid(f"{self.name} must return finite numbers inside the domain")


def _invalid(message: str) -> InvalidInput:
    return InvalidInput(f"the energy's {message}", "invalid_energy", 3)
