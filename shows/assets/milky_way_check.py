"""What milky_way.exr and milky_way_deep.exr must hold to: light, places of known objects, no seam, no
pinch, no steps."""

import math

import numpy as np
import OpenImageIO as oiio

from deep_sky import CLUSTERS, GALAXIES, MAGELLANIC, NEBULAE
from sphere_image import (LUMA, blurred, column_row, declinations, galactic_latitude, mean_over_sky,
                          rows_near, separation, solid_angle)

S10 = 8.3e-3  # file units

# Name, RA, Dec (degrees, J2000), light or dark, degrees within which it is looked for, and within
# which it must be found: the pixel for what is small, its own extent for clouds.
OBJECTS = [
    ("M 31", 10.685, 41.269, 1, 1.5, 0.2),
    ("M 33", 23.462, 30.660, 1, 1.0, 0.2),
    ("Orion Nebula", 83.82, -5.40, 1, 1.0, 0.2),
    ("M 8", 270.92, -24.38, 1, 0.8, 0.3),
    ("Small Magellanic Cloud", 13.19, -72.83, 1, 1.6, 0.8),
    ("Large Magellanic Cloud", 80.0, -69.5, 1, 4.0, 1.5),
    ("eta Carinae's nebula", 161.27, -59.68, 1, 1.5, 0.4),
    ("omega Centauri", 201.697, -47.480, 1, 1.0, 0.25),
    ("47 Tucanae", 6.022, -72.081, 1, 0.8, 0.25),
    ("Rho Ophiuchi's dust", 248.0, -24.3, -1, 4.0, 2.5),
    ("Coalsack", 192.5, -62.7, -1, 4.0, 2.5),
    ("Small Sagittarius Cloud", 274.2, -18.4, 1, 2.0, 1.0),
    ("Large Sagittarius Cloud", 271.0, -28.5, 1, 3.0, 2.0),
    ("Scutum Cloud", 281.5, -7.0, 1, 3.0, 2.0),
    ("North America Nebula", 314.7, 44.3, 1, 1.5, 0.8),
]


def found_at(luma, ra, dec, sign, within):
    """Centre of weight of what stands out (dark: falls short) around a place, degrees off it."""
    height = len(luma)
    near = separation(ra, dec, height)
    around = np.median(luma[(near > within) & (near < 1.6 * within)])
    excess = np.where(near < within, np.maximum(sign * (luma - around), 0), 0)
    excess = np.where(excess > 0.5 * excess.max(), excess, 0)
    if excess.max() <= 0:
        return math.inf, math.inf
    rows, columns = np.nonzero(excess)
    x, y = column_row(ra, dec, height)
    degree = 180 / height
    dx = (columns - x + height) % (2 * height) - height
    weight = excess[rows, columns] * solid_angle(height)[rows, 0]
    east = -(dx * np.cos(declinations(height)[rows]) * weight).sum() / weight.sum() * degree
    north = -((rows - y) * weight).sum() / weight.sum() * degree
    return east, north


def report(ok, text):
    print(("ok    " if ok else "WRONG ") + text)
    return 0 if ok else 1


def check_places(luma):
    wrong = 0
    for name, ra, dec, sign, within, tolerance in OBJECTS:
        east, north = found_at(luma, ra, dec, sign, within)
        wrong += report(math.hypot(east, north) <= tolerance,
                        f"{name}: {east:+.2f} east, {north:+.2f} north (degrees; {tolerance} "
                        "allowed)")
    return wrong


def check_light(sky, luma):
    mean, least, greatest = mean_over_sky(luma), luma.min(), luma.max()
    wrong = report(0.4 < mean < 0.7, f"mean {mean:.3f} ({mean / S10:.0f} S10(V))")
    # The greatest is the heart of a globular cluster.
    wrong += report(0.07 < least and greatest < 100, f"least {least:.3f}, greatest {greatest:.2f}")
    latitude = np.abs(galactic_latitude(len(luma)))
    weight = solid_angle(len(luma)) * np.ones(luma.shape)
    belts = [(luma * weight)[b].sum() / weight[b].sum() / S10
             for b in ((latitude >= low) & (latitude < high)
                       for low, high in ((0, 5), (5, 10), (10, 20), (20, 30), (30, 60), (60, 91)))]
    wrong += report(all(a > b for a, b in zip(belts, belts[1:])), "S10(V) by galactic latitude "
                    + " ".join(f"{b:.0f}" for b in belts))
    whole = np.array([mean_over_sky(sky[..., k]) for k in range(3)]) / mean
    return wrong + report(whole[0] > whole[2], "mean colour " + " ".join(f"{c:.3f}" for c in whole))


