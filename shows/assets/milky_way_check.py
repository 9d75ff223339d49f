"""What milky_way.exr must hold to: light, places of known objects, no seam, no pinch, no steps."""

import math

import numpy as np
import OpenImageIO as oiio

from sphere_image import (DEC, GALACTIC_POLE, HEIGHT, LUMA, SOLID_ANGLE, WIDTH, blurred, column_row,
                          directions, mean_over_sky, separation)

S10 = 8.3e-3  # file units

# Name, RA, Dec (degrees, J2000), light or dark, degrees within which it is looked for, and within
# which it must be found: the pixel for what is small, its own extent for clouds.
OBJECTS = [
    ("M 31", 10.685, 41.269, 1, 1.5, 0.3),
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
    near = separation(ra, dec)
    around = np.median(luma[(near > within) & (near < 1.6 * within)])
    excess = np.where(near < within, np.maximum(sign * (luma - around), 0), 0)
    excess = np.where(excess > 0.5 * excess.max(), excess, 0)
    if excess.max() <= 0:
        return math.inf, math.inf
    rows, columns = np.nonzero(excess)
    x, y = column_row(ra, dec)
    degree = 360 / WIDTH
    dx = (columns - x + WIDTH / 2) % WIDTH - WIDTH / 2
    weight = excess[rows, columns] * SOLID_ANGLE[rows, columns]
    east = -(dx * np.cos(DEC[rows]) * weight).sum() / weight.sum() * degree
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
    wrong += report(0.1 < least and greatest < 12, f"least {least:.3f}, greatest {greatest:.2f}")
    whole = np.array([mean_over_sky(sky[..., k]) for k in range(3)]) / mean
    return wrong + report(whole[0] > whole[2], "mean colour " + " ".join(f"{c:.3f}" for c in whole))


def check_joins(luma):
    """The wrap, and the panorama's own (RA 6h), are no rougher than any other column; at the poles
    all RA agree."""
    rough = np.median(np.abs(np.roll(luma, -1, axis=1) - luma) / luma, axis=0)
    joins = max(rough[-1], rough[WIDTH // 4 - 1])
    usual = np.median(rough)
    wrong = report(joins < 2 * usual, f"steps at seams {joins:.5f}, at other columns {usual:.5f}")
    spread = max(np.ptp(luma[row]) / luma[row].mean() for row in (0, -1))
    return wrong + report(spread < 0.02, f"at the poles the light differs by {spread:.2%} over RA")


def check_specks(luma):
    """More than 25 degrees from the galactic equator, the greatest step from a pixel to its
    surroundings of half a degree, and the share of pixels that equal the one below, as most do
    between the contours of a picture in steps."""
    dark = np.abs(directions() @ GALACTIC_POLE) > math.sin(math.radians(25))
    for _, ra, dec, _, within, _ in OBJECTS:
        dark &= separation(ra, dec) > 2 * within
    step = (np.abs(luma / blurred(luma, 0.5) - 1))[dark].max()
    flat = (np.diff(luma, axis=0) == 0)[dark[1:]].mean()
    wrong = report(step < 0.05, f"greatest step beyond the band {step:.1%}")
    return wrong + report(flat < 0.1, f"{flat:.1%} of the pixels there equal the one below")


def check(path):
    """Prints what is measured; the number of things that are wrong."""
    sky = oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)
    if sky.shape != (HEIGHT, WIDTH, 3) or not np.isfinite(sky).all() or sky.min() < 0:
        return report(False, f"{path}: expected {WIDTH} x {HEIGHT} x 3 finite numbers from 0 up")
    luma = sky @ LUMA
    return check_light(sky, luma) + check_places(luma) + check_joins(luma) + check_specks(luma)
