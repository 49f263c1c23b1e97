"""The options of functions, by their types; `unwrapd unwrap --help` says what each does."""

from collections.abc import Sequence
from typing import Any, Literal, TypedDict

from ._energy import Energy

Resolution = int | str | tuple[int, int]
Seams = Literal["normals"] | Sequence[Sequence[int]] | Any

class Layout(TypedDict, total=False):
    """How charts are laid out."""

    resolution: Resolution | None
    padding: int | None
    pages: int | None
    texels_per_unit: float | None
    packing: Literal["fast", "tight"] | None
    stack: Literal["off", "keep", "identical", "mirrored"] | None
    stack_offset: bool | None
    rotate: Literal["any", "quarter", "none"] | None
    control: Sequence[str] | None
    rectangle: Sequence[str] | None
    straighten: str | None
    threads: int | None

class UnwrapOptions(Layout, total=False):
    """Where to cut, how to map and how to pack."""

    preset: Literal["material", "lightmap"] | None
    mips: int | None
    seams: Seams | None
    cut: Literal["auto", "fast", "disk", "keep", "seams"] | None
    quality: Literal["smooth", "balanced", "few"] | None
    cones: int | None
    cone_vertices: Sequence[int] | Any | None
    kept_maps: Literal["optimized", "as-given"] | None
    max_charts: int | None
    max_distortion: float | None
    max_stretch: float | None
    seam_weight: float | None
    symmetry: Literal["auto", "off"] | None
    energy: str | Energy | None
    barrier: str | None
    barrier_strength: float | None
    barrier_support: float | None
    barrier_continuation: bool | None
    pin: Literal[0, 2] | None
    quantization_safe: Literal[12, 14, 16] | None
    time_budget: float | None

class Sets(TypedDict, total=False):
    """UV sets of a file, and what shares an atlas."""

    group_by: Literal["mesh", "scene", "material", "primitive"] | None
    source_texcoord: int | None
    texcoord: int | None
    overwrite: bool | None

class Baking(TypedDict, total=False):
    """Resampling of textures."""

    rebake: bool | None
    bake_tiled: bool | None
    bake_colors: bool | None
    bake_size: int | None
    image_format: Literal["source", "png", "jpeg", "webp"] | None

class UnwrapFileOptions(UnwrapOptions, Sets, Baking, total=False):
    """The same and what concerns files."""

    texel_weight: Sequence[str] | None
    material_borders: bool | None
    heatmap_measure: Literal["conformal", "area", "symmetric-dirichlet"] | None
    merge_materials: Sequence[str] | None

class UnwrapBytesOptions(UnwrapFileOptions, total=False):
    """The same and the format of the result."""

    format: Literal["glb", "obj"] | None

class RepackOptions(Layout, total=False):
    """How islands are packed, and which stay."""

    islands: Sequence[dict[str, Any]] | None

class RepackFileOptions(RepackOptions, Sets, Baking, total=False):
    """The same and what concerns files."""

class MeasureOptions(TypedDict, total=False):
    """What is asked of UVs."""

    padding: int | None
    resolution: Resolution | None
    pages: int | None
    mips: int | None
    aligned: bool | None
    bits: int | None
    threads: int | None

class MeasureFileOptions(MeasureOptions, total=False):
    """The same and which UVs of a file."""

    texcoord: int | None
    group_by: Literal["mesh", "scene", "material", "primitive"] | None
    separate_nodes: bool | None
    skip_missing: bool | None

class VerifyOptions(MeasureOptions, total=False):
    """What is to be proven of UVs."""

    bijective: bool | None
    stacks: bool | None
    unmirrored: bool | None

class VerifyFileOptions(VerifyOptions, MeasureFileOptions, total=False):
    """The same and which UVs of a file."""

class ProblemOptions(TypedDict, total=False):
    """What a deformation costs."""

    energy: str | Energy | None
    barrier: str | None
    barrier_strength: float | None
    barrier_support: float | None
    max_conformal: float | None
    bijective: bool | None

class SolveOptions(TypedDict, total=False):
    """How a problem is solved."""

    method: Literal["projected", "levenberg"] | None
    barrier_continuation: bool | None
    bias: bool | None
    tolerance: float | None
    search: bool | None
    threads: int | None
    time_budget: float | None
