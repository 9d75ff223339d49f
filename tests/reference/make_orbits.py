#!/usr/bin/env python3
"""Writes orbits.csv: timelike geodesics of the maximally extended Schwarzschild geometry, M = 1.

Usage: make_orbits.py > orbits.csv      (mpmath 1.3, some minutes)

Every quantity is an integral over r itself, by Gauss-Legendre quadrature with 50 digits between
turning points and over decades of the distance to each; turning points are roots of the cubic found with 150 digits:

    tau = int dr/|u|    phi = int L dr/(r^2 |u|)    u^2 = (E^2 - 1) + 2/r - L^2/r^2 + 2 L^2/r^3
    v, u: dv/dtau = (1 + L^2/r^2)/(E - u) inwards, (E + u)/(1 - 2/r) outwards; du/dtau the reverse

The radii are doubles; the parameters are the doubles that they print as.
"""
import sys
from mpmath import mp, mpf, sqrt, polyroots, log, fabs, inf
from mpmath.calculus.quadrature import GaussLegendre

mp.dps = 50
NODES = GaussLegendre(mp).calc_nodes(5, 200)  # 48 points
FIELDS = "kind,a,b,c,leg,periods,tau,r,azimuth,null_time,energy,angular_momentum"


class Orbit:
    """E^2 - 1 and L, the roots of the cubic, and integrals along a leg."""

    def __init__(self, excess, l):
        self.excess, self.l = mpf(excess), mpf(l)
        self.energy = sqrt(1 + self.excess)
        with mp.workdps(150):
            l2 = self.l ** 2
            coefficients = [2 * l2, -l2, mpf(2), self.excess] if l2 else [mpf(2), self.excess]
            while coefficients[-1] == 0:
                coefficients.pop()  # the root w = 0: infinity
            self.roots = polyroots(coefficients, maxsteps=2000, extraprec=600)
        self.radii = sorted(mp.re(1 / w) for w in self.roots
                            if fabs(mp.im(w)) < mpf(10) ** -60 and mp.re(w) > 0)

    def speed(self, r):
        w = 1 / r
        p = self.excess + 2 * w - self.l ** 2 * w ** 2 * (1 - 2 * w)
        return sqrt(p) if p > 0 else mpf(0)

    def cuts(self, a, b):
        low, high = min(a, b), max(a, b)
        cuts = {low, high}
        for w in self.roots:
            centre = mp.re(1 / w) if mp.re(w) != 0 else mpf(4)
            for k in range(-1, 16):
                for sign in (-1, 1):
                    cuts.add(centre * (1 + sign * mpf(10) ** -k))
        for k in range(-8, 31):
            cuts.add(mpf(10) ** k)
        cuts.add(mpf(2))
        return sorted(c for c in cuts if low <= c <= high)

    def leg(self, a, b, outward, null):
        """tau, phi and the null time `null` ("u" or "v") gained from r = a to r = b."""
        e, l = self.energy, self.l

        def integrands(r):
            u = self.speed(r)
            squares = 1 + (l / r) ** 2
            if e == 0:
                rate = mpf(0)
            elif outward == (null == "u"):
                rate = squares / (e + u)
            else:
                rate = (e + u) / (1 - 2 / r)
            return 1 / u, l / (r * r * u), rate / u

        cuts = self.cuts(a, b)
        sums = [mpf(0)] * 3
        for low, high in zip(cuts, cuts[1:]):
            # r = end +- x^2 from both ends, since either may be a turning point.
            half = sqrt((high - low) / 2)
            for end, sign in ((low, 1), (high, -1)):
                for node, weight in NODES:
                    x = half * (1 + node) / 2
                    values = integrands(end + sign * x * x)
                    for k in range(3):
                        sums[k] += half * weight * x * values[k]
        forward = 1 if (b > a) == outward else -1
        return [forward * s for s in sums]


def tortoise(r):
    return r + 2 * log(fabs(r - 2) / 2)


ROWS = []


def row(kind, parameters, leg, periods, sums, r, orbit):
    padded = list(parameters) + [""] * (3 - len(parameters))
    numbers = [mp.nstr(x, 20) for x in (sums[0], r, sums[1], sums[2], orbit.energy, orbit.l)]
    ROWS.append(",".join([kind] + [p if p == "" else repr(p) for p in padded] +
                         [leg, str(periods)] + numbers))


def turning(kind, parameters, orbit, near, far, radii, periods=(0,)):
    """tau = 0 at the periastron `near`."""
    whole = [2 * x for x in orbit.leg(near, far, True, "v")[:2]] if far != inf else [0, 0]
    null_whole = 0
    if far != inf:
        null_whole = orbit.leg(near, far, True, "v")[2] + orbit.leg(far, near, False, "v")[2]
    for r in radii:
        r = mpf(r)
        out = orbit.leg(near, r, True, "v")
        into = orbit.leg(near, r, False, "v")
        for n in periods:
            for leg, part in (("out", out), ("in", into)):
                sums = [part[0] + n * whole[0], part[1] + n * whole[1], part[2] + n * null_whole]
                row(kind, parameters, leg, n, sums, r, orbit)


