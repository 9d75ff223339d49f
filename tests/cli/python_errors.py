# Called by python_module.sh in a folder with the show dome.yaml: what the module refuses, and in
# what words; and that a signal ends long work.
import os
import signal
import time

import numpy as np

import domefall


def raises(kind, words, call):
    try:
        result = call()
    except Exception as error:
        assert type(error) is kind and words in str(error), (type(error), str(error))
    else:
        raise AssertionError(f"{words!r} was not raised, but returned {result!r}")


def write(name, text):
    with open(name, "w") as file:
        file.write(text)
    return name


assert issubclass(domefall.InputError, ValueError) and issubclass(domefall.TemporaryError, OSError)
show, trace, mistaken = domefall.Show("dome.yaml"), domefall.trace, domefall.InputError

broken = write("broken.yaml", "timeline:\n  - {duration_s: -1, trajectory: {type: static}}\n")
raises(mistaken, "/broken.yaml:2:18: timeline[1].duration_s must exceed 0 (seconds), got -1",
       lambda: domefall.Show(broken))
raises(mistaken, "No such file", lambda: domefall.Show("absent.yaml"))
raises(mistaken, "No such file", lambda: domefall.Show(os.fsencode("absent") + b"\xff"))
missing = write("missing.yaml", "sky: {region_I: {background: absent.exr}}\n"
                "timeline: [{duration_s: 1, trajectory: {type: static}}]\n")
raises(domefall.TemporaryError, "absent.exr", lambda: domefall.Show(missing))
raises(mistaken, "threads must be from 0 to 1024, got -1", lambda: domefall.Show("dome.yaml", -1))

raises(mistaken, "frame 24: the show has 24 frames", lambda: show.frame(24))
raises(mistaken, "frame -1: the show has 24 frames", lambda: show.graded(-1))
raises(mistaken, "the show has 24 frames", lambda: show.frame(10**30))
raises(mistaken, "frame 24: ", lambda: show.states([[0, 24]]))
raises(TypeError, "cannot be interpreted as an integer", lambda: show.frame(1.0))
raises(TypeError, "frames must be integers, got an array of float64", lambda: show.states([0.5]))
raises(TypeError, "frames must be integers, got an array of bool", lambda: show.states([True]))
unmade = domefall.Show.__new__(domefall.Show)
for use in (lambda: unmade.frame(0), lambda: unmade.states(), lambda: unmade.graded(0),
            lambda: unmade.title, lambda: repr(unmade)):
    raises(TypeError, "its __init__ was not called", use)
raises(TypeError, "expected a domefall.Show, got 3", lambda: domefall.Show.frame(3, 0))
for size in (15, "5k", -1, 10**30, (64, 64), "64x64"):
    raises(mistaken, ": a dome takes 1k, 2k, 4k, 8k or a number", lambda: show.frame(0, size))
raises(mistaken, "size must be a number of pixels", lambda: show.frame(0, (1, 2, 3)))
raises(TypeError, "cannot be interpreted as an integer", lambda: show.frame(0, 64.5))

raises(mistaken, "ray [1]: r must be from 1e-9 to 1e12 (units of M), got nan",
       lambda: trace([6, np.nan], 1))
raises(mistaken, "ray [1, 2]: delta must be from 0 to pi, got 4",
       lambda: trace([[6.0], [7.0]], np.array([[1, 2, 3], [1, 2, 4]])))
raises(mistaken, "ray [0]: r must be a number, got 'six'", lambda: trace(["six"], 1))
raises(mistaken, "delta must be from 0 to pi, got nan", lambda: trace(6, None, edge=""))
raises(mistaken, "a ray takes delta, or an edge", lambda: trace(6))
raises(mistaken, "offset is given without an edge", lambda: trace(6, 1, offset=0))
raises(mistaken, "edge must be silhouette, region3 or empty", lambda: trace(6, edge="rim"))
raises(mistaken, "ray [1]: delta is 1, and edge and offset give 0.78",
       lambda: trace([6, 6], [np.nan, 1], edge="silhouette", observer="static"))
raises(mistaken, "observer must be rain, static", lambda: trace(6, 1, observer="Rain"))
raises(mistaken, "r must exceed 2", lambda: trace(2, 1, observer="static"))
raises(mistaken, "method must be one of table, exact, rk4", lambda: trace(6, 1, method="euler"))
raises(mistaken, "tolerance must be from 1e-13 to 1e-3", lambda: trace(6, 1, tolerance=np.nan))
raises(TypeError, "delta must be real numbers", lambda: trace(6, [1j]))
raises(TypeError, "r must be real numbers", lambda: trace(np.array([True]), 1))
raises(ValueError, "broadcast", lambda: trace([6, 7, 8], [1, 2]))


class Enough(Exception):
    pass


def stop(number, stack):
    raise Enough


def is_stopped(call):
    """Stops a call that would take much longer, as Ctrl-C does."""
    start = time.monotonic()
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        call()
    except Enough:
        return time.monotonic() - start < 60
    return False


# Hours of integration, and a minute's exposure of a dome.
signal.signal(signal.SIGALRM, stop)
before = show.frame(3).tobytes()
whirl = domefall.Show(write("whirl.yaml", """
frames_per_second: 1
size: 2048
black_hole: {mass_solar: 10}
sky: {region_I: {stars: none}}
exposure: {shutter_deg: 360}
timeline: [{duration_s: 9, trajectory: {type: circular, r: 6, orbits: 9}}]
"""))
angles = np.linspace(1, 3, 10**5)
assert is_stopped(lambda: trace(6, angles, method="rk4", tolerance=1e-13))
assert is_stopped(lambda: whirl.frame(4))
assert whirl.frame(4, 16).any() and show.frame(3).tobytes() == before
