"""What unwrapping gives."""

from __future__ import annotations

import json
from functools import cached_property
from typing import Any

import numpy as np


class Atlas:
    """An unwrapped mesh: each vertex as often as its corners differ in UVs.

    Attributes
    ----------
    vmapping : (N,) uint32
        For each vertex of the result that of the given mesh, as `xatlas` calls it.
    indices : (F, 3) uint32
        The faces in vertices of the result: as many as given, in the same order, with the same first corners, so that
        ``vertices[atlas.vmapping][atlas.indices]`` equals ``vertices[faces]``.
    uvs : (N, 2) float32
        UVs of the vertices of the result, v up, exact on a grid of 2⁻²³.
    charts : (F,) uint32
        The chart of each face, counted over all meshes of the atlas.
    """

    def __init__(
        self,
        vmapping: np.ndarray,
        indices: np.ndarray,
        uvs: np.ndarray,
        charts: np.ndarray,
        report: str,
    ) -> None:
        self.vmapping = vmapping
        self.indices = indices
        self.uvs = uvs
        self.charts = charts
        self._report = report

    @property
    def corner_uvs(self) -> np.ndarray:
        """UVs of the corners of the faces, (F, 3, 2) float32."""
        corners: np.ndarray = self.uvs[self.indices]
        return corners

    @cached_property
    def report(self) -> dict[str, Any]:
        """The whole report: options, distortion, seams, packing, certificate, warnings, seconds."""
        report: dict[str, Any] = json.loads(self._report)
        return report

    @property
    def certificate(self) -> dict[str, Any]:
        """What exact predicates say of these UVs: flips, overlaps, padding."""
        certificate: dict[str, Any] = self.report["groups"][0]["certificate"]
        return certificate

    @property
    def measures(self) -> dict[str, Any]:
        """Distortion, seams, density and packing."""
        measures: dict[str, Any] = self.report["groups"][0]["measures"]
        return measures

    @property
    def certified(self) -> bool:
        """Whether everything that was asked for is proven."""
        return bool(self.report["certified"])

    @property
    def n_charts(self) -> int:
        """Charts of the whole atlas."""
        return int(self.certificate["charts"])

    def __repr__(self) -> str:
        proven = "certified" if self.certified else "not certified"
        # Of a list of meshes this is one: the report counts the charts of all.
        own = len(np.unique(self.charts))
        return f"<unwrapd.Atlas: {len(self.indices)} faces, {own} charts, {proven}>"

    def __getstate__(self) -> tuple[Any, ...]:
        return (self.vmapping, self.indices, self.uvs, self.charts, self._report)

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.vmapping, self.indices, self.uvs, self.charts, self._report = state