def returning(kind, parameters, orbit, top, radii):
    """tau = 0 at the apoastron `top`; the outgoing tetrad before it."""
    jump = 2 * tortoise(top) if orbit.energy else 0
    for r in radii:
        r = mpf(r)
        after = orbit.leg(top, r, False, "v")
        before = orbit.leg(top, r, True, "u")
        if orbit.energy == 0:
            after[2], before[2] = tortoise(r), -tortoise(r)
        else:
            before[2] -= jump
        row(kind, parameters, "in", 0, after, r, orbit)
        row(kind, parameters, "out", 0, before, r, orbit)


def one_way(kind, parameters, orbit, start, outward, null, radii):
    """tau = 0 at `start`, no turning point between there and the radii."""
    for r in radii:
        r = mpf(r)
        row(kind, parameters, "out" if outward else "in", 0, orbit.leg(start, r, outward, null), r,
            orbit)


def by_turning_points(near, far):
    """E^2 - 1 and L of an orbit that turns at both; far may be infinite (E = 1)."""
    a, b = 1 / near, (1 / far if far != inf else mpf(0))
    l2 = 2 / ((a + b) - 2 * (a * a + a * b + b * b))
    return Orbit((1 - 2 * a) * (1 + l2 * a * a) - 1, sqrt(l2))


def parabolics():
    for rp, radii in ((4.5, (4.6, 30.0, 1e6)), (10.0, (10.000001, 12.0, 1e9)), (100.0, (300.0,))):
        turning("parabolic_periastron", [rp], by_turning_points(mpf(rp), inf), mpf(rp), inf, radii)
    for l, radii in ((4.2, (6.0, 1e3)), (30.0, (500.0, 1e4))):
        orbit = Orbit(0, l)
        turning("parabolic_angular_momentum", [l], orbit, orbit.radii[-1], inf, radii)
    for excess, radii in ((1e-10, (4.001, 4.5, 30.0, 1e6)), (1e-14, (4.0001, 10.0)), (0.5, (50.0,))):
        orbit = Orbit(0, 4 * (1 + mpf(excess)))
        turning("parabolic_excess", [excess], orbit, orbit.radii[-1], inf, radii)


def speed_excess(v):
    return v * v / (1 - v * v)


def critical_momentum(v):
    e = sqrt(1 + 8 * v * v)
    w = (1 + e) / (2 * (3 + e))
    return sqrt((speed_excess(v) + 2 * w) / (1 - 2 * w)) / w


def turned_at(v, rp):
    w = 1 / mpf(rp)
    excess = speed_excess(v)
    return Orbit(excess, sqrt((1 + excess) / (1 - 2 * w) - 1) / w)


def hyperbolics():
    for v, rp, radii in ((0.9999, 3.5, (3.6, 100.0, 1e6)), (0.3, 6.0, (6.5, 40.0)),
                         (1e-6, 10.0, (11.0, 1e4, 1e9)), (0.999999999, 3.01, (3.02, 50.0)),
                         (0.01, 1000.0, (1e4, 1e6))):
        turning("hyperbolic_periastron", [v, rp], turned_at(mpf(v), rp), mpf(rp), inf, radii)
    for rp, excess, radii in ((3.5, 1e-8, (3.51, 20.0)), (3.1, 1e-12, (3.101, 1000.0))):
        bound = sqrt(4 - mpf(rp)) / (mpf(rp) - 2)
        turning("hyperbolic_speed_excess", [rp, excess],
                turned_at(bound * (1 + mpf(excess)), rp), mpf(rp), inf, radii)
    for v, b, radii in ((0.5, 20.0, (30.0, 1e4)), (1e-3, 5000.0, (20.0, 1e7))):
        excess = speed_excess(mpf(v))
        orbit = Orbit(excess, mpf(b) * sqrt(excess))
        turning("hyperbolic_impact", [v, b], orbit, orbit.radii[-1], inf, radii)
    for v, excess, radii in ((0.5, 1e-8, (3.5, 30.0)), (0.9, 1e-14, (3.4, 100.0))):
        orbit = Orbit(speed_excess(mpf(v)), critical_momentum(mpf(v)) * (1 + mpf(excess)))
        turning("hyperbolic_impact_excess", [v, excess], orbit, orbit.radii[-1], inf, radii)


