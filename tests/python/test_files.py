"""Files and bytes."""

import pathlib
import shutil

import pytest
import unwrapd

ASSETS = pathlib.Path(__file__).resolve().parents[1] / "assets"
BOX = ASSETS / "Box.glb"


def test_unwrap_file(tmp_path):
    report = unwrapd.unwrap_file(BOX, tmp_path / "out.glb", padding=4)
    assert report["certified"] and report["options"]["padding"] == 4
    assert unwrapd.verify_file(tmp_path / "out.glb", bijective=True)["certified"]
    assert unwrapd.measure_file(str(tmp_path / "out.glb"))["groups"][0]["measures"]["flipped"] == 0
    assert [path.name for path in tmp_path.iterdir()] == ["out.glb"]


def test_files_beside_it(tmp_path):
    unwrapd.unwrap_file(BOX, tmp_path / "out.gltf")
    names = sorted(path.name for path in tmp_path.iterdir())
    assert "out.gltf" in names and len(names) > 1
    assert unwrapd.verify_file(tmp_path / "out.gltf")["certified"]


def test_repack_file(tmp_path):
    unwrapd.unwrap_file(BOX, tmp_path / "a.glb")
    assert unwrapd.repack_file(tmp_path / "a.glb", tmp_path / "b.obj", padding=8)["certified"]


def test_bytes():
    data, report = unwrapd.unwrap_bytes(BOX.read_bytes())
    assert report["certified"] and data[:4] == b"glTF"
    text, _ = unwrapd.unwrap_bytes(BOX.read_bytes(), format="obj")
    assert b"\nvt " in text
    with pytest.raises(unwrapd.InvalidOptions):
        unwrapd.unwrap_bytes(BOX.read_bytes(), format="gltf")


def test_resources(tmp_path):
    unwrapd.unwrap_file(BOX, tmp_path / "out.gltf")
    others = {path.name: path.read_bytes() for path in tmp_path.iterdir() if path.suffix != ".gltf"}
    main = (tmp_path / "out.gltf").read_bytes()
    assert unwrapd.unwrap_bytes(main, "out.gltf", resources=others)[1]["certified"]
    with pytest.raises(unwrapd.InvalidInput):
        unwrapd.unwrap_bytes(main, "out.gltf")


def test_what_cannot_be(tmp_path):
    with pytest.raises(FileNotFoundError):
        unwrapd.unwrap_file(tmp_path / "none.glb", tmp_path / "out.glb")
    with pytest.raises(unwrapd.InvalidOptions, match="must end in"):
        unwrapd.unwrap_file(BOX, tmp_path / "out.png")
    with pytest.raises(unwrapd.InvalidInput) as raised:
        unwrapd.unwrap_bytes(b"no mesh")
    assert raised.value.code == "invalid_gltf"
    own = shutil.copy(BOX, tmp_path / "own.glb")
    with pytest.raises(unwrapd.InvalidOptions, match="replace the input"):
        unwrapd.unwrap_file(own, own)
    assert [path.name for path in tmp_path.iterdir()] == ["own.glb"]
