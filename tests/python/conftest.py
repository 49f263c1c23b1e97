"""The package under test: the installed one, or the sources around the extension that `UNWRAPD_NATIVE` names."""

import os
import pathlib
import signal
import sys
import tempfile
import threading
import time
import traceback

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def pytest_configure(config):
    native = os.environ.get("UNWRAPD_NATIVE")
    if native is None:
        return
    config.package = tempfile.TemporaryDirectory(prefix="unwrapd-package-")
    package = pathlib.Path(config.package.name) / "unwrapd"
    package.mkdir()
    for source in (ROOT / "src/python/unwrapd").iterdir():
        if source.suffix in (".py", ".pyi", ".typed"):
            (package / source.name).symlink_to(source)
    (package / "_native.abi3.so").symlink_to(native)
    sys.dont_write_bytecode = True
    sys.path.insert(0, config.package.name)
    os.environ["PYTHONPATH"] = config.package.name


def pytest_unconfigure(config):
    if hasattr(config, "package"):
        config.package.cleanup()


#: Children in which a test is begun anew before it counts as failed, and seconds in which no thread of a hanging child wakes.
CHILDREN = 10
ASLEEP = 2.0


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    """Runs what calls the package `xatlas` in a child process, and anew where that hangs.

    When its scheduler ends, it wakes its workers without the lock with which they wait: one that was about to wait sleeps
    for good. That happens where the machine is busy, and is no matter of ours.
    """
    params = getattr(pyfuncitem, "callspec", None) and pyfuncitem.callspec.params
    if getattr((params or {}).get("xatlas"), "__name__", "") != "xatlas":
        return None
    arguments = {name: pyfuncitem.funcargs[name] for name in pyfuncitem._fixtureinfo.argnames}
    for _ in range(CHILDREN):
        outcome = outcome_of(lambda: pyfuncitem.obj(**arguments))
        if outcome is not None:
            if outcome:
                pytest.fail(outcome, pytrace=False)
            return True
    pytest.fail(f"the package xatlas hung {CHILDREN} times")


def outcome_of(run):
    """What went wrong in a child process, or an empty text; None if it hung and was ended."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(reader)
        said = ""
        try:
            run()
        except BaseException:
            said = traceback.format_exc()
        with os.fdopen(writer, "w") as pipe:
            pipe.write(said)
        os._exit(0 if not said else 1)
    os.close(writer)
    hung = threading.Event()
    threading.Thread(target=watch, args=(child, hung), daemon=True).start()
    with os.fdopen(reader) as pipe:
        said = pipe.read()
    _, status = os.waitpid(child, 0)
    if hung.is_set():
        return None
    return said or ("" if status == 0 else f"the child ended with status {status}")


def watch(child, hung):
    """Ends a process all of whose threads sleep."""
    slept = 0.0
    while slept < ASLEEP:
        time.sleep(0.1)
        try:
            states = [
                path.read_text().rsplit(")", 1)[1].split()[0]
                for path in pathlib.Path(f"/proc/{child}/task").glob("*/stat")
            ]
        except OSError:
            return
        if not states or "Z" in states:
            return
        slept = slept + 0.1 if set(states) == {"S"} else 0.0
    hung.set()
    os.kill(child, signal.SIGKILL)


@pytest.fixture
def pyramid():
    """A pyramid without its base: one chart."""
    vertices = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 0.7]])
    return vertices, np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])


@pytest.fixture
def cube():
    """A closed cube."""
    corners = [[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces = [f for a, b, c, d in quads for f in ([a, b, c], [a, c, d])]
    return np.array(corners), np.array(faces)


def waves(side):
    """A bent sheet of side² vertices, large enough that work on it takes a while."""
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    vertices = np.stack([x, y, 0.3 * np.sin(9 * x) * np.cos(7 * y)], -1).reshape(-1, 3)
    at = np.arange(side * side).reshape(side, side)
    a, b, c, d = at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]
    faces = [np.stack(triangle, -1).reshape(-1, 3) for triangle in ([a, c, b], [a, d, c])]
    return vertices, np.concatenate(faces)


@pytest.fixture
def sheet():
    return waves


def in_child(check):
    """Whether a check holds in a child of this process, which may take a minute."""
    child = os.fork()
    if child == 0:
        try:
            os._exit(0 if check() else 1)
        finally:
            os._exit(2)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            return os.waitstatus_to_exitcode(status) == 0
        time.sleep(0.01)
    os.kill(child, 9)
    os.waitpid(child, 0)
    pytest.fail("the child hangs")


@pytest.fixture
def forked():
    if not hasattr(os, "fork"):
        pytest.skip("no fork here")
    return in_child