def bounds():
    for rp, ra, radii, periods in ((10.0, 20.0, (11.0, 19.0), (0, 1, 10000)),
                                   (5.0, 1000.0, (5.5, 500.0), (0, 3)),
                                   (30.0, 1e6, (31.0, 9e5), (0, 1))):
        turning("bound_turning_points", [rp, ra], by_turning_points(mpf(rp), mpf(ra)), mpf(rp),
                mpf(ra), radii, periods)
    for p, e, radii, periods in ((12.0, 0.5, (8.5, 20.0), (0, 1000)), (7.1, 0.5, (4.9,), (0, 2)),
                                 (10.0, 1e-6, (10.000003,), (0, 1))):
        near, far = mpf(p) / (1 + mpf(e)), mpf(p) / (1 - mpf(e))
        turning("bound_shape", [p, e], by_turning_points(near, far), near, far, radii, periods)
    for e, excess, radii, periods in ((0.5, 1e-8, (4.7, 10.0), (0, 10000)),
                                      (0.9, 1e-14, (4.2, 70.0), (0, 3)), (0.1, 1e-8, (6.0,), (0,))):
        p = 6 + 2 * mpf(e) + mpf(excess)
        near, far = p / (1 + mpf(e)), p / (1 - mpf(e))
        turning("bound_excess", [e, excess], by_turning_points(near, far), near, far, radii, periods)


def falls():
    for r0, l, radii in ((10.0, 3.0, (9.0, 2.0, 1.0, 1e-3)), (30.0, 0.0, (20.0, 2.0001, 0.1)),
                         (2.5, 1.0, (2.4, 1.999, 1e-3)), (1000.0, 3.9, (500.0, 3.9, 1.0)),
                         (2.5, 10.0, (2.3, 0.5)), (2.000001, 0.5, (2.0000005, 1.5))):
        w = 1 / mpf(r0)
        orbit = Orbit((1 - 2 * w) * (1 + (mpf(l) * w) ** 2) - 1, l)
        returning("rest", [r0, l], orbit, mpf(r0), radii)
    for l, r0, radii in ((0.0, 10.0, (1e6, 3.0, 1e-3)), (3.9, 30.0, (1e6, 4.1, 2.0, 0.01)),
                         (3.999999, 100.0, (4.0, 1.0))):
        one_way("infinity", [l, r0], Orbit(0, l), mpf(r0), False, "v", radii)
    v, b, r0 = 0.5, 1.0, 20.0
    excess = speed_excess(mpf(v))
    one_way("speed", [v, b, r0], Orbit(excess, mpf(b) * sqrt(excess)), mpf(r0), False, "v",
            (1e3, 5.0, 1.0))


def thrown_orbit(r, a, b):
    r, a, b = mpf(r), mpf(a), mpf(b)
    return Orbit((1 + a * a + b * b) * (1 - 2 / r) - 1, r * b)


def throws():
    for r, a, b, radii in ((10.0, -1e3, 10.0, (1e4, 5.0, 0.5)), (6.0, -2.0, 0.5, (3.0, 2.0, 0.1)),
                           (10.0, -1e6, 100.0, (100.0, 1.0))):
        one_way("thrown", [r, a, b], thrown_orbit(r, a, b), mpf(r), False, "v", radii)
    for r, a, b, radii in ((10.0, 2.0, 0.1, (11.0, 1e4)), (3.0, 50.0, 1.0, (4.0, 1e6))):
        one_way("thrown", [r, a, b], thrown_orbit(r, a, b), mpf(r), True, "v", radii)
    for r, a, b in ((1.0, 0.5, 1.0), (0.1, -3.0, 2.0), (1.5, 0.0, 30.0), (1.0, 3.0, 1.0)):
        s, gamma = sqrt(2 / mpf(r)), sqrt(1 + mpf(a) ** 2 + mpf(b) ** 2)
        energy = gamma - s * mpf(a)
        one_way("rain", [r, a, b], Orbit(energy * energy - 1, mpf(r) * mpf(b)), mpf(r), False, "v",
                (r / 2, r / 30))


def crossings():
    for e, l, radii in ((0.0, 0.0, (1.9999, 1.0, 1e-3)), (0.0, 2.0, (1.5, 0.1)),
                        (0.5, 0.0, (2.5, 2.0, 1e-3)), (0.9, 2.0, (5.0, 1.0)),
                        (2.0, 15.0, (2.1, 1.0)), (1e-6, 0.0, (1.9999, 0.5))):
        orbit = Orbit(mpf(e) ** 2 - 1, l)
        # What comes out of r = 0 turns at the first root it meets.
        returning("crossing", [e, l], orbit, orbit.radii[0], radii)
    for e, l, radii in ((1.0, 1.0, (0.5, 3.0, 1e6)), (2.0, 1.0, (1e-3, 2.5, 1e4))):
        one_way("crossing", [e, l], Orbit(mpf(e) ** 2 - 1, l), mpf(2), True, "u", radii)


def main():
    for make in (parabolics, hyperbolics, bounds, falls, throws, crossings):
        make()
        print(make.__name__, len(ROWS), file=sys.stderr, flush=True)
    print("# timelike geodesics, M = 1, computed with 50 digits by make_orbits.py; a, b, c: the factory's")
    print("# arguments; leg: in or out at this state; null_time: u on the way out from region IV, else v")
    print(FIELDS)
    print("\n".join(ROWS))


if __name__ == "__main__":
    main()
