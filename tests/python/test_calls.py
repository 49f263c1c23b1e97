"""Calls: progress, early ends, Ctrl-C, threads, forks, memory."""

import _thread
import os
import threading
import time

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
    # It takes some 20 ms; a busy machine may let it wait, but not for as long as all of the work takes.
    assert time.monotonic() - pressed[0] < 5
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
    # If it were held, no tick would fall within the work.
    assert len(ticks) > 10


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


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_after_a_fork(sheet, forked):
    """No thread outlives a call, so a child has lost nothing."""
    mesh = sheet(30)
    expected = unwrapd.unwrap(*mesh)
    image, _ = unwrapd.bake(expected, mesh[0], 32)

    def is_same():
        again = unwrapd.unwrap(*mesh)
        baked = unwrapd.bake(again, mesh[0], 32)[0]
        return (again.uvs == expected.uvs).all() and (baked == image).all()

    assert forked(is_same)


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
