"""The light of nebulae, galaxies and clusters, in S10(V) and linear Rec.709.

A source's light, summed over the sky, is the catalogued one. None is narrower than the blur that
all get in the end, so that none is a lone pixel, which would flicker where the sky turns."""

import math
import zlib

import numpy as np

from deep_sky import (CLUSTERS, GALAXIES, KINDS, LOOP, LOOP_BRIGHTNESS, LOOP_WIDTH, MAGELLANIC,
                      NEBULAE, PINK)
from sphere_image import (LUMA, blurred, east_north, mean_over_sky, rows_near, separation,
                          solid_angle)

BLUR = 0.8  # sigma, in pixels: a point is then 1.9 pixels wide at half its height
# Where a nebula ends, in radii of its ellipse. Its light has fallen to 2e-4 of the middle's there.
NEBULA_END = 3.4
WAVES = 14  # in each octave of turbulence


def s10(mag_arcsec2):
    """Stars of V = 10 per square degree; one is 27.78 mag/arcsec^2."""
    return 10 ** (0.4 * (27.78 - mag_arcsec2))


def colour_of(kind):
    colour = np.array(KINDS[kind])
    return colour / (colour @ LUMA)


def ellipse_radius(east, north, length, width, angle):
    """1 on the ellipse of these diameters (arcminutes), at places given in degrees."""
    cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return np.hypot((north * cos + east * sin) * 120 / length,
                    (east * cos - north * sin) * 120 / width)


def of_light(profile, light, height, rows):
    """The profile, scaled to a light in S10(V) times square degrees."""
    total = (profile * solid_angle(height)[rows]).sum() * math.degrees(1) ** 2
    return profile * (light / total)


def of_flux(profile, v, height, rows):
    """The profile, its light that of a star of magnitude v."""
    return of_light(profile, 10 ** (-0.4 * (v - 10)), height, rows)


def turbulence(seed, east, north, longest, shortest):
    """A random field of variance 1, the same for the same seed: plane waves of lengths (degrees)
    between those two, whose amplitudes grow with their length."""
    random = np.random.default_rng(zlib.crc32(seed.encode()))
    total, power, length = np.zeros(east.shape), 0.0, longest
    while length >= shortest or not power:
        for turn, phase, stretch in random.random((WAVES, 3)):
            k = 2 * math.pi / (length * (0.7 + 0.6 * stretch))
            x = math.cos(2 * math.pi * turn) * east + math.sin(2 * math.pi * turn) * north
            total += length ** 0.8 * np.cos(k * x + 2 * math.pi * phase)
        power += WAVES / 2 * length ** 1.6
        length /= 2
    return total / math.sqrt(power)


def nebula_profile(name, east, north, length, width, angle, pixel):
    """An ellipse bent and torn, without an edge. Arcminutes; the rest is in degrees."""
    size = math.sqrt(length * width) / 60

    def field(part, longest):
        return turbulence(f"{name}, {part}", east, north, longest, 2.5 * pixel)
    bend = min(0.13 * size, 0.2 * width / 60)
    r = ellipse_radius(east + bend * field("east", 0.9 * size),
                       north + bend * field("north", 0.9 * size), length, width, angle)
    return np.exp(-1.55 * r ** 1.4 + 0.35 * field("clumps", 0.5 * size)) * (r < NEBULA_END)


def nebulae(red, relief, more, height):
    """`red` is how much redder than its surroundings the panorama is, `relief` its luminance
    against that around: the nebulae's shapes, where it shows them. `more` are rows like NEBULAE's.
    """
    sky = np.zeros((height, 2 * height, 3))
    pixel = 180 / height
    for name, ra, dec, length, width, angle, brightness, kind in NEBULAE + more:
        rows = rows_near(dec, 0.55 * NEBULA_END * length / 60 + 3 * pixel, height)
        east, north = east_north(ra, dec, height, rows)
        near = np.hypot(east, north) < 0.55 * NEBULA_END * length / 60 + 2 * pixel
        seen = [max(x, 60 * pixel) for x in (length, width)]
        profile = nebula_profile(name, east[near], north[near], *seen, angle, pixel)
        profile *= relief[rows][near]
        shape = red[rows][near]
        if kind in ("pink", "rose") and shape.max() > 0:
            mean = np.average(shape, weights=profile)
            profile *= 0.35 + np.minimum(0.65 * shape / max(mean, 0.004), 4)
        whole = np.zeros(east.shape)
        whole[near] = profile
        light = s10(brightness) * math.pi / 4 * length * width / 3600
        whole = of_light(whole, light, height, rows)
        sky[rows][near] += whole[near][:, None] * colour_of(kind)
    return sky + barnards_loop(height)[..., None] * (np.array(PINK) / (np.array(PINK) @ LUMA))


def barnards_loop(height):
    ra, dec, radius, first, last = LOOP
    rows = rows_near(dec, 3 * radius, height)
    east, north = east_north(ra, dec, height, rows)
    away, angle = np.hypot(east, north), np.degrees(np.arctan2(east, north))
    away = away + 0.25 * turbulence("loop", east, north, 4, 0.4)
    arc = np.exp(-0.5 * ((away - radius) / LOOP_WIDTH) ** 2)
    arc += 0.35 * np.exp(-0.5 * ((away - radius + 0.9) / (2.2 * LOOP_WIDTH)) ** 2)
    ends = np.clip(np.minimum(angle - first, last - angle) / 35, 0, 1)
    sky = np.zeros((height, 2 * height))
    clumps = np.exp(0.3 * turbulence("loop's clumps", east, north, 3, 0.3) - 0.045)
    sky[rows] = arc * clumps * ends * ends * (3 - 2 * ends) * s10(LOOP_BRIGHTNESS)
    return sky


