//! Codes of inputs that cannot be used. They come from the pipeline, mean the same on the command line, and have status 422.

/// Code and meaning.
pub(super) const CAUSES: [(&str, &str); 53] = [
    // Handles.
    ("malformed_handles", "The list of handles is not one"),
    ("no_handle", "There is no handle"),
    ("handle_count", "There is no handle, or there are too many"),
    (
        "unknown_handle",
        "A handle names a vertex that is not there",
    ),
    (
        "handle_outside",
        "A handle lies outside the mesh or picture",
    ),
    (
        "bad_target",
        "A target is not as many finite numbers as it needs, or out of range",
    ),
    (
        "contradictory_handles",
        "Two handles pull one vertex to different places",
    ),
    (
        "unpaired_handles",
        "The problem has not as many targets as handles",
    ),
    (
        "vertex_of_cage",
        "A handle names a vertex; in a cage handles are places",
    ),
    (
        "ambiguous_vertex",
        "An anchor names a vertex that has several UVs",
    ),
    (
        "anchor_on_boundary",
        "An anchor pulls at a boundary that is fixed",
    ),
    (
        "grid_too_coarse",
        "The grid has no vertex inside its fixed border",
    ),
    // Meshes.
    ("invalid_mesh", "The mesh file does not follow its format"),
    ("no_triangles", "The mesh has no triangle"),
    ("no_elements", "There is nothing to deform"),
    ("no_uvs", "The mesh has no such UV set"),
    (
        "index_out_of_range",
        "A face or element names a vertex that is not there",
    ),
    ("non_finite_position", "A coordinate is not a finite number"),
    (
        "limit_exceeded",
        "The input has more than is allowed of something",
    ),
    (
        "folded_mesh",
        "An element is inverted at rest: two lie on the same side of their common side",
    ),
    (
        "zero_size_element",
        "An element has no area or volume at rest",
    ),
    (
        "not_planar",
        "The mesh has no tetrahedra, and its triangles do not lie in a plane of equal z",
    ),
    (
        "flipped_uvs",
        "A face of the chart to be edited is flipped or empty, and untangling did not help",
    ),
    (
        "nonorientable_chart",
        "The chart to be edited has two sides that are one",
    ),
    (
        "missing_resource",
        "The input refers to a file that was not sent",
    ),
    (
        "unsupported_version",
        "The glTF is of another version than 2",
    ),
    (
        "unsupported_extension",
        "The glTF requires an extension that is not known",
    ),
    (
        "unsupported_output",
        "The format asked for cannot hold this document",
    ),
    (
        "indivisible",
        "Triangles cannot be cut: something they have cannot be interpolated",
    ),
    (
        "texcoord_in_use",
        "Textures sample the UV set that would be replaced",
    ),
    (
        "texture_too_small",
        "At the texels per unit asked for the charts do not fit; the detail names a resolution or number of pages that would do",
    ),
    (
        "unknown_material",
        "A weight names a material that the file does not have; only those of glTF are known",
    ),
    ("invalid_seams", "The seams given do not fit the mesh"),
    ("invalid_uvs", "The new UVs do not fit the document"),
    (
        "planar_bijectivity",
        "Only maps of the plane can be kept bijective",
    ),
    (
        "overlapping_start",
        "The map that should be kept bijective overlaps or touches itself at the start",
    ),
    // Pictures and drawings.
    ("invalid_image", "The picture is damaged"),
    (
        "image_too_large",
        "The picture has more bytes or pixels than are read",
    ),
    ("empty_image", "The picture has no pixels"),
    ("empty_outline", "There is nothing to outline"),
    ("invalid_svg", "The drawing cannot be read"),
    ("open_path", "A filled path of the drawing does not close"),
    ("self_intersecting_outline", "The outline meets itself"),
    (
        "outline_too_detailed",
        "The outline has too many vertices, pieces or holes",
    ),
    (
        "outline_too_fine",
        "The outline is too fine for its coordinates",
    ),
    (
        "too_many_triangles",
        "The resolution needs too many triangles",
    ),
    // Problems.
    ("malformed_problem", "The problem file is not one"),
    (
        "wrong_start",
        "The start has not as many numbers as the mesh",
    ),
    (
        "infeasible_start",
        "An element of the start is inverted or too small, and untangling did not help",
    ),
    (
        "planar_energy",
        "The energy or bound is defined in the plane only",
    ),
    ("bad_parameter", "A number of the model is out of range"),
    ("invalid_setting", "A setting is out of range"),
    ("no_valid_result", "No valid result was found"),
];

/// What a code of an input means.
pub(super) fn meaning(code: &str) -> Option<&'static str> {
    let mut all = CAUSES.iter();
    all.find_map(|(word, meaning)| (*word == code).then_some(*meaning))
}
