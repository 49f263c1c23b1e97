//! Codes of invalid inputs. They come from the pipeline, mean the same on the command line, and have status 422.

/// Codes with their meanings.
pub(super) const CAUSES: [(&str, &str); 63] = [
    // Handles.
    ("malformed_handles", "The list of handles cannot be parsed"),
    ("no_handle", "There is no handle"),
    ("handle_count", "There is no handle, or there are too many"),
    (
        "unknown_handle",
        "A handle names a vertex that does not exist",
    ),
    (
        "handle_outside",
        "A handle lies outside the mesh or picture",
    ),
    (
        "bad_target",
        "A target has the wrong number of coordinates, or one is not finite or out of range",
    ),
    (
        "contradictory_handles",
        "Two handles pull the same vertex to different targets",
    ),
    (
        "unpaired_handles",
        "The numbers of handles and targets differ",
    ),
    (
        "vertex_of_cage",
        "A handle names a vertex; in a cage, handles must be places",
    ),
    (
        "ambiguous_vertex",
        "An anchor names a vertex that has several UVs",
    ),
    (
        "anchor_on_boundary",
        "An anchor moves a vertex of a fixed boundary",
    ),
    (
        "grid_too_coarse",
        "The grid has no vertex inside its fixed border",
    ),
    // Meshes.
    ("invalid_mesh", "The mesh file does not follow its format"),
    ("no_triangles", "The mesh has no triangle"),
    ("no_elements", "There is nothing to deform"),
    ("no_uvs", "The mesh does not have this UV set"),
    (
        "index_out_of_range",
        "A face or element names a vertex that does not exist",
    ),
    ("non_finite_position", "A coordinate is not a finite number"),
    ("limit_exceeded", "The input exceeds a limit"),
    (
        "folded_mesh",
        "The mesh is folded: two elements lie on the same side of their common face or edge",
    ),
    ("zero_size_element", "An element has zero area or volume"),
    (
        "not_planar",
        "The mesh has no tetrahedra, and its vertices differ in z",
    ),
    (
        "flipped_uvs",
        "The chart has a flipped or degenerate face, and untangling failed",
    ),
    ("nonorientable_chart", "The chart is not orientable"),
    (
        "missing_resource",
        "The input references a file that was not uploaded",
    ),
    ("unsupported_version", "The glTF version is not 2.x"),
    (
        "unsupported_extension",
        "The glTF requires an unsupported extension",
    ),
    (
        "unsupported_output",
        "The requested format cannot hold this document",
    ),
    (
        "indivisible",
        "The triangles cannot be split: an attribute cannot be interpolated",
    ),
    (
        "texcoord_in_use",
        "Textures sample the UV set that would be replaced",
    ),
    (
        "texture_too_small",
        "The charts do not fit at this texel density; the detail names a resolution or page count that suffices",
    ),
    (
        "unknown_material",
        "A weight names a material that does not exist; only glTF materials have weights",
    ),
    ("invalid_seams", "The seams do not match the mesh"),
    // Islands.
    (
        "unknown_face",
        "An island is named by a face that does not exist or names a vertex twice",
    ),
    ("island_named_twice", "Two entries name the same island"),
    ("island_off_page", "An island leaves the page"),
    (
        "islands_too_near",
        "Two islands that stay overlap, or are closer than the padding",
    ),
    (
        "no_room",
        "The other islands do not fit around those that stay",
    ),
    ("invalid_uvs", "The new UVs do not match the document"),
    (
        "planar_bijectivity",
        "Only maps of the plane can be kept bijective",
    ),
    (
        "overlapping_start",
        "The initial map overlaps or touches itself",
    ),
    // Pictures and drawings.
    ("invalid_image", "The picture is damaged"),
    (
        "image_too_large",
        "The picture exceeds the limit of bytes or pixels",
    ),
    ("empty_image", "The picture has no pixels"),
    ("empty_outline", "There is nothing to outline"),
    ("invalid_svg", "The drawing cannot be read"),
    ("open_path", "A filled path of the drawing is open"),
    (
        "self_intersecting_outline",
        "The outline crosses or touches itself",
    ),
    (
        "outline_too_detailed",
        "The outline has too many vertices, pieces or holes",
    ),
    (
        "outline_too_fine",
        "The details of the outline are too small for its coordinates",
    ),
    (
        "too_many_triangles",
        "The mesh would have too many triangles",
    ),
    // Problems.
    ("malformed_problem", "The problem file cannot be parsed"),
    // Sessions.
    (
        "invalid_message",
        "The message is not JSON, or has no such wish",
    ),
    ("nothing_to_undo", "Nothing was remembered"),
    ("nothing_to_redo", "Nothing was undone"),
    (
        "outside_domain",
        "The present map is outside the domain of the new energy, barrier or bound",
    ),
    (
        "wrong_start",
        "The numbers of coordinates of start and mesh differ",
    ),
    (
        "infeasible_start",
        "An element of the start is inverted or too small, and untangling failed",
    ),
    (
        "planar_energy",
        "The energy or bound exists only in the plane",
    ),
    ("bad_parameter", "A model parameter is out of range"),
    (
        "invalid_formula",
        "An energy has neither a name nor a formula of its own that the input's dimension has",
    ),
    ("invalid_setting", "A setting is out of range"),
    ("no_valid_result", "No valid result was found"),
];

/// Returns the meaning of a code; `None` if it is not about the input.
pub(super) fn meaning(code: &str) -> Option<&'static str> {
    let mut all = CAUSES.iter();
    all.find_map(|(word, meaning)| (*word == code).then_some(*meaning))
}
