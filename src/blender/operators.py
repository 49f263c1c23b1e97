"""The operators. Each is one step of undo, and changes nothing where it fails."""

import bpy
import unwrapd
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .layout import Cut, judged, repacked, unwrapped
from .meshes import selected


class Operator(bpy.types.Operator):
    """What they share."""

    bl_options = {"REGISTER", "UNDO"}

    resolution: IntProperty(
        name="Resolution", description="Side of the texture that the padding refers to", default=1024, min=16, max=65536
    )
    padding: IntProperty(name="Padding", description="Texels between islands", default=2, min=0, max=256)

    @classmethod
    def poll(cls, context):
        return any(thing.type == "MESH" for thing in context.selected_objects)

    def execute(self, context):
        # Meshes that are being edited have their data elsewhere until that ends.
        is_editing = context.mode == "EDIT_MESH"
        if is_editing:
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            meshes = selected(context)
            if not meshes:
                self.report({"WARNING"}, "No selected object has faces")
                return {"CANCELLED"}
            return self.work(context, meshes)
        except (unwrapd.Error, Cut) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            if is_editing:
                bpy.ops.object.mode_set(mode="EDIT")

    def lay_out(self, context, make, meshes, **options):
        """Gives meshes the UVs that a function makes."""
        manager = context.window_manager
        manager.progress_begin(0.0, 1.0)
        try:
            options.update(resolution=self.resolution, padding=self.padding)
            uvs, report = make(meshes, progress=lambda at: manager.progress_update(at.fraction), **options)
        finally:
            manager.progress_end()
        for mesh, new in zip(meshes, uvs):
            mesh.write(new)
        measures = report["groups"][0]["measures"]
        is_certified = report["certified"]
        text = f"{measures['charts']} islands, {'certified' if is_certified else 'not certified'}"
        self.report({"INFO" if is_certified else "WARNING"}, "; ".join([text, *report["warnings"]]))
        return {"FINISHED"}


class UNWRAPD_OT_unwrap(Operator):
    """Unwrap the selected objects into one atlas: few islands, and no face flipped. Marked seams are cut. Islands with
    pinned vertices stay as they are"""

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
    """Pack the UV islands of the selected objects into one square. Islands with pinned vertices stay where they are"""

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
