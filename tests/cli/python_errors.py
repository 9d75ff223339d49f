# Called by python_module.sh in a folder with the show dome.yaml: what the module refuses, and in
# what words; and that a signal ends long work.
import os
import pathlib
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
for threads in (-1, 1025, 2**31, 10**30, np.int64(-1)):
    raises(mistaken, f"threads must be from 0 to 1024, got {threads}",
           lambda: domefall.Show("absent.yaml", threads))
for threads in (1.0, "1", True, None, np.float64(1)):
    raises(TypeError, "integer", lambda: domefall.Show("dome.yaml", threads))

# Paths are those that Python opens, and what cannot be one is not worth another try.
for path in (b"dome.yaml", pathlib.Path("dome.yaml"), np.str_("dome.yaml"), "./dome.yaml"):
    assert domefall.Show(path).file == pathlib.Path("dome.yaml").absolute(), path
for path in ("", b"", np.str_("")):
    raises(mistaken, "file must be the path of a show, got an empty one", lambda: domefall.Show(path))
for path in ("a\0b", b"a\0b", "\ud800"):
    raises(mistaken, "is no path: ", lambda: domefall.Show(path))
for path in (3, None, 1.5, ["dome.yaml"], bytearray(b"dome.yaml")):
    raises(TypeError, "PathLike", lambda: domefall.Show(path))
raises(mistaken, "this is a folder", lambda: domefall.Show("."))

raises(mistaken, "frame 24: the show has 24 frames", lambda: show.frame(24))
raises(mistaken, "frame -1: the show has 24 frames", lambda: show.graded(-1))
for number in (2**31, 2**63, 2**70, -2**70, np.uint64(2**63)):
    for use in (show.frame, show.graded, show.states):
        raises(mistaken, f"frame {number}: the show has 24 frames", lambda: use(number))
raises(mistaken, "frame 0x", lambda: show.frame(10**5000))
raises(mistaken, f"frame {2**70}: ", lambda: show.states([0, 2**70]))
for number in (1.0, "1", None, True, np.float32(1), [1], np.nan):
    raises(TypeError, "integer", lambda: show.frame(number))
for frames in ("1", [1, None], {1}, [True, 2**70], 1j):
    raises(TypeError, "integer", lambda: show.states(frames))
for frames in ([], np.zeros((0, 2)), range(0)):
    assert show.states(frames).size == 0
# Any integers will do, however they lie in memory.
wanted = np.array([[3, 20], [5, 1]])
for frames in (wanted.T, wanted[::-1], wanted.astype(">u2"), wanted.astype(object), wanted.tolist(),
               np.asfortranarray(wanted), np.matrix(wanted)):
    assert np.array_equal(show.states(frames)["frame"], np.array(frames)), frames
for number in (np.int8(3), np.uint64(3), np.array(3)):
    assert np.array_equal(show.frame(number), show.frame(3)), number
raises(mistaken, "frame 24: ", lambda: show.states([[0, 24]]))
raises(TypeError, "frames must be integers, got an array of float64", lambda: show.states([0.5]))
raises(TypeError, "frames must be integers, got an array of bool", lambda: show.states([True]))
unmade = domefall.Show.__new__(domefall.Show)
for use in (lambda: unmade.frame(0), lambda: unmade.states(), lambda: unmade.graded(0),
            lambda: unmade.title, lambda: repr(unmade)):
    raises(TypeError, "its __init__ was not called", use)
raises(TypeError, "expected a domefall.Show, got 3", lambda: domefall.Show.frame(3, 0))
for size in (15, "5k", -1, 10**30, (64, 64), "64x64"):
    raises(mistaken, ": a dome takes 1k, 2k, 4k, 8k or a number", lambda: show.frame(0, size))
raises(mistaken, f"size {2**70}: a dome", lambda: show.frame(0, 2**70))
for size in ((1, 2, 3), (), "", [64]):
    raises(mistaken, "size must be a number of pixels", lambda: show.frame(0, size))
for size in (b"4k", True, (True, 64), ("a", "b"), np.nan, {64: 64}):
    raises(TypeError, "integer", lambda: show.frame(0, size))
for size in ("64\0", "\ud800", "64 "):
    raises(mistaken, "a dome takes", lambda: show.frame(0, size))
for size in (np.int16(64), "64"):
    assert show.frame(0, size).shape == (64, 64, 3), size
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
for wrong in (None, "", "6\0 7", "\ud800", np.inf, -np.inf, 2**70, -0.0, 5e-324, "1e-400", [[]] * 2):
    if np.shape(wrong) != (2, 0):
        raises(mistaken, "r must be", lambda: trace(wrong, 1))
    else:
        assert trace(wrong, 1).shape == (2, 0)
raises(mistaken, "observer must be", lambda: trace(6, 1, observer="\ud800"))
raises(mistaken, "edge must be", lambda: trace(6, edge=["silhouette", "\0x"]))
# Numbers of any kind and order in memory are those that they stand for.
grid = np.array([[6.0, 7.0], [8.0, 9.0]])
for r in (grid.T, grid[:, ::-1], grid.astype(">f4"), grid.astype(int), grid.astype(object),
          grid.astype("U"), grid.astype("S"), grid.astype(np.longdouble)):
    assert np.array_equal(trace(r, 1)["phi"], trace(np.array(r.astype(float)), 1)["phi"]), r.dtype
raises(TypeError, "delta must be real numbers", lambda: trace(6, [1j]))
spin, wormhole = domefall.trace_spin, domefall.trace_wormhole
raises(mistaken, "ray [1]: spin^2 + charge^2 must be at most 1", lambda: spin(6, 1, spin=[0.5, 1.1]))
raises(mistaken, "a ray takes delta, or an edge", lambda: spin(6, spin=0.5))
raises(mistaken, "offset is given without an edge", lambda: spin(6, 1, spin=0.5, offset=0))
raises(mistaken, "there is no edge region3 at this r", lambda: spin(6, spin=0.5, edge="region3"))
raises(mistaken, "edge must be silhouette", lambda: spin([6, 0.01], spin=0.9, edge=["silhouette", "r" * 99]))
raises(mistaken, "theta must be from 0 to pi", lambda: spin(6, 1, theta=4))
raises(TypeError, "eta must be real numbers", lambda: spin(6, 1, eta=1j))
raises(mistaken, "profile must be", lambda: wormhole(3, 1, profile="flat"))
raises(mistaken, "method must be table or exact, got 'rk4'", lambda: wormhole(3, 1, method="rk4"))
raises(mistaken, "delta is 1, and edge and offset give", lambda: wormhole(3, 1, edge="throat"))
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
