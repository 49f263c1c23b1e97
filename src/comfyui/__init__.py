"""A node of ComfyUI that unwraps meshes with the package `unwrapd`."""

from .node import comfy_entrypoint

__all__ = ["comfy_entrypoint"]