def check_joins(luma):
    """The wrap, and the panorama's own (RA 6h), are no rougher than the columns around them; at the
    poles all RA agree."""
    rough = np.mean(np.abs(np.roll(luma, -1, axis=1) - luma) / luma, axis=0)
    wrong = 0
    for name, column in (("12h", -1), ("6h", len(luma) // 2 - 1)):
        join = rough[column]
        usual = np.median(np.roll(rough, 50 - column)[:101])
        wrong += report(join < 1.5 * usual, f"steps at RA {name} {join:.5f}, around it {usual:.5f}")
    spread = max(np.ptp(luma[row]) / luma[row].mean() for row in (0, -1))
    return wrong + report(spread < 0.02, f"at the poles the light differs by {spread:.2%} over RA")


def check_points(luma):
    """Two compact clusters must not be lone pixels, which flicker. A point has 0.22 of its light in
    its brightest pixel after the blur that all sources get."""
    wrong = 0
    for name, ra, dec in (("M 3", 205.548, 28.377), ("M 92", 259.281, 43.136)):
        near = separation(ra, dec, len(luma)) < 0.45
        excess = np.where(near, luma - np.median(luma[near]), 0)
        share = excess.max() / excess[excess > 0].sum()
        wrong += report(share < 0.25, f"the brightest pixel of {name} has {share:.0%} of its light")
    return wrong


def check_specks(luma, catalogue):
    """More than 25 degrees from the galactic equator, the greatest step from a pixel to its
    surroundings of half a degree, but for nebulae, galaxies and clusters."""
    height = len(luma)
    dark = np.abs(galactic_latitude(height)) > 25
    known = [(ra, dec, max(length / 30, 1.5)) for _, ra, dec, length, *_ in
             NEBULAE + GALAXIES + catalogue.nebulae + catalogue.galaxies]
    known += [(ra, dec, 2.5) for _, ra, dec, *_ in CLUSTERS + catalogue.clusters]
    known += [(ra, dec, 10) for _, ra, dec, *_ in MAGELLANIC] + [(84, -1, 12)]
    for ra, dec, radius in known:
        rows = rows_near(dec, radius, height)
        dark[rows] &= separation(ra, dec, height, rows) > radius
    step = (np.abs(luma / blurred(luma, 0.5) - 1))[dark].max()
    return report(step < 0.05, f"greatest step beyond the band {step:.1%}")


def read(path, height):
    sky = oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)
    if sky.shape != (height, 2 * height, 3) or not np.isfinite(sky).all() or sky.min() < 0:
        raise ValueError(f"{path}: expected {2 * height} x {height} x 3 finite numbers from 0 up")
    return sky


def check(folder, catalogue):
    """Prints what is measured; the number of things that are wrong."""
    try:
        sky, deep = (read(f"{folder}/{name}.exr", height)
                     for name, height in (("milky_way", 2048), ("milky_way_deep", 1024)))
    except ValueError as error:
        return report(False, str(error))
    luma, deep = sky @ LUMA, deep @ LUMA
    share = mean_over_sky(deep) / mean_over_sky(luma)
    wrong = report(0.4 < share < 0.7, f"{share:.0%} of the light is beyond Tycho-2's stars")
    small = (luma[::2, ::2] + luma[1::2, ::2] + luma[::2, 1::2] + luma[1::2, 1::2]) / 4
    wrong += report((deep < 1.02 * small + 1e-3).all(), "nowhere is the deep map the brighter one")
    return (wrong + check_light(sky, luma) + check_places(luma) + check_joins(luma)
            + check_points(luma) + check_specks(luma, catalogue))
