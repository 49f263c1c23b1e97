"""Calls: progress, early ends, Ctrl-C, threads, forks, memory."""

import _thread
import os
import threading
import time

import numpy as np
import pytest
import unwrapd

#: Large enough that unwrapping it takes seconds.
SIDE = 220


def test_progress(sheet):
    seen = []
    unwrapd.unwrap(*sheet(90), progress=seen.append)
    fractions = [progress.fraction for progress in seen]
    assert fractions == sorted(fractions) and 0 <= fractions[0] and fractions[-1] <= 1
    assert {"map"} <= {progress.stage for progress in seen}
    assert repr(seen[-1]).startswith("Progress(")


def test_false_ends_with_the_present_map(sheet):
    atlas = unwrapd.unwrap(*sheet(SIDE), progress=lambda progress: progress.stage != "map")
    assert atlas.certified
    assert "ended_early" in {warning["code"] for warning in atlas.report["warnings"]}


def test_time_budget(sheet):
    begin = time.monotonic()
    atlas = unwrapd.unwrap(*sheet(SIDE), time_budget=0.5)
    assert atlas.certified
    assert "ended_early" in {warning["code"] for warning in atlas.report["warnings"]}
    assert time.monotonic() - begin < 60


def test_ctrl_c(sheet):
    mesh, pressed = sheet(SIDE), []

    def press():
        time.sleep(0.3)
        pressed.append(time.monotonic())
        _thread.interrupt_main()

    presser = threading.Thread(target=press)
    presser.start()
    with pytest.raises(KeyboardInterrupt):
        unwrapd.unwrap(*mesh)
    assert time.monotonic() - pressed[0] < 0.2
    presser.join()


def test_an_exception_cancels(sheet):
    class Enough(Exception):
        pass

    def enough(progress):
        raise Enough

    with pytest.raises(Enough):
        unwrapd.unwrap(*sheet(SIDE), progress=enough)


def test_the_interpreter_is_released(sheet):
    ticks, is_done = [], threading.Event()

    def tick():
        while not is_done.wait(0.01):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    unwrapd.unwrap(*sheet(100))
    is_done.set()
    ticker.join()
    assert len(ticks) > 10
    assert np.diff(ticks).max() < 0.5


def test_threads(sheet):
    expected, found = unwrapd.unwrap(*sheet(30)).uvs, [None] * 4

    def work(number):
        found[number] = unwrapd.unwrap(*sheet(30), threads=1).uvs

    workers = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all((uvs == expected).all() for uvs in found)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_after_a_fork(sheet):
    """No thread outlives a call, so a child has lost nothing."""
    mesh = sheet(30)
    expected = unwrapd.unwrap(*mesh)
    image, _ = unwrapd.bake(expected, mesh[0], 32)
    child = os.fork()
    if child == 0:
        again = unwrapd.unwrap(*mesh)
        is_same = (again.uvs == expected.uvs).all() and (
            unwrapd.bake(again, mesh[0], 32)[0] == image
        ).all()
        os._exit(0 if is_same else 1)
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            assert os.waitstatus_to_exitcode(status) == 0
            return
        time.sleep(0.01)
    os.kill(child, 9)
    os.waitpid(child, 0)
    pytest.fail("the child hangs")


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="no /proc here")
def test_nothing_leaks(pyramid):
    """Small calls, of which some fail, leave nothing behind."""

    def call(times):
        for number in range(times):
            if number % 10 == 0:
                with pytest.raises(unwrapd.InvalidInput):
                    unwrapd.unwrap(pyramid[0], pyramid[1] + 4, threads=1)
            else:
                unwrapd.unwrap(*pyramid, cut="fast", threads=1, progress=lambda progress: None)

    call(100)
    before = resident()
    call(int(os.environ.get("UNWRAPD_CALLS", 200)))
    assert resident() - before < 4 << 20


@pytest.mark.skipif(not os.path.exists("/proc/self/task"), reason="no /proc here")
def test_cancelled_work_ends_in_silence(sheet, capfd):
    def workers():
        names = []
        for task in os.listdir("/proc/self/task"):
            try:
                with open(f"/proc/self/task/{task}/comm") as file:
                    names.append(file.read().strip())
            except OSError:
                pass
        return names.count("unwrapd")

    def stop(progress):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        unwrapd.unwrap(*sheet(SIDE), progress=stop)
    deadline = time.monotonic() + 30
    while workers() and time.monotonic() < deadline:
        time.sleep(0.01)
    assert workers() == 0
    assert capfd.readouterr() == ("", "")
