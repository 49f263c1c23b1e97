"""What is said of options and meshes that cannot be read is said in Python's words."""

import pytest

from unwrapd._errors import in_words


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (
            "`padding`: invalid type: floating point `4.0`, expected u32",
            "padding must be a whole number from 0 on, not 4.0",
        ),
        (
            "`padding`: invalid value: integer `-1`, expected u32",
            "padding must be a whole number from 0 on, not -1",
        ),
        (
            '`max_charts`: invalid type: string "3", expected usize',
            'max_charts must be a whole number from 0 on, not "3"',
        ),
        (
            "`rebake`: invalid type: sequence, expected a boolean",
            "rebake must be True or False, not a list",
        ),
        (
            "`quality`: unknown variant `balancd`, expected one of `smooth`, `balanced`, `few`",
            "quality must be 'smooth', 'balanced' or 'few', not 'balancd'; did you mean 'balanced'?",
        ),
        (
            "`quality`: unknown variant `best`, expected one of `smooth`, `balanced`, `few`",
            "quality must be 'smooth', 'balanced' or 'few', not 'best'",
        ),
        ("`padding` must lie between 0 and 128, not 129", "`padding` must lie between 0 and 128, not 129"),
    ],
)
def test_the_words_of_an_option(said, words):
    assert in_words(said) == words


def test_what_is_no_mesh_is_told_what_is_expected():
    import numpy
    import unwrapd

    vertices, faces = numpy.eye(3), numpy.array([[0, 1, 2]])
    for given, words in [
        ("chair.glb", "unwrap_file"),
        ((vertices, faces), r"unwrap\(\*mesh\)"),
        ({"vertices": vertices}, "a dict"),
    ]:
        with pytest.raises(TypeError, match=words):
            unwrapd.unwrap(given)
    with pytest.raises(unwrapd.InvalidOptions, match="time_budget must be a finite number, not nan"):
        unwrapd.unwrap(vertices, faces, time_budget=float("nan"))
    with pytest.raises(unwrapd.InvalidInput, match="none of the 1 triangles has an area"):
        unwrapd.unwrap(numpy.zeros((3, 3)), faces)


def test_each_mesh_of_a_list_shows_its_own_charts():
    import numpy
    import unwrapd

    mesh = (numpy.eye(3), numpy.array([[0, 1, 2]]))
    atlases = unwrapd.unwrap([mesh, mesh], progress=True)
    assert ["1 faces, 1 charts" in repr(atlas) for atlas in atlases] == [True, True]


def test_a_folder_that_is_not_there_is_not_made(tmp_path):
    import unwrapd

    source = tmp_path / "a.obj"
    source.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.raises(FileNotFoundError, match="new"):
        unwrapd.unwrap_file(source, tmp_path / "new" / "o.glb")
    assert not (tmp_path / "new").exists()
