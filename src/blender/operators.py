# SPDX-FileCopyrightText: The authors of unwrapd
# SPDX-License-Identifier: GPL-3.0-or-later

"""The operators. Each is one step of undo, and changes nothing where it fails."""

from contextlib import contextmanager

import bpy
import unwrapd
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .layout import judged, repacked, unwrapped
from .meshes import meshes_of, point_at


class Operator(bpy.types.Operator):
    """What they share."""

    bl_options = {"REGISTER", "UNDO"}

    resolution: IntProperty(
        name="Resolution", description="Side of the texture that the padding refers to", default=1024, min=16, max=65536
    )
    padding: IntProperty(name="Padding", description="Texels between islands", default=2, min=0, max=256)

    @classmethod
    def poll(cls, context):
        return context.mode == "EDIT_MESH" or any(thing.type == "MESH" for thing in context.selected_objects)

    def execute(self, context):
        is_edited = context.mode == "EDIT_MESH"
        things = context.objects_in_mode if is_edited else context.selected_objects
        try:
            with outside_edit_mode(context, list(things)):
                meshes = meshes_of(things, is_edited)
                if not meshes:
                    self.report({"WARNING"}, "No selected object has faces")
                    return {"CANCELLED"}
                return self.work(context, meshes)
        except unwrapd.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}

    def lay_out(self, context, make, meshes, **options):
        """Gives the faces of meshes that may change the UVs that a function makes."""
        if not any(mesh.is_free.any() for mesh in meshes):
            self.report({"WARNING"}, "No face is selected")
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0.0, 1.0)
        try:
            options.update(resolution=self.resolution, padding=self.padding)
            found = make(meshes, progress=lambda at: manager.progress_update(at.fraction), **options)
        finally:
            manager.progress_end()
        for mesh, new in zip(meshes, found.uvs):
            if new is not None:
                mesh.write(new)
        refused = [refusal(meshes[number], polygons) for number, polygons in sorted(found.refused.items())]
        for number, polygons in found.refused.items():
            point_at(meshes[number], polygons)
        if found.report is None:
            self.report({"ERROR"}, "; ".join(refused))
            return {"CANCELLED"}
        measures = found.report["groups"][0]["measures"]
        is_certified = found.report["certified"]
        text = f"{measures['charts']} islands, {'certified' if is_certified else 'not certified'}"
        warnings = [*found.report["warnings"], *found.warnings, *refused]
        self.report({"INFO" if is_certified and not refused else "WARNING"}, "; ".join([text, *warnings]))
        return {"FINISHED"}


def refusal(mesh, polygons):
    """Why a mesh stays as it is: these polygons would be cut."""
    names = ", ".join(str(polygon) for polygon in polygons[:8]) + (" …" if 8 < len(polygons) else "")
    faces = "face" if len(polygons) == 1 else "faces"
    return f"{mesh.name} stays as it is: no UVs keep {faces} {names} whole (now selected): triangulate {'it' if len(polygons) == 1 else 'them'}"


@contextmanager
def outside_edit_mode(context, things):
    """Leaves edit mode, in which meshes have their data elsewhere, and enters it again with the same objects."""
    if context.mode != "EDIT_MESH":
        yield
        return
    bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        # Edit mode takes all selected objects: others must not be, and these must.
        chosen = [thing for thing in context.view_layer.objects if thing.select_get()]
        for thing in {*chosen, *things}:
            thing.select_set(thing in things)
        bpy.ops.object.mode_set(mode="EDIT")
        for thing in {*chosen, *things}:
            thing.select_set(thing in chosen)


class UNWRAPD_OT_unwrap(Operator):
    """Unwrap the selected objects, or the selected faces in edit mode, into one atlas: few islands, and no face flipped.
    Marked seams are cut. Islands with pinned vertices stay as they are"""

    bl_idname = "unwrapd.unwrap"
    bl_label = "Unwrap (unwrapd)"

    quality: EnumProperty(
        name="Quality",
        items=[
            ("smooth", "Smooth", "Little distortion, more islands"),
            ("balanced", "Balanced", "The middle"),
            ("few", "Few", "Few islands, visibly distorted"),
        ],
        default="balanced",
    )
    along_seams: BoolProperty(
        name="Only Marked Seams", description="Cut nowhere else, but where a piece is not a disk", default=False
    )
    time_budget: FloatProperty(
        name="Seconds", description="Time for the work; 0 is no limit", default=0.0, min=0.0, max=3600.0
    )

    def work(self, context, meshes):
        budget = {"time_budget": self.time_budget} if self.time_budget > 0.0 else {}
        quality = {} if self.along_seams else {"quality": self.quality}
        return self.lay_out(context, unwrapped, meshes, along_seams=self.along_seams, **quality, **budget)


class UNWRAPD_OT_repack(Operator):
    """Pack the UV islands of the selected objects, or of the selected faces in edit mode, into one square. Islands with
    pinned vertices stay where they are"""

    bl_idname = "unwrapd.repack"
    bl_label = "Repack (unwrapd)"

    def work(self, context, meshes):
        return self.lay_out(context, repacked, meshes)


class UNWRAPD_OT_report(Operator):
    """Show what the UVs of the selected objects are worth, and what is proven of them"""

    bl_idname = "unwrapd.report"
    bl_label = "Show Report (unwrapd)"
    bl_options = {"REGISTER"}

    def work(self, context, meshes):
        measured, verified = judged(meshes, resolution=self.resolution, padding=self.padding)
        lines = lines_of(measured, verified)
        if not bpy.app.background:
            context.window_manager.popup_menu(
                lambda popup, _: [popup.layout.label(text=line) for line in lines], title="UVs", icon="UV"
            )
        self.report({"INFO"}, "; ".join(lines))
        return {"FINISHED"}


def lines_of(measured, verified):
    """A judgment in a few lines."""
    measures, certificate = measured["groups"][0]["measures"], verified["groups"][0]["certificate"]
    return [
        "Certified" if verified["certified"] else "Not certified",
        f"Islands: {measures['charts']}",
        f"Faces flipped: {certificate['flipped']}, without area: {certificate['degenerate']}",
        f"Pairs that overlap: {certificate['overlapping_pairs']}",
        f"Mean distortion: {measures['sym_dirichlet_mean']:.3f} (4 is none)",
        f"Covered: {100 * measures['pack_square']:.0f} %",
        *verified["warnings"],
    ]


def menu(self, _):
    self.layout.separator()
    for each in CLASSES:
        self.layout.operator(each.bl_idname)


CLASSES = (UNWRAPD_OT_unwrap, UNWRAPD_OT_repack, UNWRAPD_OT_report)
