"""Axel Mellinger's panorama as light without stars: what is left of them is filled in, the steps of
8 bits are smoothed."""

import sys

import numpy as np
import OpenImageIO as oiio

from deep_sky import CLUSTERS, GALAXIES, MAGELLANIC, NEBULAE, REPLACED, REPLACED_CLOUDS
from sphere_image import LUMA, blurred, decoded, doubled, encoded, rows_near, separation

PANORAMA_HEIGHT = 1024
SHARPER = 0.3  # how much of what a blur of 0.2 degrees takes is added, where light is bright


def without_specks(image):
    """Where a pixel stands far above the median of those around it, it takes that median."""
    height = len(image)
    padded = np.pad(np.concatenate([image[:, -3:], image, image[:, :3]], axis=1),
                    ((3, 3), (0, 0), (0, 0)), mode="reflect")
    ring = [(j, i) for j in range(7) for i in range(7) if max(abs(j - 3), abs(i - 3)) >= 2]
    around = np.stack([padded[j:j + height, i:i + 2 * height] @ LUMA for j, i in ring])
    median = np.median(around, axis=0)
    speck = image @ LUMA > 1.3 * median + 0.001
    kept = [(ra, dec, 1.0 * max(length, 20) / 60) for _, ra, dec, length, *_ in NEBULAE
            if length < 200]
    kept += [(ra, dec, length / 60) for _, ra, dec, length, *_ in GALAXIES]
    kept += [(ra, dec, 0.8) for _, ra, dec, *_ in CLUSTERS]
    kept += [(ra, dec, within) for _, ra, dec, within, *_ in MAGELLANIC]
    for ra, dec, radius in kept:
        rows = rows_near(dec, radius, height)
        speck[rows] &= separation(ra, dec, height, rows) > radius
    # A star's colour is not the sky's: that comes from around.
    hue = blurred(np.where(speck[..., None], 0, image), 0.6)
    hue /= np.maximum(hue @ LUMA, 1e-9)[..., None]
    print(f"{speck.mean():.1%} of the panorama's pixels are stars' and filled in")
    return np.where(speck[..., None], hue * median[..., None], image)


def between_like(luma, code):
    """Each pixel's mean with those within about 1 degree and 2 codes: steps go, edges stay."""
    out, total = np.zeros_like(luma), np.zeros_like(luma)
    for level in np.arange(0, 33, 2.0):
        like = np.exp(-0.5 * ((code - level) / 2) ** 2)
        sums = blurred(np.stack([luma * like, like], axis=2), 1.0)
        here = np.maximum(1 - np.abs(code - level) / 2, 0)
        out += here * sums[..., 0] / np.maximum(sums[..., 1], 1e-6)
        total += here
    return out / np.maximum(total, 1e-6)


def debanded(luma):
    """The fewer of 8 bits' steps there are to show a shape, the more it is blurred."""
    code = encoded(blurred(luma, 0.2))
    wide = blurred(code, 0.5)
    grain = np.clip((wide - 20) / 40, 0, 1)
    fine = grain * blurred(luma, 0.07) + (1 - grain) * blurred(luma, 0.15)
    middle = between_like(blurred(luma, 0.15), np.minimum(code, 32))
    share = np.clip((wide - 10) / 14, 0, 1)
    share = share * share * (3 - 2 * share)
    mixed = share * fine + (1 - share) * middle
    # Where nearly all is clipped, specks and noise are all there is.
    dark = np.clip((encoded(blurred(luma, 1.5)) - 3) / 5, 0, 1)
    return np.maximum(dark * mixed + (1 - dark) * blurred(luma, 2.5), 0)


def without(places, luma):
    """What is painted anew is filled in with the light around it."""
    for ra, dec, radius in places:
        away = separation(ra, dec, len(luma))
        ring = (away > radius) & (away < 1.25 * radius)
        share = np.clip((radius - away) / (0.3 * radius), 0, 1)
        luma = luma * (1 - share) + share * np.minimum(np.median(luma[ring]), luma)
    return luma


def read_panorama(path, height):
    """Linear luminance without galaxies and clusters, the same with the Magellanic Clouds, and how
    much redder than its surroundings the picture is; RA 0h in the middle (the file has 18h there)."""
    image = oiio.ImageBuf(path).get_pixels(oiio.FLOAT)[..., :3].astype(np.float64)
    if image.shape != (PANORAMA_HEIGHT, 2 * PANORAMA_HEIGHT, 3):
        sys.exit(f"{path}: expected {2 * PANORAMA_HEIGHT} x {PANORAMA_HEIGHT} pixels")
    image = without_specks(np.roll(decoded(image), PANORAMA_HEIGHT // 2, axis=1))
    luma = without(REPLACED, debanded(image @ LUMA))
    soft = blurred(image, 0.12)
    red = soft[..., 0] - 0.5 * (soft[..., 1] + soft[..., 2])
    red = np.maximum(red - blurred(red, 3.0), 0)

    def enlarged(x):
        while len(x) < height:
            x = doubled(x)
        return np.maximum(x, 0)
    clouds, red = enlarged(luma), enlarged(red)
    luma = enlarged(without(REPLACED_CLOUDS, luma))
    # A little of what the picture's own pixels took.
    lit = np.clip((encoded(blurred(luma, 0.5)) - 30) / 40, 0, 1)
    luma = np.clip(luma + SHARPER * lit * (luma - blurred(luma, 0.2)), 0.6 * luma, 1.5 * luma)
    return luma, clouds, red
