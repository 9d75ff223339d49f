#!/usr/bin/env python3
"""Writes far_ends.csv: geodesics at the ends of long ways, M = 1.

Usage: make_far_ends.py > far_ends.csv      (mpmath 1.3, some seconds)

Proper times are counted from the end that is near, by the quadratures of make_orbits.py: since the
past singularity, until the coming one, or since the periastron or apoastron, where an orbit began or
was thrown up to 1e9 M away.  The parameters are the doubles that they print as.
"""
from mpmath import mp, mpf, sqrt

from make_orbits import Orbit, speed_excess, thrown_orbit

DEEP = (1e-6, 1e-5, 1e-3, 0.05, 1.0, 1.9)
FIELDS = "kind,a,b,c,end,since,r,null_gain"
ROWS = []


def row(kind, parameters, end, since, r, null_gain):
    padded = [repr(p) for p in parameters] + [""] * (3 - len(parameters))
    numbers = [mp.nstr(x, 20) if x != "" else "" for x in (since, r, null_gain)]
    ROWS.append(",".join([kind] + padded + [end] + numbers))


def deep(kind, parameters, orbit, ends):
    """Between r = 0 and each radius; of E = 0 the null time is not an integral."""
    for end in ends:
        past = end == "past"
        for r in map(mpf, DEEP):
            since, _, gain = orbit.leg(mpf(0), r, True, "u")  # the way in is its mirror image
            row(kind, parameters, end, since if past else -since, r,
                "" if orbit.energy == 0 else gain if past else -gain)


def turning(kind, parameters, orbit, end, turn, radii):
    for r in map(mpf, radii):
        since = orbit.leg(turn, r, end == "periastron", "v")[0]
        row(kind, parameters, end, since, r, "")


def rest(r0, l):
    w = 1 / mpf(r0)
    return Orbit((1 - 2 * w) * (1 + (mpf(l) * w) ** 2) - 1, l)


for r0, l in ((30.0, 0.0), (10.0, 3.0), (2.000001, 0.0), (1e6, 0.0), (1e6, 3.9), (1e8, 0.0),
              (1e9, 0.0), (1e9, 3.999)):
    deep("rest", [r0, l], rest(r0, l), ["past", "future"])
    if r0 > 1e5:
        turning("rest", [r0, l], rest(r0, l), "apoastron", mpf(r0), [r0 * (1 - 1e-6), r0 / 2])
for l, r0 in ((0.0, 1e9), (3.9, 1e9), (3.999999, 30.0)):
    deep("infinity", [l, r0], Orbit(0, l), ["future"])
for v, b, r0 in ((0.5, 3.0, 1e9), (0.999999, 4.0, 1e9)):
    excess = speed_excess(mpf(v))
    deep("speed", [v, b, r0], Orbit(excess, mpf(b) * sqrt(excess)), ["future"])
for r0, a, b in ((1e9, -1e-3, 0.0), (1e9, -1e3, 1e-7), (10.0, -1e6, 100.0)):
    deep("thrown", [r0, a, b], thrown_orbit(r0, a, b), ["future"])
for r0, a, b in ((10.0, 2.0, 0.1), (1e9, 1e-3, 0.0), (3.0, 50.0, 1.0)):
    deep("thrown", [r0, a, b], thrown_orbit(r0, a, b), ["past"])
for e, l in ((0.99999999, 0.0), (0.9999999, 0.0), (0.99999999, 3.9), (0.5, 1.0), (0.0, 0.0),
             (0.0, 2.0), (2.0, 15.0), (1e-6, 0.0), (0.999999999999, 1.0)):
    orbit = Orbit(mpf(e) ** 2 - 1, l)
    deep("crossing", [e, l], orbit, ["past", "future"])
    top = orbit.radii[0]
    if top > 1e5:
        turning("crossing", [e, l], orbit, "apoastron", top, [top * (1 - mpf(10) ** -6), top / 2])
for e, l in ((1.0, 0.0), (1.0, 1.0), (1.0, 3.999), (2.0, 1.0), (1e3, 10.0)):
    deep("crossing", [e, l], Orbit(mpf(e) ** 2 - 1, l), ["past"])
# Past the hole after a throw from far away, unbound and bound.
for a, b in ((-4.5e-5, 5e-9), (-4e-5, 1e-8)):
    orbit = thrown_orbit(1e9, a, b)
    periastron = max(r for r in orbit.radii if r < 1e9)
    turning("thrown", [1e9, a, b], orbit, "periastron", periastron,
            [periastron * (1 + mpf(10) ** -9), periastron * 1.5, 1e3, 1e6])

print("# timelike geodesics at the ends of long ways, M = 1, computed with 50 digits by")
print("# make_far_ends.py; a, b, c: the factory's arguments; since: proper time since that end, negative")
print("# before it; null_gain: of u since the past singularity, or of v since the coming one")
print(FIELDS)
print("\n".join(ROWS))