def disc_of(name, r, side, texture):
    """A galaxy's disc, of the radius r; side is degrees to the nearer side of the minor axis."""
    disc = np.exp(-3.2 * r + 0.2 * texture) * np.clip((2.2 - r) / 0.8, 0, 1)
    if name == "M 31":  # its ring of young stars, and the dust before its bulge
        disc *= 1 + 0.35 * np.exp(-0.5 * ((r - 0.52) / 0.10) ** 2)
        disc *= 1 - 0.45 * np.clip(6 * side, 0, 1) * np.exp(-0.5 * ((r - 0.33) / 0.12) ** 2)
    return disc


def galaxies(colour, more, height):
    """Exponential discs with bulges; `colour(b_v)` is linear Rec.709 of luminance 1. `more` are
    rows like GALAXIES'."""
    sky = np.zeros((height, 2 * height, 3))
    pixel = 60 * 180 / height
    for name, ra, dec, length, width, angle, v, b_v, bulge in GALAXIES + more:
        rows = rows_near(dec, 1.2 * max(length, 2 * pixel) / 60, height)
        east, north = east_north(ra, dec, height, rows)
        side = north * math.sin(math.radians(angle)) - east * math.cos(math.radians(angle))

        def radius(a, b):  # of a peak that the pixels can show
            a, b = (math.hypot(x, 1.5 * pixel) for x in (a, b))
            return np.hypot(ellipse_radius(east, north, a, b, angle), pixel / b)
        texture = 0.0
        if length > 30:
            cos, sin = math.cos(math.radians(angle)), math.sin(math.radians(angle))
            texture = turbulence(name, north * cos + east * sin,  # round in the disc's own plane
                                 (east * cos - north * sin) * length / width,
                                 length / 200, pixel / 15)
        disc = of_flux(disc_of(name, radius(length, width), side, texture), v, height, rows)
        light = (1 - bulge) * disc[..., None] * colour(b_v - 0.1 * (bulge > 0))
        if bulge:
            size = min(0.28 * length, 0.5 * width)
            r = radius(size, 0.75 * size)
            core = of_flux(np.exp(-2.5 * r) * np.clip(4 - r, 0, 1), v, height, rows)
            light += bulge * core[..., None] * colour(b_v + 0.05)
        sky[rows] += light
    return sky


def clusters(colour, more, height):
    """Star clusters as Plummer's spheres. `more` are (name, RA, Dec, V, radius of half the light,
    colour)."""
    sky = np.zeros((height, 2 * height, 3))
    known = [(*row, colour(0.75)) for row in CLUSTERS]
    for _, ra, dec, v, half, rgb in known + more:
        core = math.hypot(half / 60, 0.7 * 180 / height)
        rows = rows_near(dec, 12 * core, height)
        away = separation(ra, dec, height, rows).astype(np.float64) / core
        profile = (1 + away ** 2) ** -2 * np.clip((12 - away) / 3, 0, 1)
        sky[rows] += of_flux(profile, v, height, rows)[..., None] * rgb
    return sky


def magellanic(luma, colour, height):
    """The two clouds: shapes from the panorama's luminance, light and colours as catalogued."""
    sky = np.zeros((height, 2 * height, 3))
    for _, ra, dec, within, v, b_v, disc, scale, ratio, angle in MAGELLANIC:
        rows = rows_near(dec, 6 * scale, height)
        away = separation(ra, dec, height, rows).astype(np.float64)
        ring = (away > within) & (away < 1.15 * within)
        edge = np.clip((within - away) / (0.75 * within), 0, 1)
        shape = np.maximum(luma[rows] - np.median(luma[rows][ring]), 0)
        shape *= edge * edge * (3 - 2 * edge)
        east, north = east_north(ra, dec, height, rows)
        r = ellipse_radius(east, north, 120 * scale, 120 * scale * ratio, angle)
        smooth = np.exp(-r) * np.clip(6 - r, 0, 1)
        sky[rows] += ((1 - disc) * of_flux(shape, v, height, rows)
                      + disc * of_flux(smooth, v, height, rows))[..., None] * colour(b_v)
    return sky


def objects(red, luma, colour, catalogue, height):
    """All of them. `luma` is the panorama's with the Magellanic Clouds; `catalogue` is
    object_catalogue.Catalogue."""
    faintest = 0.004
    relief = np.clip((luma + faintest) / (blurred(luma, 0.6) + faintest), 0.6, 1.5)
    young = [(name, ra, dec, v, 0.5, colour_of("rose") if glows else colour(0.3))
             for name, ra, dec, v, glows in catalogue.in_magellanic_clouds]
    old = [(*row, colour(0.75)) for row in catalogue.clusters]
    sky = (nebulae(red, relief, catalogue.nebulae, height)
           + galaxies(colour, catalogue.galaxies, height)
           + clusters(colour, old + young, height))
    sky = np.maximum(blurred(sky, BLUR * 180 / height), 0)
    sky += magellanic(luma, colour, height)
    print(f"nebulae, galaxies, clusters: {mean_over_sky(sky @ LUMA):.1f} S10(V)")
    return sky
