"""The command in the package: files, signals, and the service, whose jobs are computed by interpreters."""

import os
import signal
import subprocess
import sys

import pytest
import unwrapd
from conftest import waves
from service import COMMAND, Service, obj


def run(*arguments, **more):
    return subprocess.run([*COMMAND, *map(str, arguments)], capture_output=True, text=True, **more)


@pytest.fixture
def pyramid_file(tmp_path, pyramid):
    path = tmp_path / "pyramid.obj"
    path.write_text(obj(*pyramid))
    return path


def test_a_file(pyramid_file):
    output = pyramid_file.with_name("out.glb")
    done = run("unwrap", pyramid_file, "-o", output)
    assert done.returncode == 0, done.stderr
    assert unwrapd.verify_file(output)["certified"]


def test_usage_and_exit_statuses(tmp_path):
    version = run("--version")
    assert (version.returncode, version.stdout) == (0, f"unwrapd {unwrapd.__version__}\n")
    wrong = run("unwrap", "--paddin", 3)
    assert wrong.returncode == 2 and "Usage: unwrapd unwrap" in wrong.stderr
    (tmp_path / "empty.obj").write_text("")
    assert run("measure", tmp_path / "empty.obj").returncode == 3


def test_a_batch(pyramid_file, tmp_path):
    done = run("batch", pyramid_file.parent, "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "out/pyramid.glb").exists()


def test_ctrl_c_is_not_pythons(tmp_path):
    (tmp_path / "sheet.obj").write_text(obj(*waves(400)))
    arguments = ["unwrap", "sheet.obj", "-o", "out.glb"]
    process = subprocess.Popen([*COMMAND, *arguments], stderr=subprocess.PIPE, text=True, cwd=tmp_path)
    process.stderr.read(1)
    process.send_signal(signal.SIGINT)
    assert "Traceback" not in process.communicate(timeout=60)[1]
    assert process.returncode == -signal.SIGINT


def test_a_job_over_its_memory_limit(tmp_path, pyramid, sheet):
    with Service(tmp_path, "--job-memory-mib", "160") as service:
        job = service.job(sheet(400))
        assert job["state"] == "failed"
        assert job["error"]["code"] == "out_of_memory"
        assert "160 MiB" in job["error"]["detail"]
        assert service.job(pyramid)["state"] == "succeeded"
        service.process.send_signal(signal.SIGTERM)
        assert service.process.wait(timeout=60) == 0


def test_a_python_that_finds_its_library_by_the_path_of_libraries(tmp_path, pyramid):
    # As the dynamic linker does it: without the path the interpreter does not start.
    python, path = tmp_path / "python", str(tmp_path / "lib")
    python.write_text(f'#!/bin/sh\n[ "$LD_LIBRARY_PATH" = {path} ] && exec {sys.executable} "$@"\nexit 127\n')
    python.chmod(0o755)
    main = f"import sys; sys.executable = {str(python)!r}; from unwrapd.__main__ import main; sys.exit(main())"
    environment = {**os.environ, "LD_LIBRARY_PATH": path}
    command = [sys.executable, "-c", main]
    with Service(tmp_path / "data", command=command, environment=environment) as service:
        assert service.job(pyramid)["state"] == "succeeded"


def test_equal_jobs_and_live_sessions(tmp_path, pyramid):
    with Service(tmp_path) as service:
        assert service.job(pyramid)["state"] == "succeeded"
        assert service.job(pyramid)["cached"]
        session = "/v1/sessions?kind=deform&cage=4&filename=mesh.obj"
        assert service.call("POST", session, obj(*pyramid).encode())["kind"] == "deform"
        service.process.send_signal(signal.SIGINT)
        assert service.process.wait(timeout=60) == 0
