# SPDX-FileCopyrightText: The authors of unwrapd
# SPDX-License-Identifier: GPL-3.0-or-later

"""Operators that unwrap, repack and judge the UVs of the selected objects with the package `unwrapd`."""

import bpy

from .operators import CLASSES, menu

MENUS = ("VIEW3D_MT_object", "VIEW3D_MT_uv_map", "IMAGE_MT_uvs_unwrap")


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    for name in MENUS:
        getattr(bpy.types, name).append(menu)


def unregister():
    for name in MENUS:
        getattr(bpy.types, name).remove(menu)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
