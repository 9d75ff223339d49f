# Called by python_module.sh in a folder where the program has left its states, rays and frames:
# those of the module must be the same.  The argument is the table of reference rays.
import csv
import json
import sys
import threading

import numpy as np

import domefall


def rows(path):
    return list(csv.DictReader(line for line in open(path) if not line.startswith("#")))


def linear(path, kind, height, width):
    """The pixels of an EXR without compression: in each row a head of 8 bytes, then B, G and R."""
    row = np.dtype([("head", "V8"), ("bgr", kind, (3, width))])
    body = open(path, "rb").read()[-row.itemsize * height:]
    return np.frombuffer(body, row)["bgr"].transpose(0, 2, 1)[:, :, ::-1]


def graded(path, shape):
    return np.fromfile(path, "<u2").reshape(shape)


def check_states(name):
    show = domefall.Show(f"{name}.yaml")
    states, truth = show.states(), json.load(open(f"{name}.json"))
    assert states.shape == (show.frames,) == (len(truth),)
    columns = list(states.dtype.names)
    assert columns == list(rows(f"{name}.csv")[0]) == list(truth[0])[:len(columns)]
    for column in states.dtype.names:
        assert states[column].tolist() == [state[column] for state in truth], column
    for state, row in zip(states, rows(f"{name}.csv")):
        assert f"{state['r']:.17g}" == row["r"] and f"{state['ra_deg']:.15g}" == row["ra_deg"]
    for some in (5, np.int64(5), [[7, 1], [0, 7]], range(3), [], np.arange(9, dtype="u1")[::-2]):
        assert np.array_equal(show.states(some), states[np.asarray(some, dtype=int)]), some


def check_rays(path):
    table = rows(path)
    given = {name: [row[name] for row in table] for name in ("observer", "r", "delta", "edge")}
    given["offset"] = [row["offset"] or "0" for row in table]
    for method, limit in (("table", 1e-10), ("exact", 1e-13), ("binet-dopri5", None)):
        rays, printed = domefall.trace(**given, method=method), rows(f"rays_{method}.csv")
        assert rays.shape == (len(printed),) and len(printed) > 700
        assert list(rays.dtype.names) == list(printed[0])
        for name in ("observer", "edge", "origin"):
            assert rays[name].tolist() == [row[name] for row in printed], (method, name)
        for name in ("phi", "one_plus_z", "slope", "amplification"):
            seen = [float(row[name] or "nan") for row in printed]
            assert np.array_equal(rays[name], seen, equal_nan=True), (method, name)
        truth = np.array([float(row["phi"]) for row in table])
        error = np.abs(rays["phi"] - truth) / np.maximum(1, np.abs(truth))
        assert limit is None or error.max() < limit, (method, error.max())


def check_holes():
    """Rays near spins and charges, and in wormholes, are those that the program has printed."""
    for kind, trace, names in (
            ("kerr", domefall.trace_spin, ("r", "delta", "spin", "charge", "theta", "eta", "edge", "offset")),
            ("charged", domefall.trace_spin, ("r", "delta", "spin", "charge", "theta", "eta", "edge", "offset")),
            ("wormhole", domefall.trace_wormhole, ("l", "delta", "profile", "rho", "a", "m", "edge", "offset"))):
        printed = rows(f"rays_{kind}.csv")
        rays = trace(**{name: [row[name] for row in printed] for name in names})
        assert rays.shape == (len(printed),) and len(printed) > 100, kind
        assert list(rays.dtype.names) == list(printed[0]), kind
        for name in list(printed[0])[len(names):]:
            if rays.dtype[name].kind == "U":
                assert rays[name].tolist() == [row[name] for row in printed], (kind, name)
            else:
                seen = [float(row[name] or ("0" if name == "turns" else "nan")) for row in printed]
                assert np.array_equal(rays[name], seen, equal_nan=True), (kind, name)
    dome = domefall.trace_spin(10, np.linspace(0.8, 3, 5), spin=0.9, eta=[[0], [1.5]])
    assert dome.shape == (2, 5) and np.allclose(dome["x"]**2 + dome["y"]**2 + dome["z"]**2, 1, atol=1e-14)
    assert dome["theta"][0, 0] == np.pi / 2 and set(dome["origin"].flat) == {"I"}
    through = domefall.trace_wormhole(3.0, [0.1, 2.0], method="exact")
    assert through["origin"].tolist() == ["other", "own"]


