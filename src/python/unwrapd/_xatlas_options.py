"""The option classes of the package `xatlas`, and what their values are here."""

from __future__ import annotations

import operator
import warnings
from typing import Any, ClassVar

import numpy as np


class _Options:
    """Attributes with defaults; others do not exist, and values have the types of the defaults."""

    _defaults: ClassVar[dict[str, Any]]

    def __init__(self) -> None:
        for name, value in self._defaults.items():
            setattr(self, name, value)

    def __setattr__(self, name: str, value: Any) -> None:
        if name not in self._defaults:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        object.__setattr__(self, name, _typed(type(self._defaults[name]), name, value))

    def _warn_of(self, ignored: list[str]) -> None:
        """Names those that were set and have no effect."""
        for name in ignored:
            if getattr(self, name) != _typed(
                type(self._defaults[name]), name, self._defaults[name]
            ):
                text = f"unwrapd.xatlas: {type(self).__name__}.{name} has no effect"
                warnings.warn(text, UserWarning, stacklevel=4)


def _typed(kind: type, name: str, value: Any) -> Any:
    if kind is bool:
        return bool(value)
    try:
        if kind is float:
            return float(
                np.float32(operator.index(value) if isinstance(value, bool) else value + 0.0)
            )
        number = operator.index(value)
    except TypeError:
        raise TypeError(
            f"{name} must be of type {kind.__name__}, not {type(value).__name__}"
        ) from None
    if not 0 <= number <= 0xFFFF_FFFF:
        raise TypeError(f"{name} must not be negative or exceed 32 bits: {number}")
    return number


class ChartOptions(_Options):
    """How charts are made. `fix_winding` always holds here; `use_input_mesh_uvs` keeps the present islands;
    `normal_seam_weight` beyond 1000 cuts along hard edges, as it does there. Others have no effect, which a warning says
    where they are set: `unwrapd.unwrap` has options of its own."""

    max_chart_area: float
    max_boundary_length: float
    normal_deviation_weight: float
    roundness_weight: float
    straightness_weight: float
    normal_seam_weight: float
    texture_seam_weight: float
    max_cost: float
    max_iterations: int
    use_input_mesh_uvs: bool
    fix_winding: bool

    _defaults = {
        "max_chart_area": 0.0,
        "max_boundary_length": 0.0,
        "normal_deviation_weight": 2.0,
        "roundness_weight": 0.01,
        "straightness_weight": 6.0,
        "normal_seam_weight": 4.0,
        "texture_seam_weight": 0.5,
        "max_cost": 2.0,
        "max_iterations": 1,
        "use_input_mesh_uvs": False,
        "fix_winding": False,
    }

    def _given(self) -> dict[str, Any]:
        """The options here."""
        honored = ["use_input_mesh_uvs", "fix_winding"]
        if self.normal_seam_weight > 1000.0:
            honored.append("normal_seam_weight")
        self._warn_of([name for name in self._defaults if name not in honored])
        given: dict[str, Any] = {}
        if self.normal_seam_weight > 1000.0:
            given["seams"] = "normals"
        if self.use_input_mesh_uvs:
            given["cut"] = "keep"
        return given


class PackOptions(_Options):
    """How charts are laid out. `max_chart_size` and `blockAlign` have no effect, which a warning says; nor has
    `rotate_charts` where it is False and `rotate_charts_to_axis` is True."""

    max_chart_size: int
    padding: int
    texels_per_unit: float
    resolution: int
    bilinear: bool
    blockAlign: bool
    bruteForce: bool
    create_image: bool
    rotate_charts_to_axis: bool
    rotate_charts: bool

    _defaults = {
        "max_chart_size": 0,
        "padding": 0,
        "texels_per_unit": 0.0,
        "resolution": 0,
        "bilinear": True,
        "blockAlign": False,
        "bruteForce": False,
        "create_image": False,
        "rotate_charts_to_axis": True,
        "rotate_charts": True,
    }

    #: Texels between charts that filtering needs; sides and density where none are given.
    _FILTERED = 2
    _SIDE = 1024
    #: How much of a texture is filled at least, with room for what cannot be known before.
    _FILL = 0.45

    def _given(self, area: float) -> dict[str, Any]:
        """The options here, for meshes of this area."""
        self._warn_of(["max_chart_size", "blockAlign"])
        rotate = "quarter" if self.rotate_charts else "none"
        if self.rotate_charts_to_axis:
            self._warn_of(["rotate_charts"])
            rotate = "any"
        side, pages, density = self.resolution or self._SIDE, 1, self.texels_per_unit
        if density > 0.0:
            needed = area * density**2 / self._FILL
            if self.resolution:
                pages = min(10, max(1, int(np.ceil(needed / side**2))))
            else:
                side = int(np.ceil(np.sqrt(needed)))
        resolution = min(65536, max(16, side))
        if self.resolution not in (0, resolution):
            warnings.warn(
                f"unwrapd.xatlas: PackOptions.resolution {side} has become {resolution}",
                UserWarning,
                stacklevel=4,
            )
        padding = self.padding + (self._FILTERED if self.bilinear else 0)
        given: dict[str, Any] = {
            "resolution": resolution,
            "padding": min(padding, resolution // 8),
            "pages": pages,
            "packing": "tight" if self.bruteForce else "fast",
            "rotate": rotate,
        }
        if given["padding"] < self.padding:
            text = (
                f"unwrapd.xatlas: PackOptions.padding {self.padding} has become {given['padding']}"
            )
            warnings.warn(text, UserWarning, stacklevel=4)
        return {**given, "texels_per_unit": density} if density > 0.0 else given


def enlarge(given: dict[str, Any], is_fixed: bool) -> bool:
    """More room for a density that does not fit, if there can be any: a page more where the
    size of a page is fixed, else a larger texture."""
    if is_fixed:
        given["pages"] += 1
    else:
        given["resolution"] += given["resolution"] // 8
    return bool(given["pages"] <= 10 and given["resolution"] <= 65536)
