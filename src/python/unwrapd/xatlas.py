"""The calls of the package `xatlas`, with charts and maps of unwrapd: ``import unwrapd.xatlas as xatlas``.

Arguments, results, shapes, types and exceptions are those of `xatlas` 0.0.11. Options without a meaning here are named by a
warning where they are set. trimesh's ``mesh.unwrap()`` imports `xatlas` itself: `install` puts this module in its place.
"""

from __future__ import annotations

import enum
import operator
import sys
from typing import Any, Optional

import numpy as np

from ._arrays import bake
from ._atlas import Atlas as _Unwrapped
from ._xatlas_export import export
from ._xatlas_input import Mesh, taken, taken_uvs
from ._xatlas_mesh import NONE as _NONE
from ._xatlas_mesh import Done as _Done
from ._xatlas_mesh import computed
from ._xatlas_mesh import on_page as _on_page
from ._xatlas_options import ChartOptions, PackOptions

__all__ = [
    "Atlas",
    "Chart",
    "ChartOptions",
    "ChartType",
    "PackOptions",
    "export",
    "install",
    "parametrize",
]

Result = tuple[np.ndarray, np.ndarray, np.ndarray]
#: Colors of charts in an image: a step that makes neighbors differ.
_STEP = np.array([67, 131, 193])


class ChartType(enum.IntEnum):
    """How a chart was mapped: here all at once, for which LSCM stands."""

    Planar = 0
    Ortho = 1
    LSCM = 2
    Piecewise = 3
    Invalid = 4

    def __str__(self) -> str:
        return f"ChartType.{self.name}"


class Chart:
    """A chart of a mesh."""

    def __init__(self, faces: np.ndarray, atlas_index: int) -> None:
        self.faces, self.atlas_index = faces, atlas_index
        self.type, self.material = ChartType.LSCM, 0