def check_broadcasting():
    r, delta = np.array([[1.5], [3], [2.5], [40]]), np.linspace(0.1, 3.1, 7)
    grid = domefall.trace(r, delta)
    assert grid.shape == (4, 7) and np.array_equal(grid["r"], np.broadcast_to(r, (4, 7)))
    for i in range(4):
        for k in range(7):
            assert domefall.trace(r[i, 0], delta[k]).tobytes() == grid[i, k].tobytes()
    wide = np.asfortranarray(np.repeat(delta, 3).reshape(7, 3))
    assert np.array_equal(domefall.trace(6, wide[::2, ::-1])["phi"],
                          domefall.trace(6, np.ascontiguousarray(wide[::2, ::-1]))["phi"])
    assert domefall.trace(6, np.float32(0.5))["phi"] == domefall.trace(6.0, 0.5)["phi"]
    assert domefall.trace(np.zeros((0, 3)), 1).shape == (0, 3)
    edge = domefall.trace(2.5, edge="silhouette", offset=[0, 1e-12])
    assert edge["origin"].tolist() == ["IV", "I"] and np.isinf(edge["phi"][0])
    assert edge["delta"][0] == domefall.trace(2.5, edge="silhouette")["delta"]
    # A longer number than a double keeps the ray's distance from pi.
    back = domefall.trace(6, np.nextafter(np.longdouble(np.pi), np.longdouble(4)), method="exact")
    assert back["phi"] != domefall.trace(6, np.pi, method="exact")["phi"]


def check_frames():
    dome, flat = domefall.Show("dome.yaml"), domefall.Show("flat.yaml", threads=1)
    assert (dome.size, flat.size) == ((96, 96), (80, 48))
    for number in (3, 20):
        picture = dome.frame(number)
        assert picture.dtype == np.float32 and picture.shape == (96, 96, 3)
        truth = linear(f"dome/linear/dome_{number:05}.exr", "<f4", 96, 96)
        assert picture.tobytes() == truth.tobytes()
        codes = dome.graded(number)
        assert codes.dtype == np.uint16
        assert np.array_equal(codes, graded(f"dome/graded/dome_{number:05}.raw", (96, 96, 3)))
    truth = linear("larger/linear/dome_00020.exr", "<f4", 130, 130)
    for size in (130, np.int16(130), "130"):
        assert dome.frame(20, size).tobytes() == truth.tobytes()
    codes = graded("larger/graded/dome_00020.raw", (130, 130, 3))
    assert np.array_equal(dome.graded(20, 130), codes)
    assert dome.frame(20).tobytes() == picture.tobytes(), "after another size"
    for number in (7, 12):
        codes = graded(f"flat/graded/flat_{number:05}.raw", (48, 80, 3))
        assert np.array_equal(flat.graded(number), codes)
        # Files of half floats are means and mixtures of rounded instants.
        half = linear(f"flat/linear/flat_{number:05}.exr", "<f2", 48, 80).astype("f4")
        assert np.allclose(flat.frame(number), half, rtol=2e-3, atol=1e-6)
        assert np.array_equal(flat.graded(number, (80, 48)), codes)


def check_threads():
    show = domefall.Show("dome.yaml", threads=2)
    alone = {number: show.frame(number, 64).tobytes() for number in range(0, 24, 3)}
    states, wrong = show.states().tobytes(), []

    def work(numbers):
        for number in numbers:
            same = show.frame(number, 64).tobytes() == alone[number]
            if not same or show.states().tobytes() != states:
                wrong.append(number)

    orders = [sorted(alone, reverse=k % 2) for k in range(4)]
    threads = [threading.Thread(target=work, args=(numbers,)) for numbers in orders]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong, wrong


def check_properties():
    show = domefall.Show("flat.yaml")
    assert show.title == "Ein flaches Bild – 平" and repr(show).startswith("<domefall.Show 'Ein ")
    assert (show.frames, show.frames_per_second, show.mass_solar) == (15, 10.0, 10.0)
    assert show.projection == "stereographic" and show.file.is_absolute() and show.file.exists()
    for thing in (domefall.Show, domefall.trace, domefall.Show.frame, domefall.Show.states,
                  domefall.Show.graded, domefall.Show.size, domefall.InputError):
        assert len(thing.__doc__) > 20, thing


check_properties()
for name in ("dome", "flat"):
    check_states(name)
check_rays(sys.argv[1])
check_holes()
check_broadcasting()
check_frames()
check_threads()
