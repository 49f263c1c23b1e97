"""The node: a batch of meshes in, the same with UVs out."""

from __future__ import annotations

import copy
import json
from typing import Any

import comfy.model_management
import comfy.utils
import numpy as np
import torch
from comfy_api.latest import IO, ComfyExtension
from torch.nn.utils.rnn import pad_sequence

from .triple import uv_unwrap

#: Steps of the progress bar for a mesh.
STEPS = 1000
#: What vertices have besides positions and UVs, and what is right for other UVs, too.
ATTRIBUTES = ("vertex_colors", "normals")


class UnwrapdMesh(IO.ComfyNode):
    """Few charts, and no flipped or degenerate triangle: proven."""

    @classmethod
    def define_schema(cls) -> Any:
        return IO.Schema(
            node_id="UnwrapdMesh",
            display_name="Unwrap Mesh UVs (unwrapd)",
            category="3d/texturing",
            description=(
                "Makes a UV atlas of few charts, in which no triangle is flipped or degenerate: that is proven. "
                "Vertices on seams are duplicated, so the mesh has more of them than before."
            ),
            inputs=[
                IO.Mesh.Input("mesh"),
                IO.Combo.Input(
                    "quality",
                    options=["smooth", "balanced", "few"],
                    default="balanced",
                    tooltip="Less distortion, or fewer charts.",
                ),
                IO.Combo.Input(
                    "cut",
                    options=["auto", "fast"],
                    default="auto",
                    tooltip="auto: few charts under a bound on their distortion. fast: more charts in less time.",
                ),
                IO.Int.Input(
                    "resolution",
                    default=1024,
                    min=16,
                    max=8192,
                    tooltip="Side of the texture that the padding refers to.",
                ),
                IO.Int.Input(
                    "padding", default=2, min=0, max=64, tooltip="Texels between charts, at most an eighth of the side."
                ),
                IO.Float.Input(
                    "weld_distance",
                    default=0.0,
                    min=0.0,
                    max=1.0,
                    step=0.0001,
                    tooltip="Vertices closer than this fraction of the extent count as one; equal ones always do.",
                ),
            ],
            outputs=[IO.Mesh.Output("mesh"), IO.String.Output("report")],
        )

    @classmethod
    def execute(cls, mesh: Any, weld_distance: float, **options: Any) -> Any:
        meshes = items(mesh)
        bar, made = comfy.utils.ProgressBar(STEPS * len(meshes)), []
        for number, (vertices, faces, attributes) in enumerate(meshes):

            def progress(progress: Any, begin: int = STEPS * number) -> None:
                comfy.model_management.throw_exception_if_processing_interrupted()
                bar.update_absolute(begin + int(STEPS * progress.fraction))

            positions, indices = array(vertices).astype(np.float32), array(faces).astype(np.int64)
            triple, report = uv_unwrap(positions, indices, weld_distance, progress, **options)
            made.append((vertices, attributes, triple, report))
        return IO.NodeOutput(packed(mesh, made), json.dumps([report for *_, report in made]))


def items(mesh: Any) -> list[tuple[Any, Any, dict[str, Any]]]:
    """The meshes of a batch, without what fills them up to one size: vertices, faces and attributes of vertices."""

    def cut(values: Any, counts: Any, number: int) -> Any:
        return values[number] if counts is None else values[number][: int(counts[number])]

    there = [name for name in ATTRIBUTES if getattr(mesh, name, None) is not None]
    v_counts, f_counts = (getattr(mesh, name, None) for name in ("vertex_counts", "face_counts"))
    return [
        (
            cut(mesh.vertices, v_counts, number),
            cut(mesh.faces, f_counts, number),
            {name: cut(getattr(mesh, name), v_counts, number) for name in there},
        )
        for number in range(len(mesh.vertices))
    ]


def packed(mesh: Any, made: list[Any]) -> Any:
    """A batch of unwrapped meshes with the materials of the given one."""
    found = copy.copy(mesh)
    columns: dict[str, list[Any]] = {"vertices": [], "faces": [], "uvs": []}
    for vertices, attributes, (vmapping, indices, uvs), _ in made:
        # v points down, as in glTF, which this becomes.
        down = (uvs * [1, -1] + [0, 1]).astype(np.float32)
        new = {"faces": indices.astype(np.int32), "uvs": down}
        taken = {name: array(values)[vmapping] for name, values in attributes.items()}
        new.update(vertices=array(vertices)[vmapping], **taken)
        for name, values in new.items():
            columns.setdefault(name, []).append(torch.from_numpy(values).to(vertices.device))
    for name, values in columns.items():
        setattr(found, name, pad_sequence(values, batch_first=True))
    # Tangents follow the UVs that were there before.
    found.tangents = None
    for name, counted in (("vertex_counts", "uvs"), ("face_counts", "faces")):
        counts = [len(values) for values in columns[counted]]
        setattr(found, name, torch.tensor(counts) if len(counts) > 1 else None)
    return found


def array(tensor: Any) -> np.ndarray:
    """The numbers of a tensor."""
    found: np.ndarray = tensor.detach().cpu().numpy()
    return found


class UnwrapdExtension(ComfyExtension):
    """What ComfyUI loads."""

    async def get_node_list(self) -> list[Any]:
        return [UnwrapdMesh]


async def comfy_entrypoint() -> UnwrapdExtension:
    """What ComfyUI calls."""
    return UnwrapdExtension()