class Atlas:
    """Meshes that share an atlas, in the order in which they were added."""

    def __init__(self) -> None:
        self._meshes: list[Mesh] = []
        self._is_flat = False
        self._done: list[_Done] = []
        self._images: list[np.ndarray] = []
        self._utilization: list[float] = []
        self.atlas_count = self.chart_count = self.width = self.height = 0
        self.texels_per_unit = 0.0

    def add_mesh(self, positions: Any, indices: Any, normals: Any = None, uvs: Any = None) -> None:
        """Add a mesh: positions (V, 3), faces (F, 3), normals (V, 3), UVs (V, 2)."""
        self._add(taken(positions, indices, normals, uvs), False)

    def add_uv_mesh(self, uvs: Any, indices: Any, face_materials: Any = None) -> None:
        """Add UVs (V, 2) of faces (F, 3), whose islands are to be packed."""
        self._add(taken_uvs(uvs, indices, face_materials), True)

    def _add(self, mesh: Mesh, is_flat: bool) -> None:
        if self._meshes and self._is_flat != is_flat:
            raise RuntimeError("Adding mesh failed: Unspecified error")
        self._is_flat = is_flat
        self._meshes.append(mesh)

    def generate(
        self,
        chart_options: Optional[ChartOptions] = None,
        pack_options: Optional[PackOptions] = None,
        verbose: bool = False,
    ) -> None:
        """Cut, map and pack all meshes."""
        chart_options = ChartOptions() if chart_options is None else chart_options
        pack_options = PackOptions() if pack_options is None else pack_options
        if not isinstance(chart_options, ChartOptions) or not isinstance(pack_options, PackOptions):
            raise TypeError(
                "generate(): incompatible function arguments: chart_options, pack_options"
            )
        if not self._meshes:
            return
        given = pack_options._given(sum(mesh.area() for mesh in self._meshes))
        charting = chart_options._given()
        is_fixed = pack_options.resolution > 0
        self._keep(computed(self._meshes, self._is_flat, charting, given, is_fixed), given)
        self._images = self._drawn(given) if pack_options.create_image else []
        if verbose:
            print("--- Generated Atlas ---")
            print(f"Utilization: {100.0 * self.utilization:f}%")
            print(f"Charts: {self.chart_count}\nSize: {self.width}x{self.height}\n")

    def _keep(self, unwrapped: list[Optional[_Unwrapped]], given: dict[str, Any]) -> None:
        self._done, self.chart_count = [], 0
        for mesh, own in zip(self._meshes, unwrapped):
            self._done.append(_Done(mesh, own, self.chart_count))
            self.chart_count += self._done[-1].n_charts
        self.width = self.height = given["resolution"]
        found = next((own for own in unwrapped if own is not None), None)
        if found is None:
            self.atlas_count, self.texels_per_unit, self._utilization = 0, 0.0, []
            return
        for done in self._done:
            done.divide_pages(given["pages"])
        pages = found.measures["pages"]
        self.texels_per_unit = found.report["groups"][0]["texels_per_unit"] or 0.0
        self._utilization = [page["fill"] for page in pages]
        self.atlas_count = len(pages)

    def _drawn(self, given: dict[str, Any]) -> list[np.ndarray]:
        images = []
        for page in range(self.atlas_count):
            own, charts = zip(*(_on_page(done, page) for done in self._done))
            numbers, mask = bake(own, charts, given["resolution"])
            colors = 96 + np.rint(numbers).astype(np.int64)[:, :, None] * _STEP % 160
            # As there, the first row is the bottom.
            images.append(np.where(mask[:, :, None], colors, 0).astype(np.uint8)[::-1])
        return images

    def get_mesh(self, mesh_index: int) -> Result:
        """For each vertex that of the given mesh (N,), faces (F, 3) and UVs (N, 2)."""
        done = self._at(mesh_index)
        return done.vmapping.copy(), done.indices.copy(), done.uvs.copy()

    def get_mesh_vertex_assignment(self, mesh_index: int) -> tuple[np.ndarray, np.ndarray]:
        """For each vertex the atlas and the chart that it lies in."""
        done = self._at(mesh_index)
        return done.atlas_index.copy(), done.chart_index.copy()

    def get_mesh_chart_count(self, mesh_index: int) -> int:
        """Charts of a mesh."""
        return self._at(mesh_index).n_charts

    def get_mesh_chart(self, mesh_index: int, chart_index: int) -> Chart:
        """A chart of a mesh."""
        done, number = self._at(mesh_index), _index(chart_index)
        if number >= done.n_charts:
            raise IndexError(
                f"Chart index {number} out of bounds for mesh with {done.n_charts} charts."
            )
        first = int(done.chart_of_face[done.chart_of_face != _NONE].min())
        faces = np.flatnonzero(done.chart_of_face == first + number).astype(np.uint32)
        return Chart(faces, int(done.atlas_index[done.indices[faces[0], 0]]))

    def get_utilization(self, atlas_index: int) -> float:
        """The covered share of an atlas."""
        return float(self._of_atlas(self._utilization, atlas_index))

    def get_chart_image(self, atlas_index: int) -> np.ndarray:
        """A picture of the charts of an atlas, (height, width, 3) uint8."""
        if not self._images and _index(atlas_index) < self.atlas_count:
            raise RuntimeError("The atlas does not have an image.")
        return np.array(self._of_atlas(self._images, atlas_index), np.uint8)

    @property
    def utilization(self) -> float:
        """The covered share of the first atlas."""
        return self.get_utilization(0)

    @property
    def chart_image(self) -> np.ndarray:
        """A picture of the charts of the first atlas."""
        return self.get_chart_image(0)

    @property
    def mesh_count(self) -> int:
        """Meshes of the finished atlas."""
        return len(self._done)

    def __len__(self) -> int:
        return self.mesh_count

    def __getitem__(self, mesh_index: int) -> Result:
        return self.get_mesh(mesh_index)

    def _at(self, mesh_index: int) -> _Done:
        number = _index(mesh_index)
        if number >= len(self._done):
            raise IndexError(
                f"Mesh index {number} out of bounds for atlas with {len(self._done)} meshes."
            )
        return self._done[number]

    def _of_atlas(self, values: list[Any], atlas_index: int) -> Any:
        if _index(atlas_index) >= len(values):
            raise IndexError(f"Atlas index {atlas_index} out of bounds.")
        return values[atlas_index]


def parametrize(positions: Any, indices: Any, normals: Any = None, uvs: Any = None) -> Result:
    """Unwrap a mesh: positions (V, 3), faces (F, 3), normals (V, 3), UVs (V, 2).

    Returns
    -------
    vmapping : (N,) uint32
        For each vertex of the result that of the mesh.
    indices : (F, 3) uint32
        Faces in vertices of the result.
    uvs : (N, 2) float32
        UVs of these, v up, in the unit square.
    """
    atlas = Atlas()
    atlas.add_mesh(positions, indices, normals, uvs)
    atlas.generate()
    return atlas.get_mesh(0)


def install() -> None:
    """Have ``import xatlas`` give this module, also in packages that are loaded already, as trimesh's ``mesh.unwrap()``."""
    sys.modules["xatlas"] = sys.modules[__name__]


def _index(given: Any) -> int:
    number = operator.index(given)
    if number < 0:
        raise TypeError(f"incompatible function arguments: index {number}")
    return number
